"""The model's own texture coordinates as charts that fur can stand on."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import trimesh

from furbake.surface.charts import Charts
from furbake.surface.lay.own import own_charts
from furbake.surface.mesh import MeshError, Surface, clean, simplify
from furbake.surface.repair.topology import face_vectors
from furbake.surface.shapes import builtin


def square(cells: int = 4, mirrored: bool = False) -> Surface:
    """A square in x and z that faces up, with its picture laid on it: u along +x, v along +z; mirrored left of 0."""
    step = np.linspace(-1.0, 1.0, cells + 1)
    x, z = np.meshgrid(step, step, indexing="ij")
    a = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).reshape(-1)
    faces = np.concatenate([np.stack([a, a + 1, a + cells + 1], 1), np.stack([a + 1, a + cells + 2, a + cells + 1], 1)])
    surface = clean("square", np.stack([x, np.zeros_like(x), z], axis=-1).reshape(-1, 3), faces)
    u = np.abs(surface.vertices[:, 0]) if mirrored else surface.vertices[:, 0]
    return replace(surface, uv=np.stack([u, surface.vertices[:, 2]], axis=1)[surface.faces])


def areas(charts: Charts) -> Any:
    uv = charts.uv[charts.faces]
    one, two = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
    return one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]


def assert_fits(charts: Charts, surface: Surface) -> None:
    np.testing.assert_array_equal(charts.source[charts.faces], surface.faces)
    assert (areas(charts) > 0.0).all()
    assert (charts.uv > -1e-9).all()
    normals = surface.normals[charts.source]
    np.testing.assert_allclose(np.einsum("ij,ij->i", normals, charts.tangents[:, :3]), 0.0, atol=1e-9)
    np.testing.assert_allclose(np.linalg.norm(charts.tangents[:, :3], axis=1), 1.0)
    assert set(charts.tangents[:, 3]) == {1.0}


def test_tiles_have_their_width_and_hair_leans_down_the_picture() -> None:
    surface = square()
    charts = own_charts(surface, 0.5, "square")
    assert_fits(charts, surface)
    assert len(charts.source) == len(surface.vertices)
    assert areas(charts).sum() / 2 == pytest.approx(4.0 / 0.25)
    along_v = np.cross(surface.normals[charts.source], charts.tangents[:, :3])
    np.testing.assert_allclose(along_v, np.tile([0.0, 0.0, 1.0], (len(along_v), 1)), atol=1e-9)


def test_mirrored_half_is_turned_over() -> None:
    surface = square(mirrored=True)
    charts = own_charts(surface, 0.5, "square")
    assert_fits(charts, surface)
    assert len(charts.source) == len(surface.vertices) + 5
    along_v = np.cross(surface.normals[charts.source], charts.tangents[:, :3])
    np.testing.assert_allclose(along_v[:, 2], 1.0)


def test_faces_without_coordinates_are_projected() -> None:
    ball = trimesh.creation.icosphere(subdivisions=2)
    surface = clean("ball", ball.vertices, ball.faces)
    uv = np.full((len(surface.faces), 3, 2), np.nan)
    uv[:9] = 0.25
    charts = own_charts(replace(surface, uv=uv), 0.3, "ball")
    assert_fits(charts, surface)
    share = areas(charts) / (np.linalg.norm(face_vectors(surface.vertices, surface.faces), axis=1) / 0.09)
    assert share.min() > 0.5
    assert share.max() < 2.0


def test_built_in_shape_has_its_own() -> None:
    torus = builtin("torus:12x12")
    assert torus.natural
    np.testing.assert_array_equal(own_charts(torus, 0.2, "torus").uv, torus.natural.charts(0.2).uv)


def test_simplified_shape_keeps_its_own() -> None:
    few = simplify(builtin("torus:48x48"), 1000)
    assert_fits(own_charts(few, 0.2, "torus"), few)


def test_model_without_coordinates_is_one_sentence(cube: tuple[Any, Any]) -> None:
    with pytest.raises(MeshError, match=r"^cube: the model has no texture coordinates, expected some "):
        own_charts(clean("cube", *cube), 0.2, "cube")
