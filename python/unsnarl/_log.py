"""What the logger "unsnarl" is told."""

from __future__ import annotations

import logging

from ._call import Outcome

_log = logging.getLogger("unsnarl")
_log.addHandler(logging.NullHandler())

#: Of the parts that changed, most changed first.
_MOST_PARTS_NAMED = 5


def log(repaired: Outcome) -> None:
    """Tells the logger "unsnarl" what a repair came to: warnings where something is left, and of parts that changed."""
    report = repaired.report
    log_notes(report["input"]["notes"])
    level = logging.INFO if repaired.status in ("embedded", "allowed") else logging.WARNING
    _log.log(
        level,
        "%s: %d intersecting pairs before, %d after; moved by %.2g at most, %.2g of the diagonal; %.2f s",
        repaired.status,
        report["before"]["total"],
        report["after"]["total"],
        report["displacement_max"],
        report["displacement_max_rel"],
        report["seconds"],
    )
    for changed in report["changed_components"][:_MOST_PARTS_NAMED]:
        _log.warning("%s", changed["message"])
    log_notes(report["advice"])


def log_notes(notes: list[str]) -> None:
    for note in notes:
        _log.info("%s", note)
