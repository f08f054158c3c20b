"""Samples are those of the program."""

import numpy as np
import pytest
from command_line import run, sample

import unsnarl


@pytest.mark.parametrize("name", ["crossing_tubes", "klein_bottle"])
def test_surfaces_are_those_of_the_program(tmp_path, name):
    V, F = unsnarl.sample(name, resolution=12)
    expected, faces = sample(tmp_path / "s.obj", name, "--resolution", "12")
    assert np.array_equal(V, expected)
    if isinstance(F, tuple):
        assert all(np.array_equal(a, b) for a, b in zip(F, faces))
    else:
        assert np.array_equal(F, faces)
    assert len(unsnarl.find_intersections(V, F)) > 0


def test_parameters_shape_them(tmp_path):
    V, _ = unsnarl.sample("crossing_tubes", resolution=12, radius=0.3)
    expected, _ = sample(tmp_path / "s.obj", "crossing_tubes", "--resolution", "12", "--set", "radius=0.3")
    assert np.array_equal(V, expected)


def test_all_are_listed():
    listed = run("sample", "--list").split("\n\n")[0].splitlines()
    assert [line.split()[0] for line in listed] == [one.name for one in unsnarl.samples()]
    tubes = next(one for one in unsnarl.samples() if one.name == "crossing_tubes")
    assert tubes.embeddable and "radius" in [parameter.name for parameter in tubes.parameters]
    assert not all(one.embeddable for one in unsnarl.samples())


@pytest.mark.parametrize(
    "arguments, words",
    [(("nothing",), "nothing"), (("crossing_tubes", 3), "resolution"), (("crossing_tubes", -1), "resolution")],
)
def test_what_makes_no_sense_is_refused(arguments, words):
    name, resolution = (*arguments, 0)[:2]
    with pytest.raises(ValueError, match=words):
        unsnarl.sample(name, resolution=resolution)
    with pytest.raises(ValueError, match="widht"):
        unsnarl.sample("crossing_tubes", widht=1)
