"""Repairs are those of the command line, bit for bit; and what else a result holds."""

import numpy as np
import pytest

import unsnarl
from command_line import fix, positions_of_ply, read_obj, sample, without_measurements, write_ply


def assert_same_bits(a, b):
    assert a.dtype == b.dtype and a.shape == b.shape
    assert a.tobytes() == b.tobytes(), f"{np.sum(np.any(a != b, axis=1))} of {len(a)} vertices differ"


def assert_same_float32_numbers(ours, written, rest):
    """Of text, where the program writes moved coordinates with the digits that give the float32 number back."""
    moved = written != rest
    assert_same_bits(np.where(moved, rest, ours), rest)
    assert_same_bits(ours, np.where(moved, written.astype(np.float32), ours))


def assert_same_report(ours, theirs, exact):
    ours, theirs = without_measurements(ours), without_measurements(theirs)
    if not exact:
        for key in [key for key, value in ours.items() if isinstance(value, float)]:
            assert ours.pop(key) == pytest.approx(theirs.pop(key), rel=1e-4, abs=1e-9), key
        for when, measured in ours.pop("clearance").items():
            for name, smallest in theirs["clearance"][when].items():
                assert measured[name]["value"] == pytest.approx(smallest["value"], rel=1e-2, abs=1e-6), (when, name)
        del theirs["clearance"]
    assert ours == theirs


@pytest.mark.parametrize(
    "options, keywords",
    [
        ([], {}),
        (["--precision", "float64", "--threads", 1], {"precision": "float64", "threads": 1}),
        (["--goal", "disjoint", "--no-recover"], {"goal": "disjoint", "recover": False}),
    ],
    ids=["default", "float64", "disjoint"],
)
def test_same_as_the_command_line(tmp_path, options, keywords):
    source, target = tmp_path / "in.obj", tmp_path / "out.obj"
    V, F = sample(source, "mobius_extended", "--resolution", 60)
    report = fix(source, target, *options)
    result = unsnarl.repair(V, F, **keywords)
    assert result.status == "embedded" and not np.array_equal(result.V, V)
    exact = "precision" in keywords
    if exact:
        assert_same_bits(result.V, read_obj(target)[0])
    else:
        assert_same_float32_numbers(result.V, read_obj(target)[0], V)
    assert_same_report(result.report, report, exact)


def test_same_as_the_command_line_with_quads_and_fixed_vertices(tmp_path, sheets):
    V, F = sheets
    source, target, ids = tmp_path / "in.obj", tmp_path / "out.obj", tmp_path / "fixed.txt"
    source.write_text(
        "".join("v {!r} {!r} {!r}\n".format(*p) for p in V.tolist())
        + "".join("f " + " ".join(map(str, f + 1)) + "\n" for f in F)
    )
    fixed = np.arange(len(V) // 2)
    ids.write_text(" ".join(map(str, fixed)))
    options = ["--fix-vertices", ids, "--min-gap", 0.01, "--absolute", "--precision", "float64"]
    report = fix(source, target, *options)
    result = unsnarl.repair(V, F, fixed, min_gap=0.01, absolute=True, precision="float64")
    assert_same_bits(result.V, read_obj(target)[0])
    assert_same_bits(result.V[fixed], V[fixed])
    assert_same_report(result.report, report, exact=True)


def two_sheets(apart):
    grid = [(i / 4, j / 4) for i in range(5) for j in range(5)]
    V = np.array([(x, y, z) for z in (0.0, apart) for x, y in grid])
    quads = [(5 * i + j, 5 * i + j + 5, 5 * i + j + 6, 5 * i + j + 1) for i in range(4) for j in range(4)]
    return V, np.array(quads + [tuple(v + 25 for v in q) for q in quads])


def test_gaps_are_kept_wherever_sheets_are_near():
    V, F = two_sheets(0.001)
    result = unsnarl.repair(V, F, min_gap=0.02, absolute=True)
    assert result.status == "embedded" and result.report["gap"]["met"]
    assert result.V[25:, 2].min() - result.V[:25, 2].max() >= 0.0198
    held = unsnarl.repair(V, F, np.ones(len(V), bool), min_gap=0.02, absolute=True)
    assert held.status == "gap_not_met" and held.report["exit_code"] == 10
    assert held.report["gap"]["between_held"]
    assert held.report["gap"]["smallest"] == pytest.approx(0.001)
    near = unsnarl.repair(V, F, min_gap=0.02, absolute=True, gap_near_conflicts=True)
    assert near.status == "embedded" and near.report["gap"] is None
    assert_same_bits(near.V, V)


def test_same_as_the_command_line_in_float32(tmp_path, sheets):
    V, F = sheets
    source, target = tmp_path / "in.ply", tmp_path / "out.ply"
    write_ply(source, V, F)
    report = fix(source, target)
    result = unsnarl.repair(V.astype(np.float32), F)
    assert_same_bits(result.V, positions_of_ply(target, len(V)))
    assert_same_report(result.report, report, exact=True)


def test_what_has_no_conflict_comes_back_as_it_was():
    V = np.random.default_rng(1).normal(size=(3, 3))
    result = unsnarl.repair(V, [[0, 1, 2]])
    assert result.status == unsnarl.Status.embedded
    assert_same_bits(result.V, V)
    assert result.mesh is None


def test_what_cannot_be_untangled_raises_nothing(tmp_path):
    V, F = sample(tmp_path / "klein.obj", "klein_bottle", "--resolution", "20")
    result = unsnarl.repair(V, F)
    assert result.status == "obstructed"
    assert result.report["obstructions"][0]["kind"] == "closed_non_orientable"
    assert result.report["exit_code"] == 7
    assert_same_bits(result.V, V)


def test_limits_are_statuses(sheets):
    V, F = sheets
    assert unsnarl.repair(V, F, time_limit=1e-9).status == "time_limit"
    assert unsnarl.repair(V, F, memory_limit=1).status == "memory_limit"
    assert unsnarl.repair(V, F, max_displacement=1e-6).status == "displacement_exceeded"


def test_max_displacement_in_units_of_the_mesh(sheets):
    V, F = sheets
    result = unsnarl.repair(V, F)
    largest = np.linalg.norm(result.V - V, axis=1).max()
    assert unsnarl.repair(V, F, max_displacement=1.01 * largest, absolute=True).status == "embedded"
    least = result.report["displacement_lower_bound_rel"] * result.report["diagonal"]
    assert unsnarl.repair(V, F, max_displacement=0.9 * least, absolute=True).status == "displacement_exceeded"


def test_result_in_words(crossing):
    result = unsnarl.repair(*crossing)
    assert str(result.status) == "embedded"
    assert repr(result).startswith("Result(embedded: 1 intersecting pairs before, 0 after; moved by ")
    report = result.report
    assert (report["schema"], report["version"]) == ("unsnarl-report", unsnarl.__version__)
    assert report["input"]["path"] is None
    assert report["output"] == {"written": False, "path": None, "partial": []}
    assert report["displacement_max_rel"] * report["diagonal"] == pytest.approx(
        np.linalg.norm(result.V - crossing[0], axis=1).max()
    )
