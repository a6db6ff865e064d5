"""From the pose in which fur was laid back to the bind pose, in which it is stored."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from furbake.asset.rig.targets import charts_tangents, displaced_normals, fins_tangents
from furbake.surface.charts import Charts
from furbake.surface.mesh import Surface
from furbake.surface.place.fins import Fins
from furbake.surface.place.vertex_fur import VertexFur, tangential
from furbake.surface.repair.topology import unit
from furbake.surface.rig.follow import Follow
from furbake.surface.rig.pose import blend, unposed
from furbake.surface.rig.rig import Floats, Ints, Rig

if TYPE_CHECKING:
    from furbake.asset.gltf import FurModel


def bound(model: FurModel) -> FurModel:
    """The model in the bind pose, in which it is stored."""
    motion = model.motion
    if motion is None or motion.rig.pose is None:
        return model
    skin = Return(motion.rig, motion.skin, model.skin)
    ground = skin if model.ground is None else Return(motion.rig, motion.ground, model.ground)
    return replace(
        model,
        skin=skin.bind,
        ground=None if model.ground is None else ground.bind,
        charts=ground.charts(model.charts),
        fur=ground.fur(model.fur),
        fins=None if model.fins is None else ground.fins(model.fins),
    )


class Return:
    """The way of a posed surface back to the bind pose: each vertex goes through the inverse of its own blend.

    posed, bind : the surface in the two poses
    """

    def __init__(self, rig: Rig, follow: Follow, posed: Surface) -> None:
        vertices, normals = unposed(rig, follow, posed.vertices, posed.normals)
        weights = np.zeros(0) if rig.pose is None else rig.pose.weights
        self._weights, self._deltas = weights[weights != 0.0], follow.deltas[weights != 0.0]
        self._blend = blend(rig, follow.joints, follow.weights)[:, :3, :3]
        bare = replace(posed, vertices=vertices, normals=normals)
        self.posed = posed
        self.bind = replace(bare, normals=self._without(displaced_normals(bare, self._deltas), normals))

    def charts(self, charts: Charts) -> Charts:
        """Charts of the surface in the bind pose; tangents stay perpendicular to its normals."""
        back, sign = self._turned(charts.tangents[:, :3], charts.source), charts.tangents[:, 3:]
        shaped = replace(charts, tangents=np.column_stack([back, sign]))
        back = self._without(charts_tangents(self.bind, shaped, self._deltas), back)
        back = unit(tangential(back, self.bind.normals[charts.source]))
        return replace(charts, tangents=np.column_stack([back, sign]))

    def fins(self, fins: Fins) -> Fins:
        """Fins in the bind pose; the angles of their faces stay those of the pose in which the fur was laid."""
        back = self._turned(fins.tangents, fins.source)
        return replace(fins, tangents=self._without(fins_tangents(self.bind, fins, self._deltas), back))

    def _without(self, shapes: Iterable[Floats], vectors: Floats) -> Floats:
        """(n, 3) unit vectors without what the pose's targets, each (n, 3), have added to them."""
        for weight, shape in zip(self._weights.tolist(), shapes, strict=True):
            vectors = vectors - weight * shape
        return unit(vectors)

    def fur(self, fur: VertexFur) -> VertexFur:
        """Fur combed by as much as on the posed surface."""
        comb = tangential(fur.comb, self.posed.normals)
        back = tangential(self._turned(comb, np.arange(len(comb))), self.bind.normals)
        size, short = (np.linalg.norm(vectors, axis=1, keepdims=True) for vectors in (comb, back))
        return replace(fur, comb=back * size / np.maximum(short, 1e-300))

    def _turned(self, vectors: Floats, source: Ints) -> Floats:
        """(n, 3) unit vectors at the vertices in `source`, in the bind pose; as they are where nothing leads back."""
        blends = self._blend[source]
        # By the adjugate, the inverse up to a factor, which exists of every matrix.
        x, y, z = (blends[:, :, i] for i in range(3))
        rows = np.stack([np.cross(y, z), np.cross(z, x), np.cross(x, y)], axis=1)
        sign = np.sign(np.linalg.det(blends))[:, None]
        back = sign * np.einsum("vij,vj->vi", rows, vectors)
        lost = ~(np.linalg.norm(back, axis=1, keepdims=True) > 1e-12)
        return unit(np.where(lost, vectors, back))
