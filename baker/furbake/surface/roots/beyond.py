"""The skin around a patch, unfolded into the plane of its tiles: roots of combed hairs lie there."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from furbake.surface.charts import Charts
from furbake.surface.roots.layout import CELLS, Layout
from furbake.surface.soup import Flags, Floats, Ints

PLACES = 64
"""Places along an edge at which it is asked whether roots lie there, at most."""


@dataclass(frozen=True)
class _Rim:
    """Edges at the rim of what is known, as the face within runs along them.

    patch : (n,); ends : (n, 2) vertices of the surface; uv : (n, 2, 2) texture coordinates of both, tiles
    """

    patch: Ints
    ends: Ints
    uv: Floats

    def __getitem__(self, mine: Flags | Ints) -> _Rim:
        return _Rim(self.patch[mine], self.ends[mine], self.uv[mine])


@dataclass(frozen=True)
class Around:
    """Faces around patches, nearest first.

    patch : (n,); corners : (n, 3) vertices of the surface; triangles : (n, 3, 2) texture coordinates, tiles
    """

    patch: Ints
    corners: Ints
    triangles: Floats

    def outer(self) -> _Rim:
        """All edges but the first one of each face."""
        two = [[1, 2], [2, 0]]
        ends, uv = self.corners[:, two].reshape(-1, 2), self.triangles[:, two].reshape(-1, 2, 2)
        return _Rim(np.repeat(self.patch, 2), ends, uv)


def unfolded(vertices: Floats, faces: Ints, charts: Charts, layout: Layout) -> Around:
    """Faces of the surface beside each patch, as far as its roots reach: ring by ring, turned about the shared edge.

    vertices, faces : of the surface. Nothing lies beyond an open border.
    """
    half = _HalfEdges(faces)
    rim, rings, known = _ends(charts, layout), [], np.zeros(0, dtype=np.int64)
    while len(rim.patch):
        rim = rim[_wanted(rim, layout)]
        face, corner = half.beyond(rim.ends)
        key = np.where(face < 0, -1, rim.patch * len(faces) + face)
        found, first = np.unique(key, return_index=True)
        fresh = (found >= 0) & ~np.isin(found, known)
        known = np.concatenate([known, found[fresh]])
        ring = _turned(rim[first[fresh]], corner[first[fresh]], vertices)
        rings.append(ring)
        rim = ring.outer()
    return Around(
        np.concatenate([ring.patch for ring in rings]),
        np.concatenate([ring.corners for ring in rings]),
        np.concatenate([ring.triangles for ring in rings]),
    )


def _ends(charts: Charts, layout: Layout) -> _Rim:
    """Edges of patches that one face has."""
    start, end = charts.faces.reshape(-1), np.roll(charts.faces, -1, axis=1).reshape(-1)
    count = len(charts.source)
    single = ~np.isin(start * count + end, end * count + start)
    ends = np.column_stack([start, end])[single]
    return _Rim(layout.patch[ends[:, 0]], charts.source[ends], layout.uv[ends])


def _wanted(rim: _Rim, layout: Layout) -> Flags:
    """(n,) whether a root of the patch may lie on the edge."""
    length = np.linalg.norm(rim.uv[:, 1] - rim.uv[:, 0], axis=1).max(initial=0.0)
    count = int(np.clip(np.ceil(2.0 * CELLS * length), 2, PLACES))
    found = np.zeros(len(rim.patch), dtype=bool)
    for share in np.linspace(0.0, 1.0, count):
        found |= layout.owner_at(rim.uv[:, 0] + share * (rim.uv[:, 1] - rim.uv[:, 0])) == rim.patch
    return found


def _turned(rim: _Rim, corner: Ints, vertices: Floats) -> Around:
    """The faces beyond edges, in the plane of the tiles, in the edge's own scale. corner : their third vertices."""
    corners = np.column_stack([rim.ends[:, ::-1], corner])
    along, up = _third(vertices[corners])
    start, end = rim.uv[:, 1], rim.uv[:, 0]
    edge = end - start
    aside = np.column_stack([-edge[:, 1], edge[:, 0]])
    third = start + along[:, None] * edge + up[:, None] * aside
    return Around(rim.patch, corners, np.stack([start, end, third], axis=1))


def _third(points: Floats) -> tuple[Floats, Floats]:
    """Third corners of (n, 3, 3) triangles along the first edge and aside of it, in lengths of that edge."""
    edge, far = points[:, 1] - points[:, 0], points[:, 2] - points[:, 0]
    square = np.einsum("ij,ij->i", edge, edge)
    double = np.linalg.norm(np.cross(edge, far), axis=1)
    return np.einsum("ij,ij->i", edge, far) / square, double / square


class _HalfEdges:
    """Which face lies beyond an edge."""

    def __init__(self, faces: Ints) -> None:
        self.faces, self.count = faces, int(faces.max()) + 1
        keys = faces.reshape(-1) * self.count + np.roll(faces, -1, axis=1).reshape(-1)
        self.order = np.argsort(keys)
        self.keys = keys[self.order]

    def beyond(self, ends: Ints) -> tuple[Ints, Ints]:
        """(n,) the face that has an edge (n, 2) the other way round, -1 where there is none; and its third corner."""
        key = ends[:, 1] * self.count + ends[:, 0]
        at = np.minimum(np.searchsorted(self.keys, key), len(self.keys) - 1)
        half = self.order[at]
        face, side = half // 3, half % 3
        return np.where(self.keys[at] == key, face, -1), self.faces[face, (side + 2) % 3]
