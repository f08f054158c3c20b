"""Frames from files to files."""

import os
import signal
import threading
import time

import numpy as np
import pytest
from command_line import run, sample

import unsnarl


@pytest.fixture
def frames(tmp_path):
    folder = tmp_path / "dance"
    folder.mkdir()
    for k in range(3):
        sample(folder / f"f{k + 1}.obj", "crossing_tubes", "--resolution", "12", "--set", "radius=0.3", "--set",
               f"offset={0.51 + 0.01 * k}")
    return folder


def contents(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.suffix == ".obj"}


@pytest.mark.parametrize(
    "options, words",
    [
        ({}, []),
        ({"fix_component": 0, "precision": "float64"}, ["--fix-component", "0", "--precision", "float64"]),
        ({"frames": (1, 3), "weld": "none"}, ["--frames", "1:3", "--weld", "none"]),
    ],
    ids=str,
)
def test_frames_are_those_of_the_program(frames, tmp_path, options, words):
    seen = []
    result = unsnarl.fix_sequence(frames / "*.obj", tmp_path / "mine", progress=seen.append, **options)
    run("fix", "--sequence", frames / "*.obj", "-o", tmp_path / "theirs", "-q", *words)
    assert contents(tmp_path / "mine") == contents(tmp_path / "theirs")
    assert result.embedded and result.output == tmp_path / "mine"
    assert result.names == sorted(contents(tmp_path / "mine"))
    assert [frame.frame for frame in result.frames] == list(range(*options.get("frames", (0, 3))))
    first = result.frames[0]
    assert first.status == "embedded" and sum(first.before.values()) > 0 and sum(first.after.values()) == 0
    assert seen and all(isinstance(progress, unsnarl.Progress) for progress in seen)
    again = unsnarl.fix_sequence(sorted(frames.iterdir()), tmp_path / "mine", **options)
    assert again.report["done_before"] == len(result.frames)


def test_vertices_are_held(frames, tmp_path):
    V, _ = unsnarl.read(frames / "f1.obj")
    for number, fixed in enumerate(([0, 1, 2], np.arange(len(V)) < 3)):
        unsnarl.fix_sequence(frames / "*.obj", tmp_path / str(number), fixed)
    assert contents(tmp_path / "0") == contents(tmp_path / "1")
    assert np.array_equal(unsnarl.read(tmp_path / "0" / "f1.obj")[0][:3], V[:3])


def test_what_is_unfinished_raises_nothing(frames, tmp_path):
    result = unsnarl.fix_sequence(frames / "*.obj", tmp_path / "out", max_displacement=1e-9)
    assert not result.embedded and result.report["exit_code"] != 0 and result.report["written"] == 0


def test_ctrl_c_stops_the_program(tmp_path):
    for k in range(1, 7):
        sample(tmp_path / f"f{k}.obj", "crossing_tubes", "--resolution", "150", "--set", f"offset=0.{50 + k}")
    threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        unsnarl.fix_sequence(tmp_path / "*.obj", tmp_path / "out")
        time.sleep(60)
    assert time.monotonic() - begin < 30


def test_an_exception_in_progress_stops_it(frames, tmp_path):
    def fail(_):
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        unsnarl.fix_sequence(frames / "*.obj", tmp_path / "out", progress=fail)


def test_refusals(frames, tmp_path):
    with pytest.raises(ValueError, match="frames"):
        unsnarl.fix_sequence(frames / "*.obj", tmp_path / "out", frames=(2, 9))
    with pytest.raises(ValueError, match="there is no group 'x'"):
        unsnarl.fix_sequence(frames / "*.obj", tmp_path / "out", fix_group="x")
    with pytest.raises(FileNotFoundError, match="none1.obj"):
        unsnarl.fix_sequence([tmp_path / "none1.obj", tmp_path / "none2.obj"], tmp_path / "out")
    (tmp_path / "file").write_text("")
    with pytest.raises(OSError, match="file"):
        unsnarl.fix_sequence(frames / "*.obj", tmp_path / "file")
    with pytest.raises(TypeError, match="fix_grup"):
        unsnarl.fix_sequence(frames / "*.obj", tmp_path / "out", fix_grup="x")
