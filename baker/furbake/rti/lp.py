"""Lists of photographs and their lamps, `.lp`: a count, then a file and a direction on each line.

Such files are made by hand and on other machines: names have spaces and folders of Windows, counts are wrong.
"""

from __future__ import annotations

import codecs
import math
import os
import re
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from furbake.rti.ptm import GREATEST, read_bytes
from furbake.rti.relit import Array, RtiError
from furbake.surface.files import beside, nearby

COMMENT = ("#", ";", "//")

EXPORTS = "jpeg-exports"
"""Folder in which RTIBuilder keeps photographs, beside the one of its lists."""

MOST = 10_000
"""Photographs of one list."""


@dataclass(frozen=True)
class Lamps:
    """names : of the photographs, as the list has them; lights : (n, 3) unit vectors towards the lamp, lv up."""

    names: tuple[str, ...]
    lights: Array
    notices: tuple[str, ...] = ()


def read_lp(path: Path) -> Lamps:
    """The list in a file. Raises RtiError."""
    data = read_bytes(path)
    try:
        text = data.decode("utf-16" if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)) else "utf-8-sig")
    except UnicodeDecodeError:
        text = data.decode("cp1252", "replace")
    return parse_lp(text, str(path))


def parse_lp(text: str, name: str) -> Lamps:
    """The list in the text of a file of that name. Raises RtiError."""
    lines = [(i, line.strip()) for i, line in enumerate(text.splitlines(), 1)]
    lines = [(i, line) for i, line in lines if line and not line.startswith(COMMENT)]
    if not lines:
        raise RtiError(f"{name}: no line, expected the number of photographs, then NAME X Y Z for each")
    first, words = lines[0]
    if not re.fullmatch(r"\d{1,9}", words):
        raise RtiError(f"{name}: line {first} is {_short(words)}, expected the number of photographs")
    count, entries = int(words), lines[1:]
    if not entries or len(entries) > MOST:
        raise RtiError(f"{name}: {len(entries)} photographs, expected 1 to {MOST}")
    names, lights = zip(*(_entry(line, i, name) for i, line in entries), strict=True)
    notices = (
        () if count == len(names) else (f"{name}: says {count} photographs and lists {len(names)}: all are taken",)
    )
    return Lamps(names, np.array(lights), notices)


def _entry(line: str, number: int, name: str) -> tuple[str, Array]:
    """Name and direction on a line."""
    *own, x, y, z = ["", "", "", *line.rsplit(maxsplit=3)][-4:]
    what = f"{name}: line {number} is {_short(line)}, expected NAME X Y Z"
    try:
        light = np.array([float(axis.replace(",", ".")) for axis in (x, y, z)])
    except ValueError:
        raise RtiError(what) from None
    photograph = own[0].strip().strip("\"'")
    if not photograph or "\0" in photograph:
        raise RtiError(f"{what}, with the photograph's name")
    length = math.hypot(*light)
    if not 1 / GREATEST < length < GREATEST:
        raise RtiError(f"{what}, with a direction to the lamp")
    return photograph, light / length


def find(path: Path, name: str) -> Path | None:
    """The photograph of that name beside the list at `path`, or where RTIBuilder keeps it; None where there is none."""
    for near in nearby(name):
        try:
            place = beside(path, near)
            if place.is_file():
                return place
        except (OSError, ValueError):
            continue
    wanted = nearby(name)[-1].casefold()  # Windows takes another case for the same name
    for folder in (path.parent, path.parent / EXPORTS, Path(os.path.realpath(path.parent)).parent / EXPORTS):
        with suppress(OSError):
            for entry in sorted(folder.iterdir()):
                if wanted in (entry.name.casefold(), _latin(entry.name).casefold()):
                    return entry
    return None


def _latin(name: str) -> str:
    """A name whose bytes are no UTF-8, as archives of Windows leave it."""
    return os.fsencode(name).decode("cp1252", "replace")


def _short(line: str) -> str:
    return repr(line if len(line) <= 60 else f"{line[:57]}...")
