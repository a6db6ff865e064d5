"""Axes of an animal, and the direction of uncombed fur on each side of it."""

from __future__ import annotations

from typing import Literal

import numpy as np

from furbake.surface.charts import Floats
from furbake.surface.mesh import Surface
from furbake.surface.repair.topology import face_vectors, unit

Guide = Literal["nose-tail", "down"]

AXES: Floats = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], dtype=np.float64)
"""Outward from the six sides of a box."""

SINK = 0.35
"""How far hair on the flanks turns down while it runs from the nose to the tail."""


def frames(surface: Surface, guide: Guide) -> tuple[Floats, Floats]:
    """(6, 3) unit u axes and (6, 3) unit v axes of the sides in the order of `AXES`; u × v points outward."""
    tail, down = -nose(surface), np.array([0.0, -1.0, 0.0])
    laid = tail + SINK * down if guide == "nose-tail" else down
    wish = np.tile(laid, (6, 1))
    wish[2:4] = tail
    wish[np.abs(AXES @ tail) > 0.5] = down
    along_v = unit(wish - AXES * np.einsum("ij,ij->i", wish, AXES)[:, None])
    return np.cross(along_v, AXES), along_v


def nose(surface: Surface) -> Floats:
    """(3,) axis from the tail to the nose: along the longer horizontal side of the model.

    Along z the nose is at +z, as glTF has it; along x it is at the end whose outer third stands higher (a head is
    carried above a tail), +x where both are level.
    """
    x, _, z = np.ptp(surface.vertices, axis=0)
    if x <= 1.05 * z:
        return np.array([0.0, 0.0, 1.0])
    middle = surface.vertices[surface.faces].mean(axis=1)
    area = np.linalg.norm(face_vectors(surface.vertices, surface.faces), axis=1)
    low, high = surface.vertices[:, 0].min(), surface.vertices[:, 0].max()
    ends = [area * (middle[:, 0] < low + (high - low) / 3.0), area * (middle[:, 0] > high - (high - low) / 3.0)]
    first, last = (float(end @ middle[:, 1]) / max(float(end.sum()), 1e-300) for end in ends)
    return np.array([-1.0 if first > last + 0.01 * surface.extent else 1.0, 0.0, 0.0])
