"""Rays through triangles where there is no Embree, by a tree of boxes (Kay and Kajiya 1986)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from furbake.surface.mesh import Floats

Indices = NDArray[np.int64]

LEAF = 4
"""Triangles in the smallest boxes."""

TOGETHER, MOST = 4096, 2**20
"""Rays that go down the tree together, and boxes that they meet at a level, beyond which they are parted."""

EDGE = 1e-9
"""How far outside of a triangle a ray still hits it, so that none slips through between two."""


def nearest_hits(triangles: Floats, origins: Floats, directions: Floats) -> Floats:
    """Distances, (n,), along rays to the nearest of (F, 3, 3) triangles of about size 1; infinite where none is hit."""
    order = sorted_in_space(triangles.mean(1))
    levels = boxes(triangles[order])
    nearest = np.full(len(origins), np.inf)
    with np.errstate(divide="ignore", invalid="ignore"):
        parts = np.array_split(np.arange(len(origins)), max(-(-len(origins) // TOGETHER), 1))
        while parts:
            some = parts.pop()
            start, way = origins[some], directions[some]
            ray, leaf = _down(levels, start, 1 / way)
            if len(ray) > MOST and len(some) > 1:
                parts += np.array_split(some, 2)
                continue
            found = np.full(len(start), np.inf)
            for triangle in order.T:
                np.minimum.at(found, ray, crossed(triangles[triangle[leaf]], start[ray], way[ray]))
            nearest[some] = found
    return nearest


def sorted_in_space(points: Floats) -> Indices:
    """Indices of points in leaves of the tree, (2^d, LEAF): each half of a box lies on one side of the other half.

    The leaves are filled up with points that are in others, too.
    """
    depth = max(int(np.ceil(np.log2(len(points) / LEAF))), 0)
    order = np.resize(np.arange(len(points)), (1, LEAF << depth))
    for _ in range(depth):
        places = points[order]
        longest = np.ptp(places, axis=1).argmax(1)
        along = np.take_along_axis(places, longest[:, None, None], 2)[..., 0]
        order = np.take_along_axis(order, along.argsort(1), 1).reshape(2 * len(order), -1)
    return order


def boxes(leaves: Floats) -> list[Floats]:
    """Least and greatest coordinates of the boxes of each level, (2^d, 2, 3) from the whole down; leaves :
    (2^d, LEAF, 3, 3)
    """
    levels = [np.stack([leaves.min((1, 2)) - EDGE, leaves.max((1, 2)) + EDGE], 1)]
    while len(levels[0]) > 1:
        pairs = levels[0].reshape(-1, 2, 2, 3)
        levels.insert(0, np.stack([pairs[:, :, 0].min(1), pairs[:, :, 1].max(1)], 1))
    return levels


def _down(levels: list[Floats], origins: Floats, inverse: Floats) -> tuple[Indices, Indices]:
    """Rays and the leaves that they meet, two arrays of one length, or more than `MOST` boxes of a level before them;
    inverse : 1 over the rays' directions
    """
    ray, box = np.arange(len(origins)), np.zeros(len(origins), np.int64)
    for level, corners in enumerate(levels):
        if level:
            ray, box = np.repeat(ray, 2), np.repeat(2 * box, 2)
            box[1::2] += 1
        t = (corners[box] - origins[ray, None]) * inverse[ray, None]
        enters, leaves = t.min(1).max(1), t.max(1).min(1)
        # A ray along a face of a box has no number here, and meets it.
        met = ~(leaves < np.maximum(enters, 0))
        ray, box = ray[met], box[met]
        if len(ray) > MOST and len(origins) > 1:
            break
    return ray, box


def crossed(triangles: Floats, origins: Floats, directions: Floats) -> Floats:
    """Distances, (n,), at which n rays cross a triangle (n, 3, 3) each (Möller and Trumbore 1997), infinite if not."""
    corner = triangles[:, 0]
    one, two = triangles[:, 1] - corner, triangles[:, 2] - corner
    p = np.cross(directions, two)
    inverse = 1 / (p * one).sum(1)
    offset = origins - corner
    u = (offset * p).sum(1) * inverse
    q = np.cross(offset, one)
    v = (directions * q).sum(1) * inverse
    t = (two * q).sum(1) * inverse
    hit = (u >= -EDGE) & (v >= -EDGE) & (u + v <= 1 + EDGE) & (t > 0)
    return np.where(hit, t, np.inf)
