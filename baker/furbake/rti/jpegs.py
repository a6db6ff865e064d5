"""The planes of PTM_FORMAT_JPEG_LRGB and JPEG_RGB: a grey JPEG each, most of them as the difference to another.

A plane that has a reference is stored as the difference plus 128; the sum wraps round at 256. Where JPEG's own error
carries a sum over that edge, the writer adds side information: pixels by their number, row by row of the JPEG, and
their true byte.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from furbake.rti.relit import Bytes, RtiError
from furbake.surface.colours import decode
from furbake.surface.material import Picture

INVERTED = 1
"""Transform of the reference: 255 − byte. All others move it by a motion vector."""

CORRECTION = np.dtype([("pixel", ">u4"), ("byte", "u1")])
"""One entry of the side information."""


@dataclass(frozen=True)
class Packing:
    """Seven numbers of every plane, in the order of the header.

    order : in which planes are put together; reference : plane that is added, −1: none
    sizes, sides : bytes of the JPEG stream, and of the side information behind it
    """

    transforms: tuple[int, ...]
    across: tuple[int, ...]
    down: tuple[int, ...]
    order: tuple[int, ...]
    reference: tuple[int, ...]
    sizes: tuple[int, ...]
    sides: tuple[int, ...]


def unpacked(body: memoryview, packing: Packing, width: int, height: int, name: str) -> Bytes:
    """Bytes of all planes, (H, W, planes), the first row of the JPEGs first. Raises RtiError."""
    count = len(packing.order)
    streams = _streams(body, packing, name)
    codes = np.empty((height, width, count), np.uint8)
    done: set[int] = set()
    for plane in sorted(range(count), key=lambda i: (packing.order[i], i)):
        stream, side = streams[plane]
        grey = _grey(stream, width, height, f"{name}: plane {plane}")
        reference = packing.reference[plane]
        if reference >= 0:
            if reference not in done:
                raise RtiError(f"{name}: plane {plane} is told by plane {reference}, expected one before it in order")
            _check_still(packing, plane, name)
            other = codes[..., reference]
            grey += (255 - other if packing.transforms[plane] & INVERTED else other) - np.uint8(128)
        codes[..., plane] = _corrected(grey, side)
        done.add(plane)
    return codes


def _streams(body: memoryview, packing: Packing, name: str) -> list[tuple[memoryview, memoryview]]:
    """JPEG stream and side information of every plane."""
    if min(*packing.sizes, *packing.sides) < 0:
        raise RtiError(f"{name}: a JPEG stream of negative size, expected 0 bytes or more")
    expected = sum(packing.sizes) + sum(packing.sides)
    if len(body) < expected:
        raise RtiError(f"{name}: {len(body)} bytes of JPEG streams, expected {expected}")
    found, at = [], 0
    for size, side in zip(packing.sizes, packing.sides, strict=True):
        found.append((body[at : at + size], body[at + size : at + size + side]))
        at += size + side
    return found


def _check_still(packing: Packing, plane: int, name: str) -> None:
    """Raise RtiError where the reference is moved: no writer is known that does so, and no file."""
    moved = packing.across[plane], packing.down[plane]
    if packing.transforms[plane] & ~INVERTED and any(moved):
        raise RtiError(f"{name}: plane {plane} has motion {moved[0]}, {moved[1]}, expected planes without motion")


def _grey(stream: memoryview, width: int, height: int, what: str) -> Bytes:
    """(H, W) bytes of a grey JPEG."""
    pixels = decode(Picture(bytes(stream), "image/jpeg"))
    if pixels is None or pixels.shape[:2] != (height, width):
        got = "cannot be read" if pixels is None else f"{pixels.shape[1]} x {pixels.shape[0]} pixels"
        raise RtiError(f"{what}: {got}, expected a JPEG of {width} x {height}")
    return np.ascontiguousarray(pixels[..., 0])


def _corrected(grey: Bytes, side: memoryview) -> Bytes:
    """The plane with the true bytes of the side information; pixels that there are not are left out."""
    entries = np.frombuffer(side, CORRECTION, len(side) // CORRECTION.itemsize)
    entries = entries[entries["pixel"] < grey.size]
    grey.reshape(-1)[entries["pixel"]] = entries["byte"]
    return grey
