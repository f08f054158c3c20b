"""The notebook of examples/ runs from its first cell to its last, as Jupyter would run it."""

import json
from pathlib import Path

import pytest

NOTEBOOK = Path(__file__).resolve().parents[2] / "examples" / "repair.ipynb"


def test_notebook(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    notebook = json.loads(NOTEBOOK.read_text())
    assert notebook["nbformat"] == 4 and notebook["metadata"]["kernelspec"]["language"] == "python"
    shown = []
    names = {"__name__": "__main__", "display": shown.append}
    for number, cell in enumerate(cell for cell in notebook["cells"] if cell["cell_type"] == "code"):
        *most, last = "".join(cell["source"]).rstrip().split("\n")
        exec(compile("\n".join(most), f"cell {number}", "exec"), names)
        try:
            code = compile(last, f"cell {number}", "eval")  # what a cell ends with is shown
        except SyntaxError:
            exec(compile(last, f"cell {number}", "exec"), names)
        else:
            shown.append(eval(code, names))
    pictures = [value for value in shown if hasattr(value, "_repr_html_") and "data:image/png" in value._repr_html_()]
    assert len(pictures) >= 2
    assert names["result"].status == "embedded"


def test_it_is_valid():
    nbformat = pytest.importorskip("nbformat")
    nbformat.validate(nbformat.read(NOTEBOOK, as_version=4))
