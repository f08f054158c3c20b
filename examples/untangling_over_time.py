#!/usr/bin/env python3
# %% [markdown]
# # Untangling, watched
#
# Two sheets run through each other. This repairs them and plots what happened meanwhile: how many pairs of triangles
# still intersect, and how far the vertices have moved. The cells (`# %%`) run one by one in an editor that knows them,
# or all at once: `python3 untangling_over_time.py [PICTURE.png]`.

# %%
import sys
import time

import matplotlib

if __name__ == "__main__" and len(sys.argv) > 1:
    matplotlib.use("Agg")  # a picture, no window
import matplotlib.pyplot as plt
import numpy as np

import unsnarl

# %% [markdown]
# ## Two sheets
#
# Quads over a square: one sheet is flat; the other lies below, is wavy, and pokes through with a high and a low bump.

# %%
n = 24
u, v = np.meshgrid(np.linspace(-1, 1, n + 1), np.linspace(-1, 1, n + 1), indexing="ij")
flat = np.stack([u, v, np.zeros_like(u)], axis=-1)
high = 0.35 * np.exp(-8 * ((u - 0.45) ** 2 + (v - 0.45) ** 2))
low = 0.15 * np.exp(-12 * ((u + 0.45) ** 2 + (v + 0.45) ** 2))
bumpy = np.stack([u, v, high + low - 0.05 * np.cos(9 * u) - 0.1], axis=-1)
V = np.concatenate([flat.reshape(-1, 3), bumpy.reshape(-1, 3)])

corner = np.add.outer((n + 1) * np.arange(n), np.arange(n)).ravel()
quads = np.stack([corner, corner + n + 1, corner + n + 2, corner + 1], axis=-1)
F = np.concatenate([quads, quads + (n + 1) ** 2])

found = unsnarl.find_intersections(V, F)
print(f"{len(V)} vertices, {len(F)} quads: {found}")

# %% [markdown]
# ## Repair
#
# Only the bumpy sheet may move. `progress` is called now and then; what it is told is kept with the time.

# %%
begin = time.perf_counter()
seconds, watched = [], []


def watch(progress):
    seconds.append(time.perf_counter() - begin)
    watched.append(progress)


result = unsnarl.repair(V, F, fixed=np.arange(len(V)) < len(V) // 2, progress=watch)
print(result)

# %% [markdown]
# ## Plots

# %%
displacement = np.linalg.norm(result.V - V, axis=1)
figure, (pairs, moved, where) = plt.subplots(1, 3, figsize=(13, 4), layout="constrained")

pairs.step(seconds, [progress.pairs_left for progress in watched], where="post", marker="o")
pairs.set(title="Intersecting pairs of triangles", xlabel="time (s)", ylim=(0, None))

moved.step(seconds, [100 * progress.displacement_rel for progress in watched], where="post", marker="o")
moved.set(title="Largest displacement", xlabel="time (s)", ylabel="% of the diagonal", ylim=(0, None))

picture = where.pcolormesh(u, v, displacement[len(V) // 2 :].reshape(u.shape), shading="gouraud", cmap="viridis")
where.set(title="Displacement of the bumpy sheet", aspect="equal", xlabel="x", ylabel="y")
figure.colorbar(picture, ax=where)

if len(sys.argv) > 1:
    figure.savefig(sys.argv[1], dpi=110)
    print(f"wrote {sys.argv[1]}")
else:
    plt.show()
