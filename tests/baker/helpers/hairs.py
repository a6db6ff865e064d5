"""Single hairs."""

from __future__ import annotations

import numpy as np

from furbake.pelt.hairs.strands import Strands


def hair(*points: tuple[float, float, float], radius: float = 0.02) -> Strands:
    """One hair of 9 points through the given ones."""
    at = np.linspace(0, 1, 9)
    knots = np.linspace(0, 1, len(points))
    line = np.stack([np.interp(at, knots, axis) for axis in np.array(points).T], -1)[None]
    flat = np.ones((1, 9))
    return Strands(points=line, radius=radius * flat, tint=flat, hue=0 * flat)
