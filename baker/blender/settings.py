"""Choices for the fur of an object, and preferences of the add-on."""

from __future__ import annotations

from pathlib import Path

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty

from .command import OWN, PRESETS
from .job import JobError

AS_PRESET = (OWN, "As the preset", "")

BESIDE = {"PATH_SUPPORTS_BLEND_RELATIVE"} if bpy.app.version >= (4, 5, 0) else set()
"""Option of paths that may begin with `//`; Blender 4.4 and older knows none and takes all of them."""


def _choices(*names: str) -> list[tuple[str, str, str]]:
    return [AS_PRESET, *((name, name, "") for name in names)]


def _presets(_settings: object, _context: object, typed: str) -> list[str]:
    return [name for name in PRESETS if typed.lower() in name]


class FurSettings(bpy.types.PropertyGroup):
    """How the fur of an object is baked."""

    folder: StringProperty(
        name="Folder",
        subtype="DIR_PATH",
        options=BESIDE,
        description="Where the bake goes, beside the .blend file. Empty: fur-NAME",
    )
    preset: StringProperty(
        name="Preset",
        default="bunny",
        search=_presets,
        search_options={"SUGGESTION"},
        description="A preset of furbake by name, or a .toml file",
    )
    size: EnumProperty(
        name="Size",
        items=_choices("32", "64", "128", "256"),
        description="Texels per side of a slab: finer hairs, and four times the bytes each step",
    )
    basis: EnumProperty(
        name="Basis",
        items=_choices("ptm", "eigen"),
        description="How light is stored: the article's polynomial, or curves found for this fur",
    )
    states: EnumProperty(
        name="States",
        items=[(OWN, "Dry", "One state"), ("dry..wet", "Dry to wet", "Five states, for rain")],
        description="States of wetness",
    )
    dirt: BoolProperty(name="Dirt", description="A dirty state too")
    length: FloatProperty(
        name="Length", min=0.0, unit="LENGTH", description="Longest fur of a preset. 0: by the body's thickness"
    )
    follow: IntProperty(
        name="Fill in",
        min=-1,
        default=-1,
        description="Hairs grown beside each hair. -1: as many as cover the skin",
    )
    length_group: StringProperty(name="Length", description="Vertex group: share of the longest fur")
    mask_group: StringProperty(name="Mask", description="Vertex group: where fur grows")
    hairs: BoolProperty(
        name="From its hairs",
        default=True,
        description="Curves that grow on the object, and its particle hair, become the fur",
    )
    clips: BoolProperty(name="Animation", default=True, description="Actions come along as clips")
    seed: IntProperty(name="Seed", min=0, description="Seed of all chance")
    more: StringProperty(
        name="More", description="Further options of furbake bake, such as --layers 24 --max-faces 20000"
    )


class FurPreferences(bpy.types.AddonPreferences):
    """Where furbake is."""

    bl_idname = __package__

    command: StringProperty(
        name="furbake", subtype="FILE_PATH", description="The command furbake. Empty: the one on the PATH"
    )

    def draw(self, _context: bpy.types.Context) -> None:
        self.layout.prop(self, "command")


def preferred_command(context: bpy.types.Context) -> str:
    """The command that the preferences name; empty where the add-on runs without any."""
    addon = context.preferences.addons.get(__package__)
    return addon.preferences.command if addon else ""


def baked_folder(thing: bpy.types.Object) -> Path:
    """Where the bake of an object goes. Raises JobError where neither a folder nor a .blend file says so."""
    named = thing.furbake.folder.strip()
    beside = named.startswith("//") or not (Path(named).is_absolute() or named.startswith("/"))
    if beside and not bpy.data.filepath:
        got = f"{named or 'none'} and an unsaved file"
        raise JobError(f"Folder: got {got}, expected a whole path, or a .blend file to put it beside")
    name = "".join(each if each.isalnum() or each in "-_" else "-" for each in thing.name)
    place = named.removeprefix("//") or f"fur-{name}"
    return Path(bpy.path.abspath(f"//{place}")) if beside else Path(named)
