"""Seifert surfaces of knots and links, and isotopies between closed curves in the plane."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._arguments import _array, not_negative
from ._curves import _points
from ._repair import Progress, Status, _callback


@dataclass(frozen=True)
class SeifertSurface:
    """What seifert_surface gives back."""

    positions: NDArray[np.float64]
    """(n, 3); the points of the link come first, component by component."""
    faces: NDArray[np.int32]
    """(m, 3) triangles."""
    status: Status
    """embedded, or time_limit or cancelled where fairing was stopped; it is embedded then too."""
    report: dict[str, Any]
    """What check_seifert_surface finds, and the crossings and Seifert circles of the diagram."""


def seifert_surface(
    link: Any,
    *,
    edge: float = 0,
    views: int = 60,
    fair: bool = True,
    time_limit: float = 0,
    progress: Callable[[Progress], object] | None = None,
) -> SeifertSurface:
    """An oriented surface without self-intersections whose boundary is a closed polygon in space, or several.

    Parameters
    ----------
    link
        A list of arrays (n, 3) of points, or one such array for a knot. The last point is joined to the first.
    edge
        Edge length inside the surface, as a fraction of the diagonal of the bounding box; 0: that of the link, within
        1/45 and 1/20.
    views
        From how many sides to look for the simplest diagram, 3 to 10000.
    fair
        False: the surface as Seifert's algorithm builds it.
    time_limit
        Seconds after which fairing stops. 0: none.
    progress
        Called with a Progress now and then.

    Raises
    ------
    ValueError, TypeError
        For what is no link, naming the component and the point.
    """
    positions, corners, status, report = _native.seifert_surface(
        _components(link), edge=not_negative("edge", edge), views=int(views), fair=bool(fair),
        time_limit=not_negative("time_limit", time_limit), progress=None if progress is None else _callback(progress),
    )
    return SeifertSurface(positions.reshape(-1, 3), corners.reshape(-1, 3), Status(status), report)


def check_seifert_surface(positions: Any, faces: Any, link: Any, *, views: int = 60) -> dict[str, Any]:
    """Checks a Seifert surface of a link by exact arithmetic, from the mesh and the link alone.

    Takes the surface as positions (n, 3) and faces (m, 3), the link as seifert_surface does, and the number of views
    that are tried for a regular projection. Returns a dictionary: "hold" is True where all does: "intersecting_pairs"
    is 0, it is "oriented", its boundary "spans_link" bit for bit, "euler_characteristic" is
    "expected_euler_characteristic", and "alexander_of_surface" is "alexander_of_link", both lists of coefficients from
    the constant up.
    """
    p = np.array(_array(positions, "positions"), dtype=np.float64, order="C")
    f = np.array(_array(faces, "faces"), dtype=np.int32, order="C")
    if p.ndim != 2 or p.shape[1] != 3 or f.ndim != 2 or f.shape[1] != 3:
        raise ValueError(f"positions have shape {p.shape}, faces {f.shape}; give (n, 3) and (m, 3)")
    return _native.check_seifert_surface(p.ravel(), f.ravel(), _components(link), views=int(views))


def knot_of_table(name: str) -> list[NDArray[np.float64]]:
    """The points (n, 3) of each component of a knot or link: "3_1" to "10_165" as in Rolfsen's table, "hopf",
    "whitehead", "borromean", "t_2_4", "t_2_4_reversed", "t_3_7", "unknot". Raises ValueError for another name."""
    return [c.reshape(-1, 3) for c in _native.knot_of_table(name)]


@dataclass(frozen=True)
class Isotopy:
    """What planar_isotopy gives back."""

    times: NDArray[np.float64]
    """Of the rings, from 0 to 1."""
    rings: list[list[NDArray[np.float64]]]
    """For each time the points (n, 2) of each curve: first those of the start, last those of the end."""
    positions: NDArray[np.float64]
    """(n, 3) of the surface that the curves sweep; z is time times the diagonal of both sides' bounding box."""
    faces: NDArray[np.int32]
    """(m, 3) triangles."""
    status: Status
    """embedded; time_limit or cancelled with nothing else in it."""


def planar_isotopy(
    start: Any,
    end: Any,
    *,
    points: int = 0,
    time_limit: float = 0,
    progress: Callable[[Progress], object] | None = None,
) -> Isotopy:
    """Moves closed curves in the plane to others so that at no time one crosses itself or another.

    Parameters
    ----------
    start, end
        Lists of equally many arrays (n, 2), or one array each; curve k of the start becomes curve k of the end.
    points
        Of every curve on the way; 0: as many as the longer of both has, 200 at least.
    time_limit
        Seconds after which to stop. 0: none.
    progress
        Called with a Progress now and then.

    Raises
    ------
    ValueError, TypeError
        For curves that cross, run around the other way or lie within others, naming the curve.
    """
    times, rings, positions, corners, status = _native.planar_isotopy(
        _points(start), _points(end), points=int(points), time_limit=not_negative("time_limit", time_limit),
        progress=None if progress is None else _callback(progress),
    )
    return Isotopy(times, [[c.reshape(-1, 2) for c in ring] for ring in rings], positions.reshape(-1, 3),
                   corners.reshape(-1, 3), Status(status))


def _components(link: Any) -> list[NDArray[np.float64]]:
    if isinstance(link, np.ndarray) and link.ndim == 2:
        link = [link]
    result = []
    for number, component in enumerate(link):
        points = _array(component, f"component {number}")
        if points.dtype.kind not in "fiu":
            raise TypeError(f"component {number} has dtype {points.dtype}; points are real numbers")
        if points.ndim != 2 or points.shape[1] != 3:
            raise ValueError(f"component {number} has shape {points.shape}; give (n, 3), x y z of each point")
        result.append(np.array(points, dtype=np.float64, order="C", copy=True).ravel())
    return result
