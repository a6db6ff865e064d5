"""Grooms bound to a body: what is told, and fields and tiles that are as the strands are."""

from __future__ import annotations

import json
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from PIL import Image
from scipy.stats import ks_2samp

from furbake.asset.read import read_asset
from furbake.asset.validate import validate
from furbake.groom.strands import groom
from furbake.imported.bind import bind, ground_of
from furbake.imported.curves import Curves, GroomError
from furbake.imported.drawn import distance
from furbake.imported.fields import direction_of, fields_of, standing
from furbake.imported.follow import cover, filled, followers
from furbake.options import BakeOptions, OptionError
from furbake.pipeline import bake
from furbake.show.report.groom import groom_section
from furbake.study.grooms import artist_strands, held_out
from furbake.surface.mesh import Surface, clean
from helpers.command import TINY
from helpers.grooms import strands, usda

BAKE = {"layers": 4, "size": 8, "lights": 8, "max_faces": 2000}


@pytest.fixture(scope="module")
def ball() -> Surface:
    shape = trimesh.creation.icosphere(4)
    return clean("ball", shape.vertices, shape.faces)


def curves(points: np.ndarray, **more: Any) -> Curves:
    count, each = points.shape[:2]
    flat = points.reshape(-1, 3).astype(np.float32)
    return Curves(flat, np.full(count, each), np.full(len(flat), 0.01, np.float32), **more)


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("groom")
    trimesh.creation.icosphere(3).export(folder / "ball.obj")
    points = strands(3000)
    shade = np.where(points[..., 1:2] > 0, [0.4, 0.2, 0.1], [0.1, 0.1, 0.3])
    np.savez(folder / "groom.npz", points=points, widths=np.full(points.shape[:2], 0.01), colours=shade)
    return folder


@pytest.fixture(scope="module")
def baked(files: Path) -> Path:
    options = BakeOptions(groom=str(files / "groom.npz"), follow=3, **BAKE)
    bake(str(files / "ball.obj"), files / "out", options)
    return files / "out"


def test_hairs_with_colours_take_none_of_the_skins_picture(tmp_path: Path) -> None:
    shape = trimesh.creation.icosphere(3)
    stripes = Image.fromarray(np.tile(np.array([[[230, 90, 20]], [[20, 60, 200]]], np.uint8), (8, 16, 1)))
    uv = 0.5 + 0.4 * shape.vertices[:, :2]
    material = trimesh.visual.material.PBRMaterial(baseColorTexture=stripes)
    shape.visual = trimesh.visual.TextureVisuals(uv=uv, material=material)
    (tmp_path / "ball.glb").write_bytes(shape.export(file_type="glb"))
    points = strands(3000)
    grey = np.full((*points.shape[:2], 3), 0.6)
    for name, colours in (("grey", {"colours": grey}), ("none", {})):
        np.savez(tmp_path / f"{name}.npz", points=points, widths=np.full(points.shape[:2], 0.01), **colours)
        bake(str(tmp_path / "ball.glb"), tmp_path / name, BakeOptions(groom=str(tmp_path / f"{name}.npz"), **BAKE))
        assert validate(tmp_path / name) == []
    assert "roots" not in read_asset(tmp_path / "grey").fur
    assert "roots" in read_asset(tmp_path / "none").fur


@pytest.mark.parametrize(("count", "shade"), [(3000, (0.0, 0.0, 0.0)), (3000, (0.6, 0.0, 0.0)), (1, (0.3, 0.2, 0.1))])
def test_black_hairs_and_single_ones_are_worn_too(
    files: Path, tmp_path: Path, count: int, shade: tuple[float, float, float]
) -> None:
    points = strands(count)
    colours = np.broadcast_to(shade, (*points.shape[:2], 3))
    np.savez(tmp_path / "a.npz", points=points, widths=np.full(points.shape[:2], 0.01), colours=colours)
    bake(str(files / "ball.obj"), tmp_path / "out", BakeOptions(groom=str(tmp_path / "a.npz"), follow=0, **BAKE))
    assert validate(tmp_path / "out") == []
    root = np.array(read_asset(tmp_path / "out").fur["ramp"]["root"])
    assert ((root > 0) == (np.array(shade) > 0)).all()


def test_guides_that_are_too_far_apart_are_told_as_such(files: Path, tmp_path: Path) -> None:
    """Hairs between them leave the body; another body's groom they are not."""
    np.savez(tmp_path / "a.npz", points=strands(12), widths=0.01)
    options = BakeOptions(groom=str(tmp_path / "a.npz"), follow=10, **BAKE)
    with pytest.raises(GroomError, match="12 guides are so far apart that hairs between them leave the body"):
        bake(str(files / "ball.obj"), tmp_path / "out", options)


def test_roots_are_bound_and_floating_strands_counted(ball: Surface) -> None:
    points = strands(1000)
    points[:100] *= 1.5
    bound = bind("a", curves(points), ball)
    assert bound.count == 900
    assert any("100 strands float more than 0.04 off the body and are left out" in line for line in bound.notices)
    assert np.allclose(bound.length, 0.2, rtol=1e-4)
    tips = np.linalg.norm(points[100:, -1], axis=1) - 1
    assert np.allclose(bound.height, tips, atol=0.01)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda p: 100 * p, "is 100 times too large, expected the body's own units"),
        (lambda p: p / 100, "is 100 times too small, expected the body's own units"),
        (lambda p: p + np.array([9.0, 0, 0]), "expected a groom of this body"),
    ],
)
def test_grooms_of_other_bodies_and_units_get_one_sentence(ball: Surface, change: Any, message: str) -> None:
    with pytest.raises(GroomError) as caught:
        bind("a", curves(change(strands(500))), ball)
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_million_strands_far_away_are_refused_without_a_look_at_each(ball: Surface) -> None:
    far = np.broadcast_to(np.array([[50.0, 0, 0], [51.0, 0, 0]], np.float32), (1_000_000, 2, 3))
    start = time.process_time()
    with pytest.raises(GroomError, match="expected a groom of this body"):
        bind("a", curves(far), ball)
    assert time.process_time() - start < 60


def test_fields_are_those_of_the_strands(ball: Surface) -> None:
    points = strands(4000)
    points = np.concatenate([points[points[:, 0, 1] < 0.5]])  # bald above
    bound = bind("a", curves(points), ball)
    ground = ground_of(ball)
    fields = fields_of(standing(ground, bound, ground), bound)
    y = ball.vertices[:, 1]
    away = np.abs(y) < 0.4
    assert np.allclose(fields.length[away], 0.2, rtol=0.01)
    assert fields.density[away].mean() == pytest.approx(4000 / (4 * np.pi), rel=0.03)
    assert fields.density[away].std() < 0.15 * fields.density[away].mean()
    assert fields.bald[y > 0.75].all()
    assert not fields.bald[y < 0.4].any()
    down = np.array([0.0, -1.0, 0.0]) + ball.normals * y[:, None]
    down /= np.maximum(np.linalg.norm(down, axis=1, keepdims=True), 1e-9)
    assert np.degrees(np.arccos(np.einsum("ij,ij->i", direction_of(ball, fields, "nose-tail"), down)[away])).max() < 5


def test_guides_are_filled_in_between(ball: Surface) -> None:
    bound = bind("a", curves(strands(300)), ball)
    assert cover(bound, 4 * np.pi) == pytest.approx(300 * 0.2 * 0.01 / (4 * np.pi), rel=1e-3)
    assert followers(bound, 4 * np.pi, None) == 16
    assert followers(bound, 4 * np.pi, 3) == 3
    dense = replace(bound, width=100 * bound.width)
    assert followers(dense, 4 * np.pi, None) == 0
    more = filled(bound, 3, 0)
    assert more.count == 1200
    # Followers lie between guides: near the ball, as long, and not on top of each other.
    again = bind("b", more, ball)
    assert again.count == 1200
    assert 0.18 < np.quantile(again.length, 0.05) <= again.length.max() < 0.21


def test_the_distance_of_samples_is_that_of_another_library() -> None:
    rng = np.random.default_rng(0)
    one, two = rng.random(70), rng.random(50) ** 2
    assert distance(one, two) == pytest.approx(ks_2samp(one, two).statistic)


def test_hairs_are_added_gradually(ball: Surface) -> None:
    """A little thinner strands never make the fur much denser; few of them are filled to twice the skin."""
    points = strands(1000)
    area = 4 * np.pi
    filled_to = []
    for share in np.geomspace(0.05, 1.0, 40):
        widths = np.full(points.shape[:2], share * area / (1000 * 0.2), np.float32)
        bound = bind("a", replace(curves(points), widths=widths.ravel()), ball)
        filled_to.append(share * (1 + followers(bound, area, None)))
    assert filled_to[-1] == 1.0
    assert max(filled_to) < 2.3
    assert filled_to[0] > 0.8
    # One hair more beside each is the least step.
    assert np.max(np.array(filled_to[:-1]) / filled_to[1:]) < 2
    assert followers(bound, area, 5) == 5


def test_a_bake_wears_the_groom(baked: Path) -> None:
    assert validate(baked) == []
    asset = read_asset(baked)
    record = asset.record["groom"]
    assert record["strands"] == 3000
    assert record["follow"] == 3
    found = groom(baked)
    lengths = np.linalg.norm(np.diff(found.points, axis=1), axis=2).sum(axis=1)
    assert np.median(lengths) == pytest.approx(0.2, rel=0.1)
    chord = found.points[:, -1] - found.points[:, 0]
    root = found.points[:, 0] / np.linalg.norm(found.points[:, 0], axis=1, keepdims=True)
    lean = np.arccos(np.clip(np.einsum("ij,ij->i", chord, root) / np.linalg.norm(chord, axis=1), -1, 1))
    assert np.degrees(np.median(lean)) == pytest.approx(53, abs=8)
    down = np.array([0.0, -1.0, 0.0]) + root * root[:, 1:2]
    beside = np.abs(root[:, 1]) < 0.6
    cosine = np.einsum("ij,ij->i", chord, down) / (
        np.linalg.norm(down, axis=1) * np.linalg.norm(chord, axis=1) * np.sin(lean)
    )
    assert np.degrees(np.arccos(np.clip(cosine[beside], -1, 1))).mean() < 12
    upper, lower = found.colour[root[:, 1] > 0.3].mean((0, 1)), found.colour[root[:, 1] < -0.3].mean((0, 1))
    assert np.allclose(upper, (0.4, 0.2, 0.1), atol=0.03)
    assert np.allclose(lower, (0.1, 0.1, 0.3), atol=0.03)
    assert len(found.points) == pytest.approx((1 + record["follow"]) * 3000, rel=0.15)


def test_the_artists_strands_are_the_truth(baked: Path, files: Path) -> None:
    asset = read_asset(baked)
    options = BakeOptions(groom=str(files / "groom.npz"), follow=0)
    found = artist_strands(asset, options)
    assert np.allclose(found.points, strands(3000), atol=1e-3)


def test_held_out_strands_judge_the_fields(baked: Path) -> None:
    found = held_out(baked)
    assert found.held == 600
    assert found.angle < 5
    assert found.length < 0.02
    assert found.density < 0.15


def test_the_report_shows_groom_and_tile(baked: Path) -> None:
    record = json.loads((baked / "bake.json").read_text())
    page = groom_section(record)
    assert all(f"<b>{name}</b>" in page for name in ("length", "lean", "curl", "width", "clump"))
    traits = record["groom"]["traits"]
    for name in ("length", "lean", "width"):
        trait = traits[name]
        middles = np.linspace(trait["low"], trait["high"], 2 * len(trait["groom"]) + 1)[1::2]
        assert middles @ trait["tile"] == pytest.approx(middles @ trait["groom"], rel=0.15)
    assert sum(traits["length"]["tile"]) == pytest.approx(1, abs=1e-3)
    assert groom_section({}) == ""


def test_a_stage_brings_its_own_body(run: Any, tmp_path: Path) -> None:
    pytest.importorskip("pxr", reason="usd-core reads USD")
    shape = trimesh.creation.icosphere(2)
    rows = ", ".join("({:.9g}, {:.9g}, {:.9g})".format(*row) for row in shape.vertices)
    mesh = (
        f'def Mesh "ball"\n{{\n int[] faceVertexCounts = {[3] * len(shape.faces)}\n'
        f" int[] faceVertexIndices = {shape.faces.reshape(-1).tolist()}\n point3f[] points = [{rows}]\n}}"
    )
    told = {"float[] widths": '[0.05] (\n interpolation = "constant"\n)'}
    path = usda(tmp_path / "all.usda", strands(400), "", mesh, **told)
    done = run("bake", "-o", str(tmp_path / "out"), "--groom", str(path), *TINY, "--no-cache")
    assert done.status == 0, done.err
    assert "400 strands, roots" in done.err
    again = run("bake", "-o", str(tmp_path / "out"), "--groom", str(path), *TINY, "--no-cache", "--if-stale")
    assert again.out.endswith("up to date\n")


def test_a_bake_without_a_body_says_so(run: Any) -> None:
    assert run("bake", "-o", "out").err == "furbake: error: MODEL: missing, expected furbake bake MODEL -o DIR\n"
    assert "MODEL: missing, and a.npz holds strands alone" in run("bake", "-o", "out", "--groom", "a.npz").err


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"follow": 3}, "follow: got 3 without a groom"),
        ({"groom": "a.npz", "follow": 99}, "follow: got 99, expected 0 to 64"),
        ({"groom": "a.npz", "length": 2.0}, "length: got 2.0 beside a groom, expected the strands' own"),
        ({"groom": "a.npz", "comb": "a.json"}, "comb: got 'a.json' beside a groom"),
        ({"groom": "a.npz", "flat": True}, "groom: got it with --uv own or --flat"),
    ],
)
def test_options_that_a_groom_says_by_itself_are_refused(change: dict[str, Any], message: str) -> None:
    with pytest.raises(OptionError) as caught:
        replace(BakeOptions(), **change).check()
    assert str(caught.value).startswith(message)
