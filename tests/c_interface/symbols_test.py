#!/usr/bin/env python3
"""The shared library shows exactly the functions that its header declares. usage: symbols_test.py LIBRARY HEADER"""

import re
import subprocess
import sys
from pathlib import Path

library, header = sys.argv[1:]
declared = set(re.findall(r"^UNSNARL_EXPORT [^;(]*?(\w+)\(", Path(header).read_text(encoding="utf-8"), re.MULTILINE))
listed = subprocess.run(["nm", "-D", "--defined-only", "--format=posix", library], capture_output=True, text=True,
                        check=True)
exported = {line.split()[0] for line in listed.stdout.splitlines()}
for name in sorted(declared - exported):
    print(f"{name} is declared, but the library does not have it")
for name in sorted(exported - declared):
    print(f"{name} is seen outside of the library, but not declared")
print(f"{len(declared)} functions")
sys.exit(1 if declared != exported or len(declared) < 20 else 0)
