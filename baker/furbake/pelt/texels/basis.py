"""Functions of the light's direction that a texel's coefficients multiply, and their integrals over an environment."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Functions = Callable[[Array], Array]
"""Functions of the light's direction, (n, 3) → (n, C)."""

PTM_TERMS = 6
DEGREE = 6
"""Degree of new `eigen` bases: 51 smooth functions. Six curves lose 0.2 dB less in them than in the 27 of degree 4."""


def ptm(lights: Array) -> Array:
    """Rows of the paper's eq. (2): [lu², lv², lu·lv, lu, lv, 1], (n, 3) → (n, 6). No factors 2 (those of eq. (1))."""
    u, v = lights[:, 0], lights[:, 1]
    return np.stack([u * u, v * v, u * v, u, v, np.ones_like(u)], 1)


def held(lights: Array) -> Array:
    """Directions with those below the horizon held on it: (lu, lv) made unit where lz < 0, (n, 3)."""
    below = lights[:, 2] < 0
    across = np.hypot(lights[:, 0], lights[:, 1])
    flat = np.stack([lights[:, 0], lights[:, 1], np.zeros_like(across)], 1) / np.maximum(across, 1e-9)[:, None]
    return np.asarray(np.where(below[:, None], flat, lights))


def smooth_terms(degree: int) -> int:
    """How many smooth functions there are: 27 at degree 4, 51 at 6."""
    return (degree + 1) ** 2 + 2


def smooth(lights: Array, degree: int = DEGREE) -> Array:
    """lu^i·lv^j·lz^k for k in (0, 1), i + j + k ≤ degree (k outermost, then i, then j), then lz^½, lz^¼."""
    u, v, z = lights[:, 0], lights[:, 1], np.maximum(lights[:, 2], 0)
    terms = [u**i * v**j * z**k for k in (0, 1) for i in range(degree + 1) for j in range(degree + 1 - k - i)]
    return np.stack([*terms, z**0.5, z**0.25], 1)


@dataclass(frozen=True)
class Basis:
    """`ptm`: eq. (2). `eigen`: C light curves, each a row of weights of the smooth functions."""

    kind: Literal["ptm", "eigen"]
    degree: int | None = None
    matrix: Array | None = None

    def __call__(self, lights: Array) -> Array:
        """(n, 3) unit directions → (n, C)."""
        if self.matrix is None:
            return ptm(lights)
        return smooth(lights, self.degree or DEGREE) @ self.matrix.T

    @property
    def coefficients(self) -> int:
        return PTM_TERMS if self.matrix is None else len(self.matrix)

    @property
    def constant(self) -> int | None:
        """Coefficient of the function 1, where there is one."""
        if self.matrix is None:
            return PTM_TERMS - 1
        found = np.flatnonzero((self.matrix[:, 0] == 1) & ~self.matrix[:, 1:].any(1))
        return int(found[0]) if len(found) else None


PTM = Basis("ptm")


def harmonics(directions: Array) -> Array:
    """Real orthonormal spherical harmonics to order 2 without the Condon–Shortley sign, (n, 3) → (n, 9)."""
    x, y, z = directions.T
    one = np.ones_like(x)
    return np.stack(
        [
            np.sqrt(1 / (4 * np.pi)) * one,
            np.sqrt(3 / (4 * np.pi)) * y,
            np.sqrt(3 / (4 * np.pi)) * z,
            np.sqrt(3 / (4 * np.pi)) * x,
            np.sqrt(15 / (4 * np.pi)) * x * y,
            np.sqrt(15 / (4 * np.pi)) * y * z,
            np.sqrt(5 / (16 * np.pi)) * (3 * z * z - 1),
            np.sqrt(15 / (4 * np.pi)) * x * z,
            np.sqrt(15 / (16 * np.pi)) * (x * x - y * y),
        ],
        1,
    )


def environment(basis: Basis, rings: int = 64, spokes: int = 64) -> Array:
    """∫ Y_j(ω)·φ_i(ω) dω over the upper hemisphere, (C, 9): radiance in harmonics → light moments.

    Gauss–Legendre in lz^¼, which is singular at the horizon otherwise, equal steps in azimuth.
    """
    node, weight = np.polynomial.legendre.leggauss(rings)
    root = (node + 1) / 2
    z = root**4
    ring = weight / 2 * 4 * root**3
    azimuth = (np.arange(spokes) + 0.5) / spokes * 2 * np.pi
    across = np.sqrt(1 - z * z)
    directions = np.stack(
        [np.outer(across, np.cos(azimuth)), np.outer(across, np.sin(azimuth)), np.repeat(z[:, None], spokes, 1)], -1
    ).reshape(-1, 3)
    area = np.repeat(ring, spokes) * 2 * np.pi / spokes
    return basis(directions).T @ (harmonics(directions) * area[:, None])
