"""The light curves that lose least of one fur: bases found by low-rank approximation of its samples."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from furbake.pelt.texels.basis import DEGREE, Basis, smooth

Array = NDArray[np.float64]

RIDGE = 1e-3
"""Keeps the smooth functions' weights tame between lights, as a share of the curves' own energy."""

ROUNDS = 4
"""Rounds of alternating least squares: eight more gain 0.03 dB at most."""

DARK = 0.01
"""Share of the mean curves' mean square: slabs darker than that hardly count in the start of the rounds."""


def eigen(
    samples: NDArray[np.floating],
    weights: NDArray[np.floating],
    lights: Array,
    coefficients: int,
    degree: int = DEGREE,
) -> Basis:
    """Left singular vectors of the α-weighted samples, made smooth.

    samples : (n, texels), weights : (texels,), lights : (n, 3), degree : of the smooth functions
    """
    weighted = samples * np.sqrt(weights)
    curves = _strongest((weighted @ weighted.T).astype(np.float64), coefficients)
    return Basis("eigen", degree, _smoothed(curves, lights, degree))


def eigen_of_slabs(samples: NDArray[np.floating], alpha: Array, lights: Array, mean: Array, coefficients: int) -> Basis:
    """As `eigen`, of polynomials that each slab's mean curve multiplies: min Σ α·(L − m_k·ψ·c)² over ψ and c.

    samples : (n, K, N, N), alpha : (K, N, N), mean : (n, K). By alternating least squares over the texels' numbers and
    the smooth functions' weights. Texels count only by their slab's Gram matrix, so that a round costs the same for any
    number of them; nothing is divided by a mean curve.

    The first function is the constant 1, by which a slab's mean is its mean curve; without it curves that serve bright
    light best lose a tenth of the grazing light.
    """
    count, layers = samples.shape[:2]
    grams = np.empty((layers, count, count))
    for k in range(layers):
        weighted = samples[:, k].reshape(count, -1) * np.sqrt(alpha[k], dtype=samples.dtype).ravel()
        grams[k] = weighted @ weighted.T
    terms, apart = smooth(lights), np.eye(count) - 1 / count
    curves = _strongest(apart @ _evened(grams, mean) @ apart, coefficients - 1)
    basis = _with_constant(_smoothed(curves, lights))
    for _ in range(ROUNDS):
        basis = _round(basis(lights), grams, mean, terms)
    return basis


def _with_constant(matrix: Array) -> Basis:
    """Curves of these weights (C, F) after the constant 1, the first of the smooth functions."""
    return Basis("eigen", DEGREE, np.concatenate([np.eye(1, matrix.shape[1]), matrix]))


def _evened(grams: Array, mean: Array) -> Array:
    """Gram matrix of what texels are over their slab's mean curve, slabs counting by their light, (n, n)."""
    square = mean**2
    over = mean / (square + DARK * max(float(square.mean()), 1e-12)) * np.sqrt(square.mean(0))
    return np.asarray(np.einsum("nk,knm,mk->nm", over, grams, over, optimize=True))


def _round(curves: Array, grams: Array, mean: Array, terms: Array) -> Basis:
    """The constant, and the sums of smooth functions that suit best the texels' numbers in these curves, (n, C)."""
    orthonormal = np.linalg.qr(curves)[0] * np.sqrt(len(curves))
    orthonormal[:, 0] = 1
    count, width = terms.shape[1], curves.shape[1] - 1
    matrix, right = np.zeros((count, width, count, width)), np.zeros((count, width))
    for gram, light in zip(grams, mean.T, strict=True):
        inverse = np.linalg.pinv(light[:, None] * orthonormal)
        numbers = inverse @ gram
        square = numbers @ inverse.T
        matrix += np.einsum("ij,cd->icjd", (terms * light[:, None] ** 2).T @ terms, square[1:, 1:])
        right += terms.T @ (light[:, None] * (numbers[1:].T - light[:, None] * square[0, 1:]))
    energy = np.einsum("icic->c", matrix) / max(float(np.einsum("ni,ni->", terms, terms)), 1e-12)
    ridge = np.einsum("ij,cd->icjd", np.eye(count), np.diag(RIDGE * energy + 1e-12))
    size = count * width
    solved = np.linalg.solve((matrix + ridge).reshape(size, size), right.ravel()).reshape(count, width)
    return _with_constant(solved.T)


def _strongest(gram: Array, count: int) -> Array:
    """The first eigenvectors of (n, n), (n, count), of mean square 1 and mostly positive."""
    curves = np.linalg.eigh(gram)[1][:, ::-1][:, :count] * np.sqrt(len(gram))
    return np.asarray(curves * np.where(curves.sum(0) < 0, -1.0, 1.0))


def _smoothed(curves: Array, lights: Array, degree: int = DEGREE) -> Array:
    """Weights of the smooth functions, (C, F), whose sums are nearest to curves (n, C)."""
    terms = smooth(lights, degree)
    return np.asarray(np.linalg.solve(terms.T @ terms + RIDGE * np.eye(terms.shape[1]), terms.T @ curves).T, np.float64)
