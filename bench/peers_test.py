#!/usr/bin/env python3
"""bench/peers against stand-ins for the programs: what is run and how, what is judged, what the tables say."""

import csv
import subprocess
import sys
import tempfile
import textwrap
import unittest
from pathlib import Path

PEERS = Path(__file__).resolve().parent / "peers"

# A mesh is a text: the pairs in it, what its vertices moved in percent. `fix` and `run` write such texts, `check` and
# `measure` read them.
UNSNARL = """\
    #!{python}
    import json, sys
    arguments = sys.argv[1:]
    option = lambda name: arguments[arguments.index(name) + 1]
    open({calls!r}, "a").write("unsnarl " + " ".join(arguments) + "\\n")
    if arguments[0] == "fix":
        if "stubborn" in arguments[1]: sys.exit(1)
        open(option("-o"), "w").write("0 1")
    if arguments[0] == "check":
        pairs = int(open(arguments[1]).read().split()[0])
        with open(option("--pairs"), "w") as file:
            for k in range(pairs): file.write(f"{{k}},{{k + 1}},{{'folded' if k == 0 else 'disjoint'}}\\n")
        print(json.dumps(dict(pairs=dict(total=pairs))))
        sys.exit(pairs > 0)
    """
PROGRAM = """\
    #!{python}
    import json, sys
    arguments = sys.argv[1:]
    open({calls!r}, "a").write("peers " + " ".join(arguments) + "\\n")
    if arguments[0] == "run":
        pairs = {{"contours": 3, "cmcf": 0, "smoothing": 1}}[arguments[1]]
        open(arguments[arguments.index("-o") + 1], "w").write(f"{{pairs}} 20")
        print(json.dumps(dict(method=arguments[1], iterations=7, ended="time" if pairs else "goal")))
    if arguments[0] == "measure":
        moved = float(open(arguments[2]).read().split()[1]) / 100
        print(json.dumps(dict(displacement_mean_rel=moved, displacement_max_rel=2 * moved, flipped_triangles=4,
                              volume_change_rel=-3 * moved)))
    if arguments[0] == "gallery":
        open(arguments[arguments.index("-o") + 1], "w").write("picture")
    """


class PeersTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        self.calls = self.root / "calls"
        for name, text in (("unsnarl", UNSNARL), ("peers", PROGRAM)):
            path = self.root / name
            path.write_text(textwrap.dedent(text).format(python=sys.executable, calls=str(self.calls)))
            path.chmod(0o755)
        (self.root / "set").mkdir()
        for name in ("easy.obj", "stubborn.obj"):
            (self.root / "set" / name).write_text("5 0 " + name)

    def peers(self, *methods):
        chosen = [word for name in methods for word in ("--method", name)]
        run = subprocess.run([sys.executable, PEERS, "-o", self.root / "out", "--no-samples", "--unsnarl",
                              self.root / "unsnarl", "--peers", self.root / "peers", "--time-limit", "5", "--slowdown",
                              "3", "--picture", "easy", *chosen, self.root / "set"], capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stderr)
        return run.stdout

    def count(self, words):
        return sum(words in line for line in self.calls.read_text().splitlines())

    def test_tables_and_resuming(self):
        text = self.peers("default", "cmcf", "contours", "smoothing")
        # No result of "stubborn" is written, so its input is judged.
        self.assertRegex(text, r"\| unsnarl \| 2 \| 1 \| 1 \| 5 \| \d+ \| 1 \|  \| 2 \| 3 \| 4 \|")
        # Moved by 20 %, and unsnarl on the one mesh that both resolve by 1 %.
        self.assertRegex(text, r"\| Conformalised flow \| 2 \| 2 \| 2 \| 0 \| \d+ \| 20 \| 1 \| 40 \| 60 \| 8 \|")
        self.assertRegex(text, r"\| Contour minimisation, by crossing \| 2 \| 0 \| 0 \| 6 \| \d+ \| – \| – \| – \| – \| 0 \|")
        # One pair, but of faces that share vertices: resolved by the paper's count alone.
        self.assertRegex(text, r"\| Smoothing of the conflict \| 2 \| 2 \| 0 \| 0 \|")
        self.assertIn("| easy.obj | 1 % | 20 % | **1** (time) | **3** (time) |", text)
        self.assertIn("| stubborn.obj | **5** | 20 % | **1** (time) | **3** (time) |", text)
        self.assertEqual(self.count("unsnarl fix"), 2)
        self.assertEqual(self.count("--threads 1 --time-limit 15"), 2)
        self.assertEqual(self.count("peers run"), 6)
        self.assertEqual(self.count("--time-limit 5"), 6)
        self.assertTrue((self.root / "out/pictures/easy.png").exists())
        self.assertEqual(self.peers("default", "cmcf", "contours", "smoothing"), text)
        self.assertEqual(self.count("peers run"), 6, "finished runs were repeated")
        with (self.root / "out/results.csv").open(newline="") as file:
            rows = {(row["mesh"], row["method"]): row for row in csv.DictReader(file)}
        self.assertEqual(rows["easy.obj", "contours"]["iterations"], "7")
        self.assertEqual(rows["easy.obj", "contours"]["disjoint_left"], "2")
        (self.root / "set/easy.obj").write_text("6 0 changed")
        self.peers("contours")
        self.assertEqual(self.count("peers run"), 7, "a mesh that changed is run again")


if __name__ == "__main__":
    unittest.main()
