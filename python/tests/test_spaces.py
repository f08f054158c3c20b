"""Seifert surfaces and isotopies of curves."""

import numpy as np
import pytest

import unsnarl


def test_a_trefoil_is_spanned():
    knot = unsnarl.knot_of_table("3_1")
    surface = unsnarl.seifert_surface(knot, fair=False)
    assert surface.report["hold"] and surface.report["genus"] == 1
    assert surface.report["alexander_of_link"] == [1, -1, 1]
    assert surface.report["determinant"] == 3 and abs(surface.report["signature"]) == 2
    assert surface.report["genus_is_least"] is True
    np.testing.assert_array_equal(surface.positions[: len(knot[0])], knot[0])
    assert len(unsnarl.find_intersections(surface.positions, surface.faces)) == 0
    assert unsnarl.check_seifert_surface(surface.positions, surface.faces, knot)["hold"]
    handled = unsnarl.seifert_surface(knot, fair=False, handles=2)
    assert handled.report["hold"] and handled.report["genus"] == surface.report["genus"] + 2
    assert not unsnarl.check_seifert_surface(handled.positions, handled.faces, knot)["hold"]
    assert unsnarl.check_seifert_surface(handled.positions, handled.faces, knot, handles=2)["hold"]
    assert not unsnarl.check_seifert_surface(surface.positions, surface.faces[1:], knot)["hold"]


def test_a_surface_that_is_brought_is_untangled():
    # A strip of straight ways between two linked circles, which runs through itself.
    around, across = 24, 8
    angles = 2 * np.pi * np.arange(around) / around
    first = np.c_[np.cos(angles), np.sin(angles), 0 * angles]
    second = np.c_[1 + np.cos(angles + np.pi / 2), 0 * angles, np.sin(angles + np.pi / 2)]
    positions = np.concatenate([first + t * (second - first) for t in np.linspace(0, 1, across + 1)])
    faces = []
    for row in range(across):
        for k in range(around):
            a, b = row * around + k, row * around + (k + 1) % around
            faces += [[a, b, b + around], [a, b + around, a + around]]
    assert len(unsnarl.find_intersections(positions, faces)) > 0
    surface = unsnarl.untangled_seifert_surface(positions, faces)
    assert surface.status == "embedded" and surface.report["hold"] and surface.report["euler_characteristic"] == 0
    boundary = {tuple(p) for p in np.concatenate([positions[:around], positions[-around:]])}
    assert {tuple(p) for p in surface.positions[: 2 * around]} == boundary
    assert len(unsnarl.find_intersections(surface.positions, surface.faces)) == 0
    with pytest.raises(ValueError):
        unsnarl.untangled_seifert_surface(positions, [[0, 1, 2], [0, 1, 3]])


def test_a_relaxed_wire_is_spanned_and_shown_by_a_tube():
    knot = unsnarl.knot_of_table("kinks_1")
    wire = unsnarl.relaxed_wire(knot)
    assert wire.status == "embedded" and wire.report["at_rest"] and len(wire.points) >= 200
    spread = np.linalg.norm(wire.points - wire.points.mean(axis=0), axis=1)
    assert spread.max() < 1.05 * spread.min()  # an unknot comes to rest as a circle
    surface = unsnarl.seifert_surface(wire.points, fair=False)
    assert surface.report["hold"] and surface.report["genus"] == 0
    tube = unsnarl.knot_tube(wire.points, surface.positions, surface.faces)
    assert tube.radius > 0 and len(unsnarl.find_intersections(tube.positions, tube.faces)) == 0
    distances = np.linalg.norm(tube.positions[:, None] - wire.points[None], axis=2).min(axis=1)
    assert tube.radius * 0.99 < distances.min() and distances.max() < 2 * tube.radius
    # A tube has to meet the surface. One that is far away is not met, so there is no tube.
    assert unsnarl.knot_tube(wire.points, surface.positions + 100, surface.faces).radius == 0
    with pytest.raises(ValueError, match="a triangle mesh is due"):
        unsnarl.knot_tube(wire.points, [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]])
    assert unsnarl.relaxed_wire(knot, time_limit=1e-9).status == "time_limit"
    with pytest.raises(ValueError, match="component"):
        unsnarl.relaxed_wire(unsnarl.knot_of_table("hopf"))


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


def test_pairs_say_which_curve_becomes_which():
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
    sides = [square, square + 9]
    assert unsnarl.planar_isotopy(sides, sides).report["becomes"] == [0, 1]
    exchanged = unsnarl.planar_isotopy(sides, sides, pairs=[(0, 1), (1, 0)])
    assert exchanged.status == "embedded" and exchanged.report["becomes"] == [1, 0]
    np.testing.assert_array_equal(exchanged.rings[-1][0], sides[1])
    for ring in exchanged.rings:
        assert len(unsnarl.find_crossings(ring, closed=True)) == 0
    assert unsnarl.planar_isotopy(sides, sides[::-1], pairs=[]).report["becomes"] == [1, 0]
    with pytest.raises(ValueError, match="two pairs name curve 0 of the start"):
        unsnarl.planar_isotopy(sides, sides, pairs=[(0, 0), (0, 1)])
    with pytest.raises(ValueError, match="is no list of pairs"):
        unsnarl.planar_isotopy(sides, sides, pairs=[(0, -1)])


def test_an_unknot_becomes_a_circle_and_a_trefoil_does_not():
    knot, circle, trefoil = (unsnarl.knot_of_table(name)[0] for name in ("kinks_1", "circle", "3_1"))
    way = unsnarl.knot_isotopy(knot, circle)
    assert way.status == "embedded" and way.report["hold"] and way.times[0] == 0 and way.times[-1] == 1
    np.testing.assert_array_equal(way.rings[0], knot)
    np.testing.assert_array_equal(way.rings[-1], circle)
    none = unsnarl.knot_isotopy(trefoil, circle)
    assert none.status == "no_progress" and not none.rings and not none.report["hold"]
    with pytest.raises(ValueError, match="edge 0 of component 0"):
        unsnarl.knot_isotopy(np.array([[0, 0, 0], [2, 2, 0], [2, 0, 0], [0, 2, 0]]), circle)


def test_what_makes_no_sense():
    with pytest.raises(ValueError, match="component 0 has shape"):
        unsnarl.seifert_surface(np.zeros((4, 2)))
    with pytest.raises(ValueError, match="points 0 and 1 of component 0 are one"):
        unsnarl.seifert_surface(np.zeros((4, 3)))
    with pytest.raises(ValueError, match="no knot"):
        unsnarl.knot_of_table("11_1")
