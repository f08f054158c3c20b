#!/usr/bin/env python3
"""What ./demo and ./test say while they prepare a build: who refuses, what goes on, what they install, where they write."""

import os
import stat
import subprocess
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]


class PrepareBuildTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        (self.root / "bin").mkdir()
        self.program("dpkg-query", "exit 1")  # nothing is installed
        self.program("apt-get", f'echo "$*" >>{self.root}/calls; echo "Get:1 something"')

    def program(self, name, script):
        path = self.root / "bin" / name
        path.write_text(f"#!/bin/bash\n{script}\n")
        path.chmod(path.stat().st_mode | stat.S_IXUSR)

    def bash(self, script):
        return subprocess.run(["bash", "-euo", "pipefail", "-c", f"source cmake/prepare_build.sh; {script}"], cwd=PROJECT,
                              env={**os.environ, "PATH": f"{self.root}/bin:{os.environ['PATH']}"}, capture_output=True,
                              text=True, timeout=120)

    def calls(self):
        return (self.root / "calls").read_text() if (self.root / "calls").exists() else ""

    def test_a_refused_sudo_is_told_as_such(self):
        self.program("sudo", 'echo "sorry: not for you" >&2; exit 1')
        run = self.bash("is_root() { false; }; install_missing_packages build")
        self.assertEqual(run.returncode, 1)
        self.assertIn("sudo refused", run.stderr)
        self.assertIn("As root, run: apt-get update && apt-get install", run.stderr)
        self.assertNotIn("network", run.stderr)
        self.assertEqual(self.calls(), "")

    def test_a_fault_of_apt_is_told_as_such(self):
        self.program("apt-get", 'echo "E: cannot reach the mirror"; exit 100')
        run = self.bash("is_root() { true; }; install_missing_packages build")
        self.assertEqual(run.returncode, 1)
        self.assertIn("E: cannot reach the mirror", run.stderr)
        self.assertIn("apt-get failed", run.stderr)
        self.assertNotIn("sudo refused", run.stderr)

    def test_node_is_for_those_who_change_the_viewer(self):
        for wanted in ("build", "all"):
            with self.subTest(wanted):
                run = self.bash(f"is_root() {{ true; }}; install_missing_packages {wanted}")
                self.assertEqual(run.returncode, 0, run.stderr)
                words = set(self.calls().split())
                self.assertTrue({"g++", "cmake", "libzip-dev"} <= words)
                self.assertFalse({"nodejs", "npm", "chromium"} & words)
        self.assertIn("libgtest-dev", self.calls())

    def test_nothing_is_silent_for_long(self):
        run = self.bash('heartbeat_s=1; (echo "[1/2] first"; sleep 7; printf "[2/2] sec"; sleep 6; echo ond; echo done) '
                        f'| show_lines {self.root}/log')
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("[1/2] first (", run.stderr)
        self.assertIn("s so far)", run.stderr)
        self.assertEqual((self.root / "log").read_text(), "[1/2] first\n[2/2] second\ndone\n")

    def test_cmake_names_all_that_is_missing_at_once(self):
        run = subprocess.run(["cmake", "-S", PROJECT, "-B", self.root / "build", "-DUNSNARL_BUILD_TESTS=ON",
                              *(f"-DCMAKE_DISABLE_FIND_PACKAGE_{name}=ON" for name in ("fmt", "pugixml", "GTest"))],
                             capture_output=True, text=True)
        self.assertNotEqual(run.returncode, 0)
        self.assertIn("  apt-get install --no-install-recommends libfmt-dev libpugixml-dev libgtest-dev\n", run.stderr)
        self.assertIn("-DUNSNARL_BUILD_TESTS=OFF", run.stderr)

    def test_the_site_says_what_it_needs(self):
        run = subprocess.run(["cmake", "-DPROGRAM=x", f"-DSITE={self.root}", "-DCMAKE_SYSTEM_PROGRAM_PATH=/nowhere",
                              "-DMKDOCS=MKDOCS-NOTFOUND", "-DCMAKE_FIND_USE_CMAKE_SYSTEM_PATH=OFF",
                              "-DCMAKE_FIND_USE_SYSTEM_ENVIRONMENT_PATH=OFF", "-P", PROJECT / "cmake/build_site.cmake"],
                             capture_output=True, text=True)
        self.assertNotEqual(run.returncode, 0)
        self.assertIn("  apt-get install --no-install-recommends mkdocs python3-pygments\n", run.stderr)

    def test_lines_arrive_whole(self):
        text = "".join(f"[{i}/1000] line {i}\n" for i in range(1, 1001)) + "the last without an end"
        (self.root / "in").write_text(text)
        run = self.bash(f"show_lines {self.root}/log <{self.root}/in")
        self.assertEqual((self.root / "log").read_text(), text + "\n")
        self.assertEqual(len(run.stderr.splitlines()), 11)


if __name__ == "__main__":
    unittest.main()
