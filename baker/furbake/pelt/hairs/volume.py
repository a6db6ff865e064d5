"""Strands drawn into a periodic volume of slabs, and averaged down to the slabs that are stored."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np
import scipy.sparse
from numpy.typing import NDArray

from furbake.pelt.hairs.drawn import MIN_RADIUS, extinction
from furbake.pelt.hairs.strands import Strands

Array = NDArray[np.float64]
Voxels = NDArray[Any]
"""Numbers of voxels, of single precision in fine volumes, of double in stored slabs."""

Real = TypeVar("Real", np.float32, np.float64)

FINER = 2
"""The volume is built and lit this much finer in every axis at least: discretisation is the largest error of all."""

FINE_SLABS = 64
"""Slabs up to which voxels are made as flat as they are wide; more cost more than they gain."""

PLANES = 2
"""Horizontal cuts per fine slab."""

SOLID_SLAB = 1 / 16
"""Share of the fur's height to which `Coat.opacity` refers."""


@dataclass(frozen=True)
class Volume:
    """A tile of fur as K slabs of N × N voxels, slab 0 at the skin, indexed [slab, row = v, column = u].

    sigma : (K, N, N) extinction per tile width that shells show
    breadth : (K, N, N) width times length of the hairs in a volume, per tile width
    radius : (K,) mean over the hairs by their width, tile widths
    tangent : (K, N, N, 3) unit mean direction of the hairs, towards the tips; +z where there are none
    tint, hue : (K, N, N) means over the hairs, 0..1
    drift : (K, 2) mean displacement of the hairs from their roots, tile widths
    height : tile widths
    aside : (K, 2) how far a slab's voxels lie beside the skin's, tile widths; None: nowhere
    off_axis : (K, N, N, 2) mean place of a voxel's middle beside the axes of its hairs, level, in their radii; None:
        voxels show hairs in all of their width
    """

    sigma: Voxels
    breadth: Voxels
    radius: Array
    tangent: Voxels
    tint: Voxels
    hue: Voxels
    drift: Array
    height: float
    aside: Array | None = None
    off_axis: NDArray[np.float32] | None = None

    @property
    def slab(self) -> float:
        """Thickness of a slab, tile widths."""
        return self.height / len(self.sigma)

    @property
    def coverage(self) -> Voxels:
        """α = 1 − exp(−σ·h), (K, N, N): what a slab hides, seen from straight above."""
        return -np.expm1(-self.sigma * self.slab)

    @property
    def extinction(self) -> Voxels:
        """Extinction of light across the hairs, per tile width, (K, N, N)."""
        return extinction(self.breadth, self.radius)


def fine_shape(layers: int, size: int, height: float) -> tuple[int, int]:
    """Slabs and voxels per side of the volume from which `layers` slabs of `size` × `size` texels are averaged."""
    even = round(height * size * FINER / layers)
    return layers * max(FINER, min(even, -(-FINE_SLABS // layers))), size * FINER


def voxelise(
    strands: Strands, height: float, layers: int, size: int, opacity: float, aside: Array | None = None
) -> Volume:
    """Draw strands into `layers` slabs of `size` × `size` voxels.

    Each slab is cut by `PLANES` horizontal planes; where a hair crosses a plane, its cross-section (an ellipse, the
    longer the more the hair lies down) is drawn with an antialiased rim.

    `opacity` is the optical depth of 1/16 of the height filled with hair, `aside` as of `Volume`.
    """
    step = strands.points[:, 1:] - strands.points[:, :-1]
    direction = step / np.maximum(np.linalg.norm(step, axis=-1, keepdims=True), 1e-12)
    beside = np.zeros((layers, 2)) if aside is None else aside
    # Slab by slab, since sums of all of them would be the most memory that a bake takes.
    sigma, breadth, tint, hue = np.empty((4, layers, size * size), np.float32)
    tangent, off_axis = (np.empty((layers, size * size, axes), np.float32) for axes in (3, 2))
    radius, drift = np.zeros(layers), np.zeros((layers, 2))
    for slab in range(layers):
        drawn = _Drawn(size)
        for plane in range(PLANES):
            z = (slab + (plane + 0.5) / PLANES) / layers * height
            drawn.cut(strands, step, direction, z, beside[slab])
        empty = drawn.weight < 1e-6
        mean = drawn.sums[:, :5] / np.maximum(drawn.weight, 1e-6)[:, None]
        along = np.where(empty[:, None], [0.0, 0.0, 1.0], mean[:, :3])
        tangent[slab] = along / np.maximum(np.linalg.norm(along, axis=-1, keepdims=True), 1e-9)
        tint[slab], hue[slab] = np.where(empty, [[strands.tint.mean()], [strands.hue.mean()]], mean[:, 3:].T)
        sigma[slab] = drawn.solid * opacity / (height * SOLID_SLAB)
        breadth[slab] = drawn.sums[:, 6]
        off_axis[slab] = (drawn.off_axis / np.maximum(drawn.weight, 1e-6)).T
        radius[slab] = drawn.widths[0] / max(drawn.widths[1], 1e-12)
        drift[slab] = drawn.drift[:2] / max(drawn.drift[2], 1e-12) + beside[slab]
    shape = (layers, size, size)
    return Volume(
        sigma=sigma.reshape(shape),
        breadth=breadth.reshape(shape),
        radius=radius,
        tangent=tangent.reshape(*shape, 3),
        tint=tint.reshape(shape),
        hue=hue.reshape(shape),
        drift=drift,
        height=height,
        aside=aside,
        off_axis=off_axis.reshape(*shape, 2),
    )


class _Drawn:
    """Hairs drawn into a slab of voxels.

    solid : (N²,) share of each voxel that hair fills; sums : (N², 7) of coverage times tangent x, y, z, tint, hue, 1,
    and breadth; off_axis : (2, N²) of coverage times the place beside the axis; widths, drift : sums over the hairs
    """

    def __init__(self, size: int) -> None:
        self.size, self.solid = size, np.zeros(size * size)
        self.sums, self.off_axis = np.zeros((size * size, 7)), np.zeros((2, size * size))
        self.widths, self.drift = np.zeros(2), np.zeros(3)

    @property
    def weight(self) -> Array:
        """Coverage of each voxel by all its hairs, (N²,)."""
        return self.sums[:, 5]

    def cut(self, strands: Strands, step: Array, direction: Array, z: float, beside: Array) -> None:
        """Draw the cross-sections of the hairs that a plane at height z meets.

        step, direction : (S, P − 1, 3) from each point to the next, and made unit; beside : (2,) of the voxels
        """
        points, thickness, size = strands.points, strands.radius, self.size
        hair, segment = np.nonzero((points[:, :-1, 2] <= z) != (points[:, 1:, 2] <= z))
        if not len(hair):
            return
        onwards = step[hair, segment]
        t = (z - points[hair, segment, 2]) / onwards[:, 2]
        centre = points[hair, segment, :2] + t[:, None] * onwards[:, :2] - beside
        thick = thickness[hair, segment] * (1 - t) + thickness[hair, segment + 1] * t
        along = direction[hair, segment]
        along = along * np.where(along[:, 2:] < 0, -1.0, 1.0)

        cover, voxel, off = cross_sections(centre, thick, along, size)
        here = np.zeros(size * size)
        np.maximum.at(here, voxel.ravel(), cover.ravel())
        self.solid += here / PLANES
        colour = [part[hair, segment] * (1 - t) + part[hair, segment + 1] * t for part in (strands.tint, strands.hue)]
        wide = 2 / (np.pi * PLANES * np.maximum(thick, MIN_RADIUS))
        values = np.column_stack([along, *colour, np.ones_like(thick), wide])
        starts = np.arange(len(hair) + 1) * cover.shape[1]
        drawn = scipy.sparse.csr_array((cover.ravel(), voxel.ravel(), starts), (len(hair), size * size))
        self.sums += drawn.T @ values
        per_radius = 1 / np.maximum(thick * size, MIN_RADIUS)
        for axis, apart in enumerate(off):
            shares = cover * apart * per_radius[:, None]
            self.off_axis[axis] += np.bincount(voxel.ravel(), shares.ravel(), size * size)
        self.widths += (thick * thick).sum(), thick.sum()
        self.drift += np.append(thick @ (centre - points[hair, 0, :2]), thick.sum())


def cross_sections(centre: Array, thick: Array, along: Array, size: int) -> tuple[Array, NDArray[np.int64], Array]:
    """Coverage of the voxels around n cut hairs: (n, w) coverage 0..1, (n, w) flat voxel index, wrapped, and (2, n, w)
    where their middles lie from the hair's, voxels.
    """
    reach = int(np.ceil(min((thick / np.maximum(along[:, 2], 0.3)).max() * size, size / 2))) + 1
    offset = np.arange(-reach, reach + 1)
    dv, du = (grid.ravel() for grid in np.meshgrid(offset, offset, indexing="ij"))
    position = centre * size - 0.5
    nearest = np.floor(position + 0.5).astype(np.int64)
    u = nearest[:, :1] + du - position[:, :1]
    v = nearest[:, 1:] + dv - position[:, 1:]
    axial = u * along[:, :1] + v * along[:, 1:2]
    distance = np.sqrt(np.maximum(u * u + v * v - axial * axial, 0.0))
    # A disc of radius q with a rim one voxel wide has the area π(q² + 1/12): q is such that this is the hair's own.
    # Below q = 1/2 nothing but the rim is left, which is then drawn thinner.
    square = (thick[:, None] * size) ** 2
    q = np.sqrt(np.maximum(square - 1 / 12, 1 / 4))
    cover = np.clip(q - distance + 0.5, 0.0, 1.0) * np.minimum(1.0, 3 * square)
    voxel = (nearest[:, 1:] + dv) % size * size + (nearest[:, :1] + du) % size
    return cover, voxel, np.stack([u, v])


def pool(fine: NDArray[Real], size: int) -> NDArray[Real]:
    """Means over squares of voxels: (..., N, N) → (..., size, size)."""
    *rest, rows, columns = fine.shape
    tall, wide = rows // size, columns // size
    sums: NDArray[Real] = fine.reshape(*rest, size, tall, columns).sum(-2)
    mean = sums[..., ::wide].copy()  # columns by slices: NumPy is slow in sums over few neighbours
    for column in range(1, wide):
        mean += sums[..., column::wide]
    mean /= tall * wide
    return mean


def doubled(image: NDArray[Real]) -> NDArray[Real]:
    """Twice as fine, bilinear, periodic: (..., N, N) → (..., 2N, 2N). New voxels lie a quarter of an old one off."""
    for axis in (-2, -1):
        before, after = np.roll(image, 1, axis), np.roll(image, -1, axis)
        shape = list(image.shape)
        shape[axis] *= 2
        pairs = np.stack([0.75 * image + 0.25 * before, 0.75 * image + 0.25 * after], axis if axis == -1 else -2)
        image = pairs.reshape(shape)
    return image


def moved(image: NDArray[np.float32], aside: Array) -> NDArray[np.float32]:
    """An image (..., N, N) read `aside` texels (u, v) from their middles, bilinear, periodic."""
    whole = np.floor(aside).astype(int)
    part = (aside - whole).astype(np.float32)
    near = np.roll(image, (-whole[1], -whole[0]), (-2, -1))
    near = near + part[0] * (np.roll(near, -1, -1) - near)
    return np.asarray(near + part[1] * (np.roll(near, -1, -2) - near), np.float32)


def seen_from_above(coverage: NDArray[Real], layers: int) -> NDArray[Real]:
    """Visible share of each fine slab from above within its coarse slab, α_j·Π(1−α): (K·f, N, N) → (K, f, N, N)."""
    slabs = coverage.reshape(layers, -1, *coverage.shape[1:])
    shares = np.empty_like(slabs)
    clear = np.ones_like(slabs[:, 0])
    for j in reversed(range(slabs.shape[1])):
        shares[:, j] = slabs[:, j] * clear
        clear = clear * (1 - slabs[:, j])
    return shares


def average_down(fine: NDArray[Real], shares: NDArray[Real], size: int) -> NDArray[Real]:
    """Mean of a quantity as seen from above: (K·f, M, M) with shares (K, f, M, M) → (K, size, size)."""
    weights = np.maximum(shares, 1e-6)
    values = fine.reshape(shares.shape)
    mean: NDArray[Real] = pool((values * weights).sum(1), size) / pool(weights.sum(1), size)
    return mean


def joined(slabs: NDArray[np.float32], count: int) -> NDArray[np.float32]:
    """Means of every `count` slabs, (K, N, N) → (K / count, N, N)."""
    return slabs if count == 1 else np.asarray(slabs.reshape(-1, count, *slabs.shape[1:]).mean(1))


def parted(slabs: NDArray[np.float32], count: int) -> NDArray[np.float32]:
    """Linear between the middles of slabs at those of `count` times as many, (K, N, N) → (K · count, N, N)."""
    if count == 1:
        return slabs
    place = (np.arange(len(slabs) * count) + 0.5) / count - 0.5
    low = np.clip(np.floor(place).astype(np.intp), 0, max(len(slabs) - 2, 0))
    share = np.clip(place - low, 0, 1).astype(np.float32)
    parts = np.empty((len(place), *slabs.shape[1:]), np.float32)
    for i, (one, other) in enumerate(zip(low, np.minimum(low + 1, len(slabs) - 1), strict=True)):
        np.subtract(slabs[other], slabs[one], out=parts[i])
        parts[i] *= share[i]
        parts[i] += slabs[one]
    return parts


def slab_means(fine: Array, layers: int) -> Array:
    """Means of two numbers per fine slab over the stored slabs, (K·f, 2) → (K, 2)."""
    return np.asarray(fine.reshape(layers, -1, 2).mean(1))


def coarsen(fine: Volume, layers: int, size: int) -> Volume:
    """The stored slabs from the fine ones: coverage is kept exactly, all else is weighted by what the eye sees."""
    shares = seen_from_above(fine.coverage, layers)
    coverage, hairs = pool(shares.sum(1), size).astype(float), fine.breadth.mean((1, 2), dtype=np.float64)
    tangent = np.stack([average_down(fine.tangent[..., axis], shares, size) for axis in range(3)], -1).astype(float)
    return Volume(
        sigma=-np.log1p(-np.minimum(coverage, 1 - 1e-9)) / (fine.height / layers),
        breadth=pool(fine.breadth.reshape(layers, -1, *fine.breadth.shape[1:]).mean(1), size).astype(float),
        radius=(fine.radius * hairs).reshape(layers, -1).sum(1) / np.maximum(hairs.reshape(layers, -1).sum(1), 1e-12),
        tangent=tangent / np.maximum(np.linalg.norm(tangent, axis=-1, keepdims=True), 1e-9),
        tint=average_down(fine.tint, shares, size).astype(float),
        hue=average_down(fine.hue, shares, size).astype(float),
        drift=slab_means(fine.drift, layers),
        height=fine.height,
        aside=None if fine.aside is None else slab_means(fine.aside, layers),
    )
