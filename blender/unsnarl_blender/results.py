# SPDX-License-Identifier: GPL-3.0-or-later
"""Where repaired positions go: into the mesh, a shape key, a new object, a point cache; and when they cannot."""

import os
import struct
from pathlib import Path

import bmesh
import bpy
import numpy as np

from . import shape_keys
from .surfaces import Refused, mix_of, positions_of
from .versions import curves_of

#: Name of the shape keys and modifiers that are added.
NAME = "unsnarl"
#: How objects follow a parent that deforms them; a copy of what is displayed must not be deformed twice.
DEFORMING_PARENTS = {"ARMATURE", "LATTICE", "CURVE"}


def check_result(targets, settings):
    """Raises Refused where the result that is asked for cannot go to these objects. Returns what is worth knowing."""
    if settings.as_displayed and settings.result != "NEW_OBJECT":
        raise Refused(
            "With As Displayed, choose the result New Object: what modifiers make cannot go back before them."
        )
    notes = []
    for target in targets:
        name = target.name
        if _has_multires(target) and not settings.as_displayed:
            raise Refused(
                f"'{name}' has a Multiresolution modifier: moving its base mesh would move the sculpted detail. "
                "Choose As Displayed with the result New Object, or apply the modifier."
            )
        if settings.result != "NEW_OBJECT":
            _check_own_mesh(target, settings, notes)
    changed = [target.name for target in targets if any(map(_changes_shape, target.modifiers))]
    if changed and not settings.as_displayed:
        notes.append(f"Modifiers were left out, of {', '.join(changed)}: the meshes before them were repaired.")
    if settings.result != "NEW_OBJECT":
        shared = {target.data for target in targets if sum(other.data == target.data for other in targets) > 1}
        if shared:
            raise Refused(
                f"Several of the objects show one mesh, '{min(mesh.name for mesh in shared)}'. Choose New Object, or "
                "Object > Relations > Make Single User."
            )
    return notes


def _check_own_mesh(target, settings, notes):
    name, mesh = target.name, target.data
    if target.library or mesh.library:
        raise Refused(f"'{name}' is linked from another file and cannot be changed. Choose the result New Object.")
    if settings.result == "IN_PLACE" and mesh.shape_keys:
        raise Refused(
            f"'{name}' has shape keys, which its vertices are the basis of. Choose the result Shape Key or New Object."
        )
    if settings.result == "SHAPE_KEY":
        if target.mode == "EDIT":
            raise Refused(f"'{name}' is in Edit Mode. Leave it to add a shape key.")
        if target.show_only_shape_key and mesh.shape_keys:
            raise Refused(
                f"'{name}' shows one shape key only (the pin). Switch that off, so that a new key can add to the mix."
            )
    if mesh.users > 1:
        notes.append(f"The mesh of '{name}' has {mesh.users} users, which all show the result.")


def _changes_shape(modifier):
    return modifier.show_viewport and modifier.type != "COLLISION"


def _has_multires(target):
    return any(modifier.type == "MULTIRES" for modifier in target.modifiers)


def write_in_place(target, positions):
    if target.mode == "EDIT":
        edited = bmesh.from_edit_mesh(target.data)
        edited.verts.ensure_lookup_table()
        for vertex, place in zip(edited.verts, positions.tolist()):
            vertex.co = place
        edited.normal_update()
        bmesh.update_edit_mesh(target.data, loop_triangles=True, destructive=False)
        return
    target.data.vertices.foreach_set("co", positions.ravel())
    target.data.update()


def basis_of(target):
    """The positions that a new shape key is relative to."""
    key = target.data.shape_keys
    return positions_of(key.reference_key.data if key else target.data.vertices)


def write_shape_key(target, positions, mix):
    """Adds a key that displays these positions. mix: what is displayed without it."""
    basis = basis_of(target)
    if not target.data.shape_keys:
        target.shape_key_add(name="Basis", from_mix=False)
    key = target.shape_key_add(name=NAME, from_mix=False)
    key.relative_key = target.data.shape_keys.reference_key
    key.data.foreach_set("co", shape_keys.stored(positions, basis, mix).ravel())
    key.value = 1
    target.data.update()
    displays = mix_of(target)
    if not np.array_equal(displays, positions):
        off = int(np.count_nonzero(np.any(displays != positions, axis=1)))
        return [
            f"Blender displays {off} vertices of '{target.name}' otherwise than computed. Run Find Self-Intersections."
        ]
    return []


def add_object(target, positions, as_displayed, depsgraph):
    """Adds a copy of an object, in its collections, with its mesh at these positions."""
    if as_displayed:
        mesh = bpy.data.meshes.new_from_object(
            target.evaluated_get(depsgraph), preserve_all_data_layers=True, depsgraph=depsgraph
        )
    else:
        mesh = target.data.copy()
    copy = target.copy()
    copy.data = mesh
    copy.name = mesh.name = f"{target.name} repaired"
    if mesh.shape_keys:
        copy.shape_key_clear()
    if as_displayed:
        copy.modifiers.clear()
        if copy.parent_type in DEFORMING_PARENTS:
            copy.parent_type = "OBJECT"
    mesh.vertices.foreach_set("co", positions.ravel())
    mesh.update()
    homes = [one for one in target.users_collection if not one.library] or [bpy.context.scene.collection]
    for home in homes:
        home.objects.link(copy)
    return copy


def select_alone(objects, view_layer):
    for one in view_layer.objects:
        one.select_set(one in objects)
    view_layer.objects.active = objects[0]


def cache_paths(folder, targets):
    """For each object a new file for its cache. Raises Refused for a folder that nothing can go to."""
    if folder.startswith("//") and not bpy.data.filepath:
        raise Refused(
            "The folder of the point caches is beside the .blend file, which was not saved yet. "
            "Save it, or choose another folder."
        )
    place = Path(bpy.path.abspath(folder))
    existing = next(one for one in (place, *place.parents) if one.exists())
    if not existing.is_dir() or not os.access(existing, os.W_OK):
        raise Refused(f"Point caches cannot be written to {place}: {existing} is not a folder that can be written to.")
    paths = []
    for target in targets:
        stem, number = bpy.path.clean_name(target.name), 1
        while (path := place / f"{stem}_{number}.pc2").exists() or path in paths:
            number += 1
        paths.append(path)
    return paths


def write_cache(path, frames, first_frame):
    """A PC2 file of positions (n, 3) float32, one array a frame."""
    unfinished = path.with_suffix(".part")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with open(unfinished, "wb") as file:
            file.write(struct.pack("<12siiffi", b"POINTCACHE2\0", 1, len(frames[0]), first_frame, 1.0, len(frames)))
            for positions in frames:
                file.write(positions.astype("<f4").tobytes())
        os.replace(unfinished, path)
    except OSError as error:
        if unfinished.is_file():
            unfinished.unlink()
        raise Refused(f"The point cache cannot be written: {error}") from None


def own_cache(target):
    """The modifier that an earlier run has added, or None."""
    found = target.modifiers.get(NAME)
    return found if found is not None and found.type == "MESH_CACHE" else None


def play_cache(target, path, first_frame):
    """Has a modifier at the end of the stack play the cache."""
    modifier = own_cache(target) or target.modifiers.new(NAME, "MESH_CACHE")
    modifier.cache_format = "PC2"
    try:
        modifier.filepath = bpy.path.relpath(str(path)) if bpy.data.filepath else str(path)
    except ValueError:  # on another drive of Windows
        modifier.filepath = str(path)
    modifier.frame_start = first_frame
    modifier.interpolation = "NONE"
    modifier.deform_mode, modifier.play_mode, modifier.time_mode = "OVERWRITE", "SCENE", "FRAME"
    modifier.forward_axis, modifier.up_axis, modifier.flip_axis = "POS_Y", "POS_Z", set()


def add_frames_object(target, frames, first_frame, depsgraph):
    """Adds a copy of an object as it is displayed, with a shape key for each frame."""
    copy = add_object(target, frames[0], True, depsgraph)
    copy.shape_key_add(name="Basis", from_mix=False)
    keys = copy.data.shape_keys
    for number, positions in enumerate(frames, first_frame):
        key = copy.shape_key_add(name=f"frame {number}", from_mix=False)
        key.data.foreach_set("co", shape_keys.stored(positions, frames[0], frames[0]).ravel())
        for at, value in ((number - 1, 0), (number, 1), (number + 1, 0)):
            key.value = value
            key.keyframe_insert("value", frame=at)
    for curve in curves_of(keys):
        for point in curve.keyframe_points:
            point.interpolation = "CONSTANT"
    return copy
