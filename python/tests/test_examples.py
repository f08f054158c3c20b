"""The examples run, and show what they say."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


def test_untangling_over_time(tmp_path):
    pytest.importorskip("matplotlib")
    picture = tmp_path / "plots.png"
    done = subprocess.run(
        [sys.executable, EXAMPLES / "untangling_over_time.py", picture],
        capture_output=True, text=True, env={**os.environ, "MPLCONFIGDIR": str(tmp_path)},
    )
    assert done.returncode == 0, done.stderr
    assert "Intersections(" in done.stdout and "Result(embedded" in done.stdout
    assert picture.read_bytes().startswith(b"\x89PNG") and picture.stat().st_size > 10_000
