"""What mypy --strict makes of the package, and of a program that uses it."""

import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

import unsnarl

PACKAGE = Path(unsnarl.__file__).parent

#: Lines of a program, and what mypy says of each: a type, the code of an error, or nothing.
PROGRAM = """
from pathlib import Path
import numpy as np
import unsnarl
V = np.zeros((3, 3))
F = np.array([[0, 1, 2]])
class Mesh:
    vertices = V
    faces = F
def watch(progress: unsnarl.Progress) -> None:
    print(progress.pairs_left)
reveal_type(unsnarl.repair(V, F, [0, 1], goal="all", rigid=[[0]], progress=watch).V)  # ndarray
reveal_type(unsnarl.repair([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]).V)  # ndarray
reveal_type(unsnarl.repair(V, (np.array([0, 1, 2]), [0, 3]), paper={"arap": 0.5}).V)  # ndarray
reveal_type(unsnarl.repair(Mesh()).V)  # ndarray
reveal_type(unsnarl.repair([(V, F), Mesh()], fixed=[None, [0]], nested=[0, 1]).V)  # list
reveal_type(unsnarl.fix("in.obj", Path("out.obj"), fix_group="x", fix_component=[0, 1], format="obj").V)  # ndarray
reveal_type(unsnarl.fix(["a.obj", "b.obj"], "out", nested=["a.obj", "b.obj"]).V)  # list
reveal_type(unsnarl.fix_sequence("f*.obj", "out", frames=(0, 3), only_object=["a", "b"]).frames[0].status)  # Status
reveal_type(unsnarl.batch(["a.obj"], "out", precision="float32").counts)  # dict
reveal_type(unsnarl.check("a.obj", weld="none").parts[0].kind)  # Literal
reveal_type(unsnarl.find_intersections([(V, F), (V, F)]).meshes)  # ndarray
reveal_type(unsnarl.certify(V, F, V).embedded)  # bool
reveal_type(unsnarl.sample("crossing_tubes", radius=0.3)[0])  # ndarray
reveal_type(unsnarl.repair_sequence(np.zeros((2, 3, 3)), F, goal="disjoint").embedded)  # bool
unsnarl.repair(V, F, goal="some")  # error
unsnarl.repair(V, F, gaol="all")  # error
unsnarl.repair(V, F, paper={"weight": 1})  # error
unsnarl.fix("in.obj", "out.obj", fix_component="one")  # error
unsnarl.fix("in.obj", "out.obj", format="xyz")  # error
unsnarl.find_intersections(V, F, weld="some")  # error
unsnarl.fix_sequence("f*.obj", "out", precision="float16")  # error
unsnarl.batch("in", "out", max_displacment=1)  # error
"""


def mypy(*arguments, folder):
    program = shutil.which("mypy")
    if program is None:
        pytest.skip("mypy is not installed")
    done = subprocess.run(
        [program, "--strict", "--no-error-summary", "--cache-dir", folder / "cache", *arguments], cwd=folder,
        capture_output=True, text=True, env={**os.environ, "MYPYPATH": str(PACKAGE.parent)},
    )
    assert done.returncode in (0, 1), done.stderr
    return done.stdout


def test_the_package_itself(tmp_path):
    # PyVista, which _pyvista.py is for, need not be installed.
    assert mypy(*sorted(p for p in PACKAGE.glob("*.py") if p.name != "_pyvista.py"), folder=tmp_path) == ""


def test_a_program_that_uses_it(tmp_path):
    (tmp_path / "program.py").write_text(PROGRAM)
    said = {}
    lines = mypy("program.py", folder=tmp_path)
    for number, kind, words in re.findall(r"^program\.py:(\d+): (\w+): (.*)$", lines, re.M):
        said.setdefault(int(number), []).append((kind, words))
    for number, line in enumerate(PROGRAM.splitlines(), 1):
        wanted = line.partition("  # ")[2]
        kinds = {kind for kind, _ in said.get(number, [])}
        if wanted == "error":
            assert "error" in kinds, line
            continue
        assert "error" not in kinds, (line, said[number])
        assert not wanted or wanted in said[number][0][1] and "Any" != said[number][0][1], (line, said.get(number))
