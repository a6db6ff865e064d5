from __future__ import annotations

import re

import numpy as np
import pytest

from furbake.pelt.texels.basis import PTM
from furbake.show.report.measure import choose_curves, spiral_lights
from furbake.show.report.page import chosen, flat
from furbake.show.report.page import text as in_words
from furbake.show.report.pictures import BRIGHTER, DARKER, NONE, discs, error_colours, lightness, row
from furbake.show.report.svg import Axis, Series, axis, plot, round_step, sparkline


def test_lights_go_once_around_and_sink() -> None:
    lights = spiral_lights()
    np.testing.assert_allclose(np.linalg.norm(lights, axis=1), 1)
    elevation = np.degrees(np.arcsin(lights[:, 2]))
    np.testing.assert_allclose(elevation[[0, -1]], [75, 15])
    assert (np.diff(elevation) < 0).all()
    np.testing.assert_allclose(lights.sum(0)[:2] / 8, 0, atol=0.15)
    np.testing.assert_allclose(lights[2, 0], 0, atol=1e-12)
    assert lights[2, 1] > 0


def test_curves_are_of_the_median_texel_and_of_a_hard_one() -> None:
    alpha = np.ones((10, 8, 8))
    alpha[:, 0] = 0.0
    truth = np.zeros((5, 10, 8, 8), np.float32)
    stored = truth + np.arange(64, dtype=np.float32).reshape(8, 8)
    curves = choose_curves(truth, stored, alpha)
    assert [curve.layer for curve in curves] == [9, 9, 5, 5, 2, 2]
    assert [curve.hard for curve in curves] == [False, True] * 3
    # The first row has no hair: 8 to 63 remain, of which 35 is the median and 60 worse than 95 of 100.
    assert [8 * curve.row + curve.column for curve in curves[:2]] == [35, 60]
    assert curves[1].stored.tolist() == [60.0] * 5


def test_pictures_have_v_upwards_and_stand_side_by_side() -> None:
    images = np.zeros((3, 8, 8))
    images[1, 0] = 1.0
    strip = row(images, 8)
    assert strip.shape == (8, 24)
    np.testing.assert_array_equal(strip[-1], [0.0] * 8 + [1.0] * 8 + [0.0] * 8)
    assert strip[:-1].max() == 0
    assert row(images, 4).shape == (4, 12)
    assert row(images, 99).shape == (8, 24), "never enlarged"
    np.testing.assert_allclose(lightness(np.array([2.0, 1.0, 4.0]), np.array([1.0, 0.125, 1.0]), 2.0), [1, 0.25, 1])


def test_colours_of_the_error() -> None:
    colours = error_colours(np.array([[-9.0, 0.0, 9.0]]))[0] / 255
    np.testing.assert_allclose(colours, [DARKER, NONE, BRIGHTER], atol=0.002)
    low, high = error_colours(np.array([[0.05, 0.2]]))[0].sum(-1).astype(int)
    assert 0 < low < high


def test_discs_show_a_basis_from_above() -> None:
    shapes = discs(PTM, 9)
    assert len(shapes) == 6
    # lu: orange on the right, blue on the left, nothing in the middle; lv likewise upwards.
    np.testing.assert_allclose(shapes[3][4, [0, 4, 8]] / 255, [DARKER, NONE, BRIGHTER], atol=0.1)
    np.testing.assert_allclose(shapes[4][[8, 4, 0], 4] / 255, [DARKER, NONE, BRIGHTER], atol=0.1)
    np.testing.assert_allclose(shapes[5] / 255, np.broadcast_to(BRIGHTER, (9, 9, 3)), atol=0.002)


def test_axes_have_round_ticks() -> None:
    assert [round_step(step) for step in (0.9, 1.0, 1.1, 3, 6, 0.03)] == [1, 1, 2, 5, 10, pytest.approx(0.05)]
    ticks = axis([17.3, 26.1], "dB")
    assert (ticks.low, ticks.high) == (16, 28)
    assert [name for _, name in ticks.ticks] == ["16", "18", "20", "22", "24", "26", "28"]
    assert axis([0.0, 3.2], "light", low=0.0).low == 0
    same = axis([5.0, 5.0, float("nan")], "dB")
    assert same.low <= 5 <= same.high
    assert same.low < same.high


def test_plots_mark_every_point_inside_the_frame() -> None:
    x, y = Axis(0, 10, [(0, "0"), (10, "10")], "x"), Axis(0, 1, [(0, "0"), (1, "1")], "y")
    drawn = plot("a < b", x, y, (Series([0, 5, 10], [0, 0.5, 9.0], "fit", "dots", "fit & more"),))
    places = re.findall(r'class="dot fit" cx="([\d.]+)" cy="([\d.]+)" r="3"', drawn)
    assert [float(a) for a, _ in places] == [44, 188, 332]
    heights = [float(b) for _, b in places]
    assert heights[0] == 198
    assert heights[1] == pytest.approx((heights[0] + heights[2]) / 2)
    assert heights[2] > 40, "what is beyond the axis is held at its end"
    assert "a &lt; b" in drawn
    assert "fit &amp; more" in drawn
    for kind, mark in (("line", '<path class="line fit'), ("bars", '<path class="bar fit'), ("ring", '"ring fit"')):
        assert mark in plot("t", x, y, (Series([1], [0.5], "fit", kind, "n"),))
    assert sparkline([0, 2, 1], "use").count("V") == 4


def test_words() -> None:
    assert chosen(16, 4) == [15, 10, 5, 0]
    assert chosen(2, 4) == [1, 0]
    assert flat({"a": 1, "b": {"c": 2, "d": {"e": 3}}}) == {"a": 1, "b.c": 2, "b.d.e": 3}
    assert [in_words(value) for value in (None, True, 0.25, [1, 0.5], "x")] == [
        "as the preset has it", "yes", "0.25", "1, 0.5", "x",
    ]  # fmt: skip
