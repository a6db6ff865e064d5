"""Pelts that are taken from a cache where they have been made before."""

from __future__ import annotations

import hashlib
import json
import platform
from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from furbake.cache.entries import Cache
from furbake.device import device
from furbake.options import BakeOptions
from furbake.pelt.curves import Curves
from furbake.pelt.hairs.ramp import Ramp
from furbake.pelt.hairs.states import PeltState
from furbake.pelt.hairs.strands import Strands
from furbake.pelt.multiple import Multiple
from furbake.pelt.pelt import FinPelt, Pelt
from furbake.pelt.texels.basis import Basis
from furbake.tile.tile import Fitted

Floats = NDArray[np.float64]

CLASSES = (Pelt, FinPelt, Basis, Curves, Multiple, PeltState, Ramp)

ROOMS = ("pelt", "tile")
"""Parts of the package whose code decides what a pelt is."""

LIBRARIES = ("numpy", "scipy")

Sides = list[tuple[FinPelt, Floats | None, dict[str, float]]]


class KeptPelts:
    """The pelts of one fur in a cache. Everything else that a bake makes depends on its body and is not kept."""

    def __init__(self, folder: Path, options: BakeOptions, height: float, strands: Strands | None = None) -> None:
        """options, height, strands : of the tile, as of `Tile.grow`."""
        self.cache = Cache(folder, CLASSES)
        self.key = pelt_key(options, height, strands)

    def pelts(self) -> Fitted | None:
        """All states without fins; None where they are to be made."""
        return self.cache.get(self.key)

    def keep_pelts(self, fitted: Fitted) -> None:
        self.cache.put(self.key, fitted)

    def with_fins(self, fitted: Fitted) -> Fitted | None:
        """The same with their fins; None where these are to be made."""
        sides: Sides | None = self.cache.get(f"{self.key}-fins")
        if sides is None or len(sides) != len(fitted):
            return None
        return [
            (replace(pelt, fin=fin, fin_eye=eye), figures | {"fin": found})
            for (pelt, figures), (fin, eye, found) in zip(fitted, sides, strict=True)
        ]

    def keep_fins(self, fitted: Fitted) -> None:
        self.cache.put(f"{self.key}-fins", [(pelt.fin, pelt.fin_eye, figures["fin"]) for pelt, figures in fitted])


def pelt_key(options: BakeOptions, height: float, strands: Strands | None = None) -> str:
    """SHA-256 of all that decides a pelt: options and height of the tile, code, libraries, kind of machine, device.

    strands : that are not grown of the options
    """
    parts: dict[str, Any] = {
        "code": code_hash(ROOMS),
        "libraries": {name: version(name) for name in ("furbake", *LIBRARIES)},
        "machine": (platform.machine(), device()),
        "options": options.as_record(),
        "height": height,
    }
    found = hashlib.sha256(json.dumps(parts, sort_keys=True).encode())
    for array in () if strands is None else vars(strands).values():
        found.update(np.ascontiguousarray(array).tobytes())
    return found.hexdigest()


@cache
def code_hash(rooms: Sequence[str]) -> str:
    """SHA-256 of the modules in these parts of the package: a version may be under work."""
    root, found = Path(__file__).parents[1], hashlib.sha256()
    for module in sorted(path for room in rooms for path in (root / room).rglob("*.py")):
        found.update(module.relative_to(root).as_posix().encode() + b"\0" + module.read_bytes() + b"\0")
    return found.hexdigest()
