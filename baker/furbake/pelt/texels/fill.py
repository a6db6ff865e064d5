"""Empty texels take their neighbours' values, so that filtering never mixes in what is not there."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from furbake.pelt.hairs.volume import doubled, pool

Array = NDArray[np.float64]

SOLID = 0.06
"""Coverage from which a texel keeps its own value entirely."""


def fill(values: Array, alpha: Array) -> Array:
    """Push–pull over the periodic tile: (K, N, N, C) values weighted by coverage (K, N, N); N a power of two.

    Push: α-weighted means over ever larger squares. Pull: from the coarsest down, a texel keeps its own value as far as
    it is covered and takes the rest from the level above, interpolated between squares.
    """
    means, weights = [np.moveaxis(values, -1, 1)], [np.maximum(alpha, 1e-6)[:, None]]
    while (size := means[-1].shape[-1] // 2) > 0:
        weight = pool(weights[-1], size)
        means.append(pool(means[-1] * weights[-1], size) / weight)
        weights.append(weight)
    filled = means[-1]
    for mean, weight in zip(means[-2::-1], weights[-2::-1], strict=True):
        own = np.clip(weight / SOLID, 0, 1)
        filled = own * mean + (1 - own) * doubled(filled)
    return np.moveaxis(filled, 1, -1)


def fill_directions(tangent: Array, alpha: Array) -> Array:
    """`fill` for unit vectors that point out of the skin, (K, N, N, 3): unit again."""
    filled = fill(tangent, alpha)
    return np.asarray(filled / np.maximum(np.linalg.norm(filled, axis=-1, keepdims=True), 1e-9))
