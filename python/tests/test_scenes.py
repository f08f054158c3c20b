"""Several meshes as one scene."""

import numpy as np
import pytest

import unsnarl


def sphere(radius, shift=0.0, rows=10, columns=16):
    """A closed sphere of triangles around (shift, 0, 0)."""
    theta = np.pi * np.arange(1, rows) / rows
    phi = 2 * np.pi * np.arange(columns) / columns
    t, p = np.meshgrid(theta, phi, indexing="ij")
    ring = np.stack([np.sin(t) * np.cos(p), np.sin(t) * np.sin(p), np.cos(t)], axis=-1).reshape(-1, 3)
    V = np.vstack([ring, [[0, 0, 1], [0, 0, -1]]]) * radius + [shift, 0, 0]
    F, n = [], len(ring)
    for j in range(columns):
        k = (j + 1) % columns
        F.append([n, j, k])
        F.append([n + 1, (rows - 2) * columns + k, (rows - 2) * columns + j])
        for i in range(rows - 2):
            a, b, c, d = i * columns + j, i * columns + k, (i + 1) * columns + k, (i + 1) * columns + j
            F += [[a, d, c], [a, c, b]]
    return V, np.array(F)


inner, outer = sphere(1.0, 0.08), sphere(1.05)


def test_meshes_that_cross_are_separated_and_given_back_one_by_one():
    found = unsnarl.find_intersections([inner, outer])
    assert len(found) > 0 and found.meshes.shape == found.pairs.shape
    assert np.array_equal(np.unique(found.meshes, axis=0), [[0, 1]])
    assert len(unsnarl.find_intersections(*inner)) == 0
    result = unsnarl.repair([inner, outer])
    assert result.status == "embedded"
    assert [V.shape for V in result.V] == [inner[0].shape, outer[0].shape]
    assert len(unsnarl.find_intersections([(result.V[0], inner[1]), (result.V[1], outer[1])])) == 0
    assert unsnarl.certify([inner, outer], None, result.V).embedded
    files, between = result.report["files"], result.report["between_files"]
    assert [f["faces"] for f in files] == [len(inner[1]), len(outer[1])]
    assert between[0]["files"] == ["0", "1"] and between[0]["before"]["total"] == len(found)
    assert between[0]["after"]["total"] == 0


def test_a_mesh_can_be_held():
    everything = np.ones(len(outer[0]), dtype=bool)
    result = unsnarl.repair([inner, outer], fixed=[None, everything])
    assert result.status == "embedded"
    assert np.array_equal(result.V[1], outer[0]) and not np.array_equal(result.V[0], inner[0])


def test_the_inner_mesh_goes_in_even_where_the_way_out_is_nearer():
    small = sphere(0.9, 0.95)

    def once_more(result):
        return unsnarl.repair([(result.V[0], small[1]), (result.V[1], outer[1])], nested=[[0, 1]])

    plain, nested = unsnarl.repair([small, outer]), unsnarl.repair([small, outer], nested=[0, 1])
    assert plain.status == nested.status == "embedded"
    assert "nested" not in plain.report
    (pair,) = nested.report["nested"]
    assert pair["inner"] == "0" and pair["outer"] == "1" and pair["nested"]
    assert pair["wrong_before"] > 100 and pair["wrong_after"] == 0
    assert once_more(plain).status == "not_nested"
    again = once_more(nested)
    assert again.status == "embedded" and np.array_equal(again.V[0], nested.V[0])


def test_what_crosses_nothing_but_lies_wrong_is_reported():
    result = unsnarl.repair([sphere(0.2, 3.0), outer], nested=[0, 1])
    assert result.status == "not_nested" and result.report["exit_code"] == 7
    assert not result.report["nested"][0]["nested"]
    assert result.report["after"]["total"] == 0


def test_nesting_that_makes_no_sense_is_refused():
    sheet = (np.array([[0, 0, 0.0], [1, 0, 0], [0, 1, 0]]), np.array([[0, 1, 2]]))
    for meshes, nested, error, words in [
        ([inner, outer], [0, 2], ValueError, "mesh 2"),
        ([inner, outer], [0, 0], ValueError, "inside itself"),
        ([inner, outer], [0], ValueError, "two surfaces"),
        ([inner, outer], "01", TypeError, "innermost"),
        ([outer, sheet], [0, 1], ValueError, "not closed"),
    ]:
        with pytest.raises(error, match=words):
            unsnarl.repair(meshes, nested=nested)
    with pytest.raises(ValueError, match="list of meshes"):
        unsnarl.repair(*outer, nested=[0, 1])


def test_polygons_triangles_and_types_mix():
    quads = np.array([[0, 1, 2, 3]])
    flat = np.array([[-2, -2, 0.0], [2, -2, 0], [2, 2, 0], [-2, 2, 0]], dtype=np.float32)
    needle = np.array([[0.3, 0.1, -1.0], [0.4, 0.1, -1], [0.35, 0.2, 1.0]])
    result = unsnarl.repair([(flat, quads), (needle, [[0, 1, 2]])])
    assert result.status == "embedded"
    assert result.V[0].dtype == np.float32 and result.V[1].dtype == np.float64
    one = unsnarl.repair([(flat, quads)])
    assert len(one.V) == 1 and np.array_equal(one.V[0], flat)


def test_what_makes_no_sense_is_refused_with_the_mesh_named():
    with pytest.raises(ValueError, match="no mesh"):
        unsnarl.repair([])
    with pytest.raises(ValueError, match="mesh 1 of the list"):
        unsnarl.repair([inner, (outer[0][:5], outer[1])])
    with pytest.raises(ValueError, match="mesh 0 of the list"):
        unsnarl.repair([(inner[0], inner[1], 1), outer])
    with pytest.raises(ValueError, match="2 meshes"):
        unsnarl.repair([inner, outer], fixed=[None])
    with pytest.raises(ValueError, match=r"moved\[1\]"):
        unsnarl.certify([inner, outer], None, [inner[0], inner[0][:4]])
