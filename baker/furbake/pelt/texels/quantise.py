"""Coefficients to bytes and back: a' = round(a/λ + Ω), a = λ(a' − Ω)   (paper, eq. 3, with rounding)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Bytes = NDArray[np.uint8]
Codes = NDArray[Any]
"""Bytes, or words where more than 8 bits are asked for."""
Step = int | NDArray[np.int64]

TAIL = 0.02
"""Percentile of the visible texels that may saturate at either end of a coefficient's range."""

RIDGE, MIN_RIDGE = 1e-9, 1e-12
"""Added to the diagonal of a slab's Gram matrix, the first as a share of its trace."""


FULL = 8
"""Bits of a byte."""

EMPTY_STEP = 8
"""Distance of the codes of empty texels, where those of others are rounded. Half-way to a full texel, where filtering
mixes in most of their error, it is half of the full texel's at 6 bits.
"""


def step_of(bits: int) -> int:
    """Distance of the codes of numbers of `bits` bits, 1 to 8, that are stored as bytes."""
    return 1 << (FULL - bits)


def steps(coverage: Array, step: int) -> NDArray[np.int64]:
    """Distance of the codes of each texel, of the shape of `coverage`: `step` where its byte is not 0."""
    return np.where((unit_bytes(coverage) > 0) | (step == 1), step, max(step, EMPTY_STEP))


def byte_range(coefficients: Array, alpha: Array, top: int = 255) -> tuple[Array, Array]:
    """λ and Ω per coefficient, (C,) each, so that the bytes span the coefficients of the visible texels.

    coefficients : (K, N, N, C), alpha : (K, N, N), top : the greatest code.
    """
    visible = coefficients[alpha > 0.05] if (alpha > 0.05).any() else coefficients.reshape(-1, coefficients.shape[-1])
    low, high = np.percentile(visible, [TAIL, 100 - TAIL], axis=0)
    scale = np.maximum(high - low, 1e-6) / top
    return scale, -low / scale


def gram(phi: Array, mean: Array | None = None) -> Array:
    """Mean of φφᵀ over the lights, (n, C) → (C, C); with mean curves (n, K) of m²·φφᵀ for each slab, (K, C, C)."""
    if mean is None:
        return np.asarray(phi.T @ phi / len(phi))
    slabs = np.einsum("nk,nc,nd->kcd", mean**2, phi, phi, optimize=True) / len(phi)
    # In slabs that no light reaches any rounding is as good as another.
    power = np.einsum("kcc->k", slabs)
    return np.asarray(slabs + (RIDGE * power + MIN_RIDGE)[:, None, None] * np.eye(phi.shape[1]))


def quantise(coefficients: Array, scale: Array, bias: Array, gram: Array, top: int = 255, step: Step = 1) -> Codes:
    """Bytes of the coefficients, (..., C) → (..., C), with rounding errors that make up for each other.

    gram : (C, C) of `gram`, or (K, C, C) for coefficients (K, ..., C); top : the greatest code
    step : of which all codes are multiples, or those of each texel, (...)

    Coefficients are rounded one after the other, the last first; each takes up what the rounding of those before it did
    to the light (Babai's nearest plane), which the decoder need not know.
    """
    if gram.ndim > 2:
        slabs = zip(coefficients, gram, np.broadcast_to(step, coefficients.shape[:-1]), strict=True)
        return np.stack([quantise(slab, scale, bias, own, top, its) for slab, own, its in slabs])
    count = coefficients.shape[-1]
    upper = np.linalg.cholesky(gram * np.outer(scale, scale)).T
    wanted = coefficients / scale + bias
    codes: Codes = np.empty(coefficients.shape, np.uint8 if top < 256 else np.uint16)
    carried = np.zeros_like(wanted)
    for i in reversed(range(count)):
        target = wanted[..., i] + (carried[..., i + 1 :] @ upper[i, i + 1 :]) / upper[i, i]
        codes[..., i] = np.clip(step * np.round(target / step), 0, top)
        carried[..., i] = wanted[..., i] - codes[..., i]
    return codes


def dequantise(codes: Codes, scale: Array, bias: Array) -> Array:
    """(..., C) bytes → coefficients."""
    return scale * (codes - bias)


def unit_bytes(values: Array, step: Step = 1) -> Bytes:
    """0..1 → 0..255, rounded to multiples of `step`; what would be above is 255."""
    return np.minimum(step * np.round(np.clip(values, 0, 1) * (255 / step)), 255).astype(np.uint8)


def signed_bytes(vectors: Array) -> Bytes:
    """Components -1..1 → 0..255, rounded: 127.5 + 127.5·t."""
    return np.round(127.5 + 127.5 * np.clip(vectors, -1, 1)).astype(np.uint8)


def from_signed_bytes(codes: Bytes) -> Array:
    """The reverse of `signed_bytes`, within half a step of 1/127.5."""
    return codes / 127.5 - 1


def srgb_bytes(linear: Array) -> Bytes:
    """Linear 0..1 → sRGB bytes (IEC 61966-2-1)."""
    linear = np.clip(linear, 0, 1)
    return unit_bytes(np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055))
