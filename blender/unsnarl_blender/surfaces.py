# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects of Blender as the library takes them: positions, faces and where the object is; or why not."""

from typing import NamedTuple

import numpy as np

#: A vertex of a group is held from this weight on.
HELD_WEIGHT = 0.5


class Refused(Exception):
    """Why something is not done, and what to do about it. Nothing was changed."""


class Surface(NamedTuple):
    name: str  # of the object, with its library if it is linked
    positions: np.ndarray  # (n, 3) float32, in the object's own coordinates
    corners: np.ndarray  # vertex ids, face after face
    offsets: np.ndarray  # face f has the corners offsets[f] to offsets[f + 1]
    to_world: np.ndarray  # (4, 4) float64
    held: np.ndarray  # (n,) bool

    @property
    def faces(self):
        """As the library takes them: triangles as an array, so that they are the faces of any file of triangles."""
        if np.all(np.diff(self.offsets) == 3):
            return self.corners.reshape(-1, 3)
        return self.corners, self.offsets

    def is_same(self, other):
        """Is this still the surface that the other one was, bit for bit?"""
        mine, others = (self.positions, self.corners, self.to_world), (other.positions, other.corners, other.to_world)
        return all(np.array_equal(a, b) for a, b in zip(mine, others))


def object_of(name, scene):
    """The object of this full name in the scene."""
    for found in scene.objects:
        if found.name_full == name:
            return found
    raise Refused(f"'{name}' is no longer in the scene. Nothing was written.")


def targets(context, scope):
    """The mesh objects that are meant, the active one first if it is among them. Raises Refused if there is none."""
    active = context.active_object
    if scope == "ACTIVE":
        if active is None:
            raise Refused("There is no active object. Click on one.")
        chosen = [active]
    else:
        chosen = sorted(context.selected_objects, key=lambda one: (one is not active, one.name_full))
        if active is not None and active.mode == "EDIT" and active not in chosen:
            chosen.insert(0, active)
    meshes = [one for one in chosen if one.type == "MESH"]
    if not meshes:
        what = f"'{chosen[0].name}' is not a mesh. Convert it with Object > Convert > Mesh." if chosen else ""
        raise Refused(what or "No object is selected.")
    for one in meshes:
        if one.mode not in {"OBJECT", "EDIT"}:
            raise Refused(f"'{one.name}' is in another mode. Switch to Object or Edit Mode.")
    return meshes


def base_surface(target, settings=None):
    """The mesh of an object before its modifiers; with shape keys: the shape that they mix to."""
    if target.mode == "EDIT":
        if target.data.shape_keys:
            raise Refused(f"'{target.name}' has shape keys. Leave Edit Mode, so that their mix is what is repaired.")
        target.update_from_editmode()
    positions = positions_of(target.data.vertices) if not target.data.shape_keys else mix_of(target)
    return _surface(target, target.data, positions, target.matrix_world, settings)


def displayed_surface(target, depsgraph, settings=None):
    """The mesh of an object as it is displayed: with shape keys, modifiers, and the armature's pose."""
    if target.mode == "EDIT":
        target.update_from_editmode()
    evaluated = target.evaluated_get(depsgraph)
    mesh = evaluated.to_mesh(preserve_all_data_layers=True, depsgraph=depsgraph)
    try:
        return _surface(target, mesh, positions_of(mesh.vertices), evaluated.matrix_world, settings)
    finally:
        evaluated.to_mesh_clear()


def _surface(target, mesh, positions, matrix, settings):
    to_world = np.array(matrix, dtype=np.float64)
    scale = np.linalg.svd(to_world[:3, :3], compute_uv=False)
    if not np.all(np.isfinite(to_world)) or scale[-1] <= 1e-9 * scale[0]:
        raise Refused(f"'{target.name}' has a scale of zero along some axis. Give it a thickness, or apply the scale.")
    bad = np.flatnonzero(~np.all(np.isfinite(positions), axis=1))
    if bad.size > 0:
        raise Refused(f"Vertex {bad[0]} of '{target.name}' has a coordinate that is not a number. Delete or move it.")
    held = np.zeros(len(positions), bool) if settings is None else held_vertices(target, mesh, settings)
    return Surface(target.name_full, positions, *faces_of(mesh), to_world, held)


def positions_of(points):
    """(n, 3) float32: the bits that Blender keeps, of vertices or of a shape key."""
    flat = np.empty(3 * len(points), np.float32)
    points.foreach_get("co", flat)
    return flat.reshape(-1, 3)


def faces_of(mesh):
    """(corners, offsets)"""
    corners = np.empty(len(mesh.loops), np.int32)
    mesh.loops.foreach_get("vertex_index", corners)
    starts, sizes = (np.empty(len(mesh.polygons), np.int32) for _ in range(2))
    mesh.polygons.foreach_get("loop_start", starts)
    mesh.polygons.foreach_get("loop_total", sizes)
    offsets = np.append(0, np.cumsum(sizes)).astype(np.int32)
    # Before Blender 3.6 faces may use their corners in another order than they lie in.
    order = np.arange(offsets[-1], dtype=np.int64) + np.repeat(starts - offsets[:-1], sizes)
    return corners[order], offsets


def held_vertices(target, mesh, settings):
    """Which vertices must not move, (n,) bool."""
    count = len(mesh.vertices)
    if settings.role_of(target) == "HELD":
        return np.ones(count, bool)
    if settings.held in {"SELECTED", "UNSELECTED"}:
        selected = np.empty(count, bool)
        mesh.vertices.foreach_get("select", selected)
        return selected if settings.held == "SELECTED" else ~selected
    held = np.zeros(count, bool)
    if settings.held == "GROUP":
        group = target.vertex_groups.get(settings.held_group)
        if group is not None:
            for vertex in mesh.vertices:
                held[vertex.index] = any(g.group == group.index and g.weight >= HELD_WEIGHT for g in vertex.groups)
    return held


def mix_of(target):
    """The shape to which the shape keys of an object mix before its modifiers, as Blender itself computes it."""
    key = target.data.shape_keys
    if target.data.library or not key.use_relative:
        raise Refused(
            f"'{target.name}' has shape keys that {'are linked' if target.data.library else 'are absolute'}. "
            "Choose As Displayed with the result New Object."
        )
    active, pinned = target.active_shape_key_index, target.show_only_shape_key
    mix = target.shape_key_add(name="unsnarl mix", from_mix=True)
    try:
        return positions_of(mix.data)
    finally:
        target.shape_key_remove(mix)
        target.active_shape_key_index, target.show_only_shape_key = active, pinned
