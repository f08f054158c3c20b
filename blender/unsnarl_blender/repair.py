# SPDX-License-Identifier: GPL-3.0-or-later
"""Calls of the library, and the certificate of what Blender keeps of their results. Knows nothing of Blender."""

import re
from typing import NamedTuple

import numpy as np

from .spaces import space_of, spaces_of
from .versions import unsnarl

#: Statuses of the library with which nothing is left to repair.
CLEAN = {"embedded", "allowed", "gap_not_met"}
#: How often what rounding brought together is moved apart again; each time by twice as much.
ROUNDS = 4
#: The first such gap, in steps of the float32 numbers at the largest coordinate: rounding moves each of two faces by
#: half a step along each axis (no unit).
FIRST_GAP = 2


class Options(NamedTuple):
    """Lengths are in units of the scene; 0 is none, as for the library."""

    min_gap: float = 0.0
    gap_near_conflicts: bool = False
    max_displacement: float = 0.0
    time_limit: float = 0.0
    memory_limit: float = 0.0
    both_diagonals: bool = False
    threads: int = 0

    @property
    def search(self):
        return {"both_diagonals": self.both_diagonals, "threads": self.threads}


class Repaired(NamedTuple):
    status: str  #: as of the library, but "reduced" where it does not hold of what Blender keeps
    before: int  #: intersecting pairs
    after: int  #: of `positions`
    positions: list  #: of each object float32, in its own coordinates: what is to be kept
    has_moved: bool
    report: dict  #: of the library; lengths in units of its space
    length: float  #: of such a unit, in units of the scene
    notes: list

    @property
    def is_as_asked(self):
        """Clean, with the gap that was asked for."""
        return self.status in CLEAN - {"gap_not_met"}

    def is_written(self, keep_incomplete):
        """As the program decides: what is clean, what is all that can be repaired, anything better if asked for."""
        if self.status in CLEAN:
            return True
        return self.has_moved and (self.status == "obstructed" or keep_incomplete) and self.after <= self.before


def found(surfaces, options):
    """Intersecting faces: (pairs of the library, their number by pair of objects, the faces of each object)."""
    placed = space_of([s.to_world for s in surfaces]).placed([s.positions for s in surfaces])
    pairs = unsnarl.find_intersections(_meshes(placed, surfaces), **options.search)
    sides = np.sort(pairs.meshes.reshape(-1, 2), axis=1)
    counts = {}
    for a, b in sides.tolist():
        counts[a, b] = counts.get((a, b), 0) + 1
    first = np.cumsum([0] + [len(s.offsets) - 1 for s in surfaces])
    faces = [pairs.faces[(pairs.faces >= a) & (pairs.faces < b)] - a for a, b in zip(first, first[1:])]
    return pairs, counts, faces


def repaired(surfaces, rigid, options, progress=None, shown=None):
    """Repairs objects as one scene.

    rigid: the numbers of those that move as bodies. shown: what is displayed of positions that are kept, where that is
    not the same numbers: a function of a list of arrays (n, 3) float32, one an object, to such a list.
    """
    space = space_of([s.to_world for s in surfaces])
    before = [s.positions for s in surfaces]
    placed = space.placed(before)

    def keep(moved):
        kept = space.kept(moved, before)
        return shown(kept) if shown else kept

    result = _in_units_of_the_scene(
        unsnarl.repair,
        space.length,
        options.min_gap,
        _meshes(placed, surfaces),
        fixed=[s.held for s in surfaces],
        rigid=rigid or None,
        min_gap=options.min_gap / space.length,
        max_displacement=options.max_displacement / space.length,
        absolute=True,
        gap_near_conflicts=options.gap_near_conflicts,
        time_limit=options.time_limit,
        memory_limit=options.memory_limit,
        progress=progress,
        **options.search,
    )
    status, after = str(result.status), result.report["after"]["total"]
    kept, status, after, notes = _settled(
        surfaces, rigid, space, placed, result.V, keep, status, after, options, progress
    )
    return Repaired(
        status,
        result.report["before"]["total"],
        after,
        kept,
        any(not np.array_equal(a, b) for a, b in zip(kept, before)),
        result.report,
        space.length,
        notes,
    )


def repaired_frames(frames, options, progress=None):
    """Repairs the frames of objects as one moving scene, so that corrections go on smoothly in time.

    frames: of each frame a list of surfaces, of the same faces in all. Returns a Repaired of each frame.
    """
    first = frames[0]
    spaces = spaces_of([[s.to_world for s in frame] for frame in frames])
    placed = [space.placed([s.positions for s in frame]) for space, frame in zip(spaces, frames)]
    V = np.stack([np.concatenate(own) for own in placed])
    extents = [
        float(np.linalg.norm(own.max(axis=0) - own.min(axis=0))) * space.length for own, space in zip(V, spaces)
    ]
    result = _in_units_of_the_scene(
        unsnarl.repair_sequence,
        min(extents),
        options.min_gap,
        V,
        _faces_of_all(first),
        fixed=np.concatenate([s.held for s in first]),
        # The library takes shares of each frame's diagonal: of the smallest, a gap is as wide as asked in every frame,
        # of the largest, no vertex moves farther.
        min_gap=options.min_gap / min(extents) if options.min_gap else 0,
        max_displacement=options.max_displacement / max(extents) if options.max_displacement else 0,
        gap_near_conflicts=options.gap_near_conflicts,
        time_limit=options.time_limit,
        progress=progress,
        **options.search,
    )
    ends = np.cumsum([len(s.positions) for s in first])[:-1]
    return [
        _frame(frame, space, own, np.split(moved, ends), report, options)
        for frame, space, own, moved, report in zip(frames, spaces, placed, result.V, result.frames)
    ]


def _frame(surfaces, space, placed, moved, report, options):
    before = [s.positions for s in surfaces]
    kept, status, after, notes = _settled(
        surfaces,
        [],
        space,
        placed,
        moved,
        lambda m: space.kept(m, before),
        str(report.status),
        sum(report.after.values()),
        options,
        None,
    )
    has_moved = any(not np.array_equal(a, b) for a, b in zip(kept, before))
    figures = {
        "displacement_max": report.displacement_max_rel * report.diagonal,
        "untouched_share": report.untouched_share,
    }
    return Repaired(status, sum(report.before.values()), after, kept, has_moved, figures, space.length, notes)


def _settled(surfaces, rigid, space, placed, moved, keep, status, after, options, progress):
    """What is kept of a result, certified as it is kept: where float32 numbers make faces meet again, these are moved
    apart by some steps of such numbers. Returns (kept, status, pairs left, notes)."""
    kept = keep(moved)
    if space.is_own and all(np.array_equal(a, b) for a, b in zip(kept, moved)):
        return kept, status, after, []  # the library has certified these very numbers
    gap = FIRST_GAP * space.step(kept)
    for attempt in range(ROUNDS + 1):
        seen = space.placed(kept)
        certificate = unsnarl.certify(_meshes(placed, surfaces), None, seen, **options.search)
        left = sum(certificate.pairs.values())
        if status not in CLEAN or certificate.resolved or attempt == ROUNDS:
            break
        again = unsnarl.repair(
            _meshes(seen, surfaces),
            fixed=[s.held for s in surfaces],
            rigid=rigid or None,
            min_gap=gap * 2**attempt,
            absolute=True,
            gap_near_conflicts=True,
            progress=progress,
            **options.search,
        )
        kept = keep(again.V)
    notes = []
    if status in CLEAN and not certificate.resolved:
        status = "reduced"
        notes.append("Rounding to the float32 numbers that Blender keeps made faces meet again. Ask for a gap.")
    elif status in CLEAN and not space.is_own:
        for surface, own in zip(surfaces, kept):
            alone = unsnarl.certify([(surface.positions, surface.faces)], None, [own], **options.search)
            if not alone.resolved:
                status, left = "reduced", max(left, sum(alone.pairs.values()))
                notes.append(f"'{surface.name}' intersects itself in its own float32 coordinates. Ask for a gap.")
        if not certificate.float32_embedded:
            count = sum(certificate.pairs_float32.values())
            notes.append(
                f"{count} pairs meet if a program rounds positions in the world to float32, as exporters do. "
                "Ask for a gap, or apply the transforms."
            )
    return kept, status, left, notes


def _in_units_of_the_scene(function, length, gap, *arguments, **options):
    """Calls a function of the library; of a gap that it refuses, says so in units of the scene. length: of one of its
    units of the gap, in these."""
    try:
        return function(*arguments, **options)
    except ValueError as error:
        too_wide = re.search(r"is (\S+) times as wide as the faces; (\S+) is the most", str(error))
        if too_wide is None:
            raise
        most = float(too_wide[2]) * length
        raise ValueError(
            f"A gap of {gap:.4g} is {too_wide[1]} times as wide as the faces; {most:.4g} is the most here. Ask for "
            "less, or subdivide the mesh"
        ) from None


def pairs_left(surfaces, positions, options):
    """Intersecting pairs of objects at other positions, float32 in their own coordinates."""
    space = space_of([s.to_world for s in surfaces])
    placed = space.placed([s.positions for s in surfaces])
    certificate = unsnarl.certify(_meshes(placed, surfaces), None, space.placed(positions), **options.search)
    return sum(certificate.pairs.values())


def drawn_pairs(before, triangles, after, options):
    """Intersecting pairs among the triangles that Blender draws of a repaired mesh."""
    certificate = unsnarl.certify(before, triangles, after, threads=options.threads)
    return sum(certificate.pairs.values())


def _meshes(placed, surfaces):
    return [(own, surface.faces) for own, surface in zip(placed, surfaces)]


def _faces_of_all(surfaces):
    """Faces of all objects as those of one mesh, whose vertices come object after object."""
    first = np.cumsum([0] + [len(s.positions) for s in surfaces])
    corners = np.concatenate([s.corners + begin for s, begin in zip(surfaces, first)]).astype(np.int32)
    sizes = np.concatenate([np.diff(s.offsets) for s in surfaces])
    if np.all(sizes == 3):
        return corners.reshape(-1, 3)
    return corners, np.append(0, np.cumsum(sizes)).astype(np.int32)
