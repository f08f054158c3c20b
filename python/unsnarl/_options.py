"""Options as users give them, made into the struct of the library, or refused."""

from __future__ import annotations

import ctypes
import operator
from ctypes import c_char_p, c_double, c_int32, c_size_t
from typing import Any

import numpy as np

from ._library import OptionsStruct, check, library

#: Options that the command line calls otherwise.
PROGRAM_NAMES = {"each_component": "--each"}

_LARGEST_COUNT = np.iinfo(np.int32).max
_COUNTS = {"threads", "views", "handles", "points", "paper_memory", "paper_iterations"}


def options_of(**given: Any) -> OptionsStruct:
    """The struct of all options with these set, by their names."""
    options = OptionsStruct()
    check(library.unsnarl_options_init(ctypes.byref(options), ctypes.c_size_t(options.size)))
    for option, value in given.items():
        setattr(options, option, _CHECKS[option](option, value))
    return options


def paper_options(paper: Any) -> dict[str, Any]:
    """The options that `paper` stands for: a bool, or settings by their names without "paper_"."""
    if not isinstance(paper, dict):
        return {"paper": paper}
    known = [name[len("paper_") :] for name, _ in OptionsStruct._fields_ if name.startswith("paper_")]
    for name in paper:
        if name not in known:
            raise ValueError(f"paper has no setting {name!r}; there are: {', '.join(known)}")
    return {"paper": True, **{f"paper_{name}": value for name, value in paper.items()}}


def name_of(option: str, value: Any) -> bytes:
    if not isinstance(value, str):
        raise TypeError(f"{option} is {value!r}; give its name, a string")
    return value.encode("utf-8", "replace")


def not_negative(option: str, value: Any) -> float:
    """A finite number from 0 on."""
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise TypeError(f"{option} is {value!r}; give a number") from None
    if not 0 <= number < np.inf:
        raise ValueError(f"{option} is {value!r}; give a number from 0 on")
    return number


def count(option: str, value: Any) -> int:
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{option} is {value!r}; give a whole number") from None
    if not 0 <= number <= _LARGEST_COUNT:
        wanted = "0 for as many as the machine has, or their number" if option == "threads" else "a number from 0 on"
        raise ValueError(f"{option} is {number}; give {wanted}")
    return number


def flag(_: str, value: Any) -> bool:
    return bool(value)


def _check_of(option: str, kind: Any) -> Any:
    if option in _COUNTS:
        return count
    return {c_char_p: name_of, c_double: not_negative, c_int32: flag, c_size_t: count}[kind]


_CHECKS = {option: _check_of(option, kind) for option, kind in OptionsStruct._fields_}
