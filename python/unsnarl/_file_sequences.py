"""Repair of the frames of a moving mesh, from files to files."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike

from ._call import Status
from ._documents import Parts
from ._program import run, scratch_folder, words_of, words_of_parts, words_of_rules
from ._progress import OnProgress
from ._sequence import Frame, frame_of
from ._types import Format, Goal, Names, Numbers, PathLike, Precision, Rules, Weld


@dataclass(frozen=True)
class FileSequenceResult:
    """What fix_sequence came to."""

    frames: list[Frame]  #: those of the range
    names: list[str]  #: of their files; of a point cache those that messages call them by
    output: Path  #: the folder of the frames, or the point cache
    report: dict[str, Any]  #: that of ``unsnarl fix --sequence --report``, docs/sequences.md

    @property
    def embedded(self) -> bool:
        """Every frame of the range is."""
        return all(frame.status == Status.embedded for frame in self.frames)


def fix_sequence(
    paths: Union[PathLike, Sequence[PathLike]],
    output: PathLike,
    fixed: Optional[ArrayLike] = None,
    *,
    frames: Optional[tuple[int, int]] = None,
    keep_partial: bool = False,
    recompute_normals: bool = False,
    format: Optional[Format] = None,
    fix_group: Optional[Names] = None,
    fix_object: Optional[Names] = None,
    fix_material: Optional[Names] = None,
    fix_component: Optional[Numbers] = None,
    fix_boundary: bool = False,
    only_group: Optional[Names] = None,
    only_object: Optional[Names] = None,
    only_material: Optional[Names] = None,
    only_component: Optional[Numbers] = None,
    allow: Rules = None,
    goal: Goal = "all",
    precision: Precision = "auto",
    min_gap: float = 0.0,
    gap_near_conflicts: bool = False,
    max_displacement: float = 0.0,
    absolute: bool = False,
    time_limit: float = 0.0,
    memory_limit: float = 0.0,
    weld: Weld = "seams",
    weld_tolerance: float = 0.0,
    both_diagonals: bool = False,
    each_component: bool = False,
    threads: int = 0,
    progress: OnProgress = None,
) -> FileSequenceResult:
    """Repairs the frames of a moving mesh, file by file, so that corrections go on smoothly in time.

    It runs ``unsnarl fix --sequence``: the same call continues where an earlier one was interrupted
    (docs/sequences.md).

    Parameters
    ----------
    paths
        Numbered mesh files, patterns of them ("dance/*.obj"), or a list of such; or a mesh and a point cache, as in
        ["body.obj", "dance.pc2"].
    output
        The folder where the frames go under their names. Made where it is missing.
    fixed
        Vertices that must not move: a mask (n,) of bool, or their ids.
    frames
        The range wanted, (first, last) with last excluded. None: all.
    keep_partial
        Write also frames that are not embedded.
    recompute_normals, format, fix_group, fix_object, fix_material, fix_component, fix_boundary, only_group, \
only_object, only_material, only_component, allow
        As for fix.
    goal, precision, min_gap, gap_near_conflicts, max_displacement, absolute, time_limit, memory_limit, weld, \
weld_tolerance, both_diagonals, each_component, threads
        As for repair, of each frame.
    progress
        Called with a Progress now and then; True draws a bar.

    Raises
    ------
    ValueError
        Options or frames that make no sense: another number of faces, a frame that is missing.
    OSError
        A file cannot be read or written. A frame that could not be untangled raises nothing: see Frame.status.
    """
    inputs = [os.fspath(path) for path in ([paths] if isinstance(paths, (str, os.PathLike)) else paths)]
    for path in inputs:
        if not set(path) & set("*?["):  # it is no pattern
            os.stat(path)  # raises what the system says
    words = ["fix", "--sequence", *map(_as_operand, inputs), "-o", os.fspath(output), "--progress", "json"]
    words += words_of(
        keep_partial=keep_partial,
        recompute_normals=recompute_normals,
        format=format,
        fix_boundary=fix_boundary,
        goal=goal,
        precision=precision,
        min_gap=min_gap,
        gap_near_conflicts=gap_near_conflicts,
        max_displacement=max_displacement,
        absolute=absolute,
        time_limit=time_limit,
        memory_limit=memory_limit,
        weld=weld,
        weld_tolerance=weld_tolerance,
        both_diagonals=both_diagonals,
        each_component=each_component,
        threads=threads,
    )
    words += words_of_parts(
        Parts(fix_group, fix_object, fix_material, fix_component),
        Parts(only_group, only_object, only_material, only_component),
    )
    words += words_of_rules(allow)
    if frames is not None:
        words += ["--frames", f"{int(frames[0])}:{int(frames[1])}"]
    with scratch_folder() as scratch:
        if fixed is not None:
            words += ["--fix-vertices", str(_vertex_file(scratch, fixed))]
        report_file = scratch / "report.json"
        ended = run([*words, "--report", str(report_file)], progress)
        if not report_file.exists():
            ended.fail()
        report = json.loads(report_file.read_text(encoding="utf-8"))
    listed = report["list"]
    return FileSequenceResult(
        [frame_of(one) for one in listed], [one["name"] for one in listed], Path(report["output"]), report
    )


def _as_operand(path: str) -> str:
    """A name that begins with a dash is none of an option."""
    return os.path.join(".", path) if path.startswith("-") else path


def _vertex_file(folder: Path, fixed: ArrayLike) -> Path:
    given = np.asarray(fixed)
    if given.ndim != 1 or (given.size > 0 and given.dtype.kind not in "biu"):
        raise ValueError(
            f"fixed has shape {given.shape} and dtype {given.dtype}; give a mask of bool, or a list of ids"
        )
    path = folder / "fixed.txt"
    path.write_text("\n".join(map(str, np.flatnonzero(given) if given.dtype == np.bool_ else given)))
    return path
