"""Colour along a hair."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
RGB = tuple[float, float, float]

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
"""Shares of linear Rec. 709."""

PALE = 0.8
"""Share of a colour's strongest channel above which it counts as grey where its weakest is."""


@dataclass(frozen=True)
class Ramp:
    """Colour along a hair, linear Rec. 709: mix(root, mix(tip, tip2, hue), s^power)."""

    root: RGB = (0.104, 0.053, 0.028)
    tip: RGB = (0.795, 0.556, 0.327)
    tip2: RGB = (0.99, 0.92, 0.78)
    power: float = 1.2

    @property
    def hued(self) -> bool:
        """True where a tip plainly has a hue."""
        return any(min(tip) < PALE * max(tip) for tip in (self.tip, self.tip2))

    @property
    def grey(self) -> Ramp:
        """The same from dark to light without hues: luminances, over that of the lighter tip."""
        root, tip, tip2 = (float(LUMINANCE @ part) for part in (self.root, self.tip, self.tip2))
        lightest = max(tip, tip2) or 1.0
        root, tip, tip2 = (min(part / lightest, 1.0) for part in (root, tip, tip2))
        return Ramp((root,) * 3, (tip,) * 3, (tip2,) * 3, self.power)

    def colour(self, tint: Floats, hue: Floats) -> Floats:
        """The paper's (Rn, Gn, Bn): colour of every texel's hairs in plain light, linear, (K, ...) → (K, ..., 3).

        tint, hue : (K, ...) from the skin to the tips
        """
        root, tip, tip2 = (np.array(part) for part in (self.root, self.tip, self.tip2))
        s = ((np.arange(len(tint)) + 0.5) / len(tint)).reshape(-1, *[1] * tint.ndim)
        end = (1 - hue[..., None]) * tip + hue[..., None] * tip2
        return np.asarray((root + (end - root) * s**self.power) * tint[..., None])
