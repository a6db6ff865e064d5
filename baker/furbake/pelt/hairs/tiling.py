"""Points and noise on a tile that repeats: evenly spread, so that the repeat does not show.

Units are tile widths; the tile is the square [0, 1)² in u, v.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

Array = NDArray[np.float64]

TILE = np.ones(2)

EVENING_ROUNDS = 12
EVENING_GRID = 64
"""Cells per side on which the density of the hairs' upper halves is evened out, and how many times."""


def scattered_points(count: int, rng: np.random.Generator) -> Array:
    """Jittered points in the unit tile, (count, 2): one per cell of a grid, so that no bald spots arise."""
    side = int(np.ceil(np.sqrt(max(count, 1))))
    cells = np.stack(np.meshgrid(np.arange(side), np.arange(side), indexing="ij"), -1).reshape(-1, 2)
    points: Array = (cells + rng.random((side * side, 2))) / side
    return points[rng.permutation(side * side)[:count]]


def tile_noise(at: Array, waves: int, rng: np.random.Generator) -> Array:
    """Smooth periodic noise at points (S, 2) of the tile, (S,), mean 0, standard deviation 1.

    A sum of plane waves whose periods fit the tile, about `waves` of them along a side.
    """
    steps = np.arange(-waves, waves + 1)
    vectors = np.stack(np.meshgrid(steps, steps), -1).reshape(-1, 2)
    length = np.linalg.norm(vectors, axis=1)
    vectors = vectors[(length > 0.5 * waves) & (length < 1.2 * waves)]
    size = rng.normal(0.0, 1.0, len(vectors))
    size *= np.sqrt(2 / (size**2).sum())
    phase = rng.uniform(0.0, 2 * np.pi, len(vectors))
    noise: Array = np.cos(2 * np.pi * at @ vectors.T + phase) @ size
    return noise


def relaxed(centre: Array, root: Array) -> Array:
    """Centres half-way to the middle of the roots around them: no clump is much larger than the others, (C, 2)."""
    clump, way = nearest(root, centre)
    many = np.maximum(np.bincount(clump, minlength=len(centre)), 1)
    back = np.stack([np.bincount(clump, axis, len(centre)) for axis in way.T], -1) / many[:, None]
    return np.asarray((centre - 0.5 * back) % 1.0 % 1.0)  # twice: a hair below 0 is 1 after the first


def shuffle(centre: Array, rng: np.random.Generator) -> Array:
    """Values 0..1, evenly spread, one per centre, (C,), that differ from those of the centres around it.

    A value that many neighbours have in common shows from afar, and with it the tile's repeat.
    """
    noise = rng.random(len(centre))
    around = min(7, len(centre))
    if around > 1:
        _, near = cKDTree(centre, boxsize=TILE).query(centre, k=around)
        noise = noise - 0.8 * noise[np.asarray(near)[:, 1:]].mean(1)
    rank: Array = (np.argsort(np.argsort(noise, kind="stable"), kind="stable") + 0.5) / len(centre)
    return rank


def nearest(root: Array, centre: Array) -> tuple[NDArray[np.intp], Array]:
    """Index of each root's nearest centre in the repeating tile, (S,), and the way there, (S, 2)."""
    tree = cKDTree(centre % 1.0, boxsize=TILE)
    _, index = tree.query(root % 1.0)
    way = centre[index] - root
    return np.asarray(index), np.asarray(way - np.round(way))


def spread_out(points: Array, radius: Array, bend: Array, reach: float) -> Array:
    """Hairs bent a little from where they crowd to where the skin would show, (S, P, 3) → (S, P, 3).

    A pit shows the tile's repeat first. bend : (P,) share of a tip's displacement along the hair;
    reach : how far crowding is felt, tile widths; tufts are smaller and stay.
    """
    from scipy.ndimage import gaussian_filter, map_coordinates  # noqa: PLC0415 — 0.3 s, for this alone

    n, points = EVENING_GRID, points.copy()
    upper = radius * (points[..., 2] > 0.45 * points[..., 2].max())
    for _ in range(EVENING_ROUNDS):
        column, row = np.moveaxis(np.floor(points[..., :2] * n).astype(np.int64) % n, -1, 0)
        density = np.bincount((row * n + column).ravel(), upper.ravel(), n * n).reshape(n, n)
        density = gaussian_filter(density, reach * n, mode="wrap") / density.mean()
        near_tip = points[:, int(0.8 * len(bend)), 1::-1].T * n - 0.5
        slope = [(np.roll(density, -1, axis) - np.roll(density, 1, axis)) * n / 2 for axis in (1, 0)]
        uphill = np.stack([map_coordinates(way, near_tip, order=1, mode="grid-wrap") for way in slope], -1)
        points[..., :2] -= 0.5 * reach**2 * uphill[:, None] * bend[:, None]
    return points
