"""The tiger cub's body: soft unions of ellipsoids and round cones, and the triangles of their surface."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Distance = Callable[[Floats], Floats]
Point = tuple[float, float, float]

STEP = 0.02
"""Width of a cell of the grid, metres of a cub that is 1.8 high."""


def ellipsoid(centre: Point, radii: Point, turn: tuple[float, float] = (0.0, 0.0)) -> Distance:
    """Near its surface, the distance to an ellipsoid; turn : about x, then about z, degrees."""
    a, b = np.radians(turn)
    about_x = np.array([[1, 0, 0], [0, np.cos(a), -np.sin(a)], [0, np.sin(a), np.cos(a)]])
    about_z = np.array([[np.cos(b), -np.sin(b), 0], [np.sin(b), np.cos(b), 0], [0, 0, 1]])
    axes = about_z @ about_x

    def distance(points: Floats) -> Floats:
        local = (points - centre) @ axes / radii
        near = np.linalg.norm(local, axis=-1)
        return np.asarray(near * (near - 1.0) / np.maximum(np.linalg.norm(local / radii, axis=-1), 1e-9))

    return distance


def limb(points: Sequence[Point], radii: Sequence[float]) -> Distance:
    """Distance to a chain of round cones."""

    def distance(where: Floats) -> Floats:
        found = np.full(where.shape[:-1], np.inf)
        for one, two, first, last in zip(points, points[1:], radii, radii[1:], strict=False):
            way = np.subtract(two, one)
            along = np.clip((where - one) @ way / (way @ way), 0.0, 1.0)
            apart = np.linalg.norm(where - one - along[..., None] * way, axis=-1)
            found = np.minimum(found, apart - (first + along * (last - first)))
        return found

    return distance


def joined(parts: Sequence[tuple[Distance, float]]) -> Distance:
    """Union of parts; each flows into those before it over a width of its own (polynomial smooth minimum)."""

    def distance(points: Floats) -> Floats:
        found = parts[0][0](points)
        for part, width in parts[1:]:
            other = part(points)
            over = np.maximum(width - np.abs(found - other), 0.0) / width
            found = np.minimum(found, other) - over**2 * (width / 4.0)
        return found

    return distance


def both(one: Callable[[float], Distance]) -> list[Distance]:
    """A part on the right side of the cub (x < 0), and on the left."""
    return [one(-1.0), one(1.0)]


def ear(side: float) -> Distance:
    """A round ear, hollow in front."""
    shell = ellipsoid((0.31 * side, 1.66, 0.04), (0.155, 0.17, 0.075), (-12.0, -22.0 * side))
    hollow = ellipsoid((0.325 * side, 1.665, 0.15), (0.10, 0.115, 0.085), (-12.0, -22.0 * side))
    return lambda points: np.maximum(shell(points), -hollow(points))


TAIL: list[Point] = [
    (0.0, 0.16, -0.48), (0.26, 0.11, -0.66), (0.58, 0.11, -0.56), (0.78, 0.11, -0.22), (0.79, 0.12, 0.14), (0.68, 0.13, 0.44),
]  # fmt: skip


def cub() -> Distance:
    """The whole cub, sitting: y up, it looks along z, its paws on y = 0."""
    parts: list[tuple[Distance, float]] = [
        (ellipsoid((0, 0.40, -0.20), (0.40, 0.40, 0.40)), 0.1),
        (ellipsoid((0, 0.74, 0.0), (0.32, 0.44, 0.28), (14.0, 0.0)), 0.25),
        (limb([(0, 0.95, 0.04), (0, 1.18, 0.10)], [0.25, 0.27]), 0.15),
        (ellipsoid((0, 1.36, 0.12), (0.41, 0.35, 0.35)), 0.12),
    ]
    for make, width in (
        (lambda s: ellipsoid((0.24 * s, 1.22, 0.20), (0.19, 0.16, 0.17)), 0.10),
        (lambda s: ellipsoid((0.085 * s, 1.205, 0.48), (0.12, 0.095, 0.13)), 0.06),
        (ear, 0.05),
        (lambda s: limb([(0.17 * s, 0.74, 0.12), (0.175 * s, 0.42, 0.22), (0.175 * s, 0.13, 0.27)], [0.17, 0.135, 0.12]), 0.10),
        (lambda s: ellipsoid((0.18 * s, 0.085, 0.36), (0.145, 0.085, 0.19)), 0.06),
        (lambda s: ellipsoid((0.37 * s, 0.34, -0.06), (0.19, 0.31, 0.35)), 0.12),
        (lambda s: ellipsoid((0.43 * s, 0.085, 0.25), (0.125, 0.085, 0.22)), 0.07),
    ):
        parts += [(side, width) for side in both(make)]
    parts.append((ellipsoid((0, 1.115, 0.45), (0.10, 0.07, 0.11)), 0.06))
    parts.append((limb([(0, 1.44, 0.36), (0, 1.29, 0.53)], [0.11, 0.095]), 0.08))
    parts.append((limb(TAIL, [0.12, 0.105, 0.10, 0.10, 0.10, 0.105]), 0.08))
    body = joined(parts)
    # Feet stand on flat ground.
    return lambda points: np.maximum(body(points), -points[..., 1])


def surface(distance: Distance, low: Point, high: Point) -> tuple[Floats, Ints]:
    """(V, 3) vertices and (F, 3) faces, wound outward, of what has the distance 0 (Gibson: surface nets)."""
    axes = [np.arange(a, b + STEP, STEP) for a, b in zip(low, high, strict=True)]
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    values = np.stack([distance(plane) for plane in grid])
    inside = values < 0.0
    shape = np.array(values.shape) - 1
    total, number = np.zeros((*shape, 3)), np.zeros(shape)
    corners = np.array([(i, j, k) for i in (0, 1) for j in (0, 1) for k in (0, 1)])
    for one in corners:
        for axis in np.flatnonzero(one == 0):
            two = one.copy()
            two[axis] = 1
            a, b = (values[tuple(slice(c, c + n) for c, n in zip(end, shape, strict=True))] for end in (one, two))
            crossed = (a < 0.0) != (b < 0.0)
            share = np.where(crossed, a / np.where(crossed, a - b, 1.0), 0.0)
            point = one + share[..., None] * (two - one)
            total += np.where(crossed[..., None], point, 0.0)
            number += crossed
    index = np.full(shape, -1, dtype=np.int64)
    cells = np.argwhere(number > 0)
    index[tuple(cells.T)] = np.arange(len(cells))
    vertices = np.array(low) + STEP * (cells + total[tuple(cells.T)] / number[tuple(cells.T)][:, None])
    faces = []
    for axis in range(3):
        across, up = (axis + 1) % 3, (axis + 2) % 3
        step = np.eye(3, dtype=np.int64)
        ends = [slice(None)] * 3, [slice(None)] * 3
        ends[0][axis], ends[1][axis] = slice(0, -1), slice(1, None)
        first, second = inside[tuple(ends[0])], inside[tuple(ends[1])]
        edge = np.argwhere(first != second)
        edge = edge[(edge[:, across] > 0) & (edge[:, up] > 0)]
        edge = edge[(edge[:, across] < shape[across]) & (edge[:, up] < shape[up])]
        ring = [edge - step[across] - step[up], edge - step[up], edge, edge - step[across]]
        quad = np.stack([index[tuple(corner.T)] for corner in ring], axis=1)
        out = first[tuple(edge.T)]
        quad = np.where(out[:, None], quad, quad[:, ::-1])
        faces += [quad[:, [0, 1, 2]], quad[:, [0, 2, 3]]]
    return vertices, np.concatenate(faces)
