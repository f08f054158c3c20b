"""Parts that are held or moved, and options of what counts."""

import numpy as np
import pytest

import unsnarl
from command_line import fix, read_obj


@pytest.fixture
def scene(tmp_path, sheets):
    """Two sheets that run through each other, as quads, and the file of them."""
    V, F = sheets
    path = tmp_path / "in.obj"
    path.write_text(
        "".join("v {!r} {!r} {!r}\n".format(*p) for p in V.tolist())
        + "".join("f " + " ".join(map(str, f + 1)) + "\n" for f in F)
    )
    return V, F, path


def assert_same_as_file(result, path, V):
    written = read_obj(path)[0]
    assert np.array_equal(np.where(written == V, V, written.astype(np.float32)), result.V.astype(np.float32))


def test_components_are_counted_by_their_first_faces(sheets):
    V, F = sheets
    component = unsnarl.component_of_faces(V, F)
    assert component.dtype == np.int32
    assert np.array_equal(component, np.repeat([0, 1], len(F) // 2))
    assert np.array_equal(unsnarl.component_of_faces(V, F[::-1]), component)


def test_seams_hold_components_together():
    V = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]], dtype=float)
    F = [[0, 1, 2], [4, 3, 5]]
    assert list(unsnarl.component_of_faces(V, F)) == [0, 0]
    assert list(unsnarl.component_of_faces(V, F, weld="none")) == [0, 1]
    assert unsnarl.boundary_vertices(V, F).all()


def test_vertices_of_faces_by_mask_or_ids():
    V, F = np.zeros((5, 3)), [[0, 1, 2], [2, 3, 4]]
    expected = [False, False, True, True, True]
    assert unsnarl.vertices_of_faces(V, F, [1]).tolist() == expected
    assert unsnarl.vertices_of_faces(V, F, np.array([False, True])).tolist() == expected
    assert not unsnarl.vertices_of_faces(V, F, []).any()
    with pytest.raises(ValueError, match=r"faces\[0\] is 2, but there are 2 faces"):
        unsnarl.vertices_of_faces(V, F, [2])
    with pytest.raises(ValueError, match="faces has 3 flags, but there are 2 faces"):
        unsnarl.vertices_of_faces(V, F, [True, False, True])


def test_boundary_of_a_sheet(sheets):
    V, F = sheets
    on_boundary = unsnarl.boundary_vertices(V, F)
    assert np.array_equal(on_boundary, np.any(np.abs(V[:, :2]) == 1, axis=1))


def test_held_parts_are_those_of_the_command_line(tmp_path, scene):
    V, F, source = scene
    target = tmp_path / "out.obj"
    fix(source, target, "--fix-component", 0, "--fix-boundary")
    first = unsnarl.component_of_faces(V, F) == 0
    fixed = unsnarl.vertices_of_faces(V, F, first) | unsnarl.boundary_vertices(V, F)
    result = unsnarl.repair(V, F, fixed)
    assert result.status == "embedded"
    assert np.array_equal(result.V[fixed], V[fixed]) and not np.array_equal(result.V, V)
    assert_same_as_file(result, target, V)


def test_each_component_leaves_what_lies_between_them(tmp_path, scene):
    V, F, source = scene
    report = fix(source, tmp_path / "out.obj", "--each", expected=7)
    result = unsnarl.repair(V, F, each_component=True)
    assert result.status == "obstructed"
    assert result.report["obstructions"] == report["obstructions"]
    assert {obstruction["kind"] for obstruction in result.report["obstructions"]} == {"between_components"}


def test_both_diagonals_count():
    # Cut along one diagonal a quad passes below a needle, along the other through it.
    V = np.array(
        [[0, 0, 0], [2, 0, 1], [2, 2, 0], [0, 2, 1], [0.9, 1, 0.4], [1.1, 1, 0.4], [1, 1, 1.5]], dtype=float
    )
    F = ([0, 1, 2, 3, 4, 5, 6], [0, 4, 7])
    one, both = (unsnarl.find_intersections(V, F, both_diagonals=choice) for choice in (False, True))
    assert (len(one), len(both)) == (0, 1)
    repaired = unsnarl.repair(V, F, both_diagonals=True)
    assert repaired.status == "embedded"
    assert len(unsnarl.find_intersections(repaired.V, F, both_diagonals=True)) == 0
    assert unsnarl.certify(V, F, repaired.V, both_diagonals=True).embedded
    assert not unsnarl.certify(V, F, V, both_diagonals=True).embedded


def test_rigid_parts_are_those_of_the_command_line(tmp_path, scene):
    V, F, source = scene
    target = tmp_path / "out.obj"
    report = fix(source, target, "--rigid-component", 0)
    part = unsnarl.vertices_of_faces(V, F, unsnarl.component_of_faces(V, F) == 0)
    by_mask, by_ids = unsnarl.repair(V, F, rigid=[part]), unsnarl.repair(V, F, rigid=[np.flatnonzero(part)])
    assert by_mask.status == "embedded"
    assert_same_as_file(by_mask, target, V)
    assert np.array_equal(by_mask.V, by_ids.V)
    motion = by_mask.report["rigid_parts"][0]
    assert motion["rotation"] == report["rigid_parts"][0]["rotation"]
    carried = V[part] @ np.array(motion["rotation"]).reshape(3, 3).T + motion["translation"]
    assert np.abs(by_mask.V[part] - carried).max() < 1e-6 * by_mask.report["diagonal"]
    assert unsnarl.fix(source, tmp_path / "again.obj", rigid=[part]).status == "embedded"
    assert (tmp_path / "again.obj").read_bytes() == target.read_bytes()


def test_meshes_of_a_list_can_be_rigid():
    V = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4]], dtype=float)
    F = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
    small = np.array([[1.2, 1.2, 1.1], [2.6, 2.5, 2], [2.5, 2.6, 2.2], [2.4, 2.4, 2.7]])
    result = unsnarl.repair([(V, F), (small, F)], fixed=[np.arange(4), None], rigid=[1])
    assert result.status == "embedded"
    edges = [np.linalg.norm(x[:, None] - x, axis=2) for x in (small, result.V[1])]
    assert np.abs(edges[0] - edges[1]).max() < 2e-6
    assert result.report["rigid_parts"][0]["vertices"] == 4


def test_rigid_parts_that_make_no_sense(scene):
    V, F, _ = scene
    for error, message, rigid in (
        (TypeError, "rigid is a list of parts", np.ones(len(V), bool)),
        (ValueError, r"rigid\[0\] and rigid\[1\] have vertex 1 in common", [[0, 1], [1, 2]]),
        (ValueError, r"rigid\[0\]\[1\] is 1000000", [[0, 1000000]]),
    ):
        with pytest.raises(error, match=message):
            unsnarl.repair(V, F, rigid=rigid)
    with pytest.raises(ValueError, match="names mesh 1, but there are 1"):
        unsnarl.repair([(V, F)], rigid=[1])
    with pytest.raises(ValueError, match="is fixed and of the rigid part"):
        unsnarl.repair(V, F, [0], rigid=[[0, 1, 2]])
