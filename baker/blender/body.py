"""The body as a GLB: mesh, materials, armature, shape keys, clips, and vertex groups as length and mask of the fur."""

from __future__ import annotations

from pathlib import Path

import bpy
import numpy as np

from .hairs import sources
from .job import JobError
from .scene import a_copy, armatures, at_rest, hidden, rendered

LENGTH, MASK = "_LENGTH", "_MASK"
"""Attributes of the vertices that furbake reads: share of the longest fur, and where fur grows."""


def write_body(
    context: bpy.types.Context, thing: bpy.types.Object, path: Path, *, length: str = "", mask: str = "", clips: bool
) -> list[str]:
    """Write a mesh object as it is rendered, y up, in Blender units; notes for the artist.

    length, mask : names of vertex groups; clips : whether actions come along

    Raises JobError where a group is missing or the mesh has no face.
    """
    for group in filter(None, (length, mask)):
        if group not in thing.vertex_groups:
            raise JobError(f"{thing.name}: no vertex group {group}, expected one of its own")
    notes = []
    with (
        hidden(sources(thing)[0]), at_rest(context, thing), rendered(context, thing),
        a_copy(context, thing, deep=True) as copy,
    ):  # fmt: skip
        for name, group in ((LENGTH, length), (MASK, mask)):
            if group:
                paint(copy, name, group)
        kept = copy.data.shape_keys is not None
        shaping = [each for each in copy.modifiers if each.type not in {"ARMATURE", "PARTICLE_SYSTEM"}]
        others = [each.name for each in shaping if each.show_render]
        if kept and others:
            notes.append(f"left out, as the mesh has shape keys: modifiers {', '.join(others)}")
        if not copy.data.polygons and not others:
            raise JobError(f"{thing.name}: no faces, expected a mesh that fur can grow on")
        copy.show_only_shape_key = False
        home = copy.users_collection[0]
        for each in armatures(thing):
            home.objects.link(each)
        bpy.ops.export_scene.gltf(
            filepath=str(path), check_existing=False, export_format="GLB", collection=home.name,
            export_apply=not kept, export_attributes=True, export_yup=True, export_extras=False,
            export_animations=clips, export_animation_mode="ACTIONS", export_skins=True, export_morph=True,
            export_morph_normal=False, export_cameras=False, export_lights=False,
        )  # fmt: skip
    if not path.exists():
        raise JobError(f"{thing.name}: Blender's glTF exporter wrote nothing, expected a mesh that it can write")
    return notes


def paint(thing: bpy.types.Object, name: str, group: str) -> None:
    """Make a vertex group an attribute of the mesh."""
    index = thing.vertex_groups[group].index
    mesh = thing.data
    weights = np.zeros(len(mesh.vertices), np.float32)
    for vertex in mesh.vertices:
        for part in vertex.groups:
            if part.group == index:
                weights[vertex.index] = part.weight
    if (old := mesh.attributes.get(name)) is not None:
        mesh.attributes.remove(old)
    mesh.attributes.new(name, "FLOAT", "POINT").data.foreach_set("value", weights)
