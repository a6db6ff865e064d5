"""Base colour at every vertex, and any other picture painted over a model's own texture coordinates."""

from __future__ import annotations

import io
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from furbake.surface.limits import limits
from furbake.surface.material import CLAMP, MIRROR, REPEAT, Material, Picture, Skin
from furbake.surface.soup import Floats, Ints, Soup

Bytes = NDArray[np.uint8]

FORMATS = ("PNG", "JPEG", "WEBP", "BMP", "GIF", "TGA", "TIFF", "PPM")
"""Formats that are decoded, of all that Pillow knows: one of the others starts a program."""

STRIPE = 256
"""Rows of a picture that are converted together."""

QUALITY = 90
"""Quality of JPEG."""

STEPS = 6
"""Points along each side of a face at which its picture is read."""


def from_srgb(values: Floats) -> Floats:
    """Linear 0..1 of sRGB 0..1 (IEC 61966-2-1)."""
    return np.where(values <= 0.04045, values / 12.92, ((np.maximum(values, 0.04045) + 0.055) / 1.055) ** 2.4)


def srgb_bytes(linear: Floats) -> Bytes:
    """sRGB bytes of linear 0..1; the reverse of `from_srgb`."""
    held = np.clip(linear, 0.0, 1.0)
    encoded = np.where(held <= 0.0031308, 12.92 * held, 1.055 * np.maximum(held, 0.0031308) ** (1.0 / 2.4) - 0.055)
    return np.rint(255.0 * encoded).astype(np.uint8)


LINEAR: Floats = from_srgb(np.arange(256) / 255.0)
"""Linear value of every sRGB byte."""


def base_colours(soup: Soup, materials: tuple[Material, ...]) -> tuple[Floats, set[int]]:
    """(V, 3) linear base colour of every vertex, and the materials whose pictures are broken.

    As glTF says: factor × picture × vertex colour. The picture is averaged over the part of each face that is
    nearest to the vertex, so that one fine line in it does not colour a whole vertex.
    """
    total, share = np.zeros((len(soup.vertices), 3)), np.zeros(len(soup.vertices))
    seen, broken = _seen(soup, materials)
    for i, mine in soup.pieces():
        material = materials[i]
        colour = np.tile(np.array(material.factor[:3]), (len(mine.faces), 3, 1))
        if mine.paint is not None:
            colour = colour * mine.paint[..., :3]
        if i in seen:
            colour = colour * seen[i]
        a, b, c = (mine.vertices[mine.faces[:, j]] for j in range(3))
        area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
        weight = np.repeat(np.maximum(area, area.max(initial=0.0) * 1e-9 + 1e-300), 3)
        corners = mine.faces.reshape(-1)
        np.add.at(total, corners, weight[:, None] * colour.reshape(-1, 3))
        np.add.at(share, corners, weight)
    return np.clip(total / np.maximum(share, 1e-300)[:, None], 0.0, 1.0), broken


def _seen(soup: Soup, materials: tuple[Material, ...]) -> tuple[dict[int, Floats], set[int]]:
    """(F', 3, 3) linear colours that each material's picture gives to its corners; materials whose pictures are broken.

    One picture is in memory at a time.
    """
    wanted: dict[Picture, list[tuple[int, Floats]]] = {}
    for i, mine in soup.pieces():
        picture = materials[i].picture
        if picture is not None and mine.uv is not None:
            wanted.setdefault(picture, []).append((i, np.nan_to_num(mine.uv)))
    seen: dict[int, Floats] = {}
    broken: set[int] = set()
    for picture, parts in wanted.items():
        pixels = decode(picture)
        if pixels is None:
            broken |= {i for i, _ in parts}
        else:
            seen |= {i: _corner_means(pixels, uv, materials[i].wrap) for i, uv in parts}
    return seen, broken


def decode(picture: Picture) -> Bytes | None:
    """(height, width, 4) sRGB bytes, or None where the file is broken or has more pixels than the bounds allow."""
    try:
        with _any_size(), Image.open(io.BytesIO(picture.data), formats=FORMATS) as image:
            width, height = image.size
            if width * height > limits().pixels:
                return None
            pixels = np.empty((height, width, 4), dtype=np.uint8)
            for top in range(0, height, STRIPE):
                rows = image.crop((0, top, width, min(top + STRIPE, height)))
                pixels[top : top + STRIPE] = np.asarray(rows.convert("RGBA"))
            return pixels
    except Exception:  # noqa: BLE001 — image plug-ins raise anything on a broken file
        return None


def picture_size(picture: Picture) -> tuple[int, int] | None:
    """(width, height) by the file's header alone, or None where it has none."""
    try:
        with _any_size(), Image.open(io.BytesIO(picture.data), formats=FORMATS) as image:
            return image.size
    except Exception:  # noqa: BLE001 — as above
        return None


@contextmanager
def _any_size() -> Iterator[None]:
    """Switch off Pillow's own bound on pixels, so that ours can be higher."""
    before = Image.MAX_IMAGE_PIXELS
    Image.MAX_IMAGE_PIXELS = None
    try:
        yield
    finally:
        Image.MAX_IMAGE_PIXELS = before


def translucent(piece: Skin) -> bool:
    """True if some of a skin is transparent: by its factor, its vertex colours or its picture."""
    picture = piece.material.picture
    pixels = None if picture is None or piece.uv is None else decode(picture)
    return (
        piece.material.factor[3] < 1.0
        or (piece.colour is not None and bool((piece.colour[:, 3] < 1.0).any()))
        or (pixels is not None and bool((pixels[..., 3] < 255).any()))
    )


def portable(picture: Picture) -> Picture | None:
    """The picture in a format that every glTF viewer reads: WebP becomes PNG; None where it is broken."""
    if picture.kind != "image/webp":
        return picture
    pixels = decode(picture)
    return None if pixels is None else as_png(pixels)


def as_png(pixels: Bytes) -> Picture:
    """A picture of (height, width, 4) sRGB bytes."""
    stream = io.BytesIO()
    Image.fromarray(pixels).save(stream, "PNG")
    return Picture(stream.getvalue(), "image/png")


def smaller(pixels: Bytes) -> Picture:
    """A picture of (height, width, 3) sRGB bytes as PNG, or as JPEG with whole chroma where that is smaller."""
    image, png, jpeg = Image.fromarray(pixels), io.BytesIO(), io.BytesIO()
    image.save(png, "PNG", optimize=True)
    image.save(jpeg, "JPEG", quality=QUALITY, subsampling=0, optimize=True)
    if len(png.getvalue()) <= len(jpeg.getvalue()):
        return Picture(png.getvalue(), "image/png")
    return Picture(jpeg.getvalue(), "image/jpeg")


def sample_picture(
    pixels: Bytes, uv: Floats, wrap: tuple[int, int] = (REPEAT, REPEAT), table: Floats | None = None
) -> Floats:
    """(..., channels) the picture at (..., 2) texture coordinates, bilinear, v down; each byte through `table` first.

    pixels : (height, width, channels) bytes
    table : (256,) value of each byte, by default byte / 255
    """
    values = np.arange(256) / 255.0 if table is None else table
    height, width = pixels.shape[:2]
    x0, x1, s = _taps(uv[..., 0], width, wrap[0])
    y0, y1, t = _taps(uv[..., 1], height, wrap[1])
    s, t = s[..., None], t[..., None]
    above = (1.0 - s) * values[pixels[y0, x0]] + s * values[pixels[y0, x1]]
    below = (1.0 - s) * values[pixels[y1, x0]] + s * values[pixels[y1, x1]]
    return np.asarray((1.0 - t) * above + t * below)


def _taps(place: Floats, size: int, wrap: int) -> tuple[Ints, Ints, Floats]:
    """The two texels beside each place (in images) and the share of the second."""
    at = np.clip(np.nan_to_num(place), -1e6, 1e6) * size - 0.5
    first = np.floor(at)
    low = first.astype(np.int64)
    return _wrapped(low, size, wrap), _wrapped(low + 1, size, wrap), at - first


def _wrapped(index: Ints, size: int, wrap: int) -> Ints:
    if wrap == CLAMP:
        return np.clip(index, 0, size - 1)
    if wrap == MIRROR:
        index = np.mod(index, 2 * size)
        return np.minimum(index, 2 * size - 1 - index)
    return np.mod(index, size)


def _corner_means(pixels: Bytes, uv: Floats, wrap: tuple[int, int]) -> Floats:
    """(F, 3, 3) linear colour around each corner: mean over lattice points, each given to its nearest corner."""
    lattice = np.array([(i, j) for i in range(STEPS) for j in range(STEPS - i)], dtype=np.float64) + 1.0 / 3.0
    first, second = (lattice / STEPS).T
    bary = np.stack([1.0 - first - second, first, second], axis=1)
    weight = bary * (bary == bary.max(axis=1, keepdims=True))
    weight /= weight.sum(axis=0)
    colour = np.zeros((*uv.shape[:2], 3))
    for point, shares in zip(bary, weight, strict=True):
        seen = sample_picture(pixels[..., :3], np.einsum("k,fkd->fd", point, uv), wrap, LINEAR)
        colour += shares[None, :, None] * seen[:, None, :]
    return colour


def luminance(pixels: NDArray[Any]) -> Bytes:
    """(height, width) bytes of a picture as it is painted: its only channel, or Rec. 709 weights of R, G, B.

    What is transparent is not painted, and counts as white. Raises ValueError where it is no picture of bytes.
    """
    array = np.asarray(pixels)
    if array.ndim == 2:
        array = array[..., None]
    if array.ndim != 3 or array.dtype != np.uint8 or array.shape[2] not in (1, 2, 3, 4) or array.size == 0:
        raise ValueError(f"{array.dtype} of shape {np.shape(pixels)}, expected (height, width, 1 to 4) bytes")
    grey = array[..., 0].astype(np.float64)
    if array.shape[2] >= 3:
        grey = array[..., :3] @ np.array([0.2126, 0.7152, 0.0722])
    if array.shape[2] in (2, 4):
        grey = 255.0 + (grey - 255.0) * (array[..., -1] / 255.0)
    return np.rint(grey).astype(np.uint8)
