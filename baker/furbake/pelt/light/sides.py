"""Lit and dark sides of hairs that are broader than the voxels in which they are drawn.

A hair is a cylinder. The eye sees its surface from −1 to 1 radii beside its axis t; at x the normal is
n = x·b + √(1 − x²)·w, with w towards the eye across the hair and b = t × w. Diffuse, it sends 4·max(n·l, 0) in the
unit of L. A voxel shows a part of the width, x = sin ψ from ψ₁ to ψ₂, and sends on the mean

    D = sin θ · 4/(x₂ − x₁) · [½·ψ·cos φ + ¼·sin(2ψ − φ)]  from max(ψ₁, φ − π/2) to min(ψ₂, φ + π/2)

for a light at φ around the hair, towards b: over the whole width `fibre.cylinder`. Of light from many hairs, much the
same from everywhere but for its flux F, a surface takes 1/4 + F·n/2, and sides differ by 2x·(F·b).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from furbake.pelt.light.fibre import Cylinders

Array = NDArray[np.float64]
Single = NDArray[np.float32]

QUARTER = np.float32(np.pi / 2)
"""A quarter turn."""

LEAST = 0.02
"""Least part of the width, in radii, that a voxel shows."""

END_ON = 1e-3
"""Least sine between hair and eye by which b is found."""


class Sides:
    """Hairs seen from straight above under many lights: what no light changes is worked out once."""

    def __init__(
        self, axes: Single, there: NDArray[np.bool_], off_axis: NDArray[np.floating] | None, radius: Array
    ) -> None:
        """axes : (3, K, N, N) unit vectors along the hairs; there : (K, N, N) voxels that have some
        off_axis, radius : as of `Volume`
        """
        self.shape, self.voxels, self.placed = there.shape, np.flatnonzero(there), off_axis is not None
        u, v, up = (part.ravel()[self.voxels] for part in axes)
        self.whole, self.place = Cylinders(up), np.zeros_like(up)
        across = np.maximum(self.whole.sin_view, np.float32(END_ON))
        self.across = v / across, -u / across
        if off_axis is None:
            return
        off = off_axis.reshape(-1, 2)[self.voxels].astype(np.float32)
        along = off[:, 0] * u + off[:, 1] * v
        self.off = np.stack([off[:, 0] - along * u, off[:, 1] - along * v, -along * up])
        place = off[:, 0] * self.across[0] + off[:, 1] * self.across[1]
        size = self.shape[-1]
        half = np.maximum(0.5 / (size * np.maximum(radius, 1e-6)), LEAST).astype(np.float32)[self.voxels // size**2]
        low, high = np.clip(place - half, -1, 1 - LEAST), np.clip(place + half, LEAST - 1, 1)
        self.place = (low + high) / 2
        self.start, self.end, self.per_width = np.arcsin(low), np.arcsin(high), 4 / (high - low)

    def lit(self, light: Array, along: Single, some: slice) -> Single:
        """D of some of the slabs; along : cosines between their hairs and the light, a unit vector (3,)."""
        area = self.shape[1] * self.shape[2]
        first, last = np.searchsorted(self.voxels, [some.start * area, some.stop * area])
        hairs = slice(int(first), int(last))
        at = self.voxels[hairs] - some.start * area
        # As of upright hairs: a texel without any has some value.
        found = np.full(along.size, 4 / np.pi * np.hypot(*light[:2]), np.float32)
        found[at] = self._lit(light, along.ravel()[at], hairs)
        return found.reshape(along.shape)

    def towards(self, light: Array, width: Single) -> Single:
        """How far voxels lie from their hairs' axes towards a light, in radii, of all `voxels`.

        width : (K, N, N) sine between hairs and light, as of `fibre.shown`
        """
        place = np.tensordot(light.astype(np.float32), self.off, 1)
        place /= width.ravel()[self.voxels]
        return np.asarray(place)

    def _lit(self, light: Array, along: Single, hairs: slice) -> Single:
        if not self.placed:
            return self.whole.lit(along, float(light[2]), hairs)
        sin_light, cos_phi = self.whole.around(along, float(light[2]), hairs)
        u, v = light[:2].astype(np.float32)
        phi = np.copysign(np.arccos(cos_phi), u * self.across[0][hairs] + v * self.across[1][hairs])
        first = np.maximum(self.start[hairs], phi - QUARTER)
        last = np.maximum(np.minimum(self.end[hairs], phi + QUARTER), first)
        seen = (last - first) * cos_phi
        seen += (np.sin(2 * last - phi) - np.sin(2 * first - phi)) / 2
        seen *= self.per_width[hairs] / 2
        seen *= self.whole.sure[hairs]
        seen += self.whole.unsure[hairs]
        seen *= sin_light
        return np.asarray(seen)

    def beside(self) -> Single:
        """x·b, where voxels show the hairs beside their axes, level, (2, K, N, N)."""
        found = np.zeros((2, np.prod(self.shape)), np.float32)
        for part, across in zip(found, self.across, strict=True):
            part[self.voxels] = self.place * self.whole.sure * across
        return found.reshape(2, *self.shape)
