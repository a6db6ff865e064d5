"""Grooms of Cem Yuksel's `.hair` and of TressFX' `.tfx`: a header that counts, and arrays."""

from __future__ import annotations

import struct
from typing import Any

import numpy as np
from numpy.typing import NDArray

from furbake.imported.curves import Curves, GroomError, checked

HAIR, HAIR_HEADER = struct.Struct("<4s4I f f 3f"), 128
"""Magic word, strands, points, bits of the arrays, segments of a strand, thickness, transparency, colour."""

SEGMENTS, POINTS, THICKNESS, TRANSPARENCY, COLOURS = 1, 2, 4, 8, 16

TFX, TFX_HEADER = struct.Struct("<f7I"), 160
"""Version, strands, points of each, and where their arrays begin: places, uv, uv, thickness, colours."""

MAX_PER_STRAND = 65_536


class _Bytes:
    """Arrays taken from a file, one behind the other."""

    def __init__(self, name: str, data: bytes, at: int) -> None:
        self.name, self.data, self.at = name, data, at

    def take(self, kind: str, count: int, what: str) -> NDArray[Any]:
        """The next `count` numbers. Raises GroomError where the file ends before."""
        size = count * np.dtype(kind).itemsize
        if self.at + size > len(self.data):
            raise GroomError(
                f"{self.name}: {len(self.data)} bytes, expected {self.at + size} for the {what} that its header counts"
            )
        found = np.frombuffer(self.data, kind, count, self.at)
        self.at += size
        return found


def read_hair(name: str, data: bytes) -> Curves:
    """A groom of the format of Cem Yuksel. Raises GroomError."""
    if len(data) < HAIR_HEADER or data[:4] != b"HAIR":
        raise GroomError(f"{name}: does not begin with HAIR and a header of {HAIR_HEADER} bytes, expected a .hair file")
    _, strands, count, arrays, segments, thickness, _, *colour = HAIR.unpack_from(data)
    if not arrays & POINTS:
        raise GroomError(f"{name}: holds no points, expected strands")
    rest = _Bytes(name, data, HAIR_HEADER)
    if arrays & SEGMENTS:
        counts = rest.take("<u2", strands, "segments").astype(np.int64) + 1
    elif segments < MAX_PER_STRAND and strands * (segments + 1) == count:
        counts = np.full(strands, segments + 1, np.int64)
    else:
        raise GroomError(f"{name}: {strands} strands of {segments} segments and {count} points, expected as many")
    if int(counts.sum()) != count:
        raise GroomError(f"{name}: {count} points for strands that count {int(counts.sum())}, expected as many")
    points = rest.take("<f4", 3 * count, "points").reshape(-1, 3)
    widths = rest.take("<f4", count, "thicknesses") if arrays & THICKNESS else np.full(count, thickness, np.float32)
    if arrays & TRANSPARENCY:
        rest.take("<f4", count, "transparencies")
    if arrays & COLOURS:
        colours = rest.take("<f4", 3 * count, "colours").reshape(-1, 3)
    else:
        colours = np.broadcast_to(np.array(colour, np.float32), (count, 3))
    return checked(name, points, counts, widths if np.any(widths > 0) else None, colours)


def read_tfx(name: str, data: bytes) -> Curves:
    """A groom of TressFX, from version 4 on. Raises GroomError."""
    if data[:512].lstrip()[:1].isalpha() and b"\0" not in data[:512]:
        raise GroomError(f"{name}: is text, expected the binary .tfx of TressFX 4 (older exporters wrote text)")
    if len(data) < TFX_HEADER:
        raise GroomError(f"{name}: {len(data)} bytes, expected the {TFX_HEADER} of a .tfx header and strands")
    version, strands, each, places, _, _, thickness, colours = TFX.unpack_from(data)
    if not 1 <= version < 100:
        raise GroomError(f"{name}: version {version:g}, expected the binary .tfx of TressFX 4")
    if not 2 <= each <= MAX_PER_STRAND:
        raise GroomError(f"{name}: {each} points per strand, expected two or more")
    count = strands * each
    points = _Bytes(name, data, places).take("<f4", 4 * count, "points").reshape(-1, 4)[:, :3]
    widths = np.repeat(_Bytes(name, data, thickness).take("<f4", strands, "thicknesses"), each) if thickness else None
    shades = None
    if colours:
        shades = _Bytes(name, data, colours).take("<f4", 4 * count, "colours").reshape(-1, 4)[:, :3]
    usable = widths is not None and bool(np.any(widths > 0))
    return checked(name, points, np.full(strands, each), widths if usable else None, shades)
