"""Repair of a moving mesh, frame by frame."""

from __future__ import annotations

from collections.abc import Sequence
from ctypes import c_size_t
from dataclasses import dataclass
from typing import Any, NamedTuple, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arguments import allowing, face_flags, frame_range, surface_of, vertex_flags
from ._call import Status, call_and_wait
from ._options import options_of
from ._progress import OnProgress
from ._types import Faces, Goal, Positions, Precision, Weld


class Jitter(NamedTuple):
    """Second difference of the corrections in time, in the frame's own motion / diagonal of the frame; of all
    vertices."""

    mean: float
    max: float


@dataclass(frozen=True)
class Frame:
    """What became of a frame. Lengths are relative to the diagonal of its bounding box."""

    frame: int
    status: Status  #: only "embedded" and "gap_not_met" promise a frame without self-intersections
    before: dict[str, int]  #: intersecting pairs of faces by kind, see Intersections.kinds
    after: dict[str, int]
    allowed_before: dict[str, int]  #: pairs that may intersect and do, which the others leave out
    allowed_after: dict[str, int]
    diagonal: float
    displacement_mean_rel: float
    displacement_max_rel: float
    untouched_share: float  #: share of vertices that are bit-identical to the input
    float32_embedded: bool
    precision: str
    is_smoothed: bool  #: False: as it came out before corrections were averaged
    changed_components: list[dict[str, Any]]  #: as in Result.report, before corrections are averaged
    alone: Optional[Jitter]  #: before corrections are averaged; None at the ends
    jitter: Optional[Jitter]  #: of the results; None at the ends of the range


class SequenceResult(NamedTuple):
    V: Positions  #: (frames, n, 3): those of the range, in the dtype of the input as for repair
    frames: list[Frame]

    @property
    def embedded(self) -> bool:
        """Every frame of the range is."""
        return all(frame.status == Status.embedded for frame in self.frames)


def repair_sequence(
    V: ArrayLike,
    F: Faces,
    fixed: Optional[ArrayLike] = None,
    *,
    allow: Optional[Sequence[Any]] = None,
    frames: Optional[tuple[int, int]] = None,
    goal: Goal = "all",
    precision: Precision = "auto",
    min_gap: float = 0.0,
    gap_near_conflicts: bool = False,
    max_displacement: float = 0.0,
    time_limit: float = 0.0,
    weld: Weld = "seams",
    weld_tolerance: float = 0.0,
    both_diagonals: bool = False,
    threads: int = 0,
    progress: OnProgress = None,
) -> SequenceResult:
    """Repairs the frames of a moving mesh so that corrections go on smoothly in time, and certifies each by itself.

    Frames without self-intersections stay as they are. Other Python threads run meanwhile. Ctrl-C, or an exception in
    `progress`, cancels and is raised.

    Parameters
    ----------
    V, F
        Positions (frames, n, 3), and faces as for repair, the same in all frames.
    fixed
        Vertices that must not move: a mask (n,) of bool, or their ids.
    allow
        Pairs of faces that may intersect, as for repair.
    frames
        The range wanted, (first, last) with last excluded. Those around it are seen, so that the result of a frame does
        not depend on the range. None: all.
    goal, precision, min_gap, gap_near_conflicts, max_displacement, time_limit
        As for repair, of each frame.
    weld, weld_tolerance, both_diagonals, threads
        As for find_intersections.
    progress
        Called with a Progress after each frame; True draws a bar.

    Raises
    ------
    ValueError, TypeError
        As for repair. A frame that could not be untangled raises nothing: see Frame.status.
    """
    given = np.asarray(V)
    if given.ndim != 3 or given.shape[2] != 3 or given.shape[0] == 0:
        raise ValueError(f"V has shape {given.shape}; give (frames, n, 3), x y z of each vertex of each frame")
    surface = surface_of(given[0], F)
    surface = allowing(surface, allow, lambda part, name: face_flags(part, surface.face_count, name))
    if given.dtype.kind not in "fiu":
        raise TypeError(f"V has dtype {given.dtype}; positions are real numbers")
    positions = np.array(given, dtype=np.float64, order="C", copy=True)
    first, last = frame_range(frames, len(positions))
    is_float32 = given.dtype.kind == "f" and given.dtype.itemsize == 4
    if is_float32 and precision == "auto":
        precision = "float32"
    options = options_of(
        goal=goal,
        precision=precision,
        min_gap=min_gap,
        gap_near_conflicts=gap_near_conflicts,
        max_displacement=max_displacement,
        time_limit=time_limit,
        weld=weld,
        weld_tolerance=weld_tolerance,
        both_diagonals=both_diagonals,
        threads=threads,
        first_frame=first,
        last_frame=last,
    )
    struct = surface.struct(positions=positions, fixed=vertex_flags(fixed, positions.shape[1]))
    repaired = call_and_wait("repair_sequence", struct, c_size_t(len(positions)), options, progress=progress)
    moved = repaired.array("positions").reshape(-1, *positions.shape[1:])
    if is_float32 and precision == "float32":
        moved = moved.astype(given.dtype)
    return SequenceResult(moved, [frame_of(report) for report in repaired.report])


def frame_of(report: dict[str, Any]) -> Frame:
    """The frame that a report lists so."""

    def jitter(name: str) -> Optional[Jitter]:
        value = report[name]
        return Jitter(value["mean_rel"], value["max_rel"]) if value else None

    return Frame(
        frame=report["frame"],
        status=Status(report["status"]),
        before=report["before"]["by_class"],
        after=report["after"]["by_class"],
        allowed_before=report["allowed"]["before"]["by_class"],
        allowed_after=report["allowed"]["after"]["by_class"],
        diagonal=report["diagonal"],
        displacement_mean_rel=report["displacement_mean_rel"],
        displacement_max_rel=report["displacement_max_rel"],
        untouched_share=report["untouched_share"],
        float32_embedded=report["float32_embedded"],
        precision=report["precision"],
        is_smoothed=report["is_smoothed"],
        changed_components=report["changed_components"],
        alone=jitter("jitter_alone"),
        jitter=jitter("jitter"),
    )
