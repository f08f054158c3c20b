#!/usr/bin/env python3
"""Links between pages lead somewhere: files exist, headings exist, every page of docs/ is in the site."""

import re
import unittest

import pages

LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")


def anchors(page):
    """Headings as mkdocs names them."""
    headings = re.findall(r"^#+ (.*)$", pages.FENCE.sub("", page.read_text()), re.M)
    words = [re.sub(r"[^\w\s-]", "", heading.replace("`", "")).strip().lower() for heading in headings]
    return {re.sub(r"[-\s]+", "-", word) for word in words}


class Links(unittest.TestCase):
    def test_links_lead_somewhere(self):
        for page in pages.PAGES:
            for link in LINK.findall(pages.prose(page)):
                if re.match(r"[a-z]+:", link):
                    continue
                with self.subTest(page=pages.name(page), link=link):
                    path, _, anchor = link.partition("#")
                    target = (page.parent / path).resolve() if path else page
                    self.assertTrue(target.exists(), "no such file")
                    if anchor:
                        self.assertIn(anchor, anchors(target))

    def test_pictures_are_shown_somewhere(self):
        text = "".join(page.read_text() for page in pages.PAGES)
        for picture in (pages.PROJECT / "docs/images").iterdir():
            self.assertIn(f"images/{picture.name}", text)


if __name__ == "__main__":
    unittest.main()
