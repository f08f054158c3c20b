# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators: they run what runs.py does, and say what came of it."""

import time

import bpy

from . import marks, runs
from .surfaces import Refused, targets

#: Seconds between two looks at what goes on.
INTERVAL_S = 0.1


def say(operator, context, said, place):
    """Reports what came of a run, and keeps it for the panel."""
    lines = getattr(context.window_manager.unsnarl, place)
    lines.clear()
    for line in said.lines:
        lines.add().name = line
    operator.report({"INFO" if said.is_clean else "WARNING"}, " ".join(said.lines))
    redraw(context)


def redraw(context):
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()


class UNSNARL_OT_find(bpy.types.Operator):
    """Select and paint the faces that intersect, and count them by pairs of objects"""

    bl_idname = "unsnarl.find"
    bl_label = "Find Self-Intersections"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return may_run(cls, context)

    def execute(self, context):
        try:
            said, found = runs.find(context)
        except (Refused, ValueError, MemoryError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        findings = context.window_manager.unsnarl.findings
        say(self, context, said, "findings")
        for line in found:
            findings.add().name = line
        return {"FINISHED"} if said.written else {"CANCELLED"}


class UNSNARL_OT_clear(bpy.types.Operator):
    """Remove the colour attribute that Find Self-Intersections has added"""

    bl_idname = "unsnarl.clear"
    bl_label = "Clear Intersection Colours"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return may_run(cls, context)

    def execute(self, context):
        try:
            chosen = targets(context, context.scene.unsnarl.scope)
        except Refused as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        context.window_manager.unsnarl.findings.clear()
        removed = [marks.clear(target) for target in chosen if not target.data.library]
        return {"FINISHED"} if any(removed) else {"CANCELLED"}


class InSteps:
    """An operator that goes on while the window is in use: Esc ends it, and leaves nothing behind."""

    bl_options = {"REGISTER", "UNDO"}
    running = False  # of all operators of this kind together

    @classmethod
    def poll(cls, context):
        if InSteps.running:
            cls.poll_message_set("A repair is running; Esc ends it")
            return False
        return may_run(cls, context)

    def execute(self, context):
        steps = self.steps(context)
        try:
            while True:
                next(steps)
                time.sleep(INTERVAL_S / 10)
        except StopIteration as end:
            return self.ended(context, end.value)
        except Refused as error:
            return self.refused(context, error)

    def invoke(self, context, event):
        if bpy.app.background:
            return self.execute(context)
        self._steps = self.steps(context)
        self._timer = context.window_manager.event_timer_add(INTERVAL_S, window=context.window)
        InSteps.running = True
        context.window_manager.modal_handler_add(self)
        self.show(context, "Reading")
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC" and event.value == "PRESS":
            self.cancel(context)
            self.report({"INFO"}, "Cancelled. Nothing was changed.")
            return {"CANCELLED"}
        if event.type == "TIMER":
            return self.step(context)
        # The view may be turned meanwhile; nothing else may happen to what is read or written.
        is_view = event.type in {
            "MIDDLEMOUSE",
            "WHEELUPMOUSE",
            "WHEELDOWNMOUSE",
            "TRACKPADPAN",
            "TRACKPADZOOM",
            "MOUSEMOVE",
            "INBETWEEN_MOUSEMOVE",
        } or event.type.startswith("NDOF")
        return {"PASS_THROUGH"} if is_view else {"RUNNING_MODAL"}

    def step(self, context):
        try:
            self.show(context, next(self._steps))
            return {"RUNNING_MODAL"}
        except StopIteration as end:
            self.cleared(context)
            return self.ended(context, end.value)
        except Refused as error:
            self.cleared(context)
            return self.refused(context, error)
        except BaseException:
            self.cleared(context)
            raise

    def cancel(self, context):
        self._steps.close()
        self.cleared(context)

    def cleared(self, context):
        InSteps.running = False
        context.window_manager.event_timer_remove(self._timer)
        context.workspace.status_text_set(None)
        context.window_manager.unsnarl.progress = ""
        redraw(context)

    def show(self, context, line):
        context.window_manager.unsnarl.progress = line
        context.workspace.status_text_set(f"{line}   (Esc: cancel)")
        redraw(context)

    def ended(self, context, said):
        say(self, context, said, "outcome")
        return {"FINISHED"} if said.written else {"CANCELLED"}

    def refused(self, context, error):
        context.window_manager.unsnarl.outcome.clear()
        self.report({"ERROR"}, str(error))
        return {"CANCELLED"}


class UNSNARL_OT_repair(InSteps, bpy.types.Operator):
    """Move vertices as little as possible, so that no two faces intersect. Everything but positions stays"""

    bl_idname = "unsnarl.repair"
    bl_label = "Repair Self-Intersections"

    def steps(self, context):
        return runs.repair_objects(context)


class UNSNARL_OT_repair_frames(InSteps, bpy.types.Operator):
    """Repair a range of frames as displayed, so that corrections go on smoothly in time"""

    bl_idname = "unsnarl.repair_frames"
    bl_label = "Repair Frames"

    def steps(self, context):
        return runs.repair_frames(context)


def may_run(operator, context):
    if context.mode not in {"OBJECT", "EDIT_MESH"}:
        operator.poll_message_set("Switch to Object or Edit Mode")
        return False
    active = context.active_object
    if not context.selected_objects and (active is None or active.type != "MESH"):
        operator.poll_message_set("Select a mesh")
        return False
    return True


CLASSES = [UNSNARL_OT_find, UNSNARL_OT_clear, UNSNARL_OT_repair, UNSNARL_OT_repair_frames]


def register():
    for one in CLASSES:
        bpy.utils.register_class(one)


def unregister():
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)
