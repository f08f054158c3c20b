#!/usr/bin/env python3
"""The check of symbols finds what it forbids, and nothing else. usage: check_symbols_test.py"""

import unittest

from check_symbols import findings


class Symbols(unittest.TestCase):
    def test_elementary_functions_of_the_c_library_are_found(self):
        for name in ("exp", "powf", "atan2", "sinl"):
            self.assertEqual(len(list(findings(["a.o:", f"                 U {name}"]))), 1, name)

    def test_what_is_rounded_in_one_way_is_left_alone(self):
        for line in ("U sqrt", "U fmod", "U remainder", "U logger", "U sinking", "0000000000000000 T exp"):
            self.assertEqual(list(findings(["a.o:", line])), [], line)

    def test_blocked_products_are_found(self):
        line = "0000000000000000 W _ZN5Eigen8internal29general_matrix_matrix_productIldLi0ELb0EdLi1ELb0ELi0ELi1EE3runE"
        self.assertEqual(len(list(findings(["a.o:", line]))), 1)


if __name__ == "__main__":
    unittest.main()
