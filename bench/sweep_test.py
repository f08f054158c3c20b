#!/usr/bin/env python3
"""bench/sweep with the program itself on meshes of a few faces. usage: sweep_test.py PROGRAM"""

import csv
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SWEEP = Path(__file__).resolve().parent / "sweep"
PROGRAM = Path(sys.argv.pop(1)).resolve()

GOOD = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
# A tetrahedron, and a small one whose tip sticks into it.
CROSSING = ("v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4\nv 1.2 1.2 1.1\nv 2.6 2.5 2\nv 2.5 2.6 2.2\nv 2.4 2.4 2.7\n"
            "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\nf 5 7 6\nf 5 6 8\nf 6 7 8\nf 5 8 7\n")
# All triangles of a vertex with two of five others: no motion embeds them.
HOPELESS = ("v 0 0 0\nv 1 0 0\nv 0 1 0.1\nv -1 0.2 0\nv 0.1 -1 0\nv 0.2 0.1 1\nf 1 2 3\nf 1 2 4\nf 1 2 5\nf 1 2 6\n"
            "f 1 3 4\nf 1 3 5\nf 1 3 6\nf 1 4 5\nf 1 4 6\nf 1 5 6\n")


class SweepTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)

    def mesh(self, path, text):
        path = self.root / "meshes" / path
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def sweep(self, *arguments):
        run = subprocess.run([sys.executable, SWEEP, "-o", self.root / "out", "--program", PROGRAM, *arguments],
                             capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stderr)
        with (self.root / "out" / "sweep.csv").open(newline="") as file:
            return {row["mesh"]: row for row in csv.DictReader(file)}

    def test_table_summary_and_pictures(self):
        for name, text in (("a/good.obj", GOOD), ("a/crossing.obj", CROSSING), ("b/deep/hopeless.obj", HOPELESS),
                           ("b/silent.stl", "nothing"), ("b/notes.txt", "no mesh")):
            self.mesh(name, text)
        judge = self.root / "judge"
        judge.write_text(f"#!{sys.executable}\nprint('talk')\nprint('{{\"pairs\": 4, \"same\": true}}')\n")
        judge.chmod(0o755)
        rows = self.sweep(self.root / "meshes", "--jobs", "2", "--threads", "1", "--judge", judge)
        self.assertEqual({name: row["status"] for name, row in rows.items()}, {
            "a/good.obj": "embedded", "a/crossing.obj": "embedded", "b/silent.stl": "invalid_input",
            "b/deep/hopeless.obj": rows["b/deep/hopeless.obj"]["status"]})
        self.assertNotEqual(rows["b/deep/hopeless.obj"]["status"], "embedded")
        good, crossing, hopeless = (rows[name] for name in ("a/good.obj", "a/crossing.obj", "b/deep/hopeless.obj"))
        self.assertEqual((good["same_bytes"], crossing["same_bytes"]), ("True", "False"))
        self.assertGreater(int(crossing["pairs_before"]), 0)
        self.assertEqual((crossing["pairs_left"], crossing["intersecting_faces_left"]), ("0", "0"))
        self.assertNotEqual(hopeless["pairs_left"], "0")
        self.assertRegex(crossing["strategies"], r"\w+:1")
        self.assertIn("untangle:", crossing["stage_s"])
        self.assertEqual((crossing["judge.pairs"], rows["b/silent.stl"]["judge.pairs"]), ("4", ""))
        summary = (self.root / "out" / "summary.md").read_text()
        self.assertRegex(summary, r"\| a \| 2 \| 2 \| 0 \| 0 \| ")
        self.assertIn("| b/silent.stl | invalid_input |", summary)
        self.assertIn("1_b_deep_hopeless.obj.png", os.listdir(self.root / "out" / "worst"))

    def test_what_is_done_is_not_done_again(self):
        self.mesh("crossing.obj", CROSSING)
        arguments = [self.root / "meshes", "--pictures", "0"]
        first = self.sweep(*arguments)
        self.assertEqual(self.sweep(*arguments), first, "seconds would differ")
        self.assertNotEqual(self.sweep(*arguments, "--", "--no-recover")["meshes/crossing.obj"]["seconds"],
                            first["meshes/crossing.obj"]["seconds"])


if __name__ == "__main__":
    unittest.main()
