"""Every knob of a bake: what it means, its unit, its range, its default. The presets are data beside it."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from importlib.resources import files
from pathlib import Path
from typing import Any, Literal

from furbake import knobs
from furbake.knobs import KNOBS, OptionError
from furbake.pelt.pelt import Ramp
from furbake.pelt.states import WETNESS
from furbake.pelt.strands import Coat

__all__ = ["BakeOptions", "OptionError", "as_toml", "override", "preset", "preset_names", "preset_summary"]

BasisKind = Literal["ptm", "eigen"]
CurvesKind = Literal["slab", "none"]
Guide = Literal["nose-tail", "down"]
Uv = Literal["lapped", "own"]

FILES = ("length_map", "mask", "comb", "features")
"""Options that name files."""

OF_VERTICES = "vertex:"
"""With it `length_map` and `mask` name a channel of the vertex colours or an attribute instead."""


LATER = ("directions", "states", "dirt")
"""Options that early records do not have."""


@dataclass(frozen=True)
class BakeOptions:
    """Options of one bake. `None` for length, tile and height means: follow from the other two.

    length = height × tile; at most two of the three may be given.
    """

    preset: str = "paper"
    layers: int = 16
    """Slabs of the tile, 1 to 64."""
    size: int = 64
    """Texels per side of the tile, a power of two, 8 to 512."""
    lights: int = 64
    """Sampled light directions on the upper hemisphere, 8 to 1024."""
    basis: BasisKind = "ptm"
    coefficients: int = 6
    """Numbers per texel: 6 for ptm, 3 to 6 for eigen."""
    curves: CurvesKind = "slab"
    """Mean light of each slab, by which its numbers are multiplied, or none: version 1 of the format."""
    length: float | None = None
    """Longest fur, the model's own units, above 0."""
    tile: float | None = None
    """Width of a tile, the model's own units, above 0. Default: `tile_share` of the model's largest side."""
    height: float | None = None
    """Longest fur in tile widths, 0.02 to 4. Default: `height_share`."""
    seed: int = 0
    """Seed of all chance, 0 or above."""
    flat: bool = False
    """A flat patch under a point at infinity: for checks against other renderers."""
    guide: Guide = "nose-tail"
    """Direction in which the fur is laid."""
    sweep: float = 0.0
    """How far shells bend along the fur's direction, share of its length, 0 to 0.8, besides the lean in the tile."""
    uv: Uv = "lapped"
    """Lapped patches along the fur, or the model's own texture coordinates."""
    length_by_thickness: bool = False
    """Shorter fur where the body is thin (ears, feet)."""
    length_noise: float = 0.0
    """How much shorter fur may be from place to place, 0 to 0.9."""
    tip_noise: float = 0.0
    """How far tips turn to the ramp's second tip colour from place to place, 0 to 1."""
    belly: float = 0.0
    """How far they turn to it on the underside, 0 to 1."""
    max_faces: int = 60_000
    """Faces above which a model is simplified, 4 to 2 000 000."""
    length_map: str | None = None
    """PNG over the model's texture coordinates, or `vertex:red` of its vertices: white is full length, black none."""
    mask: str | None = None
    """The same for where fur grows: black is bare skin."""
    comb: str | None = None
    """JSON file of strokes along which the fur is laid."""
    features: str | None = None
    """JSON file of eyes, a nose and the like."""
    fins: bool = True
    """Quads on the edges that show the fur from the side, where shells are seen edge-on."""
    coat: Coat = field(default_factory=Coat)
    ramp: Ramp = field(default_factory=Ramp)
    colour_plane: bool = True
    """Store the paper's original colour of every texel as a third plane."""
    directions: bool = False
    """Store the hairs' mean direction in every texel, for renderers that compute the light themselves."""
    states: tuple[str, ...] = ("dry",)
    """States of wetness by name, dry first: some of those in `WETNESS`."""
    dirt: bool = False
    """A dirty state besides."""
    tile_share: float = 0.13
    """Default width of a tile as a share of the model's largest side, 0.001 to 10."""
    height_share: float = 0.5
    """Default height in tile widths, 0.02 to 4."""

    def check(self) -> None:
        """Raise `OptionError` for the first value that is out of range."""
        for name, value in _values(self).items():
            KNOBS[name].take(name, value)
        if self.size & (self.size - 1):
            raise OptionError(f"size: got {self.size}, expected a power of two")
        if self.basis == "ptm" and self.coefficients != 6:
            raise OptionError(
                f"coefficients: got {self.coefficients}, expected 6 for the basis ptm (eigen takes 3 to 6)"
            )
        knobs.within("max-faces", self.max_faces, 4, 2_000_000)
        for name, length in (("length", self.length), ("tile", self.tile)):
            if length is not None and not (math.isfinite(length) and length > 0):
                raise OptionError(f"{name}: got {length:g}, expected a length above 0")
        if None not in (self.length, self.tile, self.height):
            raise OptionError(
                "length: got length, tile and height, expected at most two of them (length = height × tile)"
            )
        known = list(WETNESS)
        if self.states[:1] != ("dry",) or self.states != tuple(name for name in known if name in self.states):
            expected = f"dry..wet, or dry and then some of {', '.join(known[1:])}"
            raise OptionError(f"states: got {','.join(self.states)}, expected {expected}")
        if self.dirt and self.coefficients < 4:
            raise OptionError("dirt: got 3 coefficients, which leave no room for the share of mud, expected 4 to 6")
        hairs = self.coat.guard.count + self.coat.under.count
        knobs.within("coat.guard.count + coat.under.count", hairs, 1, 20_000)

    @property
    def own_height(self) -> float:
        """Longest fur in tile widths, where no body's length has a say in it."""
        return self.height if self.height is not None else self.height_share

    def dimensions(self, extent: float) -> tuple[float, float]:
        """(tile, length) in the model's units, for a model whose largest side is `extent`.

        Raises OptionError when length and tile together give a height out of range.
        """
        height = self.own_height
        if self.length is not None and self.tile is not None:
            knobs.within("height (length / tile)", self.length / self.tile, 0.02, 4)
            return self.tile, self.length
        if self.length is not None:
            return self.length / height, self.length
        tile = self.tile if self.tile is not None else self.tile_share * extent
        return tile, height * tile

    def as_record(self) -> dict[str, Any]:
        """Plain data, for bake.json. Of `LATER` only what is used is in it: other records stay what they were."""
        unused = {name for name in LATER if getattr(self, name) == getattr(BakeOptions, name)}
        return {name: value for name, value in asdict(self).items() if name not in unused}

    @classmethod
    def from_record(cls, record: dict[str, Any]) -> BakeOptions:
        """The options that `as_record` wrote, JSON's lists and all; older ones know no curves.

        Raises OptionError for anything else.
        """
        try:
            options = _build({"curves": "none", **record})
            options.check()
        except (TypeError, ValueError, AttributeError, KeyError) as error:
            raise OptionError(
                f"options: got a record that is not understood ({error}), expected one of bake.json"
            ) from None
        return options


def _values(options: BakeOptions) -> dict[str, Any]:
    """All knobs by dotted name. A preset's `height` is the default one; a given height takes its place."""
    values = dict(knobs.flatten(asdict(options)))
    values["height"] = options.own_height
    return {name: values[name] for name in KNOBS}


def _build(table: Mapping[str, Any]) -> BakeOptions:
    """Options from nested tables and lists; what they don't name is at its default."""
    coat = dict(table.get("coat", {}))
    defaults = Coat()
    for kind in ("guard", "under"):
        coat[kind] = replace(getattr(defaults, kind), **_tuples(coat.get(kind, {})))
    built = {"coat": Coat(**_tuples(coat)), "ramp": Ramp(**_tuples(table.get("ramp", {})))}
    return BakeOptions(**{**_tuples(table), **built})


def _tuples(table: Mapping[str, Any]) -> dict[str, Any]:
    return {key: tuple(value) if isinstance(value, list) else value for key, value in table.items()}


def preset_names() -> list[str]:
    """Names of the presets that come with furbake, sorted."""
    entries = (files("furbake") / "presets").iterdir()
    return sorted(entry.name.removesuffix(".toml") for entry in entries if entry.name.endswith(".toml"))


def preset(name: str | Path) -> BakeOptions:
    """The options that a preset sets, the rest at their defaults.

    name : of one that comes with furbake, or a path that ends in `.toml`: a file of knobs like theirs, which may begin
        with `extends = NAME` (or another file's path, seen from its own folder)

    Raises OptionError for an unknown preset, and for a knob that is unknown, of another type or out of range.
    """
    values, label = _load(str(name), ())
    return _with(BakeOptions(preset=label), values)


def override(options: BakeOptions, texts: Mapping[str, str]) -> BakeOptions:
    """Options with some knobs changed: dotted name → value as text. Raises OptionError."""
    return _with(options, {name: knobs.parse(name, text) for name, text in texts.items()})


def as_toml(options: BakeOptions) -> str:
    """All knobs as a preset file, which gives the same options back."""
    return knobs.write(_values(options))


def preset_summary(name: str) -> str:
    """The first comment line of a preset's file: one sentence on what it is for."""
    text = (files("furbake") / "presets" / f"{name}.toml").read_text("utf-8")
    return text.splitlines()[0].removeprefix("#").strip()


def _with(options: BakeOptions, values: Mapping[str, Any]) -> BakeOptions:
    """Options with some knobs, by dotted name, at checked values."""
    table = knobs.nest({**dict(knobs.flatten(asdict(options))), **values})
    if "height" in values:
        table |= {"height_share": values["height"], "height": None}
    return _build(table)


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
        text, place = path.read_bytes().decode(), path.resolve()
    except OSError as error:
        why = (error.strerror or str(error)).lower()
        raise OptionError(f"{what}: got {name!r} ({why}), expected a .toml file with knobs") from None
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
