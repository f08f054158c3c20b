#!/usr/bin/env python3
"""bench/compare against stand-ins for the program whose results and costs are known."""

import csv
import subprocess
import sys
import tempfile
import textwrap
import unittest
from pathlib import Path

COMPARE = Path(__file__).resolve().parent / "compare"

PROGRAM = """\
    #!{python}
    import json, sys, time
    arguments = sys.argv[1:]
    if arguments[0] == "sample":
        open(arguments[3], "w").write("v 0 0 0\\n")
        sys.exit(0)
    option = lambda name: arguments[arguments.index(name) + 1]
    open({calls!r}, "a").write({side!r} + " " + arguments[1].rsplit("/", 1)[1] + "\\n")
    end = time.process_time() + {cpu_s}
    while time.process_time() < end: pass
    held = bytearray({megabytes} << 20)
    for i in range(0, len(held), 4096): held[i] = 1
    json.dump(dict(status="embedded", displacement_mean_rel={displacement}, after=dict(total={left})),
              open(option("--report"), "w"))
    """


class CompareTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        self.calls = self.root / "calls"
        for name in ("a.obj", "b.obj"):
            (self.root / name).write_text("v 0 0 0\n")

    def program(self, side, **values):
        values = {"cpu_s": 0, "megabytes": 0, "displacement": 0.001, "left": 0, **values}
        path = self.root / side
        text = textwrap.dedent(PROGRAM).format(python=sys.executable, calls=str(self.calls), side=side, **values)
        path.write_text(text)
        path.chmod(0o755)
        return path

    def compare(self, base, head, *arguments):
        run = subprocess.run([sys.executable, COMPARE, "--program-base", base, "--program-head", head, "-o",
                              self.root / "out", "--rounds", "3", *arguments], capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stderr)
        with (self.root / "out/compare.csv").open(newline="") as file:
            return {row["mesh"].split("/")[-1]: row for row in csv.DictReader(file)}, run.stdout

    def test_alternates_and_sees_what_changed(self):
        base = self.program("base", cpu_s=0.3, megabytes=100, displacement=0.002, left=3)
        head = self.program("head", displacement=0.001)
        rows, text = self.compare(base, head, self.root / "a.obj", self.root / "b.obj")
        one_round = ["base a.obj", "head a.obj", "base b.obj", "head b.obj"]
        self.assertEqual(self.calls.read_text().splitlines(), 3 * one_round)
        for mesh in ("a.obj", "b.obj", "all"):
            row = rows[mesh]
            self.assertLess(float(row["cpu_s_ratio"]), 0.7)
            self.assertLess(float(row["peak_memory_mb_ratio"]), 0.6)
            self.assertEqual(float(row["displacement_mean_rel_ratio"]), 0.5)
            for quantity in ("cpu_s", "peak_memory_mb", "displacement_mean_rel", "pairs_left"):
                self.assertEqual(row[f"{quantity}_significant"], "True", quantity)
        self.assertEqual((rows["all"]["pairs_left_base"], rows["all"]["pairs_left_head"]), ("6", "0"))
        self.assertIn("3 → 0", text)

    def test_a_program_equals_itself(self):
        same = self.program("same")
        rows, text = self.compare(same, same)
        self.assertIn("flying_saucer", rows)
        for row in rows.values():
            self.assertEqual(row["displacement_mean_rel_significant"], "False")
            self.assertEqual(row["pairs_left_significant"], "False")


if __name__ == "__main__":
    unittest.main()
