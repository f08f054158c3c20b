#!/usr/bin/env python3
"""Troubleshooting knows every status, exit code and obstruction, and quotes only messages that the program has."""

import re
import unittest

import pages

PAGE = (pages.PROJECT / "docs/troubleshooting.md").read_text()
LITERAL = re.compile(r'"((?:[^"\\\n]|\\.)*)"')
FROM_CLI11 = {"The following argument was not expected:"}


def enumerators(file, name):
    body = re.search(rf"enum (?:class )?{name}\b[^{{]*\{{(.*?)\}};", (pages.PROJECT / file).read_text(), re.S)[1]
    return re.findall(r"^\s*(\w+)(?: = (\d+))?,", body, re.M)


def literals():
    """All strings in the sources; neighbours are one, as for the compiler."""
    for folder in ("src", "apps"):
        for file in (pages.PROJECT / folder).rglob("*.cpp"):
            for run in re.findall(r'"(?:[^"\\\n]|\\.)*"(?:\s*"(?:[^"\\\n]|\\.)*")*', file.read_text()):
                yield "".join(LITERAL.findall(run)).replace('\\"', '"')


def quoted_messages():
    rows = [line for line in PAGE.splitlines() if line.startswith("| `")]
    yield from (re.match(r"\| `([^`]+)`", row)[1] for row in rows)
    yield from re.findall(r"^> (.*)$", PAGE, re.M)


class Troubleshooting(unittest.TestCase):
    def test_every_ending_has_a_section(self):
        headings = re.findall(r"^### (\S+)$", PAGE, re.M)
        for status, _ in enumerators("include/unsnarl/report.h", "Status"):
            self.assertIn(status, headings)
        for kind, _ in enumerators("include/unsnarl/report.h", "Kind"):
            self.assertIn(kind, headings)

    def test_every_exit_code_is_explained(self):
        codes = {code for _, code in enumerators("include/unsnarl/exit_code.h", "ExitCode")}
        self.assertIn("70", codes)
        self.assertEqual(codes, set(re.findall(r"(?:Exit code |^\| )(\d+)\b", PAGE, re.M)))

    def test_messages_are_the_programs(self):
        all_literals = "\n".join(literals())
        messages = list(quoted_messages())
        self.assertGreater(len(messages), 50)
        for message in messages:
            for part in re.split("…", message):
                part = part.strip(" ()")
                if part and part not in FROM_CLI11:
                    with self.subTest(message=message):
                        self.assertTrue(part in all_literals, f"no source says '{part}'")

    def test_strategies_are_the_programs(self):
        table = (pages.PROJECT / "docs/how_it_works.md").read_text()
        strategies = re.findall(r"`([a-z]+-\d+)`", table)
        source = (pages.PROJECT / "src/untangle/strategies.cpp").read_text()
        self.assertEqual(set(strategies), set(re.findall(r'local\("([a-z]+-\d+)"', source)))


if __name__ == "__main__":
    unittest.main()
