"""Several meshes in one coordinate system, seen as one surface: vertices and faces mesh after mesh."""

from __future__ import annotations

import operator
from collections.abc import Sequence
from typing import Any, NamedTuple, Optional

import numpy as np
from numpy.typing import NDArray

from ._arguments import Surface, allowing, face_flags, positions_of, rigid_numbers, surface_of, vertex_flags
from ._library import SurfaceStruct
from ._meshes import MovedTo, opened
from ._trimesh_scenes import instances_of, is_scene


class Scene(NamedTuple):
    surface: Surface  # of all meshes together
    dtypes: list[np.dtype[Any]]  # of the positions of each
    moved_to: list[Optional[MovedTo]]  # see _meshes
    vertex_counts: list[int]
    face_counts: list[int]
    is_list: bool  # several meshes were given, or a list of one
    whole: Any = None  # the scene of trimesh that they are of
    nodes: Sequence[Any] = ()  # of that scene, one a mesh

    @property
    def mesh_sizes(self) -> NDArray[np.uintp]:
        """Vertices and faces of each of several meshes; empty: there is one."""
        sizes = [self.vertex_counts, self.face_counts] if self.is_list else [[], []]
        return np.ascontiguousarray(np.array(sizes, dtype=np.uintp).T)

    def struct(self, **fields: Any) -> SurfaceStruct:
        """For the library, with further fields of the struct."""
        sizes = self.mesh_sizes
        return self.surface.struct(mesh_sizes=sizes, mesh_count=len(sizes), **fields)

    def split(self, positions: NDArray[Any]) -> list[NDArray[Any]]:
        """Positions (n, 3) of all -> those of each mesh."""
        return np.split(positions, np.cumsum(self.vertex_counts)[:-1])

    def meshes_of(self, faces: NDArray[np.int32]) -> NDArray[np.int32]:
        """The mesh of each face."""
        return np.searchsorted(np.cumsum(self.face_counts), faces, side="right").astype(np.int32)

    def flags_of_vertices(self, fixed: Any) -> NDArray[np.uint8]:
        """One flag a vertex of all, from what is fixed of the mesh, or of each in a list; empty: nothing."""
        if not self.is_list:
            return vertex_flags(fixed, self.vertex_counts[0])
        if fixed is None:
            return np.empty(0, np.uint8)
        if isinstance(fixed, dict) and self.whole is not None:
            numbers = self.numbers_of(list(fixed), "fixed")
            fixed = [dict(zip(numbers, fixed.values())).get(i) for i in range(len(self.vertex_counts))]
        if not isinstance(fixed, (list, tuple)) or len(fixed) != len(self.vertex_counts):
            count = len(self.vertex_counts)
            raise ValueError(f"fixed is {_what(fixed)}; of {count} meshes give as many, or None for some")
        parts = [vertex_flags(own, count) for own, count in zip(fixed, self.vertex_counts)]
        return np.concatenate(
            [part if part.size > 0 else np.zeros(n, np.uint8) for part, n in zip(parts, self.vertex_counts)]
        )

    def rigid_numbers(self, rigid: Any) -> NDArray[np.int32]:
        """The rigid part of each vertex of all, from the parts of the mesh, or from those in a list that are rigid as a
        whole; empty: none is."""
        if not self.is_list:
            return rigid_numbers(rigid, self.vertex_counts[0])
        if rigid is None:
            return np.empty(0, np.int32)
        rigid = self.numbers_of(rigid, "rigid")
        count = len(self.vertex_counts)
        if isinstance(rigid, (str, bytes)) or not all(isinstance(i, (int, np.integer)) for i in rigid):
            raise TypeError(f"rigid is {_what(rigid)}; of {count} meshes give the numbers of those that are rigid")
        wrong = [i for i in rigid if not 0 <= i < count]
        if wrong:
            raise ValueError(f"rigid names mesh {wrong[0]}, but there are {count} (counted from 0)")
        number_of = {mesh: number for number, mesh in enumerate(dict.fromkeys(rigid))}
        return np.repeat(np.array([number_of.get(i, -1) for i in range(count)], np.int32), self.vertex_counts)

    def allowing(self, allow: Any) -> Scene:
        """The same where pairs of faces may intersect: of parts of the mesh, each a mask or ids of faces; of a list of
        meshes of these, by their numbers."""
        count = len(self.face_counts)

        def faces_of(part: Any, argument: str) -> NDArray[np.uint8]:
            if not self.is_list:
                return face_flags(part, self.face_counts[0], argument)
            mesh = self.numbers_of([part], argument)[0]
            if not isinstance(mesh, (int, np.integer)) or isinstance(mesh, bool):
                raise TypeError(f"{argument} is {part!r}; of {count} meshes give their numbers, as in (0, 1)")
            if not 0 <= mesh < count:
                raise ValueError(f"{argument} names mesh {mesh}, but there are {count} (counted from 0)")
            return np.repeat(np.arange(count) == mesh, self.face_counts).astype(np.uint8)

        return self._replace(surface=allowing(self.surface, allow, faces_of))

    def numbers_of(self, meshes: Any, argument: str) -> Any:
        """Nodes of a scene of trimesh as the numbers of their meshes; what is none stays."""
        if self.whole is None or isinstance(meshes, (str, bytes)):
            return meshes
        unknown = [node for node in meshes if isinstance(node, str) and node not in self.nodes]
        if unknown:
            names = ", ".join(map(repr, self.nodes))
            raise ValueError(f"{argument} names node {unknown[0]!r}; the scene has faces at these: {names}")
        return [self.nodes.index(node) if node in self.nodes else node for node in meshes]

    def nested_numbers(self, nested: Any) -> NDArray[np.int32]:
        """Chains of meshes from the innermost out, a -1 after each, from one chain or a list of them; empty: none."""
        if nested is None:
            return np.empty(0, np.int32)
        if not self.is_list:
            raise ValueError("nested is of a list of meshes; give them as [(V, F), ...], one a surface")
        if not isinstance(nested, (str, bytes)):
            nested = [self.numbers_of(one, "nested") if isinstance(one, (list, tuple)) else one for one in nested]
            nested = self.numbers_of(nested, "nested")
        try:
            chains = [[operator.index(i) for i in nested]]
        except TypeError:
            try:
                chains = [[operator.index(i) for i in chain] for chain in nested]
            except TypeError:
                raise TypeError(
                    f"nested is {_what(nested)}; give the numbers of meshes from the innermost out, as in [0, 1, 2], "
                    "or a list of such"
                ) from None
        count = len(self.vertex_counts)
        wrong = [i for chain in chains for i in chain if not 0 <= i < count]
        if wrong:
            raise ValueError(f"nested names mesh {wrong[0]}, but there are {count} (counted from 0)")
        return np.array([i for chain in chains for i in [*chain, -1]], np.int32)

    def positions_of(self, moved: Any, name: str) -> NDArray[np.float64]:
        """Flat positions of all, from those of the mesh, or of each in a list."""
        if not self.is_list:
            return positions_of(moved, name)
        if not isinstance(moved, (list, tuple)) or len(moved) != len(self.vertex_counts):
            count = len(self.vertex_counts)
            raise ValueError(f"{name} is {_what(moved)}; of {count} meshes give as many arrays (n, 3)")
        parts = [positions_of(own, f"{name}[{i}]") for i, own in enumerate(moved)]
        for i, (part, count) in enumerate(zip(parts, self.vertex_counts)):
            if part.size != 3 * count:
                raise ValueError(f"{name}[{i}] has {part.size // 3} positions, but mesh {i} has {count} vertices")
        return np.concatenate(parts)


def scene_of(V: Any, F: Any) -> Scene:
    """One mesh as arrays or as such, or a list of them: [(V, F), mesh, ...], or a scene of trimesh."""
    if F is None and is_scene(V):
        instances = instances_of(V)
        joined = _joined([(one.positions, one.mesh.faces, None) for one in instances], True)
        return joined._replace(whole=V, nodes=[one.node for one in instances])
    if F is not None or not isinstance(V, (list, tuple)):
        return _joined([opened(V, F)], False)
    if len(V) == 0:
        raise ValueError("there is no mesh in the list; give [(V, F), ...]")
    meshes = []
    for i, mesh in enumerate(V):
        is_pair = isinstance(mesh, (list, tuple))
        if is_pair and len(mesh) != 2:
            raise ValueError(f"mesh {i} of the list is {_what(mesh)}; give (V, F), or a mesh")
        meshes.append(opened(*mesh) if is_pair else opened(mesh, None))
    return _joined(meshes, True)


def _joined(meshes: list[tuple[Any, Any, Optional[MovedTo]]], is_list: bool) -> Scene:
    surfaces = []
    for i, (V, F, _) in enumerate(meshes):
        try:
            surfaces.append(surface_of(V, F))
        except (TypeError, ValueError) as error:
            if not is_list:
                raise
            raise type(error)(f"mesh {i} of the list: {error}") from None
    vertex_counts = [len(s.positions) // 3 for s in surfaces]
    if len(surfaces) == 1:
        whole = surfaces[0]
    else:
        whole = _concatenated(surfaces, vertex_counts)
    return Scene(
        whole,
        [np.asarray(V).dtype for V, _, _ in meshes],
        [moved_to for _, _, moved_to in meshes],
        vertex_counts,
        [s.face_count for s in surfaces],
        is_list,
    )


def _concatenated(surfaces: list[Surface], vertex_counts: list[int]) -> Surface:
    if max(sum(vertex_counts), sum(len(s.corners) for s in surfaces)) > np.iinfo(np.int32).max:
        raise ValueError("these meshes together have more than 2^31 - 1 vertices or corners of faces")
    for i, (surface, count) in enumerate(zip(surfaces, vertex_counts)):
        wrong = np.flatnonzero((surface.corners < 0) | (surface.corners >= count))
        if wrong.size > 0:
            raise ValueError(
                f"mesh {i} of the list: a face uses vertex {surface.corners[wrong[0]]}, but it has {count} vertices"
            )
    first = np.cumsum([0, *vertex_counts[:-1]], dtype=np.int32)
    corners = np.concatenate([s.corners + begin for s, begin in zip(surfaces, first)])
    if all(s.offsets.size == 0 for s in surfaces):
        offsets = np.empty(0, np.int32)
    else:
        sizes = [np.diff(s.offsets) if s.offsets.size > 0 else np.full(s.face_count, 3) for s in surfaces]
        offsets = np.append(0, np.cumsum(np.concatenate(sizes))).astype(np.int32)
    return Surface(np.concatenate([s.positions for s in surfaces]), corners.astype(np.int32), offsets)


def _what(value: Any) -> str:
    return f"a {type(value).__name__}" + (f" of {len(value)}" if isinstance(value, (list, tuple)) else "")
