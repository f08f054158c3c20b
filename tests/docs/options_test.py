#!/usr/bin/env python3
"""The man page has every option that --help has, and no other; pages name no option that does not exist."""

import re
import subprocess
import sys
import unittest

import pages

# Options of other programs that pages name.
OTHERS = {"--build", "--install", "--preset", "--prefix", "--roots", "--strict", "--no-build-isolation", "--system-site-packages",
          "--tests"}


class ManPage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        done = subprocess.run([sys.executable, pages.PROJECT / "tools/man_page.py", pages.PROGRAM],
                              capture_output=True, text=True, check=True)
        cls.source = done.stdout
        text = re.sub(r"\\f[BIR]", "", cls.source).replace("\\-", "-").replace("\\(aq", "'").replace("\\&", "")
        cls.sections = dict(re.findall(r"^\.SH (.*)\n((?:(?!\.SH).*\n?)*)", text, re.M))

    def options_of(self, section):
        heads = re.findall(r"^\.TP\n(-.*)$", self.sections[section], re.M)
        return {word.strip(",") for head in heads for word in head.split() if word.startswith("-")}

    def test_options(self):
        self.assertEqual(self.options_of("OPTIONS"), pages.options(pages.help_text()))
        for command in pages.commands():
            with self.subTest(command=command):
                expected = pages.options(pages.help_text(command))
                self.assertGreater(len(expected), 4)
                self.assertEqual(self.options_of(f"UNSNARL {command.upper()}"), expected)

    def test_nothing_that_help_says_is_lost(self):
        words = " ".join(" ".join(self.sections.values()).replace("\\e", "\\").split())
        for command in pages.commands():
            for line in pages.help_text(command).splitlines():
                for part in re.split(r"  +", line.strip()):
                    if not part.startswith(("-", "Usage")) and not part.endswith(":"):
                        self.assertIn(" ".join(part.split()), words)

    def test_exit_codes(self):
        listed = re.findall(r"^\.TP\n(\d+)$", self.sections["EXIT STATUS"], re.M)
        header = (pages.PROJECT / "include/unsnarl/exit_code.h").read_text()
        self.assertEqual(listed, re.findall(r"^  exit_\w+ = (\d+),", header, re.M))

    def test_groff_has_no_complaint(self):
        try:
            done = subprocess.run(["groff", "-man", "-ww", "-Tutf8", "-z"], input=self.source, capture_output=True, text=True)
        except FileNotFoundError:
            self.skipTest("groff is not installed")
        self.assertEqual(done.stderr, "")


class Pages(unittest.TestCase):
    def test_options_exist(self):
        known = set(OTHERS)
        for command in (None, *pages.commands()):
            known |= pages.options(pages.help_text(command))
        for page in pages.PAGES:
            for line in pages.code(page):
                if not re.match(r"(\$ )?(unsnarl|-)", line.strip()):
                    continue
                for option in re.findall(r"(?<![\w-])--[a-z][a-z-]*(?![\w.-])", line):
                    with self.subTest(page=pages.name(page)):
                        self.assertIn(option, known)


if __name__ == "__main__":
    unittest.main()
