#!/usr/bin/env python3
"""The sessions that pages show (```console) run, and say what the page says: the same words and counts. Lengths, shares
and angles may differ a little, as they do between machines; seconds and memory may be any."""

import os
import re
import subprocess
import tempfile
import unittest
from decimal import Decimal
from pathlib import Path

import pages

NUMBER = r"\d+(?:\.\d+)?(?:e[-+]?\d+)?"
# Numbers are of three kinds: the machine and the moment decide some, some were measured, all others are counts and names.
KINDS = re.compile(rf"(?P<any>{NUMBER}(?= s\b| MB\b| a second\b)|(?<=residual){NUMBER}|(?<=at vertex)\d+)"
                   rf"|(?P<measured>\d+\.\d+(?:e[-+]?\d+)?|\d+(?= %| degrees\b))|\d+")
PROGRESS = re.compile(r"[a-z]+ +\d+ %   .* s")  # what a slow machine says every 30 seconds
TOLERANCE = 0.1  # share of a measured number by which it may differ; else by one in its last digit


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


def unaligned(line):
    """The line without the blanks before numbers, of which columns have more or fewer."""
    return re.sub(r"\s+(?=\d)", "", line)


def pattern(lines):
    """What matches the lines, with a group for each measured number and anything where the page has '...'; and these
    numbers."""
    regex, measured = "", []
    for line in map(unaligned, lines):
        if line == "...":
            regex += r"(?:.*\n)*?"
            continue
        end = 0
        for number in KINDS.finditer(line):
            regex += re.escape(line[end:number.start()])
            if number["measured"]:
                measured.append(number[0])
            regex += f"({NUMBER})" if number["measured"] else NUMBER if number["any"] else rf"{number[0]}(?!\d)"
            end = number.end()
        regex += re.escape(line[end:]) + r"\n"
    return regex, measured


def is_near(shown, said):
    last_digit = 10.0 ** Decimal(shown).as_tuple().exponent
    return abs(float(said) - float(shown)) <= max(TOLERANCE * float(shown), 1.01 * last_digit)


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
                        said = "".join(unaligned(line) + "\n" for line in done.stdout.splitlines() if not PROGRESS.fullmatch(line))
                        regex, measured = pattern(shown)
                        self.assertRegex(said, rf"\A{regex}\Z")
                        for there, here in zip(measured, re.match(rf"{regex}\Z", said).groups()):
                            self.assertTrue(is_near(there, here), f"the page says {there}, the program {here}")
                        tried += 1
        self.assertGreater(tried, 10)


if __name__ == "__main__":
    unittest.main()
