"""Arrays as users give them, made into the flat arrays of the library, or refused."""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ._library import CurvesStruct, SurfaceStruct

# What the library counts with.
_LARGEST_ID = np.iinfo(np.int32).max


class Surface(NamedTuple):
    """A polygon mesh as flat arrays of its own, which nobody else can change meanwhile."""

    positions: NDArray[np.float64]  # 3 n
    corners: NDArray[np.int32]  # vertex ids, face after face
    offsets: NDArray[np.int32]  # m + 1; empty: all faces are triangles
    face_parts: NDArray[np.int32] = np.empty(0, np.int32)  # of each face; empty: no pair of faces may intersect
    allowed: NDArray[np.int32] = np.empty((0, 2), np.int32)  # pairs of these parts

    @property
    def face_count(self) -> int:
        return len(self.offsets) - 1 if self.offsets.size > 0 else len(self.corners) // 3

    def struct(self, **fields: Any) -> SurfaceStruct:
        """For the library, with further fields of the struct."""
        return SurfaceStruct(
            **{
                "positions": self.positions,
                "vertex_count": len(self.positions) // 3,
                "corners": self.corners,
                "corner_count": len(self.corners),
                "offsets": self.offsets,
                "offset_count": len(self.offsets),
                "face_parts": self.face_parts,
                "allowed": self.allowed,
                "allowed_count": len(self.allowed),
                **fields,
            }
        )


class Polylines(NamedTuple):
    """Polylines one after another."""

    points: NDArray[np.float64]  # flat
    offsets: NDArray[np.int32]  # polyline c has the points [offsets[c], offsets[c + 1])

    @property
    def sizes(self) -> NDArray[np.int32]:
        """Numbers of points."""
        return np.diff(self.offsets)

    def struct(self, **fields: Any) -> CurvesStruct:
        """For the library, with further fields of the struct."""
        return CurvesStruct(points=self.points, offsets=self.offsets, curve_count=len(self.offsets) - 1, **fields)


def surface_of(V: Any, F: Any) -> Surface:
    """The mesh of positions V (n, 3) and faces F (m, k), or (corners, offsets)."""
    positions = positions_of(V)
    if isinstance(F, tuple) and len(F) == 2:
        return Surface(positions, *_polygons(F[0], F[1]))
    faces = _ids(F, "F")
    if faces.size == 0:
        faces = faces.reshape(0, 3)
    if faces.ndim != 2 or faces.shape[1] < 3:
        raise ValueError(
            f"F has shape {faces.shape}; give (m, 3) triangles, (m, 4) quads, or a tuple (corners, offsets)"
        )
    count, size = faces.shape
    if size == 3:
        offsets = np.empty(0, np.int32)
    else:
        offsets = _narrowed(np.arange(count + 1, dtype=np.int64) * size, "the number of corners in F")
    return Surface(positions, _narrowed(faces, "F").ravel(), offsets)


def positions_of(V: Any, name: str = "V") -> NDArray[np.float64]:
    """A flat copy of positions (n, 3)."""
    positions = _array(V, name)
    if positions.dtype.kind not in "fiu":
        raise TypeError(f"{name} has dtype {positions.dtype}; positions are real numbers")
    if positions.size == 0:
        positions = positions.reshape(0, 3)
    if positions.ndim != 2 or positions.shape[1] != 3:
        transposed = positions.ndim == 2 and positions.shape[0] == 3
        raise ValueError(
            f"{name} has shape {positions.shape}; give (n, 3), x y z of each vertex"
            + (f" (that is {name}.T)" if transposed else "")
        )
    return np.array(positions, dtype=np.float64, order="C", copy=True).ravel()


def vertex_flags(fixed: Any, vertex_count: int) -> NDArray[np.uint8]:
    """One flag a vertex, from a mask (n,) of bool or from vertex ids; empty where nothing is fixed."""
    if fixed is None or _array(fixed, "fixed").size == 0:
        return np.empty(0, np.uint8)
    return _flags(fixed, "fixed", vertex_count, "vertices", "vertex")


def rigid_numbers(parts: Any, vertex_count: int) -> NDArray[np.int32]:
    """The rigid part of each vertex, -1 for none, from a list of parts: each a mask (n,) of bool or vertex ids; empty
    where there is none."""
    if parts is None:
        return np.empty(0, np.int32)
    if not isinstance(parts, (list, tuple)) or any(np.ndim(part) != 1 for part in parts):
        raise TypeError("rigid is a list of parts, each a mask of bool or vertex ids: rigid=[mask] for one")
    numbers = np.full(vertex_count, -1, np.int32)
    for number, part in enumerate(parts):
        own = _flags(part, f"rigid[{number}]", vertex_count, "vertices", "vertex").astype(bool)
        common = np.flatnonzero(own & (numbers >= 0))
        if common.size > 0:
            raise ValueError(
                f"rigid[{numbers[common[0]]}] and rigid[{number}] have vertex {common[0]} in common; join them to one"
            )
        numbers[own] = number
    return numbers if len(parts) > 0 else np.empty(0, np.int32)


def face_flags(faces: Any, face_count: int, argument: str = "faces") -> NDArray[np.uint8]:
    """One flag a face, from a mask (m,) of bool or from face ids."""
    return _flags(faces, argument, face_count, "faces", "face")


def allowing(surface: Surface, allow: Any, faces_of: Callable[[Any, str], NDArray[np.uint8]]) -> Surface:
    """The surface where pairs of faces may intersect. `allow`: a list of rules: a tuple of two parts, or one part that
    may intersect itself; None: no pair may. faces_of(part, argument): one flag a face."""
    if allow is None:
        return surface
    if not isinstance(allow, (list, tuple)):
        raise TypeError("allow is a list: of tuples (A, B) of parts that may pass through each other, or of single parts")
    rules = []
    for number, rule in enumerate(allow):
        sides = rule if isinstance(rule, tuple) else (rule, rule)
        if len(sides) != 2:
            raise ValueError(f"allow[{number}] is a tuple of {len(sides)}; give (A, B), or A alone")
        rules.append([faces_of(side, f"allow[{number}]").astype(bool) for side in sides])
    parts = np.zeros(surface.face_count, np.int64)
    for flags in (flags for rule in rules for flags in rule):
        parts = np.unique(2 * parts + flags, return_inverse=True)[1].reshape(-1)
    first = np.unique(parts, return_index=True)[1]  # a face of each part
    may_pass = np.zeros((len(first), len(first)), bool)
    for a, b in rules:
        may_pass |= np.outer(a[first], b[first])
    pairs = np.argwhere(np.triu(may_pass | may_pass.T)).astype(np.int32)
    return surface._replace(face_parts=parts.astype(np.int32), allowed=np.ascontiguousarray(pairs))


def _flags(chosen: Any, argument: str, count: int, things: str, thing: str) -> NDArray[np.uint8]:
    given = _array(chosen, argument)
    if given.size == 0:
        return np.zeros(count, np.uint8)
    if given.ndim != 1:
        raise ValueError(f"{argument} has shape {given.shape}; give a mask ({count},) of bool, or a list of ids")
    if given.dtype == np.bool_:
        if given.size != count:
            raise ValueError(f"{argument} has {given.size} flags, but there are {count} {things}")
        return given.astype(np.uint8)
    ids = _ids(given, argument)
    wrong = np.flatnonzero((ids < 0) | (ids >= count))
    if wrong.size > 0:
        raise ValueError(f"{argument}[{wrong[0]}] is {ids[wrong[0]]}, but there are {count} {things} (counted from 0)")
    if ids.size == count > 2 and ids.max() <= 1:
        raise ValueError(
            f"{argument} holds a 0 or 1 for each {thing}: give a mask as bool, as in {argument}.astype(bool)"
        )
    flags = np.zeros(count, np.uint8)
    flags[ids] = 1
    return flags


def frame_range(frames: Any, count: int) -> tuple[int, int]:
    """(first, last) of a range of frames, last excluded; None: all."""
    if frames is None:
        return 0, count
    try:
        first, last = (operator.index(value) for value in frames)
    except (TypeError, ValueError):
        raise TypeError(f"frames is {frames!r}; give (first, last), whole numbers, last excluded") from None
    if not 0 <= first < last <= count:
        raise ValueError(f"frames is {frames!r}; give (first, last) with 0 <= first < last <= {count}")
    return first, last


def polylines_of(polylines: Any, dimension: int, thing: str) -> Polylines:
    """A list of arrays (n, dimension) of points, or one such array alone; `thing` is what each is called."""
    if isinstance(polylines, np.ndarray) and polylines.ndim == 2:
        polylines = [polylines]
    flat = []
    for number, polyline in enumerate(polylines):
        points = _array(polyline, f"{thing} {number}")
        if points.dtype.kind not in "fiu":
            raise TypeError(f"{thing} {number} has dtype {points.dtype}; points are real numbers")
        if points.ndim != 2 or points.shape[1] != dimension:
            axes = " ".join("xyz"[:dimension])
            raise ValueError(
                f"{thing} {number} has shape {points.shape}; give (n, {dimension}), {axes} of each point"
            )
        flat.append(np.array(points, dtype=np.float64, order="C", copy=True).ravel())
    ends = np.cumsum([0] + [points.size // dimension for points in flat])
    return Polylines(np.concatenate([np.empty(0), *flat]), _narrowed(ends, "the number of points"))


def _polygons(corners: Any, offsets: Any) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    corners, offsets = _ids(corners, "corners"), _ids(offsets, "offsets")
    for array, what in ((corners, "corners"), (offsets, "offsets")):
        if array.ndim != 1:
            raise ValueError(f"{what} has shape {array.shape}; of a tuple (corners, offsets), both are flat")
    if offsets.size == 0 or offsets[0] != 0 or offsets[-1] != corners.size:
        ends = f"from {offsets[0]} to {offsets[-1]}" if offsets.size > 0 else "over nothing"
        raise ValueError(
            f"offsets run {ends}; give them from 0 to {corners.size}, the number of corners: "
            "face f is corners[offsets[f]:offsets[f + 1]]"
        )
    sizes = np.diff(offsets.astype(np.int64))
    wrong = np.flatnonzero(sizes < 3)
    if wrong.size > 0:
        face = wrong[0]
        raise ValueError(
            f"face {face} runs from offset {offsets[face]} to {offsets[face + 1]}; a face has at least 3 corners"
        )
    return _narrowed(corners, "corners"), _narrowed(offsets, "offsets")


def _ids(values: Any, name: str) -> NDArray[Any]:
    ids = _array(values, name)
    if ids.size == 0:
        return ids.astype(np.int32)  # [] is an array of floats to numpy
    if ids.dtype.kind not in "iu":
        raise TypeError(f"{name} has dtype {ids.dtype}; vertex ids are integers")
    return ids


def _array(values: Any, name: str) -> NDArray[Any]:
    try:
        return np.asarray(values)
    except ValueError:  # rows of different lengths
        hint = "; polygons of mixed sizes are a tuple (corners, offsets)" if name == "F" else ""
        raise ValueError(f"{name} has rows of different lengths{hint}") from None


def _narrowed(ids: NDArray[Any], name: str) -> NDArray[np.int32]:
    """A contiguous copy in the type of the library. Negative ids are left to its own complaint."""
    if ids.size > 0 and (ids.max() > _LARGEST_ID or ids.min() < -_LARGEST_ID):
        raise ValueError(f"{name} holds {ids.max()}; ids up to {_LARGEST_ID} can be counted")
    return np.array(ids, dtype=np.int32, order="C", copy=True)
