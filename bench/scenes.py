"""Meshes of any size with tangles in them, made of the program's own samples: for bench/scale."""

import subprocess
import tempfile
from pathlib import Path

import numpy as np


def read_obj(path):
    """Vertices (n, 3) and triangles (m, 3) of an OBJ file; polygons are cut into fans from their first corners."""
    vertices, triangles = [], []
    for line in Path(path).read_text().splitlines():
        words = line.split()
        if line.startswith("v "):
            vertices.append([float(word) for word in words[1:4]])
        elif line.startswith("f "):
            corners = [int(word.split("/")[0]) for word in words[1:]]
            corners = [c - 1 if c > 0 else len(vertices) + c for c in corners]
            triangles += [[corners[0], corners[k], corners[k + 1]] for k in range(1, len(corners) - 1)]
    return np.array(vertices), np.array(triangles, dtype=np.int64)


def write_obj(path, vertices, triangles):
    with Path(path).open("w") as file:
        file.write("".join("v %.9g %.9g %.9g\n" % tuple(p) for p in vertices))
        file.write("".join("f %d %d %d\n" % tuple(t) for t in triangles + 1))
    return path


def sample(program, name):
    """A built-in sample, as triangles."""
    run = subprocess.run([program, "sample", name, "-o", "-", "--format", "obj"], capture_output=True)
    if run.returncode:
        raise RuntimeError(f"'unsnarl sample {name}' failed: {run.stderr.decode()}")
    with tempfile.NamedTemporaryFile(suffix=".obj") as file:
        file.write(run.stdout)
        file.flush()
        return read_obj(file.name)


def refine(vertices, triangles, chosen):
    """Cuts the chosen triangles (flags) in four at the middles of their edges, their neighbours as needed."""
    sides = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]], axis=2).reshape(-1, 2)
    edges, edge_of = np.unique(sides, axis=0, return_inverse=True)
    edge_of = edge_of.reshape(-1, 3)
    is_cut = np.zeros(len(edges), dtype=bool)
    is_cut[edge_of[chosen].ravel()] = True
    middle = np.cumsum(is_cut) - 1 + len(vertices)
    vertices = np.vstack([vertices, vertices[edges[is_cut]].mean(axis=1)])
    cuts = is_cut[edge_of].sum(axis=1)
    result = [triangles[cuts == 0]]
    for t, e in ((triangles[cuts == 3], edge_of[cuts == 3]),):
        a, b, c = t.T
        ab, bc, ca = middle[e].T
        result += [np.stack(corners, axis=1) for corners in ((a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca))]
    for k in range(3):  # one side cut: the one after corner k; two: all but the one after corner k
        one = (cuts == 1) & is_cut[edge_of[:, k]]
        a, b, c = np.roll(triangles[one], -k, axis=1).T
        m = middle[edge_of[one, k]]
        result += [np.stack([a, m, c], axis=1), np.stack([m, b, c], axis=1)]
        two = (cuts == 2) & ~is_cut[edge_of[:, k]]
        a, b, c = np.roll(triangles[two], -k, axis=1).T
        bc, ca = middle[np.roll(edge_of[two], -k, axis=1)[:, 1]], middle[np.roll(edge_of[two], -k, axis=1)[:, 2]]
        result += [np.stack(corners, axis=1) for corners in ((a, b, bc), (a, bc, ca), (ca, bc, c))]
    return vertices, np.vstack(result)


def refine_all(vertices, triangles):
    return refine(vertices, triangles, np.ones(len(triangles), dtype=bool))


def refine_elsewhere(vertices, triangles, kept):
    """Every triangle without one of the kept vertices (ids) in four."""
    return refine(vertices, triangles, ~np.isin(triangles, kept).any(axis=1))


def around(triangles, vertices, rings):
    """The vertices and all within so many edges."""
    found = np.unique(vertices)
    for _ in range(rings):
        found = np.unique(triangles[np.isin(triangles, found).any(axis=1)])
    return found


def side_by_side(meshes, face_count):
    """Copies of the meshes on a grid, each scaled to the unit box, until there are so many faces."""
    unit = []
    for vertices, triangles in meshes:
        low = vertices.min(axis=0)
        unit.append(((vertices - low) / np.ptp(vertices, axis=0).max(), triangles))
    count, total = 0, 0
    while total < face_count:
        total += len(unit[count % len(unit)][1])
        count += 1
    row = int(np.ceil(count ** (1 / 3)))
    all_vertices, all_triangles, first = [], [], 0
    for k in range(count):
        vertices, triangles = unit[k % len(unit)]
        cell = np.array([k % row, k // row % row, k // row ** 2])
        all_vertices.append(vertices + 1.25 * cell)
        all_triangles.append(triangles + first)
        first += len(vertices)
    return np.vstack(all_vertices), np.vstack(all_triangles)


def hooked_sheet(cells, footprint=24):
    """A wavy sheet of cells x cells squares, cut in two each. A finger of it, of `footprint` cells across at its foot,
    bends over and pierces the sheet beside it."""
    i, j = np.meshgrid(np.arange(cells + 1), np.arange(cells + 1), indexing="ij")
    x, y = i / cells, j / cells
    z = 0.002 * np.sin(20 * x) * np.cos(17 * y)
    foot = footprint / cells / 2
    length, width = 3.2 * foot, 0.28 * foot
    dx, dy = x - 0.5, y - 0.5
    way = np.clip(1 - np.hypot(dx, dy) / foot, 0, 1)  # 0 at the foot's rim, 1 at the tip
    angle = np.arctan2(dy, dx)
    finger = width * np.sqrt(np.clip(1 - ((way - 0.15) / 0.85) ** 4, 0, 1))
    radius = np.where(way < 0.15, foot * (1 - way) * (1 - way / 0.15) + width * (way / 0.15), finger)
    bend = length / 3.6
    turn = way * length / bend
    inside = way > 0
    x = np.where(inside, 0.5 + bend * (1 - np.cos(turn)) + radius * np.cos(angle) * np.cos(turn), x)
    y = np.where(inside, 0.5 + radius * np.sin(angle), y)
    z = np.where(inside, z + bend * np.sin(turn) - radius * np.cos(angle) * np.sin(turn), z)
    a = (i[:-1, :-1] * (cells + 1) + j[:-1, :-1]).ravel()
    b, c, d = a + cells + 1, a + cells + 2, a + 1
    triangles = np.vstack([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
    return np.stack([x, y, z], axis=-1).reshape(-1, 3), triangles
