#!/usr/bin/env python3
"""The check of constants finds what it forbids, and nothing else. usage: check_constants_test.py"""

import tempfile
import unittest
from pathlib import Path

import check_constants


class Constants(unittest.TestCase):
    def found(self, text, name="src/mesh/a.cpp"):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, name)
            path.parent.mkdir(parents=True)
            path.write_text(text)
            return check_constants.check(Path(folder))[0]

    def refused(self, text, why, **where):
        found = self.found(text, **where)
        self.assertEqual(len(found), 1, found)
        self.assertIn(why, found[0])

    def accepted(self, text, **where):
        self.assertEqual(self.found(text, **where), [])

    def test_a_constant_says_what_it_means_and_its_unit(self):
        self.accepted("/// Rounds of one call, at most (unit: rounds)\nconstexpr int most_rounds = 4;\n")
        self.accepted("constexpr double growth = 1.6;  ///< A gap grows by this factor (no unit)\n")
        self.accepted("constexpr std::size_t header = 84;  ///< Size of the header (fixed by the format, in bytes)\n")
        self.refused("constexpr int most_rounds = 4;\n", "comment that ends with its unit")
        self.refused("/// Rounds of one call, at most.\nconstexpr int most_rounds = 4;\n", "comment that ends with its unit")
        self.refused("constexpr int most_rounds = 4;  ///< (unit: rounds)\n", "sentence")

    def test_two_constants_share_no_comment(self):
        self.refused("/// Least and most of it (unit: h)\nconstexpr double least = 3, most = 4;\n", "one a line")
        self.refused("/// Least of it all (unit: h)\nconstexpr double least = 3;\nconstexpr double most = 4;\n", "'most'")

    def test_constants_of_all_kinds_are_found(self):
        self.refused("constexpr std::array<double, 2> weights = {0.1,\n    0.2};\n", "'weights'")
        self.refused("class A {\n  static constexpr Index leaf_size = 4;\n};\n", "'leaf_size'")
        self.refused("void f() {\n  constexpr std::size_t most = 1 << 18;\n}\n", "'most'")
        self.refused("struct StepOptions {\n  int max_steps = 120;\n};\n", "'max_steps'")
        self.refused("struct StepOptions {\n  PcgOptions solver = {0.1};\n};\n", "'solver'")

    def test_what_nobody_chose_is_exempt(self):
        self.accepted("constexpr double none = -1;\nconstexpr std::uint32_t magic = 0x4E4F534A;\n")
        self.accepted("constexpr double infinity = std::numeric_limits<double>::infinity();\n")
        self.accepted('constexpr std::string_view start = "version 3";\n')
        self.accepted("struct StepOptions {\n  double gap = 0;\n  bool snaps = true;\n};\nstruct State {\n  int next = 2;\n};\n")

    def test_thresholds_in_code_have_names(self):
        self.refused("bool f(double h) { return h < 0.37 * g(); }\n", "0.37 has no name")
        self.refused("bool f(double h) { return h < 1e-9; }\n", "1e-9 has no name")
        self.accepted('double f(double h) { return 0.5 * h + 2.0 / 3; }  // as 0.37 h\nauto s = "0.37";\n')
        self.accepted("Options Options::paper() {\n  return {0.37};\n}\n")

    def test_pictures_and_samples_are_made_of_numbers(self):
        self.accepted("void f() { line(0.37); }\n", name="src/render/a.cpp")
        self.accepted("constexpr double radius = 0.37;\n", name="src/applications/routes/route_samples.cpp")
        self.refused("constexpr double radius = 0.37;\n", "'radius'", name="src/render/a.cpp")


if __name__ == "__main__":
    unittest.main()
