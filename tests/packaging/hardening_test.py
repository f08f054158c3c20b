#!/usr/bin/env python3
"""What is shipped was compiled and linked to end rather than be misused, and opens no connection. usage: hardening_test.py FILE..."""

import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path


def output(*command):
    return subprocess.run([str(c) for c in command], capture_output=True, text=True, check=True).stdout


def weaknesses(path):
    """What a program or shared library lacks, in words; empty: nothing."""
    headers, dynamic = output("readelf", "-Wl", path), output("readelf", "-Wd", path)
    symbols = output("readelf", "-W", "--dyn-syms", path)
    code = output("objdump", "-d", "--no-show-raw-insn", path)
    stack = re.search(r"GNU_STACK(?:\s+0x\w+){5}\s+(\w+)", headers)
    found = {
        "position independent": "Elf file type is DYN" in headers,
        "RELRO": "GNU_RELRO" in headers,
        "all symbols bound at the start": bool(re.search(r"FLAGS.*\bNOW\b", dynamic)),
        "a stack that is not executable": stack is not None and "E" not in stack[1],
        "no text relocations": "TEXTREL" not in dynamic,
        "the stack protector": "__stack_chk_fail" in symbols,
        "_FORTIFY_SOURCE": bool(re.search(r"__\w+_chk\b", symbols.replace("__stack_chk", ""))),
        "_GLIBCXX_ASSERTIONS": b"__n < this->size()" in path.read_bytes(),
        "marks where indirect jumps may land": code.count("endbr64") > 1000,
        # Larger frames are probed page by page, and none is entered without.
        "stack clash protection": bool(re.search(r"sub\s+\$0x1000,%rsp\s*\n.*or[ql]\s+\$0x0,", code)),
        "no call that opens a connection": not re.search(r"\bUND (socket|connect|getaddrinfo|gethostbyname)\b", symbols),
        "no path of where it was built": not re.search(rb"(/[\w.-]+)+/src/(mesh|io|scene|pipeline)/\w+\.(cpp|h)",
                                                       path.read_bytes()),
    }
    return [name for name, holds in found.items() if not holds]


class HardeningTest(unittest.TestCase):
    def test_what_is_shipped(self):
        for path in FILES:
            with self.subTest(path.name):
                self.assertEqual(weaknesses(path), [])

    def test_weaknesses_are_seen(self):
        with tempfile.TemporaryDirectory() as folder:
            source, program = Path(folder) / "weak.c", Path(folder) / "weak"
            source.write_text("#include <sys/socket.h>\nint main(void) { return socket(AF_INET, SOCK_STREAM, 0); }\n")
            subprocess.run(["cc", "-no-pie", "-fno-stack-protector", "-z", "norelro", "-z", "lazy", "-z", "execstack", source,
                            "-o", program], check=True, capture_output=True)
            seen = weaknesses(program)
        for name in ("position independent", "RELRO", "all symbols bound at the start", "a stack that is not executable",
                     "the stack protector", "_FORTIFY_SOURCE", "_GLIBCXX_ASSERTIONS", "no call that opens a connection"):
            self.assertIn(name, seen)


if __name__ == "__main__":
    FILES = [Path(argument) for argument in sys.argv[1:]]
    unittest.main(argv=sys.argv[:1])
