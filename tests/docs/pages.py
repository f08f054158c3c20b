"""The project's pages, and what is in them."""

import json
import os
import re
import subprocess
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("UNSNARL_PROGRAM", str(PROJECT / "build/release/unsnarl"))
ABOUT = json.loads((PROJECT / "cmake/project.json").read_text())  # version and address
PAGES = [PROJECT / "README.md", PROJECT / "CONTRIBUTING.md", PROJECT / "SECURITY.md", *sorted((PROJECT / "docs").glob("*.md"))]

FENCE = re.compile(r"^```(\w*)\n(.*?)^```$", re.M | re.S)
INDENTED = re.compile(r"(?:^    .*\n)+", re.M)
INLINE = re.compile(r"`([^`\n]+)`")


def name(page):
    return str(page.relative_to(PROJECT))


def prose(page):
    """The page without its blocks of code."""
    return INDENTED.sub("", FENCE.sub("", page.read_text()))


def blocks(page, language):
    return [block for kind, block in FENCE.findall(page.read_text()) if kind == language]


def code(page):
    """All that is set as code, block or inline, one line each."""
    text = page.read_text()
    lines = [line for _, block in FENCE.findall(text) for line in block.splitlines()]
    lines += [line for block in INDENTED.findall(FENCE.sub("", text)) for line in block.splitlines()]
    return lines + INLINE.findall(prose(page))


def help_text(command=None):
    arguments = [PROGRAM, *([command] if command else []), "--help"]
    return subprocess.run(arguments, capture_output=True, text=True, check=True).stdout


def commands():
    """The commands of the program."""
    return re.findall(r"^  ([\w-]+)", help_text().split("Commands:")[1].split("\n\n")[0], re.M)


def options(help):
    """All names of options that a help text explains, short ones too."""
    heads = re.findall(r"^  (-\S+)", help, re.M)
    return {name for head in heads for name in head.split(",")}
