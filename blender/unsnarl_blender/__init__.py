# SPDX-License-Identifier: GPL-3.0-or-later
"""Repair of self-intersecting meshes in Blender: a shell around the Python package unsnarl."""

# For Blender 3.x; from 4.2 on Blender reads blender_manifest.toml. blender/build writes the version.
bl_info = {
    "name": "unsnarl",
    "description": "Find and repair self-intersections, moving vertices only",
    "version": (0, 0, 0),
    "blender": (3, 3, 0),
    "location": "3D View > Sidebar > Unsnarl; Object and Mesh > Clean Up menus",
    "category": "Mesh",
}

from . import operators, panel, settings

PARTS = (settings, operators, panel)


def register():
    for part in PARTS:
        part.register()


def unregister():
    for part in reversed(PARTS):
        part.unregister()
