"""`pip install .` offline gives a package that imports, types included. The library is the one already built."""

import importlib.util
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

PROJECT = Path(__file__).resolve().parents[2]


def test_pip_install(tmp_path):
    for module in ("pip", "setuptools", "wheel"):
        if importlib.util.find_spec(module) is None:
            pytest.skip(f"{module} is not installed")
    # A copy, since pip leaves its traces in the source tree.
    source, target = tmp_path / "source", tmp_path / "target"
    source.mkdir()
    for name in ("pyproject.toml", "setup.py", "CMakeLists.txt", "README.md"):
        shutil.copy(PROJECT / name, source)
    shutil.copytree(PROJECT / "python", source / "python")
    install = ["-m", "pip", "install", "--no-build-isolation", "--no-index", "--no-deps", "--target", target, source]
    done = subprocess.run([sys.executable, *install], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr

    assert {"py.typed", "libunsnarl_c.so"} <= {path.name for path in (target / "unsnarl").iterdir()}
    script = "import unsnarl; print(unsnarl.__file__, unsnarl.find_intersections([[0, 0, 0]], []))"
    done = subprocess.run(
        [sys.executable, "-c", script],
        capture_output=True, text=True, cwd=tmp_path, env={**os.environ, "PYTHONPATH": str(target)},
    )
    assert done.stdout.split() == [str(target / "unsnarl" / "__init__.py"), "Intersections(none)"], done.stderr
