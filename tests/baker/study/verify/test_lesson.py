"""Pictures of the lesson's rivals: their view, their light, and the sky that the tracer has."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from furbake.asset.planes import write_webp
from furbake.daylight import PAGE, tone_mapped
from furbake.groom.strands import Groom
from furbake.study.verify.cells import Cell, Frame
from furbake.study.verify.lesson import QUALITY, View, shown
from furbake.study.verify.truth import Scene, Traced, trace

LESSON = Path(__file__).parents[4] / "web" / "learn" / "rivals"


def test_the_lesson_has_a_picture_of_every_lamp() -> None:
    view = View.read(LESSON / "view.json")
    assert view.sky == 0.5
    assert sorted(view.lamps) == sorted(path.stem for path in LESSON.glob("*.webp"))
    for name in view.lamps:
        with Image.open(LESSON / f"{name}.webp") as picture:
            assert (picture.mode, picture.width) == ("RGBA", picture.height)
            coverage = np.asarray(picture)[..., 3] / 255
        # The ring over nothing, all of it.
        assert 0.25 < coverage.mean() < 0.5
        assert max(coverage[edge].max() for edge in (0, -1, np.s_[:, 0], np.s_[:, -1])) == 0


def test_lamp_and_sky_add_up_and_are_tone_mapped_behind_their_coverage(tmp_path: Path) -> None:
    """A matt white wall that faces the lamp, half of a pixel, has the lamp's own radiance there."""
    white, half = np.full((1, 2, 3), 4.0), np.array([[1.0, 0.5]])
    lit, sky = (Traced(light * half[..., None], half, (light, light)) for light in (white, 0 * white))
    picture = shown(lit, sky)
    expected = tone_mapped(np.array(PAGE.lamp) / np.pi)
    linear = np.where(
        picture[..., :3] <= 0.04045, picture[..., :3] / 12.92, ((picture[..., :3] + 0.055) / 1.055) ** 2.4
    )
    np.testing.assert_allclose(linear, np.broadcast_to(expected, linear.shape), atol=0.005)
    np.testing.assert_array_equal(picture[..., 3], half)
    brighter = shown(lit, Traced(0.1 * half[..., None] * np.ones(3), half, (white, white)))
    assert (brighter[..., 2] > picture[..., 2]).all()

    pixels = np.round(np.repeat(picture, 8, axis=0).repeat(8, axis=1) * 255).astype(np.uint8)
    write_webp(tmp_path / "a.webp", pixels, QUALITY)
    with Image.open(tmp_path / "a.webp") as stored:
        assert (stored.mode, stored.size) == ("RGBA", (16, 8))
        # Lossy, but colours stay as they are where the coverage is half.
        assert np.abs(np.asarray(stored, float) - pixels).max() < 12


def test_the_sky_is_above() -> None:
    """A matt plate that faces up sees the upper half of the sky alone: its radiance is albedo times the sky's."""
    pytest.importorskip("mitsuba")
    plate = np.array([[-3.0, 0, -3], [-3, 0, 3], [3, 0, 3], [3, 0, -3]])
    # A hair out of sight.
    hair = np.array([[[0.0, 90, 0], [0, 91, 0], [0, 92, 0]]], np.float32)
    thin, white = np.full((1, 3), 1e-3, np.float32), np.ones((1, 3, 3), np.float32)
    one = Groom(hair, thin, white[..., 0], white, np.zeros(1, np.int64), np.zeros(1, np.int64))
    above, below = (0.2, 0.3, 0.4), (0.7, 0.0, 0.0)
    faces = np.array([[0, 1, 2], [0, 2, 3]])
    scene = Scene(one, plate, faces, 1.0, 1.0, white, (0.5, 0.5, 0.5), (above, below))
    seen = Frame(np.zeros(3), 1.0, 10.0, 8, 8)
    over = Cell("over", "none", np.array([0.0, 10.0, 0.1]), np.array([0.0, 0.0, 1.0]))
    (found,) = trace(scene, seen, [over], 256, fast=False)
    np.testing.assert_allclose(found.light.mean((0, 1)), 0.5 * np.array(above), rtol=0.02)
