#!/usr/bin/env python3
"""The site builds without a warning, holds every page, and its pages load nothing from the network."""

import json
import os
import subprocess
import sys
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path

import pages

SKIPPED = 77
LOADS = {"script": "src", "img": "src", "link": "href", "iframe": "src", "source": "src", "video": "src"}


class Loads(HTMLParser):
    """Collects what a browser fetches for a page by itself."""

    def __init__(self, text):
        super().__init__()
        self.found = []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        value = dict(attributes).get(LOADS.get(tag, ""))
        if value and dict(attributes).get("rel") != "canonical":
            self.found.append(value)


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.site = Path(cls.folder.name) / "site"
        cls.built = subprocess.run(["mkdocs", "build", "--strict", "--site-dir", cls.site], cwd=pages.PROJECT,
                                   env={**os.environ, "UNSNARL_PROGRAM": pages.PROGRAM},
                                   capture_output=True, text=True)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_it_builds(self):
        self.assertEqual(self.built.returncode, 0, self.built.stderr)
        for page in (pages.PROJECT / "docs").glob("*.md"):
            self.assertTrue((self.site / page.with_suffix(".html").name).exists(), page.name)

    def test_nothing_comes_from_the_network(self):
        for page in self.site.rglob("*.html"):
            for address in Loads(page.read_text()).found:
                with self.subTest(page=page.name):
                    self.assertNotRegex(address, r"^(\w+:)?//")
                    if page.name != "404.html":  # which is for servers, and has addresses from their root
                        self.assertTrue((page.parent / address.partition("?")[0]).exists(), address)
        for sheet in self.site.rglob("*.css"):
            self.assertNotRegex(sheet.read_text(), r"(@import|url\()\s*[\"']?(\w+:)?//")

    def test_every_page_can_be_searched(self):
        text = (self.site / "assets/search_index.js").read_text()
        sections = json.loads(text[text.index("["):text.rindex(";")])
        for page, anchor, title, _ in sections:
            self.assertIn(f'id="{anchor}"', (self.site / page).read_text(), title)
        self.assertEqual({page for page, *_ in sections}, {p.with_suffix(".html").name for p in (pages.PROJECT / "docs").glob("*.md")})
        self.assertTrue(any("--max-displacement" in words for *_, words in sections))
        for page in self.site.glob("*.html"):
            if page.name != "404.html":
                self.assertEqual(page.read_text().count('class="site-search"'), 1, page.name)
        self.assertIn(".site-search", (self.site / "assets/colours.css").read_text())

    def test_what_is_put_in_is_there(self):
        text = (self.site / "command_line.html").read_text()
        for option in pages.options(pages.help_text("fix")):
            self.assertIn(f"<code>{option}</code>", text)
        self.assertIn("find_intersections(surface)", (self.site / "cpp.html").read_text())
        for page in self.site.glob("*.html"):
            self.assertNotRegex(page.read_text(), r"<!-- (options|code):")
            self.assertNotIn("&lt;!-- ", page.read_text())


if __name__ == "__main__":
    if subprocess.run(["sh", "-c", "command -v mkdocs"], capture_output=True).returncode != 0:
        print("skipped: mkdocs is not installed (Debian's package mkdocs); ./test installs it")
        sys.exit(SKIPPED)
    unittest.main()
