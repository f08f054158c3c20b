"""Exact check of moved positions."""

from __future__ import annotations

from collections.abc import Sequence
from ctypes import c_size_t, c_void_p
from typing import Any, NamedTuple, Optional, Union

from numpy.typing import ArrayLike

from ._call import call
from ._options import options_of
from ._scenes import scene_of
from ._types import Faces, Mesh, Meshes, Weld


class Certificate(NamedTuple):
    """What an exact check of given positions found."""

    embedded: bool  #: no two faces meet, none has lost its area, no seam has opened
    float32_embedded: bool  #: no two faces meet after rounding all positions to float32
    pairs: dict[str, int]  #: intersecting pairs of faces by kind, see Intersections.kinds
    pairs_float32: dict[str, int]  #: the same after rounding to float32
    new_zero_area_faces: int  #: triangles without area that had some in the input
    seams_closed: bool  #: welded vertices are at one position
    allowed: dict[str, int]  #: pairs that may intersect and do, which the others leave out
    resolved: bool  #: embedded, or nothing keeps it from being so but pairs that may intersect


def certify(
    V: Union[ArrayLike, Mesh, Meshes],
    F: Optional[Faces],
    moved: Union[ArrayLike, Sequence[ArrayLike]],
    *,
    allow: Optional[Sequence[Any]] = None,
    weld: Weld = "seams",
    weld_tolerance: float = 0.0,
    both_diagonals: bool = False,
    threads: int = 0,
) -> Certificate:
    """Decides exactly whether the positions `moved` (n, 3) embed the faces of the mesh (V, F).

    Vertices are welded as in V, so those that have come to coincide since intersect; find_intersections(moved, F) might
    weld them. Polygons are split into triangles as in V, and as a program splits them that reads `moved`.

    allow: pairs of faces that may intersect, as for repair; Certificate.allowed alone counts them.

    V and F (None where V is a mesh or a list of meshes; then `moved` is a list too), weld, weld_tolerance,
    both_diagonals, threads and errors: as for find_intersections.
    """
    scene = scene_of(V, F).allowing(allow)
    options = options_of(
        weld=weld, weld_tolerance=weld_tolerance, both_diagonals=both_diagonals, threads=threads
    )
    positions = scene.positions_of(moved, "moved")
    found = call(
        "certify", scene.surface.struct(), c_void_p(positions.ctypes.data), c_size_t(positions.size // 3), options
    )
    return Certificate(**found.report)
