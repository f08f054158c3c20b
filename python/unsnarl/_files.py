"""Repair of mesh files, in any format of docs/formats.md."""

from __future__ import annotations

import ctypes
import inspect
import os
import weakref
from pathlib import Path
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import NDArray

from ._arguments import Surface, rigid_numbers, vertex_flags
from ._call import Outcome, call_and_wait
from ._intersections import Intersections, find_intersections
from ._library import SurfaceStruct, check as check_code, library
from ._options import options_of, paper_options
from ._progress import OnProgress
from ._repair import Result, log, repair

PathLike = Union[str, "os.PathLike[str]"]

#: Options of repair() that fix() takes too.
_OPTIONS = {
    name for name, p in inspect.signature(repair).parameters.items() if p.kind is p.KEYWORD_ONLY and name not in ("progress", "nested")
}


class Document:
    """A mesh file with all that it holds."""

    def __init__(self, path: PathLike, format: Optional[str] = None):
        self.handle = ctypes.c_void_p()
        name = None if format is None else format.encode()
        check_code(library.unsnarl_document_read(os.fsencode(path), name, ctypes.byref(self.handle)))
        weakref.finalize(self, library.unsnarl_document_free, self.handle)
        self.struct = SurfaceStruct()
        check_code(library.unsnarl_document_surface(self.handle, ctypes.byref(self.struct)))

    def surface(self) -> Surface:
        """A copy of the mesh."""
        s = self.struct
        return Surface(
            _copied(s.positions, 3 * s.vertex_count, np.float64),
            _copied(s.corners, s.corner_count, np.int32),
            _copied(s.offsets, s.offset_count, np.int32),
        )

    def check_output(self, path: PathLike) -> None:
        check_code(library.unsnarl_document_check_output(self.handle, os.fsencode(path)))

    def write(self, repaired: Outcome, path: PathLike) -> None:
        check_code(library.unsnarl_document_write(self.handle, repaired._handle, os.fsencode(path)))


def _copied(address: Optional[int], count: int, dtype: Any) -> NDArray[Any]:
    values: NDArray[Any] = np.empty(count, dtype)
    if count > 0:
        ctypes.memmove(values.ctypes.data, address, values.nbytes)
    return values


def read(path: PathLike, format: Optional[str] = None) -> tuple[NDArray[np.float64], Any]:
    """The mesh of a file, as (V, F) for all functions here: F is (m, 3), or (corners, offsets) of polygons.

    path: the file. format: "obj", "ply", ...; None: by the extension, or the content.

    Raises OSError where the file cannot be read.
    """
    surface = Document(path, format).surface()
    V = surface.positions.reshape(-1, 3)
    if surface.offsets.size == 0:
        return V, surface.corners.reshape(-1, 3)
    return V, (surface.corners, surface.offsets)


def check(path: PathLike, format: Optional[str] = None, **options: Any) -> Intersections:
    """The intersecting pairs of faces of a mesh file.

    path: the file. format: "obj", "ply", ...; None: by the extension, or the content. options: those of
    find_intersections. Raises OSError where the file cannot be read.
    """
    V, F = read(path, format)
    return find_intersections(V, F, **options)


def fix(
    path: PathLike,
    output: Optional[PathLike] = None,
    fixed: Any = None,
    *,
    rigid: Any = None,
    in_place: bool = False,
    keep_partial: bool = False,
    format: Optional[str] = None,
    progress: OnProgress = None,
    **options: Any,
) -> Result:
    """Repairs a mesh file as ``unsnarl fix`` does: everything but positions stays, and the old file or the whole new
    one is there at any time, never a part.

    Parameters
    ----------
    path, output
        Files of one format. Where the result is not embedded, nothing is written, but for obstructed, where something
        else was repaired.
    fixed
        Vertices that must not move, as for repair.
    rigid
        Parts that move as bodies, as for repair.
    in_place
        Write to `path`; no output is given then.
    keep_partial
        Write also what a limit or an obstacle left unfinished.
    format
        Of the file, where its name does not tell: "obj", "ply", ...
    progress, options
        As for repair.

    Returns a Result; its `output` is the file that was written, or None.

    Raises OSError where a file cannot be read or written, before the repair; ValueError and TypeError as repair does.
    """
    if in_place == (output is not None):
        raise ValueError("give the file to write as output, or in_place=True")
    unknown = sorted(set(options) - _OPTIONS)
    if unknown:
        raise TypeError(f"fix() has no option {unknown[0]!r}; there are: {', '.join(sorted(_OPTIONS))}")
    if output is not None and os.path.exists(output) and os.path.samefile(path, output):
        raise ValueError(f"{os.fspath(output)!r} is the input; give another name, or in_place=True to overwrite it")
    paper = paper_options(options.pop("paper", False))
    document = Document(path, format)
    target = Path(path if output is None else output)
    document.check_output(target)
    surface = document.surface()
    flags = vertex_flags(fixed, len(surface.positions) // 3)
    if flags.size > 0:
        document.struct.arrays.append(flags)
        document.struct.fixed = flags.ctypes.data
    parts = rigid_numbers(rigid, len(surface.positions) // 3)
    if parts.size > 0:
        document.struct.arrays.append(parts)
        document.struct.rigid = parts.ctypes.data
    repaired = call_and_wait("repair", document.struct, options_of(**options, **paper), progress=progress)
    log(repaired)
    V = repaired.array("positions")
    is_changed = not np.array_equal(V.ravel(), surface.positions)
    written: Optional[Path] = None
    if repaired.status == "embedded" or (repaired.status == "obstructed" and is_changed) or keep_partial:
        written = target
        document.write(repaired, written)
    report = repaired.report
    report["output"] = {"written": written is not None, "path": None if written is None else os.fspath(written)}
    return Result(V, repaired.status, report, None, written, surface, V, _document=document)
