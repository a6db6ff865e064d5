"""Wet fur: the same hairs, drawn together into fewer, larger clumps that end in points, and lying lower.

Water between hairs pulls them together until a clump is one thick strand with the skin showing between it and the next.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from furbake.pelt.hairs.strands import Strands
from furbake.pelt.hairs.tiling import nearest, relaxed, scattered_points

Array = NDArray[np.float64]

FEWER = 0.4
"""Clumps of soaked fur over those of dry fur."""

SETTLING = 4
"""Rounds that make clumps more alike: pits between large ones would show the tile's repeat."""

PULL = (0.75, 1.0)
"""Share of the way to its clump that the tip of a soaked hair goes, from hair to hair."""

SHORTER = 0.15
"""Share of its height that soaked fur loses."""

ALBEDO = 0.6 / 0.85
"""Albedo of soaked hairs over that of dry ones: water between a hair's scales lets more light in."""

SHADE = 0.55
"""Colour of soaked hairs over that of dry ones."""

GLOSS, SHARPNESS = 1.5, 4.0
"""Strength and exponent of the highlights of soaked hairs over those of dry ones: a film of water is smooth."""

HEIGHTS = 33
"""Heights at which the middle of a clump is known."""


def wet(strands: Strands, wetness: float, clumps: int, seed: int) -> Strands:
    """The hairs at a wetness of 0 (as they are) to 1 (soaked), of a coat that has `clumps` of them when dry.

    A point at a share s of its hair goes the share wetness·pull·s² of the way to the middle of its clump, which is at
    the same height and leans as the clump's hairs do on average.
    """
    if wetness == 0:
        return strands
    rng = np.random.default_rng([seed, 1])
    root = strands.points[:, 0, :2]
    centre = scattered_points(max(1, round(FEWER * clumps)), rng)
    for _ in range(SETTLING):
        centre = relaxed(centre, root)
    clump, to_centre = nearest(root, centre)
    pull = rng.uniform(*PULL, len(root))
    s = np.linspace(0.0, 1.0, strands.points.shape[1])
    sideways = strands.points[..., :2] - root[:, None]
    to_middle = to_centre[:, None] + middles(strands, clump, len(centre)) - sideways
    points = strands.points.copy()
    points[..., :2] += wetness * pull[:, None, None] * (s * s)[:, None] * to_middle
    points[..., 2] *= 1 - SHORTER * wetness
    return Strands(points, strands.radius, strands.tint, strands.hue)


def middles(strands: Strands, clump: NDArray[np.intp], count: int) -> Array:
    """How far the middle of each hair's clump has moved aside at the heights of the hair's points, (S, P, 2).

    clump : (S,) index below `count`. The middle is that of all hairs that are as long, the less of one the nearer its
    tip, so that it does not jump where a hair ends.
    """
    points = strands.points
    length = points[:, -1, 2]
    height = np.linspace(0.0, length.max(), HEIGHTS)
    at = np.minimum(height / length[:, None], 1.0)
    weight = np.maximum(1.0 - at, 1e-3) * (height <= length[:, None] * (1 + 1e-9))
    sideways = _between(points[..., :2] - points[:, :1, :2], at)
    sums, weights = np.zeros((count, HEIGHTS, 2)), np.zeros((count, HEIGHTS))
    np.add.at(sums, clump, sideways * weight[..., None])
    np.add.at(weights, clump, weight)
    middle = sums / np.maximum(weights, 1e-12)[..., None]
    last = np.maximum.accumulate(np.where(weights > 0, np.arange(HEIGHTS), 0), axis=1)
    middle = np.take_along_axis(middle, last[..., None], axis=1)
    return _between(middle[clump], points[..., 2] / height[-1])


def _between(rows: Array, share: Array) -> Array:
    """Values (S, H, 2) of evenly spaced points at shares (S, P) of the way from the first to the last, (S, P, 2)."""
    at = share * (rows.shape[1] - 1)
    low = np.clip(np.floor(at).astype(np.int64), 0, rows.shape[1] - 2)
    part = (at - low)[..., None]
    before, after = (np.take_along_axis(rows, (low + step)[..., None], axis=1) for step in (0, 1))
    return np.asarray(before + part * (after - before))
