"""Curves in the plane that cross themselves and each other."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._arguments import _array, not_negative, vertex_flags
from ._repair import Progress, Status, _callback


@dataclass(frozen=True)
class CurveResult:
    """What untangle_curves gives back."""

    curves: list[NDArray[np.float64]]
    """Points (n, 2) of each curve, in the order of the input. Where an open curve ends on a segment of another one, that
    has a point more."""
    status: Status
    """embedded, obstructed (only what must not move crosses), reduced, no_progress, time_limit or cancelled."""
    report: dict[str, Any]
    """Counts, displacement and distance from the input's drawing (fractions of the diagonal), joints, and as arrays
    (m, 4) of curve, segment, curve, segment: "obstructions" and "left"."""


def find_crossings(curves: Any, closed: Any = False) -> NDArray[np.int32]:
    """All pairs of segments that meet anywhere but in an end that they share along one curve, by exact arithmetic.

    curves, closed: as for untangle_curves. Returns rows (curve, segment, curve, segment), sorted; segment k starts at point k.
    """
    points = _points(curves)
    return _native.find_crossings(points, _closed(closed, len(points)))


def untangle_curves(
    curves: Any,
    closed: Any = False,
    *,
    fixed: Sequence[Any] | None = None,
    fix_ends: bool = False,
    gap: float = 4e-3,
    junction: float = 1e-9,
    time_limit: float = 0,
    recover: bool = True,
    progress: Callable[[Progress], object] | None = None,
) -> CurveResult:
    """Moves the points of polylines in the plane as little as possible until no two segments cross or touch.

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
    gap
        Distance to keep where a crossing was opened, as a fraction of the diagonal, in (0, 0.1].
    junction
        An open curve that ends this close to another one ends on it and stays there, as a fraction of the diagonal.
    time_limit
        Seconds after which to stop. 0: none.
    recover
        False: stop once nothing crosses, without opening and smoothing anything (for research).
    progress
        Called with a Progress now and then.

    Raises
    ------
    ValueError, TypeError
        For points that are no curve, naming the curve and the point. Crossings that could not be resolved raise nothing:
        see CurveResult.status.
    """
    points = _points(curves)
    flags = [np.empty(0, np.uint8) for _ in points]
    if fixed is not None:
        if len(fixed) != len(points):
            raise ValueError(f"fixed has {len(fixed)} entries, but there are {len(points)} curves")
        flags = [vertex_flags(f, len(p) // 2) for f, p in zip(fixed, points)]
    moved, status, report = _native.untangle_curves(
        points,
        _closed(closed, len(points)),
        flags,
        gap=not_negative("gap", gap),
        junction=not_negative("junction", junction),
        fix_ends=bool(fix_ends),
        time_limit=not_negative("time_limit", time_limit),
        recover=bool(recover),
        progress=None if progress is None else _callback(progress),
    )
    return CurveResult([m.reshape(-1, 2) for m in moved], Status(status), report)


def _points(curves: Any) -> list[NDArray[np.float64]]:
    if isinstance(curves, np.ndarray) and curves.ndim == 2:
        curves = [curves]
    result = []
    for number, curve in enumerate(curves):
        points = _array(curve, f"curve {number}")
        if points.dtype.kind not in "fiu":
            raise TypeError(f"curve {number} has dtype {points.dtype}; points are real numbers")
        if points.ndim != 2 or points.shape[1] != 2:
            raise ValueError(f"curve {number} has shape {points.shape}; give (n, 2), x y of each point")
        result.append(np.array(points, dtype=np.float64, order="C", copy=True).ravel())
    return result


def _closed(closed: Any, count: int) -> list[bool]:
    if np.ndim(closed) == 0:
        return [bool(closed)] * count
    if len(closed) != count:
        raise ValueError(f"closed has {len(closed)} entries, but there are {count} curves")
    return [bool(c) for c in closed]
