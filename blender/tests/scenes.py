# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects for the tests, and what is compared of them."""

import hashlib
import struct
import subprocess
import sys
import os
from pathlib import Path

import bpy
import numpy as np

from unsnarl_blender.versions import unsnarl

PROGRAM = os.environ["UNSNARL_PROGRAM"]
VERIFY = Path(__file__).resolve().parents[2] / "tools" / "verify.py"


def fresh():
    """An empty scene with the default settings."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.preferences.addon_enable(module="unsnarl_blender")


def add(name, V, F, **transform):
    """A mesh object, selected and active."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(np.asarray(V, float).tolist(), [], [list(map(int, face)) for face in F])
    mesh.update()
    one = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(one)
    for key, value in transform.items():
        setattr(one, key, value)
    select(one)
    return one


def select(*objects):
    bpy.context.view_layer.update()
    for one in bpy.context.view_layer.objects:
        one.select_set(one in objects)
    bpy.context.view_layer.objects.active = objects[0]
    bpy.context.view_layer.update()


def tubes(name="tubes", resolution=16, **transform):
    return add(name, *unsnarl.sample("crossing_tubes", resolution=resolution), **transform)


def ball(name, centre, radius=1.0, rings=12, **transform):
    """A sphere of quads with a triangle fan at each pole."""
    u = np.pi * np.arange(1, rings) / rings
    v = 2 * np.pi * np.arange(2 * rings) / (2 * rings)
    grid = np.stack(
        np.broadcast_arrays(np.sin(u)[:, None] * np.cos(v), np.sin(u)[:, None] * np.sin(v), np.cos(u)[:, None]), -1
    )
    V = np.concatenate([grid.reshape(-1, 3), [[0, 0, 1], [0, 0, -1]]]) * radius + centre
    n, top, bottom = len(v), (rings - 1) * len(v), (rings - 1) * len(v) + 1
    quads = [
        [i * n + j, (i + 1) * n + j, (i + 1) * n + (j + 1) % n, i * n + (j + 1) % n]
        for i in range(rings - 2)
        for j in range(n)
    ]
    caps = [[top, j, (j + 1) % n] for j in range(n)]
    caps += [[bottom, (rings - 2) * n + (j + 1) % n, (rings - 2) * n + j] for j in range(n)]
    return add(name, V, quads + caps, **transform)


def positions(one):
    flat = np.empty(3 * len(one.data.vertices), np.float32)
    one.data.vertices.foreach_get("co", flat)
    return flat.reshape(-1, 3)


def displayed(one):
    evaluated = one.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    flat = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", flat)
    evaluated.to_mesh_clear()
    return flat.reshape(-1, 3)


def faces(one):
    """(corners, offsets)"""
    polygons = [list(polygon.vertices) for polygon in one.data.polygons]
    return np.concatenate([np.array(p) for p in polygons]), np.cumsum([0] + [len(p) for p in polygons])


def in_world(one, own=None):
    """Positions in the world, float64, written otherwise than the add-on does."""
    own = positions(one) if own is None else own
    matrix = np.array(one.matrix_world, dtype=np.float64)
    return own.astype(np.float64) @ matrix[:3, :3].T + matrix[:3, 3]


def pairs(*objects):
    """Intersecting pairs of faces, of float32 positions in an object's own coordinates, or of several in the world."""
    if len(objects) == 1:
        return len(unsnarl.find_intersections(positions(objects[0]), faces(objects[0])))
    return len(unsnarl.find_intersections([(in_world(one), faces(one)) for one in objects]))


def write_ply(path, V, polygons):
    """A binary PLY file that holds these very numbers, float32 or float64."""
    corners, offsets = polygons
    number = "float" if V.dtype == np.float32 else "double"
    header = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(V)}\n"
        + "".join(f"property {number} {axis}\n" for axis in "xyz")
        + f"element face {len(offsets) - 1}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    with open(path, "wb") as file:
        file.write(header.encode() + V.tobytes())
        for begin, end in zip(offsets, offsets[1:]):
            file.write(struct.pack(f"<B{end - begin}i", end - begin, *map(int, corners[begin:end])))


def read_ply(path, dtype):
    content = Path(path).read_bytes()
    header, body = content.split(b"end_header\n", 1)
    count = int(header.split(b"element vertex ")[1].split()[0])
    return np.frombuffer(body, dtype, 3 * count).reshape(-1, 3)


def by_program(*arguments):
    """Runs the program; fails with what it said."""
    ran = subprocess.run([PROGRAM, *map(str, arguments), "--quiet"], capture_output=True, text=True)
    if ran.returncode != 0:
        raise AssertionError(f"unsnarl {arguments} ended with {ran.returncode}: {ran.stdout}{ran.stderr}")


def verify(before, after):
    """Has tools/verify.py, which shares no code with the product, judge two files. Returns what it says, or fails."""
    ran = subprocess.run([sys.executable, str(VERIFY), str(before), str(after)], capture_output=True, text=True)
    if ran.returncode != 0:
        raise AssertionError(ran.stdout + ran.stderr)
    return ran.stdout


def settings():
    return bpy.context.scene.unsnarl


def outcome():
    """What the panel says of the last repair."""
    return [line.name for line in bpy.context.window_manager.unsnarl.outcome]


def findings():
    return [line.name for line in bpy.context.window_manager.unsnarl.findings]


def hashes(one):
    """A hash of everything that an object and its mesh hold but the positions of vertices, by its name."""
    mesh = one.data
    found = {}

    def put(name, *values):
        digest = hashlib.sha256()
        for value in values:
            digest.update(value.tobytes() if isinstance(value, np.ndarray) else repr(value).encode())
        found[name] = digest.hexdigest()

    def column(collection, attribute, width, dtype):
        values = np.empty(width * len(collection), dtype)
        collection.foreach_get(attribute, values)
        return values

    fields = {
        "FLOAT": ("value", 1, np.float32),
        "INT": ("value", 1, np.int32),
        "BOOLEAN": ("value", 1, bool),
        "FLOAT_VECTOR": ("vector", 3, np.float32),
        "FLOAT2": ("vector", 2, np.float32),
        "INT8": ("value", 1, np.int32),
        "FLOAT_COLOR": ("color", 4, np.float32),
        "BYTE_COLOR": ("color", 4, np.float32),
    }
    for attribute in mesh.attributes:
        if attribute.name != "position":
            data = column(attribute.data, *fields[attribute.data_type])
            put(f"attribute {attribute.name}", attribute.domain, attribute.data_type, data)
    for layer in mesh.uv_layers:
        put(f"uv {layer.name}", column(layer.data, "uv", 2, np.float32), layer.active_render)
    put(
        "vertices",
        *(
            column(mesh.vertices, name, 1, dtype)
            for name, dtype in (("select", bool), ("hide", bool), ("bevel_weight", np.float32))
        ),
    )
    put(
        "edges",
        column(mesh.edges, "vertices", 2, np.int32),
        *(
            column(mesh.edges, name, 1, dtype)
            for name, dtype in (
                ("select", bool),
                ("hide", bool),
                ("use_seam", bool),
                ("use_edge_sharp", bool),
                ("use_freestyle_mark", bool),
                ("crease", np.float32),
                ("bevel_weight", np.float32),
            )
        ),
    )
    put(
        "faces",
        *(
            column(mesh.polygons, name, 1, dtype)
            for name, dtype in (
                ("loop_start", np.int32),
                ("loop_total", np.int32),
                ("material_index", np.int32),
                ("use_smooth", bool),
                ("select", bool),
                ("hide", bool),
            )
        ),
    )
    put("corners", column(mesh.loops, "vertex_index", 1, np.int32), column(mesh.loops, "edge_index", 1, np.int32))
    put("materials", [material.name for material in mesh.materials])
    put(
        "groups",
        [group.name for group in one.vertex_groups],
        [[(g.group, g.weight) for g in vertex.groups] for vertex in mesh.vertices],
    )
    put("custom normals", mesh.has_custom_normals, mesh.use_auto_smooth, mesh.auto_smooth_angle)
    for key in mesh.shape_keys.key_blocks if mesh.shape_keys else []:
        put(
            f"shape key {key.name}",
            column(key.data, "co", 3, np.float32),
            key.value,
            key.mute,
            key.vertex_group,
            key.relative_key.name,
            key.slider_min,
            key.slider_max,
        )
    put("modifiers", [(modifier.name, modifier.type, modifier.show_viewport) for modifier in one.modifiers])
    put(
        "object",
        one.name,
        mesh.name,
        [list(row) for row in one.matrix_basis],
        one.mode,
        one.active_shape_key_index,
        [key for key in one.keys() if key != "unsnarl"],
        list(mesh.keys()),
        one.select_get(),
    )
    return found


def normals_at(one, V):
    """The split normals of the mesh if its vertices were at V: of equal layers of custom normals they are equal."""
    copy = one.data.copy()
    copy.vertices.foreach_set("co", np.ascontiguousarray(V).ravel())
    copy.update()
    copy.calc_normals_split()
    normals = np.empty(3 * len(copy.loops), np.float32)
    copy.loops.foreach_get("normal", normals)
    bpy.data.meshes.remove(copy)
    return normals
