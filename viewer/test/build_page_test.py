#!/usr/bin/env python3
"""viewer/build_page --check sees each change of what the page is made of, and of the page, without Node.js."""

import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

VIEWER = Path(__file__).resolve().parents[1]


class BuildPageTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.viewer = Path(folder.name) / "viewer"
        shutil.copytree(VIEWER, self.viewer, ignore=shutil.ignore_patterns("node_modules", "test"))

    def check(self):
        return subprocess.run([sys.executable, "-B", self.viewer / "build_page", "--check"], capture_output=True,
                              text=True, env={"PATH": "/nowhere"})

    def test_a_copy_is_current(self):
        run = self.check()
        self.assertEqual((run.returncode, run.stderr), (0, ""))

    def test_every_change_is_seen(self):
        for name in ("page.html", "src/main.js", "src/style.css", "index.html", "shell.html", "package-lock.json", "vite.config.js"):
            with self.subTest(name):
                before = (self.viewer / name).read_bytes()
                (self.viewer / name).write_bytes(before + b"\n")
                run = self.check()
                self.assertEqual(run.returncode, 1)
                self.assertIn(f"{name} changed since page.html was built. Run viewer/build_page.", run.stderr)
                (self.viewer / name).write_bytes(before)

    def test_new_and_lost_parts_are_seen(self):
        (self.viewer / "src/new.js").write_text("")
        self.assertIn("src/new.js changed", self.check().stderr)
        (self.viewer / "src/new.js").unlink()
        (self.viewer / "src/main.js").unlink()
        self.assertIn("src/main.js changed", self.check().stderr)

    def test_the_lock_file_names_the_public_registry_alone(self):
        lines = [line for line in (VIEWER / "package-lock.json").read_text().splitlines() if '"resolved"' in line]
        self.assertTrue(lines)
        self.assertEqual([line for line in lines if '"resolved": "https://registry.npmjs.org/' not in line], [])


if __name__ == "__main__":
    unittest.main()
