"""What `unsnarl COMMAND --help` says, as data: the man page and the site are made from it, so they say the same."""

import re
import subprocess
from dataclasses import dataclass, field

HEADING = re.compile(r"^(\S.*):$")
ENTRY = re.compile(r"^  (\S.*?)(?:  +(\S.*))?$")


@dataclass
class Entry:
    """One option, argument or command."""

    names: list  # of an option: ["-o", "--output"]; else one word
    value: str  # "OUT", "NAME ..." or nothing
    meaning: str


@dataclass
class Help:
    summary: str  # what stands before the usage
    usage: str
    groups: dict = field(default_factory=dict)  # heading: entries
    notes: list = field(default_factory=list)  # what stands behind the options: paragraphs, lists of lines


def help_text(program, command=None):
    arguments = [program, *([command] if command else []), "--help"]
    return subprocess.run(arguments, capture_output=True, text=True, check=True).stdout


def entry_of(head):
    words = head.split(" ", 1)
    return Entry(words[0].split(","), words[1] if len(words) > 1 else "", "")


def parse(text):
    before, usage, after = re.split(r"^Usage: (.*)$", text, maxsplit=1, flags=re.M)
    result = Help(" ".join(before.split()), usage)
    paragraphs = [block.splitlines() for block in re.split(r"\n\s*\n", after.strip("\n"))]
    for lines in paragraphs:
        heading = HEADING.match(lines[0])
        if heading and not result.notes and not heading[1].startswith(("Examples", "Classes")):
            group = result.groups.setdefault(heading[1], [])
            for line in lines[1:]:
                if line.startswith("  ") and line[2] != " ":
                    head, meaning = ENTRY.match(line).groups()
                    group.append(entry_of(head))
                    group[-1].meaning = meaning or ""
                else:
                    group[-1].meaning += " " + line.strip()
        else:
            result.notes.append(lines)
    for group in result.groups.values():
        for entry in group:
            entry.meaning = entry.meaning.strip()
    return result


def read(program):
    """{None: the program's own help, "fix": ..., ...} for every command that the program has."""
    own = parse(help_text(program))
    commands = [entry.names[0] for entry in own.groups["Commands"]]
    return {None: own, **{command: parse(help_text(program, command)) for command in commands}}
