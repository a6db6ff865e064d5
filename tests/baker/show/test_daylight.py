"""Light and tone mapping of swatches are those of the page."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest

from furbake.daylight import PAGE, PALING, SHOULDER, tone_mapped

WEB = Path(__file__).parents[3] / "web"
RNG = np.random.default_rng(4)


def test_tone_mapping_keeps_colours_up_to_its_shoulder_and_hues_beyond() -> None:
    below = RNG.uniform(0, 0.6, (50, 3))
    np.testing.assert_array_equal(tone_mapped(below), below)
    ramp = tone_mapped(np.linspace(0, 20, 2000)[:, None].repeat(3, 1))[:, 0]
    assert (np.diff(ramp) > 0).all()
    assert ramp[-1] < 1
    np.testing.assert_allclose(np.diff(ramp)[58:61], 20 / 1999, rtol=0.05)  # no kink at the shoulder
    # Hue: the middle channel's place between the others; saturation falls slowly.
    bright = np.array([2.0, 1.0, 0.25])
    shown = tone_mapped(bright[None])[0]
    assert (shown[1] - shown[2]) / (shown[0] - shown[2]) == pytest.approx((1 - 0.25) / (2 - 0.25))
    assert 0.95 * (1 - 0.25 / 2) < 1 - shown[2] / shown[0] < 1 - 0.25 / 2


def test_light_and_tone_mapping_are_the_pages() -> None:
    daylight, curve = ((WEB / "page" / name).read_text() for name in ("daylight.ts", "toneMapping.ts"))
    power = float(found(r"KEY_POWER = ([\d.]+) \* Math.PI", daylight))
    lamp, sky, ground = (
        np.array([float(part) for part in found(pattern, daylight).split(", ")])
        for pattern in (r"KEY_COLOUR.*?Color\(([^)]*)", r"new Color\(([^)]*)\), new", r"\), new Color\(([^)]*)")
    )
    assert found(r"KEY_POWER / (\d)\)", daylight) == "4"
    np.testing.assert_allclose(PAGE.lamp, math.pi * power * lamp)
    np.testing.assert_allclose(PAGE.sky, math.pi * power / 4 * sky)
    np.testing.assert_allclose(PAGE.ground, math.pi * power / 4 * ground)
    assert float(found(r"SHOULDER = ([\d.]+)", curve)) == SHOULDER
    assert float(found(r"PALING = ([\d.]+)", curve)) == PALING


def found(pattern: str, text: str) -> str:
    match = re.search(pattern, text)
    assert match, pattern
    return match[1]
