"""What may be passed in, that it is left alone, and what is said about the rest."""

import numpy as np
import pytest

import unsnarl


def same_bits(a, b):
    return a.dtype == b.dtype and a.shape == b.shape and a.tobytes() == b.tobytes()


@pytest.mark.parametrize("dtype", ["f8", ">f8", "f2", "longdouble", "i1", "u2", "i8"])
def test_positions_of_any_dtype(crossing, dtype):
    V, F = crossing[0] + 1, crossing[1]  # no negative number
    expected = unsnarl.repair(V, F)
    result = unsnarl.repair(V.astype(dtype), F)
    assert result.status == "embedded"
    assert result.V.dtype == np.float64
    assert same_bits(result.V, expected.V)


@pytest.mark.parametrize("dtype", ["f4", ">f4"])
def test_float32_stays_float32(crossing, dtype):
    V, F = crossing
    result = unsnarl.repair(V.astype(dtype), F)
    assert result.V.dtype == np.dtype(dtype)
    assert result.report["options"]["precision"] == "float32"
    assert unsnarl.certify(V, F, result.V).embedded
    assert unsnarl.repair(V.astype(dtype), F, precision="float64").V.dtype == np.float64


@pytest.mark.parametrize("dtype", ["i1", "u1", "i2", ">i4", "u4", "i8", "u8"])
def test_faces_of_any_dtype(sheets, dtype):
    V, F = sheets[0][:100], sheets[1][sheets[1].max(axis=1) < 100]
    assert same_bits(unsnarl.repair(V, F.astype(dtype)).V, unsnarl.repair(V, F).V)


@pytest.mark.parametrize(
    "arranged",
    [
        np.asfortranarray,
        lambda array: np.repeat(array, 2, axis=0)[::2],
        lambda array: np.ascontiguousarray(array[:, ::-1])[:, ::-1],
        lambda array: array.tolist(),
    ],
    ids=["fortran", "strided", "negative_strides", "lists"],
)
def test_any_memory_order(sheets, arranged):
    V, F = sheets
    assert same_bits(unsnarl.repair(arranged(V), arranged(F)).V, unsnarl.repair(V, F).V)
    found, expected = unsnarl.find_intersections(arranged(V), arranged(F)), unsnarl.find_intersections(V, F)
    assert np.array_equal(found.pairs, expected.pairs)


def test_quads_are_polygons_of_four(sheets):
    V, F = sheets
    polygons = (F.ravel(), 4 * np.arange(len(F) + 1))
    assert same_bits(unsnarl.repair(V, F).V, unsnarl.repair(V, polygons).V)
    assert "quad" in unsnarl.repair(V, F).report["input"]["triangulation"]


def test_inputs_are_left_alone(sheets):
    V, F = sheets
    fixed = np.array([0, 5])
    before = [array.copy() for array in (V, F, fixed)]
    for array in (V, F, fixed):
        array.setflags(write=False)
    result = unsnarl.repair(V, F, fixed)
    assert result.status == "embedded"
    assert all(same_bits(a, b) for a, b in zip((V, F, fixed), before))
    assert not np.shares_memory(result.V, V)
    result.V[0] = 0  # the caller's to change


def test_progress_may_change_what_was_passed_in(sheets):
    V, F = sheets
    expected = unsnarl.repair(V, F)

    def spoil(_):
        V[:] = np.nan
        F[:] = 0

    assert same_bits(unsnarl.repair(V, F, progress=spoil).V, expected.V)


def test_empty_meshes():
    for V, F in (([], []), (np.zeros((3, 3)), []), (np.zeros((0, 3)), np.zeros((0, 4), int)), ([], ([], [0]))):
        result = unsnarl.repair(V, F)
        assert result.status == "embedded"
        assert result.V.shape == (len(V), 3)
        assert len(unsnarl.find_intersections(V, F)) == 0


def test_fixed_as_mask_or_as_ids(sheets):
    V, F = sheets
    mask = np.arange(len(V)) < len(V) // 2
    by_mask, by_ids = unsnarl.repair(V, F, mask), unsnarl.repair(V, F, np.flatnonzero(mask))
    assert same_bits(by_mask.V, by_ids.V)
    assert same_bits(by_mask.V[mask], V[mask])
    assert by_mask.report["options"]["fixed_vertices"] == mask.sum()
    assert same_bits(unsnarl.repair(V, F, []).V, unsnarl.repair(V, F).V)


A = np.zeros((6, 3))
T = np.array([[0, 1, 2], [3, 4, 5]])


@pytest.mark.parametrize(
    "error, message, call",
    [
        (ValueError, r"V has shape \(3, 6\).*V\.T", lambda: unsnarl.repair(A.T, T)),
        (ValueError, r"V has shape \(6, 2\); give \(n, 3\)", lambda: unsnarl.repair(A[:, :2], T)),
        (ValueError, r"V has shape \(18,\)", lambda: unsnarl.find_intersections(A.ravel(), T)),
        (ValueError, "V has rows of different lengths", lambda: unsnarl.repair([[0, 0, 0], [1, 2]], T)),
        (TypeError, "V has dtype complex128", lambda: unsnarl.repair(A + 1j, T)),
        (TypeError, "V has dtype <U1", lambda: unsnarl.repair([["a", "b", "c"]], T)),
        (ValueError, "vertex 1 has a coordinate that is not a finite",
         lambda: unsnarl.repair([[0] * 3, [0, 0, np.nan]], [])),
        (ValueError, r"F has shape \(2, 2\); give \(m, 3\) triangles", lambda: unsnarl.repair(A, T[:, :2])),
        (ValueError, "F has rows of different lengths; polygons of mixed sizes are a tuple",
         lambda: unsnarl.repair(A, [[0, 1, 2], [0, 1, 2, 3]])),
        (TypeError, "F has dtype float64; vertex ids are integers", lambda: unsnarl.repair(A, T.astype(float))),
        (TypeError, "F has dtype bool", lambda: unsnarl.repair(A, T > 1)),
        (ValueError, "face 1 uses vertex 6, but there are 6", lambda: unsnarl.repair(A, T + [[0], [1]])),
        (ValueError, "face 0 uses vertex -1", lambda: unsnarl.repair(A, T - 1)),
        (ValueError, "F holds 4294967298", lambda: unsnarl.repair(A, T + 2**32 - 3)),
        (ValueError, "F holds 18446744073709551615",
         lambda: unsnarl.repair(A, np.full((1, 3), 2**64 - 1, np.uint64))),
        (ValueError, "offsets run from 0 to 5; give them from 0 to 6",
         lambda: unsnarl.repair(A, (T.ravel(), [0, 3, 5]))),
        (ValueError, "offsets run over nothing", lambda: unsnarl.repair(A, (T.ravel(), []))),
        (ValueError, "face 1 runs from offset 5 to 3", lambda: unsnarl.repair(A, (T.ravel(), [0, 5, 3, 6]))),
        (ValueError, "corners has shape", lambda: unsnarl.repair(A, (T, [0, 3, 6]))),
        (ValueError, "fixed has 5 flags, but there are 6", lambda: unsnarl.repair(A, T, np.zeros(5, bool))),
        (ValueError, r"fixed\[1\] is 6, but there are 6", lambda: unsnarl.repair(A, T, [0, 6])),
        (ValueError, r"fixed\[0\] is -1", lambda: unsnarl.repair(A, T, [-1])),
        (ValueError, "give a mask as bool", lambda: unsnarl.repair(A, T, [0, 1, 0, 0, 0, 1])),
        (TypeError, "fixed has dtype float64", lambda: unsnarl.repair(A, T, [0.5])),
        (ValueError, "goal is 'none'; choose one of 'all', 'disjoint'", lambda: unsnarl.repair(A, T, goal="none")),
        (ValueError, "precision is 'half'; choose one of 'float32', 'float64'",
         lambda: unsnarl.repair(A, T, precision="half")),
        (TypeError, "precision is None; give its name", lambda: unsnarl.repair(A, T, precision=None)),
        (ValueError, "weld is 'some'; choose one of 'none', 'seams', 'all'",
         lambda: unsnarl.find_intersections(A, T, weld="some")),
        (ValueError, "weld_tolerance is -1; give a number from 0 on",
         lambda: unsnarl.find_intersections(A, T, weld_tolerance=-1)),
        (ValueError, "min_gap is nan", lambda: unsnarl.repair(A, T, min_gap=np.nan)),
        (ValueError, "max_displacement is -0.1", lambda: unsnarl.repair(A, T, max_displacement=-0.1)),
        (TypeError, "time_limit is 'soon'; give a number", lambda: unsnarl.repair(A, T, time_limit="soon")),
        (TypeError, "threads is 1.5; give a whole number", lambda: unsnarl.repair(A, T, threads=1.5)),
        (ValueError, "threads is -1; give 0 for as many", lambda: unsnarl.find_intersections(A, T, threads=-1)),
        (TypeError, "progress is 3; give a function", lambda: unsnarl.repair(A, T, progress=3)),
        (TypeError, "ndarray is no mesh: give arrays V and F", lambda: unsnarl.repair(A)),
        (ValueError, "there are 5 positions for a surface of 6", lambda: unsnarl.certify(A, T, A[:5])),
        (ValueError, r"moved has shape \(6, 2\)", lambda: unsnarl.certify(A, T, A[:, :2])),
    ],
)
def test_errors_say_what_and_where(error, message, call):
    with pytest.raises(error, match=message):
        call()
