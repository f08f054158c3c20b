"""Pairs of faces that may intersect."""

import numpy as np
import pytest

import unsnarl

# A floor, a blade through it and a bar through the floor elsewhere; one triangle each.
V = np.array(
    [[0, 0, 0], [8, 0, 0], [0, 8, 0], [1, 1, -1], [1, 1, 2], [2, 1, 2], [3, 2, -1], [3, 2, 2], [3.5, 2.5, 2]], float
)
F = np.array([[0, 1, 2], [3, 4, 5], [6, 7, 8]])
OBJ = "".join(f"v {x} {y} {z}\n" for x, y, z in V) + "o floor\nf 1 2 3\no blade\nf 4 5 6\no bar\nf 7 8 9\n"


def test_arrays_by_masks_or_ids_of_faces():
    assert len(unsnarl.find_intersections(V, F)) == 2
    mask = np.array([True, False, False])
    for allow in ([(mask, [1])], [([1], mask)], [([0, 2], [1])], [[0, 1]]):
        result = unsnarl.repair(V, F, allow=allow)
        assert result.status == "allowed", allow
        assert result.report["allowed"]["after"]["total"] == 1
        assert result.report["after"]["total"] == 0 and result.report["before"]["total"] == 1
        left = unsnarl.find_intersections(result.V, F)
        assert left.pairs.tolist() == [[0, 1]]
        assert len(unsnarl.find_intersections(result.V, F, allow=allow)) == 0
        certificate = unsnarl.certify(V, F, result.V, allow=allow)
        assert certificate.resolved and not certificate.embedded and sum(certificate.allowed.values()) == 1
    both = unsnarl.repair(V, F, allow=[([0], [1]), ([0], [2])])
    assert both.status == "allowed" and np.array_equal(both.V, V)
    assert "pairs that may intersect" in both._repr_html_()
    assert unsnarl.repair(V, F, allow=[]).status == unsnarl.repair(V, F, allow=[[0]]).status == "embedded"


def test_meshes_by_their_numbers():
    meshes = [(V[3 * i : 3 * i + 3], [[0, 1, 2]]) for i in range(3)]
    result = unsnarl.repair(meshes, allow=[(0, 1)])
    assert result.status == "allowed"
    assert np.array_equal(result.V[1], V[3:6])
    assert result.report["between_files"][0]["allowed"]["after"]["total"] == 1
    assert unsnarl.find_intersections(meshes, allow=[(0, 1), (2, 0)]).pairs.size == 0


def test_files_by_names(tmp_path):
    (tmp_path / "in.obj").write_text(OBJ)
    for allow in ("floor:blade", ("floor", "blade"), ["object=floor:1"], [(0, 1)]):
        result = unsnarl.fix(tmp_path / "in.obj", tmp_path / "out.obj", allow=allow)
        assert result.status == "allowed", allow
        assert unsnarl.check(tmp_path / "out.obj", allow=allow).report["allowed"]["total"] == 1
        assert len(unsnarl.check(tmp_path / "out.obj", allow=allow)) == 0
        assert len(unsnarl.check(tmp_path / "out.obj")) == 1
        assert result.picture().startswith(b"\x89PNG") and b"<html" in result.view().html
    with pytest.raises(ValueError, match="allow: there is no part 'roof'"):
        unsnarl.fix(tmp_path / "in.obj", tmp_path / "out.obj", allow="floor:roof")


def test_sequences_and_batches(tmp_path):
    frames = unsnarl.repair_sequence(np.stack([V, V]), F, allow=[([0], [1])]).frames
    assert [frame.status for frame in frames] == ["allowed"] * 2
    assert sum(frames[0].allowed_after.values()) == 1
    (tmp_path / "in").mkdir()
    (tmp_path / "in/a_0.obj").write_text(OBJ)
    (tmp_path / "in/a_1.obj").write_text(OBJ)
    found = unsnarl.fix_sequence(str(tmp_path / "in/*.obj"), tmp_path / "frames", allow=("floor", "blade"))
    assert [frame.status for frame in found.frames] == ["allowed"] * 2
    result = unsnarl.batch(tmp_path / "in", tmp_path / "out", allow=["floor:blade"])
    assert result.counts == {"allowed": 2} and result.rows[0]["allowed_after"] == 1


def test_what_makes_no_sense_is_refused():
    with pytest.raises(TypeError, match="allow is a list"):
        unsnarl.repair(V, F, allow="floor")
    with pytest.raises(ValueError, match=r"allow\[0\] is a tuple of 3"):
        unsnarl.repair(V, F, allow=[([0], [1], [2])])
    with pytest.raises(ValueError, match=r"allow\[1\]\[0\] is 7"):
        unsnarl.repair(V, F, allow=[[0], [7]])
    with pytest.raises(ValueError, match="names mesh 5"):
        unsnarl.repair([(V, F)], allow=[(0, 5)])
    with pytest.raises(ValueError, match="leave one of the two out"):
        unsnarl.repair(V, F, allow=[[0]], paper=True)
