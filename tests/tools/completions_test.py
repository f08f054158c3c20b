#!/usr/bin/env python3
"""Shells complete commands, options and choices of the program. usage: completions_test.py PROGRAM"""

import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOOLS = Path(__file__).resolve().parents[2] / "tools"
sys.path.insert(0, str(TOOLS))
import help_text  # noqa: E402
PROGRAM = sys.argv.pop(1)

# Types a line into an interactive shell and presses tab; what it lists comes out.
ZSH = """
zmodload zsh/zpty
zpty shell zsh -f -i
zpty -w shell 'PS1=; unsetopt beep; LISTMAX=1000; stty columns 200 rows 500; fpath=({folder} $fpath); autoload -U compinit; compinit -D -u;
  zstyle ":completion:*" list-prompt ""; echo rea''dy'
zpty -r shell out '*ready*'
zpty -n -w shell $'{line}\\t\\t'
for i in {{1..20}}; do sleep 0.1; while zpty -r -t shell out; do print -rn -- $out; done; done
zpty -d shell
"""


def script(shell):
    made = subprocess.run([sys.executable, "-B", TOOLS / "completions.py", shell, PROGRAM], capture_output=True,
                          text=True, check=True)
    return made.stdout


def output(shell, *arguments):
    done = subprocess.run([shell, *arguments], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    return done.stdout


class Completions(unittest.TestCase):
    def bash(self, *words):
        quoted = " ".join(f"'{word}'" for word in words)
        return output("bash", "--norc", "-c", f"compopt() {{ :; }}\n{script('bash')}\n"
                      f"COMP_WORDS=({quoted}); COMP_CWORD={len(words) - 1}; _unsnarl; echo \"${{COMPREPLY[@]}}\"").split()

    def test_every_option_has_a_meaning(self):
        for command, text in help_text.read(PROGRAM).items():
            for entries in text.groups.values():
                for entry in entries:
                    self.assertTrue(entry.meaning, f"{command}: {entry.names}")
                    self.assertLess(len(entry.value.split()), 4, f"{command}: {entry.names}")

    def test_bash(self):
        self.assertIn("seifert", self.bash("unsnarl", ""))
        self.assertEqual(self.bash("unsnarl", "f"), ["fix"])
        self.assertEqual(self.bash("unsnarl", "fix", "a.obj", "--preci"), ["--precision"])
        self.assertEqual(self.bash("unsnarl", "fix", "--precision", "f"), ["float32", "float64"])
        self.assertEqual(self.bash("unsnarl", "check", "--preci"), [])
        self.assertEqual(self.bash("unsnarl", "fix", "a"), [])  # files, by bash itself

    def test_fish(self):
        if not shutil.which("fish"):
            self.skipTest("fish is not installed")

        def fish(line):
            listed = output("fish", "--no-config", "-c", f"{script('fish')}\ncomplete -C {line!r}")
            return [row.split("\t")[0] for row in listed.splitlines()]

        self.assertEqual(fish("unsnarl f"), ["fix"])
        self.assertEqual(fish("unsnarl fix --preci"), ["--precision"])
        self.assertEqual(fish("unsnarl fix --precision "), ["auto", "float32", "float64"])
        self.assertEqual(fish("unsnarl check --preci"), [])

    def test_zsh(self):
        if not shutil.which("zsh"):
            self.skipTest("zsh is not installed")
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "_unsnarl").write_text(script("zsh"))

            def zsh(line):
                return output("zsh", "-f", "-c", ZSH.format(folder=folder, line=line))

            listed = zsh("unsnarl ")
            self.assertIn("seifert", listed)
            self.assertIn("Repair a mesh", listed)
            self.assertIn("--precision", zsh("unsnarl fix --preci"))
            self.assertIn("float64", zsh("unsnarl fix --precision "))


if __name__ == "__main__":
    unittest.main()
