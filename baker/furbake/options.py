"""Every knob of a bake: what it means, its unit, its range, its default. The presets are data beside it."""

from __future__ import annotations

import math
import tomllib
from dataclasses import asdict, dataclass, field
from importlib.resources import files
from typing import Any, Literal

from furbake.pelt.pelt import Ramp
from furbake.pelt.strands import Coat, Hairs

BasisKind = Literal["ptm", "eigen"]
Guide = Literal["nose-tail", "down"]


class OptionError(ValueError):
    """An option that cannot be used; the message names it, what was got and what was expected."""


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
    length_by_thickness: bool = False
    """Shorter fur where the body is thin (ears, feet)."""
    coat: Coat = field(default_factory=Coat)
    ramp: Ramp = field(default_factory=Ramp)
    colour_plane: bool = True
    """Store the paper's original colour of every texel as a third plane."""
    tile_share: float = 0.13
    """Default width of a tile as a share of the model's largest side, 0.001 to 10."""
    height_share: float = 0.5
    """Default height in tile widths, 0.02 to 4."""

    def check(self) -> None:
        """Raise `OptionError` for the first value that is out of range."""
        if self.preset not in preset_names():
            raise OptionError(f"preset: got {self.preset!r}, expected one of {', '.join(preset_names())}")
        _within("layers", self.layers, 1, 64)
        _within("size", self.size, 8, 512)
        if self.size & (self.size - 1):
            raise OptionError(f"size: got {self.size}, expected a power of two")
        _within("lights", self.lights, 8, 1024)
        if self.basis not in ("ptm", "eigen"):
            raise OptionError(f"basis: got {self.basis!r}, expected ptm or eigen")
        if self.basis == "ptm" and self.coefficients != 6:
            raise OptionError(
                f"coefficients: got {self.coefficients}, expected 6 for the basis ptm (eigen takes 3 to 6)"
            )
        _within("coefficients", self.coefficients, 3, 6)
        for name, value in (("length", self.length), ("tile", self.tile)):
            if value is not None and not (math.isfinite(value) and value > 0):
                raise OptionError(f"{name}: got {value:g}, expected a length above 0")
        if None not in (self.length, self.tile, self.height):
            raise OptionError(
                "length: got length, tile and height, expected at most two of them (length = height × tile)"
            )
        _within("height", self.height if self.height is not None else self.height_share, 0.02, 4)
        _within("seed", self.seed, 0, 2**63 - 1)
        if self.guide not in ("nose-tail", "down"):
            raise OptionError(f"guide: got {self.guide!r}, expected nose-tail or down")
        _within("tile_share", self.tile_share, 0.001, 10)
        _check_coat(self.coat)
        for name, colour in (("root", self.ramp.root), ("tip", self.ramp.tip), ("tip2", self.ramp.tip2)):
            for channel in colour:
                _within(f"ramp.{name}", channel, 0, 1)
        _within("ramp.power", self.ramp.power, 0.05, 20)

    def dimensions(self, extent: float) -> tuple[float, float]:
        """(tile, length) in the model's units, for a model whose largest side is `extent`.

        Raises OptionError when length and tile together give a height out of range.
        """
        height = self.height if self.height is not None else self.height_share
        if self.length is not None and self.tile is not None:
            _within("height (length / tile)", self.length / self.tile, 0.02, 4)
            return self.tile, self.length
        if self.length is not None:
            return self.length / height, self.length
        tile = self.tile if self.tile is not None else self.tile_share * extent
        return tile, height * tile

    def as_record(self) -> dict[str, Any]:
        """Plain data, for bake.json."""
        return asdict(self)

    @classmethod
    def from_record(cls, record: dict[str, Any]) -> BakeOptions:
        """The options that `as_record` wrote, JSON's lists and all."""
        return _build(record)


def _within(name: str, value: float, low: float, high: float) -> None:
    if not (math.isfinite(value) and low <= value <= high):
        raise OptionError(f"{name}: got {value:g}, expected {low:g} to {high:g}")


def _check_coat(coat: Coat) -> None:
    for kind, hairs in (("guard", coat.guard), ("under", coat.under)):
        name = f"coat.{kind}"
        _within(f"{name}.count", hairs.count, 0, 20_000)
        _within(f"{name}.curl", hairs.curl, 0, 0.5)
        _within(f"{name}.turns", hairs.turns, 0, 20)
        _within(f"{name}.stray", hairs.stray, 0, 1)
        _within(f"{name}.clump", hairs.clump, 0, 1)
        for end in hairs.length:
            _within(f"{name}.length", end, 0.05, 1)
        for end in hairs.radius:
            _within(f"{name}.radius", end, 1e-4, 0.1)
    _within("coat.guard.count + coat.under.count", coat.guard.count + coat.under.count, 1, 20_000)
    for axis in coat.lean:
        _within("coat.lean", axis, -2, 2)
    _within("coat.bend", coat.bend, 1, 4)
    _within("coat.clumps", coat.clumps, 1, 5_000)
    _within("coat.shade", coat.shade, 0, 0.5)
    _within("coat.opacity", coat.opacity, 0.05, 50)


def preset_names() -> list[str]:
    """Names of the presets that come with furbake, sorted."""
    return sorted(entry.name.removesuffix(".toml") for entry in _presets() if entry.name.endswith(".toml"))


def preset(name: str) -> BakeOptions:
    """The options that a preset sets, the rest at their defaults. Raises OptionError for an unknown name."""
    if name not in preset_names():
        raise OptionError(f"preset: got {name!r}, expected one of {', '.join(preset_names())}")
    table = tomllib.loads((files("furbake") / "presets" / f"{name}.toml").read_text("utf-8"))
    if "height" in table:
        table["height_share"] = table.pop("height")
    return _build({"preset": name, **table})


def _build(table: dict[str, Any]) -> BakeOptions:
    """Options from nested tables and lists; what they don't name is at its default."""
    coat = dict(table.get("coat", {}))
    for kind in ("guard", "under"):
        if kind in coat:
            coat[kind] = Hairs(**_tuples(coat[kind]))
    built = {"coat": Coat(**_tuples(coat)), "ramp": Ramp(**_tuples(table.get("ramp", {})))}
    return BakeOptions(**{**_tuples(table), **built})


def preset_summary(name: str) -> str:
    """The first comment line of a preset's file: one sentence on what it is for."""
    text = (files("furbake") / "presets" / f"{name}.toml").read_text("utf-8")
    return text.splitlines()[0].removeprefix("#").strip()


def _presets() -> list[Any]:
    return list((files("furbake") / "presets").iterdir())


def _tuples(table: dict[str, Any]) -> dict[str, Any]:
    return {key: tuple(value) if isinstance(value, list) else value for key, value in table.items()}
