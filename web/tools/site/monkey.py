"""The monkey of the docs: furred and rendered in Blender, then baked by the extension.

    BLENDER-PYTHON monkey.py FURBAKE FOLDER

Writes FOLDER/monkey, a baked folder, and FOLDER/monkey.png, what Cycles sees of the same hairs. Run by `npm run pictures
-- --blender`.
"""

from __future__ import annotations

import importlib
import math
import os
import sys
import types
from pathlib import Path

import bpy

ROOT = Path(__file__).resolve().parents[3]
SIDE, SAMPLES = 560, 16
"""Pixels of the picture's sides, and paths for each, smoothed."""

BROWN, DARK = (0.30, 0.16, 0.07, 1.0), (0.05, 0.03, 0.02, 1.0)
FUR_LENGTH = 0.16


def extension() -> types.ModuleType:
    """The extension from its sources, registered."""
    package = types.ModuleType("furbake_extension")
    package.__path__ = [str(ROOT / "baker" / "blender")]
    sys.modules[package.__name__] = package
    settings, bake = (importlib.import_module(f"furbake_extension.{name}") for name in ("settings", "bake"))
    bpy.utils.register_class(settings.FurSettings)
    bpy.utils.register_class(bake.FURBAKE_OT_bake)
    bpy.types.Object.furbake = bpy.props.PointerProperty(type=settings.FurSettings)
    return bake


def choose(thing: bpy.types.Object) -> None:
    """Select one object."""
    for each in bpy.context.selected_objects:
        each.select_set(False)
    thing.select_set(True)
    bpy.context.view_layer.objects.active = thing


def material(name: str, kind: str, colour: tuple[float, ...]) -> bpy.types.Material:
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    nodes, links = made.node_tree.nodes, made.node_tree.links
    nodes.clear()
    shader, end = nodes.new(kind), nodes.new("ShaderNodeOutputMaterial")
    shader.inputs["Color" if "Color" in shader.inputs else "Base Color"].default_value = colour
    if kind == "ShaderNodeBsdfHairPrincipled":
        shader.parametrization = "COLOR"
    links.new(shader.outputs[0], end.inputs["Surface"])
    return made


def nodding(thing: bpy.types.Object, neck: float, nod: tuple[float, float, float]) -> None:
    """Give a monkey two bones and the clip “nod”, which turns the head until frame 12 and back until 24.

    neck : height of the joint above the lower bone's end; nod : angles of the head in frame 12, radians
    """
    bpy.ops.object.armature_add(enter_editmode=True, location=(0, 0, -1))
    rig = bpy.context.object
    root = rig.data.edit_bones[0]
    root.name, root.head, root.tail = "root", (0, 0, 0), (0, 0, neck)
    head = rig.data.edit_bones.new("head")
    head.head, head.tail, head.parent = (0, 0, neck), (0, 0, 2), root
    bpy.ops.object.mode_set(mode="OBJECT")
    choose(thing)
    rig.select_set(True)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.parent_set(type="ARMATURE_AUTO")
    rig.animation_data_create().action = bpy.data.actions.new("nod")
    bone = rig.pose.bones["head"]
    bone.rotation_mode = "XYZ"
    for frame, angles in ((1, (0, 0, 0)), (12, nod), (24, (0, 0, 0))):
        bone.rotation_euler = angles
        bone.keyframe_insert("rotation_euler", frame=frame)
    choose(thing)


def monkey() -> bpy.types.Object:
    """A smooth monkey with two bones that nods, bald around eyes and mouth, with Blender's quick fur."""
    bpy.ops.mesh.primitive_monkey_add()
    thing = bpy.context.object
    bpy.ops.object.modifier_add(type="SUBSURF")
    thing.modifiers[0].levels = 1
    bpy.ops.object.modifier_apply(modifier=thing.modifiers[0].name)
    bpy.ops.object.shade_smooth()
    thing.data.materials.append(material("skin", "ShaderNodeBsdfPrincipled", DARK))
    group = thing.vertex_groups.new(name="fur")
    for vertex in thing.data.vertices:
        x, y, z = vertex.co
        face = math.hypot(x / 0.52, (z - 0.05) / 0.62) if y < -0.35 else 2.0
        group.add([vertex.index], min(max((face - 0.75) / 0.5, 0.12), 1.0), "REPLACE")
    nodding(thing, 0.6, (0.5, 0.2, 0))
    bpy.context.scene.frame_set(1)
    bpy.ops.object.quick_fur(density="MEDIUM", length=FUR_LENGTH, radius=0.004, use_noise=True, use_frizz=True)
    for each in bpy.data.objects:
        if each.type == "CURVES":
            each.data.materials.clear()
            each.data.materials.append(material("hair", "ShaderNodeBsdfHairPrincipled", BROWN))
    choose(thing)
    return thing


def render(path: Path) -> None:
    """Render from the page's side by Cycles, under one lamp and a faint sky."""
    bpy.ops.preferences.addon_enable(module="cycles")
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising = SAMPLES, True
    scene.render.threads_mode, scene.render.threads = "FIXED", 2
    scene.render.resolution_x = scene.render.resolution_y = SIDE
    scene.render.image_settings.file_format = "PNG"
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.angle = math.radians(30)
    camera.location, camera.rotation_euler = (2.4, -5.2, 1.1), (math.radians(80), 0, math.radians(24.8))
    lamp = bpy.data.objects.new("lamp", bpy.data.lights.new("lamp", "SUN"))
    lamp.data.energy, lamp.data.angle = 5.0, 0.05
    lamp.rotation_euler = (math.radians(40), math.radians(-35), 0)
    world = bpy.data.worlds.new("world")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.35, 0.4, 0.45, 1)
    world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.5
    scene.collection.objects.link(camera)
    scene.collection.objects.link(lamp)
    scene.camera, scene.world = camera, world
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)


def main(furbake: str, folder: str) -> None:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bake = extension()
    bake.preferred_command = lambda _context: furbake
    thing = monkey()
    thing.furbake.folder, thing.furbake.preset = str(Path(folder, "monkey")), "wolf"
    thing.furbake.length_group = "fur"
    bpy.ops.furbake.bake()
    render(Path(folder, "monkey.png"))


if __name__ == "__main__":
    main(*sys.argv[1:])
    sys.stdout.flush()
    # Once Cycles has rendered, Blender's threads may wait for each other where Python ends.
    os._exit(0)
