"""Self-intersecting test surfaces."""

from __future__ import annotations

import json
from ctypes import c_int32
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._call import call
from ._options import count, name_of


@dataclass(frozen=True)
class SampleParameter:
    """A number that shapes a sample."""

    name: str
    value: float  #: the default
    minimum: float
    maximum: float
    description: str


@dataclass(frozen=True)
class Sample:
    """A kind of surface that sample() makes."""

    name: str
    description: str
    embeddable: bool  #: False: no motion of vertices can embed it
    parameters: list[SampleParameter]


def samples() -> list[Sample]:
    """All samples of surfaces, as ``unsnarl sample --list`` names them."""
    return [
        Sample(one["name"], one["description"], one["embeddable"], [SampleParameter(**p) for p in one["parameters"]])
        for one in call("list_samples").report
    ]


def sample(name: str, *, resolution: int = 0, **parameters: float) -> tuple[NDArray[np.float64], Any]:
    """The surface of ``unsnarl sample NAME`` as (V, F): F is (m, 3), (m, 4), or (corners, offsets) of mixed polygons.

    Parameters
    ----------
    name
        As samples() lists them: "crossing_tubes", ...
    resolution
        Steps along the longest direction of the surface, 8 to 2000. 0: the sample's own.
    parameters
        Numbers by the names that samples() lists, as in ``sample("crossing_tubes", radius=0.3)``.

    Raises ValueError for an unknown name or an invalid number; the message lists the valid ones.
    """
    given = json.dumps({key: float(value) for key, value in parameters.items()}).encode()
    made = call("sample", name_of("name", name), c_int32(count("resolution", resolution)), given)
    corners, offsets = made.array("corners"), made.array("offsets")
    V: NDArray[np.float64] = made.array("positions")
    if offsets.size == 0:
        return V, corners.reshape(-1, 3)
    sizes = np.unique(np.diff(offsets))
    if len(sizes) == 1:
        return V, corners.reshape(-1, sizes[0])
    return V, (corners, offsets)
