"""Colour along a hair."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
RGB = tuple[float, float, float]


@dataclass(frozen=True)
class Ramp:
    """Colour along a hair, linear Rec. 709: mix(root, mix(tip, tip2, hue), s^power)."""

    root: RGB = (0.104, 0.053, 0.028)
    tip: RGB = (0.795, 0.556, 0.327)
    tip2: RGB = (0.99, 0.92, 0.78)
    power: float = 1.2

    def colour(self, tint: Floats, hue: Floats) -> Floats:
        """The paper's (Rn, Gn, Bn): colour of every texel's hairs in plain light, linear, (K, ...) → (K, ..., 3).

        tint, hue : (K, ...) from the skin to the tips
        """
        root, tip, tip2 = (np.array(part) for part in (self.root, self.tip, self.tip2))
        s = ((np.arange(len(tint)) + 0.5) / len(tint)).reshape(-1, *[1] * tint.ndim)
        end = (1 - hue[..., None]) * tip + hue[..., None] * tip2
        return np.asarray((root + (end - root) * s**self.power) * tint[..., None])
