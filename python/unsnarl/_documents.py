"""Mesh files with all that they hold, and the parts that they name."""

from __future__ import annotations

import ctypes
import os
import weakref
from collections.abc import Iterable
from pathlib import Path
from typing import Any, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import NDArray

from ._arguments import Surface
from ._call import Outcome, call, call_and_wait
from ._library import OptionsStruct, SurfaceStruct, check as check_code, library
from ._options import options_of
from ._progress import OnProgress
from ._scenes import Scene
from ._types import Format, Names, Numbers, PathLike, Paths, Rules


class Document:
    """A mesh file, or several as one scene."""

    def __init__(self, paths: Union[PathLike, Paths], format: Optional[Format] = None):
        self.is_scene = isinstance(paths, (list, tuple))
        self.paths = [Path(path) for path in paths] if isinstance(paths, (list, tuple)) else [Path(paths)]
        if not self.paths:
            raise ValueError("there is no file in the list; give the names of the files of a scene")
        self.handle = ctypes.c_void_p()
        encoded = (ctypes.c_char_p * len(self.paths))(*(os.fsencode(path) for path in self.paths))
        name = None if format is None else format.encode()
        count = ctypes.c_size_t(len(self.paths))
        check_code(library.unsnarl_document_read_scene(encoded, count, name, ctypes.byref(self.handle)))
        weakref.finalize(self, library.unsnarl_document_free, self.handle)
        self.struct = SurfaceStruct()
        check_code(library.unsnarl_document_surface(self.handle, ctypes.byref(self.struct)))

    @property
    def names(self) -> list[str]:
        return [path.name for path in self.paths]

    def surface(self) -> Surface:
        """A copy of the mesh, of several of all together."""
        s = self.struct
        return Surface(
            _copied(s.positions, 3 * s.vertex_count, np.float64),
            _copied(s.corners, s.corner_count, np.int32),
            _copied(s.offsets, s.offset_count, np.int32),
        )

    def scene(self) -> Scene:
        """The meshes of the files."""
        surface = self.surface()
        sizes = _copied(self.struct.mesh_sizes, 2 * self.struct.mesh_count, np.uintp).astype(int).reshape(-1, 2)
        if len(sizes) == 0:
            sizes = np.array([[len(surface.positions) // 3, surface.face_count]])
        count = len(sizes)
        dtypes = [np.dtype(np.float64)] * count
        return Scene(surface, dtypes, [None] * count, sizes[:, 0].tolist(), sizes[:, 1].tolist(), self.is_scene)

    def faces_of(self, kind: str, name: Union[str, int], **options: Any) -> NDArray[np.uint8]:
        """One flag a face: it belongs to the part of this kind and name."""
        found = call("document_faces", self.handle, kind.encode(), _encoded(str(name)), options_of(**options))
        return found.array("faces")

    def allow(self, rules: Rules, surface: Surface, **options: Any) -> Surface:
        """Lets pairs of faces intersect, in the struct and in the surface that is returned."""
        if rules is None:
            return surface
        texts = [_encoded(text_of_rule(rule)) for rule in ([rules] if isinstance(rules, (str, tuple)) else rules)]
        listed, count = (ctypes.c_char_p * len(texts))(*texts), ctypes.c_size_t(len(texts))
        try:
            found = call("document_allowed", self.handle, listed, count, options_of(**options))
        except ValueError as error:
            raise ValueError(f"allow: {error}") from None
        surface = surface._replace(face_parts=found.array("face_parts"), allowed=found.array("allowed"))
        self.struct.lend(face_parts=surface.face_parts, allowed=surface.allowed, allowed_count=len(surface.allowed))
        return surface

    def vertices_of(self, faces: NDArray[np.uint8]) -> NDArray[np.uint8]:
        found = call("vertices_of_faces", self.struct, ctypes.c_void_p(faces.ctypes.data), ctypes.c_size_t(faces.size))
        return found.array("vertices")

    def boundary(self, **options: Any) -> NDArray[np.uint8]:
        return call("boundary_vertices", self.struct, options_of(**options)).array("vertices")

    def recompute_normals(self) -> bool:
        """From now on write() turns stored vertex normals too. False: there are none."""
        is_any = ctypes.c_int32()
        check_code(library.unsnarl_document_recompute_normals(self.handle, ctypes.byref(is_any)))
        return bool(is_any.value)

    def repair(self, path: Optional[PathLike], options: OptionsStruct, progress: OnProgress) -> Outcome:
        """Repairs, certifies what is written and puts it in place. path: None: the input is overwritten."""
        place = None if path is None else os.fsencode(path)
        return call_and_wait("document_repair", self.handle, self.struct, place, options, progress=progress)

    def partial(self) -> list[Path]:
        """The files that repair() has kept an unfinished result in; empty: none."""
        places = (library.unsnarl_document_partial(self.handle, i) for i in range(len(self.paths)))
        return [Path(os.fsdecode(place)) for place in places if place is not None]


class Parts(NamedTuple):
    """Parts of files by what names them."""

    group: Optional[Names] = None
    object: Optional[Names] = None
    material: Optional[Names] = None
    component: Optional[Numbers] = None
    file: Optional[Names] = None

    def named(self, prefix: str) -> Iterable[tuple[str, str, Union[str, int]]]:
        """(option, kind, name) of each; `prefix` and the kind make the option."""
        for kind, names in self._asdict().items():
            option = f"{prefix}_{kind}"
            for name in _each(option, names, int if kind == "component" else str):
                yield option, kind, name


def _each(option: str, names: Any, kind: type) -> list[Any]:
    if names is None:
        return []
    if isinstance(names, (str, int, np.integer)):
        names = [names]
    listed = list(names)
    for name in listed:
        if not isinstance(name, (int, np.integer) if kind is int else str) or isinstance(name, bool):
            wanted = "numbers of components" if kind is int else "names"
            raise TypeError(f"{option} is {listed!r}; give {wanted}, one or a list")
    return listed


class NamedParts:
    """The flags of vertices that names of parts stand for."""

    def __init__(self, document: Document, **find_options: Any):
        self._document = document
        self._find_options = find_options

    def fixed(self, fix: Parts, only: Parts, boundary: bool) -> NDArray[np.uint8]:
        """One flag a vertex: it is of a part to hold, or of a face that is not of those that alone may move."""
        flags = np.zeros(self._document.struct.vertex_count, np.uint8)
        for part in fix.named("fix"):
            flags |= self._document.vertices_of(self._faces(*part))
        alone = [self._faces(*part) for part in only.named("only")]
        if alone:
            # Nothing else may change, so a vertex that a face outside uses too stays.
            flags |= self._document.vertices_of(1 - np.bitwise_or.reduce(alone))
        if boundary:
            flags |= self._document.boundary(**self._find_options)
        return flags

    def vertices(self, option: str, kind: str, name: Union[str, int]) -> NDArray[np.bool_]:
        """Mask of the vertices of one part."""
        return self._document.vertices_of(self._faces(option, kind, name)).astype(bool)

    def numbered(self, parts: Iterable[tuple[str, str, Union[str, int]]]) -> tuple[NDArray[np.int32], list[str]]:
        """The number of the part that each vertex is of, -1 for none, and the names of the parts."""
        numbers = np.full(self._document.struct.vertex_count, -1, np.int32)
        names: list[str] = []
        for option, kind, name in parts:
            own = self.vertices(option, kind, name)
            common = np.flatnonzero(own & (numbers >= 0))
            if common.size > 0:
                other = names[numbers[common[0]]]
                raise ValueError(
                    f"{option}: {other!r} and {name!r} have vertex {common[0]} in common; name parts that share none"
                )
            numbers[own] = len(names)
            names.append(f"component {name}" if kind == "component" else str(name))
        return numbers, names

    def _faces(self, option: str, kind: str, name: Union[str, int]) -> NDArray[np.uint8]:
        if kind == "file" and not self._document.is_scene:
            instead = option[: -len("file")] + "object"
            raise ValueError(f"{option} names one of several files; of one file, name parts by {instead} and its like")
        try:
            return self._document.faces_of(kind, name, **self._find_options)
        except ValueError as error:
            raise ValueError(f"{option}: {error}") from None


def text_of_rule(rule: Any) -> str:
    """A rule of `allow` as the program takes it: "A:B" or "A"; numbers are those of components."""
    if isinstance(rule, tuple):
        if len(rule) != 2:
            raise ValueError(f"allow: {rule!r} is a tuple of {len(rule)}; give (A, B), or A alone")
        return ":".join(text_of_rule(part) for part in rule)
    if isinstance(rule, str):
        return rule
    if isinstance(rule, (int, np.integer)) and not isinstance(rule, bool):
        return f"component={rule}"
    raise TypeError(f"allow: {rule!r} is neither a name nor the number of a component")


def _encoded(text: str) -> bytes:
    return text.encode("utf-8", "surrogateescape")


def _copied(address: Optional[int], count: int, dtype: Any) -> NDArray[Any]:
    values: NDArray[Any] = np.empty(count, dtype)
    if address is not None:
        ctypes.memmove(values.ctypes.data, address, values.nbytes)
    return values


def read(path: PathLike, format: Optional[Format] = None) -> tuple[NDArray[np.float64], Any]:
    """The mesh of a file, as (V, F) for all functions here: F is (m, 3), or (corners, offsets) of polygons.

    path: the file. format: "obj", "ply", ...; None: by the extension, or the content.

    Raises OSError where the file cannot be read.
    """
    surface = Document(path, format).surface()
    V = surface.positions.reshape(-1, 3)
    if surface.offsets.size == 0:
        return V, surface.corners.reshape(-1, 3)
    return V, (surface.corners, surface.offsets)
