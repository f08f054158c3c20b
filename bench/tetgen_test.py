#!/usr/bin/env python3
"""bench/tetgen with stand-ins for TetGen: what it says of results that are taken as they are, turned, or never.
And with TetGen itself, where it is installed."""

import importlib.machinery
import importlib.util
import math
import os
import shutil
import subprocess
import sys
import tempfile
import textwrap
import unittest
from pathlib import Path

BENCH = Path(__file__).resolve().parent / "tetgen"
PROGRAM = None

# Each stand-in notes the switches and the first vertex of what it is asked about.
TETGEN = """\
    #!{python}
    import pathlib, sys
    first = pathlib.Path(sys.argv[2]).read_text().splitlines()[2]
    notes = pathlib.Path({notes!r})
    with notes.open("a") as file: file.write(sys.argv[1] + " " + first + "\\n")
    as_it_is = notes.read_text().splitlines()[0].split(" ", 1)[1]
    sys.exit({code})
    """


def load():
    loader = importlib.machinery.SourceFileLoader("bench_tetgen", str(BENCH))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("bench_tetgen", loader))
    loader.exec_module(module)
    return module


class TetgenTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "meshes").mkdir()
        subprocess.run([PROGRAM, "sample", "spindle_torus", "--resolution", "12", "-o",
                        self.folder / "meshes" / "part.obj"], check=True, capture_output=True)

    def ask(self, code):
        """Exit code and lines of bench/tetgen with a stand-in that ends with this code, and what that noted."""
        stand_in, notes = self.folder / "tetgen", self.folder / "notes"
        stand_in.write_text(textwrap.dedent(TETGEN).format(python=sys.executable, notes=str(notes), code=code))
        stand_in.chmod(0o755)
        run = self.run_bench(f"{self.folder}:{os.environ['PATH']}")
        return run.returncode, run.stdout.splitlines(), notes.read_text().splitlines()

    def run_bench(self, path):
        return subprocess.run([sys.executable, BENCH, "-o", self.folder / "out", "--program", PROGRAM, "--turns", "3",
                               self.folder / "meshes"], capture_output=True, text=True,
                              env={**os.environ, "PATH": path})

    def test_what_is_taken_as_it_is_is_asked_about_once(self):
        code, lines, notes = self.ask("0")
        self.assertEqual((code, len(notes)), (0, 1))
        self.assertEqual(lines[-1], "of 1 closed results, tetgen -p takes 1 as they are, 0 more turned")

    def test_what_is_taken_turned_is_told_from_what_is_taken_as_it_is(self):
        code, lines, notes = self.ask("3 if first == as_it_is else 0")
        self.assertEqual(code, 0)
        self.assertEqual([note.split()[0] for note in notes], ["-pNEFQ", "-pMNEFQ", "-pYNEFQ"] + 3 * ["-pNEFQ"])
        self.assertEqual(len(set(note.split(" ", 1)[1] for note in notes)), 4)
        self.assertIn("REFUSED", lines[-2])
        self.assertIn("turned: taken 3 of 3 times", lines[-2])
        self.assertEqual(lines[-1], "of 1 closed results, tetgen -p takes 0 as they are, 1 more turned")

    def test_what_is_never_taken_fails(self):
        code, lines, _ = self.ask("3")
        self.assertEqual(code, 1)
        self.assertIn("turned: taken 0 of 3 times", lines[-2])
        self.assertEqual(lines[-1], "of 1 closed results, tetgen -p takes 0 as they are, 0 more turned")

    @unittest.skipUnless(shutil.which("tetgen"), "TetGen is not installed")
    def test_tetgen_takes_the_result_and_not_the_input(self):
        part = self.folder / "meshes" / "part.obj"
        bench = load()
        bench.write_off(self.folder / "part.off", *bench.read_obj(part))
        before = subprocess.run(["tetgen", "-pNEFQ", self.folder / "part.off"], capture_output=True)
        self.assertNotEqual(before.returncode, 0)
        run = self.run_bench(os.environ["PATH"])
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        self.assertIn("tetgen -p takes 1 as they are", run.stdout)

    def test_a_turn_keeps_lengths_and_handedness(self):
        bench = load()
        axes = bench.turned([[1, 0, 0], [0, 1, 0], [0, 0, 1]], 5)
        self.assertGreater(math.dist(axes[0], [1, 0, 0]), 0.1)
        for a in range(3):
            for b in range(3):
                self.assertAlmostEqual(sum(x * y for x, y in zip(axes[a], axes[b])), a == b, places=14)
        self.assertLess(math.dist(bench.cross(axes[0], axes[1]), axes[2]), 1e-14)

    def test_the_thinnest_face_is_measured_against_the_diagonal(self):
        vertices = [[0, 0, 0], [3, 0, 0], [1, 0.5, 0], [1, 0, 4]]
        triangles = [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]]
        self.assertAlmostEqual(load().thinnest(vertices, triangles), 0.5 / math.hypot(3, 0.5, 4))


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
