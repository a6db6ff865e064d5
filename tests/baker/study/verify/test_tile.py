from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from furbake import BakeOptions
from furbake.asset.planes import read_png
from furbake.pelt.hairs.strands import Coat, Hairs, grow
from furbake.pipeline import bake
from furbake.study.verify.pathtrace import Tracer, VerifyError, control_points, tiles_around, write_tiles
from furbake.study.verify.tile import Views, figures, flat_options, lights, lines, side_by_side, verify
from helpers.hairs import hair


def blurred(images: np.ndarray) -> Views:
    return Views(images, images, images, images[0], images[0])


def test_splines_pass_through_the_strands() -> None:
    curly = Hairs(count=40, curl=0.05, turns=4)
    strands = grow(Coat(guard=curly, under=curly), 0.5, 3)
    control = control_points(strands)
    assert control.shape == (80, strands.points.shape[1] + 2, 4)
    at_knots = (control[:, :-2] + 4 * control[:, 1:-1] + control[:, 2:]) / 6
    assert np.abs(at_knots[..., :3] - strands.points).max() <= 1e-3
    np.testing.assert_allclose(at_knots[..., 3], strands.radius, atol=1e-6)


def test_splines_stay_near_the_strands_between_their_points() -> None:
    strands = grow(Coat(), 0.5, 0)
    control = control_points(strands)
    middles = (control[:, :-3] + 23 * control[:, 1:-2] + 23 * control[:, 2:-1] + control[:, 3:]) / 48
    straight = (strands.points[:, 1:] + strands.points[:, :-1]) / 2
    assert np.abs(middles[..., :3] - straight).max() <= 2e-3


def test_tiles_repeat_the_strand_around_the_first(tmp_path: Path) -> None:
    strand = hair((0.5, 0.5, 0), (0.6, 0.4, 0.3))
    control, path = control_points(strand), tmp_path / "curves.txt"
    write_tiles(path, strand, 1)
    *strands, last = [
        np.array([[float(x) for x in line.split()] for line in block.splitlines()])
        for block in path.read_text().strip().split("\n\n")
    ]
    assert last[:, 3].max() <= 1e-6
    assert np.ptp(last[:, :3], axis=0).max() <= 4e-6  # no ray meets what a reader past the end would miss
    read = np.array(strands)
    assert read.shape == (9, control.shape[1], 4)
    moved = read - control
    assert {tuple(np.round(shift).astype(int)) for shift in moved[:, 0, :2]} == {
        (u, v) for u in (-1, 0, 1) for v in (-1, 0, 1)
    }
    np.testing.assert_allclose(moved, np.round(moved), atol=1e-6)
    assert not np.round(moved[..., 2:]).any()


def test_longer_fur_needs_more_tiles() -> None:
    assert tiles_around(hair((0, 0, 0), (0, 0, 0.5)), 0.342) == 2
    assert tiles_around(hair((0, 0, 0), (0, 0, 2.0)), 0.342) == 6


def test_lights_are_the_eight_from_75_to_20_degrees() -> None:
    towards = lights()
    np.testing.assert_allclose(np.linalg.norm(towards, axis=1), 1)
    np.testing.assert_allclose(np.degrees(np.arcsin(towards[:, 2])), [75, 60, 50, 40, 35, 30, 25, 20])


def test_equal_images_agree_and_unequal_ones_do_not() -> None:
    chance = np.random.default_rng(0)
    images = chance.random((8, 16, 16)) * np.arange(1, 9)[:, None, None]
    same = figures(blurred(images))
    for part in ("samples", "fit"):
        assert same[part]["r"] == pytest.approx(1)
        assert same[part]["r_brightness"] == pytest.approx(1)
        assert same[part]["ratio"] == pytest.approx(1)
    assert all(target["met"] for target in same["met"].values())
    halved = replace(blurred(images), samples=images / 2, fit=images[:, ::-1])
    other = figures(halved)
    assert other["samples"]["r"] == pytest.approx(1)
    assert other["samples"]["ratio"] == pytest.approx(0.5)
    assert other["fit"]["r"] < 0.3, "a flipped image does not agree: orientation is not searched for"
    text = "\n".join(lines(other | {"spp": 1, "depth": 2, "pixels": 16}))
    assert "missed: fit.r" in text
    assert "samples: r 1.000" in text


def test_constant_images_have_no_correlation() -> None:
    assert figures(blurred(np.ones((8, 4, 4))))["samples"]["r"] == 0


def test_picture_has_a_row_per_light_and_the_larger_v_on_top() -> None:
    images = np.zeros((8, 16, 16))
    images[:, -1] = 1
    sheet = side_by_side(blurred(images))
    assert sheet.shape == (8 * 160 + 7 * 4, 3 * 160 + 2 * 4, 3)
    assert sheet[0, 0, 0] == 255
    assert sheet[150, 0, 0] == 0


@pytest.mark.parametrize(
    ("record", "says"),
    [
        ({}, "no options"),
        ({"options": {"no such knob": 1}}, "not understood"),
        ({"options": BakeOptions().as_record()}, "--flat"),
    ],
)
def test_what_is_no_flat_bake_is_refused(record: dict[str, object], says: str) -> None:
    with pytest.raises(VerifyError, match=says):
        flat_options(record, Path("asset"))


def test_missing_mitsuba_says_what_to_install(
    tmp_path: Path, tiny: BakeOptions, monkeypatch: pytest.MonkeyPatch
) -> None:
    bake("plane", tmp_path / "a", replace(tiny, flat=True))
    monkeypatch.setitem(sys.modules, "mitsuba", None)
    with pytest.raises(VerifyError, match=r"pip install 'furbake\[verify\]'"):
        verify(tmp_path / "a")


def test_strands_of_another_seed_are_refused(
    tmp_path: Path, tiny: BakeOptions, monkeypatch: pytest.MonkeyPatch
) -> None:
    bake("plane", tmp_path / "a", replace(tiny, flat=True))
    record = tmp_path / "a" / "bake.json"
    record.write_text(record.read_text().replace('"seed": 0', '"seed": 1'))
    monkeypatch.setattr("furbake.study.verify.tile.load", lambda: None)
    with pytest.raises(VerifyError, match="bake it again"):
        verify(tmp_path / "a")


@pytest.mark.usefixtures("mitsuba")
class TestWithMitsuba:
    """Proofs that need the path tracer."""

    def test_row_is_v_and_column_is_u(self, tmp_path: Path) -> None:
        strands = hair((0.2, 0.7, 0.1), (0.2, 0.7, 0.11), (0.45, 0.7, 0.12))
        write_tiles(tmp_path / "c.txt", strands, 1)
        covered = Tracer(tmp_path / "c.txt", 1, 32, 32, 0.85).covered()
        rows, columns = np.nonzero(covered > 0.5)
        assert (rows.mean() + 0.5) / 32 == pytest.approx(0.7, abs=0.02)
        assert (columns.min() / 32, (columns.max() + 1) / 32) == pytest.approx((0.2, 0.45), abs=0.05)

    def test_hair_lit_from_the_side_is_as_bright_as_the_cylinder_says(self, tmp_path: Path) -> None:
        strands = hair((0.1, 0.5, 0.3), (0.5, 0.5, 0.300001), (0.9, 0.5, 0.300002), radius=0.05)
        write_tiles(tmp_path / "c.txt", strands, 0)
        light = np.array([0.0, 0.6, 0.8])
        tracer = Tracer(tmp_path / "c.txt", 0, 64, 64, 0.85)
        seen = tracer.lit(light, depth=2)[:, 24:40]
        covered = tracer.covered()[:, 24:40]
        phi = np.arccos(0.8)
        expected = np.sin(phi) + (np.pi - phi) * np.cos(phi)
        assert 4 * np.pi / 0.85 * seen.sum() / covered.sum() == pytest.approx(expected, rel=0.02)
        assert seen[32:].sum() > seen[:32].sum(), "the side that faces the light is the brighter one"

    def test_a_bake_is_compared(self, tmp_path: Path, tiny: BakeOptions) -> None:
        bake("plane", tmp_path / "a", replace(tiny, flat=True))
        seen: list[str] = []
        found = verify(tmp_path / "a", picture=tmp_path / "p.png", spp=4, progress=lambda stage, _: seen.append(stage))
        assert found["samples"]["r"] > 0.2
        assert found["coverage"]["r"] > 0.3
        assert read_png(tmp_path / "p.png").shape[2] == 3
        assert list(dict.fromkeys(seen)) == ["strands", "light", "trace"]
