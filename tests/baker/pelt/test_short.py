"""The law of light on shorter hairs: its numbers, what they mend, and which bakes have them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from furbake.asset.read import read_asset
from furbake.asset.stored import read_pelt
from furbake.options import BakeOptions, preset
from furbake.pelt.hairs.strands import grow
from furbake.pelt.light.transport import hemisphere
from furbake.pelt.short import SHORTEST, fit_short, growth, pressed_light
from furbake.pipeline import bake

SMALL = preset("teddy")
HAIRS = grow(SMALL.coat, SMALL.height_share, SMALL.seed), SMALL.coat, SMALL.height_share, 8, 32
HEIGHTS = (np.arange(8) + 0.5) / 8


def test_growth() -> None:
    numbers = np.array([0.5, -0.4, 0.2])
    np.testing.assert_array_equal(growth(1.0, HEIGHTS, numbers), 1.0)
    np.testing.assert_array_equal(growth(1.7, HEIGHTS, numbers), 1.0)
    np.testing.assert_allclose(growth(np.exp(-1), np.array([0.0, 0.5, 1.0]), numbers), [1.5, 1.35, 1.3])
    np.testing.assert_array_equal(growth(0.01, HEIGHTS, numbers), growth(SHORTEST, HEIGHTS, numbers))


def test_numbers_bring_light_to_that_of_pressed_hairs() -> None:
    """Lengths and lights that no fit has seen, as seen from above; twice the same numbers."""
    numbers, lights = fit_short(*HAIRS), hemisphere(9, turn=0.5)
    whole, seen = pressed_light(*HAIRS, 1.0, lights)
    for share in (0.6, 0.25):
        pressed = pressed_light(*HAIRS, share, lights)[0] @ seen
        before, after = (
            float(np.sqrt(np.mean(np.log(told @ seen / pressed) ** 2)))
            for told in (whole, whole * growth(share, HEIGHTS, numbers))
        )
        assert before > 0.05
        assert after < max(0.5 * before, 0.05)
    np.testing.assert_array_equal(fit_short(*HAIRS), numbers)


def test_fur_without_hairs_has_none() -> None:
    strands, *others = HAIRS
    bare = replace(strands, radius=0 * strands.radius)
    np.testing.assert_array_equal(fit_short(bare, *others), 0.0)


@pytest.mark.parametrize(("changed", "there"), [({}, True), ({"curves": "none"}, False), ({"flat": True}, False)])
def test_a_bake_stores_them(tmp_path: Path, tiny: BakeOptions, changed: dict[str, object], there: bool) -> None:
    bake("plane", tmp_path / "fur", replace(tiny, **changed))  # type: ignore[arg-type]
    asset = read_asset(tmp_path / "fur")
    stored = read_pelt(asset).short
    assert (stored is not None) == ("short" in asset.fur) == there
    if stored is not None:
        assert stored.shape == (3,)
        np.testing.assert_allclose(stored, asset.fur["short"])
