"""Many meshes, each in a process of its own."""

import json

import pytest
from command_line import run, sample

import unsnarl


@pytest.fixture
def meshes(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    folder = tmp_path / "scans"
    (folder / "bands").mkdir(parents=True)
    sample(folder / "tubes.obj", "crossing_tubes", "--resolution", "12")
    sample(folder / "bands" / "bottle.obj", "klein_bottle", "--resolution", "12")
    (folder / "broken.obj").write_text("v 0 0\nf 1 2 3\n")
    return folder


def test_a_folder(meshes, tmp_path, caplog):
    with caplog.at_level("INFO", logger="unsnarl"):
        result = unsnarl.batch(meshes, tmp_path / "mine", jobs=1, threads=1, min_gap=1e-4)
    run("batch", meshes, "-o", tmp_path / "theirs", "--jobs", "1", "--threads", "1", "-q", "--", "--min-gap", "1e-4",
        expected=1)
    assert (tmp_path / "mine" / "fixed" / "tubes.obj").read_bytes() == (
        tmp_path / "theirs" / "fixed" / "tubes.obj").read_bytes()
    assert result.counts == {"embedded": 1, "obstructed": 1, "invalid_input": 1} and not result.embedded
    assert {row["mesh"] for row in result.rows} == {"tubes.obj", "bands/bottle.obj", "broken.obj"}
    assert json.loads((tmp_path / "mine" / "reports" / "tubes.obj.json").read_text())["options"]["min_gap_rel"] == 1e-4
    assert "of 3 meshes" in caplog.text
    assert unsnarl.batch(meshes, tmp_path / "mine", summary=True, min_gap=1e-4).rows == result.rows


def test_a_list_and_parts_of_it(meshes, tmp_path):
    paths = ["scans/tubes.obj", "scans/bands/bottle.obj"]
    parts = [unsnarl.batch(paths, tmp_path / "out", jobs=1, shard=(i, 2)) for i in range(2)]
    assert [part.rows for part in parts] == [[], []]
    whole = unsnarl.batch(paths, tmp_path / "out", summary=True)
    assert whole.counts == {"embedded": 1, "obstructed": 1}
    only = unsnarl.batch(["scans/tubes.obj"], tmp_path / "one")
    assert only.embedded and (tmp_path / "one" / "fixed" / "scans" / "tubes.obj").exists()


def test_refusals(meshes, tmp_path):
    with pytest.raises(FileNotFoundError, match="nowhere"):
        unsnarl.batch(tmp_path / "nowhere", tmp_path / "out")
    with pytest.raises(ValueError, match="line breaks"):
        unsnarl.batch(["a\nb.obj"], tmp_path / "out")
    with pytest.raises(ValueError, match="shard"):
        unsnarl.batch(meshes, tmp_path / "out", shard=(3, 2))
    with pytest.raises(ValueError, match="goal"):
        unsnarl.batch(meshes, tmp_path / "out", goal="none")
