"""Regions: parts of a body with a fur of their own, from a TOML file of one table each.

[mane]
near = [[0.0, 0.9, 0.35, 0.3]]
preset = "wolf"
length = 0.12
tip = [0.45, 0.2, 0.06]

The rest of the body is the coat, in the fur of the bake itself.
"""

from __future__ import annotations

import math
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from furbake.options import knobs
from furbake.options.bake_options import OF_VERTICES, BakeOptions
from furbake.options.knobs import KNOBS, LENGTH, OptionError
from furbake.options.presets import preset, with_knobs
from furbake.surface.files import read_regular
from furbake.surface.limits import Budget
from furbake.surface.soup import MeshError

COAT = "coat"
"""Name of the rest of the body."""

MAX_REGIONS = 3
"""Regions beside the coat: each has its own numbers in the shaders."""

PLACES = ("mask", "material", "near")
"""Keys that say where a region is: one of them."""

COLOURS = ("root", "tip", "tip2")

KEYS = (*PLACES, "preset", "length", "density", "border", *COLOURS, "set")
"""Keys of a region's table."""

OWN = ("seed", "tile_share", "sweep", "length_noise", "tip_noise", "belly")
"""Options beside hairs and colours that a region's preset sets; all others are the coat's."""

MAX_BALLS = 64

DENSITY = knobs.Knob("number", 0.1, 8.0)

Ball = tuple[float, float, float, float]


@dataclass(frozen=True)
class Region:
    """Part of a body with a fur of its own.

    options : of its fur; layers, size and all that pelts of one body share are the coat's
    mask : path of a picture over the model's texture coordinates, or `vertex:` + channel or attribute; or None
    material : name of the material that covers it, or None
    near : balls (x, y, z, radius), model units: 1 at the middle of a ball, 0 beyond it; or ()
    border : width of its soft edge, model units; None: a third of the coat's tile
    """

    name: str
    options: BakeOptions
    mask: str | None = None
    material: str | None = None
    near: tuple[Ball, ...] = ()
    border: float | None = None


def read_regions(path: str, coat: BakeOptions) -> tuple[Region, ...]:
    """Regions of a TOML file. Raises OptionError with one sentence for whatever is wrong in it.

    coat : options of the bake, of which a region keeps all that it does not change
    """
    label = f"regions: {Path(path).name}"
    try:
        table = _table(path)
        if not 1 <= len(table) <= MAX_REGIONS:
            raise OptionError(f"got {len(table)} regions, expected 1 to {MAX_REGIONS} beside the coat")
        return tuple(_region(name, entry, Path(path).parent, coat) for name, entry in table.items())
    except OptionError as error:
        raise OptionError(f"{label}: {error}") from None


def region_files(path: str) -> list[str]:
    """Pictures and presets that a file of regions names, as paths; [] where it cannot be read."""
    try:
        entries = [entry for entry in _table(path).values() if isinstance(entry, dict)]
    except OptionError:
        return []
    named = [entry.get("mask") for entry in entries] + [entry.get("preset") for entry in entries]
    files = [name for name in named if isinstance(name, str) and not name.startswith(OF_VERTICES)]
    return [str(Path(path).parent / name) for name in files if name.endswith((".png", ".toml"))]


def _table(path: str) -> dict[str, Any]:
    try:
        return tomllib.loads(read_regular(Path(path), Budget(path, "bytes")).decode())
    except OSError as error:
        why = (error.strerror or str(error)).lower()
        raise OptionError(f"got {path!r} ({why}), expected a .toml file with a table for each region") from None
    except MeshError as error:
        raise OptionError(str(error)) from None
    except (ValueError, RecursionError) as error:
        detail = "too deeply nested" if isinstance(error, RecursionError) else str(error)
        raise OptionError(f"got no valid TOML ({detail}), expected a table such as [mane] for each region") from None


def _region(name: str, entry: Any, folder: Path, coat: BakeOptions) -> Region:
    if not isinstance(entry, Mapping):
        raise OptionError(f"{name}: got {knobs.show(entry)}, expected a table such as [mane]")
    if name == COAT:
        raise OptionError(f"{COAT}: got a table, expected other names: the coat is the rest, in the fur of the bake")
    unknown = [key for key in entry if key not in KEYS]
    if unknown:
        raise OptionError(f"{name}.{unknown[0]}: got an unknown key, expected one of {', '.join(KEYS)}")
    places = [key for key in PLACES if key in entry]
    if len(places) != 1:
        raise OptionError(f"{name}: got {' and '.join(places) or 'no place'}, expected one of {', '.join(PLACES)}")
    options = _options(name, entry, folder, coat)
    try:
        return Region(
            name,
            options,
            mask=_mask(entry, folder),
            material=_text("material", entry),
            near=_balls(entry),
            border=_length("border", entry),
        )
    except OptionError as error:
        raise OptionError(f"{name}: {error}") from None


def _options(name: str, entry: Mapping[str, Any], folder: Path, coat: BakeOptions) -> BakeOptions:
    """Options of a region's fur: its preset's, or the coat's, with the changes of its table."""
    options = coat
    try:
        if (worn := _text("preset", entry)) is not None:
            found = preset(str(folder / worn) if worn.endswith(".toml") else worn, coat.own_colours)
            options = replace(coat, **{key: getattr(found, key) for key in ("preset", "coat", "ramp", *OWN)})
            options = replace(options, length=None, tile=None, height=None, height_share=found.height_share)
        table = entry.get("set", {})
        if not isinstance(table, Mapping):
            raise OptionError(f"set: got {knobs.show(table)}, expected a table of knobs")
        values = knobs.read(table)
        for key in values:
            if not key.startswith(("coat.", "ramp.")) and key not in (*OWN, "height"):
                raise OptionError(f"set.{key}: is the same on the whole body, expected a knob of hairs or colours")
        values |= {f"ramp.{key}": KNOBS[f"ramp.{key}"].take(key, entry[key]) for key in COLOURS if key in entry}
        options = with_knobs(options, values)
        if (length := _length("length", entry)) is not None:
            options = replace(options, length=length, tile=None)
        if "density" in entry:
            options = _denser(options, DENSITY.take("density", entry["density"]))
        options.check()
    except OptionError as error:
        raise OptionError(f"{name}: {error}") from None
    return options


def _denser(options: BakeOptions, density: float) -> BakeOptions:
    """The same fur with more hairs, or fewer."""
    coat = options.coat
    guard, under = (replace(hairs, count=round(density * hairs.count)) for hairs in (coat.guard, coat.under))
    return replace(options, coat=replace(coat, guard=guard, under=under))


def _mask(entry: Mapping[str, Any], folder: Path) -> str | None:
    mask = _text("mask", entry)
    return mask if mask is None or mask.startswith(OF_VERTICES) else str(folder / mask)


def _text(key: str, entry: Mapping[str, Any]) -> str | None:
    value = entry.get(key)
    if value is not None and (not isinstance(value, str) or not value):
        raise OptionError(f"{key}: got {knobs.show(value)}, expected a text")
    return value


def _length(key: str, entry: Mapping[str, Any]) -> float | None:
    return None if key not in entry else float(LENGTH.take(key, entry[key]))


def _balls(entry: Mapping[str, Any]) -> tuple[Ball, ...]:
    balls = entry.get("near", [])
    expected = "near: got {}, expected balls [x, y, z, radius] with a radius above 0"
    if not isinstance(balls, list) or ("near" in entry and not 1 <= len(balls) <= MAX_BALLS):
        raise OptionError(expected.format(knobs.show(balls)))
    for ball in balls:
        numbers = isinstance(ball, list) and len(ball) == 4 and all(type(part) in (int, float) for part in ball)
        if not numbers or not all(map(math.isfinite, ball)) or ball[3] <= 0:
            raise OptionError(expected.format(knobs.show(ball)))
    return tuple((float(x), float(y), float(z), float(radius)) for x, y, z, radius in balls)
