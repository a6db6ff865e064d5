"""Six numbers per texel from its samples, and how good they are under lights that the fit did not see."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from furbake.pelt.texels.basis import Functions, held

Array = NDArray[np.float64]
Single = NDArray[np.float32]

VISIBLE = 0.05
"""Coverage above which a texel's samples set the scale of the figures."""


def fit(samples: NDArray[np.floating], basis: Functions, lights: Array, mean: Array | None = None) -> Array:
    """Least squares of eq. (2) for all texels at once, (n, K, N, N) → (K, N, N, C).

    The singular value decomposition of the light matrix is made once; its pseudo-inverse times all samples is the
    rest. mean : (n, K) curves by which a slab's polynomials are multiplied; then once a slab.
    """
    phi = basis(lights)
    if mean is not None:
        slabs = [_solved(samples[:, k], curve[:, None] * phi) for k, curve in enumerate(mean.T)]
        return np.stack(slabs)
    return _solved(samples, phi)


def _solved(samples: NDArray[np.floating], phi: Array) -> Array:
    """Least squares of (n, ...) in the columns of φ (n, C), (..., C)."""
    inverse = np.linalg.pinv(phi)
    count, *shape = samples.shape
    coefficients = inverse.astype(samples.dtype) @ samples.reshape(count, -1)
    return np.ascontiguousarray(np.moveaxis(coefficients.reshape(-1, *shape), 0, -1), np.float64)


def relight(coefficients: Array, basis: Functions, lights: Array, mean: Array | None = None) -> Single:
    """L of all texels, clamped at 0 as the shader does, (K, N, N, C) → (n, K, N, N) float32.

    mean : (n, K) curves by which a slab's polynomials are multiplied; then lights may be below the horizon
    """
    *shape, count = coefficients.shape
    phi = basis(lights if mean is None else held(lights)).astype(np.float32)
    light = (phi @ coefficients.reshape(-1, count).T.astype(np.float32)).reshape(len(lights), *shape)
    if mean is not None:
        light *= mean.astype(np.float32).reshape(*mean.shape, *[1] * (len(shape) - 1))
    return np.maximum(light, 0)


def decibels(error: float) -> float:
    """Mean squared error on a scale of 1 → peak signal-to-noise ratio."""
    return float(-10 * np.log10(max(error, 1e-12)))


@dataclass(frozen=True)
class Judge:
    """Figures of light curves against the held-out samples.

    truth : (n, K, N, N) samples, alpha, tint : (K, N, N). All errors are α-weighted and on samples divided by their
    99th percentile where α > `VISIBLE`; the composite is Σ_k vis_k·α_k·tint_k·L_k seen from above.
    """

    truth: Single
    alpha: Array
    tint: Array

    @property
    def peak(self) -> float:
        return float(np.percentile(self.truth[:, self.alpha > VISIBLE], 99))

    def _weights(self) -> Single:
        clear = np.cumprod((1 - self.alpha)[::-1], axis=0)[::-1]
        visible = np.concatenate([clear[1:], np.ones_like(clear[:1])])
        return (visible * self.alpha * self.tint).astype(np.float32)

    def composite(self, light: NDArray[np.floating]) -> NDArray[np.floating]:
        """The tile seen from above, (n, K, N, N) → (n, N, N)."""
        return np.asarray(np.einsum("nkrc,krc->nrc", light, self._weights()))

    def layer_errors(self, light: NDArray[np.floating]) -> Array:
        """α-weighted mean squared error per layer, (K,), and its weights' sums, stacked (2, K)."""
        square = (((light - self.truth) / self.peak) ** 2).mean(0)
        return np.stack([(square * self.alpha).sum((1, 2)), self.alpha.sum((1, 2))])

    def figures(self, light: NDArray[np.floating]) -> dict[str, float]:
        """psnr, psnr_worst_layer, psnr_composite (dB) and r2 of light curves (n, K, N, N)."""
        errors, weights = self.layer_errors(light)
        mean = (self.truth * self.alpha).sum() / (self.alpha.sum() * len(self.truth))
        variance = (((self.truth - mean) / self.peak) ** 2 * self.alpha).sum() / len(self.truth)
        return {
            "psnr": decibels(errors.sum() / weights.sum()),
            "psnr_worst_layer": decibels(float((errors / np.maximum(weights, 1e-9)).max())),
            "psnr_composite": self._composite_psnr(light),
            "r2": float(1 - errors.sum() / variance),
        }

    def between(self, light: NDArray[np.floating], other: NDArray[np.floating]) -> float:
        """α-weighted PSNR of one set of light curves against another, dB."""
        square = (((light - other) / self.peak) ** 2).mean(0)
        return decibels(float((square * self.alpha).sum() / self.alpha.sum()))

    def bound(self, rank: int) -> dict[str, float]:
        """Best possible figures of `rank` numbers per texel, if they saw the held-out lights (Eckart–Young)."""
        count = len(self.truth)
        weighted = (self.truth * np.sqrt(self.alpha).astype(np.float32)).reshape(count, -1)
        values, vectors = np.linalg.eigh((weighted @ weighted.T).astype(np.float64))
        best = vectors[:, -rank:]
        light = (best @ best.T).astype(np.float32) @ self.truth.reshape(count, -1)
        lost = np.maximum(values[:-rank], 0).sum() / count / self.peak**2 / self.alpha.sum()
        return {
            "rank": rank,
            "psnr": decibels(float(lost)),
            "psnr_composite": self._composite_psnr(light.reshape(self.truth.shape)),
        }

    def _composite_psnr(self, light: NDArray[np.floating]) -> float:
        error = (self.composite(light) - self.composite(self.truth)) / self.peak
        return decibels(float((error**2).mean()))
