"""Hollow polygons cut anew: trimesh cuts every polygon into a fan, which lies over itself where the polygon is hollow.

Such a fan is a run of triangles (a, b, c), (a, c, d), (a, d, e) ... some of which face the other way than their sum.
"""

from __future__ import annotations

import numpy as np

from furbake.surface.repair.topology import face_vectors
from furbake.surface.soup import Floats, Ints

TURNED = 1e-6
"""Share of a polygon's area by which a triangle must face the other way."""

LONGEST = 512
"""Triangles of a fan that is cut anew; the time grows with the square."""

STEPS, PER_TRIANGLE = 100_000, 4
"""Corners that are looked at in one mesh at the most, beside some for each triangle of such fans.

The fans that are left then stay as they are.
"""


def recut(vertices: Floats, faces: Ints) -> Ints:
    """(F, 3) faces in which fans that lie over themselves are cut along their ears instead.

    The triangles of a fan keep their places, so that what counts faces still fits.
    """
    follows = (faces[1:, 0] == faces[:-1, 0]) & (faces[1:, 1] == faces[:-1, 2])
    starts = np.flatnonzero(np.append(True, ~follows))
    length = np.diff(np.append(starts, len(faces)))
    run = np.repeat(np.arange(len(starts)), length)
    vectors = face_vectors(vertices, faces)
    total = np.stack([np.bincount(run, vectors[:, i]) for i in range(3)], axis=1)[run]
    against = np.einsum("ij,ij->i", vectors, total) < -TURNED * np.einsum("ij,ij->i", total, total)
    hollow = np.flatnonzero((np.bincount(run, against) > 0) & (length > 1) & (length <= LONGEST))
    result, steps = faces, [STEPS + PER_TRIANGLE * int(length[hollow].sum())]
    for i in hollow:
        rows = np.arange(starts[i], starts[i] + length[i])
        ring = [int(faces[rows[0], 0]), int(faces[rows[0], 1]), *faces[rows, 2].tolist()]
        triangles = ears(vertices[ring], total[rows[0]], steps)
        if triangles is not None:
            result = result.copy() if result is faces else result
            result[rows] = np.array(ring)[triangles]
    return result


def ears(ring: Floats, normal: Floats, steps: list[int]) -> Ints | None:
    """(n − 2, 3) triangles of a flat polygon by clipping ears (Meisters 1975); None where it crosses itself.

    ring : (n, 3) corners, counter-clockwise seen from the tip of `normal`
    steps : [how many corners may be looked at], less those that were; None comes when there are none left
    """
    drop = int(np.argmax(np.abs(normal)))
    plane = np.delete(ring, drop, axis=1) * ((1.0, 1.0) if (normal[drop] > 0) == (drop != 1) else (-1.0, 1.0))
    left, found = list(range(len(ring))), []
    while len(left) > 3:
        k = _ear(plane[left], steps)
        if k is None:
            return None
        found.append((left[k - 1], left[k], left[(k + 1) % len(left)]))
        left.pop(k)
    found.append((left[0], left[1], left[2]))
    return np.array(found)


def _ear(ring: Floats, steps: list[int]) -> int | None:
    """A corner of (n, 2) that can be cut off, or one that is none; each that is looked at is a step."""
    flat = None
    for k in range(len(ring)):
        if not steps[0]:
            return None
        steps[0] -= 1
        corner = ring[k - 1], ring[k], ring[(k + 1) % len(ring)]
        turn = _turn(*corner)
        if turn > 0.0 and not _inside(*corner, np.delete(ring, [k - 1, k, (k + 1) % len(ring)], axis=0)):
            return k
        if turn == 0.0:
            flat = k
    return flat


def _turn(a: Floats, b: Floats, c: Floats) -> float:
    return float((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))


def _inside(a: Floats, b: Floats, c: Floats, points: Floats) -> bool:
    """True if any of (n, 2) points lies in the triangle or on its edges."""

    def side(p: Floats, q: Floats) -> Floats:
        return np.asarray((q[0] - p[0]) * (points[:, 1] - p[1]) - (q[1] - p[1]) * (points[:, 0] - p[0]))

    return bool(((side(a, b) >= 0.0) & (side(b, c) >= 0.0) & (side(c, a) >= 0.0)).any())
