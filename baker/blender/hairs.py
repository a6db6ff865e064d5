"""Hairs of a body as a groom that furbake reads: curves objects and particle hair, as they are rendered."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from .job import JobError
from .scene import a_copy, at_rest

Singles = NDArray[np.float32]

RADIUS = 0.01
"""Radius of curves that have none, Blender's own."""

SPLINES = 1
"""Number of the last of the types of curves whose points are taken as they are: Catmull-Rom 0, poly 1."""

AMOUNT = "Viewport Amount"
"""Input of Blender's node groups that thins hairs on the screen."""


@dataclass(frozen=True)
class Hairs:
    """Hairs of S strands with N points in all, y up, metres.

    points (N, 3); counts (S,); widths (N,); colours (N, 3) linear, or None
    """

    points: Singles
    counts: NDArray[np.int32]
    widths: Singles
    colours: Singles | None


def sources(thing: bpy.types.Object) -> tuple[list[bpy.types.Object], list[bpy.types.ParticleSystem]]:
    """Curves objects that grow on a body, and its systems of particle hair, where they are rendered."""
    grown = [
        each
        for each in bpy.data.objects
        if each.type == "CURVES" and not each.hide_render and thing in {each.data.surface, each.parent}
    ]
    shown = {
        each.particle_system.name for each in thing.modifiers if each.type == "PARTICLE_SYSTEM" and each.show_render
    }
    return grown, [each for each in thing.particle_systems if each.settings.type == "HAIR" and each.name in shown]


def write_hairs(context: bpy.types.Context, thing: bpy.types.Object, path: Path) -> int:
    """Write all hairs of a body at rest as `.npz`; their number. Raises JobError where there are none."""
    with at_rest(context, thing):
        curves, systems = sources(thing)
        found = [curves_hairs(context, each, each) for each in curves]
        found += [particle_hairs(context, thing, each) for each in systems]
    found = [each for each in found if len(each.counts)]
    if not found:
        raise JobError(f"{thing.name}: no hairs, expected curves on it or particle hair; or take “From its hairs” off")
    arrays: dict[str, Any] = {
        name: np.concatenate([getattr(each, name) for each in found]) for name in ("points", "counts", "widths")
    }
    if all(each.colours is not None for each in found):
        arrays["colours"] = np.concatenate([each.colours for each in found])
    np.savez(path, **arrays)
    return len(arrays["counts"])


def curves_hairs(context: bpy.types.Context, thing: bpy.types.Object, painted: bpy.types.Object) -> Hairs:
    """Hairs of a curves object, after its modifiers. painted : the object whose material has their colour."""
    with plain_curves() as nodes, a_copy(context, thing, deep=False) as copy:
        for modifier in copy.modifiers:
            modifier.show_viewport = modifier.show_render
            _show_all(modifier)
        copy.modifiers.new("furbake", "NODES").node_group = nodes
        copy.hide_viewport = False
        context.view_layer.update()
        data = copy.evaluated_get(context.evaluated_depsgraph_get()).data
        count, total = len(data.curves), len(data.points)
        first = numbers(data.curve_offset_data, "value", count + 1, np.int32) if count else np.zeros(1, np.int32)
        place = np.array(copy.matrix_world, np.float64)
        points = numbers(data.position_data, "vector", 3 * total).reshape(-1, 3) if total else np.zeros((0, 3))
        points = points @ place[:3, :3].T + place[:3, 3]
        radius = data.attributes.get("radius")
        widths = np.full(total, 2 * RADIUS) if radius is None else 2 * numbers(radius.data, "value", total)
        widths = widths * np.cbrt(abs(np.linalg.det(place[:3, :3])))
        colours = painted_colours(data, first)
    if colours is None and (one := material_colour(painted.active_material)) is not None:
        colours = np.tile(np.array(one, np.float32), (total, 1))
    return Hairs(y_up(points), np.diff(first).astype(np.int32), widths.astype(np.float32), colours)


def particle_hairs(context: bpy.types.Context, thing: bpy.types.Object, system: bpy.types.ParticleSystem) -> Hairs:
    """Hairs of a particle system, its children among them, as Blender turns them into curves."""
    settings = system.settings
    shown = {"display_percentage": 100, "display_step": settings.render_step}
    shown["child_percent"] = settings.rendered_child_count
    before = {name: getattr(settings, name) for name in shown}
    index = thing.particle_systems.active_index
    known = set(bpy.data.objects)
    try:
        for name, value in shown.items():
            setattr(settings, name, value)
        thing.particle_systems.active_index = list(thing.particle_systems).index(system)
        context.view_layer.objects.active = thing
        context.view_layer.update()
        bpy.ops.curves.convert_from_particle_system()
        (made,) = set(bpy.data.objects) - known
        slot = settings.material - 1
        made.data.materials.append(thing.material_slots[slot].material if slot < len(thing.material_slots) else None)
        hairs = curves_hairs(context, made, made)
        curves = made.data
        bpy.data.objects.remove(made)
        bpy.data.hair_curves.remove(curves)
    finally:
        for name, value in before.items():
            setattr(settings, name, value)
        thing.particle_systems.active_index = index
    return Hairs(hairs.points, hairs.counts, particle_widths(settings, hairs.counts), hairs.colours)


def particle_widths(settings: bpy.types.ParticleSettings, counts: NDArray[np.int32]) -> Singles:
    """(N,) widths along hairs by the particles' shape, as Cycles has them."""
    starts = np.repeat(np.cumsum(counts) - counts, counts)
    along = (np.arange(counts.sum()) - starts) / np.repeat(np.maximum(counts - 1, 1), counts)
    shape = settings.shape
    left = (1.0 - along) ** (1.0 + shape if shape < 0 else 1.0 / (1.0 - min(shape, 0.999)))
    root, tip = (settings.radius_scale * each for each in (settings.root_radius, settings.tip_radius))
    return np.asarray(tip + left * (root - tip), np.float32)


@contextmanager
def plain_curves() -> Iterator[bpy.types.NodeTree]:
    """Nodes that make instances real, and of Bézier curves and NURBS the points that are drawn."""
    tree = bpy.data.node_groups.new("furbake", "GeometryNodeTree")
    tree.is_modifier = True
    for way in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=way, socket_type="NodeSocketGeometry")
    names = ("NodeGroupInput", "GeometryNodeRealizeInstances", "GeometryNodeResampleCurve", "NodeGroupOutput")
    start, real, drawn, end = (tree.nodes.new(name) for name in names)
    if hasattr(drawn, "mode"):
        drawn.mode = "EVALUATED"
    else:  # Blender 5
        drawn.inputs["Mode"].default_value = "Evaluated"
    kind, beyond = tree.nodes.new("GeometryNodeInputNamedAttribute"), tree.nodes.new("FunctionNodeCompare")
    kind.data_type = "INT"
    kind.inputs["Name"].default_value = "curve_type"
    beyond.data_type, beyond.operation = "INT", "GREATER_THAN"
    whole = [each for each in beyond.inputs if each.type == "INT"]
    whole[1].default_value = SPLINES
    value = next(each for each in kind.outputs if each.type == "INT" and each.enabled)
    links = tree.links
    links.new(value, whole[0])
    links.new(beyond.outputs[0], drawn.inputs["Selection"])
    for one, two in ((start, real), (real, drawn), (drawn, end)):
        links.new(one.outputs[0], two.inputs[0])
    try:
        yield tree
    finally:
        bpy.data.node_groups.remove(tree)


def painted_colours(data: bpy.types.Curves, first: NDArray[np.int32]) -> Singles | None:
    """(N, 3) linear colours of an attribute of the curves or their points, the first there is."""
    for each in data.attributes:
        if each.data_type in {"FLOAT_COLOR", "BYTE_COLOR"} and not each.name.startswith("."):
            size = len(each.data)
            colours = numbers(each.data, "color", 4 * size).reshape(-1, 4)[:, :3]
            return np.repeat(colours, np.diff(first), axis=0) if each.domain == "CURVE" else colours
    return None


def material_colour(material: bpy.types.Material | None) -> tuple[float, float, float] | None:
    """The linear colour of a material, where it is one for all hairs."""
    if material is None or not material.use_nodes:
        return None
    wanted = {"BSDF_HAIR_PRINCIPLED": "Color", "BSDF_PRINCIPLED": "Base Color", "BSDF_HAIR": "Color"}
    for node in material.node_tree.nodes:
        name = wanted.get(node.type)
        if name is None or getattr(node, "parametrization", "COLOR") != "COLOR":
            continue
        if not node.inputs[name].is_linked:
            red, green, blue, _ = node.inputs[name].default_value
            return red, green, blue
    return None


def numbers(values: Any, name: str, count: int, kind: Any = np.float32) -> NDArray[Any]:
    """(count,) numbers of a collection of Blender's."""
    found = np.empty(count, kind)
    values.foreach_get(name, found)
    return found


def y_up(points: NDArray[Any]) -> Singles:
    """(N, 3) places in Blender's axes as glTF has them."""
    return np.stack([points[:, 0], points[:, 2], -points[:, 1]], axis=1).astype(np.float32)


def _show_all(modifier: bpy.types.Modifier) -> None:
    if modifier.type != "NODES" or modifier.node_group is None:
        return
    for item in modifier.node_group.interface.items_tree:
        if item.item_type == "SOCKET" and item.in_out == "INPUT" and item.name == AMOUNT:
            modifier[item.identifier] = 1.0
