from __future__ import annotations

import numpy as np

from furbake.pelt.texels.fill import SOLID, fill, fill_directions

RNG = np.random.default_rng(0)


def test_covered_texels_keep_their_values() -> None:
    values, alpha = RNG.normal(size=(2, 16, 16, 3)), RNG.random((2, 16, 16))
    filled = fill(values, alpha)
    np.testing.assert_array_equal(filled[alpha >= SOLID], values[alpha >= SOLID])


def test_empty_texels_stay_between_their_neighbours() -> None:
    alpha = np.where(RNG.random((1, 32, 32)) < 0.1, 1.0, 0.0)
    values = np.where(alpha[..., None] > 0, RNG.uniform(2, 3, (1, 32, 32, 1)), 1000.0)
    filled = fill(values, alpha)
    assert filled.min() >= 2 - 1e-3
    assert filled[alpha == 0].max() <= 3 + 0.5


def test_nearest_hair_wins() -> None:
    alpha = np.zeros((1, 32, 32))
    values = np.zeros((1, 32, 32, 1))
    alpha[0, 8, 8] = alpha[0, 24, 24] = 1
    values[0, 8, 8], values[0, 24, 24] = 1, 2
    filled = fill(values, alpha)
    assert abs(filled[0, 9, 9, 0] - 1) < 0.4
    assert abs(filled[0, 23, 24, 0] - 2) < 0.4


def test_an_empty_layer_stays_finite() -> None:
    assert np.isfinite(fill(np.ones((1, 8, 8, 2)), np.zeros((1, 8, 8)))).all()


def test_directions_stay_unit_and_empty_texels_lean_as_their_neighbours_do() -> None:
    alpha = np.where(RNG.random((2, 32, 32)) < 0.1, 1.0, 0.0)
    leaning = np.array([[0.6, 0.0, 0.8], [0.0, -0.28, 0.96]])[:, None, None]
    tangent = np.where(alpha[..., None] > 0, leaning, [0.0, 0.0, 1.0])
    filled = fill_directions(tangent, alpha)
    np.testing.assert_allclose(np.linalg.norm(filled, axis=-1), 1)
    np.testing.assert_allclose(filled, np.broadcast_to(leaning, filled.shape), atol=0.02)
