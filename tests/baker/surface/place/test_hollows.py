"""Fur in hollows against brute force: which hairs of a valley's cross-section cross each other."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from furbake.surface.mesh import Surface
from furbake.surface.place.hollows import out_of_hollows
from furbake.surface.place.vertex_fur import FARTHEST
from furbake.surface.repair.topology import unit
from furbake.surface.shapes import builtin

LENGTH = 0.12
STEP = 0.02
ROWS = 9


def valley(radius: float, scale: float = 1.0) -> Surface:
    """Two slopes of 45° that meet in an arc, extruded along z; the lowest point is the origin."""
    reach = radius * np.sin(np.pi / 4)
    x = np.linspace(-0.5, 0.5, int(1 / STEP) + 1)
    arc = radius - np.sqrt(np.maximum(radius**2 - x**2, 0.0))
    y = np.where(np.abs(x) < reach, arc, radius * (1 - np.cos(np.pi / 4)) + np.abs(x) - reach)
    slope = np.where(np.abs(x) < reach, x / np.sqrt(np.maximum(radius**2 - x**2, 1e-12)), np.sign(x))
    columns = len(x)
    z = STEP * np.arange(ROWS)
    vertices = np.stack([np.tile(x, ROWS), np.tile(y, ROWS), np.repeat(z, columns)], axis=1)
    normals = unit(np.stack([-np.tile(slope, ROWS), np.ones(len(vertices)), np.zeros(len(vertices))], axis=1))
    i, j = (grid.reshape(-1) for grid in np.meshgrid(np.arange(ROWS - 1), np.arange(columns - 1), indexing="ij"))
    a = i * columns + j
    b, c, d = a + columns, a + columns + 1, a + 1
    faces = np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
    return Surface(scale * vertices, faces, normals)


def tips(surface: Surface, comb: np.ndarray, length: float) -> np.ndarray:
    rise = np.sqrt(1.0 - (comb**2).sum(axis=1, keepdims=True))
    return surface.vertices + length * (rise * surface.normals + comb)


def crossings(surface: Surface, comb: np.ndarray, length: float) -> int:
    """Pairs of hairs of the middle row that cross in the x-y plane."""
    columns = len(surface.vertices) // ROWS
    row = slice(ROWS // 2 * columns, (ROWS // 2 + 1) * columns)
    roots, ends = surface.vertices[row, :2], tips(surface, comb, length)[row, :2]

    def side(p: np.ndarray, q: np.ndarray, r: np.ndarray) -> float:
        return float((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]))

    return sum(
        side(a, b, c) * side(a, b, d) < 0 and side(c, d, a) * side(c, d, b) < 0
        for (a, b), (c, d) in itertools.combinations(zip(roots, ends, strict=True), 2)
    )


def straight(surface: Surface) -> np.ndarray:
    return np.zeros_like(surface.vertices)


def full(surface: Surface, length: float = LENGTH) -> np.ndarray:
    return np.full(len(surface.vertices), length)


def test_hairs_of_a_narrow_valley_do_not_cross() -> None:
    surface = valley(0.04)
    assert crossings(surface, straight(surface), LENGTH) > 15
    assert crossings(surface, out_of_hollows(surface, full(surface), straight(surface)), LENGTH) == 0


def test_combed_hairs_do_not_cross_either() -> None:
    surface = valley(0.04)
    along = np.broadcast_to([0.0, 0.0, 0.4], surface.vertices.shape)
    across = 0.2 * np.stack([surface.normals[:, 1], -surface.normals[:, 0], surface.normals[:, 2]], axis=1)
    for comb in (along, across):
        assert crossings(surface, comb, LENGTH) > 15
        out = out_of_hollows(surface, full(surface), comb)
        assert crossings(surface, out, LENGTH) == 0
        far = np.abs(surface.vertices[:, 0]) > 0.4
        np.testing.assert_allclose(out[far], comb[far], atol=1e-12)


def test_comb_lies_in_the_surface_and_is_no_longer_than_allowed() -> None:
    surface = valley(0.01)
    comb = out_of_hollows(surface, full(surface, 0.3), straight(surface))
    np.testing.assert_allclose(np.einsum("ij,ij->i", comb, surface.normals), 0.0, atol=1e-12)
    length = np.linalg.norm(comb, axis=1)
    assert 0.5 < length.max() <= FARTHEST + 1e-12


@pytest.mark.parametrize("name", ["sphere", "plane", "torus"])
def test_round_and_flat_bodies_keep_their_comb(name: str) -> None:
    surface = builtin(name)
    np.testing.assert_array_equal(out_of_hollows(surface, full(surface), straight(surface)), 0.0)


def test_wide_valley_and_short_fur_keep_their_comb() -> None:
    wide, narrow = valley(0.2), valley(0.04)
    np.testing.assert_array_equal(out_of_hollows(wide, full(wide), straight(wide)), 0.0)
    for length in (0.0, 0.02):
        np.testing.assert_array_equal(out_of_hollows(narrow, full(narrow, length), straight(narrow)), 0.0)


def test_bald_skin_keeps_its_comb_whichever_way_it_looks() -> None:
    ball = builtin("sphere")
    np.testing.assert_array_equal(out_of_hollows(ball, full(ball, 0.0), straight(ball)), 0.0)


@pytest.mark.parametrize("scale", [1e-4, 1e5])
def test_unit_does_not_matter(scale: float) -> None:
    one, other = valley(0.04), valley(0.04, scale)
    expected = out_of_hollows(one, full(one), straight(one))
    np.testing.assert_allclose(out_of_hollows(other, full(other, scale * LENGTH), straight(other)), expected, atol=1e-7)


def test_face_without_area_does_no_harm() -> None:
    surface = valley(0.04)
    bad = Surface(surface.vertices, np.vstack([surface.faces, [[0, 1, 1], [3, 4, 5]]]), surface.normals)
    comb = out_of_hollows(bad, full(bad), straight(bad))
    assert np.isfinite(comb).all()
    assert crossings(bad, comb, LENGTH) == 0
