"""Lapped textures: every figure of the promise, on round, ringed, ragged and torn surfaces."""

from __future__ import annotations

import base64
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from furbake.surface.charts import Charts
from furbake.surface.lay.field import comb_field
from furbake.surface.lay.lapped import lap
from furbake.surface.lay.lapped_figures import lapped_figures
from furbake.surface.lay.sheet import cut
from furbake.surface.mesh import MeshError, Surface, clean, load_mesh
from furbake.surface.shapes import builtin

BUNNY = Path(__file__).parents[4] / "node_modules" / "@pmndrs" / "assets" / "models" / "bunny.glb.js"


@pytest.fixture(scope="module")
def bunny(tmp_path_factory: pytest.TempPathFactory) -> Surface:
    if not BUNNY.exists():
        pytest.skip("the npm packages are not installed")
    data = re.search(r"base64,([A-Za-z0-9+/=]+)", BUNNY.read_text())
    assert data
    path = tmp_path_factory.mktemp("model") / "bunny.glb"
    path.write_bytes(base64.b64decode(data[1]))
    return load_mesh(path)


def figures(surface: Surface, share: float = 0.12) -> dict[str, float]:
    direction, tile = comb_field(surface).direction, share * surface.extent
    charts = lap(surface, direction, tile)
    check(surface, charts)
    return lapped_figures(surface, charts, direction, tile)


def check(surface: Surface, charts: Charts) -> None:
    """Properties of charts of every surface, worked out face by face without the figures."""
    uv, place = charts.uv[charts.faces], surface.vertices[charts.source][charts.faces] / surface.extent
    assert np.isfinite(charts.uv).all()
    assert charts.uv.min() >= 0
    assert (np.linalg.det(uv[:, 1:] - uv[:, :1]) > 0).all(), "a face is mirrored"

    _, index = np.unique(charts.group, return_inverse=True)
    np.testing.assert_allclose(np.bincount(index, charts.weights), 1.0, atol=1e-9)
    assert charts.weights.min() >= 0
    owner = np.full(index.max() + 1, -1)
    owner[index] = charts.source
    assert (owner[index] == charts.source).all(), "a group has copies of two vertices"

    # The weights of all copies of a face sum to 1 at each of its corners: so they do at every point of it.
    total: dict[tuple[int, ...], dict[int, float]] = {}
    for corners in charts.faces:
        sources = charts.source[corners]
        sums = total.setdefault(tuple(sorted(sources.tolist())), {})
        for corner, source in zip(corners, sources.tolist(), strict=True):
            sums[source] = sums.get(source, 0.0) + charts.weights[corner]
    assert set(total) == {tuple(sorted(face)) for face in surface.faces.tolist()}
    np.testing.assert_allclose([list(sums.values()) for sums in total.values()], 1.0, atol=1e-9)

    tangent, normal = charts.tangents[:, :3], surface.normals[charts.source]
    np.testing.assert_allclose(np.linalg.norm(tangent, axis=1), 1.0, atol=1e-9)
    np.testing.assert_allclose(np.einsum("ij,ij->i", tangent, normal), 0.0, atol=1e-9)
    assert (charts.tangents[:, 3] == 1.0).all()
    assert np.isfinite(place).all()


LIMITS = {"faces_ratio": 1.6, "stretch_mean": 1.10, "stretch_95": 1.25, "sum_error": 1 / 255, "angle_95": 30.0}


def promised(surface: Surface, **limits: float) -> None:
    got = figures(surface)
    assert got["coverage"] == 1.0
    assert got["mirrored"] == 0
    assert got["sum_error_vertices"] < 1 / 255
    assert got["stretch_most"] <= 3.0
    for name, most in {**LIMITS, **limits}.items():
        assert got[name] <= most, f"{name}: {got[name]:.3f}"


@pytest.mark.parametrize("name", ["sphere", "torus:48x48", "torus:88x96"])
def test_promise(name: str) -> None:
    promised(builtin(name))


def test_promise_of_few_faces() -> None:
    promised(builtin("torus:16x16"), faces_ratio=2.4)


def test_promise_of_the_bunny(bunny: Surface) -> None:
    promised(bunny)


def test_promise_of_a_coarse_bunny(bunny: Surface) -> None:
    fast_simplification = pytest.importorskip("fast_simplification")
    vertices, faces = fast_simplification.simplify(
        bunny.vertices.astype(np.float32), bunny.faces.astype(np.int32), target_count=512
    )
    coarse = clean("coarse bunny", vertices.astype(float), faces.astype(np.int64))
    assert len(coarse.faces) == 512
    promised(coarse, faces_ratio=2.4, stretch_mean=1.15, stretch_95=1.45)


def strip(half_turns: int) -> Surface:
    """A band, closed after some half turns: a cylinder or a Möbius strip."""
    around, across = 60, 5
    angle, width = np.meshgrid(2 * np.pi * np.arange(around) / around, np.linspace(-0.3, 0.3, across), indexing="ij")
    out = 1 + width * np.cos(half_turns * angle / 2)
    places = np.stack([out * np.cos(angle), width * np.sin(half_turns * angle / 2), out * np.sin(angle)], axis=-1)
    number = np.arange(around * across).reshape(around, across)
    after = np.roll(number, -1, axis=0)
    if half_turns % 2:
        after[-1] = after[-1, ::-1]
    a, b, c, d = number[:, :-1], number[:, 1:], after[:, 1:], after[:, :-1]
    faces = np.concatenate([np.stack([a, b, c], axis=-1).reshape(-1, 3), np.stack([a, c, d], axis=-1).reshape(-1, 3)])
    return clean("strip", places.reshape(-1, 3), faces)


def book(pages: int) -> Surface:
    """Squares around one edge, each of 8 × 8 cells."""
    grid = np.stack(np.meshgrid(np.arange(9), np.arange(9), indexing="ij"), axis=-1).reshape(-1, 2) / 8
    a = (np.arange(8)[:, None] * 9 + np.arange(8)).reshape(-1)
    cells = np.concatenate([np.stack([a, a + 9, a + 10], axis=1), np.stack([a, a + 10, a + 1], axis=1)])
    places, faces = [], []
    for i in range(pages):
        angle = 2 * np.pi * i / pages
        places.append(np.column_stack([grid[:, 0] * np.cos(angle), grid[:, 1], grid[:, 0] * np.sin(angle)]))
        faces.append(cells + 81 * i)
    return clean("book", np.concatenate(places), np.concatenate(faces))


def ball(radius: float, centre: tuple[float, float, float] = (0, 0, 0), steps: int = 3) -> trimesh.Trimesh:
    solid = trimesh.creation.icosphere(subdivisions=steps, radius=radius)
    solid.apply_translation(centre)
    return solid


def solids(*parts: trimesh.Trimesh) -> Surface:
    both = trimesh.util.concatenate(parts)
    return clean("solids", np.asarray(both.vertices, dtype=float), np.asarray(both.faces))


@pytest.mark.parametrize(
    "make",
    [
        lambda: clean("one face", np.eye(3), np.array([[0, 1, 2]])),
        lambda: strip(2),
        lambda: strip(1),
        lambda: book(3),
        lambda: book(5),
        lambda: solids(ball(1.0), ball(0.5), ball(0.2)),
        lambda: solids(ball(1.0, (-1, 0, 0)), ball(1.0, (1, 0, 0))),
        lambda: solids(trimesh.creation.box()),
        lambda: solids(trimesh.creation.cylinder(0.02, 5, sections=12)),
        lambda: solids(trimesh.creation.cone(0.001, 1.0, sections=8)),
    ],
    ids=["face", "band", "moebius", "book 3", "book 5", "balls in balls", "balls", "box", "needle", "spike"],
)
def test_torn_and_sharp(make: object) -> None:
    got = figures(make())  # type: ignore[operator]
    assert got["coverage"] == 1.0
    assert got["stretch_most"] <= 3.0


def test_an_edge_of_three_faces_is_not_crossed() -> None:
    surface = book(3)
    charts = lap(surface, comb_field(surface).direction, 0.2)
    # Copies that faces share form a patch, or a part of one: none has faces of two pages.
    page = np.round(np.degrees(np.arctan2(*surface.vertices[surface.faces].mean(axis=1)[:, [2, 0]].T)) % 360)
    order = {tuple(sorted(face)): i for i, face in enumerate(surface.faces.tolist())}
    for copy in range(len(charts.source)):
        faces = charts.source[charts.faces[(charts.faces == copy).any(axis=1)]]
        assert len({page[order[tuple(sorted(face))]] for face in faces.tolist()}) == 1


@pytest.mark.parametrize("make", [lambda: strip(1), lambda: book(4), lambda: solids(ball(1.0))])
def test_sheets_are_manifold(make: object) -> None:
    surface = make()  # type: ignore[operator]
    sheet = cut(surface)
    np.testing.assert_array_equal(sheet.source[sheet.faces], surface.faces)
    assert np.bincount(sheet.edges.reshape(-1)).max() <= 2
    start, end = sheet.faces.reshape(-1), np.roll(sheet.faces, -1, axis=1).reshape(-1)
    for edge in np.flatnonzero(np.bincount(sheet.edges.reshape(-1)) == 2):
        one, two = np.flatnonzero(sheet.edges.reshape(-1) == edge)
        assert (start[one], end[one]) == (end[two], start[two])


@pytest.mark.parametrize("scale", [1e-6, 1e6])
def test_units_do_not_matter(scale: float) -> None:
    surface = builtin("torus:12x24")
    direction = comb_field(surface).direction
    one = lapped_figures(surface, lap(surface, direction, 0.2), direction, 0.2)
    other = replace(surface, vertices=scale * surface.vertices)
    two = lapped_figures(other, lap(other, direction, 0.2 * scale), direction, 0.2 * scale)
    assert two["faces_ratio"] == pytest.approx(one["faces_ratio"], rel=0.1)
    assert two["stretch_mean"] == pytest.approx(one["stretch_mean"], abs=0.02)


def test_faces_apart_are_not_repeated() -> None:
    chance = np.random.default_rng(0)
    corners = chance.normal(size=(50, 1, 3)) + chance.normal(size=(50, 3, 3))
    got = figures(clean("soup", corners.reshape(-1, 3), np.arange(150).reshape(-1, 3)))
    assert got["faces_ratio"] == 1.0
    assert got["stretch_most"] == pytest.approx(1.0, abs=1e-3)


def test_needles_end_and_are_covered() -> None:
    solid = ball(1.0)
    spikes = solid.vertices * (1 + 0.3 * np.random.default_rng(0).normal(size=(len(solid.vertices), 1)))
    got = figures(clean("needles", spikes, np.asarray(solid.faces)))
    assert got["coverage"] == 1.0
    assert got["mirrored"] == 0


def test_a_tile_is_a_tile_wide() -> None:
    surface = builtin("sphere")
    direction = comb_field(surface).direction
    for tile in (0.1, 0.4):
        charts = lap(surface, direction, tile)
        uv, place = charts.uv[charts.faces], surface.vertices[charts.source][charts.faces]
        areas = np.linalg.det(uv[:, 1:] - uv[:, :1]).sum() * tile**2
        true = np.linalg.norm(np.cross(place[:, 1] - place[:, 0], place[:, 2] - place[:, 0]), axis=1).sum()
        assert areas == pytest.approx(true, rel=0.03)


def test_v_grows_along_the_field_and_u_along_the_tangent() -> None:
    surface = builtin("sphere")
    direction = comb_field(surface).direction
    charts = lap(surface, direction, 0.2)
    place, uv = surface.vertices[charts.source][charts.faces], charts.uv[charts.faces]
    along = np.linalg.solve(uv[:, 1:] - uv[:, :1], place[:, 1:] - place[:, :1])
    along /= np.linalg.norm(along, axis=2, keepdims=True)
    tangent, normal = charts.tangents[:, :3], surface.normals[charts.source]
    other = charts.tangents[:, 3:] * np.cross(normal, tangent)
    for corner in range(3):
        copies = charts.faces[:, corner]
        assert np.einsum("fi,fi->f", along[:, 0], tangent[copies]).min() > 0.9
        assert np.einsum("fi,fi->f", along[:, 1], other[copies]).min() > 0.8
    laid = np.einsum("ij,ij->i", other, direction[charts.source])
    assert np.average(laid, weights=charts.weights) > 0.98


def test_seeds_and_repeats() -> None:
    surface = builtin("torus:12x24")
    direction = comb_field(surface).direction
    one, same, other = (lap(surface, direction, 0.2, seed=seed) for seed in (0, 0, 1))
    np.testing.assert_array_equal(one.uv, same.uv)
    np.testing.assert_array_equal(one.weights, same.weights)
    assert len(one.uv) != len(other.uv) or not np.allclose(one.uv, other.uv)


def test_progress_runs_to_1() -> None:
    surface = builtin("torus:8x12")
    told: list[float] = []
    lap(surface, comb_field(surface).direction, 0.2, progress=told.append)
    assert told == sorted(told)
    assert told[-1] == 1.0


def test_radius_is_free_of_the_tile() -> None:
    surface = builtin("sphere")
    direction = comb_field(surface).direction
    fine, coarse = (lap(surface, direction, 0.2, radius=radius) for radius in (0.08, 0.25))
    got = [lapped_figures(surface, charts, direction, 0.2) for charts in (fine, coarse)]
    assert got[0]["angle_95"] < got[1]["angle_95"]
    assert got[0]["faces_ratio"] > got[1]["faces_ratio"]


@settings(max_examples=25)
@given(st.integers(0, 10_000), st.integers(3, 60), st.integers(1, 200), st.sampled_from([1e-6, 1.0, 1e6]))
def test_any_soup(seed: int, points: int, faces: int, scale: float) -> None:
    chance = np.random.default_rng(seed)
    places = chance.normal(size=(points, 3)) * chance.choice([1.0, 1e-3, 0.0], 3, p=[0.7, 0.2, 0.1]) * scale
    try:
        surface = clean("soup", places, chance.integers(0, points, (faces, 3)))
    except MeshError:
        return
    got = figures(surface)
    assert got["coverage"] == 1.0
    assert got["sum_error"] < 1 / 255
