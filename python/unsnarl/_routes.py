"""Routes in space whose tubes keep clear of each other."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._arguments import polylines_of
from ._call import Status, call, call_and_wait
from ._options import options_of
from ._progress import OnProgress


@dataclass(frozen=True)
class Routes:
    """What plan_routes gives back."""

    routes: list[NDArray[np.float64]]
    """Points (n, 3) of each agent's route, from start to goal. Empty where nothing was tried."""
    status: Status
    """embedded: certified to keep clear. obstructed: report["messages"] says by what. no_progress: the best that was
    found does not hold. time_limit."""
    report: dict[str, Any]
    """What is certified: "hold", "clearance", "obstacle_clearance", "self_clearance" (distances / those needed),
    "turn" (radius * curvature), "speed" (/ the one allowed), "length" and "straight" of each route, in time its
    "arrival", "messages", "seconds"."""


def plan_routes(
    plan: Any, *, spacing: float = 0.5, time_limit: float = 0, progress: OnProgress = None
) -> Routes:
    """Finds ways for agents with radii, past each other and past obstacles (docs/routes.md).

    Parameters
    ----------
    plan
        A dict as the JSON of ``unsnarl routes``, arrays allowed: {"agents": [{"name": "a", "radius": 1, "start": [x, y,
        z], "goal": [x, y, z], "waypoints": [...]}], "obstacles": [{"vertices": V, "faces": F}, {"file": "wall.obj"}]}.
        With "timed": True, agents keep clear of where the others are at the same time; routes have equally many points.
        Agents may then have a "speed" and a "window", obstacles a "motion", and the plan a "duration".
    spacing
        Distance of the points of a route, as a multiple of its radius, in (0, 2].
    time_limit
        Seconds after which to stop. 0: none.
    progress
        Called with a Progress now and then; True draws a bar.

    Raises ValueError for an invalid plan, and names the place as in "agents[2].radius".
    """
    options = options_of(spacing=spacing, time_limit=time_limit)
    done = call_and_wait("plan_routes", _json_of(plan), options, progress=progress)
    return Routes(done.polylines(), done.status, done.report)


def check_routes(plan: Any, routes: Sequence[Any]) -> dict[str, Any]:
    """Certifies routes, arrays (n, 3), one an agent: the report of plan_routes, and "faults", what does not hold."""
    report: dict[str, Any] = call("check_routes", _json_of(plan), polylines_of(routes, 3, "route").struct()).report
    return report


def _json_of(plan: Any) -> bytes:
    if not isinstance(plan, dict):
        raise TypeError(f"plan is a {type(plan).__name__}; give a dict with 'agents' and 'obstacles'")
    return json.dumps(plan, default=_plain).encode()


def _plain(value: Any) -> Any:
    if hasattr(value, "tolist"):  # numpy
        return value.tolist()
    raise TypeError(f"plan holds a {type(value).__name__}; give numbers, texts, lists and arrays")
