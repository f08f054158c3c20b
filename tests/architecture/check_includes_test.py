#!/usr/bin/env python3
"""The include check finds what it forbids, and nothing else. usage: check_includes_test.py"""

import tempfile
import unittest
from pathlib import Path

import check_includes


class Checked(unittest.TestCase):
    check = None

    def findings(self, files):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                path = Path(folder, name)
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            return list(type(self).check(Path(folder)))

    def refused(self, name, line, others=()):
        found = self.findings({name: line + "\n", **{other: "" for other in others}})
        self.assertEqual(len(found), 1, found)
        self.assertIn(f"{name}:1:", found[0])

    def accepted(self, name, line, others=()):
        self.assertEqual(self.findings({name: line + "\n", **{other: "" for other in others}}), [])


class Layers(Checked):
    check = check_includes.check_layers

    def test_a_layer_includes_nothing_from_above(self):
        self.refused("src/mesh/a.cpp", '#include "pipeline/b.h"')
        self.refused("src/report/a.cpp", '#include "render/b.h"')
        self.refused("src/pipeline/a.cpp", '#include "c_interface/b.h"')
        self.accepted("src/pipeline/a.cpp", '#include "mesh/b.h"')

    def test_the_core_includes_nothing_of_files(self):
        self.refused("src/pipeline/a.cpp", '#include "io/b.h"')
        self.refused("src/report/a.cpp", '#include "report/files/b.h"')
        self.accepted("src/pipeline/files/a.cpp", '#include "io/b.h"')
        self.accepted("src/applications/knots/files/a.cpp", '#include "render/b.h"')

    def test_public_headers_include_public_headers(self):
        self.refused("include/unsnarl/a.h", '#include "mesh/b.h"')
        self.refused("include/unsnarl/a.h", "#include <nlohmann/json.hpp>")
        self.accepted("include/unsnarl/a.h", '#include "unsnarl/b.h"')

    def test_users_of_the_library_include_public_headers(self):
        for user in ("apps/unsnarl", "src/c_interface", "examples"):
            with self.subTest(user=user):
                self.refused(f"{user}/a.cpp", '#include "report/b.h"')
                self.refused(f"{user}/a.cpp", '#include "report/b.h"', ["src/report/b.h"])
                self.refused(f"{user}/a.cpp", "#include <report/b.h>", ["src/report/b.h"])
                self.refused(f"{user}/a.cpp", '#include "samples/b.h"', ["samples/b.h"])
                self.refused(f"{user}/a.cpp", '#include "../src/report/b.h"', ["src/report/b.h"])
                self.refused(f"{user}/a.cpp", "#  include <src/report/b.h>", ["src/report/b.h"])
                self.accepted(f"{user}/a.cpp", '#include "unsnarl/b.h"')
                self.accepted(f"{user}/a.cpp", '#include "b.h"', [f"{user}/b.h"])
                self.accepted(f"{user}/room/a.cpp", '#include "b.h"', [f"{user}/b.h"])
                self.refused(f"{user}/room/a.cpp", '#include "b.h"', ["b.h"])
                self.accepted(f"{user}/a.cpp", "#include <fmt/format.h>")
                self.accepted(f"{user}/a.cpp", "#include <vector>")

    def test_the_command_line_may_ask_the_system(self):
        self.accepted("apps/unsnarl/a.cpp", '#include "platform/b.h"', ["src/platform/b.h"])
        self.refused("src/c_interface/a.cpp", '#include "platform/b.h"', ["src/platform/b.h"])
        self.refused("src/platform/a.cpp", '#include "geometry/b.h"')


class Systems(Checked):
    check = check_includes.check_systems

    def test_only_the_platform_includes_headers_of_a_system(self):
        for header in ("unistd.h", "sys/stat.h", "windows.h", "csignal"):
            self.refused("src/io/a.cpp", f"#include <{header}>")
            self.refused("apps/unsnarl/a.cpp", f"#  include <{header}>")
            self.refused("src/platform/a.h", f"#include <{header}>")
            self.accepted("src/platform/posix/a.cpp", f"#include <{header}>")
            self.accepted("src/platform/windows/a.cpp", f"#include <{header}>")
        self.accepted("src/io/a.cpp", '#include "io/io.h"')
        self.accepted("src/io/a.cpp", "#include <cerrno>")

    def test_only_the_platform_asks_which_system_it_is(self):
        for line in ("#ifdef _WIN32", "#if defined(__linux__)", "#  elif !defined(__APPLE__) && X", "#ifndef __GLIBC__"):
            self.refused("src/io/a.cpp", line)
            self.accepted("src/platform/posix/a.cpp", line)
        self.accepted("src/io/a.cpp", "#if __cplusplus")
        self.accepted("src/io/a.cpp", "// not #ifdef _WIN32")


if __name__ == "__main__":
    unittest.main()
