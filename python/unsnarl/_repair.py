"""Repair of a mesh."""

from __future__ import annotations

import ctypes
from collections.abc import Mapping, Sequence
from typing import Any, Optional, Union, overload

import numpy as np
from numpy.typing import ArrayLike

from ._call import Outcome, Status, call, call_and_wait
from ._log import log, log_notes
from ._options import options_of, paper_options
from ._progress import OnProgress
from ._result import Paper, Result
from ._scenes import Scene, scene_of
from ._trimesh_scenes import with_positions
from ._types import Faces, Goal, Mesh, Meshes, Positions, Precision, Weld


@overload
def repair(
    V: ArrayLike,
    F: Faces,
    fixed: Optional[ArrayLike] = None,
    *,
    rigid: Optional[Sequence[ArrayLike]] = None,
    allow: Optional[Sequence[Union[ArrayLike, tuple[ArrayLike, ArrayLike]]]] = None,
    nested: None = None,
    goal: Goal = "all",
    precision: Precision = "auto",
    min_gap: float = 0.0,
    gap_near_conflicts: bool = False,
    min_dihedral: float = 0.0,
    max_displacement: float = 0.0,
    absolute: bool = False,
    time_limit: float = 0.0,
    memory_limit: float = 0.0,
    weld: Weld = "seams",
    weld_tolerance: float = 0.0,
    both_diagonals: bool = False,
    each_component: bool = False,
    threads: int = 0,
    recover: bool = True,
    paper: Paper = False,
    progress: OnProgress = None,
) -> Result[Positions]: ...


@overload
def repair(
    V: Mesh,
    F: None = None,
    fixed: Optional[ArrayLike] = None,
    *,
    rigid: Optional[Sequence[ArrayLike]] = None,
    allow: Optional[Sequence[Union[ArrayLike, tuple[ArrayLike, ArrayLike]]]] = None,
    nested: None = None,
    goal: Goal = "all",
    precision: Precision = "auto",
    min_gap: float = 0.0,
    gap_near_conflicts: bool = False,
    min_dihedral: float = 0.0,
    max_displacement: float = 0.0,
    absolute: bool = False,
    time_limit: float = 0.0,
    memory_limit: float = 0.0,
    weld: Weld = "seams",
    weld_tolerance: float = 0.0,
    both_diagonals: bool = False,
    each_component: bool = False,
    threads: int = 0,
    recover: bool = True,
    paper: Paper = False,
    progress: OnProgress = None,
) -> Result[Positions]: ...


@overload
def repair(
    V: Meshes,
    F: None = None,
    fixed: Union[Sequence[Optional[ArrayLike]], Mapping[str, ArrayLike], None] = None,
    *,
    rigid: Optional[Sequence[Union[int, str]]] = None,
    allow: Optional[Sequence[Union[int, str, tuple[Union[int, str], Union[int, str]]]]] = None,
    nested: Union[Sequence[Union[int, str]], Sequence[Sequence[Union[int, str]]], None] = None,
    goal: Goal = "all",
    precision: Precision = "auto",
    min_gap: float = 0.0,
    gap_near_conflicts: bool = False,
    min_dihedral: float = 0.0,
    max_displacement: float = 0.0,
    absolute: bool = False,
    time_limit: float = 0.0,
    memory_limit: float = 0.0,
    weld: Weld = "seams",
    weld_tolerance: float = 0.0,
    both_diagonals: bool = False,
    each_component: bool = False,
    threads: int = 0,
    recover: bool = True,
    paper: Paper = False,
    progress: OnProgress = None,
) -> Result[list[Positions]]: ...


def repair(
    V: Any,
    F: Any = None,
    fixed: Any = None,
    *,
    rigid: Any = None,
    allow: Any = None,
    nested: Any = None,
    goal: Goal = "all",
    precision: Precision = "auto",
    min_gap: float = 0.0,
    gap_near_conflicts: bool = False,
    min_dihedral: float = 0.0,
    max_displacement: float = 0.0,
    absolute: bool = False,
    time_limit: float = 0.0,
    memory_limit: float = 0.0,
    weld: Weld = "seams",
    weld_tolerance: float = 0.0,
    both_diagonals: bool = False,
    each_component: bool = False,
    threads: int = 0,
    recover: bool = True,
    paper: Paper = False,
    progress: OnProgress = None,
) -> Any:
    """Moves the vertices as little as possible so that no two faces intersect; connectivity is kept.

    The result is that of ``unsnarl fix`` on a file of the same numbers, bit for bit, at any number of threads (time
    limits aside); where it writes the short digits of float32 numbers as text, V holds those numbers.

    Other Python threads run meanwhile. Ctrl-C, or an exception in `progress`, cancels and is raised.

    Parameters
    ----------
    V, F
        Positions (n, 3) and faces (m, 3), (m, 4), (m, k) or (corners, offsets); or a mesh of meshio, trimesh, pyvista
        or VTK alone, as in ``repair(mesh, fixed=ids)``; or a list of such, ``repair([(V, F), mesh, ...])``: one scene,
        in which meshes are also separated from each other; or a trimesh.Scene, whose geometries are repaired where
        its nodes put them. See the documentation of the package.
    fixed
        Vertices that must not move: a mask (n,) of bool, or their ids. None: all may move. Masks of parts come from
        vertices_of_faces and boundary_vertices. Of a list of meshes: a list of the same length, with None where all
        may move.
    rigid
        Parts that are turned and shifted as one body each and never deformed: a list of masks (n,) of bool or of vertex
        ids. Of a list of meshes: the numbers of those that are rigid. They move where they intersect what is fixed or
        each other; report["rigid_parts"] says how. What is in none of them is soft.
    allow
        Pairs of faces that may intersect: a list of rules, (A, B) for the faces of two parts, A alone for those of one
        among each other. Parts are masks (m,) of bool or ids of faces; of a list of meshes the numbers of meshes. Such
        pairs hold nothing up; report["allowed"] counts them, all else leaves them out; status is "allowed" where nothing
        else is left. Not with nested and paper.
    nested
        Of a list of meshes: which lies inside which, their numbers from the innermost out, as in [0, 1, 2], or several
        such chains. All but the first of a chain have to be closed. Where two of them cross, the inner one goes in and
        the outer one out, even where the other way is shorter. report["nested"] says for each and the next one out how
        many vertices were and are on the wrong side; status is "not_nested" where nothing intersects any more, but one
        lies wrong. Not with rigid, each_component and paper. None: it does not matter.
    goal
        "all": no intersecting pair of any kind. "disjoint": none of faces that share no vertex.
    precision
        Number format in which the result must hold: "float32", "float64", or "auto": float32 where V is, or where
        conflicts lie on coordinates coarse enough for it.
    min_gap
        Wanted gap between sheets, as a fraction of the bounding-box diagonal; at most 8 times as wide as the faces.
        Gaps that are too small are opened wherever they are; report["gap"] names the smallest one, and status is
        "gap_not_met" where it falls short by more than 1 %. 0: just enough to be safe where faces intersect.
    gap_near_conflicts
        Open gaps only around what intersects, and promise none.
    min_dihedral
        Degrees, below 90: two faces at an edge that are folded together closer are opened to this angle, as far as
        nothing is in the way. 0: left as they are.
    max_displacement
        How far any vertex may move, as a fraction of the diagonal. 0: any distance.
    absolute
        min_gap and max_displacement are lengths in the units of V.
    time_limit
        Seconds after which to stop. 0: none.
    memory_limit
        MB that the whole process may hold. 0: no limit.
    weld, weld_tolerance, both_diagonals, threads
        As for find_intersections.
    each_component
        Repair every component as if alone; what runs through others may do so still, and is reported as obstruction.
    recover
        False: stop after untangling, without moving back toward the input (for research).
    paper
        The configuration of the paper instead of the regional one (for research). True, or a dict of its settings:
        bandwidth ("global", "independent", "symmetric"), adaptive, bandwidth_scale, neighbourhood, gaussian, mesh,
        mesh_energy ("depth", "length"), whole_polygons, arap, memory, iterations; docs/paper.md explains them.
    progress
        Called with a Progress now and then, from the thread that called repair. What it returns is ignored. True draws
        a bar on standard error, also in notebooks.

    Raises
    ------
    ValueError, TypeError
        As for find_intersections. A mesh that could not be untangled raises nothing: see Result.status.
    """
    scene = scene_of(V, F).allowing(allow)
    is_float32 = [dtype.kind == "f" and dtype.itemsize == 4 for dtype in scene.dtypes]
    if any(is_float32) and precision == "auto":
        precision = "float32"
    options = options_of(
        goal=goal,
        precision=precision,
        min_gap=min_gap,
        gap_near_conflicts=gap_near_conflicts,
        min_dihedral=min_dihedral,
        max_displacement=max_displacement,
        absolute=absolute,
        time_limit=time_limit,
        memory_limit=memory_limit,
        weld=weld,
        weld_tolerance=weld_tolerance,
        both_diagonals=both_diagonals,
        each_component=each_component,
        threads=threads,
        recover=recover,
        **paper_options(paper),
    )
    chains = scene.nested_numbers(nested)
    surface = scene.struct(
        fixed=scene.flags_of_vertices(fixed),
        rigid=scene.rigid_numbers(rigid),
        nested=chains,
        nested_count=len(chains),
    )
    repaired = call_and_wait("repair", surface, options, progress=progress)
    log(repaired)
    positions = repaired.array("positions")
    moved = scene.split(positions)
    if precision == "float32":
        moved = [own.astype(dtype) if small else own for own, dtype, small in zip(moved, scene.dtypes, is_float32)]
    if scene.whole is not None:
        find = options_of(weld=weld, weld_tolerance=weld_tolerance, both_diagonals=both_diagonals, threads=threads)
        return _put_back(scene, repaired, moved, find)
    meshes = [moved_to(own) if moved_to else None for own, moved_to in zip(moved, scene.moved_to)]
    if not scene.is_list:
        return Result(moved[0], repaired.status, repaired.report, meshes[0], None, scene.surface, positions)
    return Result(moved, repaired.status, repaired.report, meshes, None, scene.surface, positions, scene.mesh_sizes)


def _put_back(scene: Scene, repaired: Outcome, moved: Any, find_options: Any) -> Result[list[Positions]]:
    """A scene of trimesh whose geometries are repaired, each in its own frame, and certified as it then is."""
    mesh, held, notes = with_positions(scene.whole, moved)
    positions = np.concatenate(held)
    status, report = repaired.status, repaired.report
    if not np.array_equal(positions, np.concatenate(moved)):
        flat = np.ascontiguousarray(positions).ravel()
        pointer, count = ctypes.c_void_p(flat.ctypes.data), ctypes.c_size_t(len(positions))
        certificate = call("certify", scene.surface.struct(), pointer, count, find_options).report
        if status in ("embedded", "allowed", "gap_not_met") and not certificate["resolved"]:
            status = Status.reduced
            notes.append("rounding in the frames of the geometries made faces meet again; give a min_gap")
            pairs = certificate["pairs"]
            report.update(status=str(status), exit_code=1, after={"total": sum(pairs.values()), "by_class": pairs})
    report["input"]["notes"] += notes
    log_notes(notes)
    return Result(held, status, report, mesh, None, scene.surface, positions, scene.mesh_sizes)
