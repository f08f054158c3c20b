#!/usr/bin/env python3
"""The sessions that pages show (```console) run, and say what the page says: the same words, though other numbers."""

import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

import pages

NUMBER = re.compile(r"\d[\d.]*(?:e[-+]?\d+)?")


def session(page):
    """[(command, [lines that it prints])] of all sessions of a page, in one folder one after the other."""
    steps = []
    for block in pages.blocks(page, "console"):
        for line in block.splitlines():
            if line.startswith("$ "):
                steps.append((line[2:], []))
            else:
                steps[-1][1].append(line)
    return steps


def pattern(lines):
    """What matches the lines with any numbers, and anything where the page has '...'."""
    regex = [r"(?:.*\n)*?" if line == "..." else r"\s*[\d.e+-]+".join(map(re.escape, NUMBER.split(line))) + r"\n"
             for line in (re.sub(r"\s+(?=\d)", "", line) for line in lines)]
    return "".join(regex)


class Commands(unittest.TestCase):
    def test_sessions(self):
        tried = 0
        for page in pages.PAGES:
            with tempfile.TemporaryDirectory() as folder:
                os.symlink(pages.PROGRAM, Path(folder) / "unsnarl")
                environment = {**os.environ, "PATH": f"{folder}:{os.environ['PATH']}"}
                last = 0
                for command, shown in session(page):
                    with self.subTest(page=pages.name(page), command=command):
                        if command == "echo $?":
                            self.assertEqual(shown, [str(last)])
                            continue
                        done = subprocess.run(["sh", "-c", command], cwd=folder, env=environment, text=True,
                                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
                        last = done.returncode
                        said = "".join(re.sub(r"\s+(?=\d)", "", line) + "\n" for line in done.stdout.splitlines())
                        self.assertRegex(said, rf"\A{pattern(shown)}\Z")
                        tried += 1
        self.assertGreater(tried, 10)


if __name__ == "__main__":
    unittest.main()
