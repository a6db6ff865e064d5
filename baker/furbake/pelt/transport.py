"""Light through the fur: every layer sampled under many light directions (paper, section 3, "sampling each layer").

Directions are unit vectors (lu, lv, lz) towards the light in the tile's frame. The unit of L is
4π · radiance / (albedo · irradiance perpendicular to the light).
"""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import scipy.fft
from numpy.typing import NDArray

from furbake.pelt.fibre import cylinder, sine
from furbake.pelt.scatter import scatter
from furbake.pelt.volume import Volume, average_down, doubled, pool, slab_means

Array = NDArray[np.float64]
Single = NDArray[np.float32]

BODY_RADIUS = 4.0
"""β: radius of the furry body over the length of its fur. It bounds the path of light that arrives near the horizon."""

LOWEST, LOWEST_FLAT = 0.02, 0.1
"""lz of the lowest sampled light. None is below the horizon: zeros there would ruin the fit.

Light along a flat patch crosses it without end and leaves it black at once, which no polynomial follows and no body
shows: its light comes in at lz_eff ≥ 1/√(2β + 1) = 1/3. Flat patches are sampled from a little higher.
"""

STEPS_PER_TEXEL = 8

LAMP, LAMP_RAYS = np.radians(10), 3
"""Radius of the lamp as seen from the fur, radians, and the rays that stand for it."""

HIDDEN = 0.02
"""What hairs that are hidden from the eye count in the mean of their texel, to those that are seen."""

SINGLE_SHARE = 0.8
"""Share of the time that single scattering takes, for the progress."""


def hemisphere(count: int, turn: float = 0.0, lowest: float = LOWEST) -> Array:
    """`count` evenly spread directions with lz ≥ `lowest`, (count, 3): a Fibonacci spiral turned by `turn` radians."""
    i = np.arange(count) + 0.5
    z = lowest + (1 - lowest) * (1 - i / count)
    angle = np.pi * (3 - np.sqrt(5)) * i + turn
    across = np.sqrt(1 - z * z)
    return np.stack([across * np.cos(angle), across * np.sin(angle), z], -1)


def curved_elevation(lz: float, beta: float = BODY_RADIUS) -> float:
    """The lz of a flat slab whose path is as long as the path through a shell of fur around a ball of radius β."""
    return float(1 / (-beta * lz + np.sqrt(beta * beta * lz * lz + 2 * beta + 1)))


class OpticalDepth:
    """τ from every voxel's middle up to the light, by convolution.

    The tile is periodic and τ is linear in σ, so a layer's τ is a sum of convolutions of the σ above it with the
    ray's segments: exact at every angle for a volume that is bilinear within a slab and constant across it. Bilinear
    look-up is the mean over a voxel's square of a ray through constant voxels.
    """

    def __init__(self, sigma: NDArray[np.floating], slab: float, aside: Array | None = None) -> None:
        """sigma : (K, N, N) per tile width; slab : thickness of a slab, tile widths; aside : as of `Volume`."""
        self.layers, self.size, _ = sigma.shape
        self.slab = slab
        self.spectrum = scipy.fft.rfft2(np.asarray(sigma, np.float32))
        self.back = None if aside is None else _moved(-aside, self.size)
        if self.back is not None:
            self.spectrum *= self.back.conj()

    def _segment(self, shift: Array, start: float, end: float) -> Single:
        """Weights, (N, N), of the stretch of ray between heights `start` and `end` (slabs above the voxel)."""
        count = max(8, int(np.ceil(np.hypot(*shift) * (end - start) * STEPS_PER_TEXEL)))
        t = start + (end - start) * (np.arange(count) + 0.5) / count
        # Reading σ at x + shift·t is a convolution with a point at −shift·t.
        x, y = -shift[0] * t, -shift[1] * t
        column, row = np.floor(x).astype(np.int64), np.floor(y).astype(np.int64)
        fx, fy = x - column, y - row
        n = self.size
        weights = np.zeros(n * n)
        for down, wy in ((0, 1 - fy), (1, fy)):
            for right, wx in ((0, 1 - fx), (1, fx)):
                weights += np.bincount((row + down) % n * n + (column + right) % n, wx * wy, n * n)
        return (weights * ((end - start) / count)).reshape(n, n).astype(np.float32)

    def above(self, light: Array) -> Single:
        """Optical depth of all slabs above the voxel's own, (K, N, N).

        The ray passes through the middle of the voxel. lz of `light` may be the effective one of a curved body.
        """
        shift, path = self._way(light)
        segments = [self._segment(shift, m - 0.5, m + 0.5) for m in range(1, self.layers)]
        kernels = scipy.fft.rfft2(np.stack(segments)) if segments else self.spectrum[:0]
        above = np.zeros_like(self.spectrum)
        for k in range(self.layers - 1):
            above[k] = np.einsum("jyx,jyx->yx", self.spectrum[k + 1 :], kernels[: self.layers - 1 - k])
        return self._in_space(above, path)

    def own(self, light: Array) -> Single:
        """Optical depth of the voxel's own slab from its floor to its ceiling, (K, N, N), on the same ray."""
        shift, path = self._way(light)
        return self._in_space(self.spectrum * scipy.fft.rfft2(self._segment(shift, -0.5, 0.5)), path)

    def _way(self, light: Array) -> tuple[Array, float]:
        """How far the ray moves aside in a slab, voxels, and its length there, tile widths."""
        lz = max(float(light[2]), 1e-3)
        return light[:2] / lz * self.slab * self.size, self.slab / lz

    def _in_space(self, spectrum: NDArray[np.complexfloating], path: float) -> Single:
        if self.back is not None:
            spectrum = spectrum * self.back
        depth: Single = np.maximum(scipy.fft.irfft2(spectrum, s=(self.size, self.size)) * np.float32(path), 0)
        return depth


def _moved(aside: Array, size: int) -> NDArray[np.complexfloating]:
    """What moves the spectra of K slabs aside by (K, 2) tile widths, (K, size, size / 2 + 1)."""
    along = np.arange(size // 2 + 1)
    across = np.fft.fftfreq(size, 1 / size)
    turns = aside[:, 1, None, None] * across[:, None] + aside[:, 0, None, None] * along
    return np.asarray(np.exp(-2j * np.pi * turns), np.complex64)


def passing(depth: Single) -> Single:
    """Mean over a slab of what is left of light that crosses it, (1 − e^−τ)/τ."""
    thick: Single = np.maximum(depth, np.float32(1e-4))
    return np.asarray(-np.expm1(-thick) / thick, np.float32)


def lamp_cone(light: Array, turn: float) -> Array:
    """Directions over the disc of a lamp `LAMP` radians in radius, none below the horizon, (`LAMP_RAYS`, 3)."""
    across = np.cross(light, [0.0, 0.0, 1.0] if abs(light[2]) < 0.99 else [1.0, 0.0, 0.0])
    across /= np.linalg.norm(across)
    ray = np.arange(LAMP_RAYS)
    radius = np.tan(LAMP) * np.sqrt((ray + 0.5) / LAMP_RAYS)
    angle = turn + ray * np.pi * (3 - np.sqrt(5))
    spread = np.outer(np.cos(angle), across) + np.outer(np.sin(angle), np.cross(light, across))
    rays = light + radius[:, None] * spread
    rays[:, 2] = np.maximum(rays[:, 2], 0)
    return np.asarray(rays / np.linalg.norm(rays, axis=1, keepdims=True))


def sample(
    fine: Volume,
    layers: int,
    size: int,
    lights: Array,
    *,
    albedo: float = 0.85,
    skin: float = 0.25,
    flat: bool = False,
    progress: Callable[[float], None] = lambda fraction: None,
) -> Single:
    """L of every stored texel under every light, (n, layers, size, size) float32: once scattered, T·D, and the rest, M.

    `fine` is the oversampled volume; what is returned is averaged down. `albedo` and `skin` are the shares of the light
    that hairs and skin scatter on; L is in units of the former. `flat` leaves out the curve of the body and the
    size of the lamp, and makes the skin black: a patch that other renderers can check.
    """
    half = (layers, size // 2, size // 2)
    single = np.empty((len(lights), layers, size, size), np.float32)
    caught, reaching = (np.empty((len(lights), *half), np.float32) for _ in range(2))
    floor = np.empty((len(lights), *half[1:]), np.float32)
    beam = _Beam(fine, layers, size, flat)
    with ThreadPoolExecutor(os.cpu_count()) as workers:
        for i, fields in enumerate(workers.map(beam, lights, range(len(lights)))):
            single[i], caught[i], reaching[i], floor[i] = fields
            progress((i + 1) / len(lights) * SINGLE_SHARE)
    tangent = np.stack([beam.stored(beam.sigma * beam.tangent[..., axis]) for axis in range(3)], -1)
    tangent[..., 2] += 1e-9  # upright where there is no hair
    tangent /= np.linalg.norm(tangent, axis=-1, keepdims=True)
    slab, sigma = fine.height / layers, beam.stored(beam.sigma)
    aside = None if fine.aside is None else slab_means(fine.aside, layers)
    multiple = scatter(
        sigma, slab, tangent, lights, caught, reaching, floor,
        albedo=albedo, skin=0.0 if flat else skin, aside=aside,
    )  # fmt: skip
    progress(1.0)
    return single + doubled(multiple)


class _Beam:
    """One light through the oversampled volume, before anything is scattered twice."""

    def __init__(self, fine: Volume, layers: int, size: int, flat: bool) -> None:
        self.flat, self.layers, self.size, self.half, self.slab = flat, layers, size, size // 2, fine.slab
        self.aside = fine.aside
        coverage = fine.coverage.astype(np.float32)
        clear = np.cumprod(1 - coverage[::-1], axis=0, dtype=np.float32)[::-1]
        above = np.concatenate([clear[1:], np.ones_like(clear[:1])])
        # Of a texel's hairs those count most that the eye sees through all that lies above.
        shares = (coverage * (above + HIDDEN)).astype(np.float32)
        self.shares = shares.reshape(layers, -1, *coverage.shape[1:])
        self.sigma = fine.sigma.astype(np.float32)
        self.tangent = fine.tangent.astype(np.float32)
        self.hair: Single = np.maximum(self.stored(self.sigma), np.float32(1e-6))

    def __call__(self, light: Array, number: int) -> tuple[Single, Single, Single, Single]:
        """T·D averaged down, (K, N, N); T·sin θ and T on average over the hairs, (K, N/2, N/2); the skin's irradiance.

        T is taken at the ceiling of a voxel's slab: how a hair shades itself is in D. A hair that the light runs along
        catches less of it and shades less: its σ counts times the sine between the two. D and that sine are those of
        the lamp's middle, and so is the path through the voxel's own slab; its rays are averaged in what they pass
        through above.
        """
        width = sine(self.tangent, light)
        depth = OpticalDepth(self.sigma * width, self.slab, self.aside)
        rays = light[None] if self.flat else lamp_cone(light, float(number))
        passed = np.zeros_like(self.sigma)
        skin = np.zeros_like(self.sigma[0])
        own = depth.own(self.way_in(light))
        for ray in rays:
            clear = np.exp(-depth.above(self.way_in(ray)))
            passed += clear
            skin += clear[0] * np.exp(-own[0]) * np.float32(ray[2])
        hairs = passed * passing(own)
        share = np.float32(1 / len(rays))
        single = average_down(passed * share * cylinder(self.tangent, light), self.shares, self.size)
        lit = hairs * (share * self.sigma)
        return single, self.stored(lit * width) / self.hair, self.stored(lit) / self.hair, pool(skin * share, self.half)

    def way_in(self, light: Array) -> Array:
        """The direction in which light crosses the slabs."""
        return light if self.flat else np.array([light[0], light[1], curved_elevation(float(light[2]))])

    def stored(self, fine: Single) -> Single:
        """Means over blocks of fine voxels, to stored slabs at half the stored resolution."""
        mean: Single = pool(fine.reshape(self.layers, -1, *fine.shape[1:]).mean(1), self.half)
        return mean
