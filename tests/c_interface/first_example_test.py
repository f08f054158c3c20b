#!/usr/bin/env python3
"""The example at the top of the C header compiles as it stands, runs, and says what it promises.

usage: first_example_test.py HEADER INCLUDE_DIR LIBRARY COMPILER"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path


def example(header):
    """The first indented paragraph of the first comment."""
    comment = header[header.index("/*"):header.index("*/")]
    return re.search(r"(?:^ \*   .*\n)+", comment, re.MULTILINE)[0].replace("\n *   ", "\n")[5:]


def main():
    header, include, library, compiler = sys.argv[1:]
    code = example(Path(header).read_text())
    if "unsnarl_repair(" not in code:
        sys.exit("the header's first comment holds no example")
    with tempfile.TemporaryDirectory(prefix="unsnarl-example-") as folder:
        source, program = Path(folder) / "example.c", Path(folder) / "example"
        source.write_text("#include <stdio.h>\n#include <unsnarl/unsnarl.h>\n"
                          f"int main(void) {{\n{code}\n  return 0;\n}}\n")
        subprocess.run([compiler, "-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-I", include, source, library,
                        f"-Wl,-rpath,{Path(library).parent}", "-o", program], check=True)
        said = subprocess.run([program], check=True, capture_output=True, text=True).stdout
    if not re.fullmatch(r"embedded: vertex 3 is at z = -?[\d.e-]+ now\n", said):
        sys.exit(f"it says: {said}")


if __name__ == "__main__":
    main()
