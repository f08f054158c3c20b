"""Repair of many meshes, each in a process of its own."""

from __future__ import annotations

import json
import os
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Optional, Union

from ._documents import Parts
from ._program import run, scratch_folder, words_of, words_of_parts, words_of_rules
from ._types import Format, Goal, Names, Numbers, PathLike, Precision, Rules, Weld


@dataclass(frozen=True)
class BatchResult:
    """What batch came to."""

    rows: list[dict[str, Any]]
    """One a mesh, as results.jsonl has it: "mesh", "status", "output", pairs, displacement, ... (docs/batch.md). Empty
    after a part of a batch: batch(..., summary=True) gives all."""
    output: Path  #: the folder of the results

    @property
    def counts(self) -> dict[str, int]:
        """Number of meshes by status."""
        return dict(Counter(row["status"] for row in self.rows))

    @property
    def embedded(self) -> bool:
        """Every mesh is."""
        return all(row["status"] == "embedded" for row in self.rows)


def batch(
    meshes: Union[PathLike, Sequence[PathLike]],
    output: PathLike,
    *,
    jobs: int = 0,
    shard: Optional[tuple[int, int]] = None,
    summary: bool = False,
    retry: bool = False,
    attempts: int = 3,
    thumbnails: bool = False,
    time_limit: float = 3600.0,
    memory_limit: Optional[float] = None,
    threads: int = 0,
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
    min_dihedral: float = 0.0,
    max_displacement: float = 0.0,
    absolute: bool = False,
    weld: Weld = "seams",
    weld_tolerance: float = 0.0,
    both_diagonals: bool = False,
    each_component: bool = False,
) -> BatchResult:
    """Repairs every mesh of a folder or a list, each in a process of its own, and continues where an earlier call
    stopped.

    It runs ``unsnarl batch`` (docs/batch.md). A mesh that crashes or runs out of memory affects only its own row. What it
    says on the way goes to the logger "unsnarl".

    Parameters
    ----------
    meshes
        A folder, searched with its subfolders; a file with the path of a mesh a line; or a list of paths.
    output
        The folder of the results. Made where it is missing.
    jobs
        Meshes to repair at a time. 0: as many as there are processors.
    shard
        (i, n): only part i of n, 0 <= i < n. All may write to one folder at a time.
    summary
        Repair nothing: read what is there, of all parts.
    retry
        Try again what has not ended embedded, allowed, obstructed or gap_not_met.
    attempts
        How often a mesh is tried whose process dies, 1 to 100.
    thumbnails
        Draw each mesh before and after, for the page index.html.
    time_limit, memory_limit
        Seconds and MB for each mesh. time_limit 0: none. memory_limit None: its share of nine tenths of what there is.
    threads
        For each mesh. 0: the processors divided by jobs.
    keep_partial, recompute_normals, format, fix_group, fix_object, fix_material, fix_component, fix_boundary, \
only_group, only_object, only_material, only_component, allow, goal, precision, min_gap, gap_near_conflicts, \
min_dihedral, max_displacement, absolute, weld, weld_tolerance, both_diagonals, each_component
        As for fix, the same for every mesh.

    Raises ValueError for options that make no sense, OSError where the folder or the list cannot be read, or the folder
    of the results not be written. What became of a mesh raises nothing: see its row.
    """
    fix_words = words_of(
        keep_partial=keep_partial,
        recompute_normals=recompute_normals,
        format=format,
        fix_boundary=fix_boundary,
        goal=goal,
        precision=precision,
        min_gap=min_gap,
        gap_near_conflicts=gap_near_conflicts,
        min_dihedral=min_dihedral,
        max_displacement=max_displacement,
        absolute=absolute,
        weld=weld,
        weld_tolerance=weld_tolerance,
        both_diagonals=both_diagonals,
        each_component=each_component,
    )
    fix_words += words_of_parts(
        Parts(fix_group, fix_object, fix_material, fix_component),
        Parts(only_group, only_object, only_material, only_component),
    )
    fix_words += words_of_rules(allow)
    words = words_of(jobs=jobs, threads=threads, summary=summary, retry=retry, thumbnails=thumbnails)
    words += ["--time-limit", repr(float(time_limit)), "--attempts", str(attempts)]
    if memory_limit is not None:
        words += ["--memory-limit", repr(float(memory_limit))]
    if shard is not None:
        words += ["--shard", f"{int(shard[0])}/{int(shard[1])}"]
    with scratch_folder() as scratch:
        given = meshes if isinstance(meshes, (str, os.PathLike)) else _list_file(scratch, meshes)
        os.stat(given)  # raises what the system says
        ended = run(["batch", os.fspath(given), "-o", os.fspath(output), *words, "--", *fix_words])
    if ended.code not in (0, 1, 8):
        ended.fail()
    rows = Path(output) / "results.jsonl"
    # A part does not write the tables, and those that are there are of an earlier time.
    is_whole = (shard is None or summary) and rows.exists()
    return BatchResult([json.loads(line) for line in rows.open(encoding="utf-8")] if is_whole else [], Path(output))


def _list_file(folder: Path, meshes: Sequence[PathLike]) -> Path:
    lines = [os.fsencode(path) for path in meshes]
    for line in lines:
        if b"\n" in line or b"\t" in line:
            name = os.fsdecode(line)
            raise ValueError(f"{name!r}: a list holds no names with line breaks or tabs; give their folder")
    path = folder / "meshes.txt"
    path.write_bytes(b"".join(line + b"\n" for line in lines))
    return path
