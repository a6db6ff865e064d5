"""How one hair scatters."""

from __future__ import annotations

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Real = TypeVar("Real", np.float32, np.float64)


ABOVE = np.array([0.0, 0.0, 1.0])
"""Direction of the eye for which slabs are stored."""


def cylinder(tangent: NDArray[Real], light: Array, eye: Array = ABOVE) -> NDArray[Real]:
    """D: a Lambertian cylinder of direction `tangent` (..., 3), lit from `light`, seen from `eye`.

    sinθ·[sin φ + (π − φ)·cos φ], θ between light and fibre, φ between light and eye around the fibre. Where the fibre
    points at the eye φ has no meaning and its mean, (4/π)·sinθ, holds.
    """
    up, along = (tangent @ way.astype(tangent.dtype) for way in (eye, light))
    return scattered(across(along), across(up), around(along, up, float(light @ eye)))


def across(along: NDArray[Real]) -> NDArray[Real]:
    """Sine of the angle whose cosine is `along`."""
    sine: NDArray[Real] = np.sqrt(np.maximum(1 - along * along, 0))
    return sine


def around(light: NDArray[Real], eye: NDArray[Real], between: float) -> NDArray[Real]:
    """cos φ around the fibre, of directions with these cosines with it, and `between` each other."""
    cosine: NDArray[Real] = np.clip((between - light * eye) / np.maximum(across(light) * across(eye), 1e-4), -1, 1)
    return cosine


def scattered(sin_light: NDArray[Real], sin_view: NDArray[Real], cos_phi: NDArray[Real]) -> NDArray[Real]:
    """D by the sines between fibre and light, fibre and eye, and by cos φ."""
    phi: NDArray[Real] = np.arccos(cos_phi)
    seen = np.sin(phi) + (np.pi - phi) * cos_phi
    sure: NDArray[Real] = sin_view**2 / (sin_view**2 + 0.15**2)
    lit: NDArray[Real] = sin_light * (sure * seen + (1 - sure) * (4 / np.pi))
    return lit


THINNEST = 0.15
"""Least share of its width that a hair shows to light that runs along it."""


def sine(tangent: NDArray[Real], direction: Array) -> NDArray[Real]:
    """Sine between fibre (..., 3) and direction, at least `THINNEST`: the share of its width that the fibre shows."""
    along = tangent @ direction.astype(tangent.dtype)
    across: NDArray[Real] = np.sqrt(np.maximum(1 - along * along, THINNEST**2))
    return across
