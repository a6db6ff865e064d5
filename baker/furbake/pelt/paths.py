"""Straight rays through fur that stands on a ball, as they look in the flat slabs.

Lengths are in lengths of the fur. A body of radius β is below it, so that a point at height s is r = β + s from the
centre, and the fur ends at R = β + 1. A ray leaves the point with lz, the cosine between it and the skin's normal
there. After a distance t

    height     h(t) = √(r² + t² + 2·r·t·lz) − β
    foot       β·ψ(t),  ψ(t) = atan2(t·√(1 − lz²), r + t·lz)

where the foot is how far the ray has moved along the skin, on which the tile is laid, in the azimuth of the light. It
comes no nearer to the centre than b = r·√(1 − lz²); for lz < 0 it meets the skin where b < β. A height h is passed at
t = −r·lz ± √((β + h)² − b²). Hairs diverge: at a height h there are (β/(β + h))² as many in a volume as at the skin.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

BODY_RADIUS = 4.0
"""β: radius of the furry body over the length of its fur, where nothing else is known."""

STEP = 1e-9
"""Lengths of the fur: two heights that are passed closer together than this are one."""


def lowest(beta: float = BODY_RADIUS) -> float:
    """lz of the lowest light that reaches the tips, −√(2β + 1)/(β + 1): the body hides those below it."""
    return float(-np.sqrt(2 * beta + 1) / (beta + 1))


def thinned(height: Array, beta: float) -> Array:
    """Hairs in a volume at these heights, as a share of those at the skin."""
    return (beta / (beta + height)) ** 2


@dataclass(frozen=True)
class Path:
    """The ray from a point at `height` towards a light with this `lz`, above a body of radius `beta`."""

    height: float
    lz: float
    beta: float

    @property
    def radius(self) -> float:
        """r."""
        return self.beta + self.height

    @property
    def across(self) -> float:
        """√(1 − lz²)."""
        return float(np.sqrt(max(1 - self.lz**2, 0.0)))

    @property
    def blocked(self) -> bool:
        """Whether it meets the skin."""
        return self.lz < 0 and self.radius * self.across < self.beta

    def heights(self, t: Array) -> Array:
        """h(t)."""
        return np.sqrt(self.radius**2 + t * t + 2 * self.radius * self.lz * t) - self.beta

    def feet(self, t: Array) -> Array:
        """β·ψ(t)."""
        return self.beta * np.arctan2(t * self.across, self.radius + t * self.lz)

    def pieces(self, slabs: int, start: float, longest: float) -> tuple[NDArray[np.intp], Array]:
        """The ray from t = `start` to the end of the fur, cut where it passes from one of the equal slabs to another.

        Pieces whose feet are more than `longest` apart are cut again. Returns each piece's slab, (n,), and the
        distances where it starts and ends, (n, 2). Where the ray is blocked there are none.
        """
        if self.blocked:
            return np.empty(0, np.intp), np.empty((0, 2))
        levels = self.beta + np.arange(slabs + 1) / slabs
        square = levels**2 - (self.radius * self.across) ** 2
        root = np.sqrt(square[square >= 0])
        passed = np.unique(np.concatenate([-root, root]) - self.radius * self.lz)
        end = passed[-1] if len(passed) else start
        edges = np.concatenate([[start], passed[passed > start + STEP]])
        if end <= start + STEP:
            return np.empty(0, np.intp), np.empty((0, 2))
        feet = self.feet(edges)
        parts = np.maximum(np.ceil(np.abs(np.diff(feet)) / longest), 1).astype(np.intp)
        piece = np.repeat(np.arange(len(parts)), parts)
        within = np.arange(len(piece)) - np.repeat(np.cumsum(parts) - parts, parts)
        share = (within[:, None] + np.array([0.0, 1.0])) / parts[piece, None]
        spans = edges[piece, None] + np.diff(edges)[piece, None] * share
        slab = np.floor(self.heights(spans.mean(1)) * slabs).astype(np.intp)
        return np.clip(slab, 0, slabs - 1), spans
