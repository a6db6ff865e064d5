"""Automatic length leaves bodies of every shape their shape; lengths in wrong units are questioned."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

from furbake.body.size import Size, questions, sized
from furbake.options import BakeOptions
from furbake.surface.mesh import Surface, clean
from helpers.command import TINY
from helpers.rays import march

MOST = 0.4
"""Length over the local thickness that no fur may exceed."""


def solid(*parts: trimesh.Trimesh) -> Surface:
    whole = trimesh.util.concatenate(parts)
    return clean("solid", np.asarray(whole.vertices), np.asarray(whole.faces))


def rod(radius: float, start: list[float], end: list[float]) -> trimesh.Trimesh:
    return trimesh.creation.cylinder(radius, segment=np.array([start, end], float), sections=12).subdivide()


def ball(radius: float, place: tuple[float, float, float] = (0, 0, 0)) -> trimesh.Trimesh:
    found = trimesh.creation.icosphere(subdivisions=2, radius=radius)
    found.apply_translation(place)
    return found


def box(*sides: float) -> trimesh.Trimesh:
    return trimesh.creation.box(sides).subdivide().subdivide().subdivide()


def fox() -> Surface:
    legs = [rod(0.05, [x, 0, z], [x, 0.8, z]) for x in (-0.15, 0.15) for z in (-0.7, 0.7)]
    snout = trimesh.creation.cone(0.18, 0.6, sections=12)
    snout.apply_translation([0, 1.2, 1.2])
    return solid(rod(0.3, [0, 1, -0.9], [0, 1, 0.9]), ball(0.3, (0, 1.2, 1.1)), snout, *legs)


def spider() -> Surface:
    around = np.linspace(0, 2 * np.pi, 8, endpoint=False) + 0.2
    legs = [rod(0.03, [0.3 * np.cos(a), 0, 0.3 * np.sin(a)], [2 * np.cos(a), 0.2, 2 * np.sin(a)]) for a in around]
    return solid(ball(0.4), *legs)


SHAPES: dict[str, Callable[[], Surface]] = {
    "fox": fox,
    "spider": spider,
    "plate": lambda: solid(box(2, 0.03, 2)),
    "ball": lambda: solid(ball(1)),
    "two bodies": lambda: solid(ball(1), ball(0.15, (1.5, 0, 0))),
    "ring": lambda: solid(trimesh.creation.torus(1, 0.08, major_sections=32, minor_sections=10)),
    "cone": lambda: solid(trimesh.creation.cone(0.4, 2, sections=16).subdivide().subdivide()),
    "cube": lambda: solid(box(1, 1, 1)),
    "rod": lambda: solid(rod(0.05, [0, 0, 0], [0, 4, 0]).subdivide()),
    "shell": lambda: solid(trimesh.creation.annulus(0.9, 1.0, 1.5, sections=24).subdivide()),
}


def fitted(surface: Surface, **options: Any) -> Size:
    return sized(surface, surface.extent, BakeOptions(auto_length=True, **options))


def measured(surface: Surface) -> tuple[np.ndarray, np.ndarray]:
    """Distance through the body at each vertex and at each face's middle."""
    triangles = surface.vertices[surface.faces]
    across = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    normals = np.concatenate([surface.normals, across / np.linalg.norm(across, axis=1, keepdims=True)])
    places = np.concatenate([surface.vertices, triangles.mean(1)])
    far = march(triangles, places - 1e-4 * surface.extent * normals, -normals)
    return far[: len(surface.vertices)], far[len(surface.vertices) :]


@pytest.mark.parametrize("shape", SHAPES)
def test_no_fur_is_longer_than_the_body_bears(shape: str) -> None:
    surface = SHAPES[shape]()
    size = fitted(surface)
    lengths = size.length * np.round(255 * size.shares) / 255  # as stored
    at_vertices, at_faces = measured(surface)
    assert (lengths <= MOST * at_vertices).all()
    assert (lengths[surface.faces].mean(1) <= MOST * at_faces).all()
    assert (lengths > 0).mean() > 0.95
    assert np.median(lengths) > 0.05 * np.quantile(at_faces, 0.3), "it is fur still"
    assert 0.4 <= size.tile / (BakeOptions.tile_share * surface.extent) <= 1, "patches stay few"


def test_a_thick_body_keeps_the_usual_length() -> None:
    surface = SHAPES["ball"]()
    usual = sized(surface, surface.extent, BakeOptions())
    assert (fitted(surface).length, fitted(surface).tile) == (usual.length, usual.tile)
    np.testing.assert_array_equal(fitted(surface).shares, 1)


def test_a_fox_keeps_its_legs() -> None:
    surface = fox()
    size = fitted(surface)
    legs, trunk = surface.vertices[:, 1] < 0.5, np.abs(surface.vertices[:, 2]) < 0.1
    assert size.shares[legs].max() < 0.4 * size.shares[trunk & ~legs].min()
    (told,) = size.notices
    assert told.startswith("length: ")
    assert "--length" in told
    assert "--no-length-by-thickness" in told


def test_a_sheet_has_the_usual_length() -> None:
    sheet = trimesh.Trimesh([[0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1]], [[0, 2, 1], [0, 3, 2]])
    surface = solid(sheet.subdivide().subdivide())
    np.testing.assert_array_equal(fitted(surface).shares, 1)
    assert fitted(surface).length == pytest.approx(BakeOptions.tile_share * BakeOptions.height_share)


def test_a_given_length_keeps_the_proportions() -> None:
    surface = fox()
    usual = fitted(surface)
    longer = fitted(surface, length=2 * usual.length)
    assert (longer.length, longer.notices) == (2 * usual.length, ())
    free = usual.shares * usual.length < 0.9 * measured(surface)[0] * MOST  # where only the usual length bounds it
    assert free.mean() > 0.5
    assert np.median(np.abs(longer.shares - usual.shares)[free]) < 0.02
    short = fitted(surface, length=usual.length / 20)
    assert short.shares.mean() > 0.95, "short fur is even"
    both = fitted(surface, tile=0.2, height=0.5)
    assert (both.length, both.tile) == (0.1, 0.2)


def test_a_given_tile_or_height_is_kept() -> None:
    surface = fox()
    assert fitted(surface, tile=0.2).tile == 0.2
    high = fitted(surface, height=1.0)
    assert high.length == high.tile
    plate = SHAPES["plate"]()
    high = fitted(plate, height=1.0)
    at_vertices, _ = measured(plate)
    assert (high.length * high.shares <= MOST * at_vertices).all()


@pytest.mark.parametrize("scale", [1e-3, 1e4])
def test_the_unit_does_not_matter(scale: float) -> None:
    surface = spider()
    larger = replace(surface, vertices=surface.vertices * scale)
    one, other = fitted(surface), fitted(larger)
    assert other.length == pytest.approx(scale * one.length, rel=1e-3)
    np.testing.assert_allclose(other.shares, one.shares, rtol=0.02, atol=1e-3)


def test_units_that_cannot_be_right_are_questioned() -> None:
    def asked(extent: float = 2.0, **options: Any) -> tuple[str, ...]:
        given = BakeOptions(**options)
        return questions(*given.dimensions(extent), extent, given)

    (told,) = asked(length=5.0)
    assert told == (
        "length: 5 is 2.5 times the model's largest side (2), is it in the model's own units? 0.13 is usual"
    )
    (told,) = asked(length=1e-4)
    assert told.startswith("length: 0.0001 is 1/2e+04 of the model's largest side")
    assert [line.split(":")[0] for line in asked(tile=500.0)] == ["tile"]
    assert asked() == asked(length=0.3) == asked(tile=0.3) == asked(height=4.0) == ()


def test_the_command_fits_files_and_says_so(run: Callable[..., Any], tmp_path: Path, monkeypatch: Any) -> None:
    monkeypatch.chdir(tmp_path)
    trimesh.Trimesh(fox().vertices, fox().faces).export("fox.stl")
    small = (*TINY, "--no-fins")
    done = run("bake", "fox.stl", "-o", "fitted", *small)
    assert "furbake: note: length: " in done.err
    assert done.err.index("note: length") < done.err.index("furbake: light")
    asked = run("bake", "fox.stl", "-o", "even", *small, "--no-length-by-thickness", "--length", "5").err
    assert "is it in the model's own units?" in asked
    run("bake", "plane:1x1", "-o", "shape", *small)

    def of(folder: str) -> tuple[float, bool]:
        record = json.loads(Path(folder, "bake.json").read_text())
        length = json.loads(Path(folder, "model.gltf").read_text())["extensions"]["FUR_ptm_shells"]["length"]
        return length, record["options"].get("auto_length", False)

    assert of("fitted")[0] < 0.2
    assert [of(name)[1] for name in ("fitted", "even", "shape")] == [True, False, False]
    assert of("even")[0] == 5
    assert run("bake", "fox.stl", "-o", "fitted", *small, "--if-stale").out == "fitted: up to date\n"
