#!/usr/bin/env python3
"""bench/thingi10k on a table of made-up models."""

import csv
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

LISTER = Path(__file__).resolve().parent / "thingi10k"
GOOD = {"file_id": 0, "num_faces": 100, "num_geometrical_degenerated_faces": 0, "num_combinatorial_degenerated_faces": 0,
        "num_connected_components": 1, "num_boundary_edges": 0, "num_duplicated_faces": 0, "num_self_intersections": 5,
        "num_coplanar_intersecting_faces": 0, "vertex_manifold": 1, "edge_manifold": 1, "total_area": 1.5}
MODELS = [{**GOOD, "file_id": 902}, {**GOOD, "file_id": 17}, {**GOOD, "file_id": 1, "num_self_intersections": 0},
          {**GOOD, "file_id": 2, "vertex_manifold": 0}, {**GOOD, "file_id": 3, "edge_manifold": 0},
          {**GOOD, "file_id": 4, "num_geometrical_degenerated_faces": 1}, {**GOOD, "file_id": 5, "num_duplicated_faces": 2},
          {**GOOD, "file_id": 6, "num_combinatorial_degenerated_faces": 1}, {**GOOD, "file_id": 7, "edge_manifold": ""},
          {**GOOD, "file_id": 30, "num_boundary_edges": 4}, {**GOOD, "file_id": 31, "num_connected_components": 2},
          {**GOOD, "file_id": 32, "num_coplanar_intersecting_faces": 1}, {**GOOD, "file_id": 33, "num_faces": 101}]


class Thingi10KTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)

    def list(self, table, *arguments):
        return subprocess.run([sys.executable, LISTER, table, *arguments], capture_output=True, text=True)

    def ids(self, table, *arguments):
        run = self.list(table, *arguments)
        self.assertEqual(run.returncode, 0, run.stderr)
        return [int(line) for line in run.stdout.split()]

    def table(self, models=MODELS):
        path = self.root / "geometry_data.csv"
        with path.open("w", newline="") as file:
            writer = csv.DictWriter(file, models[0])
            writer.writeheader()
            writer.writerows(models)
        return path

    def test_manifold_and_intersecting(self):
        self.assertEqual(self.ids(self.table()), [17, 30, 31, 32, 33, 902])
        self.assertIn("6 of 13 models: vertex_manifold 1", self.list(self.table()).stderr)

    def test_narrower(self):
        for option, without in (("--closed", 30), ("--one-component", 31), ("--no-coplanar", 32)):
            self.assertEqual(self.ids(self.table(), option), [i for i in (17, 30, 31, 32, 33, 902) if i != without])
        self.assertEqual(self.ids(self.table(), "--most-faces", "100"), [17, 30, 31, 32, 902])

    def test_json(self):
        path = self.root / "models.json"
        path.write_text(json.dumps([{**model, "vertex_manifold": bool(model["vertex_manifold"])} for model in MODELS]))
        self.assertEqual(self.ids(path), [17, 30, 31, 32, 33, 902])

    def test_errors(self):
        lacking = [{name: value for name, value in GOOD.items() if name != "edge_manifold"}]
        wrong = [{**GOOD, "num_self_intersections": "many"}]
        for models, words in ((lacking, "no 'edge_manifold'"), (wrong, "'many', not a number")):
            run = self.list(self.table(models))
            self.assertEqual(run.returncode, 1)
            self.assertIn(words, run.stderr)
        self.assertIn("cannot be read", self.list(self.root / "none.csv").stderr)
        (self.root / "bad.json").write_text('{"file_id": 1}')
        self.assertIn("list of objects", self.list(self.root / "bad.json").stderr)


if __name__ == "__main__":
    unittest.main()
