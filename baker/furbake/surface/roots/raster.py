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
    some, triangles = np.flatnonzero(count), _Triangles(corners)
    ends = np.cumsum(count[some])
    for start, stop in _runs(ends):
        faces = some[start:stop]
        face = np.repeat(faces, count[faces])
        inside = np.arange(len(face)) - np.repeat(np.cumsum(count[faces]) - count[faces], count[faces])
        column, row = low[face, 0] + inside % size[face, 0], low[face, 1] + inside // size[face, 0]
        shares = triangles.shares_at(face, column + 0.5, row + 0.5)
        hit = np.flatnonzero((shares[0] >= 0.0) & (shares[1] >= 0.0) & (shares[2] >= 0.0))
        yield face[hit], row[hit], column[hit], np.stack([share[hit] for share in shares], axis=1)


def covered(corners: Floats, shape: tuple[int, int]) -> Flags:
    """Texels of a grid that triangles touch, or nearly touch: those in them and those around corners and sides."""
    cells = np.zeros(shape, dtype=bool)
    for _, row, column, _ in drawn(corners, shape):
        cells[row, column] = True
    sides = np.roll(corners, 1, axis=1) - corners
    steps = int(np.ceil(2.0 * np.linalg.norm(sides, axis=2).max(initial=0.0))) + 1
    for along in np.linspace(0.0, 1.0, steps, endpoint=False):
        column, row = np.floor(corners + along * sides).astype(np.int64).reshape(-1, 2).T
        cells[np.clip(row, 0, shape[0] - 1), np.clip(column, 0, shape[1] - 1)] = True
    return cells


class _Triangles:
    """Barycentric coordinates in (F, 3, 2) triangles."""

    def __init__(self, corners: Floats) -> None:
        self.first = corners[:, 0].T
        self.one, self.two = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] - corners[:, 0]).T
        area = self.one[0] * self.two[1] - self.one[1] * self.two[0]
        self.flat = np.abs(area) < 1e-12
        self.area = np.where(self.flat, 1.0, area)

    def shares_at(self, face: Ints, x: Floats, y: Floats) -> tuple[Floats, Floats, Floats]:
        """Shares of the corners of (n,) faces at (n,) points; −1 in faces without an area."""
        x, y, area, flat = x - self.first[0][face], y - self.first[1][face], self.area[face], self.flat[face]
        second = (x * self.two[1][face] - y * self.two[0][face]) / area
        third = (self.one[0][face] * y - self.one[1][face] * x) / area
        second[flat] = third[flat] = -1.0
        return 1.0 - second - third, second, third


def _runs(ends: Ints) -> Iterator[tuple[int, int]]:
    """Spans of faces whose texels together are few; ends : running sums of their numbers."""
    start = 0
    while start < len(ends):
        before = ends[start - 1] if start else 0
        stop = max(int(np.searchsorted(ends, before + AT_ONCE, side="right")), start + 1)
        yield start, stop
        start = stop
