from __future__ import annotations

import numpy as np
import pytest

from furbake.pelt.light.transport import hemisphere
from furbake.pelt.texels.basis import PTM
from furbake.pelt.texels.fit import Judge, decibels, fit, relight

RNG = np.random.default_rng(1)


def judge(lights: int = 40) -> Judge:
    truth = RNG.uniform(0, 3, (lights, 3, 8, 8)).astype(np.float32)
    return Judge(truth, RNG.uniform(0.1, 0.9, (3, 8, 8)), RNG.uniform(0.5, 1, (3, 8, 8)))


def test_relight_never_goes_below_zero() -> None:
    coefficients = RNG.normal(size=(2, 4, 4, 6))
    light = relight(coefficients, PTM, hemisphere(20))
    assert light.min() == 0.0
    assert light.shape == (20, 2, 4, 4)


def test_perfect_light_curves_have_no_error() -> None:
    about = judge()
    figures = about.figures(about.truth)
    assert figures["r2"] == pytest.approx(1)
    assert figures["psnr"] == figures["psnr_composite"] == decibels(0)


def test_psnr_is_on_samples_over_their_99th_percentile() -> None:
    about = judge()
    off = about.truth + np.float32(0.1 * about.peak)
    assert about.figures(off)["psnr"] == pytest.approx(20, abs=1e-3)
    assert about.between(off, about.truth) == pytest.approx(20, abs=1e-3)


def test_mean_light_has_r2_of_zero() -> None:
    about = judge()
    mean = (about.truth * about.alpha).sum() / (about.alpha.sum() * len(about.truth))
    assert about.figures(np.full_like(about.truth, mean))["r2"] == pytest.approx(0, abs=1e-5)


def test_composite_is_seen_from_above() -> None:
    alpha, tint = np.array([1.0, 0.5, 0.25]).reshape(3, 1, 1), np.array([1.0, 0.5, 1.0]).reshape(3, 1, 1)
    truth = np.array([8.0, 4.0, 2.0], np.float32).reshape(1, 3, 1, 1)
    seen = Judge(truth, alpha, tint).composite(truth)
    assert seen == pytest.approx(0.25 * 2 + 0.75 * 0.5 * 0.5 * 4 + 0.75 * 0.5 * 8)


def test_bound_is_eckart_youngs_and_no_fit_beats_it() -> None:
    about = judge()
    lights = hemisphere(40)
    fitted = relight(fit(about.truth, PTM, lights), PTM, lights)
    weighted = (about.truth / about.peak * np.sqrt(about.alpha)).reshape(40, -1)
    lost = (np.linalg.svd(weighted, compute_uv=False)[6:] ** 2).sum() / 40 / about.alpha.sum()
    assert about.bound(6)["psnr"] == pytest.approx(decibels(lost), abs=1e-3)
    assert about.figures(fitted)["psnr"] <= about.bound(6)["psnr"]
    assert about.bound(40)["psnr_composite"] > 80
