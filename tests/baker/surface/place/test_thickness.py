"""Length by thickness against shapes whose thickness is known, and embree against plain NumPy."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import trimesh

from furbake.surface.mesh import Surface, clean
from furbake.surface.place import rays, thickness
from furbake.surface.place.rays import nearest_hits
from furbake.surface.place.thickness import SHORTEST, cone, distances, length_by_thickness
from furbake.surface.shapes import builtin
from helpers.rays import march


def slab(thick: float) -> Surface:
    solid = trimesh.creation.box((2.0, thick, 2.0))
    for _ in range(4):
        solid = solid.subdivide()
    return clean("slab", np.asarray(solid.vertices), np.asarray(solid.faces))


def middle(surface: Surface) -> np.ndarray:
    return (np.abs(surface.vertices[:, [0, 2]]) < 0.4).all(axis=1)


def test_thick_body_has_full_length() -> None:
    np.testing.assert_array_equal(length_by_thickness(builtin("sphere")), 1.0)


@pytest.mark.parametrize(("thick", "share"), [(0.05, SHORTEST), (0.25, 0.53), (0.6, 1.0)])
def test_slab(thick: float, share: float) -> None:
    surface = slab(thick)
    got = length_by_thickness(surface)[middle(surface)]
    np.testing.assert_allclose(got, share, atol=0.03)


@pytest.mark.parametrize("scale", [1e-4, 37.0, 1e5])
def test_unit_does_not_matter(scale: float) -> None:
    surface = slab(0.25)
    larger = replace(surface, vertices=surface.vertices * scale + scale)
    np.testing.assert_allclose(length_by_thickness(larger), length_by_thickness(surface), atol=1e-3)


def test_open_surface_counts_as_thick() -> None:
    np.testing.assert_array_equal(length_by_thickness(builtin("plane")), 1.0)


def test_embree_agrees_with_numpy(monkeypatch: pytest.MonkeyPatch) -> None:
    surface = builtin("torus:12x16")
    inward = cone(-surface.normals, 3, 0.3)
    start = np.broadcast_to((surface.vertices - 0.01 * surface.normals)[:, None], inward.shape).reshape(-1, 3)
    fast = distances(surface, start, inward.reshape(-1, 3))
    plain = march(surface.vertices[surface.faces], start, inward.reshape(-1, 3))
    near = np.isfinite(plain) & np.isfinite(fast)
    assert near.mean() > 0.99
    np.testing.assert_allclose(fast[near], plain[near], rtol=1e-3)
    monkeypatch.setattr(thickness, "EmbreeScene", None)
    np.testing.assert_allclose(distances(surface, start, inward.reshape(-1, 3)), plain)


@pytest.mark.parametrize("count", [1, 4, 5, 300])
def test_a_tree_of_boxes_finds_what_brute_force_finds(count: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Triangles anyhow, rays from among them and from outside, some along the axes and so along faces of boxes."""
    chance = np.random.default_rng(count)
    triangles = chance.uniform(-0.5, 0.5, (count, 1, 3)) + chance.normal(0, 0.1, (count, 3, 3))
    triangles[0] = [[0, 0, 0], [0.3, 0, 0], [0, 0.3, 0]]  # flat: a box without a height
    starts = chance.uniform(-1, 1, (5000, 3))
    ways = chance.normal(size=(5000, 3))
    ways[:600] = np.repeat([[0, 0, 1], [0, 0, -1], [1, 0, 0]], 200, axis=0)
    starts[:400, :2] = np.abs(starts[:400, :2]) / 6
    ways /= np.linalg.norm(ways, axis=1, keepdims=True)
    triangles[-1, 2] = triangles[-1, 1]  # no area
    monkeypatch.setattr(rays, "MOST", 3000)
    found, expected = nearest_hits(triangles, starts, ways), march(triangles, starts, ways)
    assert np.isfinite(expected).sum() > (100 if count > 1 else -1)
    np.testing.assert_array_equal(np.isfinite(found), np.isfinite(expected))
    hit = np.isfinite(expected)
    np.testing.assert_allclose(found[hit], expected[hit])


def test_cone() -> None:
    axes = np.array([[0.0, 1, 0], [1, 0, 0], [0, 0, -1]])
    directions = cone(axes, 5, 0.35)
    np.testing.assert_array_equal(directions[:, 0], axes)
    np.testing.assert_allclose(np.linalg.norm(directions, axis=2), 1.0)
    np.testing.assert_allclose(np.einsum("ni,nki->nk", axes, directions)[:, 1:], np.cos(0.35))
