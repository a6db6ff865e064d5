"""From the pose in which fur was laid back to the bind pose, in which it is stored."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from furbake.asset.rig.motion import Stance
from furbake.surface.charts import Charts
from furbake.surface.mesh import Surface
from furbake.surface.place.fins import Fins
from furbake.surface.place.vertex_fur import VertexFur, tangential
from furbake.surface.repair.topology import unit
from furbake.surface.rig.follow import Follow
from furbake.surface.rig.rig import Floats, Ints

FLAT = 1e-9
"""Determinant of a blend, as a share of its size cubed, below which nothing leads back from it."""


def blends(stance: Stance, follow: Follow) -> Floats:
    """(V, 4, 4) sum of the joints' matrices by the stored weights; 1 where there are no joints."""
    if not len(stance.matrices):
        return np.broadcast_to(np.eye(4), (len(follow.weights), 4, 4))
    shares = follow.weights.astype(np.float64) / 255.0
    return np.asarray(np.einsum("vk,vkij->vij", shares, stance.matrices[follow.joints.astype(np.int64)]))


class Return:
    """The way of a posed surface's vertices back to the bind pose.

    Linear blends do not compose: each vertex goes through the inverse of its own.
    """

    def __init__(self, stance: Stance, follow: Follow) -> None:
        blend = blends(stance, follow)
        size = np.linalg.norm(blend[:, :3, :3], axis=(1, 2))
        lost = ~(np.abs(np.linalg.det(blend[:, :3, :3])) > FLAT * size**3)
        self._inverse = np.linalg.inv(np.where(lost[:, None, None], np.eye(4), blend))
        self._moved = np.einsum("t,tvi->vi", stance.weights, follow.deltas)

    def _turned(self, vectors: Floats, source: slice | Ints = slice(None)) -> Floats:
        return np.asarray(np.einsum("vij,vj->vi", self._inverse[source, :3, :3], vectors))

    def surface(self, posed: Surface) -> Surface:
        """The surface in the bind pose, morph targets at 0."""
        vertices = self._turned(posed.vertices) + self._inverse[:, :3, 3] - self._moved
        return replace(posed, vertices=vertices, normals=unit(self._turned(posed.normals)))

    def charts(self, posed: Charts, bind: Surface) -> Charts:
        """Charts of `bind`: tangents stay perpendicular to its normals."""
        back = tangential(self._turned(posed.tangents[:, :3], posed.source), bind.normals[posed.source])
        return replace(posed, tangents=np.column_stack([unit(back), posed.tangents[:, 3]]))

    def fins(self, posed: Fins) -> Fins:
        """Fins in the bind pose; the angles of their faces stay those of the pose in which the fur was laid."""
        return replace(posed, tangents=unit(self._turned(posed.tangents, posed.source)))

    def fur(self, posed: VertexFur, ground: Surface, bind: Surface) -> VertexFur:
        """Fur on `bind`, combed by as much as on the posed `ground`."""
        comb = tangential(posed.comb, ground.normals)
        back = tangential(self._turned(comb), bind.normals)
        return replace(posed, comb=np.linalg.norm(comb, axis=1, keepdims=True) * _short(back))


def _short(vectors: Floats) -> Floats:
    """Unit vectors; zero stays zero."""
    size = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.asarray(vectors / np.maximum(size, 1e-300))
