"""One light on its way through the oversampled volume, before anything is scattered twice."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from furbake.device import device
from furbake.pelt.hairs.drawn import through_own, through_own_from
from furbake.pelt.hairs.volume import Volume, doubled, joined, parted, pool, slab_means
from furbake.pelt.light.card import CardDepth
from furbake.pelt.light.depth import Depth
from furbake.pelt.light.fibre import shown
from furbake.pelt.light.paths import spread, thinned
from furbake.pelt.light.sides import Sides
from furbake.pelt.light.slabs import Slabs

Array = NDArray[np.float64]
Single = NDArray[np.float32]

HIDDEN = 0.02
"""Weight of occluded hairs in the mean of their texel (visible = 1)."""

EVEN_SIZE = 32
"""Texels a side, E, in which light is scattered between hairs, or half of the stored ones where these are fewer.

A texel holds two or three hairs then. Where one hair fills many, M comes out too small: 0.85 and 0.92 (bunny), 0.87 and
0.89 (sheep), 0.80 and 0.80 (fox) of a path tracer's with 64, under lights from 76° and 15°.
"""

MERGED = 2
"""Fine slabs that a bent ray crosses as one where a stored slab has twice as many or more: T changes little between."""

CHUNK = 2**16
"""Voxels that are worked on together: a core's cache holds what is between."""

Fields = tuple[Single, Single, Single, Single]
"""T·D averaged down, caught, reaching and the skin's irradiance, as of `Beam.__call__`."""


def mean_share(part: Single, whole: Single) -> Array:
    """Mean of each slab's `part` over that of its `whole`, (K, N, N) both → (K,); 1 where both are 0."""
    some, all_of_it = (field.sum((1, 2), dtype=np.float64) + 1e-9 for field in (part, whole))
    return np.asarray(some / all_of_it)


def transmitted(
    sigma: Single,
    width: Single,
    radius: Array,
    slab: float,
    light: Array,
    beta: float | None,
    *,
    aside: Array | None = None,
    merged: int = 1,
    sides: Sides | None = None,
) -> tuple[Single, Single]:
    """T of voxels, (K, N, N), and the skin's irradiance, (N, N), under a light.

    sigma : (K, N, N) extinction across the hairs; width : sine between hairs and light, as of `sine`
    radius : (K,) of the hairs, tile widths; slab : thickness, tile widths
    beta : radius of the body, None: flat; aside : as of `Volume`
    merged : slabs that a ray crosses as one; sides : of the hairs, where they are broader than voxels

    What a hair does to its own light is divided out of T: it is in D. With `sides` this is done voxel by voxel: on the
    lit side there is little of the hair before them, and D is greatest.
    """
    caught = sigma * width
    slabs = len(caught) // merged
    kind = Depth if device() == "cpu" else CardDepth
    depth = kind(joined(caught, merged), slab * merged, beta, None if aside is None else slab_means(aside, slabs))
    drawn = radius, caught.shape[-1], slab * merged / 2, mean_share(caught, sigma)
    del caught
    clear, floor = depth.through(light)
    clear = parted(clear, merged)
    if sides is None or not sides.placed:
        clear /= through_own(*drawn).astype(np.float32)[:, None, None]
    else:
        place, voxels = sides.towards(light, width), sides.voxels
        own = through_own_from(place, voxels // clear[0].size, *drawn)
        of_hairs = clear.reshape(-1)
        of_hairs[voxels] = np.minimum(of_hairs[voxels] / own, 1)
    return clear, floor * np.float32(max(light[2], 0))


def mean_direction(parts: list[Single]) -> Single:
    """Unit vectors, (..., 3), of three components; upright where all are 0."""
    vectors = np.stack(parts, -1)
    vectors[..., 2] += 1e-9
    vectors /= np.linalg.norm(vectors, axis=-1, keepdims=True)
    return vectors


class Beam:
    """One light through the oversampled volume, before anything is scattered twice."""

    def __init__(self, fine: Volume, layers: int, size: int, beta: float | None) -> None:
        """beta : radius of the body; None: flat."""
        self.beta, self.layers, self.size, self.slab = beta, layers, size, fine.slab
        self.even = min(size // 2, EVEN_SIZE)
        self.aside, self.height = fine.aside, fine.height
        coverage = fine.coverage.astype(np.float32)
        clear = np.cumprod(1 - coverage[::-1], axis=0, dtype=np.float32)[::-1]
        above = np.concatenate([clear[1:], np.ones_like(clear[:1])])
        # Hairs that the eye sees through all that lies above count most in their texel.
        self.shares = np.maximum(coverage * (above + HIDDEN), np.float32(1e-6), dtype=np.float32)
        self.breadth, self.sigma = fine.breadth.astype(np.float32), fine.extinction.astype(np.float32)
        tangent = fine.tangent.astype(np.float32)
        if beta is not None:
            middle = (np.arange(len(self.sigma)) + 0.5) / len(self.sigma)
            tangent, longer = spread(tangent, middle, beta)
            self.breadth *= longer
            self.sigma *= longer
        self.axes = np.ascontiguousarray(np.moveaxis(tangent, -1, 0))
        self.sides = Sides(self.axes, fine.breadth > 0, fine.off_axis, fine.radius)
        self.seen = self._pooled(self.shares, self.size)
        self.beside = [self._pooled(self.shares * part, self.size) / self.seen for part in self.sides.beside()]
        self.hair: Single = np.maximum(self.stored(self.breadth), np.float32(1e-6))
        per_slab = len(self.sigma) // layers
        self.merged = MERGED if per_slab >= 2 * MERGED and per_slab % MERGED == 0 else 1
        self.radius = fine.radius

    def __call__(self, light: Array) -> Fields:
        """T·D averaged down, (layers, N, N); T·sin θ and T on average over the hairs, (layers, E, E); the skin's
        irradiance, (E, E).

        A hair that the light runs along catches less of it and shades less: its σ counts times the sine between the
        two.
        """
        along = self.along(light)
        passed, skin = self._reach(light, along, self.sides)
        return self.to_eye(passed, light, along), *self.caught(passed, along), pool(skin, self.even)

    def along(self, way: Array) -> Single:
        """Cosines between the hairs and a direction, (K, N, N)."""
        return np.asarray(np.tensordot(way.astype(np.float32), self.axes, 1))

    def to_eye(self, passed: Single, light: Array, along: Single) -> Single:
        """T·D averaged down, (layers, N, N); passed : T of the fine voxels; along : of the light."""
        single = np.empty((self.layers, self.size, self.size), np.float32)
        for some, fine in self._chunks():
            lit = self.sides.lit(light, along[fine], fine)
            lit *= passed[fine]
            lit *= self.shares[fine]
            np.divide(self._pooled(lit, self.size), self.seen[some], out=single[some])
        return single

    def several(self, scattered: Single) -> Single:
        """M of the stored texels, which see the hairs' sides, (layers, N, N); scattered : as of `Scattered.under`."""
        found, *fluxes = self._all_texels(scattered)
        for flux, beside in zip(fluxes, self.beside, strict=True):
            found += 2 * flux * beside
        return np.asarray(np.maximum(found, 0, out=found))

    def caught(self, passed: Single, along: Single) -> tuple[Single, Single]:
        """T·sin θ and T on average over the hairs, (layers, E, E); parameters as of `to_eye`."""
        caught, reaching = np.empty((2, *self.hair.shape), np.float32)
        for some, fine in self._chunks():
            lit = passed[fine] * self.breadth[fine]
            np.divide(self.stored(lit), self.hair[some], out=reaching[some])
            lit *= shown(along[fine])
            np.divide(self.stored(lit), self.hair[some], out=caught[some])
        return caught, reaching

    def reach(self, light: Array, *, sides: bool = True) -> tuple[Single, Single]:
        """T of the fine voxels, (K, N, N), and the skin's irradiance, (N, N); sides : of hairs are told apart, else
        what a hair leaves of its own light is its mean.
        """
        return self._reach(light, self.along(light), self.sides if sides else None)

    def _reach(self, light: Array, along: Single, sides: Sides | None) -> tuple[Single, Single]:
        return transmitted(
            self.sigma,
            shown(along),
            self.radius,
            self.slab,
            light,
            self.beta,
            aside=self.aside,
            merged=self.merged,
            sides=sides,
        )

    def slabs(self) -> Slabs:
        """The stored slabs in E × E texels, as thin as hair is on the body, for `scatter`."""
        tangent = mean_direction([self.stored(self.breadth * axis) for axis in self.axes])
        sigma = self.stored(self.breadth)
        if self.beta is not None:
            sigma *= thinned((np.arange(self.layers) + 0.5) / self.layers, self.beta).astype(np.float32)[:, None, None]
        aside = None if self.aside is None else slab_means(self.aside, self.layers)
        return Slabs(sigma, self.height / self.layers, tangent, aside)

    def stored(self, fine: Single) -> Single:
        """Means over blocks of the fine voxels of whole stored slabs, (layers, E, E)."""
        return self._pooled(fine, self.even)

    def _all_texels(self, even: Single) -> Single:
        """(..., E, E) as (..., N, N)."""
        while even.shape[-1] < self.size:
            even = doubled(even)
        return even

    def _pooled(self, fine: Single, size: int) -> Single:
        per_slab = len(self.sigma) // self.layers
        return pool(fine.reshape(-1, per_slab, *fine.shape[1:]).mean(1), size)

    def _chunks(self) -> Iterator[tuple[slice, slice]]:
        """Some stored slabs after the other, and the fine slabs that they are made of."""
        per_slab = len(self.sigma) // self.layers
        count = max(CHUNK // (per_slab * self.sigma[0].size), 1)
        for first in range(0, self.layers, count):
            last = min(first + count, self.layers)
            yield slice(first, last), slice(first * per_slab, last * per_slab)
