#!/usr/bin/env python3
"""bench/ablations against a stand-in for unsnarl_ablations: what is run, what is not run twice, what the table says."""

import csv
import subprocess
import sys
import tempfile
import textwrap
import unittest
from pathlib import Path

ABLATIONS = Path(__file__).resolve().parent / "ablations"

PROGRAM = """\
    #!{python}
    import json, sys
    arguments = sys.argv[1:]
    open({calls!r}, "a").write(" ".join(arguments) + "\\n")
    clean = "--frozen" not in arguments
    print(json.dumps(dict(clean=clean, iterations=20 if clean else 1500, disjoint_left=0 if clean else 7, seconds=0.5,
                          displacement_mean_rel=0.01, turned_share=0, volume_ratio=1)))
    """


class AblationsTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        self.calls = self.root / "calls"
        self.program = self.root / "program"
        self.program.write_text(textwrap.dedent(PROGRAM).format(python=sys.executable, calls=str(self.calls)))
        self.program.chmod(0o755)
        (self.root / "mesh.obj").write_text("v 0 0 0\n")

    def ablations(self, *experiments):
        only = [word for name in experiments for word in ("--only", name)]
        run = subprocess.run([sys.executable, ABLATIONS, "-o", self.root / "out", "--program", self.program,
                              "--no-samples", *only, self.root / "mesh.obj"], capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stderr)
        return run.stdout

    def call_count(self):
        return len(self.calls.read_text().splitlines())

    def test_tables_and_resuming(self):
        text = self.ablations("bandwidth")
        self.assertEqual(self.call_count(), 6)
        self.assertIn("| symmetric adaptive | 1 | 20 |", text)
        self.assertIn("| symmetric frozen | 0 | not reached |", text)
        self.assertIn("7 left (1 %)", text)
        self.assertEqual(self.ablations("bandwidth"), text)
        self.assertEqual(self.call_count(), 6, "finished runs were repeated")
        self.ablations("bandwidth", "energies")
        self.assertEqual(self.call_count(), 9, "what two experiments share is run once")
        with (self.root / "out/results.csv").open(newline="") as file:
            rows = {(row["experiment"], row["variant"]): row for row in csv.DictReader(file)}
        self.assertEqual(rows["energies", "both"]["iterations"], "20")
        self.assertEqual(rows["bandwidth", "global frozen"]["disjoint_left"], "7")


if __name__ == "__main__":
    unittest.main()
