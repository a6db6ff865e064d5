"""Import of a baked folder: the body by Blender's glTF importer, the strands as curves with a material."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import bpy
import numpy as np
from bpy.props import FloatProperty, StringProperty
from numpy.typing import NDArray

from .command import found
from .job import Job, JobError
from .settings import BESIDE, preferred_command

COLOUR = "Color"
"""Attribute of the points that holds the hairs' colours."""


class FURBAKE_OT_take(bpy.types.Operator):  # noqa: N801
    """Import a baked folder: mesh, hairs as curves, materials"""

    bl_idname = "furbake.take"
    bl_label = "Baked fur (folder)"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 — Blender's way

    directory: StringProperty(subtype="DIR_PATH", options={"HIDDEN"} | BESIDE)
    filter_folder: bpy.props.BoolProperty(default=True, options={"HIDDEN"})
    share: FloatProperty(
        name="Share of hairs",
        default=1.0,
        min=0.0,
        max=1.0,
        description="How many of the hairs come along, as much wider as they are fewer; 0: the body alone",
    )

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context: bpy.types.Context) -> set[str]:
        try:
            take(context, Path(bpy.path.abspath(self.directory)), self.share)
        except (JobError, RuntimeError, OSError) as error:
            self.report({"ERROR"}, str(error).strip())
            return {"CANCELLED"}
        return {"FINISHED"}


def take(context: bpy.types.Context, folder: Path, share: float = 1.0) -> bpy.types.Object | None:
    """Import a baked folder; the hairs, or None where none are wanted. Raises JobError where furbake refuses it."""
    command = found(preferred_command(context))
    with TemporaryDirectory(prefix="furbake-") as scratch:
        body, strands = Path(scratch) / f"{folder.name}.glb", Path(scratch) / "hairs.npz"
        Job([command, "export", str(folder), "--glb", str(body)]).result()
        if share > 0:
            Job([command, "groom", str(folder), "-o", str(strands)]).result()
        before = set(bpy.data.objects)
        bpy.ops.import_scene.gltf(filepath=str(body))
        made = [each for each in bpy.data.objects if each not in before]
        if share <= 0:
            return None
        with np.load(strands) as arrays:
            parts = {name: arrays[name] for name in ("points", "radius", "colour")}
    hairs = curves_of(context, folder.name, **thinned(parts, share))
    skin = next((each for each in made if each.type == "MESH" and each.name.partition(".")[0] == "skin"), None)
    if skin is not None:
        attach(context, hairs, skin)
    return hairs


def thinned(parts: dict[str, NDArray[Any]], share: float) -> dict[str, NDArray[Any]]:
    """A share of S hairs by chance, as much wider as they are fewer: the area that is seen of them stays.

    parts : points (S, P, 3), radius (S, P) and colour (S, P, 3)
    """
    count = len(parts["points"])
    chosen = np.sort(np.random.default_rng(0).permutation(count)[: round(share * count)])
    found = {name: values[chosen] for name, values in parts.items()}
    return found | {"radius": found["radius"] * (count / max(len(chosen), 1))}


def attach(context: bpy.types.Context, hairs: bpy.types.Object, skin: bpy.types.Object) -> None:
    """Let hairs grow on a skin as Blender's own do: with the place of each root in the skin's UV map, if it has one."""
    hairs.data.surface = skin
    place = hairs.matrix_world.copy()
    hairs.parent = skin
    context.view_layer.update()
    hairs.matrix_world = place
    if skin.data.uv_layers and len(hairs.data.curves):
        hairs.data.surface_uv_map = skin.data.uv_layers.active.name
        context.view_layer.update()
        with context.temp_override(active_object=hairs, object=hairs, selected_objects=[hairs]):
            bpy.ops.curves.snap_curves_to_surface(attach_mode="NEAREST")


def curves_of(
    context: bpy.types.Context, name: str, points: NDArray[Any], radius: NDArray[Any], colour: NDArray[Any]
) -> bpy.types.Object:
    """A curves object of S hairs: points (S, P, 3) y up, radius (S, P), colour (S, P, 3) linear."""
    data = bpy.data.hair_curves.new(f"{name} hairs")
    count, length = points.shape[:2]
    if count:
        data.add_curves([length] * count)
        x, y, z = np.moveaxis(points.reshape(-1, 3), -1, 0)
        data.position_data.foreach_set("vector", np.stack([x, -z, y], axis=1).astype(np.float32).reshape(-1))
        data.attributes.new("radius", "FLOAT", "POINT").data.foreach_set("value", radius.astype(np.float32).reshape(-1))
        painted = np.concatenate([colour.reshape(-1, 3), np.ones((count * length, 1))], axis=1).astype(np.float32)
        data.attributes.new(COLOUR, "FLOAT_COLOR", "POINT").data.foreach_set("color", painted.reshape(-1))
    data.materials.append(hair_material(name))
    thing = bpy.data.objects.new(data.name, data)
    context.collection.objects.link(thing)
    return thing


def hair_material(name: str) -> bpy.types.Material:
    """Hair in the colours of its points."""
    material = bpy.data.materials.new(f"{name} hairs")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    colours, hair, end = (
        tree.nodes.new(kind)
        for kind in ("ShaderNodeAttribute", "ShaderNodeBsdfHairPrincipled", "ShaderNodeOutputMaterial")
    )
    colours.attribute_name = COLOUR
    hair.parametrization = "COLOR"
    tree.links.new(colours.outputs["Color"], hair.inputs["Color"])
    tree.links.new(hair.outputs[0], end.inputs["Surface"])
    return material
