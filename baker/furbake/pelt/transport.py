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

from furbake.pelt.volume import Volume, average_down, seen_from_above

Array = NDArray[np.float64]
Single = NDArray[np.float32]

BODY_RADIUS = 4.0
"""β: radius of the furry body over the length of its fur. It bounds the path of light that arrives near the horizon."""

LOWEST = 0.02
"""lz of the lowest sampled light. None is below the horizon: zeros there would ruin the fit."""

STEPS_PER_TEXEL = 8


def hemisphere(count: int, turn: float = 0.0) -> Array:
    """`count` evenly spread directions with lz ≥ `LOWEST`, (count, 3): a Fibonacci spiral turned by `turn` radians."""
    i = np.arange(count) + 0.5
    z = LOWEST + (1 - LOWEST) * (1 - i / count)
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

    def __init__(self, sigma: NDArray[np.floating], slab: float) -> None:
        """sigma : (K, N, N) per tile width; slab : thickness of a slab, tile widths."""
        self.layers, self.size, _ = sigma.shape
        self.slab = slab
        self.spectrum = scipy.fft.rfft2(np.asarray(sigma, np.float32))

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

    def __call__(self, light: Array) -> tuple[Single, Single]:
        """Optical depth of all slabs above, and of the voxel's own slab from its floor to its ceiling, each (K, N, N).

        The ray passes through the middle of the voxel. lz of `light` may be the effective one of a curved body.
        """
        lz = max(float(light[2]), 1e-3)
        shift = light[:2] / lz * self.slab * self.size
        path = self.slab / lz
        segments = [self._segment(shift, m - 0.5, m + 0.5) for m in range(self.layers)]
        kernels = scipy.fft.rfft2(np.stack(segments))
        above = np.zeros_like(self.spectrum)
        for k in range(self.layers - 1):
            above[k] = np.einsum("jyx,jyx->yx", self.spectrum[k + 1 :], kernels[1 : self.layers - k])
        shape = (self.size, self.size)
        own = scipy.fft.irfft2(self.spectrum * kernels[0], s=shape) * path
        return np.maximum(scipy.fft.irfft2(above, s=shape) * path, 0), np.maximum(own, 0)


def within_slab(tau_view: NDArray[np.floating], tau_light: NDArray[np.floating]) -> NDArray[np.floating]:
    """g: mean over a slab of the light's path times the eye's: [τv/(τv+τl)]·[1−e^−(τv+τl)]/[1−e^−τv]."""
    both = tau_view + tau_light
    clear = tau_view < 1e-4
    exact = tau_view * -np.expm1(-both) / np.where(clear, 1, both * -np.expm1(-tau_view))
    thin = -np.expm1(-tau_light) / np.maximum(tau_light, 1e-6)
    return np.where(clear, np.where(tau_light < 1e-6, 1, thin), exact)


def cylinder(tangent: NDArray[np.floating], light: Array) -> NDArray[np.floating]:
    """D: a Lambertian cylinder of direction `tangent` (..., 3), lit from `light`, seen from straight above.

    sinθ·[sin φ + (π − φ)·cos φ], θ between light and fibre, φ between light and eye around the fibre. Where the fibre
    points at the eye φ has no meaning and its mean, (4/π)·sinθ, holds.
    """
    up = tangent[..., 2]
    along = tangent @ light.astype(tangent.dtype)
    sin_light = np.sqrt(np.maximum(1 - along * along, 0))
    sin_view = np.sqrt(np.maximum(1 - up * up, 0))
    cos_phi = np.clip((float(light[2]) - along * up) / np.maximum(sin_light * sin_view, 1e-4), -1, 1)
    phi = np.arccos(cos_phi)
    seen = np.sin(phi) + (np.pi - phi) * cos_phi
    sure = sin_view**2 / (sin_view**2 + 0.15**2)
    return np.asarray(sin_light * (sure * seen + (1 - sure) * (4 / np.pi)))


def sample(
    fine: Volume, lights: Array, *, flat: bool = False, progress: Callable[[float], None] = lambda fraction: None
) -> Single:
    """L of every stored texel under every light, (n, K, N, N) float32.

    `fine` is the oversampled volume; what is returned is averaged down. T·g·D: transmittance of what lies above, times
    the mean within the slab, times the hair's own scattering. `flat` leaves out the curve of the body.
    """
    depth = OpticalDepth(fine.sigma, fine.slab)
    coverage = fine.coverage.astype(np.float32)
    shares = seen_from_above(coverage)
    tau_view = (fine.sigma * fine.slab).astype(np.float32)
    tangent = fine.tangent.astype(np.float32)

    def one(light: Array) -> Single:
        elevation = float(light[2]) if flat else curved_elevation(float(light[2]))
        above, own = depth(np.array([light[0], light[1], elevation]))
        reaching = np.exp(-above) * within_slab(tau_view, own)
        return average_down(reaching * cylinder(tangent, light), shares).astype(np.float32)

    samples = []
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for done, image in enumerate(pool.map(one, lights), 1):
            samples.append(image)
            progress(done / len(lights))
    return np.stack(samples)
