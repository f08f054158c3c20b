#!/usr/bin/env python3
"""What .github/workflows/ci.yml runs is there: scripts, presets, targets; and each step is well formed for a shell."""

import json
import os
import re
import subprocess
import sys
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
TARGETS = PROJECT / "packaging/targets"
SKIPPED = 77

try:
    import yaml
except ImportError:
    print("skipped: python3-yaml is not installed; mkdocs brings it")
    sys.exit(SKIPPED)


def steps(job):
    """The command lines of a job, once for each target of its matrix."""
    for step in job["steps"]:
        for target in job.get("strategy", {}).get("matrix", {}).get("target", [""]):
            if "run" in step:
                yield step["run"].replace("${{ matrix.target }}", target)


class Ci(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.jobs = yaml.safe_load((PROJECT / ".github/workflows/ci.yml").read_text())["jobs"]
        cls.commands = {name: list(dict.fromkeys(steps(job))) for name, job in cls.jobs.items()}

    def test_the_tests_are_those_of_ci(self):
        self.assertIn(".ci/run", self.commands["tests"])

    def test_scripts_exist(self):
        for command in sum(self.commands.values(), []):
            for path in re.findall(r"(?<![\w/])(?:\.ci|cmake|packaging|tools)/[\w./-]+", command):
                if TARGETS.is_dir() or TARGETS not in (PROJECT / path).parents:
                    self.assertTrue((PROJECT / path).is_file(), path)

    def test_every_target_is_built(self):
        scripts = {path.name for path in TARGETS.glob("*") if os.access(path, os.X_OK) and not path.suffix
                   and "python" in path.read_text().partition("\n")[0]}  # those in bash are steps of these
        self.assertLessEqual(scripts, set(self.jobs["targets"]["strategy"]["matrix"]["target"]))

    def test_presets_exist(self):
        presets = json.loads((PROJECT / "CMakePresets.json").read_text())
        for command in sum(self.commands.values(), []):
            if name := re.search(r"--preset (\S+)", command):
                kind = "test" if "ctest" in command else "build" if "--build" in command else "configure"
                self.assertIn(name[1], [preset["name"] for preset in presets[f"{kind}Presets"]])

    def test_steps_are_well_formed(self):
        for command in sum(self.commands.values(), []):
            subprocess.run(["bash", "-n", "-c", command], check=True)

    def test_the_sources_are_formatted_as_it_asks(self):
        (command,) = (command for command in self.commands["format"] if "clang-format --" in command)
        tools = subprocess.run(["sh", "-c", "clang-format --version && git rev-parse"], cwd=PROJECT, capture_output=True, text=True)
        if tools.returncode != 0 or "version 14." not in tools.stdout:
            self.skipTest("clang-format of Debian 12 is not installed, or this is no checkout")
        checked = subprocess.run(["bash", "-o", "pipefail", "-c", command], cwd=PROJECT, capture_output=True, text=True)
        self.assertEqual(checked.returncode, 0, checked.stderr[:2000])


if __name__ == "__main__":
    unittest.main()
