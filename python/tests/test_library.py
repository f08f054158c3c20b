"""What Python believes of the C interface is what its header says."""

import ctypes
import re
from pathlib import Path

import pytest

from unsnarl import _call, _library

HEADER = (Path(__file__).resolve().parents[2] / "include" / "unsnarl" / "unsnarl.h").read_text()
TYPES = {
    "size_t": ctypes.c_size_t,
    "int32_t": ctypes.c_int32,
    "double": ctypes.c_double,
    "unsnarl_type": ctypes.c_int,
    "const char*": ctypes.c_char_p,
}


def fields(struct):
    body = re.search(rf"typedef struct {struct} {{(.*?)}} {struct};", HEADER, re.DOTALL)[1]
    body = re.sub(r"/\*.*?\*/", "", body, flags=re.DOTALL)
    found = []
    for line in filter(None, (line.strip() for line in body.split(";"))):
        kind, name = re.fullmatch(r"(.*?)\s*(\w+)", line, re.DOTALL).groups()
        found.append((name, TYPES.get(kind, ctypes.c_void_p if kind.endswith("*") else None)))
    return found


@pytest.mark.parametrize("struct", ["surface", "curves", "options", "progress", "array"])
def test_structs(struct):
    ours = getattr(_library, f"{struct.capitalize()}Struct")
    assert ours._fields_ == fields(f"unsnarl_{struct}")


def test_names_of_statuses():
    listed = re.search(r"How the work ended: (.*?);", HEADER, re.DOTALL)[1]
    assert re.findall(r'"(\w+)"', listed) == [status.value for status in _call.Status]


def test_codes_of_errors():
    listed = re.search(r"typedef enum unsnarl_error {(.*?)}", HEADER, re.DOTALL)[1]
    codes = {int(code): name for name, code in re.findall(r"UNSNARL_(\w+) = (\d+)", listed)}
    assert codes[1] == "INVALID_ARGUMENT" and codes[2].startswith("CANNOT") and codes[3].startswith("CANNOT")
    assert set(_library._EXCEPTIONS) == set(codes) - {0, 70}
    with pytest.raises(ValueError, match="'no knot'"):
        _call.call("knot_of_table", b"no knot")
