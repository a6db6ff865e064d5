"""Empty texels take their neighbours' values, so that filtering never mixes in what is not there."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

SOLID = 0.06
"""Coverage from which a texel keeps its own value entirely."""


def fill(values: Array, alpha: Array) -> Array:
    """Push–pull over the periodic tile: (K, N, N, C) values weighted by coverage (K, N, N); N a power of two.

    Push: α-weighted means over ever larger squares. Pull: from the coarsest down, a texel keeps its own value as far as
    it is covered and takes the rest from the level above, interpolated between squares.
    """
    means, weights = [values], [np.maximum(alpha, 1e-6)]
    while means[-1].shape[1] > 1:
        weight = weights[-1][..., None]
        means.append(_halve(means[-1] * weight) / _halve(weight))
        weights.append(_halve(weight)[..., 0])
    filled = means[-1]
    for value, weight in zip(means[-2::-1], weights[-2::-1], strict=True):
        own = np.clip(weight / SOLID, 0, 1)[..., None]
        filled = own * value + (1 - own) * _double(filled)
    return filled


def _halve(image: Array) -> Array:
    layers, size, _, channels = image.shape
    halved: Array = image.reshape(layers, size // 2, 2, size // 2, 2, channels).mean((2, 4))
    return halved


def _double(image: Array) -> Array:
    """Twice the size, bilinear, periodic: new texels lie a quarter of an old one beside its middle."""
    for axis in (1, 2):
        before, after = np.roll(image, 1, axis), np.roll(image, -1, axis)
        pairs = np.stack([0.75 * image + 0.25 * before, 0.75 * image + 0.25 * after], axis + 1)
        shape = list(image.shape)
        shape[axis] *= 2
        image = pairs.reshape(shape)
    return image
