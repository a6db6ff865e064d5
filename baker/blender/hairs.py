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

from .colours import Singles, hair_colours, numbers
from .job import JobError
from .scene import a_copy, at_rest, changed, rendered

RADIUS = 0.01
"""Radius of curves that have none, Blender's own."""

SPLINES = 1
"""Number of the last of the types of curves whose points are taken as they are: Catmull-Rom 0, poly 1."""

AMOUNT = "Viewport Amount"
"""Input of Blender's node groups that thins hairs on the screen."""


@dataclass(frozen=True)
class Hairs:
    """Hairs of S strands with N points in all, y up, Blender units.

    points (N, 3); counts (S,); widths (N,); colours (N, 3) linear, or None; note : where the colours come from
    """

    points: Singles
    counts: NDArray[np.int32]
    widths: Singles
    colours: Singles | None
    note: str


def sources(
    thing: bpy.types.Object, *, shown: bool = True
) -> tuple[list[bpy.types.Object], list[bpy.types.ParticleSystem]]:
    """Curves objects that grow on a body, and its systems of particle hair: those that are rendered, or the others."""
    grown = [
        each
        for each in bpy.data.objects
        if each.type == "CURVES" and each.hide_render != shown and thing in {each.data.surface, each.parent}
    ]
    names = {
        each.particle_system.name
        for each in thing.modifiers
        if each.type == "PARTICLE_SYSTEM" and each.show_render == shown
    }
    return grown, [each for each in thing.particle_systems if each.settings.type == "HAIR" and each.name in names]


def check_hairs(context: bpy.types.Context, thing: bpy.types.Object) -> tuple[bool, list[str]]:
    """True where a body has hairs that are rendered, and notes for the artist on those that are not taken.

    Raises JobError where it has hairs and none of them is rendered.
    """
    here = any(sources(thing))
    left = [each.name for part in sources(thing, shown=False) for each in part]
    if left and not here:
        named = ", ".join(left)
        raise JobError(
            f"{thing.name}: hairs that are not rendered ({named}), expected some that are, or “From its hairs” off"
        )
    if here:
        return True, [f"hairs left out, as they are not rendered: {len(left)} ({', '.join(left)})"] if left else []
    loose = [
        each.name
        for each in context.scene.objects
        if each.type == "CURVES" and each.data.surface is None and (each.parent is None or each.parent.type != "MESH")
    ]
    beside = f"; hair curves without a surface: {', '.join(loose)}" if loose else ""
    return False, [f"no hairs on {thing.name}, the preset's are taken{beside}"]


def write_hairs(context: bpy.types.Context, thing: bpy.types.Object, path: Path) -> list[str]:
    """Write all hairs of a body at rest as `.npz`; notes for the artist. Raises JobError where there are none."""
    with at_rest(context, thing), rendered(context, thing):
        curves, systems = sources(thing)
        found = [curves_hairs(context, each, each) for each in curves]
        found += [particle_hairs(context, thing, each) for each in systems]
    found = [each for each in found if len(each.counts)]
    if not found:
        raise JobError(f"{thing.name}: no hairs, expected curves on it or particle hair; or take “From its hairs” off")
    arrays: dict[str, Any] = {
        name: np.concatenate([getattr(each, name) for each in found]) for name in ("points", "counts", "widths")
    }
    notes = [f"{len(arrays['counts'])} hairs", *dict.fromkeys(each.note for each in found if each.note)]
    bare = [each for each in found if each.colours is None]
    if not bare:
        arrays["colours"] = np.concatenate([each.colours for each in found])
    elif len(bare) < len(found):
        notes.append("some hairs have no colour, so the preset's are taken for all")
    np.savez(path, **arrays)
    return notes


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
        first, total = offsets(data), len(data.points)
        place = np.array(copy.matrix_world, np.float64)
        points = numbers(data.position_data, "vector", 3 * total).reshape(-1, 3) if total else np.zeros((0, 3))
        points = points @ place[:3, :3].T + place[:3, 3]
        radius = data.attributes.get("radius")
        widths = np.full(total, 2 * RADIUS) if radius is None else 2 * numbers(radius.data, "value", total)
        widths = widths * thickened(points, first, place)
        colours, note = hair_colours(data, first, painted)
    return Hairs(y_up(points), np.diff(first).astype(np.int32), widths.astype(np.float32), colours, note)


def particle_hairs(context: bpy.types.Context, thing: bpy.types.Object, system: bpy.types.ParticleSystem) -> Hairs:
    """Hairs of a particle system, its children among them, as Blender turns them into curves."""
    settings, systems = system.settings, thing.particle_systems
    shown = {"display_percentage": 100, "display_step": settings.render_step}
    shown["child_percent"] = settings.rendered_child_count
    values: list[tuple[Any, str, Any]] = [(settings, name, value) for name, value in shown.items()]
    values.append((systems, "active_index", [each.name for each in systems].index(system.name)))
    values += [
        (each, "show_viewport", True)
        for each in thing.modifiers
        if each.type == "PARTICLE_SYSTEM" and each.particle_system.name == system.name
    ]
    known = set(bpy.data.objects)
    with changed(values):
        context.view_layer.objects.active = thing
        context.view_layer.update()
        bpy.ops.curves.convert_from_particle_system()
        (made,) = set(bpy.data.objects) - known
        slot = settings.material - 1
        made.data.materials.append(thing.material_slots[slot].material if slot < len(thing.material_slots) else None)
        curves = made.data
        widths = particle_widths(settings, np.diff(offsets(curves)))
        if len(widths):
            curves.attributes.new("radius", "FLOAT", "POINT").data.foreach_set("value", widths / 2)
        hairs = curves_hairs(context, made, made)
        bpy.data.objects.remove(made)
        bpy.data.hair_curves.remove(curves)
    return hairs


def offsets(data: bpy.types.Curves) -> NDArray[np.int32]:
    """(S + 1,) numbers of the points that S curves begin with, and of all points."""
    count = len(data.curves)
    return numbers(data.curve_offset_data, "value", count + 1, np.int32) if count else np.zeros(1, np.int32)


def thickened(points: NDArray[Any], first: NDArray[np.int32], place: NDArray[np.float64]) -> NDArray[np.float64]:
    """(N,) factors of widths by an object's scale, as Cycles draws them: across each hair, the mean of both ways.

    points (N, 3) : in the world; first (S + 1,) : offsets of the hairs; place (4, 4) : the object's matrix
    """
    linear = place[:3, :3]
    chords = points[first[1:] - 1] - points[first[:-1]]
    own = np.linalg.norm(chords @ np.linalg.pinv(linear).T, axis=1)
    long, volume = np.linalg.norm(chords, axis=1), abs(np.linalg.det(linear))
    stretch = np.divide(long, own, out=np.full(len(own), np.cbrt(volume)), where=own > 0)
    factors = np.sqrt(np.divide(volume, stretch, out=np.zeros(len(own)), where=stretch > 0))
    return np.repeat(factors, np.diff(first))


def particle_widths(settings: bpy.types.ParticleSettings, counts: NDArray[np.int32]) -> Singles:
    """(N,) widths along hairs by the particles' shape, as Cycles has them, in the object's own units."""
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


def y_up(points: NDArray[Any]) -> Singles:
    """(N, 3) places in Blender's axes as glTF has them."""
    return np.stack([points[:, 0], points[:, 2], -points[:, 1]], axis=1).astype(np.float32)


def _show_all(modifier: bpy.types.Modifier) -> None:
    if modifier.type != "NODES" or modifier.node_group is None:
        return
    for item in modifier.node_group.interface.items_tree:
        if item.item_type == "SOCKET" and item.in_out == "INPUT" and item.name == AMOUNT:
            modifier[item.identifier] = 1.0
