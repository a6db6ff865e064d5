"""Light on bent fur: the truth follows the hairs, and the law is nearer to it than none."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from furbake.options import BakeOptions, as_toml, preset
from furbake.pelt.bent import bent
from furbake.pelt.hairs.strands import Strands
from furbake.pelt.light.depth import Depth
from furbake.pelt.light.transport import hemisphere
from furbake.pelt.pelt import Pelt
from furbake.pelt.texels.basis import ptm
from furbake.study.bend import BAKED, LAWS, Row, bend, horizon, law, markdown, relit, turned, unbent

SMALL = replace(preset("paper"), size=16, layers=6, lights=24)
LIGHTS = hemisphere(40)


def test_unbent_fur_is_as_its_fit() -> None:
    (row,) = bend(SMALL, (0.0,), 1)
    assert row.ratios == pytest.approx(dict.fromkeys([*LAWS, BAKED], 1.0), abs=1e-5)


def test_the_law_beats_none_and_a_frame_that_turns() -> None:
    told: list[float] = []
    rows = list(bend(SMALL, (0.3,), 2, told.append))
    assert [row.azimuth for row in rows] == [0, 180]
    assert told == sorted(told)
    mean = {name: np.mean([row.ratios[name] for row in rows]) for name in [*LAWS, BAKED]}
    assert mean[BAKED] < mean["law"] < mean["as unbent"] < mean["frame turned"]
    assert mean[BAKED] < 1.6
    sky = {name: np.mean([row.sky[name] for row in rows]) for name in mean}
    assert sky[BAKED] < min(sky["law"], sky["as unbent"])


def test_texels_follow_the_hairs() -> None:
    """A hair that is bent stays in its texel, whatever part of a texel that slab has moved."""
    even = np.full((1, 65), 0.03)
    hair = Strands(np.linspace([0.53, 0.53, 0.0], [0.53, 0.53, 0.5], 65)[None], even, even, even)
    for tip in (np.zeros(2), np.array([0.3, -0.1])):
        volume = bent(hair, 0.5, tip, SMALL.coat.opacity, SMALL.layers, SMALL.size)
        assert volume.height == pytest.approx(0.5 * np.sqrt(1 - tip @ tip))
        assert (volume.sigma[:, 16, 16] > 0.9 * volume.sigma.max((1, 2))).all()
        np.testing.assert_allclose(volume.drift[-1], 0.5 * tip, atol=0.02)
        steepest = np.array([*(2 * tip), np.sqrt(1 - tip @ tip)])
        np.testing.assert_allclose(volume.tangent[-1, 16, 16], steepest / np.linalg.norm(steepest), atol=0.02)


def test_depth_through_slabs_aside_is_that_of_a_sheared_ray() -> None:
    rng = np.random.default_rng(5)
    sigma, slab, slope = rng.random((6, 16, 16)), 0.05, np.array([0.7, -0.4])
    # Smooth, so that it does not matter how texels are read between their middles.
    smooth = np.fft.rfft2(sigma) * (np.hypot(*np.meshgrid(np.arange(9), np.fft.fftfreq(16, 1 / 16))) < 3)
    sigma = np.fft.irfft2(smooth, s=(16, 16)) + 1
    aside = slope * slab * (np.arange(6)[:, None] + 0.5)
    light = np.array([0.5, 0.3, 0.8])
    bent, _ = Depth(sigma, slab, None, aside).through(light)
    sheared = np.array([*(light[:2] - slope * light[2]), light[2]])
    length = np.linalg.norm(sheared)
    # The sheared ray is as long as it was, and starts as far from the voxel's middle.
    plain, _ = Depth(sigma / length, slab, None).through(sheared / length)
    np.testing.assert_allclose(bent, plain, atol=0.02)


def test_laws() -> None:
    tip, lean, none = np.array([0.3, 0.4]), np.array([0.2, 0.1]), np.zeros(2)
    for each in LAWS.values():
        ways, factor = each(LIGHTS, none, lean, 0.7)
        np.testing.assert_allclose(ways, LIGHTS, atol=1e-12)
        np.testing.assert_allclose(factor, 1.0)
        np.testing.assert_allclose(np.linalg.norm(each(LIGHTS, tip, lean, 0.7)[0], axis=1), 1.0)
    # A light along the chord from s to the tip runs along hairs that stand.
    chord = np.array([*(1.5 * tip), np.sqrt(1 - tip @ tip)])
    ways, _ = law(chord[None] / np.linalg.norm(chord), tip, lean, 0.5)
    np.testing.assert_allclose(ways, [[0, 0, 1]], atol=1e-12)
    # On the horizon it stays there.
    np.testing.assert_allclose(law(np.array([[0.6, 0.8, 0]]), tip, lean, 0.5)[0], [[0.6, 0.8, 0]])
    away, towards = (law(np.array([[side, 0, 0.8]]), np.array([0.3, 0]), none, 1.0)[1] for side in (-0.6, 0.6))
    assert away > towards
    along, against = (law(LIGHTS, side * lean, lean, 0.0)[1] for side in (1, -1))
    assert (along < against).all()
    # A frame that turned lets lights below its horizon fade.
    assert turned(np.array([[-0.995, 0, 0.0999]]), np.array([0.5, 0]), none, 1.0)[1] < 0.5
    np.testing.assert_allclose(horizon(np.array([[0, 0, -1.0]]), 0.5)[1], 0)


def test_texels_are_lit_and_clamped(make_pelt: Callable[..., Pelt]) -> None:
    for kind, count in (("ptm", 6), ("eigen", 4)):
        pelt = make_pelt(kind=kind, coefficients=count)
        light = relit(pelt, LIGHTS, np.array([0.3, 0]), np.zeros(2), law)
        assert light.shape == (40, 4, 8, 8)
        assert light.min() == 0
    pelt = make_pelt()
    values = np.maximum((pelt.scale * (pelt.codes[1, 2, 3] - pelt.bias)) @ ptm(LIGHTS).T, 0)
    np.testing.assert_allclose(relit(pelt, LIGHTS, np.zeros(2), np.zeros(2), unbent)[:, 1, 2, 3], values, atol=1e-4)


def test_table() -> None:
    def row(preset: str, tip: float, ratio: float) -> Row:
        return Row(preset, tip, 90.0, dict.fromkeys([*LAWS, BAKED], ratio), dict.fromkeys([*LAWS, BAKED], 0.1 * ratio))

    lines = markdown([row("fox", 0.3, 1.0), row("fox", 0.5, 1.5), row("mole", 0.3, 2.0)]).splitlines()
    assert lines[0] == "| fur | tip | from the lean | as unbent | frame turned | sheared | law | baked numbers |"
    assert lines[2] == "| fox | 0.3 H | 90° | 1.00 | 1.00 | 1.00 | 1.00 | 1.00 |"
    assert lines[5:] == [
        "| **fox** | all | mean | 1.25 | 1.25 | 1.25 | 1.25 | 1.25 |",
        "| **mole** | all | mean | 2.00 | 2.00 | 2.00 | 2.00 | 2.00 |",
        "| **all** | 0.3 H | mean | 1.50 | 1.50 | 1.50 | 1.50 | 1.50 |",
        "| **all** | 0.5 H | mean | 1.50 | 1.50 | 1.50 | 1.50 | 1.50 |",
        "| **all** | all | mean | 1.50 | 1.50 | 1.50 | 1.50 | 1.50 |",
        "| **all** | all | worst | 2.00 | 2.00 | 2.00 | 2.00 | 2.00 |",
        "| **all, under an even sky** | all | mean | 15.0% | 15.0% | 15.0% | 15.0% | 15.0% |",
    ]


def test_command(run: Callable[..., Any], tmp_path: Any, tiny: BakeOptions) -> None:
    (tmp_path / "tiny.toml").write_text(as_toml(tiny))
    done = run("bend", tmp_path / "tiny.toml", "--tips", "0.4", "--azimuths", "2", "--quiet")
    assert (done.status, done.err) == (0, "")
    assert [line.split(" | ")[0] for line in done.out.splitlines()[2:]] == ["| tiny"] * 2 + ["| **tiny**"] + [
        "| **all**"
    ] * 3 + ["| **all, under an even sky**"]
