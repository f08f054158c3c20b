#!/usr/bin/env python3
"""Reports are what the JSON Schemas in docs/schemas say, these name every key of the page, and they do refuse."""

import json
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

import pages

SCHEMAS = pages.PROJECT / "docs" / "schemas"
TYPES = {"object": dict, "array": list, "string": str, "boolean": bool, "integer": int, "number": (int, float),
         "null": type(None)}
KNOWN = {"$schema", "$defs", "$ref", "title", "anyOf", "type", "const", "enum", "required", "properties",
         "additionalProperties", "propertyNames", "items", "minItems", "maxItems", "minimum", "maximum"}


def faults(value, schema, root, at="$"):
    """What a value breaks of a schema, of which all keywords must be known here."""
    assert set(schema) <= KNOWN, set(schema) - KNOWN
    if "$ref" in schema:
        return faults(value, root["$defs"][schema["$ref"].rpartition("/")[2]], root, at)
    if "anyOf" in schema:
        each = [faults(value, choice, root, at) for choice in schema["anyOf"]]
        return [] if not all(each) else min(each, key=len)
    kind = schema.get("type")
    if kind and (not isinstance(value, TYPES[kind]) or (isinstance(value, bool) and kind != "boolean")):
        return [f"{at} is no {kind}: {value!r}"]
    found = []
    if "const" in schema and value != schema["const"]:
        found.append(f"{at} is {value!r}")
    if "enum" in schema and value not in schema["enum"]:
        found.append(f"{at} is {value!r}")
    if isinstance(value, (int, float)) and not schema.get("minimum", value) <= value <= schema.get("maximum", value):
        found.append(f"{at} is {value}, out of range")
    if isinstance(value, dict):
        found += [f"{at}.{key} is missing" for key in schema.get("required", []) if key not in value]
        own = schema.get("properties", {})
        for key, entry in value.items():
            found += faults(key, schema.get("propertyNames", {}), root, f"{at}: key")
            rest = schema.get("additionalProperties", {})
            if key in own or rest is not False:
                found += faults(entry, own.get(key, rest), root, f"{at}.{key}")
            else:
                found.append(f"{at}.{key} is unknown")
    if isinstance(value, list):
        if not schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", len(value)):
            found.append(f"{at} has {len(value)} entries")
        for i, entry in enumerate(value):
            found += faults(entry, schema.get("items", {}), root, f"{at}[{i}]")
    return found


class Schemas(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.report, cls.check, cls.sequence = (json.loads((SCHEMAS / f"{name}.schema.json").read_text())
                                               for name in ("report", "check", "sequence"))

    def options(self):
        return set(self.report["anyOf"][0]["properties"]["options"]["properties"])

    def run_program(self, folder, *words):
        return subprocess.run([pages.PROGRAM, *words], cwd=folder, capture_output=True, text=True)

    def test_what_the_program_writes(self):
        calls = {"crossing_tubes": [], "klein_bottle": [], "anchored_balls": ["--fix-group", "anchor", "--record", "c.json"],
                 "anchor_scene": ["--fix-object", "anchor", "--rigid", "hoop"],
                 "linked_rings": ["--max-displacement", "1e-6", "--keep-partial"], "stool": []}
        with tempfile.TemporaryDirectory() as folder:
            for sample, options in calls.items():
                with self.subTest(sample=sample):
                    self.run_program(folder, "sample", sample, "-o", "in.obj", "--resolution", "12")
                    self.run_program(folder, "fix", "in.obj", "-o", "out.obj", "--report", "r.json", *options)
                    report = json.loads((Path(folder) / "r.json").read_text())
                    self.assertEqual(faults(report, self.report, self.report), [])
                    self.assertEqual(set(report["options"]), self.options())
                    found = json.loads(self.run_program(folder, "check", "in.obj", "--json").stdout)
                    self.assertEqual(faults(found, self.check, self.check), [])
            self.run_program(folder, "sample", "book", "-o", "second.obj")
            self.run_program(folder, "fix", "in.obj", "second.obj", "-o", "scene", "--report", "r.json", "--time-limit", "1")
            scene = json.loads((Path(folder) / "r.json").read_text())
            self.assertEqual((faults(scene, self.report, self.report), len(scene["files"])), ([], 2))
            (Path(folder) / "in.obj").write_text("v 0 nan 0\n")
            self.run_program(folder, "fix", "in.obj", "-o", "out.obj", "--report", "r.json")
            self.assertEqual(faults(json.loads((Path(folder) / "r.json").read_text()), self.report, self.report), [])

    def test_what_it_writes_of_a_sequence(self):
        with tempfile.TemporaryDirectory() as folder:
            for elbow in ("80", "90", "100", "110"):
                self.run_program(folder, "sample", "posed_limb", "--resolution", "8", "--set", f"elbow={elbow}", "-o", f"{elbow}.obj")
            for frames, limit, count in (("0:3", "60", 3), ("0:4", "0.000001", 4)):
                self.run_program(folder, "fix", "--sequence", "*.obj", "-o", "out", "--frames", frames, "--report", "r.json",
                                 "--time-limit", limit)
                report = json.loads((Path(folder) / "r.json").read_text())
                self.assertEqual((faults(report, self.sequence, self.sequence), len(report["list"])), ([], count))

    def test_they_refuse(self):
        for broken in ({}, {"schema": "unsnarl-report", "schema_version": 2}, []):
            self.assertNotEqual(faults(broken, self.report, self.report), [])
            self.assertNotEqual(faults(broken, self.check, self.check), [])
            self.assertNotEqual(faults(broken, self.sequence, self.sequence), [])

    def test_every_key_of_the_page_is_there(self):
        keys = set(self.report["anyOf"][0]["properties"])
        page = (pages.PROJECT / "docs/report.md").read_text().partition("\n## ")[0]
        for row in re.findall(r"^\| (`\w[^|]*) \| \w", page, re.M):
            for name in re.findall(r"`(\w+)", row):
                self.assertTrue(name in keys or name[0] == "_" and any(key.endswith(name) for key in keys), name)
        described = set(re.findall(r"`(\w+)`", re.search(r"^\| `options` .*", page, re.M)[0]))
        self.assertLessEqual({name for name in self.options() if f"{name}_rel" not in self.options()}, described)


if __name__ == "__main__":
    unittest.main()
