"""The installed `furbake`, and what it is told."""

from __future__ import annotations

import shlex
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Protocol

from .job import JobError, answer

INSTALL = "install it with: pip install ./baker, in a clone of furbake; then name it in the preferences of this add-on"

PRESETS = ("paper", "bunny", "fox", "wolf", "sheep", "teddy", "mole")
"""Names that the panel offers; the files of other presets may be named, too."""

OWN = "PRESET"
"""Choice of the panel that leaves a value to the preset."""


class Chosen(Protocol):
    """Choices of the panel."""

    preset: str
    size: str
    basis: str
    states: str
    dirt: bool
    length: float
    follow: int
    seed: int
    more: str


def found(path: str) -> str:
    """The command that preferences name, or the one on the PATH. Raises JobError where it is none or another one."""
    name = path.strip() or "furbake"
    command = shutil.which(name)
    if command is None:
        raise JobError(f"{name}: no such command, {INSTALL}")
    # It starts in another folder than Blender's.
    command = str(Path(command).absolute())
    said = answer([command, "--version"])
    if not any(line.startswith("furbake ") for line in said):
        got = said[-1] if said else "no answer"
        raise JobError(f"{command} --version: got {got}, expected the command furbake")
    return command


def placed(word: str, place: Callable[[str], str]) -> str:
    """A word of a command line with its path as the command finds it; place : makes paths whole."""
    option, equals, value = word.partition("=")
    return f"{option}={place(value)}" if equals and option.startswith("--") else place(word)


def arguments(
    chosen: Chosen, body: Path, groom: Path | None, folder: Path, place: Callable[[str], str] = str
) -> list[str]:
    """Arguments of a bake; place : makes paths whole that begin with Blender's `//`.

    Raises JobError for further options whose quotes do not close.
    """
    given = [
        "bake",
        str(body),
        "-o",
        str(folder),
        "--force",
        "--json",
        "--percent",
        "--preset",
        place(chosen.preset) or PRESETS[0],
    ]
    for option, value in (("--size", chosen.size), ("--basis", chosen.basis), ("--states", chosen.states)):
        if value not in {"", OWN}:
            given += [option, value]
    if chosen.dirt:
        given.append("--dirt")
    if chosen.seed:
        given += ["--seed", str(chosen.seed)]
    if groom is not None:
        given += ["--groom", str(groom)]
        if chosen.follow >= 0:
            given += ["--follow", str(chosen.follow)]
    elif chosen.length > 0:
        given += ["--length", f"{chosen.length:g}"]
    try:
        return given + [placed(word, place) for word in shlex.split(chosen.more)]
    except ValueError as error:
        raise JobError(f"more options: got {chosen.more}, expected quotes that close") from error
