"""The shells' surface with texture coordinates, vertices repeated where patches overlap or end."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True)
class Charts:
    """A textured copy of a surface.

    source : (M,) int, vertex of the surface that each vertex here is a copy of
    faces : (F', 3) int, into the copies; every one has a positive Jacobian (is not mirrored)
    tangents : (M, 4) float, unit T along growing u, and w = ±1: B = w·N×T along growing v
    uv : (M, 2) float, tiles
    weights : (M,) float 0..1, share of each copy in the fur
    group : (M,) int, the weights of the copies of one group sum to 1. A source vertex has one group, or several
        where different copies serve different faces around it (texture seams, sharp corners)
    """

    source: Ints
    faces: Ints
    tangents: Floats
    uv: Floats
    weights: Floats
    group: Ints


@dataclass(frozen=True)
class Natural:
    """The texture coordinates that a built-in shape has by itself, before a tile width is known.

    source, faces, tangents : as in `Charts`
    uv : (M, 2) float, 0..1 over the whole shape
    lengths : mean lengths of the shape along u and v, model units
    closed : whether u and v meet their own beginning, so that a whole number of tiles must fit
    """

    source: Ints
    faces: Ints
    tangents: Floats
    uv: Floats
    lengths: tuple[float, float]
    closed: tuple[bool, bool]

    def charts(self, tile: float) -> Charts:
        """Charts for tiles about `tile` model units wide."""
        tiles = [
            float(max(1, round(length / tile))) if closed else length / tile
            for length, closed in zip(self.lengths, self.closed, strict=True)
        ]
        count = len(self.source)
        return Charts(
            self.source, self.faces, self.tangents, self.uv * np.array(tiles), np.ones(count), np.arange(count)
        )


def laid(charts: Charts, normals: Floats) -> Floats:
    """(V, 3) unit tangent vectors of growing v, where the fur is laid, at the vertices of the surface.

    normals : (V, 3) unit. Where copies differ the mean of their directions holds, by their weights.
    """
    tangent, sign = charts.tangents[:, :3], charts.tangents[:, 3:]
    grows = charts.weights[:, None] * sign * np.cross(normals[charts.source], tangent)
    total = np.stack([np.bincount(charts.source, axis, len(normals)) for axis in grows.T], axis=1)
    total -= normals * np.einsum("ij,ij->i", total, normals)[:, None]
    # Where directions cancel, any tangent will do.
    any_axis = np.cross(normals, np.where(np.abs(normals[:, :1]) < 0.7, [[1.0, 0.0, 0.0]], [[0.0, 1.0, 0.0]]))
    total = np.where(np.linalg.norm(total, axis=1, keepdims=True) > 1e-6, total, any_axis)
    return np.asarray(total / np.linalg.norm(total, axis=1, keepdims=True))
