# SPDX-License-Identifier: GPL-3.0-or-later
"""The interface itself: the modal operator in a window, Esc, undo, and the panel. Run in a Blender with a window:

  xvfb-run blender --factory-startup --enable-event-simulate --python blender/tests/interface.py -- ADDON_ZIP FOLDER

FOLDER gets pictures of the window to look at.
"""

import os
import sys
import traceback
from pathlib import Path

import bpy

HERE = Path(__file__).resolve().parent
addon, folder = sys.argv[sys.argv.index("--") + 1 :]
INTERVAL_S = 0.1


def view():
    """Where operators of the 3D View run."""
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    region = next(region for region in area.regions if region.type == "WINDOW")
    return {"window": window, "area": area, "region": region}


def in_view(operator, *arguments):
    with bpy.context.temp_override(**view()):
        return operator(*arguments)


def picture(name):
    bpy.ops.wm.redraw_timer(type="DRAW_WIN_SWAP", iterations=1)
    in_view(lambda: bpy.ops.screen.screenshot(filepath=f"{folder}/{name}.png"))


def session():
    return bpy.context.window_manager.unsnarl


def check(holds, what):
    print("ok  " if holds else "FAIL", what, flush=True)
    if not holds:
        raise AssertionError(what)


def press(kind, x=0, y=0):
    window = view()["window"]
    for value in ("PRESS", "RELEASE"):
        window.event_simulate(type=kind, value=value, x=x, y=y)


def open_panel():
    """Shows the sidebar at the tab of the add-on, as a click on it does."""
    area = view()["area"]
    area.spaces.active.show_region_ui = True
    yield
    sidebar = next(region for region in area.regions if region.type == "UI")
    window = view()["window"]
    for below in range(40, 400, 20):  # tabs are below each other; no call of this version chooses one
        x, y = sidebar.x + sidebar.width - 8, sidebar.y + sidebar.height - below
        window.event_simulate(type="MOUSEMOVE", value="NOTHING", x=x, y=y)
        yield
        press("LEFTMOUSE", x, y)
        yield
        yield
        if PANEL_DRAWN:
            return
    raise AssertionError("the tab of the add-on was not found")


PANEL_DRAWN = []


def test():
    import scenes
    from unsnarl_blender import operators, panel

    own = panel.gap_hints
    for one in list(bpy.data.objects):
        bpy.data.objects.remove(one)
    one = scenes.tubes(resolution=150)
    start = scenes.positions(one).tobytes()
    in_view(bpy.ops.ed.undo_push)
    in_view(bpy.ops.view3d.view_selected)

    def watched(context):
        PANEL_DRAWN.append(True)
        return own(context)

    panel.gap_hints = watched
    yield
    yield from open_panel()
    in_view(bpy.ops.unsnarl.find, "INVOKE_DEFAULT")
    space = view()["area"].spaces.active
    space.shading.color_type = "VERTEX"
    yield
    picture("found")
    in_view(bpy.ops.ed.undo_push)

    found = scenes.hashes(bpy.data.objects["tubes"])
    check(
        in_view(bpy.ops.unsnarl.repair, "INVOKE_DEFAULT") == {"RUNNING_MODAL"},
        "repair goes on while the window is in use",
    )
    lines = set()
    for _ in range(12):
        yield
        lines.add(session().progress)
    check(len(lines) > 2 and any("pairs left" in line for line in lines), f"the line is live: {sorted(lines)[:3]}")
    picture("working")
    check(not bpy.ops.unsnarl.repair.poll(), "a second repair is not possible meanwhile")
    press("ESC")
    for _ in range(5):
        yield
    check(not operators.InSteps.running and session().progress == "", "Esc ends it")
    one = bpy.data.objects["tubes"]
    check(scenes.positions(one).tobytes() == start and scenes.hashes(one) == found, "Esc leaves nothing behind")

    in_view(bpy.ops.unsnarl.repair, "INVOKE_DEFAULT")
    while operators.InSteps.running:
        yield
    one = bpy.data.objects["tubes"]
    check(scenes.pairs(one) == 0 and scenes.positions(one).tobytes() != start, f"it ends: {scenes.outcome()}")
    repaired = scenes.positions(one).tobytes()
    yield
    picture("repaired")
    in_view(bpy.ops.ed.undo)
    one = bpy.data.objects["tubes"]
    check(scenes.positions(one).tobytes() == start and scenes.hashes(one) == found, "one undo restores")
    in_view(bpy.ops.ed.redo)
    check(scenes.positions(bpy.data.objects["tubes"]).tobytes() == repaired, "redo repeats it")
    in_view(bpy.ops.ed.undo)

    in_view(bpy.ops.object.mode_set, "EXEC_DEFAULT", True)
    with bpy.context.temp_override(**view()):
        bpy.ops.object.mode_set("EXEC_DEFAULT", True, mode="EDIT")
        bpy.ops.unsnarl.repair("INVOKE_DEFAULT")
    while operators.InSteps.running:
        yield
    one = bpy.data.objects["tubes"]
    check(one.mode == "EDIT", "Edit Mode is kept")
    one.update_from_editmode()
    check(scenes.positions(one).tobytes() == repaired, "with the same result")
    yield
    picture("edit_mode")
    in_view(bpy.ops.ed.undo)
    one = bpy.data.objects["tubes"]
    one.update_from_editmode()
    check(one.mode == "EDIT" and scenes.positions(one).tobytes() == start, "and one undo restores there too")
    in_view(lambda: bpy.ops.wm.call_menu(name="VIEW3D_MT_edit_mesh_context_menu"))
    yield
    picture("menu")
    press("ESC")
    yield
    with bpy.context.temp_override(**view()):
        bpy.ops.object.mode_set(mode="OBJECT")
    bpy.data.objects.remove(bpy.data.objects["tubes"])
    cloth, body = scenes.ball("cloth", (0, 0, 0), rings=40), scenes.ball("body", (1.9, 0.1, 0.2), rings=40)
    scenes.settings().gap = 0.04
    cloth.modifiers.new("cloth", "CLOTH")
    body.modifiers.new("collision", "COLLISION")
    scenes.select(cloth, body)
    body.unsnarl.role = "HELD"
    scenes.settings().scope = "SELECTED"
    in_view(bpy.ops.unsnarl.find, "INVOKE_DEFAULT")
    in_view(bpy.ops.view3d.view_all)
    in_view(bpy.ops.unsnarl.repair)
    yield
    picture("scene")

    bpy.context.scene.unsnarl.own_range, bpy.context.scene.unsnarl.cache_folder = True, folder
    bpy.context.scene.unsnarl.gap = 0
    for frame, x in ((1, 0.1), (24, 0.15)):
        body = bpy.data.objects["body"]
        body.location.x = -x
        body.keyframe_insert("location", frame=frame)
    bpy.context.scene.frame_set(7)
    in_view(bpy.ops.ed.undo_push)
    count = len(list(Path(folder).glob("*.pc2")))
    in_view(bpy.ops.unsnarl.repair_frames, "INVOKE_DEFAULT")
    for _ in range(5):
        yield
    check(session().progress.startswith("Reading frame"), f"frames are read one by one: {session().progress}")
    press("ESC")
    for _ in range(3):
        yield
    check(
        not operators.InSteps.running and bpy.context.scene.frame_current == 7,
        "Esc goes back to the frame that was shown",
    )
    check(len(list(Path(folder).glob("*.pc2"))) == count, "and leaves no cache")
    in_view(bpy.ops.unsnarl.repair_frames, "INVOKE_DEFAULT")
    while operators.InSteps.running:
        yield
    check("24 of 24 frames are clean" in scenes.outcome()[0], f"frames end: {scenes.outcome()[0]}")
    check(
        "unsnarl" in bpy.data.objects["cloth"].modifiers and bpy.context.scene.frame_current == 7,
        "a modifier plays them",
    )
    in_view(bpy.ops.ed.undo)
    check("unsnarl" not in bpy.data.objects["cloth"].modifiers, "one undo takes it away")


def stepwise(steps):
    def tick():
        try:
            next(steps)
            return INTERVAL_S
        except StopIteration:
            code = 0
        except BaseException:
            traceback.print_exc()
            code = 1
        sys.stdout.flush()
        os._exit(code)

    return tick


bpy.ops.preferences.addon_install(filepath=addon, overwrite=True)
bpy.ops.preferences.addon_enable(module="unsnarl_blender")
bpy.context.preferences.view.show_splash = False
sys.path.insert(0, str(HERE))
bpy.app.timers.register(stepwise(test()), first_interval=1)
