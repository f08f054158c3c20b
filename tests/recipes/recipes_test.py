#!/usr/bin/env python3
"""Applies the recipes of CONTRIBUTING.md, word for word, to a copy of the sources, and compiles and runs the result.

usage: recipes_test.py BUILD_DIR LIBRARY...

Code blocks with a title are the recipe: ```cpp title="PATH" is a new file, ```diff title="PATH" changes one: lines that
begin with a blank or - stand in the file one after the other, once; those that begin with a blank or + replace them.
What the recipe changes is compiled with the flags of the build, any warning an error, beside a program of this folder,
and takes the place of what the libraries hold of it.
"""
import json
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
COMPILER = re.compile(r"(^|[/-])(g|c|clang)\+\+(-\d+)?$")
BLOCK = re.compile(r'^```(\w+) title="([^"]+)"\n(.*?)^```$', re.MULTILINE | re.DOTALL)


def recipe(name):
    """The text of the recipe that begins with this bold name."""
    text = (PROJECT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    recipes = text[text.index("## Recipes"):text.index("## Style")]
    begin = recipes.index(f"**{name}**")
    end = re.search(r"^\*\*", recipes[begin + 2:], re.MULTILINE)
    return recipes[begin:begin + 2 + end.start()] if end else recipes[begin:]


def changed(text, diff):
    lines = diff.splitlines(keepends=True)
    old = "".join(line[1:] for line in lines if line[0] in " -")
    new = "".join(line[1:] for line in lines if line[0] in " +")
    count = ("\n" + text).count("\n" + old)
    if count != 1:
        raise AssertionError(f"these lines stand {count} times in the file:\n{old}")
    return ("\n" + text).replace("\n" + old, "\n" + new)[1:]


def apply(name, tree):
    """Applies a recipe to a copy of the project. Returns the paths that it changes, in its order."""
    paths = []
    for language, path, content in BLOCK.findall(recipe(name)):
        file = tree / path
        if language == "diff":
            file.write_text(changed(file.read_text(encoding="utf-8"), content), encoding="utf-8")
        else:
            assert not file.exists(), f"{path} exists already"
            file.write_text(content, encoding="utf-8")
        paths.append(path)
    assert paths, f"the recipe '{name}' has no code block with a title"
    return paths


def flags_of(layer, tree):
    """How the build compiles a file of a layer, with the sources of the copy."""
    commands = json.loads((BUILD / "compile_commands.json").read_text(encoding="utf-8"))
    entry = next(e for e in commands if f"unsnarl_{layer}.dir" in e.get("output", e["command"]))
    words, flags = shlex.split(entry["command"]), []
    words = words[next(i for i, word in enumerate(words) if COMPILER.search(word)):]  # not ccache
    skip = False
    for word in words:
        if skip or word in ("-o", "-c", "-MF", "-MT", "-MQ", "-MD", "-MMD") or word == entry["file"]:
            skip = word in ("-o", "-MF", "-MT", "-MQ", "-c")
            continue
        flags.append(word)
    here = str(PROJECT)
    moved = [re.sub(f"{re.escape(here)}/(src|include)$", rf"{tree}/\1", flag) for flag in flags]
    directory = Path(entry["directory"])
    return [re.sub(r"^(-I|-isystem)(\.\.?/.*)", lambda m: relocated(m, directory, tree), flag) for flag in moved]


def relocated(match, directory, tree):
    path = (directory / match[2]).resolve()
    for folder in ("src", "include"):
        if path == PROJECT / folder:
            path = tree / folder
    return f"{match[1]}{path}"


class Recipes(unittest.TestCase):
    def setUp(self):
        if not (BUILD / "compile_commands.json").is_file():
            self.skipTest("the build does not say how it compiles")  # neither Ninja nor make

    def run_recipe(self, name, layer, recompiled=()):
        with tempfile.TemporaryDirectory() as folder:
            tree = Path(folder)
            for part in ("src", "include"):
                shutil.copytree(PROJECT / part, tree / part)
            shutil.copytree(PROJECT / "tests" / "scene", tree / "tests" / "scene")
            paths = apply(name, tree)
            sources = [p for p in paths if p.endswith(".cpp")] + list(recompiled)
            check = subprocess.run([sys.executable, PROJECT / "tests/architecture/check_includes.py", "layers", tree],
                                   capture_output=True, text=True)
            self.assertEqual(check.returncode, 0, check.stdout)
            flags = [*flags_of(layer, tree), f"-I{tree}/tests", "-O0", "-U_FORTIFY_SOURCE", "-Wall", "-Wextra", "-Werror"]
            objects = []
            for source in [*dict.fromkeys(sources), str(PROJECT / "tests/recipes" / f"{name.split()[-1]}.cpp")]:
                objects.append(str(tree / f"{len(objects)}.o"))
                self.call([*flags, "-c", str(tree / source), "-o", objects[-1]])
            program = tree / "program"
            self.call([*flags, *objects, "-Wl,-z,muldefs", *LIBRARIES, "-pthread", "-o", str(program)])
            # Sanitizers: what takes the place of the library's is no mistake.
            self.call(["env", "ASAN_OPTIONS=detect_odr_violation=0", str(program)])

    def call(self, command):
        result = subprocess.run(command, cwd=BUILD, capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, " ".join(map(str, command)) + "\n" + result.stdout + result.stderr)

    def test_format(self):
        self.run_recipe("A format", "io", ["src/io/document.cpp"])

    def test_strategy(self):
        self.run_recipe("A strategy", "untangle")

    def test_reason(self):
        self.run_recipe("A reason", "scene")

    def test_energy(self):
        self.run_recipe("An energy", "recover")


if __name__ == "__main__":
    BUILD, LIBRARIES = Path(sys.argv[1]), sys.argv[2:]
    unittest.main(argv=sys.argv[:1])
