"""Presets: options by name, or from a TOML file of knobs."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import asdict, replace
from importlib.resources import files
from pathlib import Path
from typing import Any

from furbake.options import knobs
from furbake.options.bake_options import BakeOptions, build, values_of
from furbake.options.knobs import OptionError
from furbake.surface.files import read_regular
from furbake.surface.limits import Budget
from furbake.surface.soup import MeshError


def preset_names() -> list[str]:
    """Names of the presets that come with furbake, sorted."""
    entries = (files("furbake") / "presets").iterdir()
    return sorted(entry.name.removesuffix(".toml") for entry in entries if entry.name.endswith(".toml"))


def preset(name: str | Path, own_colours: bool = False) -> BakeOptions:
    """The options that a preset sets, the rest at their defaults.

    name : of one that comes with furbake, or a path that ends in `.toml`: a file of knobs like theirs, which may begin
        with `extends = NAME` (or another file's path, seen from its own folder)
    own_colours : hairs are in the model's colours, so the preset's are without their hues

    Raises OptionError for an unknown preset, and for a knob that is unknown, of another type or out of range.
    """
    values, label = _load(str(name), ())
    options = with_knobs(BakeOptions(preset=label), values)
    return replace(options, own_colours=True, ramp=options.ramp.grey) if own_colours else options


def override(options: BakeOptions, texts: Mapping[str, str]) -> BakeOptions:
    """Options with some knobs changed: dotted name → value as text. Raises OptionError."""
    return with_knobs(options, {name: knobs.parse(name, text) for name, text in texts.items()})


def as_toml(options: BakeOptions) -> str:
    """All knobs as a preset file, which gives the same options back."""
    return knobs.write(values_of(options))


def preset_summary(name: str) -> str:
    """The first comment line of a preset's file: one sentence on what it is for."""
    text = (files("furbake") / "presets" / f"{name}.toml").read_text("utf-8")
    return text.splitlines()[0].removeprefix("#").strip()


def with_knobs(options: BakeOptions, values: Mapping[str, Any]) -> BakeOptions:
    """Options with some knobs, by dotted name, at checked values."""
    table = knobs.nest({**dict(knobs.flatten(asdict(options))), **values})
    if "height" in values:
        table |= {"height_share": values["height"], "height": None}
    return build(table)


def _load(name: str, chain: tuple[Path, ...]) -> tuple[dict[str, Any], str]:
    """Checked values of a preset by dotted name, those that it extends included, and its short name.

    chain : the files that have led here
    """
    what = "extends" if chain else "preset"
    if not name.endswith(".toml"):
        if name not in preset_names():
            raise OptionError(f"{what}: got {name!r}, expected one of {', '.join(preset_names())}, or a .toml file")
        text = (files("furbake") / "presets" / f"{name}.toml").read_text("utf-8")
        return knobs.read(tomllib.loads(text)), name
    path = Path(name)
    try:
        text, place = read_regular(path, Budget(name, "bytes")).decode(), path.resolve()
    except OSError as error:
        why = (error.strerror or str(error)).lower()
        raise OptionError(f"{what}: got {name!r} ({why}), expected a .toml file with knobs") from None
    except MeshError as error:
        raise OptionError(str(error)) from None
    except ValueError as error:
        raise OptionError(f"{what}: got {name!r} ({error}), expected a .toml file with knobs") from None
    if place in chain:
        raise OptionError(f"{what}: got a circle of files that extend each other, expected an end")
    try:
        table = tomllib.loads(text)
        base = table.pop("extends", None)
        if base is not None and not isinstance(base, str):
            raise OptionError(f"extends: got {knobs.show(base)}, expected the name of a preset or a .toml file")
        values = knobs.read(table)
        if base is not None:
            base = str(path.parent / base) if base.endswith(".toml") else base
            values = {**_load(base, (*chain, place))[0], **values}
    except OptionError as error:
        raise OptionError(f"{path.name}: {error}") from None
    except (ValueError, RecursionError) as error:
        detail = "too deeply nested" if isinstance(error, RecursionError) else str(error)
        raise OptionError(f"{path.name}: got no valid TOML ({detail}), expected lines such as layers = 16") from None
    return values, path.stem
