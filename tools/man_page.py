#!/usr/bin/env python3
"""Writes the man page of the program from what its --help says: man_page.py PROGRAM > unsnarl.1"""

import re
import subprocess
import sys

import help_text


def escaped(text):
    text = text.replace("\\", "\\e").replace("-", "\\-").replace("'", "\\(aq")
    return "\\&" + text if text.startswith((".", "\\(aq")) else text


def bold(text):
    return f"\\fB{escaped(text)}\\fR"


def options_in_bold(text):
    return re.sub(r"(?<![\w-])\\-\\-[a-z](?:\w|\\-)*\w", r"\\fB\g<0>\\fR", escaped(text))


def entries(group):
    for entry in group:
        value = f" \\fI{escaped(entry.value)}\\fR" if entry.value else ""
        yield f".TP\n{', '.join(map(bold, entry.names))}{value}\n{options_in_bold(entry.meaning)}"


def note(lines):
    """A paragraph as it is, or, under a heading, lines that keep their columns."""
    heading = help_text.HEADING.match(lines[0])
    if not heading:
        yield ".PP\n" + options_in_bold(" ".join(lines))
        return
    yield f".SS {escaped(heading[1])}\n.nf\n" + "\n".join(escaped(line[2:]) for line in lines[1:]) + "\n.fi"


def exit_status(notes):
    """'Exit codes:' and a line for each."""
    lines = next(lines for lines in notes if lines[0] == "Exit codes:")
    for code, meaning in (line.split(maxsplit=1) for line in lines[1:]):
        yield f".TP\n{bold(code)}\n{escaped(meaning)}"


def man_page(program):
    pages = help_text.read(program)
    own = pages.pop(None)
    version = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout.strip()
    yield f'.TH UNSNARL 1 "" "{version}" "User Commands"'
    yield ".SH NAME\nunsnarl \\- remove self\\-intersections from surface meshes"
    yield ".SH SYNOPSIS"
    for command, page in pages.items():
        yield f"{bold('unsnarl ' + command)} {escaped(page.usage.removeprefix(f'unsnarl {command} '))}\n.br"
    yield ".SH DESCRIPTION\n" + escaped(own.summary)
    yield ".SH OPTIONS"
    yield from entries(own.groups["Options"])
    for command, page in pages.items():
        yield f".SH UNSNARL {command.upper()}\n{escaped(page.summary)}."
        for heading, group in page.groups.items():
            yield f".SS {escaped(heading)}"
            yield from entries(group)
        for lines in page.notes:
            yield from note(lines)
    yield ".SH EXIT STATUS"
    yield from exit_status(own.notes)
    yield ".SH EXAMPLES\n.nf"
    yield from (escaped(line[2:]) for line in next(lines for lines in own.notes if lines[0] == "Examples:")[1:])
    yield ".fi"


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: man_page.py PROGRAM")
    print("\n".join(man_page(sys.argv[1])))
