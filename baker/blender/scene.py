"""The scene as the exporters need it, and as it was again afterwards."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import AbstractContextManager, contextmanager
from typing import Any

import bpy

FINE = {
    "SUBSURF": ("levels", "render_levels"), "MULTIRES": ("levels", "render_levels"), "SCREW": ("steps", "render_steps"),
    "OCEAN": ("viewport_resolution", "resolution"),
}  # fmt: skip
"""Modifiers that are finer when they are rendered: the property of the viewport, and that of the render."""


def armatures(thing: bpy.types.Object) -> list[bpy.types.Object]:
    """The armatures that move an object: of its modifiers and above it."""
    found = [each.object for each in thing.modifiers if each.type == "ARMATURE" and each.object]
    above = thing.parent
    while above is not None:
        if above.type == "ARMATURE":
            found.append(above)
        above = above.parent
    return list(dict.fromkeys(found))


@contextmanager
def at_rest(context: bpy.types.Context, thing: bpy.types.Object) -> Iterator[None]:
    """A body in object mode, its armatures in their rest position and its shape keys at the basis."""
    active, chosen = context.view_layer.objects.active, context.selected_objects
    mode = active.mode if active else "OBJECT"
    if mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    poses = [(each.data, each.data.pose_position) for each in armatures(thing)]
    pinned, key = thing.show_only_shape_key, thing.active_shape_key_index
    for data, _ in poses:
        data.pose_position = "REST"
    if thing.data.shape_keys:
        thing.show_only_shape_key, thing.active_shape_key_index = True, 0
    context.view_layer.update()
    try:
        yield
    finally:
        for data, position in poses:
            data.pose_position = position
        thing.show_only_shape_key, thing.active_shape_key_index = pinned, key
        for each in context.selected_objects:
            each.select_set(False)
        for each in chosen:
            each.select_set(True)
        context.view_layer.objects.active = active
        if mode != "OBJECT":
            bpy.ops.object.mode_set(mode=mode)
        context.view_layer.update()


@contextmanager
def a_copy(context: bpy.types.Context, thing: bpy.types.Object, *, deep: bool) -> Iterator[bpy.types.Object]:
    """A copy of an object in a collection of its own, which goes with it; deep : with data of its own."""
    home = bpy.data.collections.new("furbake")
    context.scene.collection.children.link(home)
    copy = thing.copy()
    data = copy.data
    if deep:
        copy.data = data = data.copy()
    home.objects.link(copy)
    try:
        yield copy
    finally:
        bpy.data.objects.remove(copy)
        if deep:
            bpy.data.batch_remove([data])
        bpy.data.collections.remove(home)


@contextmanager
def changed(values: Iterable[tuple[Any, str, Any]]) -> Iterator[None]:
    """Other values of Blender's properties for a while; values : owner, property and value of each."""
    before = []
    try:
        for owner, name, value in values:
            if (old := getattr(owner, name)) != value:
                before.append((owner, name, old))
                setattr(owner, name, value)
        yield
    finally:
        for owner, name, old in reversed(before):
            setattr(owner, name, old)


def hidden(things: list[bpy.types.Object]) -> AbstractContextManager[None]:
    """Objects that are not evaluated: thousands of hairs would be, for every frame of every clip."""
    return changed((each, "hide_viewport", True) for each in things)


def rendered(context: bpy.types.Context, thing: bpy.types.Object) -> AbstractContextManager[None]:
    """An object whose modifiers stand in the viewport as they are rendered: which of them, and how fine.

    Particles stay as they are, as they do not shape the mesh.
    """
    shaping = [each for each in thing.modifiers if each.type != "PARTICLE_SYSTEM"]
    values: list[tuple[Any, str, Any]] = [(each, "show_viewport", each.show_render) for each in shaping]
    for each in shaping:
        if each.type in FINE:
            seen, wanted = FINE[each.type]
            values.append((each, seen, getattr(each, wanted)))
    settings = context.scene.render
    simplified = ("simplify_subdivision", "simplify_child_particles")
    values += [(settings, name, getattr(settings, f"{name}_render")) for name in simplified]
    return changed(values)
