#!/usr/bin/env python3
"""No script of the project deletes or changes what lies in a folder that it is told to write to."""

import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
SCRIPTS = [script for folder in ("bench", "packaging") for script in sorted((PROJECT / folder).iterdir())
           if script.is_file() and re.search(r'add_argument\("-o"', script.read_text(errors="replace"))]
# What a script may be told beside -o; a program that does nothing keeps it from real work.
MORE = {
    "ablations": ["--program", "/bin/true", "--unsnarl", "/bin/true", "in.obj"],
    "bandwidths": ["in.obj"],
    "build_packages": ["--build-dir", "nothing_built"],
    "build_wheel": ["--build-dir", "nothing_built"],
    "compare": ["--program-base", "/bin/true", "--program-head", "/bin/true", "in.obj"],
    "peers": ["--unsnarl", "/bin/true", "--peers", "/bin/true", "in.obj"],
    "release": ["--build-dir", "nothing_built"],
    "sweep": ["in.obj"],
    "tetgen": ["in.obj"],
}
WITHOUT_PROGRAM = {"ablations", "build_packages", "build_wheel", "compare", "paper_figures", "peers", "release"}
# Names that scripts give to what they write, and some that they have no business with.
CONTENT = ["in.obj", "thesis.txt", "results.csv", "report.json", "fixed.obj", "out.json", "meshes/a.obj", "work/1/a.obj",
           "worst/a.png", "undisturbed/a", "killed/a", "parts/a", "samples/a.obj", ".hidden/a"]


class FoldersTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.home = Path(folder.name) / "home"
        for name in self.names_of_results() + CONTENT:
            (self.home / name).parent.mkdir(parents=True, exist_ok=True)
            (self.home / name).write_text(f"{name} is precious")
        self.before = self.content()

    @staticmethod
    def names_of_results():
        """Folders that are called as the benchmarks call theirs: routes' plans."""
        plans = re.findall(r'"(\w+)"', re.search(r"PLANS = \[(.*?)\]", (PROJECT / "bench/routes").read_text(), re.S)[1])
        return [f"{plan}/a" for plan in plans]

    def content(self):
        return {path: path.read_bytes() for path in self.home.rglob("*") if path.is_file()}

    def run_script(self, script):
        program = [] if script.name in WITHOUT_PROGRAM else ["--program", "/bin/true"]
        return subprocess.run([sys.executable, "-B", script, "-o", self.home, *program, *MORE.get(script.name, [])],
                              capture_output=True, text=True, cwd=self.home, timeout=60)

    def test_scripts_are_found(self):
        names = {script.name for script in SCRIPTS}
        self.assertTrue({"build_packages", "build_wheel", "batch", "sweep", "routes", "knots"} <= names, names)

    def test_what_is_in_the_folder_stays(self):
        for script in SCRIPTS:
            if script.name == "gallery":  # writes the pages of docs/, by default in place
                continue
            with self.subTest(script.name):
                run = self.run_script(script)
                self.assertNotEqual(run.returncode, 0, run.stdout)
                self.assertNotIn("usage:", run.stderr)
                lost = [str(path) for path, data in self.before.items()
                        if not path.exists() or path.read_bytes() != data]
                self.assertEqual(lost, [])
                if script.parent.name == "bench" and "ModuleNotFoundError" not in run.stderr:
                    self.assertIn(f"is not empty, and bench/{script.name} has not made it", run.stderr)
                    self.assertEqual(self.content(), self.before)


if __name__ == "__main__":
    unittest.main()
