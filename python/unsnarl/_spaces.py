"""Seifert surfaces of knots and links, and isotopies of curves in the plane and of knots."""

from __future__ import annotations

import operator
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._arguments import polylines_of, surface_of
from ._call import Outcome, Status, call, call_and_wait
from ._options import name_of, options_of
from ._progress import OnProgress


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
    handles: int = 0,
    time_limit: float = 0,
    progress: OnProgress = None,
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
    handles
        Added to the surface, each of which raises its genus by one, 0 to 100.
    time_limit
        Seconds after which fairing stops. 0: none.
    progress
        Called with a Progress now and then; True draws a bar.

    Raises
    ------
    ValueError, TypeError
        For what is no link, naming the component and the point.
    """
    options = options_of(edge=edge, views=views, fair=fair, handles=handles, time_limit=time_limit)
    polygons = polylines_of(link, 3, "component")
    made = call_and_wait("seifert_surface", polygons.struct(), options, progress=progress)
    return SeifertSurface(made.array("positions"), made.array("corners"), made.status, _findings(made))


def untangled_seifert_surface(
    positions: Any,
    faces: Any,
    *,
    edge: float = 0,
    fair: bool = True,
    time_limit: float = 0,
    progress: OnProgress = None,
) -> SeifertSurface:
    """A surface of your own that spans a link and may run through itself, untangled with its boundary held bit for bit.

    Takes positions (n, 3) and faces (m, 3) of an oriented surface with a boundary, and edge, fair, time_limit and
    progress as seifert_surface does. The points of the boundary come first in the result. If pairs of faces are left,
    its status is no_progress, its arrays are empty, and report["message"] says how many. Raises ValueError for a surface
    that is not oriented or has no boundary.
    """
    start = surface_of(positions, faces)
    options = options_of(edge=edge, fair=fair, time_limit=time_limit)
    made = call_and_wait("untangled_seifert_surface", start.struct(), options, progress=progress)
    return SeifertSurface(made.array("positions"), made.array("corners"), made.status, _findings(made))


def check_seifert_surface(positions: Any, faces: Any, link: Any, *, views: int = 60, handles: int = 0) -> dict[str, Any]:
    """Checks a Seifert surface of a link by exact arithmetic, from the mesh and the link alone.

    Takes the surface as positions (n, 3) and faces (m, 3), the link as seifert_surface does, the number of views that
    are tried for a regular projection, and the number of handles that were added. Returns a dictionary: "hold" is True where all does: "intersecting_pairs"
    is 0, it is "oriented", its boundary "spans_link" bit for bit, "euler_characteristic" is
    "expected_euler_characteristic", and "alexander_of_surface" is "alexander_of_link", both lists of coefficients from
    the constant up. Also in it are the "determinant", the "signature" (-2 for the right-handed trefoil), and
    "genus_is_least": the degree of the polynomial proves that no connected surface has a smaller genus.
    """
    polygons = polylines_of(link, 3, "component")
    surface = surface_of(positions, faces)
    return _findings(call("check_seifert_surface", surface.struct(), polygons.struct(), options_of(views=views, handles=handles)))


def _findings(outcome: Outcome) -> dict[str, Any]:
    report: dict[str, Any] = outcome.report
    for polynomial in ("alexander_of_surface", "alexander_of_link"):
        if polynomial in report:
            report[polynomial] = [int(coefficient) for coefficient in report[polynomial]]
    if "determinant" in report:
        report["determinant"] = int(report["determinant"])
    return report


@dataclass(frozen=True)
class KnotTube:
    """What knot_tube gives back."""

    positions: NDArray[np.float64]
    """(n, 3); empty where there is no tube."""
    faces: NDArray[np.int32]
    """(m, 3) triangles."""
    radius: float
    """0: no tube was found."""


def knot_tube(link: Any, positions: Any, faces: Any) -> KnotTube:
    """A tube around each component of a link, to show it with a surface that spans it.

    Takes the link as seifert_surface does, and positions (n, 3) and faces (m, 3) of the surface. The tube does not run
    through itself, and along each component it meets the surface in one band of faces, by exact arithmetic. Its radius
    is 2 % of the diagonal of the link's bounding box, or less if needed, down to 5 millionths of it.
    """
    polygons = polylines_of(link, 3, "component")
    made = call("knot_tube", polygons.struct(), surface_of(positions, faces).struct())
    return KnotTube(made.array("positions"), made.array("corners"), made.report["radius"])


@dataclass(frozen=True)
class RelaxedWire:
    """What relaxed_wire gives back."""

    points: NDArray[np.float64]
    """(n, 3) of the knot, 200 at least."""
    status: Status
    """embedded; time_limit, cancelled: stopped. It is the same knot then too."""
    report: dict[str, Any]
    """"at_rest": False where it was stopped or no further step could be proven; its "energy"; "seconds"."""


def relaxed_wire(knot: Any, *, time_limit: float = 0, progress: OnProgress = None) -> RelaxedWire:
    """Lets a knot repel itself until it comes to rest. Every step is proven to be an isotopy; its length stays.

    knot: an array (n, 3) of at most 2,000 points, or a list of one. time_limit: seconds after which to stop; 0: none.
    progress: as in seifert_surface. Raises ValueError for what is no knot.
    """
    polygon = polylines_of(knot, 3, "component")
    made = call_and_wait("relaxed_wire", polygon.struct(), options_of(time_limit=time_limit), progress=progress)
    return RelaxedWire(made.polylines()[0], made.status, made.report)


def knot_of_table(name: str) -> list[NDArray[np.float64]]:
    """The points (n, 3) of each component of a knot or link: "3_1" to "10_165" as in Rolfsen's table, "hopf",
    "whitehead", "borromean", "t_2_4", "t_2_4_reversed", "t_3_7", "unknot"; diagrams of the unknot: "circle", "kinks_1"
    to "kinks_6", "culprit", "goeritz", "thistlethwaite", "ochiai", "ochiai_2". Raises ValueError for another name."""
    return call("knot_of_table", name_of("name", name)).polylines()


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
    report: dict[str, Any]
    """method ("annulus", "untangled annulus" or "shortening"), shortened (the part of the way to triangles that was
    gone), length_kept and area_kept (least ratio to what is evenly between start and end), becomes (the number of the
    curve of the end that each of the start becomes; rings have the curves in the order of the start)."""


def planar_isotopy(
    start: Any,
    end: Any,
    *,
    points: int = 0,
    pairs: Sequence[tuple[int, int]] | None = None,
    time_limit: float = 0,
    progress: OnProgress = None,
) -> Isotopy:
    """Moves closed curves in the plane to others so that at no time one crosses itself or another.

    Parameters
    ----------
    start, end
        Lists of equally many arrays (n, 2), or one array each.
    points
        Of every curve in the middle of the way, at least; 0: 200. There are more where curves have more.
    pairs
        Numbers of a curve of the start and of the one of the end that it becomes, such as [(0, 1), (1, 0)]. The others
        are paired so that curves lie in each other alike on both sides and are near: with [] all are. None: curve k
        becomes curve k.
    time_limit
        Seconds after which to stop. 0: none.
    progress
        Called with a Progress now and then; True draws a bar.

    Raises
    ------
    ValueError, TypeError
        For curves that cross, run around the other way or lie in each other otherwise at the end, naming the curve.
    """
    both = [polylines_of(side, 2, "curve") for side in (start, end)]
    options = options_of(points=points, time_limit=time_limit)
    if pairs is not None:
        options.pairs = ",".join(f"{operator.index(a)}={operator.index(b)}" for a, b in pairs).encode()
    made = call_and_wait("planar_isotopy", *(side.struct() for side in both), options, progress=progress)
    curves = made.polylines()
    count = len(both[0].sizes)
    rings = [curves[first : first + count] for first in range(0, len(made.array("times")) * count, count)]
    return Isotopy(made.array("times"), rings, made.array("positions"), made.array("corners"), made.status, made.report)


@dataclass(frozen=True)
class KnotIsotopy:
    """What knot_isotopy gives back."""

    times: NDArray[np.float64]
    """Of the rings, from 0 to 1."""
    rings: list[NDArray[np.float64]]
    """For each time the points (n, 3) of the knot: first those of the start, last those of the end. All between have
    equally many and move straight from ring to ring."""
    status: Status
    """embedded; no_progress: none was found; time_limit, cancelled. In all but the first case there are no rings."""
    report: dict[str, Any]
    """What is certified ("hold", ...), how it was found or where it stopped ("found"), double points."""


def knot_isotopy(
    start: Any,
    end: Any,
    *,
    points: int = 0,
    time_limit: float = 0,
    progress: OnProgress = None,
) -> KnotIsotopy:
    """Moves a knot to another polygon of the same knot without ever passing through itself.

    Parameters
    ----------
    start, end
        Arrays (n, 3) of points. The last point is joined to the first.
    points
        Of the knot on the way, 16 to 2000; 0: as many as the longer of both has, 200 at least.
    time_limit
        Seconds after which to stop. 0: none.
    progress
        Called with a Progress now and then; True draws a bar.

    Raises
    ------
    ValueError, TypeError
        For what is no knot: edges that touch or have no length, several components; naming the place.
    """
    both = [polylines_of(side, 3, "component") for side in (start, end)]
    options = options_of(points=points, time_limit=time_limit)
    made = call_and_wait("knot_isotopy", *(side.struct() for side in both), options, progress=progress)
    return KnotIsotopy(made.array("times"), made.polylines(), made.status, made.report)
