from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from furbake import BakeOptions
from furbake.asset.read import read_asset
from furbake.asset.stored import read_pelt
from furbake.pipeline import bake
from furbake.study.verify import field
from furbake.study.verify.pathtrace import Tracer, VerifyError, write_tiles
from helpers.hairs import hair


@pytest.fixture
def flat(tmp_path: Path, tiny: BakeOptions) -> Path:
    bake("plane", tmp_path / "a", replace(tiny, flat=True))
    return tmp_path / "a"


def test_twelve_eyes_and_five_lights_stand_where_they_say() -> None:
    eyes, lights = field.towards(field.EYES), field.towards(field.LIGHTS)
    np.testing.assert_allclose(np.degrees(np.arcsin(eyes[:, 2])), [90] + [60] * 3 + [40] * 4 + [20] * 4)
    np.testing.assert_allclose(np.degrees(np.arcsin(lights[:, 2])), [75, 40, 40, 15, 15])
    np.testing.assert_allclose(eyes[-3], [0, np.cos(np.radians(20)), np.sin(np.radians(20))], atol=1e-12)


def test_from_above_shells_show_the_composite(flat: Path) -> None:
    """Straight above there is no law of light and eye, but the surge of a lamp beside the eye."""
    pelt = read_pelt(read_asset(flat))
    above, lamps = np.array([[0.0, 0.0, 1.0]]), field.towards(field.LIGHTS)
    alpha = pelt.alpha / 255
    over = np.cumprod(np.concatenate([np.ones_like(alpha[:1]), 1 - alpha[:0:-1]]), 0)[::-1]
    light = (pelt.light(lamps) * alpha * over).sum(1).mean((1, 2))
    seen = field.shown(replace(pelt, surge=None), above, lamps)[0]
    np.testing.assert_allclose(seen, light, rtol=0.1)


def test_the_law_of_light_and_eye_counts(flat: Path) -> None:
    pelt = read_pelt(read_asset(flat))
    eyes, lamps = field.towards(field.EYES), field.towards(field.LIGHTS)
    with_law, without = (field.shown(each, eyes, lamps) for each in (pelt, replace(pelt, eye=None, surge=None)))
    assert np.abs(with_law / without - 1).max() > 0.2


def test_figures_say_how_far_each_pair_is_off() -> None:
    traced = np.ones((12, 5))
    page = traced.copy()
    page[3, 2] = 1.6
    found = field.figures(page, traced)
    assert found["off"] == pytest.approx({"mean": 0.01, "worst": 0.6})
    assert not found["met"]
    assert field.figures(traced, traced)["met"]
    text = field.lines(found | {"spp": 1})
    assert text[5].split() == ["60°", "250°", "1.00", "1.00", "1.60", "1.00", "1.00"]
    assert text[-1].startswith("off by 1.0 % (15) on the mean, 60.0 % (30) at worst")


def test_no_paths_are_refused(flat: Path) -> None:
    with pytest.raises(VerifyError, match="at least 1"):
        field.verify_field(flat, spp=0)


@pytest.mark.usefixtures("mitsuba")
class TestWithMitsuba:
    """Proofs that need the path tracer."""

    def test_an_eye_aside_sees_the_lit_side_of_hairs(self, tmp_path: Path) -> None:
        """Upright hairs in a field: as bright as a cylinder from where the light comes, dark across from it."""
        write_tiles(tmp_path / "c.txt", hair((0.5, 0.5, 0), (0.5, 0.5, 0.2)), 5)
        tracer = Tracer(tmp_path / "c.txt", 5, 64, 16, 0.85)
        light = np.array([np.cos(0.5), 0.0, np.sin(0.5)])
        towards, across = (
            tracer.field(np.array([sign * np.cos(0.6), 0, np.sin(0.6)]), light, 0.1) for sign in (1.0, -1.0)
        )
        assert towards > 5 * across > 0
        # A cylinder that faces the light sends π/4 of what a flat face would.
        covered = 0.04 * 0.2 / np.tan(0.6)
        assert towards == pytest.approx(covered * 0.85 / np.pi * np.cos(0.5) * np.pi / 4, rel=0.15)

    def test_a_bake_is_compared(self, flat: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        monkeypatch.setattr(field, "EYES", ((90, 0), (40, 130)))
        monkeypatch.setattr(field, "LIGHTS", ((75, 30),))
        seen: list[str] = []
        found = field.verify_field(flat, spp=2, progress=lambda stage, _: seen.append(stage))
        assert 0 < found["off"]["mean"] < 0.6
        assert list(dict.fromkeys(seen)) == ["strands", "trace"]
