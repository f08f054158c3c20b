"""Calls of the library, short ones and those that are waited for, and what comes of them."""

from __future__ import annotations

import ctypes
import enum
import json
import queue
import threading
import weakref
from collections.abc import Callable
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import NDArray

from ._library import ArrayStruct, ProgressFunction, check, library
from ._progress import OnProgress, Progress, ProgressBar, function_of

#: Seconds after which a thread that waits looks for signals, where none has woken it.
_SIGNAL_INTERVAL_S = 0.1

#: By unsnarl_type.
_DTYPES = (np.float64, np.int32, np.uint8)


class Status(str, enum.Enum):
    """How a repair ended; equal to its name, as in ``result.status == "embedded"``."""

    embedded = "embedded"  #: no two faces meet anywhere but in the hull of the vertices they share
    reduced = "reduced"  #: fewer intersecting pairs than the input, but not none
    no_progress = "no_progress"  #: nothing better than the input was found; V is the input's
    obstructed = "obstructed"  #: all repaired but what no motion can resolve, see report["obstructions"]
    allowed = "allowed"  #: no two faces meet but those that `allow` lets pass through each other
    not_nested = "not_nested"  #: no two faces meet, but a mesh does not lie inside another as `nested` asks
    time_limit = "time_limit"  #: stopped by time_limit
    memory_limit = "memory_limit"  #: stopped by memory_limit
    displacement_exceeded = "displacement_exceeded"  #: some vertex had to move further than max_displacement
    gap_not_met = "gap_not_met"  #: no two faces meet, but report["gap"] falls short of min_gap by more than 1 %
    cancelled = "cancelled"  #: not seen from Python, where what cancels is raised

    __str__ = str.__str__


class _Context:
    """What a call tells of itself and is cancelled by."""

    def __init__(self, tell: Optional[Callable[[Any, Any], int]]):
        self._on_progress = ProgressFunction(tell) if tell else ProgressFunction(0)
        self.handle = ctypes.c_void_p(library.unsnarl_context_new(self._on_progress, None))
        if not self.handle:
            raise MemoryError("there is not enough memory")
        weakref.finalize(self, library.unsnarl_context_free, self.handle)

    def cancel(self) -> None:
        library.unsnarl_context_cancel(self.handle)


class Outcome:
    """A result of the library."""

    def __init__(self, handle: ctypes.c_void_p):
        self._handle = handle
        weakref.finalize(self, library.unsnarl_result_free, handle)

    @property
    def status(self) -> Status:
        return Status(library.unsnarl_result_status(self._handle).decode())

    @property
    def report(self) -> Any:
        return json.loads(library.unsnarl_result_report(self._handle))

    def array(self, name: str) -> NDArray[Any]:
        """A copy; flat where there is one column."""
        found = ArrayStruct()
        check(library.unsnarl_result_array(self._handle, name.encode(), ctypes.byref(found)))
        shape = (found.rows,) if found.columns == 1 else (found.rows, found.columns)
        result: NDArray[Any] = np.empty(shape, _DTYPES[found.type])
        ctypes.memmove(result.ctypes.data, found.data, result.nbytes)
        return result

    def polylines(self) -> list[NDArray[np.float64]]:
        """The points of each curve."""
        points, offsets = self.array("points"), self.array("offsets")
        return [points[begin:end].copy() for begin, end in zip(offsets, offsets[1:])]


def call(name: str, *arguments: Any) -> Outcome:
    """The result of a function of the library; the last of its arguments, which takes it, is not to be given."""
    handle = ctypes.c_void_p()
    given = [ctypes.byref(a) if isinstance(a, ctypes.Structure) else a for a in arguments]
    check(getattr(library, f"unsnarl_{name}")(*given, ctypes.byref(handle)))
    return Outcome(handle)


def next_news(news: queue.SimpleQueue[Any]) -> Any:
    """What has come; None: nothing for a while."""
    try:
        return news.get(timeout=_SIGNAL_INTERVAL_S)
    except queue.Empty:
        return None


def call_and_wait(name: str, *arguments: Any, progress: OnProgress) -> Outcome:
    """The same of a function that takes a context, which is not to be given either.

    It works in a thread of its own, while this one serves Python: it hands out progress and heeds Ctrl-C. What is
    raised here cancels the work, and is raised once that has stopped.
    """
    show = function_of(progress)
    news: queue.SimpleQueue[Any] = queue.SimpleQueue()  # a Progress each; what the work came to ends it

    def tell(report: Any, _: Any) -> int:
        now = report.contents
        news.put(Progress(now.fraction, now.phase.decode(), now.pairs_left, now.displacement_rel))
        return 0

    context = _Context(tell if show is not None else None)

    def work() -> None:
        try:
            news.put(call(name, *arguments, context.handle))
        except BaseException as error:
            news.put(error)

    worker = threading.Thread(target=work, name=f"unsnarl_{name}")
    raised: Optional[BaseException] = None
    came_to: Union[Outcome, BaseException, None] = None
    worker.start()
    try:
        while came_to is None:
            try:
                report = next_news(news)
                if report is None and isinstance(show, ProgressBar):
                    show.show_again()
                if not isinstance(report, Progress):
                    came_to = report
                elif raised is None and show is not None:
                    show(report)
            except BaseException as error:
                if raised is None:
                    raised = error
                context.cancel()
    finally:
        if came_to is None:  # interrupted between the lines above
            context.cancel()
        worker.join()
        if isinstance(show, ProgressBar):
            show.close()
    if raised is not None:
        raise raised
    if isinstance(came_to, BaseException):
        raise came_to
    return came_to
