"""Lit and dark sides of hairs that are broader than the voxels in which they are drawn.

A hair is a cylinder. The eye sees its surface from −1 to 1 radii beside its axis t; at x the normal is
n = x·b + √(1 − x²)·w, with w towards the eye across the hair and b = t × w. Diffuse, it sends 4·max(n·l, 0) in the
unit of L. A voxel shows a part of the width, x = sin ψ from ψ₁ to ψ₂, and sends on the mean

    D = sin θ · 4/(x₂ − x₁) · [½·ψ·cos φ + ¼·sin(2ψ − φ)]  from max(ψ₁, φ − π/2) to min(ψ₂, φ + π/2)

for a light at φ around the hair, towards b: over the whole width `fibre.cylinder`. Of light from
many hairs, much the same from everywhere but for its flux F, a surface takes 1/4 + F·n/2, and sides differ by 2x·(F·b).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from furbake.pelt.light.fibre import Cylinders

Array = NDArray[np.float64]
Single = NDArray[np.float32]

QUARTER = np.float32(np.pi / 2)

LEAST = 0.02
"""Least part of the width, in radii, that a voxel shows."""

END_ON = 1e-3
"""Least sine between hair and eye by which b is found."""


class Sides:
    """Hairs seen from straight above under many lights: what no light changes is worked out once."""

    def __init__(self, axes: Single, off_axis: NDArray[np.floating] | None, radius: Array) -> None:
        """axes : (3, K, N, N) unit vectors along the hairs; off_axis, radius : as of `Volume`"""
        self.axes, self.whole, self.told = axes, Cylinders(axes[2]), off_axis is not None
        self.place = np.zeros_like(axes[2])
        if off_axis is None:
            return
        place = off_axis[..., 0] * axes[1] - off_axis[..., 1] * axes[0]
        place /= np.maximum(self.whole.sin_view, END_ON)
        half = np.maximum(0.5 / (axes.shape[-1] * np.maximum(radius, 1e-6)), LEAST).astype(np.float32)[:, None, None]
        low, high = np.clip(place - half, -1, 1 - LEAST), np.clip(place + half, LEAST - 1, 1)
        self.place = (low + high) / 2
        self.start, self.end, self.per_width = np.arcsin(low), np.arcsin(high), 4 / (high - low)

    def lit(self, light: Array, along: Single, some: slice) -> Single:
        """D of some of the slabs; along : cosines between their hairs and the light, a unit vector (3,)."""
        if not self.told:
            return self.whole.lit(along, float(light[2]), some)
        sin_light, cos_phi = self.whole.around(along, float(light[2]), some)
        u, v = light[:2].astype(np.float32)
        phi = np.copysign(np.arccos(cos_phi), u * self.axes[1][some] - v * self.axes[0][some])
        first = np.maximum(self.start[some], phi - QUARTER)
        last = np.maximum(np.minimum(self.end[some], phi + QUARTER), first)
        seen = (last - first) * cos_phi
        seen += (np.sin(2 * last - phi) - np.sin(2 * first - phi)) / 2
        seen *= self.per_width[some] / 2
        seen *= self.whole.sure[some]
        seen += self.whole.unsure[some]
        seen *= sin_light
        return np.asarray(seen)

    def beside(self) -> Single:
        """x·b, where voxels show the hairs beside their axes, level, (2, K, N, N)."""
        across = self.place * self.whole.sure / np.maximum(self.whole.sin_view, END_ON)
        return np.stack([across * self.axes[1], -across * self.axes[0]])
