"""Bounds on what a model may ask for, so that no small file takes much memory or time.

Each can be raised in the environment: `FURBAKE_LIMITS=bytes=2G,pixels=200M`.
"""

from __future__ import annotations

import os
import re
from dataclasses import dataclass, fields, replace

from furbake.byte_units import BYTE_UNITS
from furbake.surface.soup import MeshError

VARIABLE = "FURBAKE_LIMITS"

PER_BYTE = 4
"""Numbers that a model may ask for beside the bound, for each byte that is read."""

MOST = 10**15
"""Bounds beyond this are none."""


@dataclass(frozen=True)
class Limits:
    """The bounds.

    bytes : of a model together with all files that it names, and of all that an archive unpacks to
    numbers : of a glTF's accessors and of its faces' corners, together, beside four for each byte that is read
    pixels : of one picture
    members : files in an archive
    """

    bytes: int = 250 * 10**6
    numbers: int = 10 * 10**6
    pixels: int = 67_108_864
    members: int = 10_000


class Budget:
    """A bound of one model, of which each use takes some.

    model : its name, for the message; limit : name of the bound in `Limits`
    """

    def __init__(self, model: str, limit: str) -> None:
        self.model, self.limit = model, limit
        self.whole: int = getattr(limits(), limit)
        self.left = self.whole

    def take(self, amount: int) -> None:
        """Raises MeshError where less is left."""
        if amount > self.left:
            raise MeshError(
                f"{self.model}: more than {self.whole} {self.limit} to read, expected fewer, "
                f"or a higher bound in {VARIABLE} ({self.limit}=...)"
            )
        self.left -= amount


class Budgets:
    """All bounds of one model, with the files that it names or the archive that it lies in.

    bytes : read from the disk, or unpacked; copied : of pictures, beside those; numbers : in memory
    """

    def __init__(self, model: str) -> None:
        self.bytes, self.copied = Budget(model, "bytes"), Budget(model, "bytes")
        self.numbers = Budget(model, "numbers")

    def took(self, data: bytes) -> None:
        """A file has been read: its bytes are some numbers' worth."""
        self.numbers.whole += PER_BYTE * len(data)
        self.numbers.left += PER_BYTE * len(data)


def limits() -> Limits:
    """The bounds, with those that the environment sets. Raises MeshError where it is malformed."""
    found = Limits()
    names = [field.name for field in fields(Limits)]
    for part in os.environ.get(VARIABLE, "").replace(" ", "").split(","):
        if not part:
            continue
        match = re.fullmatch(r"(\w+)=(\d{1,15})([KMG]?)", part, re.ASCII)
        if not match or match[1] not in names:
            raise MeshError(
                f"{VARIABLE}: got {part!r}, expected NAME=NUMBER with one of {', '.join(names)}, such as bytes=2G"
            )
        found = replace(found, **{match[1]: min(int(match[2]) * BYTE_UNITS[match[3]], MOST)})
    return found
