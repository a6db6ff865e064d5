"""Photographs of real fur or cloth become the texels of a tile: light, colour, coverage.

A photograph shows what an eye above sees, and no more. So the tile is a skin: opaque, without what lies below. Where
the light curves tell heights, its slabs stand on each other as steps: a texel that grazing lamps leave darker than
lamps above do lies in the shadow of others, lower than them. On six furs of our own, drawn from above, the ranks of
such heights agree with the true ones by .69 to .84. That ratio knows nothing of the colour of a texel.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from furbake.daylight import PAGE
from furbake.pelt.fin import overlap
from furbake.pelt.light.transport import hemisphere
from furbake.rti.files import LP, is_rti, read_relit, suffix_of
from furbake.rti.fit import LUMINANCE
from furbake.rti.photographs import read_photographs
from furbake.rti.relit import Array, Bytes, RtiError, Single
from furbake.surface.colours import LINEAR

BORDER = 0.25
"""Share of the tile by which its opposite edges are blended."""

LOWEST = 0.02
"""lz of the lowest lamp that counts."""

LEAST = 8
"""Lamps above that: some judge the fit."""

GRAZING = 0.5
"""lz below which a lamp grazes."""

AGREEMENT = 0.5
"""Correlation of the heights that two halves of the grazing lamps tell, from which they are believed."""

WHITE = 4 * np.pi / PAGE.lamp[1]
"""L of white in a photograph: nobody knows its exposure, so the page's lamp shows it as the photograph does."""

LAMPS, UNSEEN = 64, 32
"""Lamps under which a PTM is looked at, and others for the figures."""

HELD_OUT = 6
"""One photograph in so many judges the fit."""


@dataclass(frozen=True)
class Measured:
    """A periodic tile of K slabs of N × N texels, row = v.

    lights : (n, 3), held_out : (n,) bool, samples : (n, K, N, N) L, in the unit of `light.transport`
    alpha : (K, N, N) coverage, colour : (N, N, 3) linear
    notices : what was left out, and how heights were found, one sentence each
    """

    lights: Array
    held_out: np.ndarray[tuple[int], np.dtype[np.bool_]]
    samples: Single
    alpha: Array
    colour: Array
    notices: tuple[str, ...]


def measure(path: Path, layers: int, size: int) -> Measured:
    """The tile of a `.lp` with its photographs, a PTM or a folder of relight. Raises RtiError."""
    lights, pictures, notices = _pictures(path)
    kept = lights[:, 2] > LOWEST
    if kept.sum() < LEAST:
        raise RtiError(f"{path}: {kept.sum()} lamps above the horizon, expected {LEAST} or more")
    tile = [periodic(LINEAR[pixels], size) for pixels, keep in zip(pictures, kept, strict=True) if keep]
    lights, linear = lights[kept], np.stack(tile)
    held_out = np.arange(len(lights)) % HELD_OUT == HELD_OUT - 1
    if suffix_of(path) != LP:
        held_out = np.arange(len(lights)) >= LAMPS
    brightness = linear @ LUMINANCE.astype(np.float32)
    brightest = np.maximum(brightness.max(0), 1e-4)
    mean = np.maximum(brightness.sum(0), 1e-6)
    colour = np.clip(linear.sum(0) / mean[..., None] * np.minimum(brightest, 1)[..., None], 0, 1)
    light = WHITE * brightness / np.minimum(brightest, 1)
    alpha, told = _steps(brightness.astype(np.float64), lights, layers)
    samples = np.repeat(light[:, None], layers, axis=1).astype(np.float32)
    return Measured(lights, held_out, samples, alpha, np.asarray(colour, np.float64), (*notices, *told))


def _pictures(path: Path) -> tuple[Array, Iterator[Bytes], tuple[str, ...]]:
    """Lamps, the pictures under them, and what was left out."""
    if not is_rti(path):
        raise RtiError(f"{path}: unknown kind, expected FILE.lp, FILE.ptm, or info.json of relight")
    if suffix_of(path) == LP:
        photographs = read_photographs(path)
        return photographs.lights, iter(photographs), photographs.notices
    relit = read_relit(path)
    lights = np.concatenate([hemisphere(LAMPS), hemisphere(UNSEEN, turn=1.0)])
    return lights, map(relit.picture, lights), ()


def periodic(pixels: Array, size: int) -> Single:
    """The middle of a picture (H, W, 3) as a periodic tile (size, size, 3), row 0 at the bottom.

    A border beyond the tile is faded into its other side; what the fade takes of the contrast is given back
    (Heitz and Neyret, High-Performance By-Example Noise, 2018).
    """
    height, width = pixels.shape[:2]
    side, border = min(height, width), round(BORDER * size)
    top, left = (height - side) // 2, (width - side) // 2
    spread = overlap(side, size + border).astype(np.float32)
    square = pixels[top : top + side, left : left + side].astype(np.float32)
    whole = np.einsum("ri,ijk,cj->rck", spread, square, spread, optimize=True)[::-1]
    mean = whole.mean((0, 1))
    share = ((np.arange(border) + 0.5) / border).astype(np.float32)
    for axis in (0, 1):
        whole = np.moveaxis(whole, axis, 0)
        fade = share.reshape(-1, 1, 1)
        mixed = fade * (whole[:border] - mean) + (1 - fade) * (whole[size:] - mean)
        whole = np.concatenate([mean + mixed / np.sqrt(fade**2 + (1 - fade) ** 2), whole[border:size]])
        whole = np.moveaxis(whole, 0, axis)
    return np.ascontiguousarray(np.clip(whole, 0, 1), np.float32)


def heights(brightness: Array, lights: Array) -> tuple[Array, float]:
    """Heights of texels, (N, N) ranks from 0 to 1, and how far two halves of the grazing lamps agree, −1 to 1.

    brightness : (n, N, N) linear, lights : (n, 3)
    """
    per_cosine = brightness / lights[:, 2, None, None]
    low = np.flatnonzero(lights[:, 2] < GRAZING)
    low = low[np.argsort(np.arctan2(lights[low, 1], lights[low, 0]))]
    high = np.flatnonzero(lights[:, 2] >= GRAZING)
    if len(low) < 4 or len(high) < 1:
        return np.ones(brightness.shape[1:]), 0.0
    above = np.maximum(per_cosine[high].mean(0), 1e-6)
    first, second = (_ranks(per_cosine[low[i::2]].mean(0) / above) for i in (0, 1))
    agreement = float(np.corrcoef(first.ravel(), second.ravel())[0, 1])
    return _ranks(per_cosine[low].mean(0) / above), agreement


def _ranks(values: Array) -> Array:
    order = np.argsort(values, axis=None, kind="stable")
    ranks = np.empty(values.size)
    ranks[order] = (np.arange(values.size) + 0.5) / values.size
    return ranks.reshape(values.shape)


def _steps(brightness: Array, lights: Array, layers: int) -> tuple[Array, tuple[str, ...]]:
    """Coverage of the slabs, (K, N, N): each texel up to its height. All of it where heights are not told."""
    if layers == 1:
        return np.ones((1, *brightness.shape[1:])), ()
    found, agreement = heights(brightness, lights)
    if agreement < AGREEMENT:
        told = f"heights: halves of the lamps agree by {agreement:.2f}, less than {AGREEMENT:g}: all texels are as high"
        return np.ones((layers, *brightness.shape[1:])), (told,)
    floors = np.arange(layers)[:, None, None]
    told = f"heights: from shadows under grazing lamps, on which halves of the lamps agree by {agreement:.2f}"
    return np.clip(found * layers - floors + (floors == 0), 0, 1), (told,)
