#!/usr/bin/env python3
"""Flags under which signs would be wrong are refused: by the configuration, and by the header of the predicates.

usage: refused_flags_test.py PROJECT_DIR COMPILER CMAKE EIGEN_DIR
"""

import subprocess
import sys
import tempfile
import unittest

PROJECT, COMPILER, CMAKE, EIGEN = sys.argv[1:]


def run(*command):
    return subprocess.run(command, capture_output=True, text=True)


def configured(flags):
    with tempfile.TemporaryDirectory() as build:
        return run(CMAKE, "-S", PROJECT, "-B", build, "-DCMAKE_BUILD_TYPE=Release", f"-DCMAKE_CXX_COMPILER={COMPILER}",
                   f"-DCMAKE_CXX_FLAGS={flags}", "-DUNSNARL_BUILD_TESTS=OFF")


def compiled(*flags):
    return run(COMPILER, "-std=c++20", "-fsyntax-only", f"-I{PROJECT}/src", f"-I{PROJECT}/include", f"-I{EIGEN}", *flags,
               f"{PROJECT}/src/geometry/predicates.cpp")


class RefusedFlags(unittest.TestCase):
    def test_by_the_configuration(self):
        for flags in ("-ffast-math", "-g -Ofast", "-fassociative-math -g"):
            with self.subTest(flags=flags):
                done = configured(flags)
                self.assertNotEqual(done.returncode, 0)
                self.assertIn("would certify falsely", done.stderr)
        self.assertEqual(configured("-O2 -march=native").returncode, 0)

    def test_by_the_header(self):
        for flag in ("-ffast-math", "-Ofast", "-ffinite-math-only"):
            with self.subTest(flag=flag):
                done = compiled("-O1", flag)
                self.assertNotEqual(done.returncode, 0)
                self.assertIn("would certify falsely", done.stderr)
        self.assertEqual(compiled("-O3", "-march=native").returncode, 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
