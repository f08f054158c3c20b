#!/usr/bin/env python3
"""Checks that every tuning constant of src/ has a name, a sentence that says what it means, and a unit.

usage: check_constants.py PROJECT_DIR

A tuning constant is a `constexpr` number or array of numbers, or the default of a field of a struct that is called
...Options, ...Settings, ...Constants, ...Stop or ...Strategy. Its comment stands above it or behind it on its line,
belongs to it alone, and ends with its unit:

    /// Newton steps of one call, at most (unit: steps)
    constexpr double most_growth = 10;  // a gap grows by this factor in one round, at most (no unit)

A number that nobody chose (of a file format, of arithmetic, of geometry) says "(fixed by the format)" in that place.
Initialisers without a decimal number but 0 and -1 (other constants, numeric_limits, hexadecimal numbers) are exempt.

A number with a decimal point or an exponent that stands in code without a name is found too, unless it is a whole number
up to 10 or 0.25, 0.5, 0.75 or 1.5, or stands in a function called paper(). Pictures (`DRAWN`) are exempt from this, since
shapes and colours are numbers. Samples are exempt from all of it.
"""
import re
import sys
from pathlib import Path

DRAWN = re.compile(r"src/render/|src/applications/.*(pictures|animation)")
SAMPLES = re.compile(r".*_samples\.cpp$")

UNIT = re.compile(r"\((?:no unit|unit: [^()]+|fixed by [^()]+)\)\.?$")
TYPE = (r"(?:const\s+)?(?:double|float|int|unsigned|char|Index|zip_uint32_t|(?:std::)?u?int(?:max|\d+)_t|std::size_t|"
        r"std::chrono::\w+|PcgOptions|Stop|std::array<(?:std::array<)?(?:double|float|int|Index|std::u?int\d+_t|std::size_t)\b.*?>)")
CONSTEXPR = re.compile(rf"^\s*(?:static |inline )*constexpr {TYPE} (\w+)\s*([={{].*)$")
FIELD = re.compile(rf"^\s*{TYPE} (\w+)\s*([={{].*)$")
STRUCT = re.compile(r"^\s*(?:struct|class)\s+(\w+)[^;]*\{\s*$")
OPTIONS = re.compile(r"(Options|Settings|Constants|Strategy|Stop)$")
STRING = re.compile(r'"(?:[^"\\]|\\.)*"')
NUMBER = re.compile(r"(?<![\w.])(?:\d[\d']*\.?\d*(?:[eE][-+]?\d+)?)(?=[uUlLfF]*(?![\w.]))")
PLAIN = set(range(11)) | {0.25, 0.5, 0.75, 1.5}


def numbers(text):
    """The decimal numbers in `text`, without those in strings and characters."""
    return [float(n.replace("'", "")) for n in NUMBER.findall(STRING.sub('""', text))]


def split_comment(line):
    """(code, comment) of a line."""
    match = re.match(r'((?:[^"/]|"(?:[^"\\]|\\.)*"|/(?!/))*)//(.*)$', line)
    return (match[1], match[2].lstrip("/<! ").strip()) if match else (line, "")


def comment_above(lines, at):
    """The comment that ends in the line before `at`."""
    first = at
    while first > 0 and lines[first - 1].lstrip().startswith("//"):
        first -= 1
    return " ".join(line.lstrip().lstrip("/! ").strip() for line in lines[first:at])


def constants(lines):
    """(first line, last line, name, statement, comment) of every constexpr number and default of an option."""
    structs = []
    at = 0
    while at < len(lines):
        code, comment = split_comment(lines[at])
        if match := STRUCT.match(code):
            structs.append(match[1])
        elif structs and re.match(r"^\s*};", code):
            structs.pop()
        match = CONSTEXPR.match(code) or (structs and OPTIONS.search(structs[-1]) and FIELD.match(code))
        first = at
        if match:
            statement = match[2]
            while ";" not in statement and at + 1 < len(lines):
                at += 1
                code, last_comment = split_comment(lines[at])
                statement += " " + code.strip()
                comment = last_comment or comment
            yield first, at, match[1], statement, comment or comment_above(lines, first)
        at += 1


def named_constants(lines):
    """(first line, last line, what is wrong or None, is exempt) of every constexpr number and default of an option."""
    for first, last, name, statement, comment in constants(lines):
        wrong = None
        if re.search(r",\s*\w+\s*=", re.sub(r"\{[^{}]*\}", "", statement)):
            wrong = f"'{name}' shares its line with another constant: one a line"
        elif not UNIT.search(comment):
            wrong = f"'{name}' has no comment that ends with its unit, as in '... (unit: faces)' or '... (no unit)'"
        elif len(UNIT.sub("", comment).split()) < 3:
            wrong = f"'{name}' has no sentence that says what it means"
        is_exempt = not any(numbers(statement)) or re.match(r"[={]\s*-1\s*}?;", statement)
        yield first, last, None if is_exempt else wrong, is_exempt


def bare_numbers(lines, named):
    """(line, what is wrong) of every line of code with a number that has no name; `named`: lines of constants."""
    is_paper = False
    for at, line in enumerate(lines):
        is_paper = re.search(r"\bpaper\(\) \{$", line) is not None or is_paper and line != "}"
        code, comment = split_comment(line)
        is_described = FIELD.match(code) and UNIT.search(comment or comment_above(lines, at))
        if at in named or is_paper or is_described:
            continue
        bare = [n for n in NUMBER.findall(STRING.sub('""', code))
                if ("." in n or "e" in n.lower()) and float(n.replace("'", "")) not in PLAIN]
        if bare:
            yield at, f"{', '.join(bare)} has no name"


def check(project):
    """Complaints about every file of src/, and the number of its tuning constants."""
    found, count = [], 0
    for path in sorted((project / "src").glob("**/*.[ch]*")):
        place = path.relative_to(project)
        if SAMPLES.match(place.name):
            continue
        lines = path.read_text(encoding="utf-8").splitlines()
        named = set()
        for first, last, wrong, is_exempt in named_constants(lines):
            named.update(range(first, last + 1))
            count += not is_exempt
            if wrong:
                found.append(f"{place}:{first + 1}: {wrong}")
        if not DRAWN.match(place.as_posix()):
            found += [f"{place}:{at + 1}: {wrong}" for at, wrong in bare_numbers(lines, named)]
    return found, count


def main():
    found, count = check(Path(sys.argv[1]))
    for complaint in found:
        print(complaint)
    print(f"{count} tuning constants, {len(found)} complaints")
    sys.exit(1 if found or count == 0 else 0)


if __name__ == "__main__":
    main()
