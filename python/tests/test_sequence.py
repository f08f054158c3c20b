"""Frames of a moving mesh."""

import numpy as np
import pytest

import unsnarl

SIDE, FRAMES = 7, 10


def moving_tent():
    """A sheet, and a tent that comes down through it and goes up again; the first and the last frame are fine."""
    i, j = np.meshgrid(np.arange(SIDE), np.arange(SIDE), indexing="ij")
    sheet = np.stack([0.5 * i, 0.5 * j, 0.02 * (i * j % 3)], axis=-1).reshape(-1, 3)
    tent = np.array([[1.4, 1.6, 0], [0.9, 1.1, 1], [2.1, 1.2, 1], [1.5, 2.2, 1]])
    height = 0.5 - 0.75 * np.sin(np.pi * np.arange(FRAMES) / (FRAMES - 1))
    V = np.stack([np.vstack([sheet, tent + [0, 0, z]]) for z in height])
    a = (i * SIDE + j)[:-1, :-1].ravel()
    F = np.vstack([np.stack([a, a + SIDE, a + SIDE + 1], 1), np.stack([a, a + SIDE + 1, a + 1], 1)])
    tip = SIDE * SIDE
    return V, np.vstack([F, [[tip, tip + 1 + k, tip + 1 + (k + 1) % 3] for k in range(3)]])


V, F = moving_tent()


def test_frames_are_embedded_and_go_on_smoothly():
    result = unsnarl.repair_sequence(V, F)
    assert result.embedded and result.V.shape == V.shape and len(result.frames) == FRAMES
    for before, after, frame in zip(V, result.V, result.frames):
        pairs = len(unsnarl.find_intersections(before, F))
        assert sum(frame.before.values()) == pairs and sum(frame.after.values()) == 0
        assert unsnarl.certify(before, F, after).embedded
        if pairs == 0:
            assert np.array_equal(before, after)
    known = [frame for frame in result.frames if frame.jitter]
    assert len(known) == FRAMES - 2
    assert sum(f.jitter.mean for f in known) < sum(f.alone.mean for f in known)
    assert any(frame.is_smoothed for frame in result.frames)


def test_a_range_comes_out_as_in_the_whole_at_any_number_of_threads():
    whole = unsnarl.repair_sequence(V, F, threads=1)
    part = unsnarl.repair_sequence(V, F, frames=(3, 6))
    assert np.array_equal(part.V, whole.V[3:6]) and [f.frame for f in part.frames] == [3, 4, 5]


def test_a_steady_sequence_is_repaired_as_its_frame():
    still = np.repeat(V[5:6], 4, axis=0)
    result = unsnarl.repair_sequence(still, F)
    assert result.embedded
    assert all(np.allclose(frame, result.V[0], atol=1e-5) for frame in result.V)


def test_fixed_vertices_and_float32_stay():
    fixed = np.arange(SIDE * SIDE)
    result = unsnarl.repair_sequence(V.astype(np.float32), F, fixed)
    assert result.embedded and result.V.dtype == np.float32
    assert np.array_equal(result.V[:, fixed], V.astype(np.float32)[:, fixed])


def test_progress_and_interruption():
    fractions = []
    unsnarl.repair_sequence(V, F, progress=lambda p: fractions.append(p.fraction))
    assert fractions == sorted(fractions) and fractions[-1] == 1

    def stop(progress):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        unsnarl.repair_sequence(V, F, progress=stop)


def test_what_makes_no_sense_is_refused():
    with pytest.raises(ValueError, match="frames, n, 3"):
        unsnarl.repair_sequence(V[0], F)
    with pytest.raises(ValueError, match="frames"):
        unsnarl.repair_sequence(V, F, frames=(3, 11))
    with pytest.raises(TypeError, match="frames"):
        unsnarl.repair_sequence(V, F, frames=3)
    with pytest.raises(ValueError):
        unsnarl.repair_sequence(V, F + 100)
    bad = V.copy()
    bad[4, 3, 1] = np.nan
    with pytest.raises(ValueError):
        unsnarl.repair_sequence(bad, F)
