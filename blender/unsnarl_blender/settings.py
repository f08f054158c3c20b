# SPDX-License-Identifier: GPL-3.0-or-later
"""What the user chooses. Kept with the scene, the role of an object with the object, findings with the session."""

import bpy
from bpy.props import (
    BoolProperty,
    CollectionProperty,
    EnumProperty,
    FloatProperty,
    IntProperty,
    PointerProperty,
    StringProperty,
)

from .repair import Options


class UnsnarlSettings(bpy.types.PropertyGroup):
    scope: EnumProperty(
        name="Repair",
        items=[
            ("ACTIVE", "Active", "The active object alone"),
            ("SELECTED", "Selected", "All selected meshes as one scene: they are separated from each other too"),
        ],
    )
    as_displayed: BoolProperty(
        name="As Displayed",
        description=(
            "Take the meshes with their modifiers and pose, as the viewport shows them. The result is a new object. "
            "Off: the meshes before their modifiers"
        ),
    )
    held: EnumProperty(
        name="Hold",
        description="Vertices that must not move",
        items=[
            ("NONE", "Nothing", "All vertices may move"),
            ("GROUP", "Vertex Group", "Vertices of a vertex group stay where they are (weight 0.5 or more)"),
            ("SELECTED", "Selected Vertices", "Vertices that are selected in Edit Mode stay where they are"),
            ("UNSELECTED", "Unselected Vertices", "Only vertices that are selected in Edit Mode may move"),
        ],
    )
    held_group: StringProperty(name="Group", description="Vertex group that is held, in every object that has it")
    result: EnumProperty(
        name="Result",
        items=[
            ("IN_PLACE", "In Place", "Move the vertices of the mesh"),
            ("SHAPE_KEY", "Shape Key", "Add a shape key at value 1, whose shape is the repaired one"),
            ("NEW_OBJECT", "New Object", "Add a copy of each object with the repaired mesh"),
        ],
    )
    gap: FloatProperty(
        name="Gap",
        description=(
            "Distance to keep between surfaces. Use the contact offset of your solver and a little more; "
            "0: only as much as is safe"
        ),
        min=0,
        soft_max=1,
        precision=4,
        step=0.1,
        subtype="DISTANCE",
        unit="LENGTH",
    )
    gap_near_conflicts: BoolProperty(
        name="Only near Intersections", description="Open the gap only around what intersects"
    )
    max_displacement: FloatProperty(
        name="Largest Move",
        description="No vertex may move farther; 0: any distance",
        min=0,
        soft_max=10,
        precision=4,
        step=1,
        subtype="DISTANCE",
        unit="LENGTH",
    )
    time_limit: FloatProperty(
        name="Time", description="Seconds after which to stop; 0: no limit", min=0, soft_max=3600
    )
    memory_limit: IntProperty(
        name="Memory", description="MB that Blender may hold while it repairs; 0: no limit", min=0
    )
    keep_incomplete: BoolProperty(
        name="Keep Incomplete Results",
        description=(
            "Write the best result that was reached also where intersections are left. Off: leave the meshes as"
            " they are"
        ),
    )
    both_diagonals: BoolProperty(
        name="Any Cut of Quads",
        description="Make the result hold whichever way other programs, or Blender's Triangulate, split quads",
    )
    select: BoolProperty(name="Select", description="Select the faces that intersect", default=True)
    colour: BoolProperty(
        name="Colour",
        description="Paint the faces that intersect red, in a colour attribute of their own",
        default=True,
    )
    frames_result: EnumProperty(
        name="Result",
        items=[
            ("CACHE", "Point Cache", "Write a PC2 file, which a Mesh Cache modifier at the end of the stack plays"),
            ("SHAPE_KEYS", "Shape Keys", "Add a new object with one shape key a frame"),
        ],
    )
    own_range: BoolProperty(name="Other Range", description="Other frames than those of the scene")
    frame_start: IntProperty(name="First Frame", default=1)
    frame_end: IntProperty(name="Last Frame", default=24)
    cache_folder: StringProperty(
        name="Folder",
        description="Where point caches are written; // is the folder of the .blend file",
        default="//unsnarl_cache",
        subtype="DIR_PATH",
    )

    def frames(self):
        """The first and the last frame that are meant."""
        scene = self.id_data
        return (self.frame_start, self.frame_end) if self.own_range else (scene.frame_start, scene.frame_end)

    def role_of(self, target):
        """What an object may do in a scene of several; alone it is free."""
        return target.unsnarl.role if self.scope == "SELECTED" else "FREE"

    def options(self):
        return Options(
            self.gap,
            self.gap_near_conflicts,
            self.max_displacement,
            self.time_limit,
            self.memory_limit,
            self.both_diagonals,
        )


class UnsnarlObject(bpy.types.PropertyGroup):
    role: EnumProperty(
        name="Role",
        items=[
            ("FREE", "Free", "Its vertices may move"),
            ("HELD", "Held", "It stays as it is"),
            ("RIGID", "Rigid", "It is turned and shifted, never deformed (not in a range of frames)"),
        ],
    )


class UnsnarlLine(bpy.types.PropertyGroup):
    """A sentence, as its name."""


class UnsnarlSession(bpy.types.PropertyGroup):
    """What the panel says. Not saved, and no part of undo."""

    findings: CollectionProperty(type=UnsnarlLine)
    outcome: CollectionProperty(type=UnsnarlLine)
    progress: StringProperty()


CLASSES = [UnsnarlSettings, UnsnarlObject, UnsnarlLine, UnsnarlSession]


def register():
    for one in CLASSES:
        bpy.utils.register_class(one)
    bpy.types.Scene.unsnarl = PointerProperty(type=UnsnarlSettings)
    bpy.types.Object.unsnarl = PointerProperty(type=UnsnarlObject)
    bpy.types.WindowManager.unsnarl = PointerProperty(type=UnsnarlSession)


def unregister():
    del bpy.types.WindowManager.unsnarl, bpy.types.Object.unsnarl, bpy.types.Scene.unsnarl
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)
