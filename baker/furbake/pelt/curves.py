"""Mean light of every slab over the direction of the light, a factor of its texels' polynomials.

The mean curve of slab k is m_k(l, β) = Σ_q w_kq · b_q(l, β): a few curves b_q for all slabs and states of a fur, and
weights w of each slab. β is the radius of the body in lengths of its fur.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from furbake.pelt.light.paths import BODY_RADIUS, lowest
from furbake.pelt.texels.basis import Functions, harmonics, held

Array = NDArray[np.float64]

RADII = (1.0, 4.0, 16.0)
"""β of the tables; other bodies are mixed from two of them in proportion to 1/(β + 1), and none is out of their range.

Beside light transport itself at β = 8, the mean light of what is seen from above is .98 to 1.03 of the measured down to
the horizon, and 1.0 to 1.1 below it; mixed in proportion to log β it was 1.05 to 1.14, and 1.2 to 1.3.
"""

KNOTS = 17
"""Knots of a table: x = 0, 1 ... 16 of `abscissa`."""

HORIZON = 6
"""x of the horizon."""

RING_POINTS, SPOKES = 4, 24
"""Quadrature over the sphere: Gauss points between two knots, equal steps in azimuth."""


def lean_direction(lean: Array) -> Array:
    """Direction in which the fur leans; along v where it does not."""
    length = float(np.hypot(*lean))
    return lean / length if length > 1e-6 else np.array([0.0, 1.0])


def abscissa(lz: Array, beta: float) -> Array:
    """x in a table for lights at height lz: 0 where no tip sees them, 6 at the horizon, 16 at the zenith."""
    above = HORIZON + (KNOTS - 1 - HORIZON) * np.sqrt(np.clip(lz, 0, 1))
    return np.asarray(np.where(lz >= 0, above, HORIZON * np.maximum(1 - lz / lowest(beta), 0)))


def elevation(x: Array, beta: float) -> Array:
    """The reverse of `abscissa`."""
    above = ((x - HORIZON) / (KNOTS - 1 - HORIZON)) ** 2
    return np.asarray(np.where(x >= HORIZON, above, (1 - x / HORIZON) * lowest(beta)))


def hats(x: Array) -> Array:
    """Weights of the knots at x, (n,) → (n, 17): linear between two."""
    return np.asarray(np.maximum(1 - np.abs(x[:, None] - np.arange(KNOTS)), 0))


def shares(beta: float) -> Array:
    """Weights of the tables of `RADII` for a body of radius β, (3,)."""
    places = -1 / (np.array(RADII) + 1)
    return np.array([np.interp(-1 / (beta + 1), places, row) for row in np.eye(len(RADII))])


@dataclass(frozen=True)
class Curves:
    """b_q(l, β) = even_q(x, β) + along_q(x, β)·(l_h·m), l_h the light held on the horizon.

    even, along : (Q, 3, 17) tables for each of `RADII`; knot 0 is dark
    lean : (2,) m, the direction in which the fur leans, of length 1
    """

    even: Array
    along: Array
    lean: Array

    @property
    def count(self) -> int:
        """Q."""
        return len(self.even)

    def __call__(self, lights: Array, beta: float = BODY_RADIUS) -> Array:
        """b, (n, 3) unit directions → (n, Q)."""
        knots = hats(abscissa(lights[:, 2], beta))
        even, along = (np.einsum("nx,r,qrx->nq", knots, shares(beta), table) for table in (self.even, self.along))
        return np.asarray(even + along * (held(lights)[:, :2] @ self.lean)[:, None])

    def mean(self, lights: Array, weights: Array, beta: float = BODY_RADIUS) -> Array:
        """m, (n, 3) unit directions and weights (K, Q) → (n, K)."""
        return np.asarray(self(lights, beta) @ weights.T)

    def of_fin(self) -> Curves:
        """The curves of a fin, which stands along v: light from u and from −u does the same there."""
        return replace(self, lean=self.lean * [0.0, 1.0])

    def environment(self, phi: Functions, beta: float = BODY_RADIUS) -> Array:
        """∫ Y_j(ω)·φ_i(ω_h)·b_q(ω, β) dω over all directions that the tips see, (Q, C, 9): radiance → light moments.

        phi : the basis, lights (n, 3) held on the horizon → (n, C). Gauss–Legendre between the knots, above the
        horizon in lz^¼, in which the basis is smooth.
        """
        directions, area = sphere(beta)
        moments = phi(held(directions)) * area[:, None]
        curves = self(directions, beta)
        return np.asarray(np.einsum("nq,nc,nj->qcj", curves, moments, harmonics(directions), optimize=True))


def at_heights(weights: Array, s: Array) -> Array:
    """Weights at heights 0..1, (K, Q) → (n, Q): linear between the middles of slabs, held beyond them."""
    count = len(weights)
    return np.stack([np.interp(s * count - 0.5, np.arange(count), column) for column in weights.T], -1)


def sphere(beta: float) -> tuple[Array, Array]:
    """Directions, (n, 3), and the solid angles for which they stand, (n,), from the lowest that tips see upwards."""
    node, weight = np.polynomial.legendre.leggauss(RING_POINTS)
    low = np.arange(KNOTS - 1.0)
    first, last = (np.concatenate([x[:HORIZON], np.sqrt(x[HORIZON:] - HORIZON)]) for x in (low, low + 1))
    at = (first + (last - first) * (node[:, None] + 1) / 2).T  # x below the horizon, √(x − 6) above it
    step = ((last - first) * weight[:, None] / 2).T
    x = np.concatenate([at[:HORIZON], HORIZON + at[HORIZON:] ** 2])
    wide = (KNOTS - 1.0 - HORIZON) ** 2
    ring = np.concatenate([step[:HORIZON] * -lowest(beta) / HORIZON, step[HORIZON:] * 4 * at[HORIZON:] ** 3 / wide])
    z = elevation(x, beta).ravel()
    azimuth = (np.arange(SPOKES) + 0.5) / SPOKES * 2 * np.pi
    across = np.sqrt(1 - z * z)
    upright = np.repeat(z[:, None], SPOKES, 1)
    directions = np.stack([np.outer(across, np.cos(azimuth)), np.outer(across, np.sin(azimuth)), upright], -1)
    return directions.reshape(-1, 3), np.repeat(ring.ravel(), SPOKES) * 2 * np.pi / SPOKES
