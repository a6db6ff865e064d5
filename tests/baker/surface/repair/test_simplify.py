"""A simplified copy keeps the shape and what is painted on it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import trimesh

from furbake.surface.mesh import MeshError, Surface, clean, simplify
from furbake.surface.repair.simplify import decimate
from furbake.surface.repair.transfer import apart, barycentric
from furbake.surface.shapes import builtin
from furbake.surface.soup import Soup


def painted_ball() -> Surface:
    """A ball whose picture is its map: u around with a seam, v down; its colours are its places."""
    ball = trimesh.creation.icosphere(subdivisions=5)
    surface = clean("ball", ball.vertices, ball.faces)
    corners = surface.vertices[surface.faces]
    u = np.arctan2(corners[..., 2], corners[..., 0]) / (2 * np.pi)
    middle = corners.mean(axis=1)
    near = np.arctan2(middle[:, 2], middle[:, 0])[:, None] / (2 * np.pi)
    u = near + np.mod(u - near + 0.5, 1.0) - 0.5
    return replace(
        surface,
        colours=0.5 + 0.5 * surface.vertices,
        uv=np.stack([u, 0.5 - 0.5 * corners[..., 1]], axis=2),
        attributes={"length": 0.5 + 0.5 * surface.vertices[:, 1:2]},
    )


def test_a_copy_of_nothing_is_refused() -> None:
    with pytest.raises(MeshError, match=r"^simplified surface: all faces have zero area, expected a surface$"):
        simplify(builtin("torus:8x8"), 1)


def test_everything_painted_comes_along() -> None:
    whole = painted_ball()
    few = simplify(whole, 4000)
    assert 3800 <= len(few.faces) <= 4000
    assert few.skin == ()
    assert few.colours is not None
    assert few.uv is not None
    unit = few.vertices / np.linalg.norm(few.vertices, axis=1, keepdims=True)
    np.testing.assert_allclose(few.colours, 0.5 + 0.5 * unit, atol=0.02)
    np.testing.assert_allclose(few.attributes["length"][:, 0], 0.5 + 0.5 * unit[:, 1], atol=0.02)
    corners = few.vertices[few.faces]
    flat = np.linalg.norm(corners[..., [0, 2]], axis=2).min(axis=1) > 0.3
    angle = np.arctan2(corners[..., 2], corners[..., 0]) / (2 * np.pi)
    off = np.abs(np.mod(few.uv[..., 0] - angle + 0.5, 1.0) - 0.5)
    assert off[flat].max() < 0.02
    assert np.ptp(few.uv[flat][..., 0], axis=1).max() < 0.2, "no face runs across the seam"
    np.testing.assert_allclose(few.uv[..., 1], 0.5 - 0.5 * corners[..., 1], atol=0.02)


def test_small_surface_is_left_alone() -> None:
    torus = builtin("torus:8x8")
    assert simplify(torus, 128) is torus


def test_material_comes_along() -> None:
    torus = builtin("torus:48x48")
    part = (torus.vertices[torus.faces].mean(axis=1)[:, 0] > 0).astype(np.int64)
    few = decimate(Soup(torus.vertices, torus.faces, part), 1000)
    middle = few.vertices[few.faces].mean(axis=1)[:, 0]
    clear = np.abs(middle) > 0.1
    np.testing.assert_array_equal(few.part[clear], middle[clear] > 0)


def test_result_repeats() -> None:
    torus = builtin("torus:48x48")
    one, two = simplify(torus, 1000), simplify(torus, 1000)
    np.testing.assert_array_equal(one.vertices, two.vertices)
    np.testing.assert_array_equal(one.faces, two.faces)


def test_distance_to_a_triangle() -> None:
    triangle = np.array([[[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]])
    points = np.array([[0.2, 0.2, 0.5], [-1, 0, 0], [1, 1, 0], [2, 0, 0]])
    np.testing.assert_allclose(apart(np.repeat(triangle, 4, axis=0), points), [0.5, 1, np.sqrt(0.5), 1])
    assert barycentric(triangle, points[:1])[0] == pytest.approx([0.6, 0.2, 0.2])
