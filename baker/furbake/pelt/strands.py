"""Procedural hairs over one periodic tile: guard hairs above a shorter undercoat.

Units are tile widths; the tile is the square [0, 1)² in u, v and the skin is at z = 0.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Hairs:
    """One kind of hair. Lengths are fractions of the fur's height, radii tile widths."""

    count: int = 330
    """Hairs per tile, 0 to 20 000."""
    length: tuple[float, float] = (0.8, 1.0)
    """Shortest and longest hair, 0 to 1."""
    radius: tuple[float, float] = (0.011, 0.004)
    """Radius at the root and at the tip, 0 to 0.1."""
    curl: float = 0.01
    """Radius of the helix that the tip describes, 0 to 0.5."""
    turns: float = 1.3
    """Turns of that helix from root to tip, 0 to 20."""
    stray: float = 0.05
    """Spread (standard deviation) of the tips' own lean, 0 to 1."""
    clump: float = 0.5
    """Share of the way that tips are drawn to their clump's centre, 0 to 1."""


@dataclass(frozen=True)
class Coat:
    """A whole coat: what grows, how it leans together, how hairs differ in shade and hue."""

    guard: Hairs = Hairs()
    under: Hairs = Hairs(count=400, length=(0.4, 0.7), radius=(0.009, 0.003), curl=0.02, stray=0.08, clump=0.3)
    lean: tuple[float, float] = (0.0, 0.34)
    """Mean displacement of the longest tips along u and v, tile widths, -2 to 2."""
    bend: float = 1.7
    """Exponent of the lean along the hair: 1 straight, above 1 curved, 1 to 4."""
    clumps: int = 60
    """Clump centres per tile, 1 to 5 000."""
    shade: float = 0.15
    """Spread of tint from hair to hair, 0 to 0.5."""
    opacity: float = 3.0
    """Optical depth of 1/16 of the fur's height filled with hair, 0.05 to 50."""


@dataclass(frozen=True)
class Strands:
    """Hairs as polylines, roots first.

    points : (S, P, 3) float, tile widths; u and v may leave [0, 1): the tile repeats
    radius : (S, P) float, tile widths
    tint : (S,) float, 0..1, brightness of the whole hair
    hue : (S,) float, 0..1, from the ramp's first tip colour to its second
    """

    points: Array
    radius: Array
    tint: Array
    hue: Array


POINTS = 25
"""Points per hair. Curls of up to six turns keep four points a turn."""


def scatter(count: int, rng: np.random.Generator) -> Array:
    """Jittered points in the unit tile, (count, 2): one per cell of a grid, so that no bald spots arise."""
    side = int(np.ceil(np.sqrt(max(count, 1))))
    cells = np.stack(np.meshgrid(np.arange(side), np.arange(side), indexing="ij"), -1).reshape(-1, 2)
    points: Array = (cells + rng.random((side * side, 2))) / side
    return points[rng.permutation(side * side)[:count]]


def grow(coat: Coat, height: float, seed: int) -> Strands:
    """Grow the hairs of one tile.

    Every hair rises linearly to its own length, follows the common lean, strays, curls, and is drawn towards the
    nearest clump's centre across the tile's borders. The longest hair ends exactly at `height` (tile widths), so that
    the topmost slab is never empty.
    """
    rng = np.random.default_rng(seed)
    kinds = (coat.guard, coat.under)
    count = sum(kind.count for kind in kinds)

    def each(values: list[float]) -> Array:
        """One value per hair from one value per kind of hair, (S,)."""
        return np.repeat(np.array(values, float), [kind.count for kind in kinds])

    def uniform(low: float, high: float) -> Array:
        return rng.uniform(low, high, count)

    root = np.concatenate([scatter(kind.count, rng) for kind in kinds])
    centre = scatter(coat.clumps, rng)
    to_centre = centre[None] - root[:, None]
    to_centre -= np.round(to_centre)
    clump = np.argmin((to_centre**2).sum(-1), axis=1)
    to_clump = to_centre[np.arange(count), clump]

    # Hairs of one clump share a length, a lean and a shade: tufts, not noise.
    tuft_length = rng.uniform(0.82, 1.0, coat.clumps)[clump]
    tuft_lean = rng.normal(0.0, 0.8, (coat.clumps, 2))[clump]
    tuft_shade = rng.normal(0.0, 0.7, coat.clumps)[clump]
    tuft_hue = rng.uniform(0.0, 1.0, coat.clumps)[clump]

    guard = each([1.0, 0.0])
    share = rng.random(count)
    length = each([k.length[0] for k in kinds]) * (1 - share) + each([k.length[1] for k in kinds]) * share
    length *= np.where(guard > 0, tuft_length, 1.0)
    length *= height / length.max()

    stray = each([k.stray for k in kinds])[:, None]
    tip = np.array(coat.lean) + stray * (tuft_lean + rng.normal(0.0, 1.0, (count, 2)))
    tip *= (length / height)[:, None]
    pull = to_clump * (each([k.clump for k in kinds]) * uniform(0.6, 1.1))[:, None]

    s = np.linspace(0.0, 1.0, POINTS)
    angle = (
        2
        * np.pi
        * (rng.random(count)[:, None] + each([k.turns for k in kinds])[:, None] * uniform(0.7, 1.3)[:, None] * s)
    )
    curl = (each([k.curl for k in kinds]) * uniform(0.4, 1.2))[:, None] * s
    sideways = tip[:, None] * s[:, None] ** coat.bend + pull[:, None] * s[:, None] ** 1.3
    sideways += curl[..., None] * np.stack([np.cos(angle), np.sin(angle)], -1)
    points = np.concatenate([root[:, None] + sideways, (length[:, None] * s)[..., None]], -1)

    thickness = uniform(0.8, 1.2)[:, None]
    taper = s**1.5
    radius = thickness * (
        each([k.radius[0] for k in kinds])[:, None] * (1 - taper) + each([k.radius[1] for k in kinds])[:, None] * taper
    )
    tint = np.clip(0.78 + coat.shade * (tuft_shade + rng.normal(0.0, 1.0, count)), 0.35, 1.0)
    hue = np.clip(0.6 * tuft_hue + 0.4 * rng.random(count), 0.0, 1.0)
    return Strands(points=points, radius=radius, tint=tint, hue=hue)
