"""The bone that warms each vertex: the nearest one that it sees through the inside of the body."""

from __future__ import annotations

import numpy as np

from furbake.surface.mesh import Surface
from furbake.surface.place.thickness import distances
from furbake.surface.repair.topology import unit
from furbake.surface.rig.rig import Floats, Ints
from furbake.surface.skeleton.skeleton import Skeleton

INSIDE = 1e-3
"""Depth below the skin at which a look begins, share of the largest side."""

ARRIVED = 0.999
"""Share of the way to a bone that a look reaches without meeting the skin."""

ALIKE = 1e-4
"""Bones whose distances differ by less, as a share, are equally near: a vertex beside their joint."""

BLOCK = 4096
"""Vertices that are looked at together."""


def warmed(surface: Surface, skeleton: Skeleton) -> tuple[Floats, Floats]:
    """(V, J) shares of the joints whose bone is nearest, summing to 1, or 0 where no bone is seen; (V,) its distance.

    Several bones that are equally near share a vertex. Baran and Popović, Automatic rigging and animation of 3D
    characters, 2007, section 4, but with the nearest of the bones that are seen.
    """
    owner, ends = skeleton.bones()
    shares, far = np.zeros((len(surface.vertices), len(skeleton.joints))), np.ones(len(surface.vertices))
    for start in range(0, len(shares), BLOCK):
        rows = slice(start, start + BLOCK)
        points = _feet(ends, surface.vertices[rows])
        length = np.linalg.norm(points - surface.vertices[rows, None], axis=2)
        seen = _seen(surface, rows, points)
        least = np.where(seen, length, np.inf).min(axis=1, keepdims=True)
        shares[rows], far[rows] = _shared(owner, length, seen, least, shares.shape[1])
    return shares, far


def nearest(surface: Surface, skeleton: Skeleton) -> tuple[Floats, Floats]:
    """The same of the nearest bones, whether they are seen or not."""
    owner, ends = skeleton.bones()
    length = np.linalg.norm(_feet(ends, surface.vertices) - surface.vertices[:, None], axis=2)
    every = np.ones(length.shape, dtype=bool)
    return _shared(owner, length, every, length.min(axis=1, keepdims=True), len(skeleton.joints))


def _feet(ends: Floats, places: Floats) -> Floats:
    """(V, B, 3) the point of each of (B, 2, 3) bones that is nearest to each place."""
    way = ends[:, 1] - ends[:, 0]
    size = np.maximum(np.einsum("bi,bi->b", way, way), 1e-300)
    along = np.einsum("vbi,bi->vb", places[:, None] - ends[:, 0], way) / size
    return np.asarray(ends[:, 0] + np.clip(along, 0.0, 1.0)[:, :, None] * way)


def _seen(surface: Surface, rows: slice, points: Floats) -> np.ndarray[tuple[int, ...], np.dtype[np.bool_]]:
    """(V, B) whether the straight way from below the skin to a point stays inside."""
    starts = surface.vertices[rows] - INSIDE * surface.extent * surface.normals[rows]
    ways = points - starts[:, None]
    length = np.linalg.norm(ways, axis=2)
    origins = np.broadcast_to(starts[:, None], ways.shape).reshape(-1, 3)
    hit = distances(surface, origins, unit(ways.reshape(-1, 3))).reshape(length.shape)
    return np.asarray(hit >= ARRIVED * length)


def _shared(
    owner: Ints, length: Floats, seen: np.ndarray[tuple[int, ...], np.dtype[np.bool_]], least: Floats, joints: int
) -> tuple[Floats, Floats]:
    near = seen & (length <= (1.0 + ALIKE) * least)
    shares = np.zeros((len(length), joints))
    for joint in np.unique(owner).tolist():
        shares[:, joint] = near[:, owner == joint].any(axis=1)
    return shares / np.maximum(shares.sum(axis=1, keepdims=True), 1.0), np.where(near.any(axis=1), least[:, 0], 1.0)
