"""Fewer faces, the same shape and everything painted on it: for models that are too large, and under their fur.

Edges are collapsed by the quadric error of Garland and Heckbert 1997, as fast-simplification does it.
"""

from __future__ import annotations

from dataclasses import replace

import fast_simplification
import numpy as np
from scipy.spatial import cKDTree

from furbake.surface.seams import islands
from furbake.surface.soup import Floats, Ints, Soup

NEAREST = 8
"""Points of the old surface around each new one, on whose faces it may lie."""

SPREAD = 0.6
"""How far towards each corner the points of a face lie, beside its middle."""

BEYOND = 0.5
"""How far outside of an old face its texture coordinates are still continued, in that face's own size."""

TRIES = (7.0, 10.0, 14.0)
"""Growing eagerness of the collapse, for meshes of many small pieces."""

VERTEX_BYTES = 32
"""Of a shell or fin vertex."""

COPIES = 1.9
"""Faces of the shells per face below them: lapped patches overlap."""

EDGES = 1.5
"""Per face of a closed surface; each carries a fin of four vertices and six indices."""


def decimate(soup: Soup, faces: int) -> Soup:
    """The soup with about `faces` faces, or more where it is too ragged; its numbers are carried over.

    Every number of a new corner is read off the old surface at its place, on the side of a texture seam that the
    middle of its face lies on.
    """
    low, extent = soup.vertices.min(axis=0), float(np.ptp(soup.vertices, axis=0).max())
    shape, now = (soup.vertices - low) / extent, soup.faces
    for eagerness in TRIES:
        if len(now) <= faces:
            break
        points, corners = fast_simplification.simplify(
            shape, now.astype(np.int32), target_count=int(faces), agg=eagerness
        )[:2]
        shape, now = np.asarray(points, dtype=np.float64), np.asarray(corners, dtype=np.int64).reshape(-1, 3)
    return _carried(soup, shape * extent + low, now)


def shell_faces(room: float, index_bytes: int = 4) -> int:
    """How many faces the copy of a surface may have so that its shells and fins fit in `room` bytes."""
    shells = COPIES * (0.65 * VERTEX_BYTES + 3 * index_bytes)
    fins = EDGES * (4 * VERTEX_BYTES + 6 * index_bytes)
    return int(room / (shells + fins))


def barycentric(triangles: Floats, points: Floats) -> Floats:
    """(n, 3) shares of the corners of (n, 3, 3) triangles in each point's foot in their plane; a third if flat."""
    one, two, way = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0], points - triangles[:, 0]
    a, b, c = (np.einsum("ij,ij->i", p, q) for p, q in ((one, one), (one, two), (two, two)))
    d, e = np.einsum("ij,ij->i", way, one), np.einsum("ij,ij->i", way, two)
    area = a * c - b * b
    flat = area <= 1e-14 * np.maximum(a, c) ** 2
    area = np.where(flat, 1.0, area)
    second, third = (c * d - b * e) / area, (a * e - b * d) / area
    shares = np.stack([1.0 - second - third, second, third], axis=1)
    return np.where(flat[:, None], 1.0 / 3.0, shares)


def apart(triangles: Floats, points: Floats) -> Floats:
    """(n,) distance of each point to its triangle."""
    shares = barycentric(triangles, points)
    inside = (shares >= 0.0).all(axis=1)
    best = np.where(inside, np.linalg.norm(np.einsum("nk,nkd->nd", shares, triangles) - points, axis=1), np.inf)
    for i in range(3):
        start, side = triangles[:, i], triangles[:, (i + 1) % 3] - triangles[:, i]
        along = np.einsum("ij,ij->i", points - start, side) / np.maximum(np.einsum("ij,ij->i", side, side), 1e-300)
        foot = start + np.clip(along, 0.0, 1.0)[:, None] * side
        best = np.minimum(best, np.linalg.norm(foot - points, axis=1))
    return np.asarray(best)


def _carried(old: Soup, vertices: Floats, faces: Ints) -> Soup:
    """A soup of these triangles with the numbers of the old one."""
    bare = replace(old, vertices=vertices, faces=faces, part=np.zeros(len(faces), dtype=np.int64))
    bare = replace(bare, uv=None, paint=None, attributes={})
    parts = np.unique(old.part)
    if not len(faces) or (len(parts) == 1 and old.uv is None and old.paint is None and not old.attributes):
        return replace(bare, part=np.full(len(faces), parts[0]))
    finder = _Finder(old)
    corners = vertices[faces]
    middle = corners.mean(axis=1)
    home = finder.face(middle)
    chart = islands(old)
    inset = (0.9 * corners + 0.1 * middle[:, None]).reshape(-1, 3)
    on = finder.face(inset, chart, np.repeat(chart[home], 3), np.repeat(home, 3))
    bary = np.clip(barycentric(old.vertices[old.faces[on]], corners.reshape(-1, 3)), -BEYOND, 1.0 + BEYOND)
    bary /= bary.sum(axis=1, keepdims=True)
    inner = np.clip(bary, 0.0, 1.0)
    inner /= inner.sum(axis=1, keepdims=True)

    def read(values: Floats, share: Floats) -> Floats:
        return np.asarray(np.einsum("nk,nkd->nd", share, values[on]).reshape(len(faces), 3, -1))

    return replace(
        bare,
        part=old.part[home],
        uv=None if old.uv is None else read(old.uv, bary),
        paint=None if old.paint is None else read(old.paint, inner),
        attributes={name: read(values, inner) for name, values in old.attributes.items()},
    )


class _Finder:
    """Which face of a surface a point lies on."""

    def __init__(self, soup: Soup) -> None:
        corners = soup.vertices[soup.faces]
        middle = corners.mean(axis=1, keepdims=True)
        points = np.concatenate([middle, SPREAD * corners + (1.0 - SPREAD) * middle], axis=1)
        self.corners = corners
        self.tree = cKDTree(points.reshape(-1, 3))

    def face(
        self, places: Floats, chart: Ints | None = None, wanted: Ints | None = None, fallback: Ints | None = None
    ) -> Ints:
        """(n,) nearest face to each place; where a chart is wanted, in that chart, or `fallback` if none is near."""
        near = self.tree.query(places, k=min(NEAREST, self.tree.n))[1].reshape(len(places), -1) // 4
        best, nearest = near[:, 0].copy(), np.full(len(places), np.inf)
        if chart is not None and wanted is not None and fallback is not None:
            best = fallback.copy()
        for candidates in near.T:
            distance = apart(self.corners[candidates], places)
            if chart is not None and wanted is not None:
                distance = np.where(chart[candidates] == wanted, distance, np.inf)
            closer = distance < nearest
            best[closer], nearest[closer] = candidates[closer], distance[closer]
        return best
