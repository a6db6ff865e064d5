"""Optical depth of a tile of fur between its voxels and a light, by convolution.

The tile is periodic and τ is linear in σ, so a slab's τ is a sum of convolutions of σ, slab by slab, with the pieces of
the ray that cross them: exact at every angle for a volume that is bilinear within a slab and constant across it.
Bilinear look-up is the mean over a voxel's square of a ray through constant voxels.
"""

from __future__ import annotations

import numpy as np
import scipy.fft
from numpy.typing import NDArray

from furbake.pelt.light.paths import FLAT, Rays, thinned

Array = NDArray[np.float64]
Single = NDArray[np.float32]
Spectrum = NDArray[np.complexfloating]

OWN_POINTS, OWN_POINTS_PER_TEXEL = 8, 8
"""Points of a ray through a voxel's own slab, at least, and per texel that it moves aside there."""

POINTS_PER_TEXEL, MIN_POINTS = 2, 2
"""Points of a bent ray per texel that it moves aside, and in a slab at least."""

STRIP, DARK = 8, 1e-4
"""Slabs whose rays are followed together, from the tips down, and the mean T below which all deeper ones are black."""

TOGETHER = 2**17
"""Numbers in the spectra of a strip, at most: with them a core's cache holds what is added up."""

BLOCK = 2**14
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
        self.spectrum = scipy.fft.rfft2(np.asarray(sigma, np.float32))
        self.back = None if aside is None else _moved(-aside, self.size)
        if self.back is not None:
            self.spectrum *= self.back.conj()
        texel = np.arange(self.size)
        self.turns = np.exp(2j * np.pi / self.size * (np.outer(texel, texel) % self.size)).astype(np.complex64)

    def through(self, light: Array) -> tuple[Single, Single]:
        """Transmittance between the light and the voxels, (K, N, N), and the skin, (N, N). 0 behind the body."""
        clear = np.zeros((self.layers, self.size, self.size), np.float32)
        middle, lz = (np.arange(self.layers) + 0.5) / self.layers, float(light[2])
        count = min(max(TOGETHER // self.spectrum[0].size, 1), STRIP)
        for top in range(self.layers, 0, -count):
            strip = slice(max(top - count, 0), top)
            rays = Rays(middle[strip], lz, self.beta)
            spectrum = self._depths(rays, 0.5 / self.layers, light)
            if self.back is not None:
                spectrum *= self.back[strip]
            np.exp(-self._in_space(spectrum), out=clear[strip])
            clear[strip][rays.blocked] = 0
            if clear[strip].mean() < DARK:
                return clear, np.zeros_like(clear[0])
        if lz <= 0:
            return clear, np.zeros_like(clear[0])
        skin = self._depths(Rays(np.zeros(1), lz, self.beta), 0.0, light)
        return clear, np.exp(-self._in_space(skin)[0])

    def own(self, light: Array) -> Single:
        """τ along the ray up to half a slab's thickness on both sides of the voxel's middle, (K, N, N)."""
        slab = self.height / self.layers
        kernel = scipy.fft.rfft2(self._crossed(light[:2] * slab * self.size))
        share = thinned((np.arange(self.layers) + 0.5) / self.layers, self.beta).astype(np.float32)
        spectrum = self.spectrum * kernel * share[:, None, None]
        return self._in_space(spectrum if self.back is None else spectrum * self.back) * np.float32(slab)

    def _crossed(self, way: Array) -> Single:
        """Weights, (N, N), of the piece of a ray around a voxel's middle that moves `way` voxels aside."""
        count = max(OWN_POINTS, int(np.ceil(np.hypot(*way) * OWN_POINTS_PER_TEXEL)))
        t = (np.arange(count) + 0.5) / count - 0.5
        # Reading σ at x + way·t is a convolution with a point at −way·t.
        x, y = -way[0] * t, -way[1] * t
        column, row = np.floor(x).astype(np.int64), np.floor(y).astype(np.int64)
        fx, fy = x - column, y - row
        n = self.size
        weights = np.zeros(n * n)
        for down, wy in ((0, 1 - fy), (1, fy)):
            for right, wx in ((0, 1 - fx), (1, fx)):
                weights += np.bincount((row + down) % n * n + (column + right) % n, wx * wy, n * n)
        return (weights / count).reshape(n, n).astype(np.float32)

    def _depths(self, rays: Rays, start: float, light: Array) -> Spectrum:
        """Spectrum of τ on the way from t = `start` to the light, (n, N, N / 2 + 1) for n rays."""
        total = np.zeros((len(rays.height), *self.spectrum.shape[1:]), np.complex64)
        texel = self.height * self.size
        way = light[:2] * (texel / max(float(np.hypot(*light[:2])), 1e-9))
        feet, weights, counts = self._points(rays, start, texel)
        odd = self.size // (self.size & -self.size)
        scratch = np.empty(max(BLOCK, total[:, :odd].size), np.complex64)
        for slab in np.flatnonzero(counts.any(0)):
            met = np.flatnonzero(counts[:, slab])
            some, points = slice(met[0], met[-1] + 1), counts[:, slab].max()
            at, weight = feet[some, slab, :points], weights[some, slab, :points, None]
            rows = self._look(at * way[1], self.size).swapaxes(1, 2)
            columns = self._look(at * way[0], self.size // 2 + 1) * weight
            block = in_blocks(len(at), points, columns.shape[2], self.size)
            shape = len(at), block, columns.shape[2]
            kernels = scratch[: shape[0] * shape[1] * shape[2]].reshape(shape)
            for first in range(0, self.size, block):
                part = slice(first, first + block)
                np.matmul(rows[:, part], columns, out=kernels)
                kernels *= self.spectrum[slab, part]
                total[some, part] += kernels
        return total

    def _points(self, rays: Rays, start: float, texel: float) -> tuple[Array, Single, NDArray[np.intp]]:
        """Points along n rays, P at most in each of K slabs: feet and weights, (n, K, P), and their number, (n, K)."""
        ray, slab, spans = rays.pieces(self.layers, start)
        length = spans[:, 1] - spans[:, 0]
        moved = (rays.feet(spans[:, 1], ray) - rays.feet(spans[:, 0], ray)) * texel
        points = MIN_POINTS * np.maximum(np.ceil(moved * (POINTS_PER_TEXEL / MIN_POINTS)), 1).astype(np.intp)
        counts = np.zeros((len(rays.height), self.layers), np.intp)
        np.add.at(counts, (ray, slab), points)
        piece = np.repeat(np.arange(len(points)), points)
        share = (np.arange(len(piece)) - np.repeat(np.cumsum(points) - points, points) + 0.5) / points[piece]
        t, of = spans[piece, 0] + length[piece] * share, ray[piece]
        # A ray below the horizon meets slabs twice: the points of both times stand one after the other.
        cell = of * self.layers + slab[piece]
        order = np.argsort(cell, kind="stable")
        before = np.cumsum(counts) - counts.ravel()
        number = np.arange(len(cell)) - before[cell[order]]
        shape = *counts.shape, int(counts.max(initial=1))
        feet, weights = np.zeros(shape), np.zeros(shape, np.float32)
        where = *np.divmod(cell[order], self.layers), number
        feet[where] = rays.feet(t, of)[order]
        weight = length[piece] * (self.height / points[piece]) * thinned(rays.heights(t, of), self.beta)
        weights[where] = weight[order]
        return feet, weights, counts

    def _look(self, at: Array, frequencies: int) -> NDArray[np.complex64]:
        """Spectra of linear look-up `at` texels (n, P) from the voxel, (n, P, `frequencies`)."""
        whole = np.floor(at).astype(np.intp)
        part = (at - whole).astype(np.float32)[..., None]
        before, after = (self.turns[(whole + step) % self.size, :frequencies] for step in (0, 1))
        return np.asarray(before + part * (after - before), np.complex64)

    def _in_space(self, spectrum: Spectrum) -> Single:
        return np.maximum(scipy.fft.irfft2(spectrum, s=(self.size, self.size)), 0)


def in_blocks(rays: int, points: int, columns: int, size: int) -> int:
    """Rows of the kernels (rays, size, columns) that are made together by products over so many points."""
    block = size
    while block % 2 == 0 and block * max(rays * columns / BLOCK, points * columns / MAX_WORK) > 1:
        block //= 2
    return block


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
