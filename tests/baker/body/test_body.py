from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

from furbake.body.body import prepare
from furbake.body.strokes import read_strokes
from furbake.options import BakeOptions
from furbake.surface.mesh import MeshError
from furbake.surface.place.occlusion import openness
from furbake.surface.place.variation import noise, underside
from furbake.surface.shapes import builtin


def body(**options: Any) -> Any:
    return prepare("sphere", BakeOptions(**options))


def test_lapped_is_the_default_and_own_the_shapes_own() -> None:
    lapped, own = (prepare("torus:24x32", BakeOptions(uv=uv)) for uv in ("lapped", "own"))
    assert len(lapped.charts.faces) > len(own.charts.faces) == 24 * 32 * 2
    along = own.charts.tangents[:, 3:] * np.cross(own.ground.normals[own.charts.source], own.charts.tangents[:, :3])
    np.testing.assert_allclose(own.direction[own.charts.source], along, atol=1e-6)


def test_length_is_what_all_its_knobs_say() -> None:
    plain, uneven = body(), body(length_noise=0.4, seed=3)
    assert (plain.fur.lengths == 1).all()
    assert uneven.fur.lengths.min() == pytest.approx(0.6, abs=0.01)
    assert uneven.fur.lengths.max() == pytest.approx(1.0, abs=0.01)
    assert plain.length == plain.tile * 0.5


def test_vertex_colours_paint_length_and_mask(tmp_path: Path) -> None:
    ball = trimesh.creation.icosphere(subdivisions=3)
    red = np.clip(128 + 200 * ball.vertices[:, 1], 0, 255).astype(np.uint8)
    ball.visual.vertex_colors = np.column_stack([red, red, red, np.full(len(red), 255)])
    ball.export(tmp_path / "ball.ply")
    model = str(tmp_path / "ball.ply")
    shorn = prepare(model, BakeOptions(length_map="vertex:red"))
    up = shorn.ground.vertices[:, 1]
    assert shorn.fur.lengths[up > 0.7].min() == 1
    assert shorn.fur.lengths[up < -0.7].max() < 0.02
    bald = prepare(model, BakeOptions(mask="vertex:red"))
    assert len(bald.ground.faces) < len(bald.skin.faces)
    assert bald.ground.vertices[:, 1].min() > -0.8


def test_belly_and_noise_choose_the_second_tip_colour() -> None:
    fur = body(belly=1.0).fur
    up = body().ground.normals[:, 1]
    assert fur.tip[up < -0.8].min() > 0.95
    assert fur.tip[up > 0.2].max() == 0
    assert (body().fur.tip == 0).all()
    assert body(tip_noise=0.5).fur.tip.max() == pytest.approx(0.5, abs=0.01)


def test_fur_makes_room_for_features(tmp_path: Path) -> None:
    eye = {"name": "eye", "shape": "ellipsoid", "centre": [0, 0, 1], "radii": [0.1, 0.1, 0.1], "on": True}
    (tmp_path / "f.json").write_text(json.dumps({"features": [{**eye, "colour": [0, 0, 0], "roughness": 0.1}]}))
    seeing = body(features=str(tmp_path / "f.json"))
    off = np.linalg.norm(seeing.ground.vertices - [0, 0, 1], axis=1)
    assert seeing.fur.lengths[off < 0.05].max() < 0.3
    assert seeing.fur.lengths[off > 0.5].min() == 1
    assert len(seeing.features) == 1


def test_sweep_combs_along_the_fur() -> None:
    swept = body(sweep=0.5)
    comb = np.einsum("ij,ij->i", swept.fur.comb, swept.direction)
    assert comb.max() == pytest.approx(0.5, abs=1e-6)
    assert np.median(comb) > 0.4
    assert (body().fur.comb == 0).all()


def test_fur_follows_strokes(tmp_path: Path) -> None:
    angle = np.radians(np.linspace(0, 60, 20))
    line = np.stack([np.sin(angle), 0 * angle, np.cos(angle)], 1)  # along +x at the front, where fur hangs down
    (tmp_path / "s.json").write_text(json.dumps({"strokes": [{"points": line.tolist()}]}))
    combed = body(comb=str(tmp_path / "s.json"))
    near = np.argmin(np.linalg.norm(combed.ground.vertices[:, None] - line[None, 10], axis=2), axis=0)
    way = line[11] - line[9]
    assert combed.direction[near][0] @ way / np.linalg.norm(way) > 0.9


@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        ("[]", r's\.json: no list of strokes, expected {"strokes": '),
        ("{}", r's\.json: no list of strokes, expected {"strokes": '),
        ("", r"s\.json: not JSON \("),
        ('{"strokes": []}', "0 strokes, expected 1 to 1000"),
        ('{"strokes": [3]}', "stroke 1 is not a line of points"),
        ('{"strokes": [{"points": [[0, 0, "a"], [1, 0, 0]]}]}', "stroke 1 is not a line of points"),
        ('{"strokes": [{"points": [[0, 0, 1], [0, 0, 1]]}]}', "stroke 1 has no length, expected two or more different"),
        ('{"strokes": [{"points": [[0, 0, 0]]}]}', "stroke 1 is not a line of points"),
        ('{"strokes": [{"points": [[0, 0, 0], [1, 0, NaN]]}]}', "stroke 1 is not a line of points"),
        ('{"strokes": [{"points": [[0, 0, 0], [1, 0, 0]], "strength": 2}]}', "stroke 1 has the strength 2"),
    ],
)
def test_strokes_that_are_none(tmp_path: Path, text: str, wrong: str) -> None:
    (tmp_path / "s.json").write_text(text)
    with pytest.raises(MeshError, match=wrong):
        read_strokes(tmp_path / "s.json")


def test_strokes_far_from_the_body_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "s.json"
    for far, refused in ((1.3, False), (1.5, True)):
        path.write_text(json.dumps({"strokes": [{"points": [[far, 0, 0], [far + 9, 1, 0]]}]}))
        if not refused:
            body(comb=str(path))
            continue
        with pytest.raises(MeshError) as error:
            body(comb=str(path))
        assert str(error.value) == (
            f"{path}: stroke 1 is far from the body, expected points on it, in (-1, -1, -1) to (1, 1, 1)"
        )


def test_openness_is_the_share_of_the_sky_that_is_seen() -> None:
    assert openness(builtin("sphere")).min() > 0.99
    torus = builtin("torus")
    seen = openness(torus)
    ring = np.hypot(torus.vertices[:, 0], torus.vertices[:, 2])
    assert seen[ring < 0.45].mean() < 0.85
    assert seen[ring > 0.95].mean() > 0.99


def test_noise_is_smooth_and_evenly_spread() -> None:
    surface = builtin("sphere")
    values = noise(surface, 5)
    assert sorted(values) == pytest.approx((np.arange(len(values)) + 0.5) / len(values))
    step = np.abs(np.diff(values[surface.faces], axis=1))
    assert np.percentile(step, 95) < 0.2
    assert (noise(surface, 6) != values).any()
    assert underside(surface)[surface.normals[:, 1] > 0.1].max() == 0
