from __future__ import annotations

import numpy as np
import pytest

from furbake.study.verify.figures import bins, contrast, figures, overlap, similarity


def picture(seed: int) -> np.ndarray:
    """Smooth in part, so that a smaller copy still holds something."""
    chance = np.random.default_rng(seed)
    return np.kron(chance.random((10, 12)), np.ones((5, 5))) + 0.2 * chance.random((50, 60))


def test_equal_pictures_agree_and_brighter_ones_are_as_much_brighter() -> None:
    truth, over, cosine = picture(0), np.ones((50, 60), bool), np.linspace(-1, 1, 3000).reshape(50, 60)
    same = figures(truth, truth, over, cosine, 1.0)
    assert (same["r"], same["ssim"], same["ssim_quarter"], same["brightness"]) == pytest.approx((1, 1, 1, 1))
    twice = figures(2 * truth, truth, over, cosine, 1.0)
    assert twice["r"] == pytest.approx(1)
    assert twice["ssim"] < 0.9
    assert twice["brightness"] == pytest.approx(2)
    other = figures(picture(1), truth, over, cosine, 1.0)
    assert abs(other["r"]) < 0.2
    assert other["ssim"] < 0.3


def test_similarity_is_that_of_its_definition() -> None:
    """Far from its edges a window over flat pictures has means alone: (2ab + c)/(a² + b² + c)."""
    flat = np.ones((40, 40))
    inner = np.zeros((40, 40), bool)
    inner[15:25, 15:25] = True
    expected = (2 * 0.5 * 0.8 + 1e-4) / (0.25 + 0.64 + 1e-4)
    assert similarity(0.5 * flat, 0.8 * flat, inner, 1.0) == pytest.approx(expected)


def test_fine_contrast_is_that_of_the_truth_whatever_its_noise_and_the_brightness() -> None:
    chance = np.random.default_rng(2)
    truth = 1 + 0.3 * chance.standard_normal((120, 120))
    over = np.ones((120, 120), bool)
    halves = (truth + 0.3 * chance.standard_normal(truth.shape), truth + 0.3 * chance.standard_normal(truth.shape))
    assert contrast(2 * truth, halves, over) == pytest.approx(1, abs=0.03)
    assert contrast(1 + 0.5 * (truth - 1), halves, over) == pytest.approx(0.5, abs=0.03)
    assert contrast(np.ones_like(truth), halves, over) == pytest.approx(0, abs=1e-6)


def test_bins_are_of_the_skin_that_counts() -> None:
    cosine = np.full((20, 20), 0.25)
    cosine[:10] = -0.55
    cosine[0] = np.nan
    truth = np.where(cosine > 0, 3.0, 1.0)
    over = np.ones((20, 20), bool)
    over[:, :5] = False
    low, high = bins(2 * truth, truth, over, cosine)
    assert (low["from"], low["pixels"], low["page"], low["truth"]) == (-0.6, 135, 2, 1)
    assert (high["from"], high["pixels"], high["page"], high["truth"]) == (0.2, 150, 6, 3)


def test_overlap_is_shared_over_all() -> None:
    one, two = np.zeros((4, 4)), np.zeros((4, 4))
    one[:, :3], two[:, 1:] = 1, 1
    assert overlap(one, two) == 0.5
