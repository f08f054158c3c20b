"""How far a call has come: what is told of it, and a bar that shows it."""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import NamedTuple, Optional, Union


class Progress(NamedTuple):
    """How far a repair has come."""

    fraction: float  #: in [0, 1], never decreases
    phase: str  #: "diagnose", "untangle", "recover", "certify"
    pairs_left: int  #: intersecting pairs of triangles at this moment
    displacement_rel: float  #: largest displacement at this moment / bounding-box diagonal


#: What may be given as `progress`.
OnProgress = Union[Callable[[Progress], object], bool, None]


class ProgressBar:
    """One line on standard error that is written over and over, in terminals and in notebooks."""

    WIDTH = 30  # characters

    def __init__(self) -> None:
        self._shown = 0

    def __call__(self, progress: Progress) -> None:
        filled = int(self.WIDTH * progress.fraction)
        bar = "#" * filled + " " * (self.WIDTH - filled)
        line = f"{progress.fraction:4.0%} |{bar}| {progress.phase}, {progress.pairs_left} pairs left"
        print("\r" + line.ljust(self._shown), end="", file=sys.stderr, flush=True)
        self._shown = len(line)

    def close(self) -> None:
        if self._shown > 0:
            print(file=sys.stderr, flush=True)


def function_of(progress: OnProgress) -> Optional[Callable[[Progress], object]]:
    """The function to call; None: there is none."""
    if isinstance(progress, bool):
        return ProgressBar() if progress else None
    if progress is not None and not callable(progress):
        raise TypeError(f"progress is {progress!r}; give a function that takes a Progress, or True for a bar")
    return progress
