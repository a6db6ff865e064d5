"""Straight rays through fur that stands on a ball, as they look in the flat slabs.

Lengths are in lengths of the fur. A body of radius β is below it, so that a point at height s is r = β + s from the
centre, and the fur ends at R = β + 1. A ray leaves the point with lz, the cosine between it and the skin's normal
there. After a distance t

    height     h(t) = √(r² + t² + 2·r·t·lz) − β
    foot       β·ψ(t),  ψ(t) = atan2(t·√(1 − lz²), r + t·lz)

where the foot is how far the ray has moved along the skin, on which the tile is laid, in the azimuth of the light. It
comes no nearer to the centre than b = r·√(1 − lz²); for lz < 0 it meets the skin where b < β. A height h is passed at
t = −r·lz ± √((β + h)² − b²). Hairs diverge: at a height h there are (β/(β + h))² as many in a volume as at the skin,
and what lies sideways in them is 1 + h/β times as long.

That hairs far along the ray are turned by ψ against it is left out: σ counts by the light's sine where the ray begins.
On a bunny of β = 4, turned hairs would change the mean T of what the eye sees by 1 % over all azimuths down to the
horizon and by −5 % at lz = −.2; for one azimuth by −6 to +9 % at the horizon, ±.004 of T at lz = −.2.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

BODY_RADIUS = 4.0
"""β: radius of the furry body over the length of its fur, where nothing else is known."""

FLAT = 1e5
"""β of a flat patch."""

STEP = 1e-9
"""Lengths of the fur: two heights that are passed closer together than this are one."""


def lowest(beta: float = BODY_RADIUS) -> float:
    """lz of the lowest light that reaches the tips, −√(2β + 1)/(β + 1): the body hides those below it."""
    return float(-np.sqrt(2 * beta + 1) / (beta + 1))


def thinned(height: Array, beta: float) -> Array:
    """Hairs in a volume at these heights, as a share of those at the skin."""
    return (beta / (beta + height)) ** 2


def spread(tangent: NDArray[np.float32], height: Array, beta: float) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Hairs that lean are drawn apart sideways by 1 + h/β: their direction, and how much longer that makes them.

    tangent : (K, ..., 3) unit vectors in slabs at `height`, (K,); returns the same and (K, ...)
    """
    drawn = np.ones((len(height), 3), np.float32)
    drawn[:, :2] = (1 + height / beta)[:, None]
    way = tangent * drawn.reshape(len(height), *[1] * (tangent.ndim - 2), 3)
    longer = np.linalg.norm(way, axis=-1)
    return way / longer[..., None], longer


@dataclass(frozen=True)
class Rays:
    """Rays from n points at `height` (n,) towards a light with this `lz`, above a body of radius `beta`.

    What is asked about points of them takes distances t and the ray's index of each, two arrays of one shape.
    """

    height: Array
    lz: float
    beta: float

    @property
    def radius(self) -> Array:
        """r, (n,)."""
        return self.beta + self.height

    @property
    def across(self) -> float:
        """√(1 − lz²)."""
        return float(np.sqrt(max(1 - self.lz**2, 0.0)))

    @property
    def blocked(self) -> NDArray[np.bool_]:
        """Which of them meet the skin, (n,)."""
        return (self.lz < 0) & (self.radius * self.across < self.beta)

    def heights(self, t: Array, ray: NDArray[np.intp]) -> Array:
        """h(t)."""
        r = self.radius[ray]
        return np.asarray(np.sqrt(r * r + t * (t + 2 * self.lz * r)) - self.beta)

    def feet(self, t: Array, ray: NDArray[np.intp]) -> Array:
        """β·ψ(t)."""
        return np.asarray(self.beta * np.arctan2(t * self.across, self.radius[ray] + t * self.lz))

    def pieces(self, slabs: int, start: Array) -> tuple[NDArray[np.intp], NDArray[np.intp], Array]:
        """The rays from t = `start` (n,) to the end of the fur, cut where they pass from one of the equal slabs to
        another.

        Returns each piece's ray and slab, (m,), and the distances where it starts and ends, (m, 2). A ray that is
        blocked has none.
        """
        r = self.radius[:, None]
        square = (self.beta + np.arange(slabs + 1) / slabs) ** 2 - (r * self.across) ** 2
        # Levels that a ray doesn't come down to are passed at its lowest point.
        root = np.sqrt(np.maximum(square, 0))
        edges = np.maximum(np.concatenate([-root[:, ::-1], root], 1) - r * self.lz, start[:, None])
        ray, edge = np.nonzero((np.diff(edges) > STEP) & ~self.blocked[:, None])
        spans = np.stack([edges[ray, edge], edges[ray, edge + 1]], 1)
        slab = np.floor(self.heights(spans.mean(1), ray) * slabs).astype(np.intp)
        return ray, np.clip(slab, 0, slabs - 1), spans
