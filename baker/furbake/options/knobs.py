"""The knobs of a preset by their dotted names: type, range, reading from TOML or from text, writing as TOML.

Ranges stand here alone; messages, help and the table of the docs are made of them. No library checks them: pydantic
takes 140 ms to import (click and this module together 60) and 10 MB, and its errors would have to be translated into
these sentences one kind at a time; msgspec's are English text without parts. TOML is read by the standard library;
tomli-w writes no comments.
"""

from __future__ import annotations

import difflib
import json
import re
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Literal

Kind = Literal["switch", "whole number", "number", "pair", "colour", "word"]

ELEMENTS = {"pair": 2, "colour": 3}

BARE_POINT = re.compile(r"(?<![\w.])\.(?=\d)")
"""Point at which a number begins, which TOML does not have."""


class OptionError(ValueError):
    """An option that cannot be used; the message names it, what was got and what was expected."""


@dataclass(frozen=True)
class Knob:
    """Type and range of a knob: numbers within low..high (each of a pair or a colour), or one of some words."""

    kind: Kind
    low: float = 0.0
    high: float = 0.0
    words: tuple[str, ...] = ()

    @property
    def expected(self) -> str:
        """The accepted values in words, for messages and comments."""
        if self.kind == "switch":
            return "true or false"
        if self.kind == "word":
            return " or ".join(self.words)
        amount = "numbers, each" if self.kind in ELEMENTS else ""
        count = {"pair": "two ", "colour": "three "}.get(self.kind, f"a {self.kind}, ")
        return f"{count}{amount}{' ' if amount else ''}{self.range}"

    @property
    def range(self) -> str:
        """Least and greatest number in words, for help."""
        return f"{plain(self.low)} to {plain(self.high)}"

    def take(self, name: str, value: Any) -> Any:
        """`value` as the options hold it. Raises OptionError for another type or a value out of range."""
        if self.kind in ELEMENTS:
            if not isinstance(value, list | tuple) or len(value) != ELEMENTS[self.kind]:
                raise OptionError(f"{name}: got {show(value)}, expected {self.expected}")
            return tuple(self._number(name, element, value) for element in value)
        if self.kind == "switch" and not isinstance(value, bool):
            raise OptionError(f"{name}: got {show(value)}, expected {self.expected}")
        if self.kind == "word" and value not in self.words:
            raise OptionError(f"{name}: got {show(value)}, expected {self.expected}")
        return value if self.kind in {"switch", "word"} else self._number(name, value, value)

    def _number(self, name: str, value: Any, whole: Any) -> int | float:
        types = int if self.kind == "whole number" else (int, float)
        if isinstance(value, bool) or not isinstance(value, types):
            raise OptionError(f"{name}: got {show(whole)}, expected {self.expected}")
        within(name, value, self.low, self.high)
        return value if self.kind == "whole number" else float(value)


def _whole(low: float, high: float) -> Knob:
    return Knob("whole number", low, high)


def _number(low: float, high: float) -> Knob:
    return Knob("number", low, high)


def _pair(low: float, high: float) -> Knob:
    return Knob("pair", low, high)


HAIRS = {
    "count": _whole(0, 20_000),
    "length": _pair(0.05, 1),
    "radius": _pair(1e-4, 0.1),
    "taper": _number(0.2, 8),
    "curl": _number(0, 0.5),
    "turns": _number(0, 20),
    "curl_shape": _number(0.1, 4),
    "wave": _number(0, 0.5),
    "waves": _number(0, 20),
    "lock": _number(0, 1),
    "frizz": _number(0, 0.5),
    "kinks": _number(0.5, 20),
    "stray": _number(0, 1),
    "clump": _number(0, 1),
    "clump_shape": _number(0.2, 8),
    "tint": _number(0, 1),
    "fade": _pair(0, 2),
    "hue": _pair(0, 1),
    "ticking": _number(0, 1),
    "ticked": _number(0, 0.99),
}

COAT = {
    "lean": _pair(-2, 2),
    "bend": _number(1, 4),
    "flow": _number(0, 1),
    "clumps": _whole(1, 5_000),
    "tufts": _number(0, 0.9),
    "patchiness": _number(0, 0.9),
    "patches": _whole(1, 16),
    "shade": _number(0, 0.5),
    "opacity": _number(0.05, 50),
    "albedo": _number(0, 0.99),
    "skin": _number(0, 1),
    "even": _number(0, 1),
}

RAMP = {
    "root": Knob("colour", 0, 1),
    "tip": Knob("colour", 0, 1),
    "tip2": Knob("colour", 0, 1),
    "power": _number(0.05, 20),
}

BAKE = {
    "layers": _whole(1, 64),
    "size": _whole(8, 512),
    "lights": _whole(8, 1024),
    "basis": Knob("word", words=("ptm", "eigen")),
    "coefficients": _whole(3, 6),
    "curves": Knob("word", words=("slab", "none")),
    "height": _number(0.02, 4),
    "tile_share": _number(0.001, 10),
    "colour_plane": Knob("switch"),
    "guide": Knob("word", words=("nose-tail", "down")),
    "sweep": _number(0, 0.8),
    "uv": Knob("word", words=("lapped", "own")),
    "length_by_thickness": Knob("switch"),
    "length_noise": _number(0, 0.9),
    "tip_noise": _number(0, 1),
    "belly": _number(0, 1),
    "fins": Knob("switch"),
    "seed": _whole(0, 2**63 - 1),
}

KNOBS: dict[str, Knob] = {
    **BAKE,
    **{f"coat.{name}": knob for name, knob in COAT.items()},
    **{f"coat.{kind}.{name}": knob for kind in ("guard", "under") for name, knob in HAIRS.items()},
    **{f"ramp.{name}": knob for name, knob in RAMP.items()},
}
"""Every knob that a preset may set, in the order in which it is written."""

LENGTH = _number(1e-30, 1e30)
"""A length in the model's units: 32-bit floats hold it and what follows from it by `height`."""

MAX_FACES = _whole(4, 2_000_000)
"""Faces of a model that is not simplified."""

FOLLOW = _whole(0, 64)
"""Hairs beside each strand of a groom."""

BITS = _whole(4, 8)
"""Bits of a stored number."""


def plain(value: float) -> str:
    """A number as people write it: 20000, not 2e+04."""
    return str(value) if isinstance(value, int) else f"{value:g}"


def show(value: Any) -> str:
    """A value as TOML would have it, cut short where it is long."""
    text = json.dumps(value, default=str, ensure_ascii=False) if not isinstance(value, str) else repr(value)
    return text if len(text) <= 60 else f"{text[:57]}..."


def within(name: str, value: float, low: float, high: float) -> None:
    """Raise OptionError unless low ≤ value ≤ high (no NaN)."""
    if not low <= value <= high:
        raise OptionError(f"{name}: got {show_number(value)}, expected {plain(low)} to {plain(high)}")


def show_number(value: float) -> str:
    """A number, cut short where it has too many digits to read."""
    return show(value) if isinstance(value, int) else f"{value:g}"


def flatten(table: Mapping[str, Any], prefix: str = "") -> Iterator[tuple[str, Any]]:
    """Nested tables as pairs of dotted name and value."""
    for key, value in table.items():
        if isinstance(value, Mapping):
            yield from flatten(value, f"{prefix}{key}.")
        else:
            yield f"{prefix}{key}", value


def nest(values: Mapping[str, Any]) -> dict[str, Any]:
    """The reverse of `flatten`."""
    table: dict[str, Any] = {}
    for name, value in values.items():
        *groups, last = name.split(".")
        inner = table
        for group in groups:
            inner = inner.setdefault(group, {})
        inner[last] = value
    return table


def find(name: str) -> Knob:
    """The knob of that dotted name. Raises OptionError that names the one most like it."""
    if name in KNOBS:
        return KNOBS[name]

    def likeness(knob: str) -> tuple[float, float]:
        whole = difflib.SequenceMatcher(None, name, knob).ratio()
        last = difflib.SequenceMatcher(None, name.rpartition(".")[2], knob.rpartition(".")[2]).ratio()
        return max(whole, last), whole

    raise OptionError(f"got {show(name)}, expected a knob such as {max(KNOBS, key=likeness)}")


def read(table: Mapping[str, Any]) -> dict[str, Any]:
    """Checked values by dotted name, from the tables of a TOML file."""
    return {name: find(name).take(name, value) for name, value in flatten(table)}


def parse(name: str, text: str) -> Any:
    """The value of a knob from the text after `=` on a command line: TOML.

    Quotes, outer brackets and a zero before a point are optional.
    """
    knob = find(name)
    plain = BARE_POINT.sub("0.", text)
    bracketed = f"[{plain}]" if knob.kind in ELEMENTS and not plain.lstrip().startswith("[") else plain
    try:
        (value,) = [text] if knob.kind == "word" else tomllib.loads(f"value = {bracketed}").values()
    except (ValueError, RecursionError):
        raise OptionError(f"{name}: got {show(text)}, expected {knob.expected}") from None
    return knob.take(name, value)


def write(values: Mapping[str, Any], comments: bool = True) -> str:
    """TOML of the knobs in `values` (by dotted name), with the accepted values of each as a comment."""
    lines: list[str] = []
    group = ""
    for name, value in sorted(values.items(), key=lambda item: list(KNOBS).index(item[0])):
        table, _, last = name.rpartition(".")
        if table != group:
            lines += ["", f"[{table}]"]
            group = table
        text = json.dumps(list(value) if isinstance(value, tuple) else value)
        lines.append(f"{last} = {text}" + (f"  # {KNOBS[name].expected}" if comments else ""))
    return "\n".join(lines) + "\n"
