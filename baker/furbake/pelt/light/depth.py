"""Optical depth of a tile of fur between its voxels and a light, by convolution.

The tile is periodic and τ is linear in σ, so a slab's τ is a sum of convolutions of σ, slab by slab, with the pieces of
the ray that cross them: exact at every angle for a volume that is bilinear within a slab and constant across it.
Bilinear look-up is the mean over a voxel's square of a ray through constant voxels.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
import scipy.fft
from numpy.typing import NDArray

from furbake.pelt.light.paths import FLAT, Rays, thinned

Array = NDArray[np.float64]
Single = NDArray[np.float32]

POINTS_PER_TEXEL, MIN_POINTS = 2, 2
"""Points of a bent ray per texel that it moves aside, and in a slab at least."""

STRIP, DARK = 4, 1e-4
"""Slabs whose rays a processor follows together, and the mean T below which all deeper ones are black."""

BLOCK = 2**16
"""Numbers of the kernels that are made together: they stay in the cache until they have been used."""


MAX_WORK = 2**15
"""Multiplications of one matrix product: BLAS starts no threads for it, which other lights use."""


class Depth:
    """τ in slabs around a ball, along the paths of `paths`: every pair of slabs has a kernel of its own.

    The spectrum of bilinear look-up at a point is the product of one per axis, e^(2πi·f·⌊x⌋)·[(1 − g) + g·e^(2πi·f)]
    with g = x − ⌊x⌋. A kernel's spectrum is the sum of these over its points, a matrix product.

    τ starts half a slab's thickness away from the voxel's middle in every direction.
    """

    def __init__(
        self, sigma: NDArray[np.floating], slab: float, beta: float | None, aside: Array | None = None
    ) -> None:
        """sigma : (K, N, N) per tile width; slab : thickness of a slab, tile widths; aside : as of `Volume`.

        beta : radius of the body, None: flat
        """
        self.layers, self.size, _ = sigma.shape
        self.height, self.beta = slab * self.layers, FLAT if beta is None else beta
        self.spectrum = self._spectrum(sigma)
        self.back = None if aside is None else self._on_device(_moved(-aside, self.size))
        if self.back is not None:
            self.spectrum *= self.back.conj()
        self.turns = self._on_device(_turns(self.size))

    def through(self, light: Array) -> tuple[Single, Single]:
        """Transmittance between the light and the voxels, (K, N, N), and the skin, (N, N). 0 behind the body."""
        clear = np.zeros((self.layers, self.size, self.size), np.float32)
        floor, lz = np.zeros_like(clear[0]), float(light[2])
        # The first ray is that of the skin.
        heights = np.append(0.0, (np.arange(self.layers) + 0.5) / self.layers)
        starts = np.append(0.0, np.full(self.layers, 0.5 / self.layers))
        rays = Rays(heights, lz, self.beta)
        points = Points.along(rays, starts, self.layers, self.height, self.size)
        together = self._together(points)
        for top in range(self.layers, 0, -together):
            strip = slice(max(top - together, 0), top)
            with_skin = strip.start == 0 and lz > 0
            of = slice(0 if with_skin else strip.start + 1, top + 1)
            spectrum = self._depths(points, of, light)
            if self.back is not None:
                spectrum[int(with_skin) :] *= self.back[strip]
            left = self._left(spectrum)
            clear[strip] = left[int(with_skin) :]
            clear[strip][rays.blocked[1:][strip]] = 0
            if with_skin:
                floor = left[0]
            elif clear[strip].mean() < DARK:
                break
        return clear, floor

    def _on_device(self, values: NDArray[Any]) -> Any:
        """An array where the others are."""
        return values

    def _together(self, points: Points) -> int:  # noqa: ARG002 — what is best here does not depend on them
        """Slabs whose rays are followed together, from the tips down."""
        return STRIP

    def _spectrum(self, fields: NDArray[np.floating]) -> Any:
        return scipy.fft.rfft2(np.asarray(fields, np.float32))

    def _depths(self, points: Points, of: slice, light: Array) -> Any:
        """Spectrum of τ along `of` the rays, n of them, to the light, (n, N, N / 2 + 1)."""
        strip = points.strip(of)
        total = np.zeros((of.stop - of.start, *self.spectrum.shape[1:]), np.complex64)
        way = light[:2] / max(float(np.hypot(*light[:2])), 1e-9)
        rows = self._look(strip.feet * way[1], self.size)
        wide = total.shape[2]
        columns = self._look(strip.feet * way[0], wide)
        columns *= strip.weights[:, None]
        most = int(strip.rays.max(initial=1))
        block = halved(self.size, BLOCK / (most * wide))
        scratch = np.empty(most * block * wide, np.complex64)
        products = []
        cells = zip(*(part.tolist() for part in (strip.start, strip.first, strip.rays, strip.each)), strict=True)
        for spectrum, (start, first, rays, each) in zip(self.spectrum, cells, strict=True):
            if rays:
                some = slice(start, start + rays * each)
                few = halved(block, MAX_WORK / (each * wide))
                across = columns[some].reshape(rays, each, wide)
                kernels = scratch[: rays * block * wide].reshape(rays, block, wide)
                # Many small products, made in one call.
                turned = rows[some].reshape(rays, each, self.size).swapaxes(1, 2)
                down = turned.reshape(rays, self.size // few, few, each)
                made = kernels.reshape(rays, block // few, few, wide)
                products.append((down, across[:, None], made, kernels, spectrum, total[first : first + rays]))
        for low in range(0, self.size, block):
            part = slice(low, low + block)
            for down, across, made, kernels, spectrum, sums in products:
                few = down.shape[2]
                np.matmul(down[:, low // few : (low + block) // few], across, out=made)
                np.multiply(kernels, spectrum[part], out=kernels)
                here = sums[:, part]
                np.add(here, kernels, out=here)
        return total

    def _look(self, at: Any, frequencies: int) -> Any:
        """Spectra of linear look-up `at` texels (...) from the voxel, (..., `frequencies`)."""
        whole = np.floor(at)
        found = self.turns[whole.astype(np.intp) % self.size, :frequencies]
        part = (at - whole).astype(np.float32)[..., None] * (self.turns[1, :frequencies] - 1)
        part += 1
        found *= part
        return found

    def _left(self, spectrum: Any) -> Single:
        """e^−τ by the spectra of τ, (n, N, N)."""
        depths = scipy.fft.irfft2(spectrum, s=(self.size, self.size), overwrite_x=True)
        np.maximum(depths, 0, out=depths)
        return np.asarray(np.exp(-depths), np.float32)


@dataclass(frozen=True)
class Points:
    """Points along n rays through K slabs, in their order: ray by ray, slab by slab.

    counts : (n, K) of the points of each ray in each slab
    feet, weights : (P,) texels aside, and what counts of σ there
    """

    counts: NDArray[np.intp]
    feet: Array
    weights: Single

    @classmethod
    def along(cls, rays: Rays, start: Array, layers: int, height: float, size: int) -> Points:
        """start : (n,) distances at which the rays begin; height : of the fur, tile widths, in `layers` slabs."""
        ray, slab, spans = rays.pieces(layers, start)
        length, texel = spans[:, 1] - spans[:, 0], height * size
        moved = (rays.feet(spans[:, 1], ray) - rays.feet(spans[:, 0], ray)) * texel
        points = MIN_POINTS * np.maximum(np.ceil(moved * (POINTS_PER_TEXEL / MIN_POINTS)), 1).astype(np.intp)
        counts = np.zeros((len(rays.height), layers), np.intp)
        np.add.at(counts, (ray, slab), points)
        piece = np.repeat(np.arange(len(points)), points)
        share = (np.arange(len(piece)) - (np.cumsum(points) - points)[piece] + 0.5) / points[piece]
        t, of = spans[piece, 0] + length[piece] * share, ray[piece]
        weight = length[piece] * (height / points[piece]) * thinned(rays.heights(t, of), rays.beta)
        # A ray below the horizon meets slabs twice: the points of both times stand one after the other.
        order = np.argsort(of * layers + slab[piece], kind="stable")
        return cls(counts, (rays.feet(t, of) * texel)[order], weight.astype(np.float32)[order])

    def padded(self, some: slice) -> tuple[Array, Single]:
        """Feet and weights of some rays, (n, K, M) for the most points of a ray in a slab; the rest have no weight."""
        counts, before = self.counts[some], int(self.counts[: some.start].sum())
        there = np.arange(counts.max()) < counts[..., None]
        feet, weights = np.zeros(there.shape), np.zeros(there.shape, np.float32)
        own = slice(before, before + int(counts.sum()))
        feet[there], weights[there] = self.feet[own], self.weights[own]
        return feet, weights

    def strip(self, some: slice) -> Strip:
        """Those of some rays."""
        counts = self.counts[some]
        begin, end = (int(self.counts[:ray].sum()) for ray in (some.start, some.stop))
        hit, each = counts > 0, counts.max(0)
        first = hit.argmax(0)
        rays = np.where(each > 0, len(hit) - hit[::-1].argmax(0) - first, 0)
        room = rays * each
        starts = np.cumsum(room) - room
        cells = starts + (np.arange(len(counts))[:, None] - first) * each
        before = np.cumsum(counts).reshape(counts.shape) - counts
        place = np.repeat((cells - before).ravel(), counts.ravel()) + np.arange(end - begin)
        feet, weights = np.zeros(room.sum()), np.zeros(room.sum(), np.float32)
        feet[place], weights[place] = self.feet[begin:end], self.weights[begin:end]
        return Strip(feet, weights, starts, first, rays, each)


@dataclass(frozen=True)
class Strip:
    """Points of neighbouring rays, slab by slab and there ray by ray, as many of each.

    feet, weights : (P,) as of `Points`; a weight is 0 where a ray has fewer points in a slab than others
    start, first, rays, each : (K,) of every slab the first point, the first ray, and the numbers of rays and of points
        of each
    """

    feet: Array
    weights: Single
    start: NDArray[np.intp]
    first: NDArray[np.intp]
    rays: NDArray[np.intp]
    each: NDArray[np.intp]


@lru_cache(4)
def _turns(size: int) -> NDArray[np.complex64]:
    """e^(2πi·x·f / size) for whole x and f, (size, size)."""
    texel = np.arange(size)
    return np.asarray(np.exp(2j * np.pi / size * (np.outer(texel, texel) % size)), np.complex64)


def halved(rows: int, most: float) -> int:
    """`rows`, halved until they are at most that many, or odd."""
    while rows % 2 == 0 and rows > most:
        rows //= 2
    return rows


def passing(depth: Single) -> Single:
    """Mean over a slab of what is left of light that crosses it, (1 − e^−τ)/τ."""
    thick: Single = np.maximum(depth, np.float32(1e-4))
    return np.asarray(-np.expm1(-thick) / thick, np.float32)


def _moved(aside: Array, size: int) -> NDArray[np.complexfloating]:
    """Factors that move the spectra of K slabs aside by (K, 2) tile widths, (K, size, size / 2 + 1)."""
    along = np.arange(size // 2 + 1)
    across = np.fft.fftfreq(size, 1 / size)
    turns = aside[:, 1, None, None] * across[:, None] + aside[:, 0, None, None] * along
    return np.asarray(np.exp(-2j * np.pi * turns), np.complex64)
