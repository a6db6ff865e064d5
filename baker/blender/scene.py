"""The scene as the exporters need it, and as it was again afterwards."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import bpy


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
def hidden(things: list[bpy.types.Object]) -> Iterator[None]:
    """Objects that are not evaluated: thousands of hairs would be, for every frame of every clip."""
    before = [(each, each.hide_viewport) for each in things]
    for each in things:
        each.hide_viewport = True
    try:
        yield
    finally:
        for each, was in before:
            each.hide_viewport = was
