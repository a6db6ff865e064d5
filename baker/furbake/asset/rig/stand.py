"""A surface as it is stored: on the grid of its positions, with the joints and morph targets that move it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from itertools import repeat
from typing import Any

import numpy as np
from numpy.typing import NDArray

from furbake.asset.mesh.buffer import Buffer
from furbake.asset.mesh.vertices import Attributes, quantise_positions, signed
from furbake.asset.rig.motion import Motion
from furbake.asset.rig.targets import charts_tangents, displaced_normals, fins_tangents, targets
from furbake.surface.charts import Charts
from furbake.surface.mesh import Surface
from furbake.surface.place.fins import Fins
from furbake.surface.rig.follow import Follow
from furbake.surface.rig.rig import Floats, Ints

Record = dict[str, Any]

FEW_JOINTS = 256
"""Joints that a byte numbers; JOINTS_0 takes 16 bits beyond."""


@dataclass(frozen=True)
class Stand:
    """A surface in the bind pose, and what moves it.

    offset, scale : of the grid of its positions
    motion, follow : None where nothing moves it
    """

    surface: Surface
    offset: Floats
    scale: float
    motion: Motion | None = None
    follow: Follow | None = None

    @cached_property
    def positions(self) -> NDArray[np.uint16]:
        """(V, 3) as `quantise_positions` makes them."""
        return quantise_positions(self.surface.vertices, self.offset, self.scale)

    @cached_property
    def _same(self) -> Ints:
        """(V,) the first vertex that is stored with the same place and normal: all of these follow as that one does."""
        rows = np.column_stack([self.positions.astype(np.int64), signed(self.surface.normals)])
        _, first, index = np.unique(rows, axis=0, return_index=True, return_inverse=True)
        return np.asarray(first[index.reshape(-1)], dtype=np.int64)

    @cached_property
    def _deltas(self) -> Floats:
        """(T, V, 3) displacements by the morph targets; (0, V, 3) where there are none."""
        if self.follow is None:
            return np.zeros((0, len(self.surface.vertices), 3))
        return self.follow.deltas[:, self._same]

    @cached_property
    def _turns(self) -> Floats:
        """(T, V, 3) displacements of the normals."""
        return displaced_normals(self.surface, self._deltas)[:, self._same]

    def joints(self, source: Ints) -> Attributes:
        """JOINTS_0 and WEIGHTS_0 of copies of the vertices in `source`; none where nothing has joints.

        Joints of a vertex rise, those without weight last: neighbours are alike, whichever joint moves them most.
        """
        if self.motion is None or self.follow is None or not self.motion.rig.joints:
            return {}
        kind = np.uint8 if len(self.motion.rig.joints) <= FEW_JOINTS else np.uint16
        which = self._same[source]
        joints, weights = self.follow.joints[which], self.follow.weights[which]
        order = np.argsort(np.where(weights > 0, joints, np.iinfo(joints.dtype).max), axis=1, kind="stable")
        joints = np.take_along_axis(joints, order, axis=1).astype(kind)
        return {"JOINTS_0": joints, "WEIGHTS_0": np.take_along_axis(weights, order, axis=1)}

    def skin_targets(self, buffer: Buffer, source: Ints) -> Record:
        """`targets` of a primitive of the skin whose vertices copy those in `source`; none where there are none."""
        return self._targets(buffer, source, repeat(None, len(self._deltas)))

    def shell_targets(self, buffer: Buffer, charts: Charts) -> Record:
        """The same of the shells."""
        return self._targets(buffer, charts.source, charts_tangents(self.surface, charts, self._deltas))

    def fin_targets(self, buffer: Buffer, fins: Fins) -> Record:
        """The same of the fins."""
        return self._targets(buffer, fins.source, fins_tangents(self.surface, fins, self._deltas))

    def _targets(self, buffer: Buffer, source: Ints, tangents: Iterable[Floats | None]) -> Record:
        if not len(self._deltas):
            return {}
        places = (delta[source] / self.scale for delta in self._deltas)
        return {"targets": targets(buffer, places, (turn[source] for turn in self._turns), tangents)}
