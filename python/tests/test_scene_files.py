"""Several files that are repaired together, and go back into files of their own."""

import json

import numpy as np
import pytest
from command_line import run, without_measurements
from test_scenes import sphere

import unsnarl


def write_off(path, V, F):
    rows = [" ".join(map(repr, map(float, v))) for v in V] + [" ".join(map(str, [3, *f])) for f in F]
    path.write_text("\n".join([f"OFF\n{len(V)} {len(F)} 0", *rows, ""]))
    return path


@pytest.fixture
def files(tmp_path):
    return [write_off(tmp_path / "inner.off", *sphere(1.0, 0.08)), write_off(tmp_path / "outer.off", *sphere(1.05))]


def names(folder):
    return sorted(path.name for path in folder.iterdir())


@pytest.mark.parametrize(
    "options, words",
    [
        ({}, []),
        ({"fix_file": "outer.off"}, ["--fix-file", "outer.off"]),
        ({"rigid_file": ["inner.off"]}, ["--rigid-file", "inner.off"]),
        ({"nested": ["inner.off", "outer.off"]}, ["--nested", "inner.off,outer.off"]),
    ],
    ids=str,
)
def test_files_of_a_scene_are_those_of_the_program(files, tmp_path, options, words):
    mine, theirs = tmp_path / "deep" / "mine", tmp_path / "theirs"
    result = unsnarl.fix(files, mine, **options)
    run("fix", *files, "-o", theirs, "--report", tmp_path / "report.json", "-q", *words,
        expected=result.report["exit_code"])
    assert result.status == "embedded" and result.output == mine
    assert names(mine) == names(theirs) == ["inner.off", "outer.off"]
    for name in names(mine):
        assert (mine / name).read_bytes() == (theirs / name).read_bytes()
    report = json.loads((tmp_path / "report.json").read_text())
    for one in (report, result.report):
        for file in one["files"]:
            file["output"] = None
    mine_only, theirs_only = without_measurements(result.report), without_measurements(report)
    assert mine_only == theirs_only
    assert [V.shape for V in result.V] == [unsnarl.read(path)[0].shape for path in files]
    assert np.array_equal(result.V[0], unsnarl.read(mine / "inner.off")[0])


def test_a_scene_of_files_is_checked_as_one(files):
    found = unsnarl.check(files)
    assert len(found) > 0 and np.array_equal(np.unique(found.meshes, axis=0), [[0, 1]])
    assert [file["name"] for file in found.report["files"]] == ["inner.off", "outer.off"]
    assert len(found) == json.loads(run("check", "--json", *files, expected=1))["pairs"]["total"]


def test_vertices_of_a_file_are_held(files, tmp_path):
    everything = np.ones(len(unsnarl.read(files[1])[0]), bool)
    result = unsnarl.fix(files, tmp_path / "out", fixed=[None, everything])
    assert result.status == "embedded" and np.array_equal(result.V[1], unsnarl.read(files[1])[0])
    assert (tmp_path / "out" / "outer.off").read_bytes() == files[1].read_bytes()
    assert result.picture(256).startswith(b"\x89PNG")


def test_what_is_not_written_leaves_no_folder(files, tmp_path):
    result = unsnarl.fix(files, tmp_path / "a" / "b", max_displacement=1e-9)
    assert result.output is None and not (tmp_path / "a").exists()
    assert all(file["output"] is None for file in result.report["files"])
    kept = unsnarl.fix(files, tmp_path / "a" / "b", max_displacement=1e-9, keep_partial=True)
    assert kept.output == tmp_path / "a" / "b" and names(kept.output) == ["inner.off", "outer.off"]


def test_refusals(files, tmp_path):
    before = names(tmp_path)
    (tmp_path / "other").mkdir()
    twin = write_off(tmp_path / "other" / "inner.off", *sphere(1.0))
    for paths, output, error, words in [
        (files, None, ValueError, "folder"),
        ([], tmp_path / "out", ValueError, "no file"),
        ([files[0], twin], tmp_path / "out", ValueError, "same name"),
        (files, tmp_path, ValueError, "part of the input"),
        ([files[0], tmp_path / "none.off"], tmp_path / "out", OSError, "none.off"),
        (files, files[0], OSError, ""),
    ]:
        with pytest.raises(error, match=words):
            unsnarl.fix(paths, output)
    with pytest.raises(ValueError, match="folder"):
        unsnarl.fix(files, in_place=True)
    with pytest.raises(ValueError, match="2 meshes"):
        unsnarl.fix(files, tmp_path / "out", fixed=[None])
    assert names(tmp_path) == sorted([*before, "other"])
