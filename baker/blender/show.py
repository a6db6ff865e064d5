"""“Open in browser”: a baked folder on a page of this computer."""

from __future__ import annotations

import webbrowser
from pathlib import Path

import bpy

from .job import JobError
from .serve import PAGE, VIEWER, Server
from .settings import baked_folder


class Shown:
    """The server, from the first look on."""

    server: Server | None = None


def address(folder: Path) -> str:
    """Address of a page that shows a baked folder. Raises JobError where there is none, or no viewer."""
    if not (folder / "model.gltf").is_file():
        raise JobError(f"{folder}: no model.gltf, expected a baked folder: bake first")
    if not (PAGE / VIEWER).is_file():
        raise JobError(f"{VIEWER}: not in this copy of the add-on, expected its zip: npm run blender makes one")
    Shown.server = Shown.server or Server()
    return Shown.server.show(folder)


def close() -> None:
    """Stop the server."""
    if Shown.server:
        Shown.server.close()
    Shown.server = None


class FURBAKE_OT_open(bpy.types.Operator):  # noqa: N801
    """Show the baked fur in the browser, under a lamp that follows the mouse"""

    bl_idname = "furbake.open"
    bl_label = "Open in browser"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return context.object is not None and context.object.type == "MESH"

    def execute(self, context: bpy.types.Context) -> set[str]:
        try:
            webbrowser.open(address(baked_folder(context.object)))
        except (JobError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}
