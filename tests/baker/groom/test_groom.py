from __future__ import annotations

import json
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from furbake import BakeOptions
from furbake.asset.read import AssetError, read_asset
from furbake.groom.files import GroomError, write_groom
from furbake.groom.ground import Ground, neighbours, read_ground
from furbake.groom.roots import barycentric, place_roots
from furbake.groom.strands import Groom, groom, on_body
from furbake.groom.walk import walk
from furbake.pelt.hairs.ramp import Ramp
from furbake.pelt.hairs.strands import Coat, Hairs, Strands, grow
from furbake.pelt.hairs.tiling import scattered_points
from furbake.pipeline import bake


def square(cells: int, tiles: float, turn: float = 0.0, shift: tuple[float, float] = (0.0, 0.0)) -> Ground:
    """One patch on the square [0, 1]² in x and y, uv turned by `turn` radians."""
    x, y = (grid.reshape(-1) for grid in np.meshgrid(*[np.linspace(0, 1, cells + 1)] * 2, indexing="ij"))
    count = len(x)
    corner = np.arange(count).reshape(cells + 1, cells + 1)
    a, b, c, d = (part.reshape(-1) for part in (corner[:-1, :-1], corner[1:, :-1], corner[1:, 1:], corner[:-1, 1:]))
    faces = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    turned = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    places = np.stack([x, y, 0 * x], 1)
    uv = tiles * places[:, :2] @ turned + np.array(shift)
    beside, across = neighbours(places, uv, faces)
    return Ground(
        vertices=places,
        normals=np.tile([0.0, 0.0, 1.0], (count, 1)),
        tangents=np.tile([1.0, 0.0, 0.0], (count, 1)),
        bitangents=np.tile([0.0, 1.0, 0.0], (count, 1)),
        uv=uv,
        faces=faces,
        weight=np.ones(count),
        reach=np.full(count, 0.1),
        comb=np.zeros((count, 3)),
        tip=np.zeros(count),
        colour=np.ones((count, 3)),
        beside=beside,
        shift=across,
        surface=np.arange(len(faces)),
        tile=1 / tiles,
    )


def both(one: Ground, two: Ground) -> Ground:
    """Two patches of the same faces."""
    count, faces = len(one.vertices), len(one.faces)
    joined = {
        name: np.concatenate([getattr(one, name), getattr(two, name)])
        for name in (
            "vertices",
            "normals",
            "tangents",
            "bitangents",
            "uv",
            "weight",
            "reach",
            "comb",
            "tip",
            "colour",
            "shift",
        )
    }
    return Ground(
        **joined,
        faces=np.concatenate([one.faces, two.faces + count]),
        beside=np.concatenate([one.beside, np.where(two.beside < 0, -1, two.beside + faces)]),
        surface=np.concatenate([one.surface, two.surface]),
        tile=one.tile,
    )


SEEDS = scattered_points(100, np.random.default_rng(0))
KINDS = np.repeat([0, 1], [30, 70])


def test_a_patch_has_a_tile_of_hairs_per_tile_of_skin() -> None:
    roots = place_roots(square(7, 6.0), SEEDS, KINDS, 0)
    assert len(roots.hair) == 36 * 100, "six by six whole tiles"
    np.testing.assert_array_equal(np.bincount(roots.hair), 36)
    for_each = np.unique(np.column_stack([roots.hair, np.floor(roots.uv)]), axis=0)
    assert len(for_each) == len(roots.hair), "no root stands twice, none is left out"


def test_weights_thin_hairs_of_each_kind_to_their_sum() -> None:
    ground = square(5, 10.0, 0.3)
    faded = replace(ground, weight=ground.vertices[:, 0])
    roots = place_roots(faded, SEEDS, KINDS, 0)
    whole = place_roots(ground, SEEDS, KINDS, 0)
    shares = barycentric(ground, whole.face, whole.uv)
    x = np.einsum("ij,ij->i", shares, ground.vertices[ground.faces[whole.face], 0])
    for kind in (0, 1):
        kept, wanted = (KINDS[roots.hair] == kind).sum(), x[KINDS[whole.hair] == kind].sum()
        assert abs(kept - wanted) <= 1
    halves = [((x < 0.5) == left).sum() for left in (True, False)]
    kept_x = np.einsum(
        "ij,ij->i", barycentric(ground, roots.face, roots.uv), ground.vertices[ground.faces[roots.face], 0]
    )
    assert (kept_x < 0.5).sum() / halves[0] == pytest.approx(0.25, abs=0.01)
    assert (kept_x >= 0.5).sum() / halves[1] == pytest.approx(0.75, abs=0.01)


def test_patches_that_overlap_have_as_many_hairs_as_one() -> None:
    one, two = square(6, 8.0, 0.2), square(6, 8.0, 1.1, (0.3, 0.7))
    blend = one.vertices[:, 1]
    laid = both(replace(one, weight=blend), replace(two, weight=1 - blend))
    roots = place_roots(laid, SEEDS, KINDS, 3)
    assert len(roots.hair) == pytest.approx(64 * 100, rel=0.01)
    places = np.einsum("ij,ijk->ik", barycentric(laid, roots.face, roots.uv), laid.vertices[laid.faces[roots.face]])
    count = np.histogram(places[:, 1], bins=8, range=(0, 1))[0]
    assert count == pytest.approx(800, rel=0.06), "everywhere, not on the mean alone"


def test_a_walk_ends_where_the_place_is_and_beyond_the_patch_in_its_plane() -> None:
    ground = square(9, 3.0, 0.5)
    chance = np.random.default_rng(1)
    face = chance.integers(0, len(ground.faces), 400)
    inside = chance.uniform(0, 1, (400, 2))
    turned = np.array([[np.cos(0.5), np.sin(0.5)], [-np.sin(0.5), np.cos(0.5)]])
    found, uv = walk(ground, face, 3.0 * inside @ turned)
    places = np.einsum("ij,ijk->ik", barycentric(ground, found, uv), ground.vertices[ground.faces[found]])
    np.testing.assert_allclose(places[:, :2], inside, atol=1e-9)
    assert (barycentric(ground, found, uv) >= -1e-6).all()
    outside = np.array([[1.3, 0.4], [-0.2, -0.1]])
    found, uv = walk(ground, face[:2], 3.0 * outside @ turned)
    places = np.einsum("ij,ijk->ik", barycentric(ground, found, uv), ground.vertices[ground.faces[found]])
    np.testing.assert_allclose(places[:, :2], outside, atol=1e-9)


def test_a_patch_that_closes_on_itself_is_walked_round() -> None:
    ring = 12
    angle = 2 * np.pi * np.arange(ring + 1) / ring
    low = np.stack([np.cos(angle), np.sin(angle), 0 * angle], 1).round(12)
    places = np.concatenate([low, low + np.array([0, 0, 1])])
    uv = np.concatenate([np.stack([np.arange(ring + 1) * 3 / ring, row + 0 * angle], 1) for row in (0.0, 0.5)])
    i = np.arange(ring)
    faces = np.concatenate([np.stack([i, i + 1, i + ring + 2], 1), np.stack([i, i + ring + 2, i + ring + 1], 1)])
    places[[ring, 2 * ring + 1]] = places[[0, ring + 1]]
    beside, shift = neighbours(places, uv, faces)
    flat = replace(square(1, 1.0), vertices=places, uv=uv, faces=faces, beside=beside, shift=shift)
    found, moved = walk(flat, np.zeros(1, np.int64), np.array([[4.1, 0.2]]))
    share = barycentric(flat, found, moved)
    assert (share >= -1e-9).all()
    at = 2 * np.pi * 4.1 / 3
    np.testing.assert_allclose(
        np.einsum("ij,ijk->ik", share, places[faces[found]])[0, :2], [np.cos(at), np.sin(at)], atol=0.05
    )


def test_points_stand_above_their_own_place_and_not_above_the_root() -> None:
    """On a slope of lengths: the tip of a hair that leans to where fur is longer is as high as fur is there."""
    ground = square(20, 2.0)
    longer = replace(ground, reach=0.1 + 0.2 * ground.vertices[:, 0])
    s = np.linspace(0, 1, 5)
    hair = np.stack([0.3 + 0.4 * s, 0.5 + 0 * s, 0.6 * s], 1)[None]
    ones = np.ones((1, 5))
    strands = Strands(hair, 0.01 * ones, 0.5 * ones, 0 * ones)
    grown = on_body(longer, strands, np.zeros(1, np.int64), 0.6, 0, Ramp())
    stands = grown.points[np.argmin(np.abs(grown.points[:, 0, :2] - [0.15, 0.25]).sum(1))].astype(float)
    np.testing.assert_allclose(stands[:, 0], 0.15 + 0.2 * s, atol=1e-6)
    np.testing.assert_allclose(stands[:, 2], s * (0.1 + 0.2 * stands[:, 0]), atol=1e-6)
    np.testing.assert_allclose(grown.radius, 0.005)


def test_combed_hairs_bend_as_the_format_says() -> None:
    ground = square(4, 2.0)
    comb = np.array([0.3, -0.4, 0.0])
    combed = replace(ground, comb=np.tile(comb, (len(ground.vertices), 1)))
    s = np.linspace(0, 1, 5)
    hair = np.stack([0.3 + 0 * s, 0.5 + 0 * s, 0.8 * s], 1)[None]
    ones = np.ones((1, 5))
    grown = on_body(combed, Strands(hair, ones, ones, ones), np.zeros(1, np.int64), 0.8, 0, Ramp())
    expected = 0.1 * (np.sqrt(0.75) * s[:, None] * [0, 0, 1] + (s**2)[:, None] * comb)
    np.testing.assert_allclose(grown.points[0] - grown.points[0, 0], expected, atol=1e-6)


def test_hairs_of_a_ball_are_as_many_and_as_high_as_the_ball_says(tmp_path: Path) -> None:
    hairs = Hairs(count=150, length=(1.0, 1.0), curl=0.0, stray=0.1, clump=0.0)
    coat = Coat(guard=hairs, under=replace(hairs, count=0), clumps=4, tufts=0.0)
    options = BakeOptions(layers=4, size=8, lights=8, coat=coat, tile=0.4, height=0.5, fins=False)
    bake("sphere", tmp_path / "a", options)
    grown = groom(tmp_path / "a")
    area = float(4 * np.pi / 0.4**2 * 150)
    assert len(grown.points) == pytest.approx(area, rel=0.015)
    away = np.linalg.norm(grown.points.astype(float), axis=-1) - 1
    strands = grow(coat, 0.5, 0)
    off = np.abs(away - 0.4 * strands.points[grown.hair, :, 2])
    assert np.quantile(off, 0.99) < 0.003
    assert off.max() < 0.03, "beyond a patch's end the skin is a plane"
    aside = np.linalg.norm(strands.points[grown.hair, -1, :2] - strands.points[grown.hair, 0, :2], axis=1)
    root, tip = (grown.points[:, i] / np.linalg.norm(grown.points[:, i], axis=1)[:, None] for i in (0, -1))
    arc = np.arccos(np.clip(np.einsum("ij,ij->i", root, tip), -1, 1))
    assert np.median(arc / (0.4 * aside)) == pytest.approx(1, abs=0.06), "patches are stretched a little"


def test_no_hair_stands_where_there_is_no_length(tmp_path: Path, tiny: BakeOptions) -> None:
    tiny = replace(tiny, uv="own", fins=False)
    features = {"features": [{"centre": [0, 0, 0], "radii": [0.2, 0.2, 0.2], "clear": 1.5}]}
    (tmp_path / "f.json").write_text(json.dumps(features))
    bake("plane", tmp_path / "a", replace(tiny, features=str(tmp_path / "f.json")))
    bake("plane", tmp_path / "b", tiny)
    bare, whole = groom(tmp_path / "a"), groom(tmp_path / "b")
    assert np.linalg.norm(whole.points[:, 0], axis=1).min() < 0.1
    assert np.linalg.norm(bare.points[:, 0], axis=1).min() > 0.15
    assert len(bare.points) < len(whole.points)


def test_the_same_folder_gives_the_same_strands(tmp_path: Path, tiny: BakeOptions) -> None:
    bake("plane:4x4", tmp_path / "a", tiny)
    one, two = groom(tmp_path / "a"), groom(tmp_path / "a")
    np.testing.assert_array_equal(one.points, two.points)
    np.testing.assert_array_equal(one.colour, two.colour)


def test_a_folder_without_options_is_refused(tmp_path: Path, tiny: BakeOptions) -> None:
    bake("plane:1x1", tmp_path / "a", tiny)
    (tmp_path / "a" / "bake.json").unlink()
    with pytest.raises(AssetError, match="no options"):
        groom(tmp_path / "a")


def test_copies_of_a_face_are_one_face_of_the_body(tmp_path: Path, tiny: BakeOptions) -> None:
    bake("sphere", tmp_path / "a", tiny)
    ground = read_ground(read_asset(tmp_path / "a"), (1.0, 1.0, 1.0))
    assert len(np.unique(ground.surface)) == 5120
    sums = np.zeros(5120)
    np.add.at(sums, ground.surface, ground.weight[ground.faces].mean(axis=1))
    np.testing.assert_allclose(sums, 1, atol=1e-6)


@pytest.fixture
def few() -> Groom:
    chance = np.random.default_rng(0)
    single = {name: chance.random((3, 5)).astype(np.float32) for name in ("radius", "tint")}
    triple = {name: chance.random((3, 5, 3)).astype(np.float32) for name in ("points", "colour")}
    return Groom(**single, **triple, hair=np.arange(3), face=np.arange(3))


def test_an_archive_holds_the_groom(tmp_path: Path, few: Groom) -> None:
    write_groom(tmp_path / "g.npz", few)
    with np.load(tmp_path / "g.npz") as kept:
        for name, values in vars(few).items():
            np.testing.assert_array_equal(kept[name], values)


def test_other_endings_are_refused(tmp_path: Path, few: Groom) -> None:
    with pytest.raises(GroomError, match=r"got g\.obj, expected"):
        write_groom(tmp_path / "g.obj", few)


def test_missing_usd_says_what_to_install(tmp_path: Path, few: Groom, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pxr", None)
    with pytest.raises(GroomError, match=r"pip install 'furbake\[groom\]'"):
        write_groom(tmp_path / "g.usdc", few)
    assert list(tmp_path.iterdir()) == []


def test_usd_holds_the_groom(tmp_path: Path, few: Groom) -> None:
    usd = pytest.importorskip("pxr.Usd")
    geometry = pytest.importorskip("pxr.UsdGeom")
    write_groom(tmp_path / "g.usdc", few)
    stage = usd.Stage.Open(str(tmp_path / "g.usdc"))
    curves = geometry.BasisCurves(stage.GetPrimAtPath("/fur"))
    assert list(curves.GetCurveVertexCountsAttr().Get()) == [5, 5, 5]
    np.testing.assert_array_equal(np.array(curves.GetPointsAttr().Get()), few.points.reshape(-1, 3))
    np.testing.assert_array_equal(np.array(curves.GetWidthsAttr().Get()), 2 * few.radius.reshape(-1))
    assert curves.GetBasisAttr().Get() == "catmullRom"
    assert [path.name for path in tmp_path.iterdir()] == ["g.usdc"]


def test_the_command_writes_a_groom(tmp_path: Path, tiny: BakeOptions, run) -> None:
    bake("plane:1x1", tmp_path / "a", tiny)
    done = run("groom", tmp_path / "a", "-o", tmp_path / "g.npz", "--json")
    assert done.status == 0
    told = json.loads(done.out)
    with np.load(tmp_path / "g.npz") as kept:
        assert told["hairs"] == len(kept["points"]) > 0
    refused = run("groom", tmp_path / "a", "-o", tmp_path / "g.txt", "--quiet")
    assert (refused.status, refused.err.count("\n")) == (2, 1)
