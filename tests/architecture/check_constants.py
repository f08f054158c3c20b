#!/usr/bin/env python3
"""Counts the tuning constants of src/untangle and src/recover: numbers that name a default of an option or a constexpr.
There may be no more than MOST, which rises only for what a measurement defends, and each has words beside it that say
what it is. usage: check_constants.py PROJECT_DIR

A field `double step = 0.1;` is one; `bool` flags, the numbers 0 and 1 without meaning of their own (counters, sums),
infinities and values that only say "none" (-1) are not. A table of numbers (a list in braces) counts each number.
"""
import re
import sys
from pathlib import Path

MOST = 80
NUMBER = re.compile(r"(?<![\w.])-?(?:\d+\.\d*(?:[eE][-+]?\d+)?|\d+(?:[eE][-+]?\d+)?)(?![\w.])")
FIELD = re.compile(r"^\s*(?:static\s+|inline\s+)*(?:constexpr\s+)?(?:double|int|Index|std::size_t|PcgOptions|Stop|"
                   r"std::array<[^;=]*>)\s+(\w+)\s*(?:=\s*|\{)([^;]*)\}?;(.*)$")
STRUCT = re.compile(r"^\s*(?:struct|class)\s+(\w+)")


def fields(path):
    """(line, name, numbers, has words) of every option and constexpr of a file."""
    lines = path.read_text(encoding="utf-8").splitlines()
    structs = []  # that the line is in, the innermost last
    for number, line in enumerate(lines, 1):
        if (match := STRUCT.match(line)) and "{" in line and "}" not in line:
            structs.append(match[1])
        if structs and re.match(r"^\s*};", line):
            structs.pop()
        match = FIELD.match(line)
        is_option = structs and re.search(r"(Options|Settings|Strategy)$", structs[-1])
        if not match or not (is_option or "constexpr" in line):
            continue
        numbers = [n for n in NUMBER.findall(match[2]) if float(n) not in (0, -1) or "constexpr double" in line]
        if not numbers:
            continue
        before = number - 2
        while before > 0 and FIELD.match(lines[before]):
            before -= 1
        has_words = "//" in match[3] or lines[before].lstrip().startswith("//")
        yield number, match[1], len(numbers), has_words


def main():
    project = Path(sys.argv[1])
    count, bare = 0, []
    for room in ("untangle", "recover"):
        for path in sorted((project / "src" / room).glob("*.[ch]*")):
            for line, name, numbers, has_words in fields(path):
                count += numbers
                if "--list" in sys.argv:
                    print(f"{path.relative_to(project)}:{line}: {name} ({numbers})")
                if not has_words:
                    bare.append(f"{path}:{line}: '{name}' has no words on its unit, meaning and measurement")
    for finding in bare:
        print(finding)
    print(f"{count} tuning constants, {MOST} at most")
    sys.exit(1 if bare or count > MOST or count == 0 else 0)


if __name__ == "__main__":
    main()
