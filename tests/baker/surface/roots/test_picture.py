"""The picture of the roots shows at every place of the shells what the model shows there."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from furbake import BakeOptions, bake
from furbake.asset.gltf import FurModel, write_gltf
from furbake.asset.read import read_asset
from furbake.asset.roots.read import read_roots
from furbake.asset.stored import read_pelt
from furbake.asset.validate import validate
from furbake.surface.colours import LINEAR, as_png, decode, smaller
from furbake.surface.material import CLAMP, REPEAT, Material, Skin
from furbake.surface.mesh import Surface, simplify
from furbake.surface.place.fins import build_fins
from furbake.surface.place.vertex_fur import VertexFur
from furbake.surface.roots.layout import laid_out, patches_of
from furbake.surface.roots.look import BaseColours, nearest_on_skin, spread
from furbake.surface.roots.picture import picture_of_roots
from furbake.surface.roots.raster import drawn
from furbake.surface.shapes import builtin
from helpers.gltf import lapped

DRIFT = np.array([0.05, 0.3])
SIDE = 64


def plane_like(points: np.ndarray) -> np.ndarray:
    """Coordinates of a picture that is projected along z."""
    return np.asarray(0.5 + 0.45 * points[:, :2] / np.abs(points).max())


def ramps() -> np.ndarray:
    """Red grows to the right, green downwards."""
    pixels = np.full((SIDE, SIDE, 4), 255, dtype=np.uint8)
    pixels[..., 0] = np.linspace(60, 240, SIDE)[None]
    pixels[..., 1] = np.linspace(80, 220, SIDE)[:, None]
    pixels[..., 2] = 128
    return pixels


def expected(uv: np.ndarray) -> np.ndarray:
    """(n, 3) linear colours of `ramps`."""
    at = np.clip(uv * SIDE - 0.5, 0, SIDE - 1)
    red, green = (np.interp(at[:, i], np.arange(SIDE), LINEAR[line]) for i, line in enumerate(lines()))
    return np.column_stack([red, green, np.full(len(uv), LINEAR[128])])


def lines() -> tuple[np.ndarray, np.ndarray]:
    return ramps()[0, :, 0], ramps()[:, 0, 1]


@pytest.fixture(scope="module")
def sphere() -> Surface:
    """Two materials: one side is painted by a picture and darkened, the other by another picture and its vertices."""
    bare = builtin("sphere")
    side = bare.vertices[bare.faces].mean(axis=1)[:, 2] > 0
    pieces = []
    for mine, factor, paint in ((side, 0.5, None), (~side, 1.0, 0.8)):
        source, index = np.unique(bare.faces[mine], return_inverse=True)
        uv = plane_like(bare.vertices)[source] + (0.0 if paint is None else 3.0)
        colour = None if paint is None else np.tile([paint, 1.0, 1.0, 1.0], (len(source), 1))
        wrap = (CLAMP, CLAMP) if paint is None else (REPEAT, REPEAT)
        material = Material(factor=(factor, 1.0, 1.0, 1.0), picture=as_png(ramps()), wrap=wrap)
        pieces.append(Skin(material, source, index.reshape(-1, 3), uv, colour))
    grey = np.linspace(0.1, 0.9, len(bare.vertices))[:, None] * np.ones(3)
    return replace(bare, skin=tuple(pieces), colours=grey)


def seen(surface: Surface, places: np.ndarray) -> np.ndarray:
    """Colours that the model shows at places of its skin."""
    colour = expected(0.5 + 0.45 * places[:, :2] / np.abs(surface.vertices).max())
    return colour * np.where(places[:, 2:] > 0, [0.5, 1, 1], [0.8, 1, 1])


def random_places(faces: int, count: int = 4000) -> tuple[np.ndarray, np.ndarray]:
    random = np.random.default_rng(1)
    return random.integers(faces, size=count), random.dirichlet([1, 1, 1], size=count)


def test_patches_have_places_of_their_own(sphere: Surface) -> None:
    charts = lapped(sphere)
    uv = laid_out(charts, DRIFT).uv
    moved = uv - charts.uv
    np.testing.assert_allclose(moved, np.rint(moved), atol=1e-9)
    assert uv.min() >= 0
    patches, patch = patches_of(charts)
    fine, owner = 16, np.full((int(np.ceil(uv.max() * 16)) + 8,) * 2, -1)
    for one in range(patches):
        faces = charts.faces[patch[charts.faces[:, 0]] == one]
        for step in (0.0, 0.5, 1.0):
            for _, row, column, _ in drawn((uv[faces] - step * DRIFT) * fine, owner.shape):
                assert set(np.unique(owner[row, column])) <= {-1, one}
                owner[row, column] = one
    assert patches > 1


@pytest.mark.parametrize("simpler", [False, True])
def test_every_place_has_the_colour_of_the_model(sphere: Surface, simpler: bool) -> None:
    """Also where the ground is a simpler copy of the skin."""
    ground = simplify(sphere, 700) if simpler else sphere
    charts = lapped(ground)
    roots = picture_of_roots(sphere, ground, charts, DRIFT, 64)
    pixels = decode(roots.picture)
    assert pixels is not None
    assert max(pixels.shape) <= 1024
    face, shares = random_places(len(charts.faces))
    corners = charts.faces[face]
    places = np.einsum("nc,nck->nk", shares, ground.vertices[charts.source[corners]])
    uv = np.einsum("nc,nck->nk", shares, roots.uv[corners]) * roots.scale
    column, row = np.minimum((uv * pixels.shape[1::-1]).astype(int), np.array(pixels.shape[1::-1]) - 1).T
    off = np.abs(LINEAR[pixels[row, column, :3]] - seen(sphere, places))
    inside = np.abs(places[:, 2]) > 0.06 * np.abs(sphere.vertices).max()  # the border of the materials is sharp
    assert np.percentile(off[inside], 99) < (0.03 if simpler else 0.012)
    assert inside.mean() > 0.9


@pytest.mark.parametrize("drift", [np.array([0.1, 0.9]), np.array([-0.8, 0.3])])
def test_roots_beyond_a_patch_have_the_colour_of_the_skin_there(sphere: Surface, drift: np.ndarray) -> None:
    """As far from a place of the patch as its hairs stand aside of their roots, along a great circle.

    The nearest colour of the patch is .023 off.
    """
    charts = lapped(sphere)
    roots = picture_of_roots(sphere, sphere, charts, drift, 64)
    pixels = decode(roots.picture)
    assert pixels is not None
    face, shares = random_places(len(charts.faces))
    corners = charts.faces[face]
    places, uv = (
        np.einsum("nc,nck->nk", shares, numbers[corners]) for numbers in (sphere.vertices[charts.source], roots.uv)
    )
    edges = charts.uv[corners[:, 1:]] - charts.uv[corners[:, :1]]
    sides = sphere.vertices[charts.source[corners[:, 1:]]] - sphere.vertices[charts.source[corners[:, :1]]]
    step = -np.einsum("nij,nj->ni", np.linalg.solve(edges, sides).transpose(0, 2, 1), np.tile(drift, (len(face), 1)))
    radius = np.linalg.norm(places, axis=1, keepdims=True)
    angle = np.linalg.norm(step, axis=1, keepdims=True) / radius
    moved = np.cos(angle) * places + radius * np.sin(angle) * step / np.linalg.norm(step, axis=1, keepdims=True)
    column, row = ((uv - drift) * roots.scale * pixels.shape[1::-1]).astype(int).T
    off = np.abs(LINEAR[pixels[row, column, :3]] - seen(sphere, moved))
    inside = np.abs(moved[:, 2]) > 0.12 * np.abs(sphere.vertices).max()
    assert np.percentile(off[inside], 95) < 0.01


def test_what_lies_between_islands_does_not_show() -> None:
    """Triangles of one colour in a picture of another, without any margin."""
    pixels = np.zeros((32, 32, 3), dtype=np.uint8) + np.array([255, 0, 255], dtype=np.uint8)
    corners = np.array([[[0.1, 0.1], [0.9, 0.13], [0.15, 0.9]]])
    for _, row, column, _ in drawn(corners * 32, (32, 32)):
        pixels[row, column] = [0, 255, 0]
    skin = Skin(Material(picture=as_png(pixels)), np.arange(3), np.array([[0, 1, 2]]), corners[0])
    surface = Surface(np.eye(3), np.array([[0, 1, 2]]), np.eye(3), skin=(skin,))
    shares = random_places(1)[1]
    green = BaseColours(surface).at(nearest_on_skin(surface, shares))
    np.testing.assert_allclose(green, np.tile([0, 1, 0], (len(shares), 1)), atol=1e-9)
    assert (spread(pixels, [corners]) != pixels).any()


def test_the_smaller_of_two_encodings() -> None:
    flat = np.zeros((64, 64, 3), dtype=np.uint8)
    noise = np.random.default_rng(2).integers(0, 256, (64, 64, 3)).astype(np.uint8)
    assert (smaller(flat).kind, smaller(noise).kind) == ("image/png", "image/jpeg")


@pytest.mark.parametrize("stored", [False, True])
def test_a_folder_with_a_picture_of_its_roots(sphere: Surface, tmp_path: Path, stored: bool) -> None:
    bake("sphere", tmp_path / "baked", BakeOptions(layers=4, size=8, lights=8))
    pelt = read_pelt(read_asset(tmp_path / "baked"))
    charts = lapped(sphere)
    roots = picture_of_roots(sphere, sphere, charts, DRIFT, 16)
    fins = build_fins(sphere, np.cross(sphere.normals, [0.3, 0.2, 0.9]), 0.2)
    fur = VertexFur.even(len(sphere.vertices))
    fur = replace(fur, colour=sphere.colours)
    model = FurModel(sphere, charts, fur, (pelt,), 0.12, fins=fins, roots=roots)
    write_gltf(tmp_path, model, compress=not stored)
    asset = read_asset(tmp_path)
    assert asset.fur["version"] == "2.3"
    assert [problem for problem in validate(tmp_path) if "bake.json" not in problem] == []
    read = read_roots(asset)
    assert read is not None
    np.testing.assert_allclose(read.scale, roots.scale, rtol=1e-8)
    if not stored:
        assert "edges" in asset.fur
        return
    attributes = asset.primitive(asset.fur["fins"])["attributes"]
    place = asset.accessor(attributes["TEXCOORD_1"]) / 65535.0
    ends = place.reshape(-1, 4, 2)
    np.testing.assert_array_equal(ends[:, :2], ends[:, 2:])
    colour = read.colours(place / read.scale)
    away = np.abs(sphere.vertices[fins.source][:, 2]) > 0.1
    off = np.abs(colour - seen(sphere, sphere.vertices[fins.source]))[away]
    assert np.percentile(off, 99) < 0.05
