# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces that intersect, selected and painted."""

import bmesh
import numpy as np

#: The colour attribute; nothing else has this name.
NAME = "self-intersections"
RED, WHITE = (0.9, 0.02, 0.01, 1.0), (0.8, 0.8, 0.8, 1.0)


def select_faces(target, faces):
    """Selects these faces and nothing else. Returns how many of them are hidden and so cannot be selected."""
    if target.mode == "EDIT":
        return _select_edited(target.data, faces)
    mesh = target.data
    hidden = np.empty(len(mesh.polygons), bool)
    mesh.polygons.foreach_get("hide", hidden)
    chosen = np.zeros(len(mesh.polygons), bool)
    chosen[faces] = True
    chosen &= ~hidden
    corners = loops_of_faces(mesh, np.flatnonzero(chosen))
    mesh.polygons.foreach_set("select", chosen)
    for elements, attribute in ((mesh.vertices, "vertex_index"), (mesh.edges, "edge_index")):
        used = np.empty(len(mesh.loops), np.int32)
        mesh.loops.foreach_get(attribute, used)
        flags = np.zeros(len(elements), bool)
        flags[used[corners]] = True
        elements.foreach_set("select", flags)
    mesh.update()
    return int(np.count_nonzero(hidden[faces]))


def _select_edited(mesh, faces):
    edited = bmesh.from_edit_mesh(mesh)
    edited.faces.ensure_lookup_table()
    for sequence in (edited.verts, edited.edges, edited.faces):
        for element in sequence:
            element.select_set(False)
    for face in faces.tolist():
        if not edited.faces[face].hide:
            edited.faces[face].select_set(True)
    edited.select_mode = {"FACE"}
    edited.select_flush_mode()
    bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)
    return sum(edited.faces[face].hide for face in faces.tolist())


def paint(target, faces):
    """Paints these faces red and all others grey, and shows that attribute where colours are shown."""
    mesh = target.data
    if target.mode == "EDIT":
        edited = bmesh.from_edit_mesh(mesh)
        layer = edited.loops.layers.color.get(NAME) or edited.loops.layers.color.new(NAME)
        edited.faces.ensure_lookup_table()
        red = set(faces.tolist())
        for face in edited.faces:
            for loop in face.loops:
                loop[layer] = RED if face.index in red else WHITE
        bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)
    else:
        attribute = mesh.color_attributes.get(NAME) or mesh.color_attributes.new(NAME, "BYTE_COLOR", "CORNER")
        colours = np.tile(np.array(WHITE, np.float32), (len(mesh.loops), 1))
        colours[loops_of_faces(mesh, faces)] = RED
        attribute.data.foreach_set("color", colours.ravel())
    mesh.color_attributes.active_color = mesh.color_attributes[NAME]
    mesh.update()


def clear(target):
    """Removes the paint. Returns whether there was any."""
    attribute = target.data.color_attributes.get(NAME)
    if attribute is None:
        return False
    if target.mode == "EDIT":
        edited = bmesh.from_edit_mesh(target.data)
        edited.loops.layers.color.remove(edited.loops.layers.color[NAME])
        bmesh.update_edit_mesh(target.data, loop_triangles=False, destructive=False)
    else:
        target.data.color_attributes.remove(attribute)
    return True


def loops_of_faces(mesh, faces):
    """The corners of these faces, as Blender numbers them."""
    starts, sizes = (np.empty(len(mesh.polygons), np.int32) for _ in range(2))
    mesh.polygons.foreach_get("loop_start", starts)
    mesh.polygons.foreach_get("loop_total", sizes)
    starts, sizes = starts[faces], sizes[faces]
    before = np.cumsum(sizes) - sizes
    return np.arange(sizes.sum()) + np.repeat(starts - before, sizes)
