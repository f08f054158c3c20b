# SPDX-License-Identifier: GPL-3.0-or-later
"""What modal operators do between events, driven without them."""

import threading
import time
import unittest

import bpy

import scenes
from scenes import hashes, positions, tubes
from unsnarl_blender import runs
from unsnarl_blender.surfaces import Refused
from unsnarl_blender.versions import unsnarl


def wait_for_threads():
    for thread in threading.enumerate():
        if thread.name.startswith("unsnarl"):
            thread.join(60)


class Steps(unittest.TestCase):
    def setUp(self):
        scenes.fresh()

    def test_lines_tell_how_many_pairs_are_left(self):
        tubes(resolution=40)
        steps, lines = runs.repair_objects(bpy.context), []
        with self.assertRaises(StopIteration) as end:
            while True:
                lines.append(next(steps))
                time.sleep(0.01)
        self.assertTrue(any("pairs left" in line for line in lines), lines)
        self.assertTrue(end.exception.value.written)

    def test_closing_at_any_moment_leaves_nothing_behind(self):
        one = tubes(resolution=30)
        before = hashes(one), positions(one).tobytes(), len(bpy.data.meshes)
        for count in (0, 1, 3, 10):
            steps = runs.repair_objects(bpy.context)
            for _ in range(count):
                next(steps)
                time.sleep(0.01)
            steps.close()
            self.assertEqual((hashes(one), positions(one).tobytes(), len(bpy.data.meshes)), before)
        wait_for_threads()
        self.assertFalse([thread for thread in threading.enumerate() if thread.name.startswith("unsnarl")])
        self.assertEqual((hashes(one), positions(one).tobytes(), len(bpy.data.meshes)), before)

    def test_what_was_changed_meanwhile_is_not_overwritten(self):
        one = tubes()
        steps = runs.repair_objects(bpy.context)
        next(steps)
        one.data.vertices[0].co.x += 1
        changed = positions(one)
        with self.assertRaisesRegex(Refused, "was changed while it was repaired"):
            for _ in steps:
                time.sleep(0.01)
        self.assertEqual(positions(one).tobytes(), changed.tobytes())

    def test_what_was_deleted_meanwhile_is_named(self):
        one = tubes()
        steps = runs.repair_objects(bpy.context)
        next(steps)
        bpy.data.objects.remove(one)
        with self.assertRaisesRegex(Refused, "'tubes' is no longer in the scene"):
            for _ in steps:
                time.sleep(0.01)

    def test_one_undo_restores(self):
        one = tubes()
        start, before = positions(one), hashes(one)
        bpy.ops.ed.undo_push(message="start")
        self.assertEqual(bpy.ops.unsnarl.repair("EXEC_DEFAULT", True), {"FINISHED"})
        self.assertNotEqual(positions(bpy.data.objects["tubes"]).tobytes(), start.tobytes())
        bpy.ops.ed.undo()
        restored = bpy.data.objects["tubes"]
        self.assertEqual(positions(restored).tobytes(), start.tobytes())
        self.assertEqual(hashes(restored), before)


class Time(unittest.TestCase):
    def test_is_printed(self):
        """Measures, and asserts nothing of it: what Blender adds to the library's own time, at 27,000 quads."""
        scenes.fresh()
        one = tubes(resolution=136)
        inside = []

        def timed(*arguments, **options):
            begin = time.perf_counter()
            try:
                return own(*arguments, **options)
            finally:
                inside.append(time.perf_counter() - begin)

        own = unsnarl.repair
        unsnarl.repair = timed
        try:
            begin = time.perf_counter()
            self.assertEqual(bpy.ops.unsnarl.repair(), {"FINISHED"})
            whole = time.perf_counter() - begin
        finally:
            unsnarl.repair = own
        begin = time.perf_counter()
        bpy.ops.unsnarl.find()
        find = time.perf_counter() - begin
        print(
            f"\n{len(one.data.polygons)} quads: repair {whole:.2f} s, of which the library {sum(inside):.2f} s, so "
            f"Blender and the shell {whole - sum(inside):.2f} s; find {find:.2f} s"
        )
