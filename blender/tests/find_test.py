# SPDX-License-Identifier: GPL-3.0-or-later
"""Find: the faces of the library are selected and painted, and pairs are counted by objects."""

import unittest

import bmesh
import bpy
import numpy as np

import scenes
from scenes import ball, faces, hashes, positions, select, settings, tubes
from unsnarl_blender.versions import unsnarl


def selected_faces(one):
    flags = np.empty(len(one.data.polygons), bool)
    one.data.polygons.foreach_get("select", flags)
    return np.flatnonzero(flags)


class Find(unittest.TestCase):
    def setUp(self):
        scenes.fresh()

    def test_faces_are_selected_and_painted(self):
        one = tubes()
        found = unsnarl.find_intersections(positions(one), faces(one))
        self.assertEqual(bpy.ops.unsnarl.find(), {"FINISHED"})
        self.assertEqual(selected_faces(one).tolist(), found.faces.tolist())
        self.assertEqual(scenes.findings(), [f"{len(found)} pairs of faces intersect.", f"tubes: {len(found)} pairs"])
        colours = one.data.color_attributes["self-intersections"]
        red = {
            polygon.index
            for polygon in one.data.polygons
            if all(colours.data[loop].color[1] < 0.1 for loop in polygon.loop_indices)
        }
        self.assertEqual(red, set(found.faces.tolist()))
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.object.mode_set(mode="OBJECT")
        self.assertEqual(selected_faces(one).tolist(), found.faces.tolist(), "Edit Mode shows the same faces")

    def test_in_edit_mode_too(self):
        one = tubes()
        found = unsnarl.find_intersections(positions(one), faces(one))
        bpy.ops.object.mode_set(mode="EDIT")
        self.assertEqual(bpy.ops.unsnarl.find(), {"FINISHED"})
        self.assertEqual(one.mode, "EDIT")
        edited = bmesh.from_edit_mesh(one.data)
        self.assertEqual([face.index for face in edited.faces if face.select], found.faces.tolist())
        bpy.ops.object.mode_set(mode="OBJECT")
        self.assertIn("self-intersections", one.data.color_attributes)
        self.assertEqual(selected_faces(one).tolist(), found.faces.tolist())

    def test_pairs_are_counted_by_objects(self):
        one, other = ball("one", (0, 0, 0)), ball("other", (0, 0, 0), location=(0.9, 0.1, 0.2))
        third = tubes("third", location=(20, 0, 0))
        select(one, other, third)
        settings().scope = "SELECTED"
        bpy.ops.unsnarl.find()
        between = scenes.pairs(one, other)
        alone = scenes.pairs(third)
        self.assertEqual(
            scenes.findings(),
            [f"{between + alone} pairs of faces intersect.", f"one – other: {between} pairs", f"third: {alone} pairs"],
        )

    def test_hidden_faces_are_counted_and_not_selected(self):
        one = tubes()
        for polygon in one.data.polygons:
            polygon.hide = True
        bpy.ops.unsnarl.find()
        self.assertEqual(len(selected_faces(one)), 0)
        self.assertTrue(any("are hidden" in line for line in scenes.findings()), scenes.findings())

    def test_clear_takes_the_paint_away_and_nothing_else(self):
        one = tubes()
        one.data.color_attributes.new("mine", "FLOAT_COLOR", "POINT")
        settings().select = False
        before = hashes(one)
        bpy.ops.unsnarl.find()
        self.assertNotEqual(hashes(one), before)
        self.assertEqual(bpy.ops.unsnarl.clear(), {"FINISHED"})
        self.assertEqual(hashes(one), before)
        self.assertEqual(bpy.ops.unsnarl.clear(), {"CANCELLED"})

    def test_what_modifiers_remake_is_counted_and_not_marked(self):
        one = tubes()
        one.modifiers.new("fine", "SUBSURF").levels = 1
        settings().as_displayed = True
        before = hashes(one)
        bpy.ops.unsnarl.find()
        shown = scenes.displayed(one)
        self.assertGreater(len(shown), len(one.data.vertices))
        self.assertTrue(any("modifiers change which faces" in line for line in scenes.findings()))
        self.assertEqual(hashes(one), before)
