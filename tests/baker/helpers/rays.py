"""Rays by brute force, the oracle of those that go down a tree."""

from __future__ import annotations

import numpy as np

EDGE = 1e-9


def march(triangles: np.ndarray, origins: np.ndarray, directions: np.ndarray, block: int = 64) -> np.ndarray:
    """(n,) distance of each ray to the nearest of (F, 3, 3) triangles (Möller and Trumbore 1997), in blocks of rays."""
    corner = triangles[:, 0]
    one, two = triangles[:, 1] - corner, triangles[:, 2] - corner
    nearest = np.full(len(origins), np.inf)
    for start in range(0, len(origins), block):
        rays = slice(start, start + block)
        way = directions[rays, None]
        p = np.cross(way, two)
        with np.errstate(divide="ignore", invalid="ignore"):
            inverse = 1.0 / np.einsum("rfi,fi->rf", p, one)
            offset = origins[rays, None] - corner
            u = np.einsum("rfi,rfi->rf", offset, p) * inverse
            q = np.cross(offset, one)
            v = np.einsum("rfi,rfi->rf", np.broadcast_to(way, q.shape), q) * inverse
            t = np.einsum("rfi,fi->rf", q, two) * inverse
            hit = (u >= -EDGE) & (v >= -EDGE) & (u + v <= 1.0 + EDGE) & (t > 0.0)
        nearest[rays] = np.where(hit, t, np.inf).min(axis=1)
    return nearest
