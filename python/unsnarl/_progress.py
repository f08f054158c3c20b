"""How far a call has come: what is told of it, and a bar that shows it."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from typing import NamedTuple, Optional, Union


class Progress(NamedTuple):
    """How far a repair has come."""

    fraction: float  #: in [0, 1], never decreases
    phase: str  #: "diagnose", "place" (rigid parts), "untangle", "recover", "open_gaps", "certify"
    pairs_left: int  #: intersecting pairs of faces (of curves: of segments) at this moment
    displacement_rel: float  #: largest displacement at this moment / bounding-box diagonal


#: What may be given as `progress`.
OnProgress = Union[Callable[[Progress], object], bool, None]


class ProgressBar:
    """One line on standard error that is written over and over, in terminals and in notebooks."""

    WIDTH = 30  # characters
    SHOWN_AGAIN_AFTER_S = 0.9

    def __init__(self) -> None:
        self._shown = 0
        self._begin = self._drawn = time.monotonic()
        self._last: Optional[Progress] = None

    def __call__(self, progress: Progress) -> None:
        self._last = progress
        self._drawn = time.monotonic()
        filled = int(self.WIDTH * progress.fraction)
        bar = "#" * filled + " " * (self.WIDTH - filled)
        line = f"{progress.fraction:4.0%} |{bar}| {progress.phase}, {progress.pairs_left} pairs left"
        line += f", {time.monotonic() - self._begin:.0f} s"
        print("\r" + line.ljust(self._shown), end="", file=sys.stderr, flush=True)
        self._shown = len(line)

    def show_again(self) -> None:
        """The same with the seconds that have passed since."""
        if self._last is not None and time.monotonic() - self._drawn > self.SHOWN_AGAIN_AFTER_S:
            self(self._last)

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
