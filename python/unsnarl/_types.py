"""Types of what the functions take and give."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, Protocol, Union

from numpy.typing import ArrayLike, NDArray

Goal = Literal["all", "disjoint"]
Precision = Literal["auto", "float32", "float64"]
Weld = Literal["none", "seams", "all"]
PairKind = Literal["disjoint", "one_vertex", "folded", "duplicate", "degenerate"]
Format = Literal["obj", "off", "ply", "stl", "glb", "gltf", "surf", "gii", "vtk", "vtp", "msh", "inp", "3mf"]

PathLike = Union[str, "os.PathLike[str]"]
#: Several files; not any sequence, for a str is one too.
Paths = Union[list[str], list[Path], tuple[PathLike, ...]]
#: A part by its name or, of a component, its number.
PartName = Union[str, int]
#: Of parts that may intersect: ("A", "B") or "A:B" for two, "A" for one and itself; one rule or a list.
Rules = Union[str, tuple[PartName, PartName], Sequence[Union[PartName, tuple[PartName, PartName]]], None]
#: One name, or several.
Names = Union[str, Sequence[str]]
Numbers = Union[int, Sequence[int]]

#: (m, 3) triangles, (m, 4) quads, (m, k) polygons, or (corners, offsets) of polygons of mixed sizes.
Faces = Union[ArrayLike, tuple[ArrayLike, ArrayLike]]

if TYPE_CHECKING:
    import numpy as np

    #: (n, 3)
    Positions = NDArray[np.floating[Any]]
else:
    Positions = NDArray[Any]


class MeshOfVertices(Protocol):
    """As of trimesh."""

    @property
    def vertices(self) -> Any: ...
    @property
    def faces(self) -> Any: ...


class MeshOfPoints(Protocol):
    """As of pyvista.PolyData."""

    @property
    def points(self) -> Any: ...
    @property
    def faces(self) -> Any: ...


class MeshOfCells(Protocol):
    """As of meshio."""

    @property
    def points(self) -> Any: ...
    @property
    def cells(self) -> Any: ...


class MeshOfVtk(Protocol):
    """As of vtkPolyData."""

    def GetPoints(self) -> Any: ...
    def GetPolys(self) -> Any: ...


class SceneOfGeometries(Protocol):
    """As trimesh.Scene."""

    @property
    def geometry(self) -> Any: ...
    @property
    def graph(self) -> Any: ...


Mesh = Union[MeshOfVertices, MeshOfPoints, MeshOfCells, MeshOfVtk]
#: Meshes in one coordinate system.
Meshes = Union[Sequence[Union[Mesh, tuple[ArrayLike, Faces]]], SceneOfGeometries]
