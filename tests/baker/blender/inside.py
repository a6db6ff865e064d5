"""Runs in Blender's Python: a scene, the extension in it, and what came of it as JSON.

PYTHON inside.py ZIP FURBAKE FOLDER
"""

from __future__ import annotations

import contextlib
import importlib
import json
import sys
import warnings
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from bodies import PAINTS, divided, handed_on, paint, particles, spline
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
    notes = hairs.write_hairs(bpy.context, thing, out)
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
        "notes": notes,
    }


def stretched() -> list[float]:
    """Factors of the widths of a hair along x whose object is eight times larger: along it, across it, as a whole."""
    hairs = importlib.import_module(f"{EXTENSION}.hairs")
    points, first = np.array([[0.0, 0, 0], [1, 0, 0]]), np.array([0, 2])
    scales = ((8, 1, 1), (1, 1, 8), (8, 8, 8))
    return [hairs.thickened(points, first, np.diag([*scale, 1.0]))[0] for scale in scales]


def written(thing: bpy.types.Object, out: Path) -> list[Any]:
    """Triangles of a body as it is written, and whether its modifiers stay as they were, even where something fails."""
    body, scene = (importlib.import_module(f"{EXTENSION}.{name}") for name in ("body", "scene"))
    before = [(each.show_viewport, getattr(each, "levels", 0)) for each in thing.modifiers]
    body.write_body(bpy.context, thing, out, clips=False)
    with contextlib.suppress(ValueError), scene.rendered(bpy.context, thing):
        raise ValueError
    after = [(each.show_viewport, getattr(each, "levels", 0)) for each in thing.modifiers]
    data = out.read_bytes()
    parts = json.loads(data[20 : 20 + int.from_bytes(data[12:16], "little")])
    faces = parts["accessors"][parts["meshes"][0]["primitives"][0]["indices"]]["count"] // 3
    return [faces, before == after]


def hidden_hairs(thing: bpy.types.Object) -> dict[str, Any]:
    """Messages where hairs are far off, some are not rendered, none is, or none grows on the body."""
    check_hairs = importlib.import_module(f"{EXTENSION}.hairs").check_hairs
    bow = bpy.data.objects["bow"]
    bow.location.z = 50
    afar = refused(more=TINY)
    second = bow.copy()
    bpy.context.collection.objects.link(second)
    second.hide_render = True
    some = check_hairs(bpy.context, thing)
    bow.hide_render = True
    none = refused()
    bpy.data.objects.remove(second)
    bow.data.surface = None
    return {"afar": afar, "some": some, "none": none, "loose": check_hairs(bpy.context, thing)}


def places(thing: bpy.types.Object, out: Path) -> dict[str, Any]:
    """The folder of a bake by what is typed, once the scene is a file, and what Blender warns of."""
    settings = importlib.import_module(f"{EXTENSION}.settings")
    bpy.ops.wm.save_as_mainfile(filepath=str(out / "scene.blend"), copy=False)
    found: dict[str, Any] = {}
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        for typed in ("", "out rel", "//out rel", str(out / "whole")):
            thing.furbake.folder = typed
            found[typed.replace(str(out), "OUT")] = settings.baked_folder(thing).relative_to(out).as_posix()
    found["warnings"] = [str(each.message) for each in told]
    (out / "my.toml").write_text("layers = 99", "utf-8")
    return found | {f"preset {name}": refused(preset=name, hairs=False) for name in ("my.toml", "//my.toml")}


def regrown() -> dict[str, Any]:
    """Hairs as an import makes them: a quarter of eight, and one that is attached to a plane with a UV map."""
    take = importlib.import_module(f"{EXTENSION}.take")
    parts = {"points": np.zeros((8, 2, 3)), "radius": np.full((8, 2), 0.5), "colour": np.zeros((8, 2, 3))}
    few = take.thinned(parts, 0.25)
    bpy.ops.mesh.primitive_plane_add(size=2, location=(3, 0, 0))
    skin = bpy.context.object
    points = np.array([[[3.5, 0, 0.5], [3.5, 1, 0.5]]])
    hairs = take.curves_of(bpy.context, "one", points, np.ones((1, 2)), np.ones((1, 2, 3)))
    take.attach(bpy.context, hairs, skin)
    place = hairs.data.attributes.get("surface_uv_coordinate")
    root = hairs.matrix_world @ hairs.data.points[0].position
    return {"few": few["radius"].tolist(), "place": list(place.data[0].vector) if place else None, "root": list(root)}


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
    chosen.hairs, chosen.length, chosen.folder, chosen.more = False, 0.2, str(out / "plain fur"), f"{TINY} {PLAIN}"
    found["plain"] = sorted(bpy.ops.furbake.bake())
    found["told"] += importlib.import_module(f"{EXTENSION}.bake").State.told[thing.name]
    known = set(bpy.data.objects)
    found["take"] = sorted(bpy.ops.furbake.take(directory=str(out / "haired"), share=0.25))
    found["taken"] = taken(out / "haired", known)
    bpy.context.scene.unit_settings.scale_length = 0.01
    baking = importlib.import_module(f"{EXTENSION}.bake").Baking(bpy.context, thing)
    found["unit"], job = baking.notes, baking.job
    job.cancel()
    try:
        found["cancelled"] = job.result()
    except RuntimeError as error:
        found["cancelled"] = str(error)
    preferences.command = "/nowhere/furbake"
    found["refused"]["command"] = refused()
    preferences.command = furbake
    found["particles"] = exported(particles(), out / "particles.npz")
    found["large"] = exported(particles((8, 8, 8)), out / "particles.npz")
    found["stretched"] = stretched()
    found["divided"] = written(divided(), out / "divided.glb")
    thing = spline()
    bow = bpy.data.objects["bow"]
    handed_on(bow)
    found["spline"] = exported(thing, out / "spline.npz")
    found["colours"] = {}
    for how in PAINTS:
        paint(bow, how)
        found["colours"][how.__name__] = exported(thing, out / "spline.npz")
    thing.furbake.folder = str(out / "hidden")
    found["hidden"] = hidden_hairs(thing)
    found["places"] = places(thing, out)
    found["regrown"] = regrown()
    bpy.ops.preferences.addon_disable(module=EXTENSION)
    found["gone"] = not hasattr(bpy.types.Object, "furbake")
    return found


Path(sys.argv[3], "found.json").write_text(json.dumps(main(*sys.argv[1:])), "utf-8")
