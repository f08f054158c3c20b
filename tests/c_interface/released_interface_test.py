#!/usr/bin/env python3
"""What a released unsnarl.h declared is in today's: functions as they were, structs with new fields only at their end.

  released_interface_test.py          compares with released_interface.json
  released_interface_test.py --add    writes that file for today's header, as a release does
"""

import json
import re
import sys
from pathlib import Path

HEADER = Path(__file__).resolve().parents[2] / "include/unsnarl/unsnarl.h"
RELEASED = Path(__file__).with_name("released_interface.json")


def interface(text):
    """{"functions": {name: declaration}, "structs": {name: [field]}, "numbers": {name: value}} of a header."""
    text = re.sub(r"/\*.*?\*/|//[^\n]*", "", text, flags=re.S)
    functions = {name: " ".join(line.split()) for line, name in re.findall(r"UNSNARL_EXPORT ([^;]*?(unsnarl_\w+)\([^;]*\));", text)}
    structs = {name: [" ".join(field.split()) for field in body.split(";") if field.strip()]
               for body, name in re.findall(r"typedef struct \w*\s*\{(.*?)\}\s*(\w+);", text, re.S)}
    return {"functions": functions, "structs": structs, "numbers": dict(re.findall(r"(UNSNARL_\w+) = (\d+)", text))}


def changes(released, today):
    """What is gone or different, a line each."""
    found = [f"{name}: {today[kind].get(name, 'gone')}" for kind in ("functions", "numbers") for name, was in released[kind].items()
             if today[kind].get(name) != was]
    return found + [f"{name}: other fields, or another order" for name, fields in released["structs"].items()
                    if today["structs"].get(name, [])[:len(fields)] != fields]


def main():
    today = interface(HEADER.read_text())
    if sys.argv[1:] == ["--add"]:
        RELEASED.write_text(json.dumps(today, indent=1) + "\n")
        return
    released = json.loads(RELEASED.read_text())
    assert len(released["functions"]) > 30 and released["structs"]["unsnarl_options"]
    for name, fields in released["structs"].items():  # a field that moves is seen
        assert changes(released, {**today, "structs": {**today["structs"], name: ["int new", *fields]}})
    if found := changes(released, today):
        sys.exit("programs that were built for a released version would not run:\n" + "\n".join(found))


if __name__ == "__main__":
    main()
