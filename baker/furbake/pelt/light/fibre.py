"""How one hair scatters."""

from __future__ import annotations

from typing import Any, Generic, TypeVar

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
    return Cylinders(up).lit(along, float(light @ eye))


class Cylinders(Generic[Real]):
    """`cylinder` of fibres seen from one eye under many lights: what no light changes is worked out once."""

    def __init__(self, up: NDArray[Real]) -> None:
        """up : (...) cosines between the fibres and the eye."""
        self.up: NDArray[Real] = up
        self.sin_view: NDArray[Real] = across(up)
        self.sure: NDArray[Real] = self.sin_view**2 / (self.sin_view**2 + 0.15**2)
        self.unsure: NDArray[Real] = (1 - self.sure) * (4 / np.pi)

    def around(self, along: NDArray[Real], between: float, some: Any = ...) -> tuple[NDArray[Real], NDArray[Real]]:
        """Sine between some of the fibres and a light, and cos φ around them; parameters as of `lit`."""
        sin_light = across(along)
        cos_phi = np.multiply(along, self.up[some], out=np.empty_like(along))
        np.subtract(between, cos_phi, out=cos_phi)
        cos_phi /= np.maximum(sin_light * self.sin_view[some], 1e-4)
        np.clip(cos_phi, -1, 1, out=cos_phi)
        return sin_light, cos_phi

    def lit(self, along: NDArray[Real], between: float, some: Any = ...) -> NDArray[Real]:
        """D under a light whose cosines are `along` (...) with some of the fibres and `between` with the eye."""
        return self.scattered(*self.around(along, between, some), some)

    def scattered(self, sin_light: NDArray[Real], cos_phi: NDArray[Real], some: Any = ...) -> NDArray[Real]:
        """D by what `around` gives."""
        seen = _around_lit(cos_phi)
        seen *= self.sure[some]
        seen += self.unsure[some]
        seen *= sin_light
        return seen


def _around_lit(cos_phi: NDArray[Real]) -> NDArray[Real]:
    """sin φ + (π − φ)·cos φ."""
    seen: NDArray[Real] = np.arccos(cos_phi, out=np.empty_like(cos_phi))
    np.subtract(np.pi, seen, out=seen)
    seen *= cos_phi
    seen += across(cos_phi)
    return seen


def across(along: NDArray[Real]) -> NDArray[Real]:
    """Sine of the angle whose cosine is `along`."""
    sine = np.multiply(along, along, out=np.empty_like(along))
    np.subtract(1, sine, out=sine)
    np.maximum(sine, 0, out=sine)
    np.sqrt(sine, out=sine)
    return sine


THINNEST = 0.15
"""Least share of its width that a hair shows to light that runs along it."""


def sine(tangent: NDArray[Real], direction: Array) -> NDArray[Real]:
    """Sine between fibre (..., 3) and direction, at least `THINNEST`: the share of its width that the fibre shows."""
    return shown(tangent @ direction.astype(tangent.dtype))


def shown(along: NDArray[Real]) -> NDArray[Real]:
    """`sine` by the cosines between fibres and a direction, (...)."""
    width = np.multiply(along, along, out=np.empty_like(along))
    np.subtract(1, width, out=width)
    np.maximum(width, THINNEST**2, out=width)
    np.sqrt(width, out=width)
    return width
