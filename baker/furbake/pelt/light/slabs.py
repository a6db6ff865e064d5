"""Slabs of hair, and light at their hairs before and after it is scattered."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Single = NDArray[np.float32]


@dataclass(frozen=True)
class Arriving:
    """Light that arrives at the hairs and at the skin, B fields of it.

    phi : (K, B, N, N) ∫I·sin θ dω, flux : (3, K, B, N, N) ∫I·ω dω, floor : (B, N, N) irradiance of the skin
    """

    phi: Single
    flux: Single
    floor: Single


@dataclass(frozen=True)
class Slabs:
    """Periodic slabs of hair in which light is scattered.

    sigma : (K, N, N) extinction across the hairs, per tile width
    thick : of a slab, tile widths
    tangent : (K, N, N, 3) unit direction of the hairs
    aside : as of `Volume`
    """

    sigma: Single
    thick: float
    tangent: Single
    aside: Array | None = None


@dataclass(frozen=True)
class Unscattered:
    """Light of n lamps of irradiance 1 before it is scattered.

    lights : (n, 3) unit directions
    caught, reaching : (n, K, N, N) share of each light that reaches a voxel's hairs, with and without the factor sin θ
    floor : (n, N, N) irradiance of the skin
    """

    lights: Array
    caught: Single
    reaching: Single
    floor: Single

    def of(self, some: slice | NDArray[np.intp]) -> Unscattered:
        """Some of the lamps."""
        return Unscattered(self.lights[some], self.caught[some], self.reaching[some], self.floor[some])

    @property
    def flux(self) -> Single:
        """∫I·ω dω, (n, 3, K, N, N)."""
        directions = self.lights.astype(np.float32)[:, :, None, None, None]
        return np.asarray(self.reaching[:, None] * directions)


@dataclass(frozen=True)
class Scattered:
    """Light of n lamps that was scattered at least twice.

    shares : (n, m) of m parts in the light of each lamp
    parts : (m, 3, K, N, N) M, what hairs send of it to the eye straight above; u and v of the flux ∫I·ω dω at them
    """

    shares: Single
    parts: Single

    def under(self, light: int) -> Single:
        """M and flux of one lamp, (3, K, N, N)."""
        found: Single = (self.shares[light] @ self.parts.reshape(len(self.parts), -1)).reshape(self.parts.shape[1:])
        np.maximum(found[0], 0, out=found[0])
        return found

    @property
    def seen(self) -> Single:
        """M, (n, K, N, N)."""
        parts = self.parts[:, 0]
        found: Single = np.maximum(self.shares @ parts.reshape(len(parts), -1), 0)
        return found.reshape(-1, *parts.shape[1:])
