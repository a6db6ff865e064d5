"""A groom's plainly different places become regions, and even ones do not; the truth is how the strands were made."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

from furbake.asset.read import read_asset
from furbake.asset.validate import validate
from furbake.body.groomed import combed_by
from furbake.groom.strands import groom
from furbake.imported.parts import parts_of
from furbake.options import BakeOptions, OptionError
from furbake.pipeline import bake
from furbake.show.report.groom import groom_section
from furbake.study.grooms import artist_strands
from furbake.surface.mesh import Surface, clean
from helpers.command import TINY
from helpers.grooms import strands

BAKE = {"layers": 4, "size": 8, "lights": 8, "max_faces": 2000}

MANE, FLANK = 0.3, 0.08
"""Lengths of the hairs above and below the plane y = .2."""


@pytest.fixture(scope="module")
def ball() -> Surface:
    shape = trimesh.creation.icosphere(4)
    return clean("ball", shape.vertices, shape.faces)


def even(folder: Path, seed: int = 0) -> str:
    """Hairs of lengths by chance, the same everywhere."""
    rng = np.random.default_rng(seed)
    points = strands(3000)
    points = points[:, :1] + rng.uniform(0.6, 1.4, (3000, 1, 1)) * (points - points[:, :1])
    np.savez(folder / "even.npz", points=points, widths=np.full(points.shape[:2], 0.02))
    return str(folder / "even.npz")


def parted(folder: Path) -> str:
    """Long upright curled hairs above, short straight ones laid flat below."""
    points = strands(3000, 1.0)
    root, way = points[:, :1], points - points[:, :1]
    up = root * np.linalg.norm(way, axis=2, keepdims=True)
    turn = 12 * np.linspace(0, 1, points.shape[1])[None, :, None]
    side = np.cross(root[:, 0], way[:, -1])[:, None]
    curled = up + 0.15 * (np.sin(turn) * side + (np.cos(turn) - 1) * np.cross(root, side))
    above = root[:, 0, 1] > 0.2
    points = root + np.where(above[:, None, None], MANE * curled, FLANK * way)
    np.savez(folder / "parted.npz", points=points, widths=np.full(points.shape[:2], 0.02))
    return str(folder / "parted.npz")


def test_two_plainly_different_places_are_told_apart(ball: Surface, tmp_path: Path) -> None:
    options = BakeOptions(groom=parted(tmp_path), regions="auto", follow=0)
    fields = combed_by(str(options.groom), options, ball, ball).fields
    found = parts_of(ball, fields, None, 0)
    assert found.count == 2
    y = ball.vertices[:, 1]
    assert (found.of[y < 0.1] == 0).all()
    assert (found.of[y > 0.3] == 1).all()
    assert np.array_equal(parts_of(ball, fields, None, 0).of, found.of)
    assert parts_of(ball, fields, 1, 0).count == 1


@pytest.mark.parametrize("steady", [False, True])
def test_even_and_steadily_changing_grooms_stay_in_one_piece(ball: Surface, tmp_path: Path, steady: bool) -> None:
    options = BakeOptions(groom=even(tmp_path), follow=0)
    fields = combed_by(str(options.groom), options, ball, ball).fields
    if steady:
        fields = replace(fields, length=0.2 * np.exp2(2 * ball.vertices[:, 1]))
    found = parts_of(ball, fields, None, 0)
    assert found.count == 1
    assert found.rms > 0.5 if steady else found.rms < 0.5


def test_no_part_is_asked_for_in_vain(ball: Surface, tmp_path: Path) -> None:
    options = BakeOptions(groom=parted(tmp_path), follow=0)
    fields = combed_by(str(options.groom), options, ball, ball).fields
    for asked in (2, 3, 4):
        found = parts_of(ball, fields, asked, 0)
        assert 2 <= found.count <= asked
        assert np.array_equal(np.unique(found.of), np.arange(found.count))


@pytest.fixture(scope="module")
def baked(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("parted")
    trimesh.creation.icosphere(3).export(folder / "ball.obj")
    options = BakeOptions(groom=parted(folder), regions="auto", follow=0, **BAKE)
    result = bake(str(folder / "ball.obj"), folder / "out", options)
    (folder / "told.txt").write_text("\n".join(result.notices), "utf-8")
    return folder / "out"


def test_regions_of_a_groom_are_baked_and_told(baked: Path) -> None:
    assert validate(baked) == []
    told = (baked.parent / "told.txt").read_text("utf-8")
    assert "groom: 2 regions (" in told
    record = json.loads((baked / "bake.json").read_text("utf-8"))
    assert [fur["name"] for fur in record["regions"]] == ["region1"]
    assert record["regions"][0]["covers"] == pytest.approx(0.4, abs=0.04)  # of a ball, what is above .2 of its radius
    shown = groom_section(record)
    assert shown.count("<h3>") == 2
    assert (baked / "strands-1.npz").is_file()


def test_each_region_wears_the_strands_of_its_own_place(baked: Path) -> None:
    found = groom(baked)
    truth = artist_strands(read_asset(baked), BakeOptions(follow=0), baked.parent / "parted.npz")
    for made in (found, truth):
        y = made.points[:, 0, 1]
        chord = made.points[:, -1] - made.points[:, 0]
        straight = np.linalg.norm(chord, axis=1)
        normal = made.points[:, 0] / np.linalg.norm(made.points[:, 0], axis=1, keepdims=True)
        upright = np.einsum("ij,ij->i", chord, normal) / straight
        above, below = y > 0.35, y < 0.05
        assert np.median(straight[above]) == pytest.approx(MANE, rel=0.25)
        assert np.median(straight[below]) == pytest.approx(FLANK, rel=0.15)
        assert np.median(upright[above]) > 0.85
        assert np.median(upright[below]) == pytest.approx(0.6, abs=0.12)


def test_several_furs_of_a_groom_have_the_strands_of_one_groom(baked: Path, run: Any) -> None:
    held = run("verify", baked, "--groom", baked.parent / "parted.npz", "--json")
    assert held.status == 0
    assert json.loads(held.out)["strands"] == 3000
    (baked / "strands-1.npz").rename(baked / "away.npz")
    try:
        broken = run("groom", baked, "-o", baked.parent / "hairs.npz")
    finally:
        (baked / "away.npz").rename(baked / "strands-1.npz")
    assert broken.status != 0
    assert "strands-1.npz cannot be read" in broken.err


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"regions": "auto"}, "regions: got auto without a groom, expected a .toml file of them"),
        ({"regions": "2"}, "regions: got 2 without a groom, expected a .toml file of them"),
        ({"regions": "ruff.toml", "groom": "a.npz"}, "regions: got ruff.toml beside a groom, expected auto or 1 to 4"),
        ({"regions": "5", "groom": "a.npz"}, "regions: got 5 beside a groom, expected auto or 1 to 4"),
        (
            {"regions": "auto", "groom": "a.npz", "basis": "eigen", "coefficients": 4},
            "regions: got basis eigen beside them",
        ),
    ],
)
def test_regions_that_cannot_be_get_one_sentence(change: dict[str, Any], message: str) -> None:
    with pytest.raises(OptionError) as caught:
        BakeOptions(**change).check()
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


def test_the_command_takes_the_number_of_regions(baked: Path, run: Any, tmp_path: Path) -> None:
    body, hairs = baked.parent / "ball.obj", baked.parent / "parted.npz"
    command = ["bake", body, "-o", tmp_path / "out", "--groom", hairs, "--follow", "0", *TINY, "--json", "--no-cache"]
    made = run(*command, "--regions", "1")
    assert made.status == 0
    assert "regions" not in json.loads(made.out)
    again = run(*command, "--regions", "1", "--if-stale")
    assert json.loads(again.out)["baked"] is False
