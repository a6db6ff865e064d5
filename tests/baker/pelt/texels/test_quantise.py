from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from furbake.pelt.light.transport import hemisphere
from furbake.pelt.texels.basis import ptm
from furbake.pelt.texels.quantise import (
    byte_range,
    dequantise,
    from_signed_bytes,
    quantise,
    signed_bytes,
    srgb_bytes,
    step_of,
    steps,
    unit_bytes,
)

PHI = ptm(hemisphere(64))
GRAM = PHI.T @ PHI / len(PHI)


@given(st.integers(0, 2**32 - 1), st.floats(-5, 5), st.floats(1e-3, 100))
def test_round_trip_of_plain_rounding_stays_within_half_a_step(seed: int, shift: float, size: float) -> None:
    coefficients = shift + size * np.random.default_rng(seed).random((1, 4, 4, 6))
    scale, bias = byte_range(coefficients, np.ones((1, 4, 4)))
    low, high = dequantise(np.uint8([0] * 6), scale, bias), dequantise(np.uint8([255] * 6), scale, bias)
    inside = np.clip(coefficients, low, high)
    back = dequantise(quantise(inside, scale, bias, np.eye(6)), scale, bias)
    assert (np.abs(back - inside) <= scale / 2 * (1 + 1e-9)).all()


def test_feedback_hurts_the_light_less_than_plain_rounding() -> None:
    coefficients = np.random.default_rng(0).normal(size=(1, 64, 64, 6))
    scale, bias = byte_range(coefficients, np.ones((1, 64, 64)))

    def error(gram: np.ndarray) -> float:
        lost = dequantise(quantise(coefficients, scale, bias, gram), scale, bias) - coefficients
        return float(((lost @ PHI.T) ** 2).mean())

    assert error(GRAM) < 0.85 * error(np.diag(np.diag(GRAM)))


def test_bytes_and_decoder_agree_on_the_ends() -> None:
    coefficients = np.linspace(-3, 5, 256).reshape(1, 16, 16, 1)
    scale, bias = byte_range(coefficients, np.ones((1, 16, 16)))
    codes = quantise(coefficients, scale, bias, np.eye(1))
    assert codes.min() == 0
    assert codes.max() == 255
    assert dequantise(np.uint8([0]), scale, bias) == pytest.approx(-3, abs=0.01)


def test_constant_coefficient_survives() -> None:
    coefficients = np.full((1, 4, 4, 6), 0.25)
    scale, bias = byte_range(coefficients, np.ones((1, 4, 4)))
    np.testing.assert_allclose(dequantise(quantise(coefficients, scale, bias, GRAM), scale, bias), 0.25, atol=1e-6)


def test_unit_and_srgb_bytes() -> None:
    np.testing.assert_array_equal(unit_bytes(np.array([-1, 0, 0.5, 1, 2])), [0, 0, 128, 255, 255])
    np.testing.assert_array_equal(srgb_bytes(np.array([0, 0.0031308, 0.2140411, 1])), [0, 10, 127, 255])


def test_signed_bytes_come_back_within_half_a_step() -> None:
    values = np.linspace(-1, 1, 4001)
    assert np.abs(from_signed_bytes(signed_bytes(values)) - values).max() <= 0.5 / 127.5 + 1e-12
    np.testing.assert_array_equal(signed_bytes(np.array([-2, -1, 1, 2])), [0, 0, 255, 255])


@pytest.mark.parametrize(("bits", "step"), [(8, 1), (6, 4), (4, 16)])
def test_fewer_bits_are_multiples_of_a_step_within_a_byte(bits: int, step: int) -> None:
    assert step_of(bits) == step
    coefficients = np.random.default_rng(1).normal(size=(1, 32, 32, 6))
    scale, bias = byte_range(coefficients, np.ones((1, 32, 32)), 256 - step)
    codes = quantise(coefficients, scale, bias, np.eye(6), 256 - step, step)
    assert codes.dtype == np.uint8
    assert 0.6 * 2**bits < len(np.unique(codes)) <= 2**bits
    assert not (codes % step).any()
    low, high = (dequantise(np.uint8([code] * 6), scale, bias) for code in (0, 256 - step))
    lost = dequantise(codes, scale, bias) - np.clip(coefficients, low, high)
    assert (np.abs(lost) <= step * scale / 2 * (1 + 1e-9)).all()
    tint = unit_bytes(np.linspace(0, 1, 999), step)
    assert tint.max() == 255
    assert not (tint[tint < 255] % step).any()


def test_empty_texels_have_fewer_codes() -> None:
    coefficients, alpha = np.random.default_rng(2).normal(size=(2, 16, 16, 6)), np.zeros((2, 16, 16))
    alpha[:, ::2] = 0.5
    alpha[:, 1] = 0.4 / 255
    np.testing.assert_array_equal(steps(alpha, 1), np.ones(alpha.shape))
    np.testing.assert_array_equal(steps(alpha, 32), np.full(alpha.shape, 32))
    scale, bias = byte_range(coefficients, alpha, 252)
    each = np.repeat(np.eye(6)[None], 2, axis=0)
    codes = quantise(coefficients, scale, bias, each, 240, steps(alpha, 4))
    assert not (codes[:, 1::2] % 8).any()
    assert not (codes % 4).any()
    assert (codes[:, ::2] % 8).any()
    full = quantise(coefficients, scale, bias, each, 240, 4)
    np.testing.assert_array_equal(codes[:, ::2], full[:, ::2])
