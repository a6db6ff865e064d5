"""Light and tone mapping of the page (`web/page/daylight.ts`, `toneMapping.ts`), for pictures made without it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
RGB = tuple[float, float, float]

SHOULDER = 0.6
"""Largest channel, linear, up to which the tone mapping changes nothing."""

PALING = 0.03
"""Paling per unit of light that the tone mapping takes away."""


@dataclass(frozen=True)
class Scene:
    """Lamp and sky, linear Rec. 709; the defaults are the page's.

    lamp : irradiance perpendicular to the light; sky, ground : irradiance of a surface that faces up, or down
    """

    lamp: RGB = (2.4 * math.pi, 2.28 * math.pi, 2.088 * math.pi)
    sky: RGB = (0.33 * math.pi, 0.39 * math.pi, 0.48 * math.pi)
    ground: RGB = (0.168 * math.pi, 0.144 * math.pi, 0.12 * math.pi)


PAGE = Scene()


def tone_mapped(linear: Array) -> Array:
    """Tone mapping of the page (`web/page/toneMapping.ts`), (..., 3) → 0..1: below a shoulder nothing changes."""
    peak = linear.max(-1, keepdims=True)
    high = np.maximum(peak, SHOULDER)
    shown = 1 - (1 - SHOULDER) ** 2 / (high + 1 - 2 * SHOULDER)
    kept = 1 / (1 + PALING * (high - shown))
    mapped = np.where(peak <= SHOULDER, linear, shown + (linear * shown / high - shown) * kept)
    return np.asarray(np.clip(mapped, 0, 1))
