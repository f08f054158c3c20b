"""Repair of mesh files, in any format of docs/formats.md."""

from __future__ import annotations

import ctypes
import os
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal, Optional, Union, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._call import call
from ._documents import Document, NamedParts, Parts, read
from ._intersections import Intersections
from ._library import pair_kinds
from ._log import log, log_notes
from ._options import options_of, paper_options
from ._progress import OnProgress
from ._result import Paper, Result
from ._scenes import Scene
from ._types import Faces, Format, Goal, Names, Numbers, PathLike, Paths, Positions, Precision, Rules, Weld


@dataclass(frozen=True)
class Part:
    """A part that a file names, as fix_object, fix_group and fix_material of fix() take it."""

    kind: Literal["object", "group", "material"]
    name: str
    faces: int
    vertices: int  #: that these faces use; parts may share some


@dataclass(frozen=True)
class Component:
    """Faces that are joined by vertices which they share; its place in the list is its number."""

    first_face: int
    faces: int
    vertices: int
    pairs_within: int  #: intersecting pairs of two of its faces
    pairs_with_others: int
    min: list[float]  #: corner of the bounding box
    max: list[float]


@dataclass(frozen=True, repr=False)
class Check(Intersections):
    """What check() finds: the intersecting pairs, and what is in the file."""

    #: What ``unsnarl check --json`` prints, docs/schemas/check.schema.json.
    report: dict[str, Any] = field(default_factory=dict)

    @property
    def parts(self) -> list[Part]:
        """Objects, then groups, then materials that the file names, each in its order."""
        return [Part(**part) for part in self.report["parts"]]

    @property
    def components(self) -> list[Component]:
        return [Component(**component) for component in self.report["components"]["list"]]


def check(
    path: Union[PathLike, Paths],
    format: Optional[Format] = None,
    *,
    allow: Rules = None,
    goal: Goal = "all",
    weld: Weld = "seams",
    weld_tolerance: float = 0.0,
    both_diagonals: bool = False,
    threads: int = 0,
) -> Check:
    """What ``unsnarl check`` finds in a mesh file, or in a list of them, which are one scene.

    path: the file, or several. format: "obj", "ply", ...; None: by the extension, or the content. allow: parts that
    may intersect, as for fix; report["allowed"] alone counts them. goal: noted in the report. weld, weld_tolerance, both_diagonals, threads: as for find_intersections.

    Returns a Check: intersecting pairs, parts that the file names, components. Raises OSError where a file cannot be
    read.
    """
    document = Document(path, format)
    options = options_of(
        goal=goal, weld=weld, weld_tolerance=weld_tolerance, both_diagonals=both_diagonals, threads=threads
    )
    scene = document.scene()
    document.allow(allow, scene.surface, weld=weld, weld_tolerance=weld_tolerance, threads=threads)
    found = call("check", document.struct, options)
    pairs = found.array("pairs")
    meshes = scene.meshes_of(pairs) if document.is_scene else None
    return Check(pairs, np.array(pair_kinds)[found.array("kinds")], meshes, found.report)


@overload
def fix(
    path: PathLike,
    output: Optional[PathLike] = None,
    fixed: Optional[ArrayLike] = None,
    *,
    rigid: Optional[Sequence[ArrayLike]] = None,
    allow: Rules = None,
    in_place: bool = False,
    keep_partial: bool = False,
    no_partial: bool = False,
    recompute_normals: bool = False,
    format: Optional[Format] = None,
    fix_group: Optional[Names] = None,
    fix_object: Optional[Names] = None,
    fix_material: Optional[Names] = None,
    fix_component: Optional[Numbers] = None,
    fix_file: Optional[Names] = None,
    fix_boundary: bool = False,
    only_group: Optional[Names] = None,
    only_object: Optional[Names] = None,
    only_material: Optional[Names] = None,
    only_component: Optional[Numbers] = None,
    only_file: Optional[Names] = None,
    rigid_group: Optional[Names] = None,
    rigid_object: Optional[Names] = None,
    rigid_material: Optional[Names] = None,
    rigid_component: Optional[Numbers] = None,
    rigid_file: Optional[Names] = None,
    nested: Union[Sequence[str], Sequence[Sequence[str]], None] = None,
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
def fix(
    path: Paths,
    output: Optional[PathLike] = None,
    fixed: Optional[Sequence[Optional[ArrayLike]]] = None,
    *,
    rigid: Optional[Sequence[int]] = None,
    allow: Rules = None,
    in_place: bool = False,
    keep_partial: bool = False,
    no_partial: bool = False,
    recompute_normals: bool = False,
    format: Optional[Format] = None,
    fix_group: Optional[Names] = None,
    fix_object: Optional[Names] = None,
    fix_material: Optional[Names] = None,
    fix_component: Optional[Numbers] = None,
    fix_file: Optional[Names] = None,
    fix_boundary: bool = False,
    only_group: Optional[Names] = None,
    only_object: Optional[Names] = None,
    only_material: Optional[Names] = None,
    only_component: Optional[Numbers] = None,
    only_file: Optional[Names] = None,
    rigid_group: Optional[Names] = None,
    rigid_object: Optional[Names] = None,
    rigid_material: Optional[Names] = None,
    rigid_component: Optional[Numbers] = None,
    rigid_file: Optional[Names] = None,
    nested: Union[Sequence[str], Sequence[Sequence[str]], None] = None,
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


def fix(
    path: Union[PathLike, Paths],
    output: Optional[PathLike] = None,
    fixed: Any = None,
    *,
    rigid: Any = None,
    allow: Rules = None,
    in_place: bool = False,
    keep_partial: bool = False,
    no_partial: bool = False,
    recompute_normals: bool = False,
    format: Optional[Format] = None,
    fix_group: Optional[Names] = None,
    fix_object: Optional[Names] = None,
    fix_material: Optional[Names] = None,
    fix_component: Optional[Numbers] = None,
    fix_file: Optional[Names] = None,
    fix_boundary: bool = False,
    only_group: Optional[Names] = None,
    only_object: Optional[Names] = None,
    only_material: Optional[Names] = None,
    only_component: Optional[Numbers] = None,
    only_file: Optional[Names] = None,
    rigid_group: Optional[Names] = None,
    rigid_object: Optional[Names] = None,
    rigid_material: Optional[Names] = None,
    rigid_component: Optional[Numbers] = None,
    rigid_file: Optional[Names] = None,
    nested: Union[Sequence[str], Sequence[Sequence[str]], None] = None,
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
    """Repairs a mesh file as ``unsnarl fix`` does: everything but positions stays, and the old file or the whole new
    one is there at any time, never a part.

    Parameters
    ----------
    path, output
        Files of one format; output must be another file. Or a list of files, which are one scene (meshes are also
        separated from each other), and the folder where they go under their names, made where it is missing. Where the
        result is neither embedded nor allowed, they are not written, but for gap_not_met, and for obstructed where
        something else was repaired. The best state that was reached goes to a file beside each, out.partial.obj for
        out.obj, unless nothing better than the input was found.
    fixed
        Vertices that must not move, as for repair; of several files a list of the same length, with None where all may
        move.
    rigid
        Parts that move as bodies, as for repair; of several files the numbers of those that are rigid.
    in_place
        Write to `path`; no output is given then. Not of several files.
    keep_partial
        Write to `output` also what a limit or an obstacle left unfinished.
    no_partial
        Write no files beside it.
    recompute_normals
        Turn stored vertex normals (OBJ vn, PLY nx ny nz, glTF) with the faces that moved.
    format
        Of the files, where names do not tell: "obj", "ply", ...
    fix_group, fix_object, fix_material, fix_component, fix_file
        Do not move the faces of these parts: a name or number, or a list of them. check() lists those that there are;
        fix_file names one of several files, without its folder.
    fix_boundary
        Do not move vertices on a boundary.
    only_group, only_object, only_material, only_component, only_file
        Leave all as it is but the faces of these parts.
    rigid_group, rigid_object, rigid_material, rigid_component, rigid_file
        Parts that are turned and shifted as one body each and never deformed. Not with `rigid`.
    allow
        Parts that may intersect: ("A", "B") or "A:B" for two, "A" for one and itself; one rule or a list. A and B are
        names of files, objects, groups or materials, or numbers of components; "object=A" says which. See repair.
    nested
        Which surfaces lie inside which, from the innermost out: names of files, or of one file's objects, as in
        ["inner.off", "outer.off"], or a list of such chains; see repair.
    goal, precision, min_gap, gap_near_conflicts, min_dihedral, max_displacement, absolute, time_limit, \
memory_limit, weld, weld_tolerance, both_diagonals, each_component, threads, recover, paper, progress
        As for repair.

    Returns a Result; its `output` is the file that was written (of several files the folder), or None, its `partial` the
    one beside it (of several files a list), or None. Of several files V is a list.

    Raises OSError where a file cannot be read or written, before the repair (FileNotFoundError, PermissionError, ... as
    the system gave the reason), or where the file to overwrite was changed meanwhile and is left as it is; ValueError and
    TypeError as repair does.
    """
    fix_parts = Parts(fix_group, fix_object, fix_material, fix_component, fix_file)
    only_parts = Parts(only_group, only_object, only_material, only_component, only_file)
    rigid_parts = Parts(rigid_group, rigid_object, rigid_material, rigid_component, rigid_file)
    _check_places(path, output, in_place)
    document = Document(path, format)
    target = Path(document.paths[0] if output is None else output)
    if document.is_scene and len(document.paths) == 1:
        target.mkdir(parents=True, exist_ok=True)
        output = target / document.names[0]
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
        keep_partial=keep_partial,
        no_partial=no_partial,
        **paper_options(paper),
    )
    scene = document.scene()
    surface = document.allow(allow, scene.surface, weld=weld, weld_tolerance=weld_tolerance, threads=threads)
    named = NamedParts(document, weld=weld, weld_tolerance=weld_tolerance, threads=threads)
    flags = named.fixed(fix_parts, only_parts, fix_boundary)
    own_flags = scene.flags_of_vertices(fixed)
    document.struct.lend(fixed=flags | own_flags if own_flags.size > 0 else flags)
    _lend_rigid(document, scene, named, rigid, rigid_parts, flags)
    _lend_nested(document, scene, named, nested)
    if recompute_normals and not document.recompute_normals():
        log_notes([f"recompute_normals: there are no vertex normals in {', '.join(document.names)} to update"])
    repaired = document.repair(output, options, progress)
    log(repaired)
    V = repaired.array("positions")
    report = repaired.report
    partial = document.partial()
    return Result(
        scene.split(V) if document.is_scene else V,
        repaired.status,
        report,
        None,
        target if report["output"]["written"] else None,
        surface,
        V,
        scene.mesh_sizes if document.is_scene else None,
        _document=document,
        partial=None if not partial else partial if document.is_scene else partial[0],
    )


def _check_places(path: Union[PathLike, Paths], output: Optional[PathLike], in_place: bool) -> None:
    is_scene = isinstance(path, (list, tuple))
    if is_scene and (in_place or output is None):
        raise ValueError("several files go to a folder: give it as output")
    if in_place == (output is not None):
        raise ValueError("give the file to write as output, or in_place=True")
    if isinstance(path, (list, tuple)) or output is None:
        return
    if os.path.exists(path) and os.path.exists(output) and os.path.samefile(path, output):
        raise ValueError(f"{os.fspath(output)!r} is the input; give another name, or in_place=True to overwrite it")


def _lend_rigid(document: Document, scene: Scene, named: NamedParts, rigid: Any, parts: Parts, fixed: Any) -> None:
    """Tells the struct which parts are rigid."""
    wanted = list(parts.named("rigid"))
    if rigid is not None and wanted:
        raise ValueError(f"rigid and {wanted[0][0]} exclude each other; name all rigid parts in one way")
    if rigid is not None:
        numbers, names = scene.rigid_numbers(rigid), []  # type: tuple[Any, list[str]]
    elif wanted:
        numbers, names = named.numbered(wanted)
    else:
        return
    held = np.flatnonzero((fixed != 0) & (numbers >= 0)) if fixed.size == numbers.size else np.empty(0, int)
    if names and held.size > 0:
        name = names[numbers[held[0]]]
        raise ValueError(f"{name!r} is to be rigid, but vertex {held[0]} of it is held; leave one of the two out")
    document.struct.lend(rigid=numbers)
    document.struct.lend_names("rigid_names", "rigid_name_count", names)


def _lend_nested(document: Document, scene: Scene, named: NamedParts, nested: Any) -> None:
    """Tells the struct which surfaces are to lie inside which."""
    if nested is None:
        return
    if isinstance(nested, str) or any(not isinstance(one, (str, list, tuple)) for one in nested):
        raise TypeError(f"nested is {nested!r}; give names from the innermost out, as in ['a', 'b'], or a list of such")
    chains = [list(nested)] if all(isinstance(one, str) for one in nested) else [list(chain) for chain in nested]
    kind = "file" if document.is_scene else "object"
    names = list(dict.fromkeys(name for chain in chains for name in chain))
    numbers, _ = named.numbered(("nested", kind, name) for name in names)
    document.struct.lend(nested_surface=numbers)
    document.struct.lend_names("nested_names", "nested_name_count", names)
    flat = np.array([i for chain in chains for i in [*map(names.index, chain), -1]], np.int32)
    document.struct.lend(nested=flat)
    document.struct.nested_count = len(flat)
