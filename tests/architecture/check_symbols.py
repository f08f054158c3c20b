#!/usr/bin/env python3
"""Checks what the library calls whose results differ between machines, by its symbols.

Elementary functions of the C library differ in the last bit between C libraries: geometry/portable_math.h has those of
the project. Products of large matrices by Eigen add in blocks as large as the processor's cache has them: lazyProduct()
adds in order.

usage: check_symbols.py NM ARCHIVE...
"""

import re
import subprocess
import sys

ELEMENTARY = {"acos", "acosh", "asin", "asinh", "atan", "atan2", "atanh", "cbrt", "cos", "cosh", "erf", "erfc", "exp", "exp10",
              "exp2", "expm1", "hypot", "lgamma", "log", "log10", "log1p", "log2", "pow", "sin", "sincos", "sinh", "tan",
              "tanh", "tgamma"}
BLOCKED = re.compile("general_matrix_matrix")


def findings(lines):
    """Of the lines of `nm`: where a member of the archive begins, or an address, a kind and a name."""
    member = ""
    for line in lines:
        if line.endswith(":"):
            member = line[:-1]
            continue
        words = line.split()
        if len(words) < 2:
            continue
        kind, name = words[-2:]
        if kind == "U" and (name in ELEMENTARY or name[:-1] in ELEMENTARY and name[-1] in "fl"):
            yield f"{member}: calls {name}() of the C library; take portable::{name}() of geometry/portable_math.h"
        if BLOCKED.search(name):
            yield f"{member}: {name} adds in blocks of the size of the cache; take lazyProduct()"


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    lines = subprocess.run(sys.argv[1:], check=True, capture_output=True, text=True).stdout.splitlines()
    if not any(" T " in line for line in lines):
        sys.exit("error: no function is defined there")
    found = list(findings(lines))
    print("\n".join(found))
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
