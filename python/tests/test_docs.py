"""The examples in docs/python.md do what they show; every public name is documented."""

import doctest
import inspect
from pathlib import Path

import pytest

import unsnarl

DOCS = Path(__file__).resolve().parents[2] / "docs" / "python.md"


def test_examples_of_the_page():
    failed, tried = doctest.testfile(str(DOCS), module_relative=False)
    assert tried > 10 and failed == 0


@pytest.mark.parametrize("name", unsnarl.__all__)
def test_docstrings(name):
    documented = getattr(unsnarl, name)
    assert inspect.getdoc(documented)
    if inspect.isfunction(documented):
        for parameter in inspect.signature(documented).parameters:
            assert parameter in documented.__doc__, parameter
