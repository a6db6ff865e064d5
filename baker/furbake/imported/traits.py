"""Traits of a groom and of the fur made of it, as samples and as histograms side by side."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.spatial import cKDTree

from furbake.imported.curves import Floats, Ints, nearest_others
from furbake.imported.drawn import Source, distance
from furbake.pelt.hairs.strands import Strands
from furbake.pelt.hairs.tiling import TILE

SAMPLE = 8000
"""Strands that are looked at."""

PLACES = 24
"""Places of the body at which the whole tile is looked at."""

JUDGED = ("length", "lean", "width")
"""Traits by which the best of some tiles is chosen."""

AROUND = 6
"""Neighbours of a strand whose tips are drawn together with its own, or not."""

POINTS = 25

BINS = 24

NAMES = {
    "length": "along the strand, model units",
    "lean": "share of the way from root to tip along the skin",
    "curl": "how much longer than that way a strand is",
    "width": "mean of a strand, model units",
    "clump": "distance of a tip to six neighbours' over that of the roots: below 1 strands clump",
}
"""Traits, and what each is."""


def compared(source: Source, strands: Strands, seed: int) -> dict[str, Any]:
    """Histograms of both: by trait its range, shares of groom and tile in each bin, and Kolmogorov's distance."""
    rng = np.random.default_rng([seed, 6])
    groom, tile = of_groom(source, rng), of_tile(source, strands, rng)
    found = {}
    for name, one in groom.items():
        other = tile[name]
        low, high = (float(value) for value in np.quantile(np.concatenate([one, other]), (0.005, 0.995)))
        edges = np.linspace(low, max(high, low + 1e-12), BINS + 1)
        shares = [np.histogram(np.clip(sample, edges[0], edges[-1]), edges)[0] / len(sample) for sample in (one, other)]
        found[name] = {
            "low": low,
            "high": float(edges[-1]),
            "groom": [round(float(share), 5) for share in shares[0]],
            "tile": [round(float(share), 5) for share in shares[1]],
            "apart": round(distance(one, other), 4),
        }
    return found


def likest(source: Source, drawn: list[tuple[Strands, Ints]], seed: int) -> tuple[Strands, Ints]:
    """The tile that is, of some, most like the groom where it stands on the body."""
    rng = np.random.default_rng([seed, 7])
    groom = of_groom(source, rng)

    def off(strands: Strands) -> float:
        tile = of_tile(source, strands, rng)
        return max(distance(groom[name], tile[name]) for name in JUDGED)

    return min(drawn, key=lambda one: off(one[0]))


def of_groom(source: Source, rng: np.random.Generator) -> dict[str, Floats]:
    """Traits of some strands of the groom."""
    bound = source.bound
    which = rng.choice(bound.count, min(SAMPLE, bound.count), replace=False)
    points = bound.curves.evened(which, POINTS)[0]
    chord = np.linalg.norm(points[:, -1] - points[:, 0], axis=1)
    roots, tips = (bound.curves.points[at].astype(np.float64) for at in (bound.curves.starts, bound.curves.ends))
    near = nearest_others(cKDTree(roots), roots[which], AROUND)
    apart = [np.linalg.norm(places[near] - places[which][:, None], axis=2).sum(axis=1) for places in (roots, tips)]
    return {
        "length": bound.length[which],
        "lean": bound.firm[which],
        "curl": _along(points) / np.maximum(chord, 1e-30) - 1,
        "width": bound.width[which],
        "clump": apart[1] / np.maximum(apart[0], 1e-30),
    }


def of_tile(source: Source, strands: Strands, rng: np.random.Generator) -> dict[str, Floats]:
    """Traits of the tile's strands as they stand on the body, at places where the groom has strands."""
    tile, height = source.tile, source.laid.longest / source.tile
    places = rng.choice(source.bound.count, PLACES * len(strands.points))
    hair = np.tile(np.arange(len(strands.points)), PLACES)
    points = _standing(source, strands, hair, places, height)
    chord = points[:, -1] - points[:, 0]
    straight = np.maximum(np.linalg.norm(chord, axis=1), 1e-30)
    root = strands.points[:, 0, :2] % 1.0 % 1.0
    near = nearest_others(cKDTree(root, boxsize=TILE), root, AROUND)
    way = root[near] - root[:, None]
    roots = np.pad(tile * (way - np.round(way)), ((0, 0), (0, 0), (0, 1)))
    one = rng.integers(source.bound.count)  # a place of which all of the tile is looked at
    whole = _standing(source, strands, np.arange(len(root)), np.full(len(root), one), height)
    tips = roots + whole[near, -1] - whole[near, 0] - (whole[:, -1] - whole[:, 0])[:, None]
    spread = [np.linalg.norm(apart, axis=2).sum(axis=1) for apart in (roots, tips)]
    steps = np.linalg.norm(np.diff(points, axis=1), axis=2)
    radius = strands.radius[hair]
    return {
        "length": steps.sum(axis=1),
        "lean": np.linalg.norm(chord[:, :2], axis=1) / straight,
        "curl": steps.sum(axis=1) / straight - 1,
        "width": tile * (steps * (radius[:, 1:] + radius[:, :-1])).sum(axis=1) / np.maximum(steps.sum(axis=1), 1e-30),
        "clump": spread[1] / np.maximum(spread[0], 1e-30),
    }


def _standing(source: Source, strands: Strands, hair: Ints, places: Ints, height: float) -> Floats:
    """(n, P, 3) points of the tile's hairs where strands of the groom stand: across the fur, along it, and up."""
    reach, comb = (source.stands.at(values)[places][:, None] for values in (source.laid.reach, source.laid.comb))
    s = strands.points[hair, :, 2] / height
    aside = source.tile * (strands.points[hair, :, :2] - strands.points[hair, :1, :2])
    along = aside[..., 1] + reach * comb * s * s
    return np.stack([aside[..., 0], along, reach * np.sqrt(1 - comb * comb) * s], axis=-1)


def _along(points: Floats) -> Floats:
    return np.asarray(np.linalg.norm(np.diff(points, axis=1), axis=2).sum(axis=1))
