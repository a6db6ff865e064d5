"""Runs in Blender's Python, which needs no furbake: pictures of hairs on a body by Cycles.

PYTHON render.py in a folder with `job.npz`; writes `NUMBER-HALF.npy`, (height, width, 4) rows from below.
"""

from __future__ import annotations

import importlib
from pathlib import Path
from typing import Any

import numpy as np

BOUNCES = 32
"""Reflections of a path at most."""


def material(bpy: Any, name: str, albedo: float) -> Any:
    """A diffuse material of one grey."""
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    diffuse, out = tree.nodes.new("ShaderNodeBsdfDiffuse"), tree.nodes.new("ShaderNodeOutputMaterial")
    diffuse.inputs["Color"].default_value = (albedo, albedo, albedo, 1.0)
    tree.links.new(diffuse.outputs["BSDF"], out.inputs["Surface"])
    return made


def shapes(bpy: Any, job: Any) -> None:
    """The skin and the hairs on it."""
    skin = bpy.data.meshes.new("skin")
    skin.from_pydata(job["vertices"].tolist(), [], job["faces"].tolist())
    skin.materials.append(material(bpy, "skin", float(job["skin"])))
    hairs = bpy.data.hair_curves.new("hairs")
    points, radius = job["points"], job["radius"]
    hairs.add_curves([points.shape[1]] * len(points))
    hairs.position_data.foreach_set("vector", points.astype(np.float32).reshape(-1))
    if "radius" not in hairs.attributes:
        hairs.attributes.new("radius", "FLOAT", "POINT")
    hairs.attributes["radius"].data.foreach_set("value", radius.astype(np.float32).reshape(-1))
    hairs.materials.append(material(bpy, "hairs", float(job["albedo"])))
    for name, data in (("skin", skin), ("hairs", hairs)):
        bpy.context.scene.collection.objects.link(bpy.data.objects.new(name, data))


def settings(bpy: Any, job: Any) -> None:
    """One lamp, no sky, paths without clamps, linear light."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.render.resolution_x, scene.render.resolution_y = (int(side) for side in job["size"])
    scene.render.resolution_percentage = 100
    scene.render.film_transparent = True
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_mode = "RGBA"
    scene.render.image_settings.color_depth = "32"
    scene.world = bpy.data.worlds.new("dark")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.0
    scene.cycles_curves.shape = "THICK"
    tracer = scene.cycles
    tracer.device, tracer.samples = "CPU", int(job["spp"])
    tracer.use_adaptive_sampling = tracer.use_denoising = False
    tracer.max_bounces = tracer.diffuse_bounces = BOUNCES
    tracer.sample_clamp_direct = tracer.sample_clamp_indirect = 0.0
    tracer.caustics_reflective = tracer.caustics_refractive = False
    tracer.pixel_filter_type = "BOX"


def turned(matrix_type: Any, back: Any, place: Any) -> Any:
    """Place and turn of what looks against `back`, as a camera and a lamp do along their -z."""
    up = np.array([0.0, 1.0, 0.0])
    right = np.cross(up, back)
    right /= np.linalg.norm(right)
    rows = np.column_stack([right, np.cross(back, right), back, place])
    return matrix_type([*rows.tolist(), [0.0, 0.0, 0.0, 1.0]])


def main() -> None:
    """All cells, either half of the paths with a seed of its own."""
    bpy, matrix_type = importlib.import_module("bpy"), importlib.import_module("mathutils").Matrix
    folder = Path.cwd()
    job = np.load(folder / "job.npz", allow_pickle=False)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    shapes(bpy, job)
    settings(bpy, job)
    scene = bpy.context.scene
    eye = bpy.data.objects.new("eye", bpy.data.cameras.new("eye"))
    lamp = bpy.data.objects.new("lamp", bpy.data.lights.new("lamp", "SUN"))
    lamp.data.angle, lamp.data.energy = 0.0, float(job["irradiance"])
    for thing in (eye, lamp):
        scene.collection.objects.link(thing)
    scene.camera = eye
    eye.data.sensor_fit, eye.data.angle = "VERTICAL", float(np.radians(job["field"]))
    eye.data.clip_start, eye.data.clip_end = (float(part * job["distance"]) for part in (0.01, 10.0))
    for number, (place, towards) in enumerate(zip(job["eyes"], job["lamps"], strict=True)):
        back = place - job["centre"]
        eye.matrix_world = turned(matrix_type, back / np.linalg.norm(back), place)
        lamp.matrix_world = turned(matrix_type, towards, np.zeros(3))
        for half in range(2):
            scene.cycles.seed = half
            scene.render.filepath = str(folder / "picture.exr")
            bpy.ops.render.render(write_still=True)
            image = bpy.data.images.load(scene.render.filepath)
            pixels = np.empty(4 * image.size[0] * image.size[1], np.float32)
            image.pixels.foreach_get(pixels)
            np.save(folder / f"{number}-{half}.npy", pixels.reshape(image.size[1], image.size[0], 4))
            bpy.data.images.remove(image)


if __name__ == "__main__":
    main()
