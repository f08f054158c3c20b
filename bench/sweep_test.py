#!/usr/bin/env python3
"""bench/sweep against a stand-in for the program that behaves as the name of the mesh says."""

import csv
import os
import subprocess
import sys
import tempfile
import textwrap
import unittest
from pathlib import Path

SWEEP = Path(__file__).resolve().parent / "sweep"

PROGRAM = """\
    #!{python}
    import json, os, shutil, sys, time
    arguments = sys.argv[1:]
    command = arguments[0]
    if command == "sample":
        if arguments[1] == "--list":
            print("good_knot    a knot\\nstubborn_knot    another")
        else:
            open(arguments[3], "w").write("v 0 0 0\\n")
        sys.exit(0)
    if command == "check":
        open(arguments[arguments.index("--pairs") + 1], "w").write("a,b,class\\n0,1,disjoint\\n1,2,disjoint\\n5,6,folded\\n")
        sys.exit(1)
    source, option = arguments[1], lambda name: arguments[arguments.index(name) + 1]
    open({calls!r}, "a").write(os.path.basename(source) + "\\n")
    if "slow" in source: time.sleep(60)
    if "crash" in source: os.abort()
    if "greedy" in source: bytearray(3 << 30)
    if "silent" in source: sys.exit(3)
    left = 3 if "stubborn" in source else 0
    if left == 0: shutil.copy(source, option("-o"))
    json.dump(dict(status="reduced" if left else "embedded",
                   topology=dict(vertices=12, faces=20), before=dict(total=8, by_class=dict(disjoint=7, folded=1)),
                   after=dict(total=left, by_class=dict(disjoint=left)), untouched_share=0.9,
                   displacement_mean_rel=1e-4, displacement_max_rel=1e-3,
                   regions=[dict(strategy="A2"), dict(strategy="A2"), dict(strategy="I4")],
                   stages=[dict(name="untangle", seconds=0.5)]), open(option("--report"), "w"))
    if "--picture" in arguments: open(option("--picture"), "w").write("png")
    sys.exit(1 if left else 0)
    """


class SweepTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = Path(self.folder.name)
        self.calls = self.root / "calls"
        self.program = self.root / "program"
        self.write_program("")

    def write_program(self, comment):
        self.program.write_text(textwrap.dedent(PROGRAM).format(python=sys.executable, calls=str(self.calls)) + comment)
        self.program.chmod(0o755)

    def mesh(self, path):
        path = self.root / "meshes" / path
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("v 0 0 0\n")

    def sweep(self, *arguments):
        run = subprocess.run([sys.executable, SWEEP, "-o", self.root / "out", "--program", self.program, *arguments],
                             capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stderr)
        with (self.root / "out" / "results.csv").open(newline="") as file:
            return {f"{row['dataset']}/{row['mesh']}": row for row in csv.DictReader(file)}

    def call_count(self):
        return len(self.calls.read_text().splitlines())

    def test_outcomes(self):
        for name in ("a/good.obj", "a/stubborn.off", "b/deep/crash.ply", "b/silent.stl", "b/slow.obj", "b/greedy.obj",
                     "b/notes.txt"):
            self.mesh(name)
        rows = self.sweep(self.root / "meshes", "--time-limit", "3", "--memory-limit", "1000", "--jobs", "3")
        self.assertEqual({name: row["status"] for name, row in rows.items()}, {
            "a/good.obj": "embedded", "a/stubborn.off": "reduced", "b/deep/crash.ply": "killed_by_SIGABRT",
            "b/silent.stl": "exit_3", "b/slow.obj": "killed_after_time_limit", "b/greedy.obj": "exit_1"})
        good, stubborn = rows["a/good.obj"], rows["a/stubborn.off"]
        self.assertEqual((good["pairs_before"], good["pairs_left"], good["intersecting_faces_left"]), ("8", "0", "0"))
        self.assertEqual((good["strategies"], good["stage_s"], good["same_bytes"]), ("A2:2 I4:1", "untangle:0.500", "True"))
        self.assertEqual((stubborn["pairs_left"], stubborn["intersecting_faces_left"]), ("3", "3"))
        self.assertEqual((good["faces"], good["before_folded"], good["displacement_max_rel"]), ("20", "1", "0.001"))
        self.assertGreater(float(good["peak_memory_mb"]), 1)
        self.assertLess(float(rows["b/slow.obj"]["seconds"]), 10)

        summary = (self.root / "out" / "summary.md").read_text()
        self.assertRegex(summary, r"\| a \| 2 \| 1 \| 0 \| 3 \| ")
        self.assertIn("b/deep/crash.ply | killed_by_SIGABRT", summary)
        pictures = sorted(p.name for p in (self.root / "out" / "worst").iterdir())
        self.assertIn("1_a_stubborn.off.png", pictures)

    def test_resumes_until_the_program_changes(self):
        self.mesh("good.obj")
        self.mesh("stubborn.obj")
        arguments = [self.root / "meshes", "--pictures", "0"]
        self.sweep(*arguments)
        self.assertEqual(self.call_count(), 2)
        self.sweep(*arguments)
        self.assertEqual(self.call_count(), 2, "finished meshes were run again")
        self.mesh("good_new.obj")
        self.sweep(*arguments)
        self.assertEqual(self.call_count(), 3)
        self.write_program("# another build\n")
        rows = self.sweep(*arguments)
        self.assertEqual(self.call_count(), 6)
        self.assertEqual(set(rows), {"meshes/good.obj", "meshes/good_new.obj", "meshes/stubborn.obj"})
        self.sweep(*arguments, "--", "--paper")
        self.assertEqual(self.call_count(), 9, "other arguments of the program make another result")

    def test_samples_and_judge(self):
        judge = self.root / "judge"
        judge.write_text(f"#!{sys.executable}\nprint('talk')\nprint('{{\"pairs\": 4, \"same\": true}}')\n")
        judge.chmod(0o755)
        rows = self.sweep("--samples", "--judge", str(judge), "--pictures", "0")
        self.assertEqual(set(rows), {"Analytic/good_knot.obj", "Analytic/stubborn_knot.obj"})
        self.assertEqual(rows["Analytic/good_knot.obj"]["judge.pairs"], "4")
        self.assertEqual(rows["Analytic/stubborn_knot.obj"]["judge.pairs"], "", "no output, nothing to judge")


if __name__ == "__main__":
    unittest.main()
