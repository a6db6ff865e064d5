"""Hairs drawn in voxels, and their extinction of light.

A hair of radius r is spread over a width of 2·√(r² + RIM²), in voxels, and takes r's share of it from the light that
crosses it. Drawn so, light fades everywhere by as much as the hair would shut out of a part. `breadth` is the width
times length of the hairs in a volume, per tile width: what they take of light across them while none hides another.
"""

from __future__ import annotations

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Real = TypeVar("Real", np.float32, np.float64)

RIM = 1.0
"""Voxels by which hairs are drawn wider than they are, what a ray reads between voxels included.

With it light that has met no other hair is, in light from 75°, 50°, 35° and 20° at 64 texels a side, 0.97, 0.92, 0.95
and 0.92 (bunny), 0.97, 0.98, 0.97 and 0.96 (sheep), 1.08, 1.03, 1.04 and 1.02 (fox), 1.14, 1.08, 1.07 and 1.03 (paper)
of what a path tracer finds.
"""

MIN_RADIUS = 1e-6
"""Least radius of a hair, tile widths."""


def extinction(breadth: NDArray[Real], radius: Array) -> NDArray[Real]:
    """Extinction by which every hair takes what meets its width, per tile width, (K, N, N).

    breadth : (K, N, N); radius : (K,) mean over the hairs, tile widths
    """
    across, depth = _across(radius, breadth.shape[-1])
    more = depth * across / (2 * np.maximum(radius, MIN_RADIUS))
    return np.asarray(breadth * more.astype(breadth.dtype)[:, None, None])


def through_own(radius: Array, size: int, start: float, sine: Array) -> Array:
    """Mean T of what a hair has of itself before it, (K,), for rays from its voxels, `size` of them a side of the tile.

    radius : (K,); start : how far from a voxel rays begin, tile widths; sine : (K,) of the angle between ray and hair,
    on the mean. Hairs bend away from rays that run along them: what counts is half-way between it and 1.
    """
    across, depth = _across(radius, size)
    free = np.minimum(start * (1 + sine) / 2 / across, 1)
    return np.asarray(free - np.expm1(-depth * (1 - free)) / depth)


def _across(radius: Array, size: int) -> tuple[Array, Array]:
    """Width of a drawn hair, tile widths, and its optical depth."""
    thick = np.maximum(radius, MIN_RADIUS)
    wide = np.hypot(thick, RIM / size)
    return 2 * wide, -np.log1p(-thick / wide)
