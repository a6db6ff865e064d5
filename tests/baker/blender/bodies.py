"""Bodies of `inside.py` whose hairs, colours, modifiers or scale once came wrong."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import bpy
import numpy as np

BROWN, GREEN = (0.5, 0.25, 0.125, 1.0), (0.0, 1.0, 0.0, 1.0)

Paint = Callable[[bpy.types.ShaderNodeTree, bpy.types.ShaderNode, bpy.types.ShaderNode], Any]


def particles(scale: tuple[float, float, float] = (1, 1, 1)) -> bpy.types.Object:
    """A moved sphere with old particle hair, five children beside each of fifty, that is not seen in the viewport."""
    bpy.ops.mesh.primitive_uv_sphere_add(segments=16, ring_count=8, location=(1, 2, 3))
    thing = bpy.context.object
    thing.scale = scale
    material = bpy.data.materials.new("red")
    material.use_nodes = True
    material.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = BROWN
    thing.data.materials.append(material)
    thing.modifiers.new("fur", "PARTICLE_SYSTEM").show_viewport = False
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
    data.attributes.new("paint", "FLOAT_COLOR", "CURVE").data.foreach_set("color", GREEN)
    return thing


def handed_on(curve: bpy.types.Object) -> None:
    """Give hairs an attribute “mask” by nodes, as Interpolate Hair Curves hands on those of the skin."""
    tree = bpy.data.node_groups.new("mask", "GeometryNodeTree")
    for way in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=way, socket_type="NodeSocketGeometry")
    names = ("NodeGroupInput", "GeometryNodeStoreNamedAttribute", "NodeGroupOutput")
    start, stored, end = (tree.nodes.new(name) for name in names)
    stored.data_type, stored.domain = "FLOAT_COLOR", "POINT"
    stored.inputs["Name"].default_value = "mask"
    tree.links.new(start.outputs[0], stored.inputs[0])
    tree.links.new(stored.outputs[0], end.inputs[0])
    curve.modifiers.new("mask", "NODES").node_group = tree


def plain(tree: bpy.types.ShaderNodeTree, shader: bpy.types.ShaderNode, end: bpy.types.ShaderNode) -> None:
    """Link a brown shader, beside a green one that hangs loose."""
    loose = tree.nodes.new("ShaderNodeBsdfPrincipled")
    loose.inputs["Base Color"].default_value = GREEN
    tree.nodes.remove(shader)
    shader = tree.nodes.new("ShaderNodeBsdfHairPrincipled")
    shader.parametrization, shader.inputs["Color"].default_value = "COLOR", BROWN
    mix = tree.nodes.new("ShaderNodeMixShader")
    tree.links.new(shader.outputs[0], mix.inputs[2])
    tree.links.new(mix.outputs[0], end.inputs["Surface"])


def attribute(tree: bpy.types.ShaderNodeTree, shader: bpy.types.ShaderNode, _end: bpy.types.ShaderNode) -> None:
    """Link the attribute “paint” through a node that changes it."""
    paint, shift = tree.nodes.new("ShaderNodeAttribute"), tree.nodes.new("ShaderNodeGamma")
    paint.attribute_name = "paint"
    tree.links.new(paint.outputs["Color"], shift.inputs["Color"])
    tree.links.new(shift.outputs[0], shader.inputs["Base Color"])


def missing(tree: bpy.types.ShaderNodeTree, shader: bpy.types.ShaderNode, _end: bpy.types.ShaderNode) -> None:
    """Link an attribute that the hairs have not."""
    paint = tree.nodes.new("ShaderNodeVertexColor")
    paint.layer_name = "none"
    tree.links.new(paint.outputs["Color"], shader.inputs["Base Color"])


def picture(tree: bpy.types.ShaderNodeTree, shader: bpy.types.ShaderNode, _end: bpy.types.ShaderNode) -> None:
    """Link a picture."""
    tree.links.new(tree.nodes.new("ShaderNodeTexImage").outputs["Color"], shader.inputs["Base Color"])


def melanin(tree: bpy.types.ShaderNodeTree, _shader: bpy.types.ShaderNode, end: bpy.types.ShaderNode) -> None:
    """Link a shader whose colour is an amount of melanin."""
    hair = tree.nodes.new("ShaderNodeBsdfHairPrincipled")
    hair.parametrization = "MELANIN"
    tree.links.new(hair.outputs[0], end.inputs["Surface"])


PAINTS: tuple[Paint, ...] = (plain, attribute, missing, picture, melanin)


def paint(curve: bpy.types.Object, how: Paint) -> None:
    """Give hairs a material by the name of its way."""
    material = bpy.data.materials.new(how.__name__)
    material.use_nodes = True
    tree = material.node_tree
    how(tree, tree.nodes["Principled BSDF"], tree.nodes["Material Output"])
    curve.data.materials.clear()
    curve.data.materials.append(material)


def divided() -> bpy.types.Object:
    """A plane that is 16 faces when it is rendered; the viewport shows 4, on two storeys that a render has not."""
    bpy.ops.mesh.primitive_plane_add()
    thing = bpy.context.object
    fine = thing.modifiers.new("fine", "SUBSURF")
    fine.subdivision_type, fine.levels, fine.render_levels = "SIMPLE", 1, 2
    storeys = thing.modifiers.new("storeys", "ARRAY")
    storeys.show_render = False
    return thing
