"""A pelt as images: layers stacked into one column, layer 0 on top, every byte as it is.

plane0 = (a0, a1, a2, a5), plane1 = (a3, a4, α, tint). Three coefficients take one plane: (a0, a1, a2, α), tint 1.
With four or five the channels that are left over are 0. An optional third image has the original colour, sRGB, another
the hairs' direction, 127.5 + 127.5·t.
A fin's images are its side view, row 0 at the roots.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from functools import lru_cache
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
import OpenImageIO as oiio  # noqa: N813 — as its own documentation spells it
from numpy.typing import NDArray

from furbake.cache.images import keep_images, write_kept
from furbake.cores import cores
from furbake.pelt.pelt import FinPelt, Pelt
from furbake.surface.files import check_regular
from furbake.surface.limits import Budget, limits
from furbake.surface.soup import MeshError

Bytes = NDArray[np.uint8]

SLOTS = ((0, 0), (0, 1), (0, 2), (1, 0), (1, 1), (0, 3))
"""(plane, channel) of a0 to a5."""


STANDARD_ERROR = 2

FILTERS = 0x08 | 0x10 | 0x20 | 0x80
"""Row filters of libpng: none, sub, up, Paeth. A mean of two neighbours, rounded down, leaves the grid of the codes."""

STRATEGIES = ("filtered", "huffman")
"""Strategies of zlib: numbers of fur have few matches. The smaller file is kept; the default is 8 % larger."""


class PlaneError(ValueError):
    """An image that cannot be written or read."""


@dataclass(frozen=True)
class Planes:
    """The images of one pelt: (layers·size, size, 4) bytes each, colour and direction with 3 channels."""

    coefficients: tuple[Bytes, ...]
    colour: Bytes | None
    direction: Bytes | None = None


@dataclass(frozen=True)
class Texels:
    """Contents of a pelt's images per texel; the reverse of `pack`.

    codes : (K, N, N, C), alpha, tint : (K, N, N), colour, direction : (K, N, N, 3) bytes or None
    """

    codes: Bytes
    alpha: Bytes
    tint: Bytes
    colour: Bytes | None
    direction: Bytes | None = None


def pack(pelt: Pelt) -> Planes:
    """The images of a pelt. Raises ValueError for fewer than 3 or more than 6 coefficients."""
    count = pelt.coefficients
    if not 3 <= count <= 6:
        raise ValueError(f"coefficients: got {count}, expected 3 to 6")
    colour, direction = (None if texels is None else _column(texels) for texels in (pelt.colour, pelt.direction))
    if count == 3:
        single = np.concatenate([pelt.codes, pelt.alpha[..., None]], axis=-1)
        return Planes((_column(single),), colour, direction)
    first, second = _two_planes(pelt.codes, pelt.alpha, pelt.tint)
    return Planes((_column(first), _column(second)), colour, direction)


def pack_fin(fin: FinPelt) -> Planes:
    """The images of the fur's side view: (height, width, channels), row 0 at the roots."""
    return Planes(tuple(_two_planes(fin.codes, fin.alpha, fin.tint)), fin.colour)


def unpack_fin(planes: Planes, coefficients: int = 6) -> Texels:
    """Texels of a fin's images, (height, width, ...). Raises ValueError where they are not two of one size."""
    shapes = {plane.shape for plane in planes.coefficients}
    if len(planes.coefficients) != 2 or len(shapes) != 1 or next(iter(shapes))[2] != 4:
        raise ValueError(f"fin: got planes {[p.shape for p in planes.coefficients]}, expected two of 4 channels")
    second = planes.coefficients[1]
    codes = np.stack([planes.coefficients[plane][..., channel] for plane, channel in SLOTS[:coefficients]], axis=-1)
    return Texels(codes, second[..., 2], second[..., 3], planes.colour)


def unpack(planes: Planes, coefficients: int) -> Texels:
    """Texels of a pelt's images. Raises ValueError where shapes and count disagree."""
    first = planes.coefficients[0]
    size = first.shape[1]
    if len(planes.coefficients) != (1 if coefficients == 3 else 2) or first.shape[0] % size or first.shape[2] != 4:
        raise ValueError(f"planes: got {[p.shape for p in planes.coefficients]} for {coefficients} coefficients")
    stacks = [plane.reshape(-1, size, size, 4) for plane in planes.coefficients]
    colour, direction = (
        None if plane is None else plane.reshape(-1, size, size, 3) for plane in (planes.colour, planes.direction)
    )
    if coefficients == 3:
        alpha = stacks[0][..., 3]
        return Texels(stacks[0][..., :3], alpha, np.full_like(alpha, 255), colour, direction)
    codes = np.stack([stacks[plane][..., channel] for plane, channel in SLOTS[:coefficients]], axis=-1)
    return Texels(codes, stacks[1][..., 2], stacks[1][..., 3], colour, direction)


def write_png(path: Path, pixels: NDArray[np.uint8] | NDArray[np.uint16], srgb: bool = False) -> None:
    """Write (height, width, channels) of 8 or 16 bits as they are. Raises PlaneError."""
    if pixels.shape[-1] != 4:
        return _write_png(path, pixels, srgb)
    least = b""
    for strategy in STRATEGIES:
        _write_png(path, pixels, srgb, strategy)
        written = path.read_bytes()
        least = written if not least or len(written) < len(least) else least
    path.write_bytes(least)
    return None


def write_webp(path: Path, pixels: NDArray[np.uint8], quality: int) -> None:
    """Write (height, width, 4) as a lossy picture, sRGB, alpha apart; quality : 0 to 100. Raises PlaneError."""
    height, width, channels = pixels.shape
    spec = oiio.ImageSpec(width, height, channels, pixels.dtype.name)
    spec.attribute("oiio:UnassociatedAlpha", 1)
    spec.attribute("compression", f"webp:{quality}")
    _write(path, spec, pixels)


def write_jpeg(path: Path, pixels: NDArray[np.uint8], quality: int) -> None:
    """Write (height, width, 3) bytes with JPEG's losses, colours as fine as brightness. Raises PlaneError."""
    height, width, channels = pixels.shape
    spec = oiio.ImageSpec(width, height, channels, pixels.dtype.name)
    spec.attribute("compression", f"jpeg:{quality}")
    spec.attribute("jpeg:subsampling", "4:4:4")
    _write(path, spec, pixels)


def _write_png(
    path: Path, pixels: NDArray[np.uint8] | NDArray[np.uint16], srgb: bool, strategy: str | None = None
) -> None:
    height, width, channels = pixels.shape
    spec = oiio.ImageSpec(width, height, channels, pixels.dtype.name)
    spec.attribute("oiio:UnassociatedAlpha", 1)  # or RGB is multiplied by A, and coefficients are lost
    spec.attribute("png:compressionLevel", 9)
    if strategy is not None:
        spec.attribute("compression", strategy)
        spec.attribute("png:filter", FILTERS)
    spec.attribute("oiio:ColorSpace", "srgb_rec709_scene" if srgb else "data")
    _write(path, spec, pixels)


def _write(path: Path, spec: oiio.ImageSpec, pixels: NDArray[Any]) -> None:
    output = oiio.ImageOutput.create(os.fspath(path))
    if output is None:
        oiio.geterror()  # taken away, or it stands before the next one
        raise PlaneError(f"{path}: no kind of picture by its name, expected one that ends in .png")
    _check_place(path)
    try:
        written = output.open(os.fspath(path), spec) and output.write_image(np.ascontiguousarray(pixels))
        if not (written and output.close()):
            reason = " ".join(output.geterror().split()) or "no reason given"
            raise PlaneError(f"{path}: cannot be written ({reason}), expected room for a picture")
    finally:
        output.close()


def _check_place(path: Path) -> None:
    """Raise PlaneError with the system's reason where no file can be written: the library gives none."""
    try:
        path.open("ab").close()
    except OSError as error:
        raise PlaneError(
            f"{path}: {(error.strerror or 'cannot be written').lower()}, expected a new picture"
        ) from error


def write_planes(folder: Path, pelt: Pelt, prefix: str = "", cache: Path | None = None) -> list[str]:
    """Write the images of a pelt, whose names begin with `prefix`; their names in the order of `images`.

    cache : optional folder of images that were encoded before
    """
    images: dict[str, tuple[Bytes, bool]] = {}
    for part, planes in (("", pack(pelt)), ("fin-", None if pelt.fin is None else pack_fin(pelt.fin))):
        if planes is None:
            continue
        stem = "fin" if part else "plane"
        images |= {f"{prefix}{stem}{i}.png": (pixels, False) for i, pixels in enumerate(planes.coefficients)}
        if planes.colour is not None:
            images[f"{prefix}{part}colour.png"] = planes.colour, True
        if planes.direction is not None:
            images[f"{prefix}{part}direction.png"] = planes.direction, False
    if cache is not None and write_kept(cache, folder, images, encoder()):
        return list(images)
    with ThreadPoolExecutor(cores()) as workers:
        list(workers.map(lambda name: write_png(folder / name, *images[name]), images))
    if cache is not None:
        keep_images(cache, folder, images, encoder())
    return list(images)


@lru_cache
def encoder() -> str:
    """All that decides a file beside its pixels: the library, and this module, which may be under work."""
    return f"{version('OpenImageIO')} {hashlib.sha256(Path(__file__).read_bytes()).hexdigest()}"


def read_png(path: Path) -> Bytes:
    """(height, width, channels) bytes of an image as they are. Raises PlaneError, also where it is too large."""
    try:
        check_regular(path, Budget(str(path), "bytes"))
    except OSError as error:
        raise PlaneError(f"{path}: {(error.strerror or 'cannot be read').lower()}, expected a picture") from error
    except MeshError as error:
        raise PlaneError(str(error)) from error
    with _silent():
        return _read_png(path)


def _read_png(path: Path) -> Bytes:
    config = oiio.ImageSpec()
    config.attribute("oiio:UnassociatedAlpha", 1)
    source = oiio.ImageInput.open(os.fspath(path), config)
    if source is None:
        oiio.geterror()  # taken away, as above
        raise PlaneError(f"{path}: cannot be read as a picture, expected PNG, JPEG or the like")
    try:
        spec = source.spec()
        if spec.format != oiio.UINT8:
            raise PlaneError(f"{path}: samples are {spec.format}, expected bytes")
        if spec.width * spec.height > limits().pixels:
            raise PlaneError(f"{path}: {spec.width} x {spec.height} pixels, expected at most {limits().pixels}")
        pixels = source.read_image("uint8")
        if pixels is None:
            raise PlaneError(f"{path}: is broken or cut short, expected a whole picture")
        return np.asarray(pixels, dtype=np.uint8).reshape(spec.height, spec.width, spec.nchannels)
    finally:
        source.close()


@contextmanager
def _silent() -> Iterator[None]:
    """Keep off standard error what libpng writes there itself; its errors are raised as well."""
    try:
        kept = os.dup(STANDARD_ERROR)
    except OSError:  # closed
        yield
        return
    try:
        with open(os.devnull, "wb") as null:  # noqa: PTH123 — no path
            os.dup2(null.fileno(), STANDARD_ERROR)
        yield
    finally:
        os.dup2(kept, STANDARD_ERROR)
        os.close(kept)


def _two_planes(codes: Bytes, alpha: Bytes, tint: Bytes) -> Bytes:
    """(2, ..., 4): coefficients (..., C) in their slots, α and tint (...) in the two spare channels."""
    planes = np.zeros((2, *alpha.shape, 4), dtype=np.uint8)
    for i, (plane, channel) in enumerate(SLOTS[: codes.shape[-1]]):
        planes[plane, ..., channel] = codes[..., i]
    planes[1, ..., 2] = alpha
    planes[1, ..., 3] = tint
    return planes


def _column(stack: Bytes) -> Bytes:
    """(K, N, N, C) → (K·N, N, C), layer 0 on top."""
    layers, size, _, channels = stack.shape
    return np.ascontiguousarray(stack).reshape(layers * size, size, channels)
