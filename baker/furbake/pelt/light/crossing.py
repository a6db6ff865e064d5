"""How light that travels in some directions crosses periodic slabs of hair."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from furbake.pelt.light.fibre import cylinder, sine

Array = NDArray[np.float64]
Single = NDArray[np.float32]

ELEVATIONS, AZIMUTHS = 3, 8
"""Directions per hemisphere: Gauss–Legendre in the cosine, even in azimuth."""


@dataclass(frozen=True)
class Crossing:
    """D directions of travel, all up or all down, through K slabs of N × N voxels; (K, D, N, N) each:

    passes : share of the light that crosses a slab without meeting a hair
    per_sine : 1 over the sine between hairs and light
    width, to_eye : that sine, and what hairs send straight up of the light, times the direction's solid angle
    rows, columns : matrices (D, N, N) for each of the K + 1 steps from outside through all slabs
    """

    passes: Single
    per_sine: Single
    width: Single
    to_eye: Single
    rows: Sequence[Single]
    columns: Sequence[Single]

    @classmethod
    def of(
        cls, sigma: Single, thick: float, tangent: Single, aside: Array, ways: Array, solid_angles: Array
    ) -> Crossing:
        """sigma, thick, tangent : as of `Slabs`; aside : (K, 2) of the slabs, voxels; ways : (D, 3) unit vectors."""
        layers, size, _ = sigma.shape
        passes, per_sine, width, to_eye = np.empty((4, layers, len(ways), size, size), np.float32)
        for d, (way, solid_angle) in enumerate(zip(ways, solid_angles, strict=True)):
            shown = sine(tangent, way)
            passes[:, d] = np.exp(sigma * shown * np.float32(-thick / abs(way[2])))
            per_sine[:, d] = 1 / shown
            width[:, d] = shown * np.float32(solid_angle)
            to_eye[:, d] = cylinder(tangent, -way) * np.float32(solid_angle)
        # The light at x comes from x + shift in the slab before; half of it at the skin and above all slabs.
        shift = -ways[:, :2] / np.abs(ways[:, 2:]) * thick * size
        order = np.arange(layers) if ways[0, 2] > 0 else np.arange(layers)[::-1]
        places = np.concatenate([np.zeros((1, 2)), aside])[[*(order + 1), 0]]
        start = np.zeros(2) if ways[0, 2] > 0 else aside[-1]
        beside = np.diff(places, axis=0, prepend=start[None])
        if ways[0, 2] > 0:
            beside[-1] = 0
        known = dict[bytes, tuple[Single, Single]]()
        steps = []
        for step, moved in enumerate(beside):
            offset = shift * (0.5 if step in {0, layers} else 1.0) + moved
            if offset.tobytes() not in known:
                columns, rows = (np.stack([_shift_matrix(x, size) for x in part]) for part in offset.T)
                known[offset.tobytes()] = rows, np.ascontiguousarray(columns.swapaxes(1, 2))
            steps.append(known[offset.tobytes()])
        return cls(passes, per_sine, width, to_eye, [rows for rows, _ in steps], [columns for _, columns in steps])

    def move(self, light: Single, step: int, other: Single, out: Single) -> None:
        """Write into `out` the light (B, D, N, N) from where it comes to the slab that is met at this step.

        other : overwritten; out : may be `light`
        """
        np.matmul(self.rows[step], light, out=other)
        np.matmul(other, self.columns[step], out=out)


def hemisphere_rule() -> tuple[Array, Array]:
    """Unit directions of the upper hemisphere, (m, 3), and their solid angles, (m,), which sum to 2π.

    Every ring is turned against the one before it.
    """
    node, weight = np.polynomial.legendre.leggauss(ELEVATIONS)
    z = np.repeat((node + 1) / 2, AZIMUTHS)
    turn = np.repeat(np.arange(ELEVATIONS) / ELEVATIONS, AZIMUTHS)
    azimuth = 2 * np.pi * (np.tile(np.arange(AZIMUTHS), ELEVATIONS) + turn) / AZIMUTHS
    across = np.sqrt(1 - z * z)
    directions = np.stack([across * np.cos(azimuth), across * np.sin(azimuth), z], -1)
    return directions, np.repeat(weight, AZIMUTHS) * np.pi / AZIMUTHS


def _shift_matrix(shift: float, size: int) -> Single:
    """The matrix, (size, size), that reads a periodic row of texels at x + shift, linearly between two."""
    whole = int(np.floor(shift))
    part = np.float32(shift - whole)
    texel = np.arange(size)
    matrix = np.zeros((size, size), np.float32)
    matrix[texel, (texel + whole) % size] = 1 - part
    matrix[texel, (texel + whole + 1) % size] += part
    return matrix
