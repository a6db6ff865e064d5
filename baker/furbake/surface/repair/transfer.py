"""Carry the numbers at the corners of one mesh over to another mesh of the same shape."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.spatial import cKDTree

from furbake.surface.repair.seams import islands
from furbake.surface.repair.topology import face_vectors
from furbake.surface.soup import Floats, Ints, Soup

NEAREST = 8
"""Points of the old surface around each new one, on whose faces it may lie."""

SPREAD = 0.6
"""How far towards each corner the points of a face lie, beside its middle."""

BEYOND = 0.5
"""How far outside of an old face its texture coordinates are still continued, in that face's own size."""

FARTHEST = 8.0
"""The same where no other face will do."""


def carry(old: Soup, vertices: Floats, faces: Ints) -> Soup:
    """A soup of these triangles with the numbers of the old one.

    Each corner is read off the nearest old face that hangs together with the one under the middle of the new face.
    Texture coordinates must also agree with that one's, continued: the two sides of a seam may hang together elsewhere.
    """
    bare = replace(old, vertices=vertices, faces=faces, part=np.zeros(len(faces), dtype=np.int64))
    bare = replace(bare, uv=None, paint=None, attributes={})
    parts = np.unique(old.part)
    if not len(faces) or (len(parts) == 1 and old.uv is None and old.paint is None and not old.attributes):
        return replace(bare, part=np.full(len(faces), parts[0]))
    old_corners = old.vertices[old.faces]
    tree = _tree(old_corners)
    corners = vertices[faces]
    middle = corners.mean(axis=1)
    home = _nearest(old_corners, _near(tree, middle), middle)
    homes, places = np.repeat(home, 3), corners.reshape(-1, 3)
    inset = (0.9 * corners + 0.1 * middle[:, None]).reshape(-1, 3)
    near = _near(tree, inset)
    island = islands(old)
    near = np.where(island[near] == island[homes][:, None], near, homes[:, None])
    on = _nearest(old_corners, near, inset)
    share = np.clip(barycentric(old_corners[on], places), 0.0, 1.0)
    share /= share.sum(axis=1, keepdims=True)

    def read(values: Floats) -> Floats:
        return np.asarray(np.einsum("nk,nkd->nd", share, values[on]).reshape(len(faces), 3, -1))

    return replace(
        bare,
        part=old.part[home],
        uv=None if old.uv is None else _coordinates(old, old.uv, near, homes, places).reshape(-1, 3, 2),
        paint=None if old.paint is None else read(old.paint),
        attributes={name: read(values) for name, values in old.attributes.items()},
    )


def _coordinates(old: Soup, uv: Floats, near: Ints, homes: Ints, places: Floats) -> Floats:
    """(n, 2) texture coordinates at each place: of the nearest face that agrees with `homes`, else those continued."""
    corners = old.vertices[old.faces]
    expected = np.einsum("nk,nkd->nd", _continued(corners[homes], places, FARTHEST), uv[homes])
    area = np.linalg.norm(face_vectors(old.vertices, old.faces), axis=1)
    one, two = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
    density = np.sqrt(np.abs(one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]) / np.maximum(area, 1e-300))
    reach = density[homes] * np.linalg.norm(places - corners[homes].mean(axis=1), axis=1)
    found, nearest = expected, np.full(len(places), np.inf)
    for faces in near.T:
        there = np.einsum("nk,nkd->nd", _continued(corners[faces], places, BEYOND), uv[faces])
        distance = apart(corners[faces], places)
        agrees = (np.linalg.norm(there - expected, axis=1) <= reach) & (distance < nearest)
        found = np.where(agrees[:, None], there, found)
        nearest = np.where(agrees, distance, nearest)
    return np.asarray(found)


def _continued(triangles: Floats, places: Floats, beyond: float) -> Floats:
    share = np.clip(barycentric(triangles, places), -beyond, 1.0 + beyond)
    total = share.sum(axis=1, keepdims=True)
    return np.where(np.abs(total) > 0.1, share / np.where(np.abs(total) > 0.1, total, 1.0), 1.0 / 3.0)


def _tree(corners: Floats) -> cKDTree:
    """Four points of every face: its middle and, on the way to each corner, another."""
    middle = corners.mean(axis=1, keepdims=True)
    points = np.concatenate([middle, SPREAD * corners + (1.0 - SPREAD) * middle], axis=1)
    return cKDTree(points.reshape(-1, 3))


def _near(tree: cKDTree, places: Floats) -> Ints:
    """(n, k) faces around each place."""
    found = tree.query(places, k=min(NEAREST, tree.n))[1]
    return np.asarray(found, dtype=np.int64).reshape(len(places), -1) // 4


def _nearest(corners: Floats, near: Ints, places: Floats) -> Ints:
    """(n,) the nearest face to each place among (n, k) candidates."""
    distance = np.stack([apart(corners[faces], places) for faces in near.T], axis=1)
    return np.take_along_axis(near, np.argmin(distance, axis=1)[:, None], axis=1)[:, 0]


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
