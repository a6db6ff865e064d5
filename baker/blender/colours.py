"""Colours of hairs: of an attribute that their material uses, or the material's own."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

Singles = NDArray[np.float32]

SHADERS = {"BSDF_HAIR_PRINCIPLED": "Color", "BSDF_PRINCIPLED": "Base Color", "BSDF_HAIR": "Color"}
"""Shaders that are read, and their input of the colour."""

SHIFTS = {"REROUTE", "GAMMA", "HUE_SAT", "BRIGHTCONTRAST", "CURVE_RGB", "INVERT", "MIX", "MIX_RGB"}
"""Nodes that pass a colour on, changed or not."""

KINDS = {"FLOAT_COLOR", "BYTE_COLOR"}
"""Types of attributes that are colours."""

OUTPUTS = ("CYCLES", "EEVEE")
"""Targets of a material's outputs, first the one that hairs are compared with."""


@dataclass(frozen=True)
class Dye:
    """Colour that a material gives to hairs: one linear colour, or the name of an attribute, or why there is none.

    through : nodes between attribute and shader, which are not computed
    """

    plain: tuple[float, ...] | None = None
    attribute: str = ""
    unread: str = ""
    through: tuple[str, ...] = ()


def hair_colours(
    data: bpy.types.Curves, first: NDArray[np.int32], painted: bpy.types.Object
) -> tuple[Singles | None, str]:
    """(N, 3) linear colours of hairs, or None where the preset's are taken; a note, empty for a plain colour.

    data : the hairs after their modifiers; first (S + 1,) : offsets of their points; painted : the object as the
    artist has it, whose material counts. Without a material its own attribute of colours counts, not one that
    modifiers hand on from the skin.
    """
    material = painted.active_material
    if material is None:
        coloured = [each.name for each in painted.data.attributes if each.data_type in KINDS]
        own = [name for name in coloured if not name.startswith(".")]
        colours = attribute_colours(data, first, own[0]) if own else None
        given = "the preset's colours are taken" if colours is None else f"colours by their attribute {own[0]}"
        return colours, f"hairs without a material: {given}"
    dye, about = dye_of(material), f"hair colour of material {material.name}:"
    if dye.plain is not None:
        return np.tile(np.array(dye.plain, np.float32), (int(first[-1]), 1)), ""
    if not dye.attribute:
        return None, f"{about} by {dye.unread}, which is not read; the preset's are taken"
    colours = attribute_colours(data, first, dye.attribute)
    if colours is None:
        return None, f"{about} by attribute {dye.attribute}, which its hairs have not; the preset's are taken"
    left = f", without what the node {', '.join(dye.through)} makes of it" if dye.through else ""
    return colours, f"{about} by attribute {dye.attribute}{left}"


def attribute_colours(data: bpy.types.Curves, first: NDArray[np.int32], name: str) -> Singles | None:
    """(N, 3) linear colours of an attribute of the curves or their points; None where it is none of colours."""
    found = data.attributes.get(name)
    if found is None or found.data_type not in KINDS:
        return None
    colours = numbers(found.data, "color", 4 * len(found.data)).reshape(-1, 4)[:, :3]
    return np.repeat(colours, np.diff(first), axis=0) if found.domain == "CURVE" else colours


def dye_of(material: bpy.types.Material) -> Dye:
    """The colour at the shader that is linked to the active output of a material."""
    if not material.use_nodes:
        return Dye(plain=tuple(material.diffuse_color[:3]))
    node = shader_of(material.node_tree)
    if node is None:
        return Dye(unread="a shader other than Principled Hair, Principled and Hair")
    way = getattr(node, "parametrization", "COLOR")
    if way != "COLOR":
        return Dye(unread=way.lower())
    socket = node.inputs[SHADERS[node.type]]
    if not socket.is_linked:
        return Dye(plain=tuple(socket.default_value[:3]))
    source, through = origin(socket)
    if name := attribute_name(source):
        return Dye(attribute=name, through=through)
    if source.type == "RGB" and not through:
        return Dye(plain=tuple(source.outputs[0].default_value[:3]))
    return Dye(unread="a picture" if source.type == "TEX_IMAGE" else f"the node {source.bl_label}")


def shader_of(tree: bpy.types.ShaderNodeTree) -> bpy.types.ShaderNode | None:
    """The first shader that is read, from the active output's surface on through mixes and sums of shaders."""
    end = next(filter(None, map(tree.get_output_node, OUTPUTS)), None)
    waiting = [end.inputs["Surface"]] if end else []
    while waiting:
        for link in (each for each in waiting.pop(0).links if each.is_valid):
            if link.from_node.type in SHADERS:
                return link.from_node
            waiting += [each for each in link.from_node.inputs if each.type == "SHADER"]
    return None


def origin(socket: bpy.types.NodeSocket, through: tuple[str, ...] = ()) -> tuple[bpy.types.Node, tuple[str, ...]]:
    """The node that a linked socket's colour comes from, an attribute before others, and those that change it."""
    node = socket.links[0].from_node
    if node.type not in SHIFTS:
        return node, through
    if node.type != "REROUTE":
        through = (*through, node.bl_label)
    ways = [each for each in node.inputs if each.is_linked and each.links[0].is_valid and each.type == "RGBA"]
    ends = [origin(each, through) for each in ways]
    return next((end for end in ends if attribute_name(end[0])), ends[0] if ends else (node, through))


def attribute_name(node: bpy.types.Node) -> str:
    """Name of the hairs' attribute that a node reads; empty for any other node."""
    if node.type == "VERTEX_COLOR":
        return node.layer_name
    return node.attribute_name if node.type == "ATTRIBUTE" and node.attribute_type == "GEOMETRY" else ""


def numbers(values: Any, name: str, count: int, kind: Any = np.float32) -> NDArray[Any]:
    """(count,) numbers of a collection of Blender's."""
    found = np.empty(count, kind)
    values.foreach_get(name, found)
    return found
