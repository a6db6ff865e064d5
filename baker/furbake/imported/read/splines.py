"""Cubic and linear curves of USD as lines of points."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from furbake.imported.curves import Floats, GroomError, Ints

BASES = {
    "bspline": np.array([[1, 4, 1, 0], [-3, 0, 3, 0], [3, -6, 3, 0], [-1, 3, -3, 1]]) / 6.0,
    "catmullRom": np.array([[0, 2, 0, 0], [-1, 0, 1, 0], [2, -5, 4, -1], [-1, 3, -3, 1]]) / 2.0,
    "bezier": np.array([[1, 0, 0, 0], [-3, 3, 0, 0], [3, -6, 3, 0], [-1, 3, -3, 1]], np.float64),
}
"""Rows: shares of four control points in 1, t, t² and t³."""

PIECES = 8
"""Straight pieces of a strand at least, where its basis bends it."""


def least(kind: str, basis: str, wrap: str) -> int:
    """Control points of a curve at least."""
    return 2 if kind == "linear" or (wrap == "pinned" and basis != "bezier") else 4


def weights(count: int, kind: str, basis: str, wrap: str) -> Floats:
    """(P, count) shares of the control points in the points of a line along one curve.

    Raises GroomError where that many control points are no curve of this basis.
    """
    if kind == "linear":
        return np.eye(count)
    if basis not in BASES:
        raise GroomError(f"basis {basis!r}, expected linear, bezier, bspline or catmullRom")
    controls = np.eye(count)
    if basis == "bezier":
        if (count - 1) % 3:
            raise GroomError(f"a bezier curve of {count} points, expected 4, 7, 10 and so on")
        first = np.arange(0, count - 1, 3)
    else:
        if wrap == "pinned":  # as USD has it: beyond each end a point as far as the one before it
            ends = [2 * controls[0] - controls[1], 2 * controls[-1] - controls[-2]]
            controls = np.vstack([ends[0], controls, ends[1]])
        first = np.arange(len(controls) - 3)
    pieces = max(1, -(-PIECES // len(first)))
    t = np.arange(pieces) / pieces
    powers = np.stack([t**i for i in range(4)], 1) @ BASES[basis]
    rows = [powers @ controls[start : start + 4] for start in first]
    return np.vstack([*rows, BASES[basis].sum(axis=0) @ controls[first[-1] : first[-1] + 4]])


def lines(
    points: Floats, counts: Ints, kind: str, basis: str, wrap: str,
    values: dict[str, tuple[NDArray[Any], str]],
) -> tuple[Floats, Ints, dict[str, Floats]]:  # fmt: skip
    """Points of lines along curves, their counts, and values at these points.

    points : (N, 3) control points; counts : (S,), all of them enough for the basis
    values : (n, ...) by name, and how USD interpolates them

    Raises GroomError where values are not as many as they must be.
    """
    starts = np.cumsum(counts) - counts
    shape = {int(count): weights(int(count), kind, basis, wrap) for count in np.unique(counts)}
    many = np.array([len(shape[int(count)]) for count in counts], np.int64)
    at = np.cumsum(many) - many
    spans = np.array([_spans(int(count), kind, basis, wrap) + 1 for count in counts])
    found_points = np.empty((int(many.sum()), 3))
    found = {name: np.empty((int(many.sum()), *array.shape[1:])) for name, (array, _) in values.items()}
    for name, (array, way) in values.items():
        expected = {"vertex": len(points), "varying": int(spans.sum()), "uniform": len(counts), "constant": 1}.get(way)
        if len(array) != expected:
            raise GroomError(f"{len(array)} {name} that are {way}, expected {expected}")
    for count, matrix in shape.items():
        rows = np.flatnonzero(counts == count)
        controls, target = starts[rows, None] + np.arange(count), at[rows, None] + np.arange(len(matrix))
        found_points[target] = np.einsum("pc,scd->spd", matrix, points[controls])
        for name, (array, way) in values.items():
            found[name][target] = _valued(array, way, rows, controls, matrix, spans)
    return found_points, many, found


def _spans(count: int, kind: str, basis: str, wrap: str) -> int:
    """Spans of a curve, between which values that are `varying` lie."""
    if kind == "linear":
        return count - 1
    return (count - 1) // 3 if basis == "bezier" else count - 1 if wrap == "pinned" else count - 3


def _valued(array: NDArray[Any], way: str, rows: Ints, controls: Ints, matrix: Floats, spans: Ints) -> NDArray[Any]:
    """(s, P, ...) values on some curves of as many points each."""
    if way == "constant":
        return np.broadcast_to(array[0], (len(rows), len(matrix), *array.shape[1:]))
    if way == "uniform":
        return np.broadcast_to(array[rows][:, None], (len(rows), len(matrix), *array.shape[1:]))
    if way == "vertex":
        return np.asarray(np.einsum("pc,sc...->sp...", matrix, array[controls]))
    count = int(spans[rows[0]])
    place = np.linspace(0.0, count - 1, len(matrix))
    low = np.minimum(place.astype(np.int64), max(count - 2, 0))
    part = (place - low).reshape(-1, *[1] * (array.ndim - 1))
    first = (np.cumsum(spans) - spans)[rows, None]
    return np.asarray((1 - part) * array[first + low] + part * array[first + np.minimum(low + 1, count - 1)])
