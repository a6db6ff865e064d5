"""Types of the command's values: each fails with what it got and what it expects."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import click

from furbake.byte_units import BYTE_UNITS
from furbake.options.knobs import Knob


class Whole(click.ParamType[int]):
    """A whole number, within the range of a knob if there is one."""

    name = "N"

    def __init__(self, knob: Knob | None = None) -> None:
        self.knob = knob

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> int:
        """The number. Fails for anything else."""
        try:
            number = int(value)
        except ValueError:
            self.fail(f"got {value!r}, expected a whole number", param, ctx)
        if self.knob is not None and not self.knob.low <= number <= self.knob.high:
            self.fail(f"got {value}, expected {self.knob.range}", param, ctx)
        return number


class Number(click.ParamType[float]):
    """A number."""

    name = "X"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> float:
        """The number. Fails for anything else."""
        try:
            return float(value)
        except ValueError:
            self.fail(f"got {value!r}, expected a number", param, ctx)


class Size(click.ParamType[int]):
    """A number of bytes, with a unit or without."""

    name = "BYTES"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> int:
        """The number. Fails for anything else."""
        found = re.fullmatch(r"(\d+(?:\.\d+)?)([KMG]?)B?", str(value).strip().upper(), re.ASCII)
        bytes_ = int(float(found[1]) * BYTE_UNITS[found[2]]) if found else 0
        if bytes_ < 1:
            self.fail(f"got {value!r}, expected a number of bytes such as 8G or 500M", param, ctx)
        return bytes_


class Share(Number):
    """A number above 0 and at most 1."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> float:
        """The number. Fails for anything else."""
        share = super().convert(value, param, ctx)
        if not 0 < share <= 1:
            self.fail(f"got {value}, expected above 0 and at most 1", param, ctx)
        return share


class Direction(click.ParamType[Any]):
    """Three numbers."""

    name = "X,Y,Z"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """The numbers. Fails for anything else."""
        if not isinstance(value, str):
            return value
        try:
            x, y, z = (float(part) for part in value.split(","))
        except ValueError:
            self.fail(f"got {value!r}, expected three numbers X,Y,Z", param, ctx)
        return x, y, z


class Setting(click.ParamType[tuple[str, str]]):
    """A knob's name and the text of its value."""

    name = "KNOB=VALUE"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> tuple[str, str]:
        """Both. Fails where one is missing."""
        name, equals, text = value.partition("=")
        if not (name.strip() and equals):
            self.fail(f"got {value!r}, expected KNOB=VALUE such as coat.guard.count=300", param, ctx)
        return name.strip(), text.strip()


class Guide(click.ParamType[str]):
    """A way to lay fur, or a file of strokes."""

    name = "WAY|FILE.json"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """The text. Fails for other words."""
        if value not in ("nose-tail", "down") and not value.endswith(".json"):
            self.fail(f"got {value!r}, expected nose-tail, down or a .json file of strokes", param, ctx)
        return str(value)


class Names(click.ParamType[tuple[str, ...]]):
    """Names with commas between."""

    name = "NAME,..."

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> tuple[str, ...]:  # noqa: ARG002
        """The names."""
        return tuple(name.strip() for name in value.split(",")) if isinstance(value, str) else tuple(value)


class Place(click.ParamType[str]):
    """A path."""

    name = "PATH"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """The path. Fails for text that can be none."""
        if not value or "\0" in value:
            self.fail(f"got {value!r}, expected a path", param, ctx)
        try:
            value.encode()
        except UnicodeEncodeError:  # as bytes of it that are not UTF-8 come in: image libraries take no other
            self.fail(f"got {value!r}, expected a path in UTF-8", param, ctx)
        return str(value)


class NewFile(Place):
    """A file to write: minutes of work want to know beforehand whether it can be."""

    def __init__(self, *endings: str) -> None:
        self.endings = endings

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """The path. Fails for other endings, and where there is no folder for it."""
        path = Path(super().convert(value, param, ctx))
        if path.suffix.lower() not in self.endings:
            self.fail(f"got {path}, expected a name that ends in {' or '.join(self.endings)}", param, ctx)
        if not path.parent.is_dir():
            self.fail(f"got {path}, expected a file in a folder that exists", param, ctx)
        return str(path)


WHOLE, NUMBER, SIZE, SHARE, DIRECTION, SETTING = Whole(), Number(), Size(), Share(), Direction(), Setting()
GUIDE, NAMES, PLACE = Guide(), Names(), Place()
