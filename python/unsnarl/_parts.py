"""Parts of a mesh, to be held or to be moved."""

from __future__ import annotations

from ctypes import c_size_t, c_void_p
from typing import Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arguments import face_flags, surface_of
from ._call import call
from ._meshes import opened
from ._options import options_of
from ._types import Faces, Mesh, Weld


def component_of_faces(
    V: Union[ArrayLike, Mesh], F: Optional[Faces] = None, *, weld: Weld = "seams", weld_tolerance: float = 0.0
) -> NDArray[np.int32]:
    """Component of each face, (m,): faces joined by a vertex that they share, seams closed.

    Components are counted from 0 in the order of their first faces, as ``unsnarl check`` lists them; a face without
    corners has -1. V, F, weld, weld_tolerance and errors: as for find_intersections.
    """
    positions, own_faces, _ = opened(V, F)
    options = options_of(weld=weld, weld_tolerance=weld_tolerance)
    return call("component_of_faces", surface_of(positions, own_faces).struct(), options).array("components")


def boundary_vertices(
    V: Union[ArrayLike, Mesh], F: Optional[Faces] = None, *, weld: Weld = "seams", weld_tolerance: float = 0.0
) -> NDArray[np.bool_]:
    """Mask (n,) of the vertices on an edge of one face only, seams closed: as `fixed`, it holds the boundary.

    V, F, weld, weld_tolerance and errors: as for find_intersections.
    """
    positions, own_faces, _ = opened(V, F)
    options = options_of(weld=weld, weld_tolerance=weld_tolerance)
    return call("boundary_vertices", surface_of(positions, own_faces).struct(), options).array("vertices").astype(bool)


def vertices_of_faces(V: Union[ArrayLike, Mesh], F: Optional[Faces], faces: ArrayLike) -> NDArray[np.bool_]:
    """Mask (n,) of the vertices that the given faces use: as `fixed`, it holds these faces.

    `faces` is a mask (m,) of bool, or their ids. With ``~mask`` of some of them all else moves only where it shares no
    vertex with them: ``fixed=vertices_of_faces(V, F, ~mask)`` moves nothing but those faces. V and F (None where V is a
    mesh) and errors: as for find_intersections.
    """
    positions, own_faces, _ = opened(V, F)
    surface = surface_of(positions, own_faces)
    flags = face_flags(faces, surface.face_count)
    found = call("vertices_of_faces", surface.struct(), c_void_p(flags.ctypes.data), c_size_t(flags.size))
    return found.array("vertices").astype(bool)
