"""Curves in the plane: the same as the command line, and arguments that make no sense."""

import json
import os
import subprocess

import numpy as np
import pytest

import unsnarl


def figure_eight(n=300):
    t = 2 * np.pi * (np.arange(n) + 0.3) / n
    return np.stack([np.sin(2 * t), 2 * np.sin(t)], axis=1)


def test_a_figure_eight_opens():
    curve = figure_eight()
    assert len(unsnarl.find_crossings(curve, closed=True)) == 1
    result = unsnarl.untangle_curves(curve, closed=True)
    assert result.status == "embedded"
    assert result.curves[0].shape == (len(curve) + result.report["inserted_points"], 2)
    assert result.report["inserted_points"] <= 4, "at most one beside the crossing on each side of each strand"
    assert len(unsnarl.find_crossings(result.curves, closed=True)) == 0
    assert result.report["crossings_before"] == 1 and result.report["crossings_after"] == 0
    assert result.report["distance_max_rel"] < 0.02
    np.testing.assert_array_equal(curve, figure_eight())


def test_strands_are_moved_if_wanted():
    k = 5 * np.arange(13) / 13
    star = np.stack([np.cos(2 * np.pi * k), np.sin(2 * np.pi * k)], axis=1)
    kept = unsnarl.untangle_curves(star, closed=True)
    moved = unsnarl.untangle_curves(star, closed=True, move_strands=True)
    assert kept.status == moved.status == "embedded"
    assert len(kept.curves[0]) > 13 and kept.report["drawing_lost"] == 0
    assert len(moved.curves[0]) == 13 and moved.report["drawing_lost"] > 0.5


def test_sets_with_fixed_points():
    t = 2 * np.pi * np.arange(80) / 80
    circle = np.stack([np.cos(t), np.sin(t)], axis=1)
    line = np.array([[-2.0, 0.3], [-1.2, 0.3], [-0.5, 0.2], [0.5, 0.2], [1.2, 0.3], [2.0, 0.3]])
    result = unsnarl.untangle_curves([circle, line], closed=[True, False], fixed=[None, [0, 5]])
    assert result.status == "embedded"
    np.testing.assert_array_equal(result.curves[1][[0, -1]], line[[0, -1]])
    held = unsnarl.untangle_curves([circle, line], closed=[True, False], fixed=[np.ones(80, bool), np.ones(6, bool)])
    assert held.status == "obstructed" and len(held.report["obstructions"]) == 2


def test_same_as_the_command_line(tmp_path):
    source, target = tmp_path / "in.json", tmp_path / "out.json"
    program = os.environ["UNSNARL_PROGRAM"]
    subprocess.run([program, "sample", "curve_star", "--set", "seed=7", "-o", source], check=True)
    subprocess.run([program, "curves", source, "-o", target, "--quiet"], check=True)
    before, after = (np.array(json.loads(path.read_text())["curves"][0]["points"]) for path in (source, target))
    result = unsnarl.untangle_curves(before, closed=True)
    # The file is rounded to 1e-9 of the diagonal.
    np.testing.assert_allclose(result.curves[0], after, rtol=0, atol=1e-9 * result.report["diagonal"])


def test_progress_and_cancellation():
    curve = figure_eight()
    seen = []
    unsnarl.untangle_curves(curve, closed=True, progress=seen.append)
    assert seen and all(0 <= p.fraction <= 1 for p in seen)

    def stop(_):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        unsnarl.untangle_curves(curve, closed=True, progress=stop)


@pytest.mark.parametrize(
    "arguments, words",
    [
        (dict(curves=np.zeros((3, 3))), "curve 0 has shape"),
        (dict(curves=[[[0, 0], [1, 1]], [[0, 0], [1, 1], [1, 1]]]), "curve 1: points 1 and 2 are equal"),
        (dict(curves=[[[0, 0], [np.nan, 1]]]), "curve 0: a coordinate of point 1"),
        (dict(curves=[[[0, 0], [1, 1]]], closed=[True, False]), "closed has 2 entries"),
        (dict(curves=[[[0, 0], [1, 1]]], fixed=[]), "fixed has 0 entries"),
        (dict(curves=[[[0, 0], [1, 1]]], gap=0.5), "gap_rel is 0.5"),
    ],
)
def test_bad_arguments(arguments, words):
    with pytest.raises(ValueError, match=words):
        unsnarl.untangle_curves(**arguments)
