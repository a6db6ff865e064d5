"""Pictures, vertex colours and attributes as numbers of the fur."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from furbake.surface.mesh import MeshError, Surface, clean
from furbake.surface.place.paint import brought, uncover, vertex_map, vertex_numbers
from furbake.surface.shapes import builtin


@pytest.fixture
def sheet(cube: tuple[Any, Any]) -> Surface:
    """A cube with x and z as its texture coordinates."""
    surface = clean("cube", *cube)
    return replace(surface, uv=surface.vertices[surface.faces][..., [0, 2]])


def test_black_is_bare(sheet: Surface) -> None:
    pixels = np.full((64, 64), 255, dtype=np.uint8)
    pixels[:, :32] = 0
    uv = 0.25 + 0.5 * sheet.vertices[sheet.faces][..., [0, 2]]
    painted = vertex_map(replace(sheet, uv=uv), pixels, "mask.png")
    np.testing.assert_array_equal(painted, np.where(sheet.vertices[:, 0] > 0.5, 1.0, 0.0))


def test_first_row_is_v_0(sheet: Surface) -> None:
    pixels = np.zeros((8, 8, 3), dtype=np.uint8)
    pixels[:4] = 51
    uv = 0.25 + 0.5 * sheet.vertices[sheet.faces][..., [0, 2]]
    painted = vertex_map(replace(sheet, uv=uv), pixels, "length.png")
    np.testing.assert_allclose(painted, np.where(sheet.vertices[:, 2] < 0.5, 0.2, 0.0), atol=1e-12)


def test_transparent_is_not_painted(sheet: Surface) -> None:
    pixels = np.zeros((2, 2, 4), dtype=np.uint8)
    np.testing.assert_array_equal(vertex_map(sheet, pixels, "mask.png"), 1.0)
    pixels[..., 3] = 255
    np.testing.assert_array_equal(vertex_map(sheet, pixels, "mask.png"), 0.0)


def test_faces_without_coordinates_keep_their_fur(sheet: Surface) -> None:
    assert sheet.uv is not None
    uv = sheet.uv.copy()
    uv[(sheet.vertices[sheet.faces][..., 0] == 0.0).any(axis=1)] = np.nan
    painted = vertex_map(replace(sheet, uv=uv), np.zeros((4, 4), dtype=np.uint8), "mask.png")
    np.testing.assert_array_equal(painted, np.where(sheet.vertices[:, 0] == 0.0, 1.0, 0.0))


def test_built_in_shapes_have_coordinates() -> None:
    ramp = np.tile(np.arange(256, dtype=np.uint8), (4, 1))
    plane = builtin("plane")
    painted = vertex_map(plane, ramp, "ramp.png")
    inside = np.abs(plane.vertices[:, 0]) < 0.49
    np.testing.assert_allclose(painted[inside], plane.vertices[inside, 0] + 0.5, atol=0.004)


@pytest.mark.parametrize("pixels", [np.zeros((4, 4)), np.zeros((2, 2, 5), np.uint8), np.zeros((0, 4), np.uint8)])
def test_no_picture_is_one_sentence(sheet: Surface, pixels: Any) -> None:
    with pytest.raises(MeshError, match=r"^mask\.png: .* expected \(height, width, 1 to 4\) bytes$"):
        vertex_map(sheet, pixels, "mask.png")


def test_no_coordinates_is_one_sentence(cube: tuple[Any, Any]) -> None:
    with pytest.raises(MeshError, match=r"^mask\.png: the model has no texture coordinates, expected some"):
        vertex_map(clean("cube", *cube), np.zeros((4, 4), np.uint8), "mask.png")


def test_channels_and_attributes(sheet: Surface) -> None:
    colour = np.linspace(0.0, 1.0, 32).reshape(8, 4)
    surface = replace(sheet, attributes={"color": colour, "length": np.full((8, 1), 2.0), "comb": np.zeros((8, 3))})
    np.testing.assert_array_equal(vertex_numbers(surface, "alpha", "--mask"), colour[:, 3])
    np.testing.assert_array_equal(vertex_numbers(surface, "length", "--mask"), 1.0)
    with pytest.raises(MeshError, match=r"^--mask: got 'hue', expected red, green, blue, alpha, length$"):
        vertex_numbers(surface, "hue", "--mask")
    with pytest.raises(MeshError, match=r"^--mask: got 'red', expected a model with vertex colours or attributes$"):
        vertex_numbers(sheet, "red", "--mask")
    assert list(brought(surface)) == ["length"]
    assert brought(sheet) == {}


def test_bare_faces_carry_no_fur() -> None:
    torus = builtin("torus:16x16")
    mask = np.clip(torus.vertices[:, 0], 0.0, 1.0)
    covered, kept = uncover(torus, mask, "mask.png")
    assert len(covered.faces) < len(torus.faces)
    np.testing.assert_array_equal(covered.vertices, torus.vertices[kept])
    np.testing.assert_array_equal(covered.normals, torus.normals[kept])
    assert (mask[kept][covered.faces].max(axis=1) > 0.0).all()
    assert covered.natural
    charts = covered.natural.charts(0.2)
    np.testing.assert_array_equal(charts.source[charts.faces], covered.faces)
    np.testing.assert_array_equal(uncover(torus, np.ones_like(mask), "x")[0].faces, torus.faces)
    with pytest.raises(MeshError, match=r"^mask\.png: every face is bare, expected some fur"):
        uncover(torus, np.zeros_like(mask), "mask.png")
