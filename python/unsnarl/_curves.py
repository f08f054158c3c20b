"""Curves in the plane that cross themselves and each other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._arguments import polylines_of, vertex_flags
from ._call import Status, call, call_and_wait
from ._options import options_of
from ._progress import OnProgress


@dataclass(frozen=True)
class CurveResult:
    """What untangle_curves gives back."""

    curves: list[NDArray[np.float64]]
    """Points (n, 2) of each curve, in the order of the input. Beside crossings, and where an open curve ends on a
    segment, curves have more points; at crossings they are joined in another way."""
    status: Status
    """embedded, obstructed (only what must not move crosses), reduced, no_progress, time_limit or cancelled."""
    report: dict[str, Any]
    """Counts, displacement and distance from the input's drawing (fractions of the diagonal), joints, and as arrays
    (m, 4) of curve, segment, curve, segment: "obstructions" and "left"."""


def find_crossings(curves: Any, closed: Any = False) -> NDArray[np.int32]:
    """All pairs of segments that meet anywhere but in an end that they share along one curve, by exact arithmetic.

    curves, closed: as for untangle_curves. Returns rows (curve, segment, curve, segment), sorted; segment k starts at
    point k.
    """
    polylines = polylines_of(curves, 2, "curve")
    return call("find_crossings", polylines.struct(closed=_closed(closed, len(polylines.sizes)))).array("crossings")


def untangle_curves(
    curves: Any,
    closed: Any = False,
    *,
    fixed: Sequence[Any] | None = None,
    fix_ends: bool = False,
    move_strands: bool = False,
    gap: float = 4e-3,
    junction: float = 1e-9,
    time_limit: float = 0,
    recover: bool = True,
    progress: OnProgress = None,
) -> CurveResult:
    """Joins polylines in the plane in another way at crossings until no two segments cross or touch.

    Parameters
    ----------
    curves
        A list of arrays (n, 2) of points, or one such array for one curve.
    closed
        Whether the last point of a curve is joined to its first: one bool, or one a curve.
    fixed
        For each curve the points that must not move, as a mask (n,) of bool, ids, or None. None: all may move.
    fix_ends
        The ends of open curves must not move.
    move_strands
        True: every curve keeps its points, in their order, and strands are moved past each other. False: curves are
        joined in another way at crossings, so that the drawing stays.
    gap
        Distance to keep where a crossing was opened, as a fraction of the diagonal, in (0, 0.1].
    junction
        An open curve that ends this close to another one ends on it and stays there, as a fraction of the diagonal.
    time_limit
        Seconds after which to stop. 0: none.
    recover
        False: stop once nothing crosses, without opening and smoothing anything (for research).
    progress
        Called with a Progress now and then; True draws a bar.

    Raises
    ------
    ValueError, TypeError
        For points that are no curve, naming the curve and the point. Crossings that could not be resolved raise
        nothing: see CurveResult.status.
    """
    polylines = polylines_of(curves, 2, "curve")
    struct = polylines.struct(
        closed=_closed(closed, len(polylines.sizes)), fixed=_fixed(fixed, polylines.sizes)
    )
    options = options_of(
        gap=gap,
        junction=junction,
        fix_ends=fix_ends,
        move_strands=move_strands,
        time_limit=time_limit,
        recover=recover,
    )
    done = call_and_wait("untangle_curves", struct, options, progress=progress)
    report = done.report
    for crossings in ("obstructions", "left"):
        report[crossings] = done.array(crossings)
    return CurveResult(done.polylines(), done.status, report)


def _fixed(fixed: Sequence[Any] | None, sizes: NDArray[np.int32]) -> NDArray[np.uint8]:
    """One flag a point of all curves; empty: all may move."""
    if fixed is None:
        return np.empty(0, np.uint8)
    if len(fixed) != len(sizes):
        raise ValueError(f"fixed has {len(fixed)} entries, but there are {len(sizes)} curves")
    flags = [vertex_flags(own, size) for own, size in zip(fixed, sizes)]
    return np.concatenate([own if own.size > 0 else np.zeros(size, np.uint8) for own, size in zip(flags, sizes)])


def _closed(closed: Any, count: int) -> NDArray[np.uint8]:
    """One flag a curve."""
    if np.ndim(closed) == 0:
        return np.full(count, bool(closed), dtype=np.uint8)
    if len(closed) != count:
        raise ValueError(f"closed has {len(closed)} entries, but there are {count} curves")
    return np.array([bool(own) for own in closed], dtype=np.uint8)
