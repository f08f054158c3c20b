#!/usr/bin/env python3
"""bench/scale with the program given: its scenes are whole, tangled where they should be, and tabulated."""

import csv
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import numpy as np
except ImportError:
    print("python3-numpy is not installed: skipped")
    sys.exit(77)

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))
import scenes

PROGRAM = sys.argv.pop(1)


def sides(triangles):
    return triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)


def area(vertices, triangles):
    a, b, c = vertices[triangles].transpose(1, 0, 2)
    return np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2


class ScenesTest(unittest.TestCase):
    def setUp(self):
        self.vertices, self.triangles = scenes.sample(PROGRAM, "intersecting_spheres")

    def is_closed(self, triangles):
        used = {tuple(side) for side in sides(triangles).tolist()}
        return len(used) == 3 * len(triangles) and all((b, a) in used for a, b in used)

    def test_refinement_keeps_the_surface(self):
        self.assertTrue(self.is_closed(self.triangles))
        vertices, triangles = scenes.refine_all(self.vertices, self.triangles)
        self.assertEqual(len(triangles), 4 * len(self.triangles))
        kept = scenes.around(self.triangles, [5], 4)
        partly = scenes.refine_elsewhere(self.vertices, self.triangles, kept)
        self.assertLess(2 * len(self.triangles), len(partly[1]))
        self.assertLess(len(partly[1]), len(triangles))
        before = self.triangles[np.isin(self.triangles, scenes.around(self.triangles, [5], 3)).all(axis=1)]
        still = {tuple(t) for t in partly[1].tolist()}
        self.assertTrue(all(tuple(t) in still for t in before.tolist()))
        for mesh in ((vertices, triangles), partly):
            self.assertTrue(self.is_closed(mesh[1]))
            self.assertAlmostEqual(area(*mesh), area(self.vertices, self.triangles), places=5)

    def test_side_by_side(self):
        vertices, triangles = scenes.side_by_side([(self.vertices, self.triangles)], 5 * len(self.triangles))
        self.assertEqual(len(triangles), 5 * len(self.triangles))
        self.assertEqual(len(np.unique(triangles)), 5 * len(self.vertices))


class ScaleTest(unittest.TestCase):
    def test_tabulates_what_it_costs(self):
        with tempfile.TemporaryDirectory() as folder:
            run = subprocess.run([sys.executable, Path(__file__).parent / "scale", "-o", folder, "--program", PROGRAM,
                                  "--sizes", "3000", "--only", "hook", "--only", "limb"], capture_output=True, text=True)
            self.assertEqual(run.returncode, 0, run.stderr)
            with (Path(folder) / "results.csv").open(newline="") as file:
                rows = {row["name"]: row for row in csv.DictReader(file)}
            self.assertEqual(list(rows), ["hook_3000", "limb_1x", "limb_4x", "limb_16x"])
            for row in rows.values():
                self.assertEqual(row["status"], "embedded")
                self.assertGreater(int(row["pairs"]), 5)
            self.assertEqual(rows["limb_1x"]["pairs"], rows["limb_16x"]["pairs"])
            self.assertGreater(int(rows["limb_16x"]["faces"]), 8 * int(rows["limb_1x"]["faces"]))
            self.assertIn("| limb_4x |", run.stdout)


if __name__ == "__main__":
    unittest.main()
