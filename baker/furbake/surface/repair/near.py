"""The nearest triangle to a place, and the point on it."""

from __future__ import annotations

from itertools import chain

import numpy as np
from scipy.spatial import cKDTree

from furbake.surface.soup import Floats, Ints

NEAREST = 8
"""Points of the old surface around each new one, on whose faces it may lie."""

SPREAD = 0.6
"""How far towards each corner the points of a face lie, beside its middle."""

MOST = 256
"""Triangles around a place, of one size, that are looked at for being the nearest."""


def sampled(corners: Floats) -> cKDTree:
    """Four points of every face: its middle and, on the way to each corner, another."""
    middle = corners.mean(axis=1, keepdims=True)
    points = np.concatenate([middle, SPREAD * corners + (1.0 - SPREAD) * middle], axis=1)
    return cKDTree(points.reshape(-1, 3))


def candidates(tree: cKDTree, places: Floats) -> Ints:
    """(n, k) faces around each place."""
    found = tree.query(places, k=min(NEAREST, tree.n))[1]
    return np.asarray(found, dtype=np.int64).reshape(len(places), -1) // 4


def nearest(corners: Floats, near: Ints, places: Floats) -> Ints:
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
    return closest(triangles, points)[1]


def closest(triangles: Floats, points: Floats) -> tuple[Floats, Floats]:
    """(n, 3) shares of the corners in the nearest point of each triangle, which sum to 1, and (n,) how far it is."""
    shares = barycentric(triangles, points)
    inside = (shares >= 0.0).all(axis=1)
    best = np.where(inside, np.linalg.norm(np.einsum("nk,nkd->nd", shares, triangles) - points, axis=1), np.inf)
    for i in range(3):
        start, side = triangles[:, i], triangles[:, (i + 1) % 3] - triangles[:, i]
        along = np.einsum("ij,ij->i", points - start, side) / np.maximum(np.einsum("ij,ij->i", side, side), 1e-300)
        along = np.clip(along, 0.0, 1.0)
        distance = np.linalg.norm(start + along[:, None] * side - points, axis=1)
        on_side = np.zeros_like(shares)
        on_side[:, i], on_side[:, (i + 1) % 3] = 1.0 - along, along
        shares = np.where((distance < best)[:, None], on_side, shares)
        best = np.minimum(best, distance)
    return shares, best


def around(corners: Floats, places: Floats, reach: Floats) -> tuple[Ints, Ints]:
    """Pairs of a place and a triangle that may lie within (n,) `reach` of it: (m,) places by rising number, (m,) faces.

    corners : (F, 3, 3). Of a crowd of needles only the `MOST` with the nearest middles are found.
    """
    middle = corners.mean(axis=1)
    size = np.linalg.norm(corners - middle[:, None], axis=2).max(axis=1)
    octave = np.ceil(np.log2(np.maximum(size, size.max(initial=0.0) * 2.0**-20 + 1e-300)))
    rows, faces = [], []
    for one in np.unique(octave):
        alike = np.flatnonzero(octave == one)
        tree, far = cKDTree(middle[alike]), (reach + 2.0**one) * (1.0 + 1e-9)
        number = np.asarray(tree.query_ball_point(places, far, return_length=True), dtype=np.int64)
        few, many = np.flatnonzero((number > 0) & (number <= MOST)), np.flatnonzero(number > MOST)
        found = tree.query_ball_point(places[few], far[few], return_sorted=True)
        listed = np.fromiter(chain.from_iterable(found), dtype=np.int64, count=int(number[few].sum()))
        nearby = np.asarray(tree.query(places[many], k=MOST)[1], dtype=np.int64)
        rows += [np.repeat(few, number[few]), np.repeat(many, MOST)]
        faces += [alike[listed], alike[nearby.reshape(-1)]]
    row = np.concatenate(rows)
    order = np.argsort(row, kind="stable")
    return row[order], np.concatenate(faces)[order]
