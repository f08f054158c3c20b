#!/usr/bin/env python3
"""The version and its release date are the same wherever they are told, and a version under work says so."""

import re
import subprocess
import unittest

import pages

VERSION = pages.ABOUT["version"]
NUMBER = VERSION.removesuffix(".dev")
DATE = r"\d{4}-\d\d-\d\d"


def cited(key):
    """Values of a key of CITATION.cff, of the software first."""
    return re.findall(rf"^ *(?:- )?{key}: \"?(.*?)\"?$", (pages.PROJECT / "CITATION.cff").read_text(), re.M)


def bibtex():
    """[{field: value}] of the entries that docs/paper.md shows."""
    (block,) = pages.blocks(pages.PROJECT / "docs/paper.md", "bibtex")
    return [dict(re.findall(r"(\w+) *= \{+(.*?)\}+,?\n", entry)) for entry in block.split("@")[1:]]


class Version(unittest.TestCase):
    def test_the_program_tells_it(self):
        said = subprocess.run([pages.PROGRAM, "--version"], capture_output=True, text=True).stdout
        self.assertEqual(said, f"unsnarl {VERSION}\n")

    def test_the_changelog_begins_with_it(self):
        heads = re.findall(r"^## \[(\d\S*)\] - (.*)$", (pages.PROJECT / "CHANGELOG.md").read_text(), re.M)
        self.assertEqual(heads[0][0], NUMBER)
        self.assertRegex(heads[0][1], f"^{DATE}$" if VERSION == NUMBER else "^not released yet$")

    def test_citations_name_it(self):
        software, paper = bibtex()
        self.assertEqual(cited("version"), [VERSION])
        self.assertEqual(software["version"], VERSION)
        self.assertEqual([software["title"], paper["title"]], cited("title"))
        names = list(zip(cited("given-names"), cited("family-names")))
        self.assertEqual(paper["author"], " and ".join(f"{last}, {first}" for first, last in names))
        self.assertEqual(len(cited("date-released")), VERSION == NUMBER)

    def test_packages_are_called_by_it(self):
        spellings = {VERSION, VERSION.replace(".dev", "~dev"), VERSION.replace(".dev", ".dev0")}  # of Debian, of Python
        named = [name for page in pages.PAGES for name in
                 re.findall(r"unsnarl(?:-dev)?[-_](\d+\.\d+\.[\w.~]*?)(?=_amd64|-linux|-py3|/bin|\.tar)", page.read_text())]
        self.assertGreater(len(named), 4)
        self.assertLessEqual(set(named), spellings)


if __name__ == "__main__":
    unittest.main()
