"""Which faces of a mesh meet."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._call import call
from ._library import pair_kinds
from ._options import options_of
from ._scenes import scene_of
from ._types import Faces, Mesh, Meshes, Weld


@dataclass(frozen=True)
class Intersections:
    """Intersecting pairs of faces; ``len(...)`` is their number, so that none is false."""

    #: (k, 2) int32, face ids a < b, sorted. A polygon that meets itself has a == b.
    pairs: NDArray[np.int32]
    #: (k,) str, how the two are related: "disjoint" (they share no vertex), "one_vertex" (they share one and meet
    #: elsewhere too), "folded" (they share an edge and overlap flat), "duplicate" (they have the same three vertices),
    #: "degenerate" (one of them has no area).
    kinds: NDArray[np.str_]
    #: Of a list of meshes: (k, 2) int32, the meshes of the two faces, counted from 0. Face ids count through all meshes
    #: in their order. Else None.
    meshes: Optional[NDArray[np.int32]] = None

    def __len__(self) -> int:
        return len(self.pairs)

    def __repr__(self) -> str:
        counts = ", ".join(f"{count} {kind}" for kind, count in self.counts.items() if count > 0)
        return f"{type(self).__name__}({counts or 'none'})"

    @property
    def counts(self) -> dict[str, int]:
        """Number of pairs of each kind, those that do not occur included."""
        return {kind: int(np.count_nonzero(self.kinds == kind)) for kind in pair_kinds}

    @property
    def faces(self) -> NDArray[np.int32]:
        """Ids of the faces that occur in some pair, each once, ascending."""
        return np.unique(self.pairs)


def find_intersections(
    V: Union[ArrayLike, Mesh, Meshes],
    F: Optional[Faces] = None,
    *,
    allow: Optional[Sequence[Any]] = None,
    weld: Weld = "seams",
    weld_tolerance: float = 0.0,
    both_diagonals: bool = False,
    threads: int = 0,
) -> Intersections:
    """All pairs of faces that meet anywhere but in the hull of the vertices they share. Touching counts.

    Decided exactly, over every pair. Other Python threads run meanwhile.

    Parameters
    ----------
    V, F
        Positions (n, 3) and faces (m, 3), (m, 4), (m, k) or (corners, offsets); or a mesh of meshio, trimesh, pyvista
        or VTK alone; or a list of such, ``find_intersections([(V, F), mesh, ...])``, of which also those between meshes
        are found. See the documentation of the package.
    allow
        Pairs of faces that may intersect, as for repair; they are left out.
    weld
        Which vertices count as one: "none"; "seams", the ends of open edges (of one face) at exactly equal positions
        (UV seams, split normals); "all" at exactly equal positions.
    weld_tolerance
        Length in the units of V: vertices this close count as equal. 0: only exactly equal ones.
    both_diagonals
        Quads have two diagonals: count two faces as intersecting where they do for any choice of them (a diagonal that
        folds its quad left out). Readers of the mesh may choose either.
    threads
        0: as many as the machine has. The result does not depend on it.

    Raises
    ------
    ValueError, TypeError
        An array has another shape or dtype, a coordinate is not finite, a face uses a vertex that does not exist, an
        option is out of range. The message says which and where.
    """
    scene = scene_of(V, F).allowing(allow)
    options = options_of(
        weld=weld, weld_tolerance=weld_tolerance, both_diagonals=both_diagonals, threads=threads
    )
    found = call("find_intersections", scene.surface.struct(), options)
    pairs = found.array("pairs")
    meshes = scene.meshes_of(pairs) if scene.is_list else None
    return Intersections(pairs, np.array(pair_kinds)[found.array("kinds")], meshes)
