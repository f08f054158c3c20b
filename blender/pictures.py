# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders the pictures of docs/blender.md, with the add-on and the pictures of the window that blender/test has left
in out/blender:

  UNSNARL_PROGRAM=build/release/unsnarl blender -b --factory-startup --python blender/pictures.py
"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import bpy
import numpy as np
from mathutils import Vector

PROJECT = Path(__file__).resolve().parents[1]
BUILT, IMAGES = PROJECT / "out" / "blender", PROJECT / "docs" / "images"
(ADDON,) = BUILT.glob("unsnarl-addon-*-linux-x64.zip")
SIZE = (600, 520)


def material(name, colour, attribute=None):
    """A matt material, in a colour or where the attribute is red in red."""
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    shader = made.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*colour, 1)
    shader.inputs["Roughness"].default_value = 0.7
    if attribute:
        nodes, links = made.node_tree.nodes, made.node_tree.links
        painted = nodes.new("ShaderNodeVertexColor")
        painted.layer_name = attribute
        split = nodes.new("ShaderNodeSeparateColor")
        is_red = nodes.new("ShaderNodeMath")
        is_red.operation, is_red.inputs[1].default_value = "LESS_THAN", 0.3
        mix = nodes.new("ShaderNodeMixRGB")
        mix.inputs["Color1"].default_value, mix.inputs["Color2"].default_value = (*colour, 1), (0.8, 0.01, 0.01, 1)
        links.new(painted.outputs["Color"], split.inputs["Color"])
        links.new(split.outputs["Green"], is_red.inputs[0])
        links.new(is_red.outputs[0], mix.inputs["Fac"])
        links.new(mix.outputs["Color"], shader.inputs["Base Color"])
    return made


def light_and_camera(objects):
    corners = [one.matrix_world @ Vector(corner) for one in objects for corner in one.bound_box]
    low, high = (Vector(bound(c[k] for c in corners) for k in range(3)) for bound in (min, max))
    height = high.z - low.z
    centre = (low + high) / 2 + Vector((0, 0, 0.13 * height))  # the tunic rather than the feet
    scene = bpy.context.scene
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.lens = 105
    camera.location = centre + Vector((0.9, -2.0, 0.35)) * height * 1.25
    camera.rotation_euler = (centre - camera.location).to_track_quat("-Z", "Y").to_euler()
    for name, place, energy, size in (
        ("key", (-1.5, -2, 2), 34, 1.5),
        ("rim", (2, 1, 1.5), 25, 1),
        ("fill", (2, -2, 0), 6, 2),
    ):
        light = bpy.data.objects.new(name, bpy.data.lights.new(name, "AREA"))
        light.data.energy, light.data.size = energy * height**2, size * height
        light.location = centre + Vector(place) * height
        light.rotation_euler = (centre - light.location).to_track_quat("-Z", "Y").to_euler()
        scene.collection.objects.link(light)
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.world = bpy.data.worlds.new("world")
    scene.world.color = (0.2, 0.21, 0.22)
    scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 96, False
    scene.render.resolution_x, scene.render.resolution_y = SIZE
    scene.view_settings.view_transform = "Standard"


def rendered():
    with tempfile.TemporaryDirectory() as folder:
        bpy.context.scene.render.filepath = f"{folder}/picture.png"
        bpy.ops.render.render(write_still=True)
        return pixels(f"{folder}/picture.png")


def pixels(path):
    """(height, width, 4), the lowest row first."""
    image = bpy.data.images.load(str(path))
    values = np.empty(len(image.pixels), np.float32)
    image.pixels.foreach_get(values)
    return values.reshape(image.size[1], image.size[0], 4)


def save(values, name):
    image = bpy.data.images.new(name, values.shape[1], values.shape[0])
    image.pixels.foreach_set(np.ascontiguousarray(values).ravel())
    image.filepath_raw, image.file_format = str(IMAGES / f"{name}.png"), "PNG"
    image.save()


def select_meshes():
    meshes = [one for one in bpy.context.scene.objects if one.type == "MESH"]
    for one in bpy.context.scene.objects:
        one.select_set(one in meshes)
    bpy.context.view_layer.objects.active = meshes[0]
    return meshes


def cloth():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.preferences.addon_enable(module="unsnarl_blender")
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(
            [
                os.environ["UNSNARL_PROGRAM"],
                "sample",
                "dressed_figure",
                "--resolution",
                "90",
                "-o",
                f"{folder}/figure.obj",
            ],
            check=True,
        )
        bpy.ops.wm.obj_import(filepath=f"{folder}/figure.obj")
    meshes = select_meshes()
    light_and_camera(meshes)
    settings = bpy.context.scene.unsnarl
    settings.scope, settings.gap = "SELECTED", 0.002
    for one, colour in zip(meshes, ((0.42, 0.27, 0.2), (0.16, 0.32, 0.5))):
        one.data.materials.clear()
        one.data.materials.append(material(one.name, colour, "self-intersections"))
        one.unsnarl.role = "HELD" if one.name == "body" else "FREE"
    bpy.ops.unsnarl.find()
    before = rendered()
    bpy.ops.unsnarl.repair()
    bpy.ops.unsnarl.find()
    after = rendered()
    print([line.name for line in bpy.context.window_manager.unsnarl.outcome])
    save(np.concatenate([before, after], axis=1), "blender_cloth")


def panel():
    window = pixels(BUILT / "scene.png")
    save(window[90:920, 250:1150], "blender_panel")


bpy.ops.preferences.addon_install(filepath=str(ADDON), overwrite=True)
cloth()
panel()
sys.stdout.flush()
