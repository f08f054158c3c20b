#!/usr/bin/env python3
"""The project's address stands in cmake/project.json alone, and nobody is asked to report anything where there is none."""

import re
import unittest
from pathlib import Path

import pages

SOURCES = [path for folder in ("apps", "src", "include", "python", "docs", "viewer/src", "cmake", "packaging", "tools")
           for path in sorted((pages.PROJECT / folder).rglob("*"))
           if path.suffix in (".cpp", ".h", ".md", ".py", ".js", ".cmake", ".in", "") and path.is_file()]
SOURCES += [pages.PROJECT / name for name in ("README.md", "demo", "test", "setup.py", "pyproject.toml", "mkdocs.yml")]
# The one place that knows whether there is an address.
KNOWS = pages.PROJECT / "apps/unsnarl/version.cpp"
ASKS = re.compile(r"please report|report (it|them|this) (at|to|as|in)|file an issue|issue tracker|bug tracker", re.I)


class Address(unittest.TestCase):
    def test_nothing_asks_for_reports_to_nowhere(self):
        asking = [str(path) for path in SOURCES if path != KNOWS and ASKS.search(path.read_text(errors="replace"))]
        self.assertEqual(asking, [])
        self.assertRegex(KNOWS.read_text(), r"homepage\.empty\(\)")

    def test_the_address_is_in_one_place(self):
        address = pages.ABOUT["homepage"]
        holding = [str(path) for path in SOURCES if address and address in path.read_text(errors="replace")]
        self.assertEqual(holding, [])

    def test_readme_offers_only_what_the_tree_has(self):
        readme = (pages.PROJECT / "README.md").read_text()
        self.assertEqual(re.findall(r"\S+\.(?:deb|whl|tar\.gz)\b", readme), [])
        self.assertLess(readme.index("./demo"), readme.index("packaging/build_packages"))


if __name__ == "__main__":
    unittest.main()
