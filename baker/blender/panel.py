"""The panel in the object's properties, and the entry of the import menu."""

from __future__ import annotations

import textwrap
from typing import Any

import bpy

from .bake import FURBAKE_OT_bake, FURBAKE_OT_cancel, State
from .hairs import sources
from .show import FURBAKE_OT_open
from .take import FURBAKE_OT_take

WIDE = 60
"""Characters of a line in the panel."""


class FURBAKE_PT_fur(bpy.types.Panel):  # noqa: N801 — Blender's way
    """Fur of the object."""

    bl_label = "Fur"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "object"
    bl_options = {"DEFAULT_CLOSED"}  # noqa: RUF012

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return context.object is not None and context.object.type == "MESH"

    def draw(self, context: bpy.types.Context) -> None:
        thing, layout = context.object, self.layout
        chosen = thing.furbake
        layout.use_property_split = True
        layout.use_property_decorate = False
        for name in ("folder", "preset", "size", "basis", "states", "dirt"):
            layout.prop(chosen, name)
        layout.prop(chosen, "hairs")
        if chosen.hairs and any(sources(thing)):
            layout.prop(chosen, "follow")
        else:
            layout.prop(chosen, "length")
        layout.prop_search(chosen, "length_group", thing, "vertex_groups", text="Length group")
        layout.prop_search(chosen, "mask_group", thing, "vertex_groups", text="Mask group")
        for name in ("clips", "seed", "more"):
            layout.prop(chosen, name)
        self._actions(thing.name, layout)

    @staticmethod
    def _actions(name: str, layout: Any) -> None:
        baking = State.baking
        if baking is None:
            layout.operator(FURBAKE_OT_bake.bl_idname, icon="RENDER_STILL")
        else:
            job = baking.job
            layout.progress(factor=job.percent / 100, text=f"{baking.thing}: {job.stage} {job.percent} %", type="BAR")
            layout.operator(FURBAKE_OT_cancel.bl_idname, icon="X")
        layout.operator(FURBAKE_OT_open.bl_idname, icon="URL")
        for line in State.told.get(name, []):
            wrong = line.startswith("Error: ")
            for number, part in enumerate(textwrap.wrap(line, WIDE)):
                layout.label(text=part, icon="NONE" if number else "ERROR" if wrong else "INFO")


def import_entry(menu: bpy.types.Menu, _context: bpy.types.Context) -> None:
    """The entry of File, Import."""
    menu.layout.operator(FURBAKE_OT_take.bl_idname)
