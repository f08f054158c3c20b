#!/usr/bin/env python3
"""Looks at the tuning constants of src/untangle and src/recover: numbers that name a default of an option or a constexpr,
and those that stand in the code without a name. The named ones have words beside them that say what they are; in
src/untangle each has a sentence of its own, with its unit. usage: check_constants.py PROJECT_DIR [--list]

A field `double step = 0.1;` is one; `bool` flags, the numbers 0 and 1 without meaning of their own (counters, sums),
infinities and values that only say "none" (-1) are not. A table of numbers (a list in braces) counts each number. Of
numbers in the code count those with a decimal point but 0, 0.5, 1 and 2, and in strategies.cpp, which is a table, whole
numbers in lists and of designated fields. The paper's own (PAPER) do not count.
"""
import re
import sys
from pathlib import Path

PAPER = ("paper_untangle.cpp", "RecoverOptions RecoverOptions::paper()")
NUMBER = re.compile(r"(?<![\w.])-?(?:\d+\.\d*(?:[eE][-+]?\d+)?|\d+(?:[eE][-+]?\d+)?)(?![\w.])")
FIELD = re.compile(r"^\s*(?:static\s+|inline\s+)*(?:constexpr\s+)?(?:double|int|Index|std::size_t|PcgOptions|Stop|"
                   r"std::array(?:<[^;=]*>)?)\s+(\w+)\s*(?:=\s*|\{)([^;]*)\}?;(.*)$")
UNIT = re.compile(r"without unit|\b(h|lengths?|edges?|faces|pairs|iterations|steps|sweeps|bisections|rounds|starts|"
                  r"neighbours|vertices|sine|share of)\b", re.IGNORECASE)
STRUCT = re.compile(r"^\s*(?:struct|class)\s+(\w+)")


def fields(path):
    """(line, name, numbers, words beside it, words of its own) of every option and constexpr of a file."""
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
        own = match[3].partition("//")[2] + comment_above(lines, before)
        while before > 0 and FIELD.match(lines[before]):
            before -= 1
        yield number, match[1], len(numbers), match[3].partition("//")[2] + comment_above(lines, before), own


def comment_above(lines, last):
    """The words of the comment that ends in this line."""
    words = []
    while last >= 0 and lines[last].lstrip().startswith("//"):
        words.insert(0, lines[last].strip().lstrip("/< "))
        last -= 1
    return " ".join(words)


def unnamed(path, named):
    """(line, numbers) of every line with numbers in the code that are no field or constexpr (`named`: their lines)."""
    if path.name == PAPER[0]:
        return
    is_paper = False
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        is_paper = line.startswith(PAPER[1]) or is_paper and line != "}"
        code = re.sub(r'"[^"]*"', "", line.split("//")[0])
        if is_paper or number in named:
            continue
        numbers = [n for n in re.findall(r"(?<![\w.])\d+(?:\.\d*(?:[eE][-+]?\d+)?|[eE][-+]?\d+)(?!\w)", code)
                   if float(n) not in (0, 0.5, 1, 2)]
        if path.name == "strategies.cpp":
            lists = " ".join(re.findall(r"\{[^{}]*\}|local\(, \d+", code)) + " ".join(re.findall(r"\w+ = \d+[,;]", code))
            numbers += [n for n in re.findall(r"(?<![\w.])\d+(?![\w.])", lists) if int(n) > 0]
        if numbers:
            yield number, numbers


def main():
    project = Path(sys.argv[1])
    count, bare = 0, []
    for room in ("untangle", "recover"):
        for path in sorted((project / "src" / room).rglob("*.[ch]*")):
            named = set()
            for line, name, numbers, words, own in fields(path):
                count += numbers
                named.add(line)
                if "--list" in sys.argv:
                    print(f"{path.relative_to(project)}:{line}: {name} ({numbers})")
                if not words:
                    bare.append(f"{path}:{line}: '{name}' has no words on its unit and meaning")
                elif room == "untangle" and not UNIT.search(own):
                    bare.append(f"{path}:{line}: '{name}' has no sentence of its own with its unit ('without unit')")
            for line, numbers in unnamed(path, named):
                count += len(numbers)
                if "--list" in sys.argv:
                    print(f"{path.relative_to(project)}:{line}: {', '.join(numbers)}, unnamed")
    for finding in bare:
        print(finding)
    print(f"{count} tuning constants")
    sys.exit(1 if bare or count == 0 else 0)


if __name__ == "__main__":
    main()
