# SPDX-License-Identifier: GPL-3.0-or-later
"""What the operators do, in steps: generators that yield a line to show now and then, and return what to say.

Closing one before it ends leaves nothing behind. Blender is read and written between the steps, in the thread that
asks for them; the library works in a thread of its own.
"""

import re
import time
from typing import NamedTuple

import bpy
import numpy as np

from . import marks, repair, results, shape_keys
from .job import Job
from .surfaces import Refused, base_surface, displayed_surface, object_of, targets


class Said(NamedTuple):
    """What came of a run."""

    written: bool  #: was anything changed?
    is_clean: bool  #: is nothing left to do?
    lines: list  #: sentences; the first is the summary


#: Obstructions, and changed parts, that are named.
MOST_PARTS = 3

PHASES = {
    "diagnose": "Looking for intersections",
    "place": "Placing rigid objects",
    "untangle": "Untangling",
    "recover": "Moving back",
    "open_gaps": "Opening gaps",
    "certify": "Checking",
}


def find(context):
    """Marks the faces that intersect. Returns what to say, and a line for each pair of objects that intersect."""
    settings = context.scene.unsnarl
    chosen = targets(context, settings.scope)
    surfaces = [_surface_of(target, settings.as_displayed) for target in chosen]
    pairs, counts, faces = repair.found(surfaces, settings.options())
    notes = []
    changed = False
    for target, surface, own in zip(chosen, surfaces, faces):
        if target.data.library:
            notes.append(f"The faces of '{target.name}' are not marked: its mesh is linked from another file.")
        elif settings.as_displayed and len(surface.offsets) - 1 != len(target.data.polygons):
            notes.append(f"The faces of '{target.name}' are not marked: its modifiers change which faces there are.")
        else:
            changed |= settings.select or settings.colour
            notes += _mark(target, own, settings)
    if changed and settings.select:
        context.tool_settings.mesh_select_mode = (False, False, True)
    found = [
        "{}: {}".format(surfaces[a].name if a == b else f"{surfaces[a].name} – {surfaces[b].name}", _pairs(count))
        for (a, b), count in sorted(counts.items())
    ]
    total = len(pairs)
    summary = f"{_pairs(total)} of faces intersect." if total else "No self-intersections."
    return Said(changed, total == 0, [summary, *notes]), found


def _mark(target, faces, settings):
    hidden = marks.select_faces(target, faces) if settings.select else 0
    if settings.colour and len(target.data.polygons) > 0:
        marks.paint(target, faces)
    return [f"{hidden} of these faces of '{target.name}' are hidden and not selected."] if hidden else []


def repair_objects(context):
    """Repairs the objects that the settings name."""
    settings = context.scene.unsnarl
    chosen = targets(context, settings.scope)
    notes = results.check_result(chosen, settings)
    surfaces = [_surface_of(target, settings.as_displayed, settings) for target in chosen]
    notes += _held_notes(chosen, settings)
    shown = _displayed_of_keys(chosen, surfaces) if settings.result == "SHAPE_KEY" else None
    rigid = [number for number, target in enumerate(chosen) if settings.role_of(target) == "RIGID"]
    options, started = settings.options(), time.monotonic()
    came_to = yield from _worked(lambda tell: repair.repaired(surfaces, rigid, options, tell, shown))

    chosen = _unchanged(context.scene, surfaces, settings.as_displayed)
    is_written = came_to.is_written(settings.keep_incomplete) and came_to.has_moved
    if is_written:
        notes += _write(context, chosen, surfaces, came_to, settings)
    lines = _summary(context.scene, came_to, time.monotonic() - started, is_written, settings.keep_incomplete)
    lines += came_to.notes + _on_parts(came_to.report, surfaces) + notes
    return Said(is_written, came_to.is_as_asked, lines)


def _write(context, chosen, surfaces, came_to, settings):
    notes, added = [], []
    depsgraph = context.evaluated_depsgraph_get()
    for target, surface, positions in zip(chosen, surfaces, came_to.positions):
        if settings.result == "NEW_OBJECT":
            added.append(results.add_object(target, positions, settings.as_displayed, depsgraph))
        elif np.array_equal(positions, surface.positions):
            continue  # nothing of it moved: the object stays as it is
        elif settings.result == "SHAPE_KEY":
            notes += results.write_shape_key(target, positions, surface.positions)
        else:
            results.write_in_place(target, positions)
    if added and context.mode == "OBJECT":
        results.select_alone(added, context.view_layer)
    for surface, positions, target in zip(surfaces, came_to.positions, added or chosen):
        notes += _notes_on_drawing(surface, positions, target, settings)
    return notes


def _notes_on_drawing(surface, positions, target, settings):
    """Blender cuts polygons of more than four corners otherwise than the library: is what it draws clean too?"""
    if np.diff(surface.offsets).max(initial=0) <= 4 or target.mode == "EDIT" or settings.result == "SHAPE_KEY":
        return []
    mesh = target.data
    mesh.calc_loop_triangles()
    triangles = np.empty(3 * len(mesh.loop_triangles), np.int32)
    mesh.loop_triangles.foreach_get("vertices", triangles)
    count = repair.drawn_pairs(surface.positions, triangles.reshape(-1, 3), positions, settings.options())
    if count == 0:
        return []
    return [
        f"Blender cuts polygons of '{target.name}' otherwise: {_pairs(count)} of the triangles that it draws"
        " intersect. Triangulate its polygons of more than four corners."
    ]


def repair_frames(context):
    """Repairs a range of frames, from what is displayed in them."""
    scene, settings = context.scene, context.scene.unsnarl
    chosen = targets(context, settings.scope)
    first, last = settings.frames()
    paths = _check_frames(chosen, settings, first, last)
    shown_frame, shown_subframe = scene.frame_current, scene.frame_subframe
    names = [target.name_full for target in chosen]
    caches = [own for own in map(results.own_cache, chosen) if own is not None and own.show_viewport]
    try:
        for own in caches:
            own.show_viewport = False  # what is repaired is what was there before the last run
        frames = []
        for number in range(first, last + 1):
            yield f"Reading frame {number} of {first} to {last}"
            scene.frame_set(number)
            depsgraph = context.evaluated_depsgraph_get()
            frames.append([displayed_surface(object_of(name, scene), depsgraph, settings) for name in names])
            _check_same_faces(frames, number)
        options, started = settings.options(), time.monotonic()
        came_to = yield from _worked(lambda tell: repair.repaired_frames(frames, options, tell))
    finally:
        scene.frame_set(shown_frame, subframe=shown_subframe)
        for own in caches:
            own.show_viewport = True
    chosen = [object_of(name, scene) for name in names]
    bad = [number for number, one in enumerate(came_to, first) if not one.is_written(settings.keep_incomplete)]
    has_moved = any(one.has_moved for one in came_to)
    lines = _frames_summary(scene, came_to, first, bad, time.monotonic() - started)
    if has_moved and not bad:
        lines += _write_frames(context, chosen, frames, came_to, paths, first)
    elif caches:
        lines.append("The modifier of an earlier run is still there. Remove it if it is no longer wanted.")
    return Said(has_moved and not bad, all(one.is_as_asked for one in came_to), lines)


def _check_frames(chosen, settings, first, last):
    if last < first:
        raise Refused(f"The last frame, {last}, comes before the first, {first}.")
    for target in chosen:
        if target.mode == "EDIT":
            raise Refused(f"'{target.name}' is in Edit Mode. Leave it to repair frames.")
        if settings.role_of(target) == "RIGID":
            raise Refused(f"'{target.name}' is rigid, which is not possible over frames. Choose Held or Free.")
        if settings.frames_result == "CACHE" and target.library:
            raise Refused(f"'{target.name}' is linked from another file and takes no modifier. Choose Shape Keys.")
    if settings.frames_result == "CACHE":
        return results.cache_paths(settings.cache_folder, chosen)
    return []


def _check_same_faces(frames, number):
    if all(len(one.corners) == 0 for one in frames[-1]):
        raise Refused(f"There is nothing to repair: no face is displayed in frame {number}.")
    for one, other in zip(frames[0], frames[-1]):
        if not (np.array_equal(one.corners, other.corners) and len(one.positions) == len(other.positions)):
            raise Refused(
                f"The faces of '{one.name}' are others in frame {number} than before. Modifiers that change them "
                "over time cannot be repaired as frames."
            )


def _write_frames(context, chosen, frames, came_to, paths, first):
    added = []
    for number, target in enumerate(chosen):
        repaired = [one.positions[number] for one in came_to]
        if not paths:
            added.append(results.add_frames_object(target, repaired, first, context.evaluated_depsgraph_get()))
            continue
        has_moved = any(not np.array_equal(own, frame[number].positions) for own, frame in zip(repaired, frames))
        if has_moved or results.own_cache(target):
            results.write_cache(paths[number], repaired, first)
            results.play_cache(target, paths[number], first)
    if not added:
        return []
    if context.mode == "OBJECT":
        results.select_alone(added, context.view_layer)
    return _notes_on_displayed_frames(frames, came_to, first, context.scene.unsnarl.options())


def _notes_on_displayed_frames(frames, came_to, first, options):
    """Blender rounds what shape keys display: are the frames in which that shows clean too?"""
    notes = []
    for number, (surfaces, one) in enumerate(zip(frames, came_to), first):
        displayed = [
            shape_keys.displayed(shape_keys.stored(own, basis, basis), basis, basis)
            for own, basis in zip(one.positions, came_to[0].positions)
        ]
        if all(np.array_equal(a, b) for a, b in zip(displayed, one.positions)):
            continue
        count = repair.pairs_left(surfaces, displayed, options)
        if count > one.after:
            notes.append(
                f"Frame {number}: {_pairs(count)} intersect as Blender rounds what shape keys display. "
                "Choose Point Cache."
            )
    return notes


def _worked(work):
    """Yields lines while the work goes on in a thread, and returns what it comes to."""
    job = Job(work)
    started = time.monotonic()
    try:
        while not job.is_done():
            yield _line(job.progress, time.monotonic() - started)
    except GeneratorExit:
        job.cancel()
        raise
    try:
        return job.result()
    except (ValueError, TypeError, TimeoutError, MemoryError) as error:
        raise Refused(_sentence(str(error) or "There is not enough memory")) from None


def _line(progress, seconds):
    if progress is None:
        return f"Looking for intersections, {seconds:.0f} s"
    phase = PHASES.get(progress.phase, progress.phase)
    return f"{phase}: {_pairs(progress.pairs_left)} left, {100 * progress.fraction:.0f} %, {seconds:.0f} s"


def _surface_of(target, as_displayed, settings=None):
    if as_displayed:
        return displayed_surface(target, bpy.context.evaluated_depsgraph_get(), settings)
    return base_surface(target, settings)


def _unchanged(scene, surfaces, as_displayed):
    """The objects of the surfaces, as they are now. Raises Refused where one has been changed since it was read."""
    chosen = [object_of(surface.name, scene) for surface in surfaces]
    for target, surface in zip(chosen, surfaces):
        if not surface.is_same(_surface_of(target, as_displayed)):
            raise Refused(f"'{surface.name}' was changed while it was repaired. Nothing was written.")
    return chosen


def _displayed_of_keys(chosen, surfaces):
    bases = [results.basis_of(target) for target in chosen]
    mixes = [surface.positions for surface in surfaces]
    return lambda kept: [shape_keys.nearest_displayed(*three) for three in zip(kept, bases, mixes)]


def _held_notes(chosen, settings):
    if settings.held != "GROUP":
        return []
    if not settings.held_group:
        raise Refused("Name the vertex group that is to be held.")
    without = [target.name for target in chosen if settings.held_group not in target.vertex_groups]
    if len(without) == len(chosen):
        raise Refused(f"No object has a vertex group '{settings.held_group}'. Choose one, or hold nothing.")
    return [f"'{name}' has no vertex group '{settings.held_group}': all its vertices were free." for name in without]


def _summary(scene, came_to, seconds, is_written, keep_incomplete):
    report = came_to.report
    moved = (
        f"moved {100 * (1 - report['untouched_share']):.3g} % of the vertices, by "
        f"{length_text(scene, report['displacement_max'] * came_to.length)} at most"
    )
    pairs = f"{came_to.before} intersecting pairs before, {came_to.after or 'none'} after"
    if came_to.before == 0 and not came_to.has_moved:
        lines = ["No self-intersections: nothing to repair."]
    else:
        lines = [f"{_status_words(scene, came_to)} {pairs}; {moved}; {seconds:.1f} s."]
    if came_to.status not in repair.CLEAN and not is_written:
        lines.append(
            "Nothing was written."
            + (
                ""
                if keep_incomplete or not came_to.has_moved
                else " Switch on Keep Incomplete Results to have the best that was reached."
            )
        )
    return lines


def _on_parts(report, surfaces):
    """What the library says of faces and parts, with the names of the objects. Faces count through all of them."""
    names = [surface.name for surface in surfaces]
    ends = np.cumsum([len(surface.offsets) - 1 for surface in surfaces])

    def part(one):
        return f"A part of '{names[int(np.searchsorted(ends, one['first_face'], side='right'))]}'"

    lines = [_sentence(one["message"]) for one in report["obstructions"][:MOST_PARTS]]
    if lines and len(names) > 1:
        lines.append(f"Faces are counted through the objects in this order: {', '.join(names)}.")
    lines += [
        _sentence(re.sub(r"^component \d+", part(one), one["message"]))
        for one in report["changed_components"][:MOST_PARTS]
    ]
    more = max(len(report["changed_components"]) - MOST_PARTS, 0) + max(len(report["obstructions"]) - MOST_PARTS, 0)
    if more:
        lines.append(f"And {more} more such parts.")
    if report["advice"]:
        lines.append(
            "Parts overlap by more than 10 % of their volume. If one has to keep its shape, make it Held or Rigid; if "
            "they are meant as one solid, unite them with a Boolean modifier."
        )
    return lines


def _sentence(text):
    return text[0].upper() + text[1:] + ("" if text.endswith(".") else ".")


STATUS = {
    "embedded": "Clean:",
    "allowed": "Clean:",
    "gap_not_met": "Clean, but the gap is smaller than asked:",
    "obstructed": "Repaired all that can be repaired:",
    "reduced": "Intersections are left:",
    "no_progress": "Nothing better was found:",
    "time_limit": "Stopped by the limit of time:",
    "memory_limit": "Stopped by the limit of memory:",
    "displacement_exceeded": "A vertex has to move farther than allowed:",
}


def _status_words(scene, came_to):
    gap = came_to.report.get("gap")
    if came_to.status == "gap_not_met" and gap:
        return f"Clean, but the smallest gap is {length_text(scene, gap['smallest'] * came_to.length)}:"
    return STATUS.get(came_to.status, f"{came_to.status}:")


def _frames_summary(scene, came_to, first, bad, seconds):
    before, after = sum(one.before for one in came_to), sum(one.after for one in came_to)
    farthest = max(one.report["displacement_max"] * one.length for one in came_to)
    clean = sum(one.status in repair.CLEAN for one in came_to)
    narrow = [number for number, one in enumerate(came_to, first) if one.status == "gap_not_met"]
    lines = [
        f"{clean} of {len(came_to)} frames are clean: {before} intersecting pairs before, {after or 'none'} after; "
        f"vertices moved by {length_text(scene, farthest)} at most; {seconds:.1f} s."
    ]
    if bad:
        lines.append(
            f"Nothing was written: intersections are left in frames {', '.join(map(str, bad[:10]))}"
            f"{' and others' if len(bad) > 10 else ''}. Keep Incomplete Results writes the best that was reached."
        )
    if narrow:
        lines.append(f"The gap is smaller than asked in {len(narrow)} frames, first in frame {narrow[0]}.")
    for number, one in enumerate(came_to, first):
        lines += [f"Frame {number}: {note}" for note in one.notes[:1]]
    return lines


def length_text(scene, length):
    """A length in units of the scene as the interface shows it."""
    units = scene.unit_settings
    if units.system == "NONE":
        return f"{length:.3g}"
    return bpy.utils.units.to_string(units.system, "LENGTH", length * units.scale_length, precision=4)


def _pairs(count):
    return f"{count} pair{'' if count == 1 else 's'}"
