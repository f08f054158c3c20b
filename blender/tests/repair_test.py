# SPDX-License-Identifier: GPL-3.0-or-later
"""Repair of objects: the positions of the command line, everything else as it was, certified as Blender keeps it."""

import math
import tempfile
import unittest
from pathlib import Path

import bmesh
import bpy
import numpy as np

import scenes
from scenes import add, ball, by_program, faces, hashes, in_world, pairs, positions, select, settings, tubes
from unsnarl_blender.versions import unsnarl


class Positions(unittest.TestCase):
    def setUp(self):
        scenes.fresh()
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def fixed_by_program(self, *arguments, objects):
        """Positions that the command line gives for objects in their own coordinates."""
        names = [self.folder / f"{one.name}.ply" for one in objects]
        for name, one in zip(names, objects):
            scenes.write_ply(name, positions(one), faces(one))
        if len(names) == 1:
            by_program("fix", names[0], "-o", self.folder / "out.ply", *arguments)
            return [scenes.read_ply(self.folder / "out.ply", np.float32)]
        by_program("fix", *names, "-o", self.folder / "out", *arguments)
        return [scenes.read_ply(self.folder / "out" / name.name, np.float32) for name in names]

    def test_are_those_of_the_command_line(self):
        one = tubes(rotation_euler=(0.3, 0.2, 0.1), location=(5, 6, 7), scale=(2, 2, 2))
        (expected,) = self.fixed_by_program(objects=[one])
        self.assertEqual(bpy.ops.unsnarl.repair(), {"FINISHED"})
        self.assertEqual(positions(one).tobytes(), expected.tobytes())
        self.assertEqual(pairs(one), 0)

    def test_and_are_judged_so_by_other_code(self):
        one = tubes(resolution=8)
        scenes.write_ply(self.folder / "in.ply", positions(one), faces(one))
        bpy.ops.unsnarl.repair()
        scenes.write_ply(self.folder / "kept.ply", positions(one), faces(one))
        self.assertIn("embedded", scenes.verify(self.folder / "in.ply", self.folder / "kept.ply"))

    def test_with_a_gap_in_units_of_the_scene(self):
        one = tubes(scale=(-2, 2, 2))  # mirrored, and twice as large
        (expected,) = self.fixed_by_program("--min-gap", "0.01", "--absolute", objects=[one])
        settings().gap = 0.02
        bpy.ops.unsnarl.repair()
        self.assertTrue(np.allclose(positions(one), expected, atol=1e-5))
        self.assertEqual(pairs(one), 0)
        result = unsnarl.repair(positions(one), faces(one), min_gap=0.0098, absolute=True)
        self.assertTrue(np.array_equal(result.V, positions(one)), "the gap is there already")

    def test_of_several_objects_are_those_of_a_scene(self):
        one, other = ball("one", (0, 0, 0)), ball("other", (0.9, 0.1, 0.2))
        expected = self.fixed_by_program(objects=[other, one])  # the active one comes first
        select(other, one)
        settings().scope = "SELECTED"
        self.assertGreater(pairs(one, other), 0)
        self.assertEqual(bpy.ops.unsnarl.repair(), {"FINISHED"})
        for kept, wanted in zip((other, one), expected):
            self.assertEqual(positions(kept).tobytes(), wanted.tobytes())
        self.assertEqual(pairs(one, other), 0)
        for kept in (one, other):
            self.assertTrue(
                any(line.startswith(f"A part of '{kept.name}' lost") for line in scenes.outcome()), scenes.outcome()
            )

    def test_of_objects_with_different_matrices_are_those_of_the_scene_in_the_world(self):
        one = ball("one", (0, 0, 0), rotation_euler=(0.4, 0.1, 0.9), scale=(1, 1.3, 0.8))
        other = ball("other", (0, 0, 0), location=(1.1, 0.2, 0.3), scale=(-0.9, 0.9, 0.9))
        select(one, other)
        both = [one, other]
        before = [positions(kept) for kept in both]
        for kept in both:
            scenes.write_ply(self.folder / f"{kept.name}.ply", in_world(kept), faces(kept))
        by_program("fix", *(self.folder / f"{kept.name}.ply" for kept in both), "-o", self.folder / "out")
        settings().scope = "SELECTED"
        self.assertEqual(bpy.ops.unsnarl.repair(), {"FINISHED"})
        self.assertEqual(pairs(*both), 0)
        for kept, own in zip(both, before):
            world = scenes.read_ply(self.folder / "out" / f"{kept.name}.ply", np.float64)
            self.assertLess(np.abs(in_world(kept) - world).max(), 1e-5)
            self.assertEqual(pairs(kept), 0)
            still = np.all(np.abs(world - in_world(kept, own)) < 1e-12, axis=1)
            self.assertGreater(np.count_nonzero(still), 0)
            self.assertTrue(np.array_equal(positions(kept)[still], own[still]), "what did not move keeps its bits")

    def test_of_an_uneven_scale_are_repaired_in_the_world(self):
        one = tubes(scale=(1, 3, 0.5))
        self.assertEqual(bpy.ops.unsnarl.repair(), {"FINISHED"})
        self.assertEqual(pairs(one), 0)

    def test_hold_where_rounding_to_float32_brings_faces_together(self):
        # In each object's own coordinates float32 numbers are a thirtieth apart: the result does not hold in them.
        far = 3e5
        one = ball("one", (far, 0, 0), location=(-far, 0, 0), rotation_euler=(0, 0, 1e-8))
        other = ball("other", (0, far, 0), location=(1.2, -far, 0.1), rotation_euler=(1e-8, 0, 0))
        select(one, other)
        both = [one, other]
        moved = unsnarl.repair([(in_world(kept), faces(kept)) for kept in both]).V
        rounded = [
            (world - in_world(kept, np.zeros((1, 3), np.float32))).astype(np.float32)
            for kept, world in zip(both, moved)
        ]
        seen = [(in_world(kept, own), faces(kept)) for kept, own in zip(both, rounded)]
        self.assertGreater(len(unsnarl.find_intersections(seen)), 0)
        settings().scope = "SELECTED"
        self.assertEqual(bpy.ops.unsnarl.repair(), {"FINISHED"})
        self.assertTrue(scenes.outcome()[0].startswith("Clean"), scenes.outcome())
        self.assertEqual((pairs(one, other), pairs(one), pairs(other)), (0, 0, 0))

    def test_of_quads_hold_for_the_triangles_that_blender_draws(self):
        one = tubes()
        bpy.ops.unsnarl.repair()
        one.data.calc_loop_triangles()
        triangles = [list(triangle.vertices) for triangle in one.data.loop_triangles]
        self.assertEqual(len(unsnarl.find_intersections(positions(one), triangles)), 0)


class EverythingElse(unittest.TestCase):
    def setUp(self):
        scenes.fresh()

    def rich(self):
        """An object with a value in every kind of layer."""
        one = tubes(scale=(1.5, 1.5, 1.5))
        mesh = one.data
        random = np.random.default_rng(1)
        uv = mesh.uv_layers.new(name="map")
        uv.data.foreach_set("uv", random.random(2 * len(mesh.loops), np.float32))
        for name, kind, domain, field, width in (
            ("heat", "FLOAT", "POINT", "value", 1),
            ("flow", "FLOAT_VECTOR", "FACE", "vector", 3),
            ("number", "INT", "EDGE", "value", 1),
            ("paint", "FLOAT_COLOR", "POINT", "color", 4),
            ("mask", "BYTE_COLOR", "CORNER", "color", 4),
            ("flag", "BOOLEAN", "FACE", "value", 1),
        ):
            data = mesh.attributes.new(name, kind, domain).data
            data.foreach_set(
                field,
                random.integers(0, 2, width * len(data)).astype(
                    {"INT": np.int32, "BOOLEAN": bool}.get(kind, np.float32)
                ),
            )
        for number in range(3):
            mesh.materials.append(bpy.data.materials.new(f"material {number}"))
        mesh.polygons.foreach_set("material_index", random.integers(0, 3, len(mesh.polygons)).astype(np.int32))
        mesh.polygons.foreach_set("use_smooth", random.random(len(mesh.polygons)) < 0.5)
        for name in ("crease", "bevel_weight"):
            mesh.edges.foreach_set(name, random.random(len(mesh.edges), np.float32))
        for name in ("use_seam", "use_edge_sharp", "select"):
            mesh.edges.foreach_set(name, random.random(len(mesh.edges)) < 0.3)
        group = one.vertex_groups.new(name="weights")
        for vertex in range(0, len(mesh.vertices), 3):
            group.add([vertex], vertex / len(mesh.vertices), "REPLACE")
        mesh.polygons[5].hide = True
        mesh.use_auto_smooth = True
        normals = random.normal(size=(len(mesh.loops), 3))
        mesh.normals_split_custom_set((normals / np.linalg.norm(normals, axis=1)[:, None]).tolist())
        one["note"] = mesh["note"] = "kept"
        mesh.update()
        return one

    def test_is_unchanged_in_place(self):
        one = self.rich()
        before, start = hashes(one), positions(one)
        normals = scenes.normals_at(one, start)
        self.assertEqual(bpy.ops.unsnarl.repair(), {"FINISHED"})
        self.assertFalse(np.array_equal(positions(one), start))
        self.assertEqual(pairs(one), 0)
        self.assertEqual(hashes(one), before)
        self.assertEqual(scenes.normals_at(one, start).tobytes(), normals.tobytes())

    def test_is_unchanged_in_edit_mode(self):
        one = self.rich()
        start = positions(one)
        bpy.ops.object.mode_set(mode="EDIT")
        one.update_from_editmode()
        before = hashes(one)
        self.assertEqual(bpy.ops.unsnarl.repair(), {"FINISHED"})
        self.assertEqual(one.mode, "EDIT")
        one.update_from_editmode()
        self.assertEqual(hashes(one), before)
        self.assertFalse(np.array_equal(positions(one), start))
        self.assertEqual(pairs(one), 0)

    def test_is_unchanged_in_edit_mode_of_several_objects(self):
        one, other = ball("one", (0, 0, 0)), ball("other", (0, 0, 0), location=(0.9, 0.1, 0.2))
        select(one, other)
        bpy.ops.object.mode_set(mode="EDIT")
        self.assertEqual((one.mode, other.mode), ("EDIT", "EDIT"))
        for edited in (one, other):
            edited.update_from_editmode()
        before = hashes(one), hashes(other)
        settings().scope = "SELECTED"
        self.assertEqual(bpy.ops.unsnarl.repair(), {"FINISHED"})
        for edited in (one, other):
            edited.update_from_editmode()
        self.assertEqual((hashes(one), hashes(other)), before)
        self.assertEqual(pairs(one, other), 0)

    def test_is_copied_to_a_new_object(self):
        one = self.rich()
        start, before = positions(one), hashes(one)
        settings().result = "NEW_OBJECT"
        self.assertEqual(bpy.ops.unsnarl.repair(), {"FINISHED"})
        new = bpy.context.active_object
        self.assertEqual(new.name, "tubes repaired")
        self.assertEqual(positions(one).tobytes(), start.tobytes())
        self.assertEqual(pairs(new), 0)
        without = {"object"}  # the names, and what is selected
        self.assertEqual(
            {k: v for k, v in hashes(new).items() if k not in without},
            {k: v for k, v in before.items() if k not in without},
        )
        self.assertEqual(scenes.normals_at(new, start).tobytes(), scenes.normals_at(one, start).tobytes())
        self.assertEqual(new.matrix_world, one.matrix_world)

    def test_is_copied_to_a_new_object_from_edit_mode(self):
        one = self.rich()
        start = positions(one)
        settings().result = "NEW_OBJECT"
        bpy.ops.object.mode_set(mode="EDIT")
        self.assertEqual(bpy.ops.unsnarl.repair(), {"FINISHED"})
        self.assertEqual(one.mode, "EDIT")
        bpy.ops.object.mode_set(mode="OBJECT")
        self.assertEqual(positions(one).tobytes(), start.tobytes())
        self.assertEqual(pairs(bpy.data.objects["tubes repaired"]), 0)

    def test_of_a_clean_mesh_nothing_changes_at_all(self):
        one = ball("one", (0, 0, 0))
        before, start = hashes(one), positions(one)
        for result in ("IN_PLACE", "SHAPE_KEY", "NEW_OBJECT"):
            settings().result = result
            self.assertEqual(bpy.ops.unsnarl.repair(), {"CANCELLED"})
        self.assertEqual(scenes.outcome(), ["No self-intersections: nothing to repair."])
        self.assertEqual((hashes(one), positions(one).tobytes()), (before, start.tobytes()))
        self.assertEqual(len(bpy.data.objects), 1)


class ShapeKeys(unittest.TestCase):
    def setUp(self):
        scenes.fresh()
        settings().result = "SHAPE_KEY"

    def test_a_key_displays_the_positions_of_the_command_line(self):
        one = tubes()
        expected = unsnarl.repair(positions(one), faces(one)).V
        start = positions(one)
        self.assertEqual(bpy.ops.unsnarl.repair(), {"FINISHED"})
        self.assertEqual(
            [(key.name, key.value) for key in one.data.shape_keys.key_blocks], [("Basis", 0), ("unsnarl", 1)]
        )
        self.assertEqual(positions(one).tobytes(), start.tobytes())
        self.assertLess(np.abs(scenes.displayed(one) - expected).max(), 1e-6)
        self.assertEqual(len(unsnarl.find_intersections(scenes.displayed(one), faces(one))), 0)

    def with_keys(self):
        """A ball whose top shape keys move through its bottom."""
        one = ball("one", (0, 0, 0))
        rest = positions(one)
        one.shape_key_add(name="Basis")
        for name, value in (("through", 0.8), ("more", 0.4), ("off", 0)):
            key = one.shape_key_add(name=name, from_mix=False)
            moved = rest.copy()
            moved[rest[:, 2] > 0.5, 2] -= 1.9  # the top goes down through the bottom
            key.data.foreach_set("co", moved.ravel())
            key.value = value
        bpy.context.view_layer.update()
        return one

    def test_looking_at_the_mix_leaves_nothing_behind(self):
        one = self.with_keys()
        one.active_shape_key_index = 2
        before, start = hashes(one), positions(one)
        settings().select = settings().colour = False
        self.assertEqual(bpy.ops.unsnarl.find(), {"CANCELLED"})
        count = len(unsnarl.find_intersections(scenes.displayed(one), faces(one)))
        self.assertEqual(scenes.findings()[0], f"{count} pairs of faces intersect.")
        self.assertEqual((hashes(one), positions(one).tobytes()), (before, start.tobytes()))

    def test_a_new_object_has_the_repaired_mix_and_no_keys(self):
        one = self.with_keys()
        before, mix = hashes(one), scenes.displayed(one)
        settings().result = "NEW_OBJECT"
        self.assertEqual(bpy.ops.unsnarl.repair(), {"FINISHED"})
        new = bpy.context.active_object
        self.assertIsNone(new.data.shape_keys)
        self.assertEqual(positions(new).tobytes(), unsnarl.repair(mix, faces(one)).V.tobytes())
        one.select_set(True)
        self.assertEqual(hashes(one), before)

    def test_the_mix_of_keys_is_repaired_and_they_stay(self):
        one = self.with_keys()
        before, mix = hashes(one), scenes.displayed(one)
        self.assertGreater(len(unsnarl.find_intersections(mix, faces(one))), 0)
        self.assertEqual(bpy.ops.unsnarl.repair(), {"FINISHED"})
        after = hashes(one)
        self.assertEqual(
            {name: after[name] for name in before if name != "object"},
            {name: value for name, value in before.items() if name != "object"},
        )
        shown = scenes.displayed(one)
        self.assertEqual(len(unsnarl.find_intersections(shown, faces(one))), 0)
        self.assertLess(np.abs(shown - unsnarl.repair(mix, faces(one)).V).max(), 1e-5)
        one.data.shape_keys.key_blocks["unsnarl"].value = 0
        self.assertEqual(scenes.displayed(one).tobytes(), mix.tobytes())


class WhatIsHeld(unittest.TestCase):
    def setUp(self):
        scenes.fresh()

    def stays(self, one, held):
        before = positions(one)
        expected = unsnarl.repair(before, faces(one), fixed=held).V
        self.assertEqual(bpy.ops.unsnarl.repair(), {"FINISHED"})
        self.assertEqual(pairs(one), 0)
        self.assertEqual(positions(one)[held].tobytes(), before[held].tobytes())
        self.assertEqual(positions(one).tobytes(), expected.tobytes())

    def test_by_vertex_group(self):
        one = tubes()
        held = unsnarl.vertices_of_faces(
            positions(one), faces(one), np.flatnonzero(unsnarl.component_of_faces(positions(one), faces(one)) == 0)
        )
        group = one.vertex_groups.new(name="pin")
        group.add(np.flatnonzero(held).tolist(), 1.0, "REPLACE")
        group.add(np.flatnonzero(~held).tolist(), 0.4, "REPLACE")
        settings().held, settings().held_group = "GROUP", "pin"
        self.stays(one, held)

    def test_by_selection_and_its_opposite(self):
        for held_is_selected in (True, False):
            scenes.fresh()
            one = tubes()
            held = unsnarl.vertices_of_faces(
                positions(one), faces(one), np.flatnonzero(unsnarl.component_of_faces(positions(one), faces(one)) == 1)
            )
            one.data.vertices.foreach_set("select", held if held_is_selected else ~held)
            settings().held = "SELECTED" if held_is_selected else "UNSELECTED"
            self.stays(one, held)

    def test_as_whole_objects_and_rigid_ones(self):
        one, other = ball("one", (0, 0, 0)), ball("other", (0.9, 0.1, 0.2))
        before = [positions(one), positions(other)]
        one.unsnarl.role, other.unsnarl.role = "HELD", "RIGID"
        select(one, other)
        settings().scope = "SELECTED"
        self.assertEqual(bpy.ops.unsnarl.repair(), {"FINISHED"})
        self.assertEqual(pairs(one, other), 0)
        self.assertEqual(positions(one).tobytes(), before[0].tobytes())
        self.assertTrue(any("make it Held or Rigid" in line for line in scenes.outcome()), scenes.outcome())
        length = [np.linalg.norm(at[1:] - at[:-1], axis=1) for at in (before[1], positions(other))]
        self.assertLess(np.abs(length[0] - length[1]).max(), 1e-5)

    def test_roles_count_among_several_objects_only(self):
        one = tubes()
        one.unsnarl.role = "HELD"
        self.assertEqual(bpy.ops.unsnarl.repair(), {"FINISHED"})
        self.assertEqual(pairs(one), 0)

    def test_an_unknown_group_is_refused(self):
        tubes()
        settings().held = "GROUP"
        with self.assertRaisesRegex(RuntimeError, "Name the vertex group"):
            bpy.ops.unsnarl.repair()
        settings().held_group = "nowhere"
        with self.assertRaisesRegex(RuntimeError, "No object has a vertex group 'nowhere'"):
            bpy.ops.unsnarl.repair()


class Limits(unittest.TestCase):
    def setUp(self):
        scenes.fresh()

    def deep_and_shallow(self, **transform):
        """One object: two tubes that run through each other, and two balls that overlap a little."""
        other = ball("other", (20, 0, 0))
        third = ball("third", (21.97, 0.05, 0.02))
        one = tubes()
        select(one, other, third)
        bpy.ops.object.join()
        for key, value in transform.items():
            setattr(one, key, value)
        select(one)
        return one

    def test_what_is_incomplete_is_written_only_if_asked_for(self):
        one = self.deep_and_shallow()
        start, before = positions(one), pairs(one)
        settings().max_displacement = 0.1
        self.assertEqual(bpy.ops.unsnarl.repair(), {"CANCELLED"})
        self.assertEqual(positions(one).tobytes(), start.tobytes())
        self.assertIn("A vertex has to move farther than allowed", scenes.outcome()[0])
        self.assertIn("Nothing was written", scenes.outcome()[1])
        settings().keep_incomplete = True
        self.assertEqual(bpy.ops.unsnarl.repair(), {"FINISHED"})
        self.assertLess(pairs(one), before)

    def test_no_vertex_moves_farther_in_units_of_the_scene(self):
        one = self.deep_and_shallow(scale=(10, 10, 10))
        start = positions(one)
        settings().max_displacement, settings().keep_incomplete = 1, True
        self.assertEqual(bpy.ops.unsnarl.repair(), {"FINISHED"})
        farthest = np.linalg.norm(positions(one) - start, axis=1).max()
        self.assertLessEqual(farthest, 0.1 * (1 + 1e-5))
        self.assertGreater(farthest, 0.01)

    def test_a_gap_wider_than_faces_allow_is_said(self):
        one = tubes(scale=(2, 2, 2))
        start = positions(one)
        settings().gap = 100
        with self.assertRaisesRegex(
            RuntimeError, r"A gap of 100 is \d+ times as wide as the faces; 3.18 is the most here"
        ):
            bpy.ops.unsnarl.repair()
        self.assertEqual(positions(one).tobytes(), start.tobytes())

    def test_duplicate_faces_are_named(self):
        add("twice", [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0.5, 0.5, 1)], [(0, 1, 2), (0, 2, 1), (0, 1, 3)])
        self.assertEqual(bpy.ops.unsnarl.repair(), {"CANCELLED"})
        self.assertIn(
            "Faces 0, 1 lie on the same three vertices: moving vertices cannot separate them.", scenes.outcome()
        )


class Meshes(unittest.TestCase):
    """What artists have: loose parts, polygons, hidden faces, several users, modifiers."""

    def setUp(self):
        scenes.fresh()

    def test_loose_edges_and_vertices_stay(self):
        V, F = unsnarl.sample("crossing_tubes", resolution=12)
        mesh = bpy.data.meshes.new("loose")
        V = np.concatenate([V, [[5, 5, 5], [6, 6, 6], [7, 7, 7]]])
        mesh.from_pydata(V.tolist(), [(len(V) - 3, len(V) - 2)], F.tolist())
        one = bpy.data.objects.new("loose", mesh)
        bpy.context.scene.collection.objects.link(one)
        select(one)
        before = positions(one)
        self.assertEqual(bpy.ops.unsnarl.repair(), {"FINISHED"})
        self.assertEqual(pairs(one), 0)
        self.assertEqual(positions(one)[-3:].tobytes(), before[-3:].tobytes())

    def test_meshes_without_faces_are_fine(self):
        for V, edges in (([], []), ([(0, 0, 0), (1, 0, 0)], [(0, 1)])):
            mesh = bpy.data.meshes.new("empty")
            mesh.from_pydata(V, edges, [])
            one = bpy.data.objects.new("empty", mesh)
            bpy.context.scene.collection.objects.link(one)
            select(one)
            bpy.ops.unsnarl.find()
            self.assertEqual(bpy.ops.unsnarl.repair(), {"CANCELLED"})
            self.assertEqual(scenes.outcome(), ["No self-intersections: nothing to repair."])
        other = tubes()
        select(other, one)
        settings().scope = "SELECTED"
        self.assertEqual(bpy.ops.unsnarl.repair(), {"FINISHED"})
        self.assertEqual(pairs(other), 0)

    def test_polygons_hold_as_they_are_cut_or_it_is_said(self):
        one, other = ball("one", (0, 0, 0), rings=8), ball("other", (0.8, 0.1, 0.2), rings=8)
        select(one, other)
        bpy.ops.object.join()
        edited = bmesh.new()
        edited.from_mesh(one.data)
        poles = [vertex for vertex in edited.verts if len(vertex.link_faces) > 4]
        bmesh.ops.dissolve_verts(edited, verts=poles)  # the caps become polygons of 16 corners
        edited.to_mesh(one.data)
        edited.free()
        self.assertEqual(max(len(polygon.vertices) for polygon in one.data.polygons), 16)
        self.assertEqual(bpy.ops.unsnarl.repair(), {"FINISHED"})
        self.assertEqual(pairs(one), 0)
        one.data.calc_loop_triangles()
        triangles = [list(triangle.vertices) for triangle in one.data.loop_triangles]
        drawn = len(unsnarl.find_intersections(positions(one), triangles))
        self.assertEqual(drawn > 0, any("Blender cuts polygons" in line for line in scenes.outcome()))

    def test_hidden_faces_count(self):
        one = tubes()
        one.data.polygons.foreach_set("hide", np.ones(len(one.data.polygons), bool))
        self.assertEqual(bpy.ops.unsnarl.repair(), {"FINISHED"})
        self.assertEqual(pairs(one), 0)
        self.assertTrue(all(polygon.hide for polygon in one.data.polygons))

    def test_modifiers_are_left_out_or_taken_as_displayed(self):
        one = tubes(resolution=10)
        one.modifiers.new("bend", "SIMPLE_DEFORM").angle = math.radians(20)
        one.modifiers.new("fine", "SUBSURF").levels = 1
        with_modifiers = scenes.displayed(one)
        start = positions(one)
        settings().as_displayed, settings().result = True, "NEW_OBJECT"
        self.assertEqual(bpy.ops.unsnarl.repair(), {"FINISHED"})
        new = bpy.context.active_object
        self.assertEqual((len(new.modifiers), len(new.data.vertices)), (0, len(with_modifiers)))
        self.assertEqual(pairs(new), 0)
        self.assertEqual(positions(new).tobytes(), unsnarl.repair(with_modifiers, faces(new)).V.tobytes())
        self.assertEqual(positions(one).tobytes(), start.tobytes())
        select(one)
        settings().as_displayed, settings().result = False, "IN_PLACE"
        self.assertEqual(bpy.ops.unsnarl.repair(), {"FINISHED"})
        self.assertEqual(pairs(one), 0)
        self.assertTrue(any("Modifiers were left out, of tubes" in line for line in scenes.outcome()))

    def test_of_an_armature_the_pose_is_taken_once(self):
        rig = bpy.data.objects.new("rig", bpy.data.armatures.new("rig"))
        bpy.context.scene.collection.objects.link(rig)
        select(rig)
        bpy.ops.object.mode_set(mode="EDIT")
        bone = rig.data.edit_bones.new("bone")
        bone.tail = (0, 0, 1)
        bpy.ops.object.mode_set(mode="OBJECT")
        one = tubes()
        one.vertex_groups.new(name="bone").add(list(range(len(one.data.vertices))), 1.0, "REPLACE")
        one.parent, one.parent_type = rig, "ARMATURE"
        rig.pose.bones["bone"].rotation_quaternion = (0.9, 0.1, 0.3, 0.2)
        bpy.context.view_layer.update()
        posed = scenes.displayed(one)
        self.assertGreater(np.abs(posed - positions(one)).max(), 0.1)
        settings().as_displayed, settings().result = True, "NEW_OBJECT"
        bpy.ops.unsnarl.repair()
        new = bpy.context.active_object
        bpy.context.view_layer.update()
        self.assertEqual(scenes.displayed(new).tobytes(), unsnarl.repair(posed, faces(one)).V.tobytes())
        self.assertTrue(np.array_equal(np.array(new.matrix_world), np.array(one.matrix_world)))

    def test_all_users_of_one_mesh_show_the_result(self):
        one = tubes()
        other = one.copy()
        bpy.context.scene.collection.objects.link(other)
        bpy.ops.unsnarl.repair()
        self.assertTrue(any("has 2 users" in line for line in scenes.outcome()))
        self.assertEqual(other.data, one.data)
        select(one, other)
        settings().scope = "SELECTED"
        with self.assertRaisesRegex(RuntimeError, "Several of the objects show one mesh"):
            bpy.ops.unsnarl.repair()
        other.location.x = 0.2
        bpy.context.view_layer.update()
        settings().result = "NEW_OBJECT"
        self.assertEqual(bpy.ops.unsnarl.repair(), {"FINISHED"})
        new = [kept for kept in bpy.context.selected_objects]
        self.assertEqual(len(new), 2)
        self.assertEqual(pairs(*new), 0)

    def test_contact_offsets_are_hinted_at(self):
        from unsnarl_blender import panel

        one, other = ball("one", (0, 0, 0)), ball("other", (3, 0, 0))
        one.modifiers.new("cloth", "CLOTH").collision_settings.distance_min = 0.004
        other.modifiers.new("collision", "COLLISION")
        other.collision.thickness_outer = 0.03
        select(one, other)
        self.assertEqual(panel.gap_hints(bpy.context), ["Cloth of one keeps 4 mm to others"])
        settings().scope = "SELECTED"
        self.assertEqual(
            panel.gap_hints(bpy.context), ["Cloth of one keeps 4 mm to others", "Collision of other adds 3 cm"]
        )

    def test_the_unit_of_the_scene_is_said(self):
        tubes()
        bpy.context.scene.unit_settings.system = "NONE"
        bpy.ops.unsnarl.repair()
        self.assertRegex(scenes.outcome()[0], r"by 0\.\d+ at most")


class Refusals(unittest.TestCase):
    def setUp(self):
        scenes.fresh()

    def refused(self, words, one=None):
        before = (hashes(one), positions(one).tobytes()) if one else None
        with self.assertRaisesRegex(RuntimeError, words):
            bpy.ops.unsnarl.repair()
        if one:
            self.assertEqual((hashes(one), positions(one).tobytes()), before)

    def test_shape_keys_in_place(self):
        one = tubes()
        one.shape_key_add(name="Basis")
        self.refused("has shape keys, which its vertices are the basis of", one)

    def test_multires(self):
        one = tubes(resolution=8)
        one.modifiers.new("sculpt", "MULTIRES")
        bpy.ops.object.multires_subdivide(modifier="sculpt")
        self.refused("Multiresolution", one)
        settings().as_displayed, settings().result = True, "NEW_OBJECT"
        self.assertEqual(bpy.ops.unsnarl.repair(), {"FINISHED"})
        self.assertEqual(pairs(bpy.context.active_object), 0)

    def test_what_is_displayed_cannot_go_in_place(self):
        one = tubes()
        settings().as_displayed = True
        self.refused("choose the result New Object", one)

    def test_a_scale_of_zero(self):
        one = tubes(scale=(1, 1, 0))
        self.refused("scale of zero", one)

    def test_a_coordinate_that_is_no_number(self):
        one = tubes()
        one.data.vertices[7].co.x = float("nan")
        self.refused("Vertex 7 of 'tubes'", None)

    def test_what_is_no_mesh(self):
        curve = bpy.data.objects.new("curve", bpy.data.curves.new("curve", "CURVE"))
        bpy.context.scene.collection.objects.link(curve)
        select(curve)
        self.refused("'curve' is not a mesh")

    def test_other_modes(self):
        tubes()
        bpy.ops.object.mode_set(mode="SCULPT")
        self.refused("Switch to Object or Edit Mode")

    def test_what_is_linked(self):
        with tempfile.TemporaryDirectory() as folder:
            library = f"{folder}/library.blend"
            tubes("linked")
            bpy.ops.wm.save_as_mainfile(filepath=library)
            scenes.fresh()
            with bpy.data.libraries.load(library, link=True) as (source, target):
                target.objects = ["linked"]
            one = bpy.data.objects["linked"]
            bpy.context.scene.collection.objects.link(one)
            select(one)
            self.assertEqual(bpy.ops.unsnarl.find(), {"CANCELLED"})
            self.assertTrue(any("linked from another file" in line for line in scenes.findings()))
            self.refused("is linked from another file", one)
            settings().result = "NEW_OBJECT"
            self.assertEqual(bpy.ops.unsnarl.repair(), {"FINISHED"})
            new = bpy.context.active_object
            self.assertIsNone(new.data.library)
            self.assertEqual(pairs(new), 0)
