"""Runs in Blender's Python: a scene, the extension in it, and what came of it as JSON.

PYTHON inside.py ZIP FURBAKE FOLDER
"""

from __future__ import annotations

import importlib
import json
import sys
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from mathutils.bvhtree import BVHTree

sys.path.append(str(Path(__file__).parents[3] / "web" / "tools" / "site"))
from monkey import choose, nodding

EXTENSION = "bl_ext.user_default.furbake"
TINY = "--layers 4 --size 8 --lights 8 --no-cache"
PLAIN = "--no-length-by-thickness --set length_noise=0"


def grown_long(z: float) -> float:
    """Share of the longest fur at a height of the monkey."""
    return 0.3 + 0.35 * (z + 1)


def monkey() -> bpy.types.Object:
    """A monkey, moved and turned, with a vertex group, a material, two bones and a clip in whose middle it is seen."""
    bpy.ops.mesh.primitive_monkey_add()
    thing = bpy.context.object
    group = thing.vertex_groups.new(name="long")
    for vertex in thing.data.vertices:
        group.add([vertex.index], grown_long(vertex.co.z), "REPLACE")
    nodding(thing, 0.8, (0.6, 0, 0))
    bpy.ops.object.quick_fur(density="LOW", use_noise=True, use_frizz=True)
    choose(thing)
    bpy.context.scene.frame_set(12)
    return thing


def state() -> list[Any]:
    """Objects, data, poses and selection, which an export leaves as they were."""
    active = bpy.context.view_layer.objects.active
    data = [len(each) for each in (bpy.data.meshes, bpy.data.hair_curves, bpy.data.node_groups, bpy.data.collections)]
    poses = [each.pose_position for each in bpy.data.armatures]
    chosen = sorted(each.name for each in bpy.context.selected_objects)
    return [sorted(each.name for each in bpy.data.objects), data, poses, chosen, active.name if active else None]


def refused(**choices: Any) -> str:
    """The sentence by which a bake is refused."""
    thing = bpy.context.object
    before = {name: getattr(thing.furbake, name) for name in choices}
    for name, value in choices.items():
        setattr(thing.furbake, name, value)
    try:
        bpy.ops.furbake.bake()
    except RuntimeError as error:
        return str(error)
    finally:
        for name, value in before.items():
            setattr(thing.furbake, name, value)
    return ""


def exported(thing: bpy.types.Object, out: Path) -> dict[str, Any]:
    """Hairs of a body as they are written: how many, how long, and how far their roots are from its rest pose."""
    hairs = importlib.import_module(f"{EXTENSION}.hairs")
    hairs.write_hairs(bpy.context, thing, out)
    with np.load(out) as arrays:
        points, counts, widths = arrays["points"], arrays["counts"], arrays["widths"]
        colours = arrays.get("colours")
    places = np.stack([points[:, 0], -points[:, 2], points[:, 1]], axis=1)
    starts = np.cumsum(counts) - counts
    mesh = thing.data
    tree = BVHTree.FromPolygons(
        [thing.matrix_world @ each.co for each in mesh.vertices], [each.vertices[:] for each in mesh.polygons]
    )
    steps = np.linalg.norm(np.diff(places, axis=0), axis=1)
    lengths = [float(steps[a : a + n - 1].sum()) for a, n in zip(starts, counts, strict=True)]
    return {
        "count": len(counts),
        "off": max(tree.find_nearest(places[start])[3] for start in starts),
        "lengths": [float(np.quantile(lengths, share)) for share in (0.0, 0.5, 1.0)],
        "widths": [float(widths[starts].mean()), float(widths[starts + counts - 1].mean())],
        "colour": None if colours is None else [float(part) for part in colours.mean(axis=0)],
    }


def particles() -> bpy.types.Object:
    """A moved sphere with old particle hair, five children beside each of fifty."""
    bpy.ops.mesh.primitive_uv_sphere_add(segments=16, ring_count=8, location=(1, 2, 3))
    thing = bpy.context.object
    material = bpy.data.materials.new("red")
    material.use_nodes = True
    material.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (0.5, 0.25, 0.125, 1)
    thing.data.materials.append(material)
    thing.modifiers.new("fur", "PARTICLE_SYSTEM")
    settings = thing.particle_systems[0].settings
    settings.type, settings.count, settings.hair_length = "HAIR", 50, 0.2
    settings.child_type, settings.child_percent, settings.rendered_child_count = "INTERPOLATED", 1, 5
    return thing


def spline() -> bpy.types.Object:
    """A plane with one Bézier hair: a quarter of a circle whose radius is 1, painted green."""
    bpy.ops.mesh.primitive_plane_add()
    thing = bpy.context.object
    data = bpy.data.hair_curves.new("bow")
    data.add_curves([2])
    curve = bpy.data.objects.new("bow", data)
    bpy.context.collection.objects.link(curve)
    data.surface = thing
    k = 4 / 3 * np.tan(np.pi / 8)
    values = {"position": [(0, 0, 0), (1, 0, 1)], "handle_left": [(0, 0, -k), (1 - k, 0, 1)]}
    values["handle_right"] = [(0, 0, k), (1 + k, 0, 1)]
    data.set_types(type="BEZIER")
    for name, places in values.items():
        held = data.attributes.get(name) or data.attributes.new(name, "FLOAT_VECTOR", "POINT")
        held.data.foreach_set("vector", np.array(places, np.float32).reshape(-1))
    data.attributes.new("paint", "FLOAT_COLOR", "CURVE").data.foreach_set("color", [0.0, 1.0, 0.0, 1.0])
    return thing


def taken(folder: Path, before: set[bpy.types.Object]) -> dict[str, Any]:
    """Objects that the import of a baked folder brought."""
    made = [each for each in bpy.data.objects if each not in before]
    hairs = next(each for each in made if each.type == "CURVES")
    skin = hairs.data.surface
    bpy.context.scene.frame_set(1)
    shape = skin.evaluated_get(bpy.context.evaluated_depsgraph_get())
    tree = BVHTree.FromPolygons(
        [shape.matrix_world @ each.co for each in shape.data.vertices],
        [each.vertices[:] for each in shape.data.polygons],
    )
    points = np.empty(3 * len(hairs.data.points), np.float32)
    hairs.data.position_data.foreach_get("vector", points)
    first = np.array([each.value for each in hairs.data.curve_offset_data])[:-1]
    places = [hairs.matrix_world @ hairs.data.points[int(start)].position for start in first]
    return {
        "kinds": sorted(each.type for each in made),
        "hairs": len(hairs.data.curves),
        "off": float(np.quantile([tree.find_nearest(each)[3] for each in places], 0.99)),
        "actions": [each.name for each in bpy.data.actions],
        "materials": [[node.type for node in each.node_tree.nodes] for each in hairs.data.materials],
        "folder": folder.name,
    }


def main(package: str, furbake: str, folder: str) -> dict[str, Any]:
    """Everything, in one scene."""
    out = Path(folder)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.extensions.package_install_files(filepath=package, repo="user_default", enable_on_install=True)
    preferences = bpy.context.preferences.addons[EXTENSION].preferences
    preferences.command = furbake
    found: dict[str, Any] = {}
    thing = monkey()
    chosen = thing.furbake
    chosen.folder, chosen.preset, chosen.length_group, chosen.more = str(out / "haired"), "fox", "long", TINY
    before = state()
    found["haired"] = sorted(bpy.ops.furbake.bake())
    found["told"] = importlib.import_module(f"{EXTENSION}.bake").State.told[thing.name]
    found["kept"] = state() == before
    found["strands"] = exported(thing, out / "monkey.npz")
    found["refused"] = {
        "option": refused(more="--layers 99"),
        "group": refused(mask_group="none"),
        "quotes": refused(more="'"),
        "unsaved": refused(folder=""),
    }
    chosen.hairs, chosen.length, chosen.folder, chosen.more = False, 0.2, str(out / "plain"), f"{TINY} {PLAIN}"
    found["plain"] = sorted(bpy.ops.furbake.bake())
    known = set(bpy.data.objects)
    found["take"] = sorted(bpy.ops.furbake.take(directory=str(out / "haired"), share=0.25))
    found["taken"] = taken(out / "haired", known)
    job = importlib.import_module(f"{EXTENSION}.bake").Baking(bpy.context, thing).job
    job.cancel()
    try:
        found["cancelled"] = job.result()
    except RuntimeError as error:
        found["cancelled"] = str(error)
    preferences.command = "/nowhere/furbake"
    found["refused"]["command"] = refused()
    found["particles"] = exported(particles(), out / "particles.npz")
    found["spline"] = exported(spline(), out / "spline.npz")
    bpy.ops.preferences.addon_disable(module=EXTENSION)
    found["gone"] = not hasattr(bpy.types.Object, "furbake")
    return found


Path(sys.argv[3], "found.json").write_text(json.dumps(main(*sys.argv[1:])), "utf-8")
