"""Meshes of other packages, known by their attributes: none of the packages is imported."""

from __future__ import annotations

import copy
import os
import re
from collections.abc import Callable
from typing import Any, Optional

import numpy as np

#: Makes a copy of the mesh at new positions (n, 3).
MovedTo = Callable[[Any], Any]

# Cells of meshio: faces, and what is none and does not hinder.
_FACES = re.compile(r"triangle|quad|polygon\d*")
_NOT_FACES = re.compile(r"vertex|line\d*")

#: Types of arrays, as VTK numbers them.
_VTK_FLOAT, _VTK_DOUBLE = 10, 11


def is_path(value: Any) -> bool:
    """Is this the name of a file?"""
    return isinstance(value, (str, bytes, os.PathLike))


def opened(V: Any, F: Any) -> tuple[Any, Any, Optional[MovedTo]]:
    """Positions and faces as given, or those of the mesh that was given in their place."""
    if F is not None:
        return V, F, None
    if is_path(V):
        raise TypeError(
            f"{V!r} is the name of a file: unsnarl.fix(IN, OUT) repairs files, unsnarl.check(IN) looks for "
            "intersections, unsnarl.view(IN) shows it, unsnarl.read(IN) gives V and F"
        )
    if hasattr(V, "vertices") and hasattr(V, "faces"):  # trimesh
        return V.vertices, V.faces, _moved_to(V, "vertices")
    if hasattr(V, "points") and hasattr(V, "faces"):  # pyvista.PolyData
        return V.points, _faces_of_vtk(V), _moved_to(V, "points")
    if hasattr(V, "points") and isinstance(getattr(V, "cells", None), list):  # meshio
        return V.points, _faces_of_blocks(V.cells), _moved_to(V, "points")
    if hasattr(V, "GetPoints") and hasattr(V, "GetPolys"):  # vtkPolyData
        return _points_of_vtk(V), _polygons_of_vtk(V), _moved_vtk(V)
    raise TypeError(
        f"{type(V).__name__} is no mesh: give arrays V and F, or a mesh with .vertices and .faces (trimesh), "
        ".points and .faces (pyvista.PolyData; of another grid, its .extract_surface()), .points and .cells (meshio) "
        "or a vtkPolyData (of another grid, what vtkGeometryFilter makes of it)"
    )


def _moved_to(mesh: Any, attribute: str) -> MovedTo:
    def moved_to(positions: Any) -> Any:
        moved = mesh.copy() if hasattr(mesh, "copy") else copy.deepcopy(mesh)
        setattr(moved, attribute, positions)
        return moved

    return moved_to


def _moved_vtk(mesh: Any) -> MovedTo:
    def moved_to(positions: Any) -> Any:
        moved = mesh.NewInstance()
        moved.DeepCopy(mesh)
        if len(positions) > 0:
            if _points_of_vtk(moved).dtype != positions.dtype:  # one that does not hold these numbers
                points = moved.GetPoints().NewInstance()
                points.SetDataType(_VTK_FLOAT if positions.dtype == np.float32 else _VTK_DOUBLE)
                points.SetNumberOfPoints(len(positions))
                moved.SetPoints(points)
            _points_of_vtk(moved)[:] = positions
            moved.GetPoints().Modified()
        return moved

    return moved_to


def _points_of_vtk(mesh: Any) -> Any:
    """A view of the positions, which VTK's arrays lend as a buffer."""
    points = mesh.GetPoints()
    return np.asarray(points.GetData()) if points and points.GetNumberOfPoints() > 0 else np.empty((0, 3))


def _polygons_of_vtk(mesh: Any) -> Any:
    """(corners, offsets)"""
    if mesh.GetNumberOfStrips() > 0:
        raise ValueError("the mesh holds triangle strips; give what vtkTriangleFilter makes of it")
    polygons = mesh.GetPolys()
    if polygons.GetNumberOfCells() == 0:
        return np.empty(0, np.int64), np.zeros(1, np.int64)
    return np.asarray(polygons.GetConnectivityArray()), np.asarray(polygons.GetOffsetsArray())


def _faces_of_vtk(mesh: Any) -> Any:
    """(corners, offsets) of faces stored as their size, then their vertices, one after another."""
    if getattr(mesh, "n_strips", 0):
        raise ValueError("the mesh holds triangle strips; give its .triangulate()")
    padded = np.asarray(mesh.faces)
    if padded.ndim == 2:  # an array of triangles or quads
        return padded
    size = int(padded[0]) if len(padded) > 0 else 3
    if len(padded) % (size + 1) == 0 and np.all(padded[:: size + 1] == size):
        return padded.reshape(-1, size + 1)[:, 1:]
    starts, at = [], 0
    while at < len(padded):
        starts.append(at)
        at += int(padded[at]) + 1
    if at != len(padded):
        raise ValueError(f".faces ends in the middle of face {len(starts) - 1}; each is its size, then its vertices")
    is_corner = np.ones(len(padded), dtype=bool)
    is_corner[starts] = False
    offsets = np.append(starts, at) - np.arange(len(starts) + 1)
    return padded[is_corner], offsets.astype(np.int64)


def _faces_of_blocks(blocks: list[Any]) -> Any:
    """(corners, offsets) of the faces of all blocks, in their order."""
    corners, sizes = [np.empty(0, np.int64)], [np.zeros(1, np.int64)]
    for block in blocks:
        if _NOT_FACES.fullmatch(block.type):
            continue
        if not _FACES.fullmatch(block.type):
            raise ValueError(f"the mesh has cells of type {block.type}; only triangles, quads and polygons are faces")
        if isinstance(block.data, np.ndarray) and block.data.ndim == 2:
            sizes.append(np.full(len(block.data), block.data.shape[1]))
            corners.append(block.data.ravel())
        else:  # polygons of mixed sizes
            sizes.append(np.array([len(face) for face in block.data], dtype=np.int64))
            corners.extend(np.asarray(face) for face in block.data)
    return np.concatenate(corners), np.cumsum(np.concatenate(sizes))
