import numpy as np

import unsnarl
from command_line import run, sample


def test_pairs_and_kinds(crossing):
    found = unsnarl.find_intersections(*crossing)
    assert found.pairs.tolist() == [[0, 1]]
    assert found.pairs.dtype == np.int32
    assert found.kinds.tolist() == ["disjoint"]
    assert found.counts == {"disjoint": 1, "one_vertex": 0, "folded": 0, "duplicate": 0, "degenerate": 0}
    assert found.faces.tolist() == [0, 1]
    assert repr(found) == "Intersections(1 disjoint)"


def test_none_is_false():
    found = unsnarl.find_intersections(np.eye(3), [[0, 1, 2]])
    assert not found
    assert found.pairs.shape == (0, 2)
    assert repr(found) == "Intersections(none)"


def test_all_that_the_command_line_finds(tmp_path):
    path, listed = tmp_path / "boy.obj", tmp_path / "pairs.csv"
    found = unsnarl.find_intersections(*sample(path, "boy_surface"))
    run("check", path, "--pairs", listed, expected=1)
    lines = [line.split(",") for line in listed.read_text().splitlines()[1:]]
    assert len(lines) > 10
    assert found.pairs.tolist() == [[int(a), int(b)] for a, b, _ in lines]
    assert found.kinds.tolist() == [kind for _, _, kind in lines]


def test_weld():
    V = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 0], [0, 1, 0], [-1, 0, 0]], dtype=float)
    F = [[0, 1, 2], [3, 4, 5]]
    assert len(unsnarl.find_intersections(V, F, weld="none")) == 1
    assert len(unsnarl.find_intersections(V, F, weld="all")) == 0
    V[3, 1] = 1e-9
    assert len(unsnarl.find_intersections(V, F, weld="all")) == 1
    assert len(unsnarl.find_intersections(V, F, weld="all", weld_tolerance=1e-6)) == 0


def test_certificate_takes_what_came_to_coincide_for_intersecting(crossing):
    V, F = crossing
    before = unsnarl.certify(V, F, V)
    assert not before.embedded and before.pairs["disjoint"] == 1
    apart = np.concatenate([V[:3], V[3:] + [0, 0, 9]])
    after = unsnarl.certify(V, F, apart)
    assert after.embedded and after.float32_embedded and after.seams_closed and after.new_zero_area_faces == 0
    touching = np.concatenate([apart[:3], apart[3:] - apart[3] + V[0]])
    assert not unsnarl.certify(V, F, touching).embedded
