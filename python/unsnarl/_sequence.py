"""Repair of a moving mesh, frame by frame."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple, Optional

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._arguments import frame_range, name, not_negative, surface_of, thread_count, vertex_flags
from ._repair import Progress, Status, _callback


class Jitter(NamedTuple):
    """Second difference of the corrections in time, in the frame's own motion / diagonal of the frame; of all vertices."""

    mean: float
    max: float


@dataclass(frozen=True)
class Frame:
    """What became of a frame. Lengths are relative to the diagonal of its bounding box."""

    frame: int
    status: Status  #: only "embedded" promises a frame without self-intersections
    before: dict[str, int]  #: intersecting pairs of faces by kind, see Intersections.kinds
    after: dict[str, int]
    diagonal: float
    displacement_mean_rel: float
    displacement_max_rel: float
    untouched_share: float  #: share of vertices that are bit-identical to the input
    float32_embedded: bool
    precision: str
    is_smoothed: bool  #: False: as it came out of a repair by itself
    alone: Optional[Jitter]  #: if this frame and those beside it were repaired each by itself; None at the ends
    jitter: Optional[Jitter]  #: of the results; None at the ends of the range


class SequenceResult(NamedTuple):
    V: NDArray[Any]  #: (frames, n, 3): those of the range, in the dtype of the input as for repair
    frames: list[Frame]

    @property
    def embedded(self) -> bool:
        """Every frame of the range is."""
        return all(frame.status == Status.embedded for frame in self.frames)


def repair_sequence(
    V: Any,
    F: Any,
    fixed: Any = None,
    *,
    frames: Any = None,
    goal: str = "all",
    precision: str = "auto",
    min_gap: float = 0.0,
    max_displacement: float = 0.0,
    time_limit: float = 0.0,
    weld: str = "seams",
    weld_tolerance: float = 0.0,
    both_diagonals: bool = False,
    threads: int = 0,
    progress: Callable[[Progress], object] | None = None,
) -> SequenceResult:
    """Repairs the frames of a moving mesh so that corrections go on smoothly in time; each frame is certified by itself.

    Frames without self-intersections stay as they are. Other Python threads run meanwhile. Ctrl-C, or an exception in
    `progress`, cancels and is raised.

    Parameters
    ----------
    V, F
        Positions (frames, n, 3), and faces as for repair, the same in all frames.
    fixed
        Vertices that must not move: a mask (n,) of bool, or their ids.
    frames
        The range wanted, (first, last) with last excluded. Those around it are seen, so that the result of a frame does
        not depend on the range. None: all.
    goal, precision, min_gap, max_displacement, time_limit
        As for repair, of each frame.
    weld, weld_tolerance, both_diagonals, threads
        As for find_intersections.
    progress
        Called with a Progress after each frame.

    Raises
    ------
    ValueError, TypeError
        As for repair. A frame that could not be untangled raises nothing: see Frame.status.
    """
    given = np.asarray(V)
    if given.ndim != 3 or given.shape[2] != 3 or given.shape[0] == 0:
        raise ValueError(f"V has shape {given.shape}; give (frames, n, 3), x y z of each vertex of each frame")
    surface = surface_of(given[0], F)
    if given.dtype.kind not in "fiu":
        raise TypeError(f"V has dtype {given.dtype}; positions are real numbers")
    positions = np.array(given, dtype=np.float64, order="C", copy=True)
    first, last = frame_range(frames, len(positions))
    is_float32 = given.dtype.kind == "f" and given.dtype.itemsize == 4
    precision = name("precision", precision)
    if is_float32 and precision == "auto":
        precision = "float32"
    moved = positions.copy()
    reports = _native.repair_sequence(
        positions,
        surface.corners,
        surface.offsets,
        vertex_flags(fixed, positions.shape[1]),
        moved,
        first=first,
        last=last,
        goal=name("goal", goal),
        precision=precision,
        min_gap=not_negative("min_gap", min_gap),
        max_displacement=not_negative("max_displacement", max_displacement),
        time_limit=not_negative("time_limit", time_limit),
        weld=name("weld", weld),
        weld_tolerance=not_negative("weld_tolerance", weld_tolerance),
        both_diagonals=bool(both_diagonals),
        threads=thread_count(threads),
        progress=None if progress is None else _callback(progress),
    )
    result = moved[first:last]
    if is_float32 and precision == "float32":
        result = result.astype(given.dtype)
    return SequenceResult(result, [_frame(report) for report in reports])


def _frame(report: dict[str, Any]) -> Frame:
    for counts in ("before", "after"):
        report[counts] = dict(zip(_native.pair_kinds, report[counts]))
    for jitter in ("alone", "jitter"):
        report[jitter] = None if report[jitter] is None else Jitter(*report[jitter])
    report["status"] = Status(report["status"])
    return Frame(**report)
