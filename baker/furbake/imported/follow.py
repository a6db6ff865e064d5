"""Grooms of guides alone, filled in between: hairs that are mixtures of the guides around them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.spatial import cKDTree

from furbake.imported.bind import Bound
from furbake.imported.curves import Curves, Floats, Ints, Single, nearest_others

AROUND = 6
"""Neighbours of a guide, between two of which and itself its followers grow."""

POINTS = 12
"""Points of a follower."""

BARE, COVERED = 0.5, 2.0
"""Width times length of all strands over the area below which hairs are added between them, and up to which."""

UNLIKE = 0.25
"""Length of a neighbour over a guide's beyond which no hair lies between them."""

MOST = 16
"""Followers of a guide at most, where they are not asked for."""


def cover(bound: Bound, area: float) -> float:
    """Width times length of all strands over the area of the surface that they stand on."""
    return float((bound.width * bound.length).sum()) / area


def followers(bound: Bound, area: float, asked: int | None) -> int:
    """Number of followers of each guide: as asked, or as many as cover the skin; 0 where the groom does by itself.

    The less they cover, the more are added: strands just below `BARE` are sparse hairs, few strands are guides.
    """
    if asked is not None:
        return asked
    covered = max(cover(bound, area), 1e-9)
    wanted = min(COVERED, BARE * BARE / covered)
    return min(MOST, max(round(wanted / covered) - 1, 0))


def filled(bound: Bound, count: int, seed: int) -> Curves:
    """The guides and `count` followers of each, which lie between it and two of its neighbours."""
    curves = bound.curves
    if not count or curves.count < 3:
        return curves
    rng = np.random.default_rng([seed, 3])
    guides, widths, colours = curves.evened(np.arange(curves.count), POINTS)
    near = _neighbours(bound, guides[:, 0])
    made: dict[str, list[Floats | None]] = {"points": [guides], "widths": [widths], "colours": [colours]}
    for _ in range(count):
        pick = np.argsort(rng.random(near.shape), axis=1)[:, :2]
        trio = np.column_stack([np.arange(curves.count), np.take_along_axis(near, pick, axis=1)])
        share = np.sort(rng.random((curves.count, 2)), axis=1)
        share = np.column_stack([share[:, 0], share[:, 1] - share[:, 0], 1 - share[:, 1]])
        for name, values in (("points", guides), ("widths", widths), ("colours", colours)):
            if values is not None:
                made[name].append(np.einsum("sk,sk...->s...", share, values[trio]))

    def flat(name: str, *width: int) -> Single | None:
        parts = [part for part in made[name] if part is not None]
        return np.concatenate(parts).reshape(-1, *width).astype(np.float32) if parts else None

    counts = np.full((1 + count) * curves.count, POINTS)
    points = flat("points", 3)
    assert points is not None  # noqa: S101 — for the types
    return replace(curves, points=points, counts=counts, widths=flat("widths"), colours=flat("colours", 3), notices=())


def _neighbours(bound: Bound, roots: Floats) -> Ints:
    """(S, AROUND) nearest roots of each that stand on the same side of the body; itself in place of others."""
    near = nearest_others(cKDTree(roots), roots, AROUND)
    alike = np.einsum("skd,sd->sk", bound.normal[near], bound.normal) > 0.3
    ratio = bound.length[near] / np.maximum(bound.length[:, None], 1e-30)
    return np.where(alike & (ratio > UNLIKE) & (ratio < 1 / UNLIKE), near, np.arange(len(roots))[:, None])
