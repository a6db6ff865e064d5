"""Stored slabs that show as much of every height as the hairs do.

Slabs are composited as if their hairs had nothing to do with each other. A hair goes on from slab to slab, and what
lies below it is hidden once: `shown_slabs` takes 1 − α of every slab to the power at which all of them together show,
from straight above, as much of each height as the strands do.

Combed hairs lie along more of the skin and hide more of it, by how much steeper they were before: the shader takes
1 − α to a further power, for which `spread_of` says how far the hairs' own slopes differ. Seen from aside all hairs lie
along more of it, and `slant` is the power for an eye there: 1/n·v, as of dust, where fur is dense, since only its tips
are seen either way; by the hairs' slopes where skin is seen between them (`open_share`), if they hide more so.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from furbake.pelt.hairs.dirt import Crumbs
from furbake.pelt.hairs.strands import Strands
from furbake.pelt.hairs.volume import Volume, coarsen, moved

Array = NDArray[np.float64]
Single = NDArray[np.float32]

MAX_COVERAGE = 0.996
"""Largest coverage, as in `shellOpacity` of hair/opacity.glsl."""

BETWEEN = 0.25
"""Texels between their middles and where they are read, along both axes: pixels lie anywhere."""

PIXELS = 256
"""Points a side of a tile at which the uppermost hair is looked for."""

MAX_DISCS = 16
"""Discs at most that stand for a segment of a hair."""

CHUNK = 1 << 16
"""Discs that are drawn at once."""

POWERS = (0.1, 4.0)
"""Least and largest power of a slab."""

STEPS = 20
"""Steps by halves towards a power."""

MAX_SLOPE, LEVELS = 4.0, 16
"""Largest slope that counts, and heights whose mean slopes are taken apart."""

MIN_SPREAD = 0.01
"""Least spread of the hairs' slopes."""

DENSE, SPARSE = 0.1, 0.3
"""Shares of the skin seen from above up to which fur hides it as dust does, and from which on as its hairs do."""


def shown_slabs(fine: Volume, strands: Strands, layers: int, size: int, mud: Crumbs | None = None) -> Volume:
    """The stored slabs of an oversampled volume, with as much of each seen from above as of the strands.

    strands, mud : what the volume was drawn from
    """
    coarse = coarsen(fine, layers, size)
    shares = seen_from_above_by_slab(uppermost(strands, coarse.height, mud), layers)
    return replace(coarse, sigma=coarse.sigma * powers(coarse.coverage, shares)[:, None, None])


def uppermost(strands: Strands, height: float, mud: Crumbs | None = None) -> Array:
    """Height of the uppermost hair at `PIXELS`² points of the tile, shares of `height`; −1 where there is none."""
    points, radius = strands.points, strands.radius
    level = np.linalg.norm(np.diff(points[..., :2], axis=1), axis=-1)
    thick = np.maximum(np.minimum(radius[:, 1:], radius[:, :-1]), 0.5 / PIXELS)
    parts = int(np.clip(np.ceil(np.percentile(level / thick, 95)), 1, MAX_DISCS))
    share = ((np.arange(parts) + 0.5) / parts)[:, None, None]
    top = np.full(PIXELS * PIXELS, -1.0)
    discs = points[:, :-1] + share[..., None] * np.diff(points, axis=1)
    _draw(top, discs.reshape(-1, 3), (radius[:, :-1] + share * np.diff(radius, axis=1)).ravel(), height)
    if mud is not None:
        _draw(top, mud.centre, mud.radius, height)
    return top


def _draw(top: Array, centre: Array, radius: Array, height: float) -> None:
    """Raise `top` to the height of discs where they lie."""
    reach = np.ceil(radius * PIXELS).astype(np.int64)
    for pixels in np.unique(reach):
        alike = np.flatnonzero(reach == pixels)
        for first in range(0, len(alike), CHUNK):
            some = alike[first : first + CHUNK]
            _draw_alike(top, centre[some], radius[some] * PIXELS, height, int(pixels))


def _draw_alike(top: Array, centre: Array, thick: Array, height: float, reach: int) -> None:
    """As `_draw`, of discs `thick` pixels in radius, of which none is more than `reach`."""
    position = centre[:, :2] * PIXELS - 0.5
    nearest = np.floor(position + 0.5).astype(np.int64)
    square, up = thick * thick, centre[:, 2] / height
    for dv in range(-reach, reach + 1):
        v = nearest[:, 1] + dv - position[:, 1]
        row, beside = (nearest[:, 1] + dv) % PIXELS * PIXELS, v * v
        for du in range(-reach, reach + 1):
            u = nearest[:, 0] + du - position[:, 0]
            inside = np.flatnonzero(u * u + beside <= square)
            np.maximum.at(top, row[inside] + (nearest[inside, 0] + du) % PIXELS, up[inside])


def seen_from_above_by_slab(top: Array, layers: int) -> Array:
    """Share of the tile in which each slab is seen from above, (K,); top : as of `uppermost`."""
    slab = np.clip((top[top >= 0] * layers).astype(np.int64), 0, layers - 1)
    return np.bincount(slab, minlength=layers) / len(top)


def powers(coverage: Array, shares: Array) -> Array:
    """Powers (K,) of 1 − α at which slabs (K, N, N) show the `shares` (K,) from straight above, within `POWERS`."""
    found, shown = np.ones(len(shares)), 0.0
    clear = np.ones(coverage.shape[1:])
    for k in reversed(range(len(shares))):
        read = moved(coverage[k].astype(np.float32), np.full(2, BETWEEN))
        depth = np.log1p(-np.minimum(read, MAX_COVERAGE)).astype(float)
        wanted = float(shares[k:].sum()) - shown
        low, high = POWERS
        for _ in range(STEPS):
            middle = (low + high) / 2
            if -(clear * np.expm1(middle * depth)).mean() > wanted:
                high = middle
            else:
                low = middle
        found[k] = (low + high) / 2
        hidden = -clear * np.expm1(found[k] * depth)
        shown, clear = shown + float(hidden.mean()), clear - hidden
    return found


def spread_of(strands: Strands, height: float) -> float:
    """Mean distance of the hairs' slopes from the mean slope at their height, at least `MIN_SPREAD`.

    A slope is a displacement per height; hairs count by what they hide; height : of the fur, tile widths
    """
    step = np.diff(strands.points, axis=1)
    slope = np.clip(step[..., :2] / np.maximum(step[..., 2:], 1e-6), -MAX_SLOPE, MAX_SLOPE).reshape(-1, 2)
    weight = ((strands.radius[:, 1:] + strands.radius[:, :-1]) * np.maximum(step[..., 2], 0)).ravel()
    middle = (strands.points[:, 1:, 2] + strands.points[:, :-1, 2]).ravel() / (2 * height)
    level = np.clip((middle * LEVELS).astype(np.int64), 0, LEVELS - 1)
    total = np.maximum(np.bincount(level, weight, LEVELS), 1e-12)
    means = np.stack([np.bincount(level, weight * part, LEVELS) / total for part in slope.T], -1)
    apart = np.linalg.norm(slope - means[level], axis=1)
    return max(float((weight * apart).sum() / max(float(weight.sum()), 1e-12)), MIN_SPREAD)


def open_share(coverage: Array) -> float:
    """Share of the skin that is seen from straight above between the hairs of slabs (K, N, N)."""
    clear = np.ones(coverage.shape[1:])
    for slab in coverage:
        clear *= 1 - np.minimum(moved(slab.astype(np.float32), np.full(2, BETWEEN)), MAX_COVERAGE)
    return float(clear.mean())


def sparse(share: float) -> float:
    """How far fur that leaves this share of the skin open hides it by its hairs' slopes, 0 (as dust) to 1."""
    return float(np.clip((share - DENSE) / (SPARSE - DENSE), 0, 1))


def slant(eye: Array, slope: Array, spread: float, share: float) -> float:
    """Power of 1 − α for an eye there, over that for one straight above.

    eye : (3,) unit vector above the horizon; slope : (2,) mean of the hairs there, displacement per height
    spread, share : as of `spread_of` and `open_share`
    """
    by_hairs = np.hypot(np.linalg.norm(slope - eye[:2] / eye[2]), spread) / np.hypot(np.linalg.norm(slope), spread)
    return float(max(1 / eye[2], (1 - sparse(share)) / eye[2] + sparse(share) * by_hairs))
