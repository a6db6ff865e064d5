"""Triangles drawn into a grid: which texels have their middle in which of them."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from furbake.surface.soup import Flags, Floats, Ints

AT_ONCE = 2_000_000
"""Texels of bounding boxes that are looked at together."""


def drawn(corners: Floats, shape: tuple[int, int]) -> Iterator[tuple[Ints, Ints, Ints, Floats]]:
    """Faces with texels in them, some at a time: (n,) faces, rows and columns, and (n, 3) shares of the corners.

    corners : (F, 3, 2) in texels, x before y; shape : rows and columns of the grid. Faces of either hand are drawn.
    """
    low = np.clip(np.ceil(corners.min(axis=1) - 0.5), 0, None).astype(np.int64)
    high = np.minimum(np.floor(corners.max(axis=1) - 0.5), (shape[1] - 1, shape[0] - 1)).astype(np.int64)
    size = np.maximum(high - low + 1, 0)
    count = size[:, 0] * size[:, 1]
    some = np.flatnonzero(count)
    ends = np.cumsum(count[some])
    for start, stop in _runs(ends):
        faces = some[start:stop]
        face = np.repeat(faces, count[faces])
        inside = np.arange(len(face)) - np.repeat(np.cumsum(count[faces]) - count[faces], count[faces])
        column, row = low[face, 0] + inside % size[face, 0], low[face, 1] + inside // size[face, 0]
        shares = shares_at(corners[face], np.column_stack([column + 0.5, row + 0.5]))
        hit = (shares >= 0.0).all(axis=1)
        yield face[hit], row[hit], column[hit], shares[hit]


def covered(corners: Floats, shape: tuple[int, int]) -> Flags:
    """Texels of a grid that triangles touch, or nearly touch: those in them and those around corners and sides."""
    cells = np.zeros(shape, dtype=bool)
    for _, row, column, _ in drawn(corners, shape):
        cells[row, column] = True
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(initial=0.0)
    steps = int(np.ceil(2.0 * longest)) + 1
    for along in np.linspace(0.0, 1.0, steps, endpoint=False):
        points = corners + along * (np.roll(corners, 1, axis=1) - corners)
        column, row = np.floor(points).astype(np.int64).reshape(-1, 2).T
        cells[np.clip(row, 0, shape[0] - 1), np.clip(column, 0, shape[1] - 1)] = True
    return cells


def shares_at(corners: Floats, points: Floats) -> Floats:
    """(n, 3) barycentric coordinates of (n, 2) points in (n, 3, 2) triangles; −1 in those without an area."""
    one, two, way = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0], points - corners[:, 0]
    area = one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]
    flat = np.abs(area) < 1e-12
    area = np.where(flat, 1.0, area)
    second = (way[:, 0] * two[:, 1] - way[:, 1] * two[:, 0]) / area
    third = (one[:, 0] * way[:, 1] - one[:, 1] * way[:, 0]) / area
    return np.where(flat[:, None], -1.0, np.stack([1.0 - second - third, second, third], axis=1))


def _runs(ends: Ints) -> Iterator[tuple[int, int]]:
    """Spans of faces whose texels together are few; ends : running sums of their numbers."""
    start = 0
    while start < len(ends):
        before = ends[start - 1] if start else 0
        stop = max(int(np.searchsorted(ends, before + AT_ONCE, side="right")), start + 1)
        yield start, stop
        start = stop
