"""How one hair scatters."""

from __future__ import annotations

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Real = TypeVar("Real", np.float32, np.float64)


ABOVE = np.array([0.0, 0.0, 1.0])
"""Towards the eye that slabs are seen by when they are stored."""


def cylinder(tangent: NDArray[Real], light: Array, eye: Array = ABOVE) -> NDArray[Real]:
    """D: a Lambertian cylinder of direction `tangent` (..., 3), lit from `light`, seen from `eye`.

    sinθ·[sin φ + (π − φ)·cos φ], θ between light and fibre, φ between light and eye around the fibre. Where the fibre
    points at the eye φ has no meaning and its mean, (4/π)·sinθ, holds.
    """
    up, along = (tangent @ way.astype(tangent.dtype) for way in (eye, light))
    sin_light = np.sqrt(np.maximum(1 - along * along, 0))
    sin_view = np.sqrt(np.maximum(1 - up * up, 0))
    cos_phi = np.clip((float(light @ eye) - along * up) / np.maximum(sin_light * sin_view, 1e-4), -1, 1)
    phi = np.arccos(cos_phi)
    seen = np.sin(phi) + (np.pi - phi) * cos_phi
    sure = sin_view**2 / (sin_view**2 + 0.15**2)
    scattered: NDArray[Real] = sin_light * (sure * seen + (1 - sure) * (4 / np.pi))
    return scattered


THINNEST = 0.15
"""Least share of its width that a hair shows to light that runs along it."""


def sine(tangent: NDArray[Real], direction: Array) -> NDArray[Real]:
    """Sine between fibre (..., 3) and direction, at least `THINNEST`: the share of its width that the fibre shows."""
    along = tangent @ direction.astype(tangent.dtype)
    across: NDArray[Real] = np.sqrt(np.maximum(1 - along * along, THINNEST**2))
    return across
