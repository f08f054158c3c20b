# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel in the sidebar of the 3D View, and the entries of its menus."""

import bpy

from .runs import length_text

#: Width of a letter on average, and of what stands beside a text in a panel (units: pixels, at a scale of 1).
LETTER, BESIDE = 6.6, 50


class UNSNARL_PT_main(bpy.types.Panel):
    bl_label = "Self-Intersections"
    bl_idname = "UNSNARL_PT_main"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Unsnarl"

    def draw(self, context):
        layout, settings, session = self.layout, context.scene.unsnarl, context.window_manager.unsnarl
        layout.use_property_split, layout.use_property_decorate = True, False
        row = layout.row()
        row.use_property_split = False
        row.prop(settings, "scope", expand=True)
        if settings.scope == "SELECTED":
            draw_roles(layout, context)
        layout.prop(settings, "as_displayed")

        layout.separator()
        row = layout.row(align=True)
        row.operator("unsnarl.find", icon="VIEWZOOM")
        row.operator("unsnarl.clear", text="", icon="X")
        column = layout.column(heading="Faces", align=True)
        column.prop(settings, "select")
        column.prop(settings, "colour")
        draw_lines(layout, context, session.findings)

        layout.separator()
        layout.prop(settings, "held")
        if settings.held == "GROUP":
            active = context.active_object
            if active is not None and active.type == "MESH":
                layout.prop_search(settings, "held_group", active, "vertex_groups")
            else:
                layout.prop(settings, "held_group")
        layout.prop(settings, "gap")
        for hint in gap_hints(context):
            draw_text(layout, context, hint, "INFO")
        layout.prop(settings, "result")
        layout.operator("unsnarl.repair", icon="MOD_SMOOTH")
        if session.progress:
            draw_text(layout, context, session.progress, "TIME")
            layout.label(text="Esc cancels")
        draw_lines(layout, context, session.outcome)


class UNSNARL_PT_limits(bpy.types.Panel):
    bl_label = "Limits and Details"
    bl_parent_id = "UNSNARL_PT_main"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout, settings = self.layout, context.scene.unsnarl
        layout.use_property_split, layout.use_property_decorate = True, False
        for name in (
            "max_displacement",
            "time_limit",
            "memory_limit",
            "keep_incomplete",
            "gap_near_conflicts",
            "both_diagonals",
        ):
            layout.prop(settings, name)


class UNSNARL_PT_frames(bpy.types.Panel):
    bl_label = "Frames"
    bl_parent_id = "UNSNARL_PT_main"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout, settings = self.layout, context.scene.unsnarl
        layout.use_property_split, layout.use_property_decorate = True, False
        column = layout.column(align=True)
        column.prop(settings, "own_range")
        if settings.own_range:
            column.prop(settings, "frame_start")
            column.prop(settings, "frame_end")
        layout.prop(settings, "frames_result")
        if settings.frames_result == "CACHE":
            layout.prop(settings, "cache_folder")
        layout.operator("unsnarl.repair_frames", icon="RENDER_ANIMATION")


def draw_roles(layout, context):
    column = layout.column(align=True)
    for one in context.selected_objects:
        if one.type == "MESH":
            column.prop(one.unsnarl, "role", text=one.name)


def draw_lines(layout, context, lines):
    for line in lines:
        draw_text(layout, context, line.name, "DOT")


def draw_text(layout, context, text, icon):
    """A text over as many lines as it needs."""
    scale = context.preferences.system.ui_scale
    most = max(12, int((context.region.width - BESIDE * scale) / (LETTER * scale)))
    column = layout.column(align=True)
    column.scale_y = 0.75
    line = ""
    for word in text.split():
        if line and len(line) + len(word) >= most:
            column.label(text=line, icon=icon)
            line, icon = "", "BLANK1"
        line = f"{line} {word}" if line else word
    column.label(text=line, icon=icon)


def gap_hints(context):
    """What the physics of the chosen objects keep apart, which a gap has to be larger than."""
    scene = context.scene
    chosen = context.selected_objects if scene.unsnarl.scope == "SELECTED" else [context.active_object]
    modifiers = [(one, modifier) for one in chosen if one is not None for modifier in one.modifiers]
    hints = []
    for one, modifier in modifiers:
        if modifier.type == "CLOTH":
            kept = modifier.collision_settings
            hints.append(
                f"Cloth of {one.name} keeps {length_text(scene, kept.distance_min)} to others"
                + (f", {length_text(scene, kept.self_distance_min)} to itself" if kept.use_self_collision else "")
            )
        elif modifier.type == "COLLISION" and one.collision is not None:
            hints.append(f"Collision of {one.name} adds {length_text(scene, one.collision.thickness_outer)}")
    return hints


def draw_menu(self, context):
    self.layout.separator()
    self.layout.operator("unsnarl.find")
    self.layout.operator("unsnarl.repair")


CLASSES = [UNSNARL_PT_main, UNSNARL_PT_limits, UNSNARL_PT_frames]
#: Context menus, and those of the header, which search finds operators by.
MENUS = [
    "VIEW3D_MT_object_context_menu",
    "VIEW3D_MT_edit_mesh_context_menu",
    "VIEW3D_MT_object",
    "VIEW3D_MT_edit_mesh_clean",
]


def register():
    for one in CLASSES:
        bpy.utils.register_class(one)
    for name in MENUS:
        getattr(bpy.types, name).append(draw_menu)


def unregister():
    for name in MENUS:
        getattr(bpy.types, name).remove(draw_menu)
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)
