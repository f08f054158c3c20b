"""Seifert surfaces and isotopies of curves."""

import numpy as np
import pytest

import unsnarl


def test_a_trefoil_is_spanned():
    knot = unsnarl.knot_of_table("3_1")
    surface = unsnarl.seifert_surface(knot, fair=False)
    assert surface.report["hold"] and surface.report["genus"] == 1
    assert surface.report["alexander_of_link"] == [1, -1, 1]
    np.testing.assert_array_equal(surface.positions[: len(knot[0])], knot[0])
    assert len(unsnarl.find_intersections(surface.positions, surface.faces)) == 0
    assert unsnarl.check_seifert_surface(surface.positions, surface.faces, knot)["hold"]
    assert not unsnarl.check_seifert_surface(surface.positions, surface.faces[1:], knot)["hold"]


def test_a_square_becomes_an_l():
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
    ell = np.array([[0, 0], [5, 0], [5, 1], [1, 1], [1, 5], [0, 5]])
    way = unsnarl.planar_isotopy(square, ell)
    assert way.status == "embedded" and way.times[0] == 0 and way.times[-1] == 1
    np.testing.assert_array_equal(way.rings[0][0], square)
    np.testing.assert_array_equal(way.rings[-1][0], ell)
    for ring in way.rings:
        assert len(unsnarl.find_crossings(ring, closed=True)) == 0
    with pytest.raises(ValueError, match="runs around the other way"):
        unsnarl.planar_isotopy(square, ell[::-1])


def test_what_makes_no_sense():
    with pytest.raises(ValueError, match="component 0 has shape"):
        unsnarl.seifert_surface(np.zeros((4, 2)))
    with pytest.raises(ValueError, match="points 0 and 1 of component 0 are one"):
        unsnarl.seifert_surface(np.zeros((4, 3)))
    with pytest.raises(ValueError, match="no knot"):
        unsnarl.knot_of_table("11_1")
