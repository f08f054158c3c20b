#!/usr/bin/env python3
"""./demo with a program that is built already: where it writes, and what it leaves alone. usage: demo_test.py PROGRAM"""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
PROGRAM = Path(sys.argv.pop(1)).resolve()
CROSSING = ("v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4\nv 1.2 1.2 1.1\nv 2.6 2.5 2\nv 2.5 2.6 2.2\nv 2.4 2.4 2.7\n"
            "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\nf 5 7 6\nf 5 6 8\nf 6 7 8\nf 5 8 7\n")
WRITTEN = ["knot.html", "knot_before_after.png", "knot_fixed.obj", "knot_report.json"]


class DemoTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.project, self.home = Path(folder.name) / "project", Path(folder.name) / "home"
        for path in (self.project / "cmake", self.project / "build/release", self.project / "bin", self.home):
            path.mkdir(parents=True)
        (self.project / "demo").write_bytes((PROJECT / "demo").read_bytes())
        (self.project / "tools").symlink_to(PROJECT / "tools")
        (self.project / "build/release/unsnarl").symlink_to(PROGRAM)
        prepare = (PROJECT / "cmake/prepare_build.sh").read_text()
        (self.project / "cmake/prepare_build.sh").write_text(
            prepare + "install_missing_packages() { :; }\nconfigure_release() { :; }\ncmake() { :; }\n")
        (self.home / "knot.obj").write_text(CROSSING)

    def demo(self, *arguments, cwd=None):
        return subprocess.run(["bash", self.project / "demo", *arguments], cwd=cwd or self.home, capture_output=True,
                              text=True)

    def names(self):
        return sorted(path.name for path in (self.home / "out").iterdir() if not path.name.startswith("."))

    def test_it_writes_to_the_folder_one_is_in(self):
        before = sorted(path.name for path in self.project.iterdir())
        run = self.demo("knot.obj")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(self.names(), WRITTEN)
        self.assertEqual(sorted(path.name for path in self.project.iterdir()), before)
        self.assertIn("out/knot.html", run.stderr)

    def test_a_second_run_replaces_what_the_first_has_written(self):
        self.demo("knot.obj")
        (self.home / "knot.obj").write_text(CROSSING.replace("2.4 2.4 2.7", "2.4 2.4 2.6"))
        run = self.demo("knot.obj")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("2.6", (self.home / "out/knot_fixed.obj").read_text())

    def test_it_replaces_nothing_else(self):
        (self.home / "out").mkdir()
        for name in WRITTEN:
            with self.subTest(name):
                (self.home / "out" / name).write_text("of somebody")
                run = self.demo("knot.obj")
                self.assertEqual(run.returncode, 1)
                self.assertIn(f"'out/{name}' is there", run.stderr)
                self.assertEqual((self.home / "out" / name).read_text(), "of somebody")
                (self.home / "out" / name).unlink()

    def test_what_was_changed_since_is_not_its_own(self):
        self.demo("knot.obj")
        (self.home / "out/knot_fixed.obj").write_text("worked on")
        self.assertEqual(self.demo("knot.obj").returncode, 1)
        self.assertEqual((self.home / "out/knot_fixed.obj").read_text(), "worked on")
        self.assertEqual(self.names(), WRITTEN)

    def test_without_a_mesh_it_takes_a_sample(self):
        run = self.demo()
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("trefoil_tube.obj", self.names())
        self.assertEqual(self.demo().returncode, 0)

    def test_what_cannot_be_read_is_told_first(self):
        run = self.demo("absent.obj")
        self.assertEqual((run.returncode, (self.home / "out").exists()), (3, False))
        self.assertIn("absent.obj", run.stderr)


if __name__ == "__main__":
    unittest.main()
