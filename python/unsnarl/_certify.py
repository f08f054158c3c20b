"""Exact check of moved positions."""

from __future__ import annotations

from typing import Any, NamedTuple

from . import _native
from ._arguments import name, not_negative, thread_count
from ._scenes import scene_of


class Certificate(NamedTuple):
    """What an exact check of given positions found."""

    embedded: bool  #: no two faces meet, none has lost its area, no seam has opened
    float32_embedded: bool  #: no two faces meet after rounding all positions to float32
    pairs: dict[str, int]  #: intersecting pairs of faces by kind, see Intersections.kinds
    pairs_float32: dict[str, int]  #: the same after rounding to float32
    new_zero_area_faces: int  #: triangles without area that had some in the input
    seams_closed: bool  #: welded vertices are at one position


def certify(
    V: Any,
    F: Any,
    moved: Any,
    *,
    weld: str = "seams",
    weld_tolerance: float = 0.0,
    both_diagonals: bool = False,
    threads: int = 0,
) -> Certificate:
    """Decides exactly whether the positions `moved` (n, 3) embed the faces of the mesh (V, F).

    Vertices are welded and polygons split on V, so vertices that have come to coincide since intersect;
    find_intersections(moved, F) might weld them.

    V and F (None where V is a mesh or a list of meshes; then `moved` is a list too), weld, weld_tolerance, both_diagonals, threads and errors: as for
    find_intersections.
    """
    scene = scene_of(V, F)
    found = _native.certify(
        *scene.surface,
        scene.positions_of(moved, "moved"),
        weld=name("weld", weld),
        weld_tolerance=not_negative("weld_tolerance", weld_tolerance),
        both_diagonals=bool(both_diagonals),
        threads=thread_count(threads),
    )
    for counts in ("pairs", "pairs_float32"):
        found[counts] = dict(zip(_native.pair_kinds, found[counts]))
    return Certificate(**found)
