#!/usr/bin/env python3
"""The list of experiments is numbered, short, and has every number that a comment cites ([E17])."""

import re
import unittest

import pages

ROWS = [line for line in (pages.PROJECT / "docs/experiments.md").read_text().splitlines() if line.startswith("| E")]
LONGEST_ROW = 165  # characters: a line of a wide screen


class Experiments(unittest.TestCase):
    def test_numbers_follow_each_other(self):
        self.assertEqual([row.split("|")[1].strip() for row in ROWS], [f"E{k + 1}" for k in range(len(ROWS))])

    def test_a_row_fits_a_line_of_the_screen(self):
        for row in ROWS:
            with self.subTest(row=row[:20]):
                self.assertLessEqual(len(row), LONGEST_ROW)
                self.assertEqual(row.count("|"), 6)

    def test_numbers_that_comments_cite_are_there(self):
        for folder in ("src", "include", "apps"):
            for file in (pages.PROJECT / folder).rglob("*.[ch]*"):
                for number in re.findall(r"\[E(\d+)\]", file.read_text(errors="replace")):
                    with self.subTest(file=str(file.relative_to(pages.PROJECT))):
                        self.assertTrue(1 <= int(number) <= len(ROWS), f"there is no entry E{number}")


if __name__ == "__main__":
    unittest.main()
