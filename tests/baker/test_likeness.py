from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import warnings
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any, Self

import numpy as np
import pytest

from furbake import BakeOptions
from furbake.asset.planes import read_png
from furbake.asset.read import read_asset
from furbake.asset.stored import read_pelt, skin_colour
from furbake.asset.validate import validate
from furbake.bake import bake
from furbake.groom.strands import Groom
from furbake.likeness import page
from furbake.likeness.ceiling import TOGETHER, directions, sampled_ceiling, shares, visible, write_passes
from furbake.likeness.cells import FIELD_OF_VIEW, PLANS, Cell, Frame, cells, frame
from furbake.likeness.colour import compared
from furbake.likeness.figures import bins, contrast, figures, overlap, similarity
from furbake.likeness.page import Shown, grey_copy, show
from furbake.likeness.paint import write_painted
from furbake.likeness.sheet import GAP, row
from furbake.likeness.tables import lines
from furbake.likeness.truth import Scene, trace
from furbake.likeness.verify import Options, verify_body
from furbake.pathtrace import VerifyError
from furbake.surface.mesh import Surface
from furbake.surface.shapes import sphere as icosphere

NEAR = Frame(np.zeros(3), 0.5, 10.0, 60, 50)


def cell(lamp: tuple[float, float, float]) -> Cell:
    """The eye is on +z, y is up."""
    towards = np.array(lamp) / np.linalg.norm(lamp)
    return Cell("front", "lamp", np.array([0.0, 0.0, 10.0]), towards)


def test_lamps_are_where_the_eye_sees_them() -> None:
    body = PLANS["body"]
    seen = frame(np.array([[-1.0, -1, -1], [1, 1, 1]]), 0.1, body, 120)
    assert (seen.width, seen.height) == (120, 100)
    wanted = cells(body, seen)
    assert [one.name for one in wanted] == [
        f"{view}-{lamp}" for view in ("front", "back") for lamp in ("frontleft", "side", "behind")
    ]
    for one in wanted:
        back = (one.eye - seen.centre) / seen.distance
        right = np.cross([0, 1, 0], back)
        assert np.linalg.norm(one.to_lamp) == pytest.approx(1)
        if one.lamp == "frontleft":
            assert one.to_lamp @ back > 0 > one.to_lamp @ right
        if one.lamp == "behind":
            assert one.to_lamp @ back < 0
    eye, beside, side = cells(PLANS["round"], seen)
    np.testing.assert_allclose(eye.to_lamp, eye.eye / 1 / np.linalg.norm(eye.eye), atol=1e-9)
    assert side.to_lamp @ eye.to_lamp == pytest.approx(0, abs=1e-9)
    assert 0.6 < beside.to_lamp @ eye.to_lamp < 0.8


def test_all_of_the_fur_is_in_the_picture() -> None:
    chance = np.random.default_rng(0)
    vertices = chance.normal(0, 1, (200, 3)) * [2, 1, 0.5]
    seen = frame(vertices, 0.2, PLANS["body"], 240)
    for one in cells(PLANS["body"], seen):
        back = (one.eye - seen.centre) / seen.distance
        right = np.cross([0, 1, 0], back)
        right /= np.linalg.norm(right)
        at = vertices - one.eye
        depth = -at @ back
        slope = np.tan(np.radians(FIELD_OF_VIEW) / 2)
        assert ((np.abs(at @ right) + 0.2) / depth).max() < slope * 1.2
        assert ((np.abs(at @ np.cross(back, right)) + 0.2) / depth).max() < slope


def test_close_up_the_eye_is_nearer_to_the_same_centre() -> None:
    corners = np.array([[-1.0, -1, -1], [1, 1, 1]])
    far, near = (frame(corners, 0.1, PLANS["body"], 120, share) for share in (1.0, 0.35))
    assert near.distance == pytest.approx(0.35 * far.distance)
    np.testing.assert_array_equal(near.centre, far.centre)


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


def test_a_sheet_is_orange_where_the_page_is_brighter() -> None:
    truth = np.full((8, 10), 0.5)
    page_ = truth.copy()
    page_[:, :5], page_[:, 5:] = 1.0, 0.0
    sheet = row(page_, truth).astype(int)
    assert sheet.shape == (8, 30 + 2 * GAP, 3)
    brighter, darker = sheet[0, 20 + 2 * GAP], sheet[0, -1]
    assert brighter[0] > 200 > brighter[2]
    assert darker[2] > 200 > darker[0]


def test_the_grey_copy_is_a_valid_asset_without_colours(tmp_path: Path, tiny: BakeOptions) -> None:
    bake("sphere", tmp_path / "a", replace(tiny, states=("dry", "soaked")))
    (tmp_path / "b").mkdir()
    grey_copy(read_asset(tmp_path / "a"), tmp_path / "b", 0.8, 0.25)
    before, after = (read_asset(tmp_path / name) for name in ("a", "b"))
    assert not [problem for problem in validate(tmp_path / "b") if "bake.json" not in problem]
    old, new = read_pelt(before), read_pelt(after)
    np.testing.assert_array_equal(new.codes, old.codes)
    np.testing.assert_array_equal(new.alpha, old.alpha)
    assert (new.tint == 255).all()
    assert old.colour is not None
    assert new.colour is None
    assert new.ramp.root == new.ramp.tip == new.ramp.tip2 == (0.8, 0.8, 0.8)
    assert skin_colour(after) == (0.25, 0.25, 0.25)
    assert len(after.fur["pelts"]) == 1


@pytest.mark.parametrize(
    ("options", "says"),
    [
        (Options(plan="all"), "plan: got 'all', expected body or round"),
        (Options(methods=("ptm", "magic")), "methods: got 'magic'"),
        (Options(size=8), "size: got 8"),
        (Options(spp=1), "spp: got 1"),
        (Options(look=(0.5, -1.0)), "look: got 0.5,-1, expected 0 to 100 each"),
        (Options(distance=0.1), "distance: got 0.1, expected 0.25 to 4"),
    ],
)
def test_options_out_of_range_are_refused(tmp_path: Path, options: Options, says: str) -> None:
    with pytest.raises(VerifyError, match=says):
        verify_body(tmp_path, options)


def test_missing_node_is_one_sentence(tmp_path: Path, tiny: BakeOptions, monkeypatch: pytest.MonkeyPatch) -> None:
    bake("plane:1x1", tmp_path / "a", tiny)
    monkeypatch.setattr(page.shutil, "which", lambda name: None)
    with pytest.raises(VerifyError, match="node: not found, expected Node"):
        show(read_asset(tmp_path / "a"), 0.8, 0.2, NEAR, [cell((0, 0, 1))], ["ptm"])


class Told:
    """A Node that writes what it should, or fails."""

    def __init__(self, command: list[str], says: str = "furbake: page 1/1\n", code: int = 0, **given: Any) -> None:
        self.stderr, self.returncode = says.splitlines(keepends=True), code
        folder = Path(command[-1])
        job = json.loads((folder / "job.json").read_text())
        assert sorted(path.name for path in (folder / "baked").glob("model.*")) == ["model.bin", "model.gltf"]
        count = job["width"] * job["height"]
        ramp = np.arange(count, dtype="<f4")
        for one in job["cells"]:
            for method in job["methods"]:
                np.column_stack([ramp, ramp * 0 + 1]).astype("<f4").tofile(folder / f"{one['name']}.{method}.f32")
            np.column_stack([ramp * 0, ramp * 0, ramp * 0 + 1, ramp >= 60]).astype("<f4").tofile(
                folder / f"{one['view']}.normals.f32"
            )
            np.zeros((count, 2), "<f4").tofile(folder / f"{one['view']}.features.f32")

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        pass


def test_pictures_of_the_page_have_row_0_on_top(
    tmp_path: Path, tiny: BakeOptions, monkeypatch: pytest.MonkeyPatch
) -> None:
    bake("plane:1x1", tmp_path / "a", tiny)
    monkeypatch.setattr(page.shutil, "which", lambda name: "node")
    monkeypatch.setattr(subprocess, "Popen", Told)
    seen: list[float] = []
    shown = show(read_asset(tmp_path / "a"), 0.8, 0.2, NEAR, [cell((0, 0, 1))], ["ptm"], seen.append)
    light = shown.light["front-lamp", "ptm"]
    assert light.shape == (50, 60)
    assert light[-1, 0] == 0
    assert light[0, 0] == 49 * 60
    assert np.isnan(shown.normal["front"][-1]).all()
    np.testing.assert_array_equal(shown.normal["front"][0, 0], [0, 0, 1])
    assert seen == [1.0]

    def broken(command: list[str], **given: Any) -> Told:
        return Told(command, "furbake: no browser for the tests: install Chromium\n", 1)

    monkeypatch.setattr(subprocess, "Popen", broken)
    with pytest.raises(VerifyError, match="page: no browser for the tests"):
        show(read_asset(tmp_path / "a"), 0.8, 0.2, NEAR, [cell((0, 0, 1))], ["ptm"])


def test_hairs_of_many_colours_are_pieces_of_a_few(tmp_path: Path) -> None:
    """Every piece is in one file, with its own control points, and as good as of its own colour."""
    control = np.random.default_rng(2).normal(size=(5, 7, 4))
    colours = np.repeat(np.linspace([0.1, 0.05, 0.02], [0.8, 0.5, 0.3], 5)[None], 5, axis=0)
    pieces = 0
    for path, colour in write_painted(tmp_path, control, colours):
        near = np.abs((colours[0, :-1] + colours[0, 1:]) / 2 - colour).max(1)
        assert near.min() < 0.02
        for curve in path.read_text().strip().split("\n\n"):
            points = np.array([[float(x) for x in line.split()] for line in curve.splitlines()])
            assert any(np.allclose(points, hair[k : k + len(points)], atol=1e-4) for hair in control for k in range(4))
            pieces += len(points) - 3
    assert pieces == 5 * 4


def test_mean_colours_are_compared_by_hue_saturation_and_luminance() -> None:
    found = compared(np.array([0.4, 0.2, 0.1]), np.array([0.2, 0.1, 0.05]))
    assert found["hue_off"] == pytest.approx(0)
    assert found["saturation_off"] == pytest.approx(0)
    assert found["luminance_off"] == pytest.approx(1)
    assert compared(np.array([1.0, 0.0, 0.1]), np.array([1.0, 0.1, 0.0]))["hue_off"] == pytest.approx(-12)


class TestWithMitsuba:
    """What only the path tracer can show; skipped where it is not installed."""

    @pytest.fixture(autouse=True)
    def _mitsuba(self) -> None:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            pytest.importorskip("mitsuba")

    @staticmethod
    def hair(radius: float) -> Groom:
        """A straight one along x, before a wall far behind it."""
        points = np.zeros((1, 9, 3), np.float32)
        points[0, :, 0] = np.linspace(-3, 3, 9)
        flat = np.ones((1, 9), np.float32)
        return Groom(points, radius * flat, flat, np.ones((1, 9, 3), np.float32), np.zeros(1, int), np.zeros(1, int))

    WALL = np.array([[-9.0, -9, -20], [9, -9, -20], [9, 9, -20], [-9, 9, -20]])
    FACES = np.array([[0, 1, 2], [0, 2, 3]])

    @pytest.mark.parametrize("phi", [0.0, 0.9, 2.2])
    def test_a_hair_is_as_wide_and_as_bright_as_the_cylinder_says(self, phi: float) -> None:
        """A Lambertian cylinder of albedo ϖ has 4π·radiance/(ϖ·E) = sinφ + (π − φ)cosφ on the mean of its width."""
        away = replace(NEAR, radius=5.0)
        scene = Scene(self.hair(0.1), self.WALL + np.array([0, 0, -900]), self.FACES, 0.85, 0.0)
        light = cell((0.0, np.sin(phi), np.cos(phi)))
        (seen,) = trace(scene, away, [light], 64, depth=2)
        column = seen.light[:, 20:40].mean(axis=1)
        cover = seen.cover[:, 20:40].mean(axis=1)
        pixel = 2 * 10 * np.tan(np.radians(FIELD_OF_VIEW) / 2) / 50
        assert cover.sum() * pixel == pytest.approx(0.2, rel=0.02)
        expected = np.sin(phi) + (np.pi - phi) * np.cos(phi)
        assert column.sum() / cover.sum() == pytest.approx(expected, rel=0.05)
        if phi > 0:
            assert column[:25].sum() > column[25:].sum(), "the upper side faces the lamp, and row 0 is on top"

    def test_skin_is_as_bright_as_lambert_says(self) -> None:
        """Radiance of albedo ρ under irradiance E·cos is ρ·E·cos/π: in the unit of L 4·ρ·cos/ϖ."""
        scene = Scene(self.hair(1e-5), self.WALL, self.FACES, 0.8, 0.3)
        (seen,) = trace(scene, NEAR, [cell((0.6, 0.0, 0.8))], 8)
        assert np.median(seen.light) == pytest.approx(4 * 0.3 * 0.8 / 0.8, rel=1e-3)
        assert seen.cover.min() == 1

    def test_a_body_is_compared(self, tmp_path: Path, tiny: BakeOptions, monkeypatch: pytest.MonkeyPatch) -> None:
        """All but the browser, whose pictures are those of the tracer, twice as bright."""
        bake("sphere", tmp_path / "a", replace(tiny, fins=False))
        kept: list[Any] = []

        def traced(*given: Any, **more: Any) -> Any:
            kept.extend(trace(*given, **more))
            return kept

        def shown(
            asset: Any, albedo: float, skin: float, seen: Frame, wanted: Any, methods: Any, *_: Any, look: Any
        ) -> Shown:
            assert look == (0.25, 40.0)
            normal = np.zeros((seen.height, seen.width, 3))
            normal[..., 2] = 1
            pairs = [(one.name, method) for one in wanted for method in methods]
            return Shown(
                {pair: 2 * one.light for pair, one in zip(pairs, kept, strict=True)},
                {pair: one.cover for pair, one in zip(pairs, kept, strict=True)},
                {"front": normal},
                {"front": normal[..., 0] > 0},
            )

        monkeypatch.setattr("furbake.likeness.verify.trace", traced)
        monkeypatch.setattr("furbake.likeness.verify.show", shown)
        options = Options(methods=("ptm",), size=36, spp=8, look=(0.25, 40.0), truth=tmp_path / "t.npz")
        found = verify_body(tmp_path / "a", options, picture=tmp_path / "p.png")
        assert found["plan"] == "round"
        for one in found["cells"]:
            assert one["methods"]["ptm"]["brightness"] == pytest.approx(2)
            assert one["methods"]["ptm"]["r"] == pytest.approx(1)
            assert one["outline"] == 1
        assert read_png(tmp_path / "p.png").shape == (3 * 30 + 2 * GAP, 3 * 36 + 2 * GAP, 3)
        assert sum(line.startswith("| front-") for line in lines(found)) == 3
        assert sum("brightness in the unit of L" in line for line in lines(found)) == 3
        again = list(kept)
        monkeypatch.setattr("furbake.likeness.verify.trace", lambda *given, **more: pytest.fail("traced again"))
        kept[:] = again
        assert verify_body(tmp_path / "a", options)["cells"][0]["outline"] == 1


def test_missing_mitsuba_says_what_to_install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "mitsuba", None)
    with pytest.raises(VerifyError, match=r"pip install 'furbake\[verify\]'"):
        verify_body(tmp_path)


class TestCeiling:
    def test_shares_bring_smooth_light_back(self) -> None:
        """Of a function of the direction that is known between the lights, too."""
        lights = directions(0.02)
        assert len(lights) % TOGETHER == 0
        chance = np.random.default_rng(0)
        towards = chance.normal(size=(500, 3))
        towards /= np.linalg.norm(towards, axis=1, keepdims=True)
        each = shares(lights, towards)
        above = towards[:, 2] > 0.02
        np.testing.assert_allclose(each.sum(axis=1), above, atol=1e-5)
        assert ((each > 0).sum(axis=1) <= 3).all()

        def light(d: np.ndarray) -> np.ndarray:
            return 1 + d[:, 2] + 0.5 * d[:, 0] * d[:, 1]

        np.testing.assert_allclose((each @ light(lights))[above], light(towards[above]), atol=0.06)

    def test_one_part_of_a_body_shades_another_and_not_itself(self) -> None:
        """A ball far behind hides the lamp; the ground's own ball does not, however low the lamp is."""
        ball = icosphere()
        whole = Surface(
            np.concatenate([ball.vertices, ball.vertices + np.array([5.0, 0, 0])]),
            np.concatenate([ball.faces, ball.faces + len(ball.vertices)]),
            np.concatenate([ball.normals, ball.normals]),
        )
        alone = Surface(ball.vertices, ball.faces, ball.normals)
        ground = SimpleNamespace(vertices=ball.vertices, normals=ball.normals, reach=np.full(len(ball.vertices), 0.1))
        lamp = np.array([1.0, 0, 0])
        lit = ball.normals[:, 0] > -0.1
        np.testing.assert_array_equal(visible(ground, alone, lamp)[lit], 1)
        assert visible(ground, whole, lamp)[ball.normals[:, 0] > 0.7].max() == 0

    def test_a_pass_is_an_asset_of_three_directions(self, tmp_path: Path, tiny: BakeOptions) -> None:
        bake("plane:2x2", tmp_path / "a", replace(tiny, uv="own"))
        asset = read_asset(tmp_path / "a")
        (tmp_path / "grey").mkdir()
        grey_copy(asset, tmp_path / "grey", 0.8, 0.2)
        found = sampled_ceiling(asset, [cell((0.2, 0.9, 0.3))])
        assert found.shares.shape == (1, 9, len(directions(0.02)))
        np.testing.assert_allclose(found.shares.sum(axis=2), 1, atol=1e-5)
        write_passes(found, tmp_path / "grey", tmp_path / "passes")
        assert len(list((tmp_path / "passes").glob("*.f32"))) == found.passes
        copy = read_asset(tmp_path / "passes" / "01")
        texels = read_pelt(copy)
        assert texels.colour is not None
        stored = (texels.colour / 255.0 + 0.055) / 1.055
        linear = np.where(texels.colour / 255.0 <= 0.04045, texels.colour / 255.0 / 12.92, stored**2.4)
        thick = found.alpha > 0.2
        np.testing.assert_allclose(
            found.white * linear[thick], np.moveaxis(found.samples[3:6], 0, -1)[thick], atol=0.02 * found.white
        )


def test_the_page_draws_a_job(tmp_path: Path, tiny: BakeOptions) -> None:
    """Through Node and a browser: a lit square of skin under fur whose hairs all have L = 1."""
    browser = [shutil.which(name) for name in ("chromium", "chromium-browser", "google-chrome")]
    if not (any(browser) or os.environ.get("FURBAKE_CHROMIUM")) or shutil.which("node") is None:
        pytest.skip("needs Node and Chromium")
    if not (page.TOOL.parents[2] / "node_modules").exists():
        pytest.skip("needs the web wing: npm ci")
    thick = replace(tiny.coat, guard=replace(tiny.coat.guard, count=900), under=replace(tiny.coat.under, count=900))
    bake("plane:1x1", tmp_path / "a", replace(tiny, uv="own", fins=False, coat=thick))
    eye = np.array([0.0, 6.0, 6.0])
    wanted = [Cell("front", "lamp", eye, np.array([0.0, 1.0, 0.0]))]
    seen = Frame(np.zeros(3), 0.7, float(np.linalg.norm(eye)), 48, 40)
    shown = show(read_asset(tmp_path / "a"), 0.8, 0.0, seen, wanted, ["unlit", "ptm"])
    skin = np.isfinite(shown.normal["front"][..., 0])
    np.testing.assert_allclose(shown.normal["front"][skin], np.tile([0, 1, 0], (skin.sum(), 1)), atol=1e-5)
    half = np.tan(np.radians(FIELD_OF_VIEW) / 2) * np.linalg.norm(eye) / 20  # of a pixel, model units
    assert skin.sum() == pytest.approx(np.sqrt(0.5) / half**2, rel=0.1), "the square from 45 degrees"
    rows, columns = np.nonzero(skin)
    assert (rows.mean(), columns.mean()) == pytest.approx((19.5, 23.5), abs=1)
    light, cover = (part["front-lamp", "unlit"] for part in (shown.light, shown.cover))
    assert (cover[skin] > 0.99).all()
    assert np.median(light[skin]) == pytest.approx(1, abs=0.03)
    assert shown.light["front-lamp", "ptm"][skin].mean() > 0.1
    assert not shown.feature["front"].any()
    glossy = show(read_asset(tmp_path / "a"), 0.8, 0.0, seen, wanted, ["ptm"], look=(1.0, 0.0))
    assert (glossy.light["front-lamp", "ptm"] - shown.light["front-lamp", "ptm"])[skin].mean() > 0.01
