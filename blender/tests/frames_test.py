# SPDX-License-Identifier: GPL-3.0-or-later
"""Frames: what is displayed is repaired with coherence, and displayed again frame by frame."""

import tempfile
import unittest
from pathlib import Path

import bpy
import numpy as np

import scenes
from scenes import ball, displayed, faces, positions, select, settings, tubes
from unsnarl_blender import runs
from unsnarl_blender.versions import unsnarl

FIRST, LAST = 10, 13


def moving_tubes():
    """Tubes, one of which shape keys move on through the other."""
    one = tubes()
    rest = positions(one)
    one.shape_key_add(name="Basis")
    key = one.shape_key_add(name="on", from_mix=False)
    moved = rest.copy()
    second = unsnarl.vertices_of_faces(
        rest, faces(one), np.flatnonzero(unsnarl.component_of_faces(rest, faces(one)) == 1)
    )
    moved[second] += np.array([0.02, 0.03, 0.04], np.float32)
    key.data.foreach_set("co", moved.ravel())
    for frame, value in ((FIRST, 0), (LAST, 1)):
        key.value = value
        key.keyframe_insert("value", frame=frame)
    return one


def shown(one):
    """What is displayed in each frame."""
    found = []
    for number in range(FIRST, LAST + 1):
        bpy.context.scene.frame_set(number)
        found.append(displayed(one))
    return np.stack(found)


class Frames(unittest.TestCase):
    def setUp(self):
        scenes.fresh()
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        settings().own_range, settings().cache_folder = True, f"{self.folder}/caches"
        settings().frame_start, settings().frame_end = FIRST, LAST

    def test_a_cache_plays_the_positions_of_the_command_line(self):
        one = moving_tubes()
        before = shown(one)
        keys = scenes.hashes(one)
        scenes.write_ply(f"{self.folder}/body.ply", before[0], faces(one))
        from unsnarl_blender import results

        results.write_cache(Path(self.folder) / "moving.pc2", list(before), FIRST)
        scenes.by_program(
            "fix", "--sequence", f"{self.folder}/body.ply", f"{self.folder}/moving.pc2", "-o", f"{self.folder}/out"
        )
        bpy.context.scene.frame_set(3)
        self.assertEqual(bpy.ops.unsnarl.repair_frames(), {"FINISHED"})
        self.assertEqual(bpy.context.scene.frame_current, 3)
        after = shown(one)
        expected = np.frombuffer(Path(f"{self.folder}/out/moving.pc2").read_bytes()[32:], np.float32)
        self.assertEqual(after.tobytes(), expected.tobytes())
        for frame in after:
            self.assertEqual(len(unsnarl.find_intersections(frame, faces(one))), 0)
        one.modifiers.remove(one.modifiers["unsnarl"])
        self.assertEqual(scenes.hashes(one), keys)
        self.assertEqual(shown(one).tobytes(), before.tobytes())

    def test_a_second_run_begins_at_what_was_there_before_the_first(self):
        one = moving_tubes()
        bpy.ops.unsnarl.repair_frames()
        once = shown(one)
        bpy.ops.unsnarl.repair_frames()
        self.assertEqual([modifier.name for modifier in one.modifiers], ["unsnarl"])
        self.assertEqual(shown(one).tobytes(), once.tobytes())
        self.assertEqual(len(list(Path(self.folder).glob("caches/*.pc2"))), 2, "no file was overwritten")

    def test_shape_keys_show_one_frame_each(self):
        one = moving_tubes()
        before = shown(one)
        expected = unsnarl.repair_sequence(before, faces(one)).V
        settings().frames_result = "SHAPE_KEYS"
        self.assertEqual(bpy.ops.unsnarl.repair_frames(), {"FINISHED"})
        new = bpy.context.active_object
        self.assertEqual(len(new.data.shape_keys.key_blocks), 1 + LAST - FIRST + 1)
        after = shown(new)
        self.assertLess(np.abs(after - expected).max(), 1e-6)
        for frame in after:
            self.assertEqual(len(unsnarl.find_intersections(frame, faces(new))), 0)
        self.assertEqual(shown(one).tobytes(), before.tobytes())

    def test_objects_that_move_are_one_scene(self):
        one, other = ball("one", (0, 0, 0)), ball("other", (0, 0, 0))
        for frame, x in ((FIRST, 1.8), (LAST, 1.7)):
            other.location.x = x
            other.keyframe_insert("location", frame=frame)
        one.unsnarl.role = "HELD"
        select(one, other)
        settings().scope = "SELECTED"
        self.assertEqual(bpy.ops.unsnarl.repair_frames(), {"FINISHED"})
        self.assertEqual(([modifier.type for modifier in other.modifiers], len(one.modifiers)), (["MESH_CACHE"], 0))
        for number in range(FIRST, LAST + 1):
            bpy.context.scene.frame_set(number)
            both = [(scenes.in_world(kept, displayed(kept)), faces(kept)) for kept in (one, other)]
            self.assertEqual(len(unsnarl.find_intersections(both)), 0)

    def test_the_range_of_the_scene_is_taken_unless_another_is_given(self):
        one = moving_tubes()
        settings().own_range, settings().frame_start = False, LAST + 10
        bpy.context.scene.frame_start, bpy.context.scene.frame_end = FIRST + 1, LAST - 1
        self.assertEqual(bpy.ops.unsnarl.repair_frames(), {"FINISHED"})
        self.assertIn(f"{LAST - FIRST - 1} of {LAST - FIRST - 1} frames are clean", scenes.outcome()[0])
        self.assertEqual(one.modifiers["unsnarl"].frame_start, FIRST + 1)

    def test_what_is_held_is_held_in_every_frame(self):
        one = moving_tubes()
        before = shown(one)
        held = unsnarl.component_of_faces(before[0], faces(one)) == 0
        held = unsnarl.vertices_of_faces(before[0], faces(one), np.flatnonzero(held))
        one.vertex_groups.new(name="pin").add(np.flatnonzero(held).tolist(), 1.0, "REPLACE")
        settings().held, settings().held_group = "GROUP", "pin"
        self.assertEqual(bpy.ops.unsnarl.repair_frames(), {"FINISHED"})
        after = shown(one)
        self.assertEqual(after[:, held].tobytes(), before[:, held].tobytes())
        self.assertTrue(all(len(unsnarl.find_intersections(frame, faces(one))) == 0 for frame in after))

    def test_what_cannot_be_is_refused(self):
        one = moving_tubes()
        settings().cache_folder = "//beside"
        with self.assertRaisesRegex(RuntimeError, "was not saved yet"):
            bpy.ops.unsnarl.repair_frames()
        file = Path(self.folder) / "file"
        file.touch()
        settings().cache_folder = f"{file}/caches"
        with self.assertRaisesRegex(RuntimeError, "is not a folder that can be written to"):
            bpy.ops.unsnarl.repair_frames()
        file.unlink()
        settings().cache_folder, settings().frame_end = f"{self.folder}/caches", FIRST - 1
        with self.assertRaisesRegex(RuntimeError, "comes before the first"):
            bpy.ops.unsnarl.repair_frames()
        settings().frame_end = LAST
        scenes.add("empty", np.empty((0, 3)), [])
        with self.assertRaisesRegex(RuntimeError, "no face is displayed in frame 10"):
            bpy.ops.unsnarl.repair_frames()
        select(one)
        decimate = one.modifiers.new("fewer", "DECIMATE")
        for frame, ratio in ((FIRST, 1), (LAST, 0.5)):
            decimate.ratio = ratio
            decimate.keyframe_insert("ratio", frame=frame)
        with self.assertRaisesRegex(RuntimeError, "are others in frame"):
            bpy.ops.unsnarl.repair_frames()
        self.assertEqual(list(Path(self.folder).iterdir()), [])

    def test_a_cancelled_run_leaves_nothing_behind(self):
        one = moving_tubes()
        bpy.context.scene.frame_set(3)
        before = scenes.hashes(one)
        steps = runs.repair_frames(bpy.context)
        self.assertEqual(next(steps), f"Reading frame {FIRST} of {FIRST} to {LAST}")
        next(steps)
        steps.close()
        self.assertEqual(bpy.context.scene.frame_current, 3)
        self.assertEqual(scenes.hashes(one), before)
        self.assertEqual(list(Path(self.folder).iterdir()), [])
