"""PTM 1.2, the format of Malzbender and Gelb (HPL-2001-104): lines of text, then bytes, the lowest row first."""

from __future__ import annotations

import re
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO, TypeVar

import numpy as np
from numpy.typing import NDArray

from furbake.rti.jpegs import Packing, unpacked
from furbake.rti.relit import TERMS, Array, Bytes, Relit, RtiError, lrgb, rgb
from furbake.surface.files import read_regular
from furbake.surface.limits import Budget
from furbake.surface.soup import MeshError

Number = TypeVar("Number", int, float)

VERSIONS = ("PTM_1.2", "PTM_1.1")
"""1.1 differs in LRGB alone: a pixel's colour follows its coefficients."""

PLANES = {"RGB": 18, "LRGB": 9, "JPEG_RGB": 18, "JPEG_LRGB": 9}
"""Kinds that are read, and their bytes per pixel."""

GREATEST = 1e9
"""Bound of all numbers of a header."""

WORD = 64
"""Characters of a number in the header at the most."""


@dataclass(frozen=True)
class Header:
    """version, kind : as in the first two lines; scale, bias : (6,); packing : of JPEG streams, or None."""

    version: str
    kind: str
    width: int
    height: int
    scale: Array
    bias: Array
    packing: Packing | None = None


def read_ptm(path: Path) -> Relit:
    """The picture in a file. Raises RtiError."""
    return parse_ptm(read_bytes(path), str(path))


def read_bytes(path: Path) -> bytes:
    """Bytes of a regular file within the bounds. Raises RtiError."""
    try:
        return read_regular(path, Budget(str(path), "bytes"))
    except OSError as error:
        text = (error.strerror or "cannot be read").lower()
        raise RtiError(f"{path}: {text}, expected a file to read") from error
    except MeshError as error:
        raise RtiError(str(error)) from error


def parse_ptm(data: bytes, name: str) -> Relit:
    """The picture in the bytes of a file of that name. Raises RtiError."""
    words = _Words(data, name)
    header = _header(words)
    body, planes = memoryview(data)[words.at :], PLANES[header.kind]
    try:
        Budget(name, "bytes").take(header.width * header.height * planes)
    except MeshError as error:
        raise RtiError(f"{error} (it has {header.width} x {header.height} pixels)") from error
    if header.packing is not None:
        codes = unpacked(body, header.packing, header.width, header.height, name)[::-1]
    else:
        codes = _plain(body, header, name)
    if planes == 9:
        return lrgb(codes[..., :TERMS], header.scale, header.bias, codes[..., TERMS:])
    return rgb(codes, header.scale, header.bias)


def _plain(body: memoryview, header: Header, name: str) -> Bytes:
    """Bytes of the pixels, (H, W, 9 or 18), row 0 on top."""
    width, height, planes = header.width, header.height, PLANES[header.kind]
    expected = width * height * planes
    if len(body) < expected:
        raise RtiError(f"{name}: {len(body)} bytes of pixels, expected {expected} for {width} x {height} {header.kind}")
    stored = np.frombuffer(body, np.uint8, expected)
    if planes == 18:
        return np.concatenate(list(stored.reshape(3, height, width, TERMS)), axis=-1)[::-1]
    if header.version == "PTM_1.1":
        return stored.reshape(height, width, planes)[::-1]
    first = width * height * TERMS
    polynomial, colour = stored[:first].reshape(height, width, TERMS), stored[first:].reshape(height, width, 3)
    return np.concatenate([polynomial, colour], axis=-1)[::-1]


def write_ptm(file: BinaryIO, relit: Relit) -> None:
    """Write a `relit.lrgb` or `relit.rgb` as PTM 1.2; biases are rounded to whole numbers, as the format has them."""
    kind = "RGB" if relit.colour is None else "LRGB"
    numbers = [" ".join(f"{value:.8g}" for value in relit.scale[:TERMS])]
    numbers.append(" ".join(str(round(value)) for value in relit.bias[:TERMS]))
    lines = ["PTM_1.2", f"PTM_FORMAT_{kind}", str(relit.width), str(relit.height), *numbers]
    file.write("".join(f"{line}\n" for line in lines).encode("ascii"))
    blocks = [relit.codes[..., i : i + TERMS] for i in range(0, relit.codes.shape[-1], TERMS)]
    file.writelines(
        np.ascontiguousarray(block[::-1]).tobytes()
        for block in [*blocks, *([] if relit.colour is None else [relit.colour])]
    )


class _Words:
    """The header word by word: writers differ in where its lines end."""

    def __init__(self, data: bytes, name: str) -> None:
        self.data, self.name, self.at = data, name, 0

    def word(self, wanted: str) -> str:
        found = re.compile(rb"\s*(\S{1,%d})(?=\s)" % WORD).match(self.data, self.at)
        if found is None:
            raise RtiError(f"{self.name}: the header ends early, expected {wanted}")
        self.at = found.end()
        return found[1].decode("latin-1")

    def wholes(self, wanted: str, count: int) -> list[int]:
        return [self._number(wanted, int) for _ in range(count)]

    def numbers(self, wanted: str, count: int) -> Array:
        return np.array([self._number(wanted, float) for _ in range(count)])

    def end(self) -> None:
        """Skip the end of the last line, and no byte of the pixels."""
        found = re.compile(rb"[ \t]*\r?\n").match(self.data, self.at)
        if found is None:
            raise RtiError(f"{self.name}: no end of the header's last line, expected one before the pixels")
        self.at = found.end()

    def _number(self, wanted: str, kind: Callable[[str], Number]) -> Number:
        text = self.word(wanted)
        with suppress(ValueError):
            value = kind(text)
            if abs(value) <= GREATEST:
                return value
            wanted = f"{wanted}, below {GREATEST:g}"
        raise RtiError(f"{self.name}: got {text!r}, expected {wanted}")


def _header(words: _Words) -> Header:
    name = words.name
    if not words.data.startswith(tuple(version.encode() for version in VERSIONS)):
        raise RtiError(f"{name}: no PTM file, expected one that begins with PTM_1.2")
    version = words.word("PTM_1.2")
    text = words.word("a kind of PTM")
    kind = text.removeprefix("PTM_FORMAT_")
    if version not in VERSIONS or not text.startswith("PTM_FORMAT_") or kind not in PLANES:
        kinds = ", ".join(f"PTM_FORMAT_{kind}" for kind in PLANES)
        raise RtiError(f"{name}: got {version} {text}, expected PTM_1.2 and one of {kinds}")
    width, height = words.wholes("width and height, pixels", 2)
    if width < 1 or height < 1:
        raise RtiError(f"{name}: got {width} x {height} pixels, expected 1 x 1 or more")
    scale, bias = words.numbers("six scales", TERMS), words.numbers("six biases", TERMS)
    packing = None
    if kind.startswith("JPEG"):
        count = PLANES[kind]
        words.word("the compression's parameter")
        rows = [words.wholes(f"{count} whole numbers of the JPEG streams", count) for _ in range(7)]
        packing = Packing(*(tuple(row) for row in rows))
    words.end()
    return Header(version, kind, width, height, scale, bias, packing)


def byte_header(low: Array, high: Array) -> tuple[Array, Array]:
    """λ and Ω per coefficient that bytes from `low` to `high` (C,) need, Ω whole and 0 or more, as viewers expect."""
    low = np.minimum(low, 0.0)
    scale = np.array([float(f"{value:.6g}") for value in np.maximum(high - low, 1e-6) / 254])
    return scale, np.ceil(-low / scale - 1e-9)


def fitted_bytes(coefficients: NDArray[np.floating[Any]], scale: Array, bias: Array) -> Bytes:
    """Bytes of coefficients (..., C), or of one (...) with its λ and Ω."""
    return np.clip(np.rint(coefficients / scale + bias), 0, 255).astype(np.uint8)
