"""Functions of the light that relight's formats use besides the polynomial: what its viewers compute, restated.

H: Gautron, Křivánek, Pattanaik, Bouatouch: A Novel Hemispherical Basis for Accurate and Efficient Rendering, 2004.
"""

from __future__ import annotations

import numpy as np

from furbake.pelt.texels.basis import harmonics
from furbake.rti.relit import Array

GRAZING = 0.15
"""Radians above the horizon to which lights of `hemispherical` are raised."""

NEAR = 1e-3
"""Share of a radial function below which relight leaves it out."""


def polynomial(lights: Array) -> Array:
    """[1, lu, lv, lu², lu·lv, lv²]: the polynomial in relight's order, (n, 3) → (n, 6)."""
    u, v, _ = lights.T
    return np.stack([np.ones_like(u), u, v, u * u, u * v, v * v], 1)


def hemispherical(lights: Array) -> Array:
    """Hemispherical harmonics of order 2, (n, 3) → (n, 9)."""
    azimuth = np.arctan2(lights[:, 1], lights[:, 0])
    c = np.cos(np.minimum(np.arccos(np.clip(lights[:, 2], -1, 1)), np.pi / 2 - GRAZING))
    ring, band = np.sqrt(np.maximum(c - c * c, 0)), 2 * c - 1
    functions = np.stack(
        [
            np.full_like(c, np.sqrt(1 / (2 * np.pi))),
            np.sqrt(6 / np.pi) * ring * np.cos(azimuth),
            np.sqrt(3 / (2 * np.pi)) * band,
            np.sqrt(6 / np.pi) * ring * np.sin(azimuth),
            np.sqrt(30 / np.pi) * (c * c - c) * np.cos(2 * azimuth),
            np.sqrt(30 / np.pi) * band * ring * np.cos(azimuth),
            np.sqrt(5 / (2 * np.pi)) * (6 * c * c - 6 * c + 1),
            np.sqrt(30 / np.pi) * band * ring * np.sin(azimuth),
            np.sqrt(30 / np.pi) * (c * c - c) * np.sin(2 * azimuth),
        ],
        1,
    )
    return np.asarray(functions)


def spherical(lights: Array) -> Array:
    """Spherical harmonics of order 2 in relight's order and signs, (n, 3) → (n, 9)."""
    return np.asarray(harmonics(lights)[:, [0, 3, 2, 1, 4, 7, 6, 5, 8]] * np.array([1, 1, 1, 1, 1, 1, 1, 1, -1]))


def radial(lights: Array, lamps: Array, sigma: float) -> Array:
    """Gaussians around the lamps (m, 3), sums 1, (n, 3) → (n, m)."""
    squares = ((lights[:, None] - lamps) ** 2).sum(-1)
    nearest = squares.min(1, keepdims=True)
    found = np.exp((nearest - squares) / sigma**2)
    found /= found.sum(1, keepdims=True)
    found *= found > NEAR
    return np.asarray(found / found.sum(1, keepdims=True))


def bilinear(lights: Array, resolution: int) -> Array:
    """Four neighbours on a lattice over the octahedron, (n, 3) → (n, resolution²), row by row."""
    u, v, z = (lights / np.abs(lights).sum(1, keepdims=True)).T
    found = np.zeros((len(lights), resolution, resolution))
    at = [(np.clip((axis + 1) / 2, 0, 1)) * (resolution - 1) for axis in (u + v, v - u)]
    low = [np.clip(np.floor(axis).astype(int), 0, resolution - 2) for axis in at]
    rows = np.arange(len(z))
    for right in (0, 1):
        for down in (0, 1):
            shares = [1 - np.abs(axis - first - step) for axis, first, step in zip(at, low, (right, down), strict=True)]
            found[rows, low[1] + down, low[0] + right] = shares[0] * shares[1]
    return found.reshape(len(lights), -1)
