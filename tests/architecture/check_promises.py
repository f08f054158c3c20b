#!/usr/bin/env python3
"""Checks that every test that docs/promises.md names exists. usage: check_promises.py PROJECT_DIR"""
import re
import sys
from pathlib import Path

project = Path(sys.argv[1])
text = (project / "docs" / "promises.md").read_text(encoding="utf-8")
named = set(re.findall(r"`([A-Z]\w+\.\w+)`", text))
there = set()
for source in (project / "tests").rglob("*_test.cpp"):
    there |= {f"{suite}.{name}" for suite, name in
              re.findall(r"^TEST(?:_F|_P)?\((\w+),\s*(\w+)\)", source.read_text(encoding="utf-8"), re.MULTILINE)}
missing = sorted(named - there)
for name in missing:
    print(f"docs/promises.md: there is no test {name}")
print(f"{len(named)} tests named")
sys.exit(1 if missing or not named else 0)
