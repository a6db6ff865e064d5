from __future__ import annotations

import numpy as np
import pytest

from furbake.pelt.light.transport import hemisphere
from furbake.pelt.texels.basis import PTM, Basis, environment, harmonics, ptm, smooth, smooth_terms
from furbake.pelt.texels.eigen import eigen
from furbake.pelt.texels.fit import fit

RNG = np.random.default_rng(7)


def test_known_coefficients_come_back() -> None:
    coefficients = RNG.normal(size=(4, 8, 8, 6))
    lights = hemisphere(64)
    samples = np.einsum("nc,krsc->nkrs", ptm(lights), coefficients)
    np.testing.assert_allclose(fit(samples, PTM, lights), coefficients, atol=1e-6)


def test_factors_two_of_eq_1_do_not_give_them_back() -> None:
    coefficients = RNG.normal(size=(4, 8, 8, 6))
    lights = hemisphere(64)
    eq_1 = ptm(lights) * [1, 1, 2, 2, 2, 1]
    samples = np.einsum("nc,krsc->nkrs", eq_1, coefficients)
    assert np.abs(fit(samples, PTM, lights) - coefficients).max() > 0.1


def test_smooth_functions_are_in_the_formats_order() -> None:
    u, v, z = 0.3, -0.5, np.sqrt(1 - 0.09 - 0.25)
    row = smooth(np.array([[u, v, z]]), 4)[0]
    assert len(row) == smooth_terms(4) == 27
    assert smooth(np.array([[0.6, 0, 0.8]]), 6).shape == (1, smooth_terms(6)) == (1, 51)
    np.testing.assert_allclose(row[:7], [1, v, v**2, v**3, v**4, u, u * v])
    np.testing.assert_allclose(row[15:18], [z, v * z, v**2 * z])
    np.testing.assert_allclose(row[25:], [z**0.5, z**0.25])


def test_eigen_finds_curves_that_are_in_the_samples() -> None:
    lights = hemisphere(96)
    curves = smooth(lights)[:, [0, 5, 15]] @ RNG.normal(size=(3, 3))
    samples = curves @ RNG.normal(size=(3, 500))
    basis = eigen(samples, RNG.uniform(0.1, 1, 500), lights, 3)
    others = hemisphere(50, turn=0.5)
    expected = smooth(others)[:, [0, 5, 15]]
    projected = basis(others) @ np.linalg.pinv(basis(others)) @ expected
    np.testing.assert_allclose(projected, expected, atol=5e-3)


def test_harmonics_are_orthonormal() -> None:
    sphere = RNG.normal(size=(400_000, 3))
    y = harmonics(sphere / np.linalg.norm(sphere, axis=1, keepdims=True))
    np.testing.assert_allclose(y.T @ y / len(y) * 4 * np.pi, np.eye(9), atol=0.03)


def test_environment_of_ptm_has_its_closed_form() -> None:
    """R = c + b·ω + ωᵀQω against the integrals written out in terms of c, b and Q."""
    c, b = 0.7, RNG.normal(size=3)
    q = RNG.normal(size=(3, 3))
    q = (q + q.T) / 2
    trace = np.trace(q)
    sphere = RNG.normal(size=(200, 3))
    sphere /= np.linalg.norm(sphere, axis=1, keepdims=True)
    radiance = c + sphere @ b + np.einsum("ni,ij,nj->n", sphere, q, sphere)
    coefficients = np.linalg.lstsq(harmonics(sphere), radiance, rcond=None)[0]
    pi = np.pi
    expected = [
        2 / 3 * pi * c + pi / 4 * b[2] + 2 * pi / 5 * q[0, 0] + 2 * pi / 15 * (q[1, 1] + q[2, 2]),
        2 / 3 * pi * c + pi / 4 * b[2] + 2 * pi / 5 * q[1, 1] + 2 * pi / 15 * (q[0, 0] + q[2, 2]),
        4 * pi / 15 * q[0, 1],
        2 * pi / 3 * b[0] + pi / 2 * q[0, 2],
        2 * pi / 3 * b[1] + pi / 2 * q[1, 2],
        2 * pi * c + pi * b[2] + 2 * pi / 3 * trace,
    ]
    np.testing.assert_allclose(environment(PTM) @ coefficients, expected, atol=1e-9)


@pytest.mark.parametrize("degree", [4, 6])
def test_environment_of_any_basis_equals_a_dense_sum(degree: int) -> None:
    basis = Basis("eigen", degree, RNG.normal(size=(5, smooth_terms(degree))))
    z = (np.arange(20000) + 0.5) / 20000
    azimuth = (np.arange(16) + 0.5) / 16 * 2 * np.pi
    across = np.sqrt(1 - z * z)[:, None]
    directions = np.stack(
        [across * np.cos(azimuth), across * np.sin(azimuth), np.broadcast_to(z[:, None], (20000, 16))], -1
    ).reshape(-1, 3)
    dense = basis(directions).T @ harmonics(directions) * 2 * np.pi / len(directions)
    assert np.abs(environment(basis) - dense).max() < 1e-4
