"""“Bake fur”: the body and its hairs are written, furbake runs beside Blender, and what it says is shown."""

from __future__ import annotations

import json
import os
import shutil
import time
from pathlib import Path
from tempfile import mkdtemp

import bpy

from .body import write_body
from .command import arguments, found
from .hairs import check_hairs, write_hairs
from .job import Job, JobError
from .settings import baked_folder, preferred_command

STEP = 0.2
"""Seconds between two looks at the command."""


class Baking:
    """A bake on its way: its files, its command.

    thing : name of the object; notes : for the artist
    """

    def __init__(self, context: bpy.types.Context, thing: bpy.types.Object) -> None:
        """Write the files and start the command. Raises JobError where anything is missing."""
        chosen, command = thing.furbake, found(preferred_command(context))
        self.thing, self.folder = thing.name, baked_folder(thing)
        self._scratch = Path(mkdtemp(prefix="furbake-")).resolve()
        try:
            body = self._scratch / f"{self.folder.name}.glb"
            self._named = {str(body): thing.name}
            self.notes = write_body(
                context, thing, body, length=chosen.length_group, mask=chosen.mask_group, clips=chosen.clips
            )
            groom = self._groom(context, thing) if chosen.hairs else None
            if (unit := context.scene.unit_settings.scale_length) != 1:
                self.notes.append(f"lengths are Blender units, {unit:g} m each by the scene's Unit Scale")
            given = arguments(chosen, body, groom, self.folder, bpy.path.abspath)
            # Paths in the options may begin at the .blend file.
            home = Path(bpy.data.filepath).parent if bpy.data.filepath else self._scratch
            self.job = Job([command, *given], home)
        except BaseException:
            self.clear()
            raise

    def _groom(self, context: bpy.types.Context, thing: bpy.types.Object) -> Path | None:
        """The file of the object's hairs; None where it has none."""
        here, notes = check_hairs(context, thing)
        self.notes += notes
        if not here:
            return None
        path = self._scratch / "hairs.npz"
        self._named[str(path)] = f"hairs of {thing.name}"
        self.notes += write_hairs(context, thing, path)
        return path

    def result(self) -> str:
        """Wait for the command, clear up, and say what it made. Raises JobError where it failed or was cancelled."""
        try:
            return summary(self.job.result())
        except JobError as error:
            raise JobError(self._plain(str(error))) from error
        finally:
            self.notes += map(self._plain, self.job.notes)
            self.clear()

    def _plain(self, text: str) -> str:
        """A message whose files are things of the artist's, not those that were written for the command."""
        for path, name in self._named.items():
            text = text.replace(path, name)
        return text.replace(f"{self._scratch}{os.sep}", "")

    def clear(self) -> None:
        shutil.rmtree(self._scratch, ignore_errors=True)


def summary(record: str) -> str:
    """A bake in a line; record : what `furbake bake --json` prints."""
    found = json.loads(record)
    size, seconds = sum(found["asset"]["bytes"].values()), sum(found["seconds"].values())
    options = found["options"]
    return f"{options['layers']} layers of {options['size']} x {options['size']}, {size / 1e6:.2f} MB, {seconds:.0f} s"


class State:
    """The bake that runs, and what the last ones said."""

    baking: Baking | None = None
    told: dict[str, list[str]] = {}  # noqa: RUF012 — one for Blender as a whole
    """Lines for the panel by the object's name, errors first."""


class FURBAKE_OT_bake(bpy.types.Operator):  # noqa: N801 — Blender's way
    """Bake fur for this object with furbake, beside Blender"""

    bl_idname = "furbake.bake"
    bl_label = "Bake fur"

    _timer = None

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return State.baking is None and context.object is not None and context.object.type == "MESH"

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Bake and wait: the way of scripts."""
        if not self._start(context):
            return {"CANCELLED"}
        while State.baking and State.baking.job.running:
            time.sleep(STEP)
        return self._finish()

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        """Bake while Blender goes on."""
        if not self._start(context):
            return {"CANCELLED"}
        self._timer = context.window_manager.event_timer_add(STEP, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        for area in (area for window in context.window_manager.windows for area in window.screen.areas):
            if area.type == "PROPERTIES":
                area.tag_redraw()
        if State.baking and State.baking.job.running:
            return {"PASS_THROUGH"}
        context.window_manager.event_timer_remove(self._timer)
        return self._finish()

    def cancel(self, _context: bpy.types.Context) -> None:
        """Blender closes, or reads another file."""
        stop()

    def _start(self, context: bpy.types.Context) -> bool:
        thing = context.object
        try:
            State.baking = Baking(context, thing)
        except (JobError, RuntimeError, OSError) as error:  # Blender's own operators raise RuntimeError
            self._tell(thing.name, [f"Error: {error}".strip()])
            self.report({"ERROR"}, str(error).strip())
            return False
        State.told[thing.name] = []
        return True

    def _finish(self) -> set[str]:
        baking, State.baking = State.baking, None
        if baking is None:
            return {"CANCELLED"}
        try:
            last = baking.result()
        except JobError as error:
            self._tell(baking.thing, [f"Error: {error}", *baking.notes])
            self.report({"WARNING" if baking.job.cancelled else "ERROR"}, str(error))
            return {"CANCELLED"}
        self._tell(baking.thing, [last, *baking.notes])
        self.report({"INFO"}, last)
        return {"FINISHED"}

    @staticmethod
    def _tell(name: str, lines: list[str]) -> None:
        State.told[name] = lines
        for line in lines:
            print(f"furbake: {line}")  # noqa: T201 — the console has what the panel cuts off


class FURBAKE_OT_cancel(bpy.types.Operator):  # noqa: N801
    """Stop the bake; nothing is written"""

    bl_idname = "furbake.cancel"
    bl_label = "Cancel"

    @classmethod
    def poll(cls, _context: bpy.types.Context) -> bool:
        return State.baking is not None

    def execute(self, _context: bpy.types.Context) -> set[str]:
        if State.baking:
            State.baking.job.cancel()
        return {"FINISHED"}


def stop() -> None:
    """End the bake that runs, if any, and what it has begun."""
    if State.baking:
        State.baking.job.cancel()
        State.baking.clear()
        State.baking = None
