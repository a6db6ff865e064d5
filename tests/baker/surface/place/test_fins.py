"""A fin on every edge that can be on the outline, in the frame that the format promises."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from furbake.surface.charts import laid
from furbake.surface.lay.own import own_charts
from furbake.surface.mesh import Surface, clean
from furbake.surface.place.fins import HOLLOWEST, SHARPEST, build_fins, fin_edges
from furbake.surface.repair.topology import face_vectors, unit
from furbake.surface.shapes import builtin

TILE = 0.2


def downward(surface: Surface) -> Any:
    """A direction for the fur: down the surface."""
    down = np.tile([0.3, -1.0, 0.2], (len(surface.vertices), 1))
    return unit(down - surface.normals * np.einsum("ij,ij->i", down, surface.normals)[:, None])


def folded(angle: float) -> Surface:
    """Two triangles that share an edge along x; `angle` radians between their normals, convex where positive."""
    vertices = [(0, 0, 0), (1, 0, 0), (0.5, np.cos(angle / 2), -np.sin(angle / 2))]
    vertices.append((0.5, -np.cos(angle / 2), -np.sin(angle / 2)))
    return clean("folded", np.array(vertices, float), np.array([[0, 1, 2], [1, 0, 3]]))


def test_a_closed_surface_has_a_quad_per_edge() -> None:
    surface = builtin("sphere")
    fins = build_fins(surface, downward(surface), TILE)
    edges = len(surface.faces) * 3 // 2
    assert len(fins.source) == 4 * edges
    assert len(fins.faces) == 2 * edges
    roots, tips = fins.source.reshape(-1, 4)[:, :2], fins.source.reshape(-1, 4)[:, 2:]
    np.testing.assert_array_equal(roots, tips)
    assert len(np.unique(np.sort(roots, axis=1), axis=0)) == edges
    height = fins.uv[:, 1].reshape(-1, 4)
    assert (height == [0, 0, 1, 1]).all()


def test_light_finds_where_the_fur_is_laid() -> None:
    surface = builtin("torus:8x8")
    direction = downward(surface)
    fins = build_fins(surface, direction, TILE)
    n = surface.normals[fins.source]
    across = unit(np.cross(fins.tangents, n))
    turned = np.cross(n, across) * np.cos(fins.laid)[:, None] + across * np.sin(fins.laid)[:, None]
    np.testing.assert_allclose(turned, direction[fins.source], atol=1e-9)


def test_quads_are_whole() -> None:
    surface = builtin("torus:8x8")
    fins = build_fins(surface, downward(surface), TILE)
    for quad, faces in enumerate(fins.faces.reshape(-1, 6)):
        assert set(faces) == {4 * quad, 4 * quad + 1, 4 * quad + 2, 4 * quad + 3}
    # Both triangles turn the same way in (u, height).
    a, b, c = (fins.uv[fins.faces[:, i]] for i in range(3))
    assert (np.linalg.det(np.stack([b - a, c - a], axis=1)) > 0).all()


def test_borders_have_fins() -> None:
    surface = builtin("plane")
    fins = build_fins(surface, downward(surface), TILE)
    ends, faces = fin_edges(surface)
    border = faces[:, 0] == faces[:, 1]
    assert border.sum() == 4 * (np.sqrt(len(surface.vertices)) - 1)
    angles = fins.angles.reshape(-1, 4, 2)
    np.testing.assert_allclose(angles[:, :, 0], 0, atol=1e-9)
    np.testing.assert_allclose(angles[~border][:, :, 1], 0, atol=1e-9)
    assert len(ends) == len(angles)


def test_a_border_is_an_outline_to_eyes_outside_of_it() -> None:
    surface = builtin("plane")
    middle = surface.vertices.mean(axis=0)
    fins = build_fins(surface, downward(surface), TILE)
    _, faces = fin_edges(surface)
    border = np.repeat(faces[:, 0] == faces[:, 1], 4)
    t, n = fins.tangents[border], surface.normals[fins.source[border]]
    angle = fins.angles[border][:, 1, None]
    second = n * np.cos(angle) + np.cross(t, n) * np.sin(angle)
    outwards = surface.vertices[fins.source[border]] - middle
    outwards -= t * np.einsum("ij,ij->i", outwards, t)[:, None]  # of a square, about its middle
    np.testing.assert_allclose(second, -outwards / np.linalg.norm(outwards, axis=1)[:, None], atol=1e-9)


@pytest.mark.parametrize(
    ("angle", "finned"),
    [
        (0, True),
        (SHARPEST - 0.01, True),
        (SHARPEST + 0.01, False),
        (-HOLLOWEST + 0.01, True),
        (-HOLLOWEST - 0.01, False),
    ],
)
def test_sharp_edges_have_none(angle: float, finned: bool) -> None:
    surface = folded(angle)
    _, faces = fin_edges(surface)
    inner = faces[:, 0] != faces[:, 1]
    assert inner.sum() == finned
    assert (~inner).sum() == 4


def test_edges_of_three_faces_have_none() -> None:
    vertices = np.array([(0, 0, 0), (1, 0, 0), (0.5, 1, 0), (0.5, -1, 0), (0.5, 0, 1)], float)
    faces = np.array([[0, 1, 2], [1, 0, 3], [0, 1, 4]])
    normals = np.tile([0.0, 0.0, 1.0], (5, 1))
    ends, _ = fin_edges(Surface(vertices, faces, normals))
    assert [0, 1] not in ends.tolist()


def test_short_diagonals_have_none() -> None:
    surface = builtin("torus:48x48")
    squares = 48 * 48
    assert len(fin_edges(surface)[0]) == 3 * squares
    kept, faces = fin_edges(surface, 10.0)
    assert len(kept) == 2 * squares
    assert np.bincount(faces.reshape(-1), minlength=len(surface.faces)).min() == 2  # at most one of each face is gone
    shortest = np.linalg.norm(surface.vertices[kept[:, 1]] - surface.vertices[kept[:, 0]], axis=1).min()
    assert len(fin_edges(surface, shortest)[0]) == 3 * squares
    plane = builtin("plane")  # its diagonals go, its borders stay
    _, faces = fin_edges(plane, 10.0)
    assert (faces[:, 0] == faces[:, 1]).sum() == 4 * (np.sqrt(len(plane.vertices)) - 1)


def test_triangles_with_equal_sides_lose_one_edge_at_most() -> None:
    surface = folded(0.0)  # two triangles, all five edges about as long
    assert len(fin_edges(surface, 10.0)[0]) >= 4


def test_tangents_run_along_the_edge_to_where_the_fur_is_laid() -> None:
    surface = builtin("sphere")
    direction = downward(surface)
    fins = build_fins(surface, direction, TILE, lean=0.3)
    quads = fins.source.reshape(-1, 4)
    way = surface.vertices[quads[:, 1]] - surface.vertices[quads[:, 0]]
    length = np.linalg.norm(way, axis=1)
    tangents = fins.tangents.reshape(-1, 4, 3)
    np.testing.assert_allclose(tangents, np.repeat((way / length[:, None])[:, None], 4, axis=1), atol=1e-12)
    assert (np.einsum("ij,ij->i", tangents[:, 0], direction[quads[:, 0]] + direction[quads[:, 1]]) >= 0).all()
    u = fins.uv[:, 0].reshape(-1, 4)
    np.testing.assert_allclose(u[:, 1] - u[:, 0], length / TILE)
    np.testing.assert_allclose(u[:, 3] - u[:, 2], length / TILE)
    assert fins.uv.min() >= 0


@pytest.mark.parametrize("lean", [0.3, -0.3])
def test_hairs_lean_as_far_as_the_edge_runs_along_the_fur(lean: float) -> None:
    surface = builtin("plane")
    for laid_at in (0.0, 0.7, np.pi / 2):
        direction = np.tile([np.sin(laid_at), 0.0, np.cos(laid_at)], (len(surface.vertices), 1))
        fins = build_fins(surface, direction, TILE, lean)
        u = fins.uv[:, 0].reshape(-1, 4)
        cosine = fins.tangents.reshape(-1, 4, 3)[:, 0] @ direction[0]
        # A hair of the texture that is rooted at u ends at u + lean, which lies this far along the fin:
        np.testing.assert_allclose(u[:, 0] + lean - u[:, 2], lean * cosine, atol=1e-12)
        assert fins.uv.min() >= 0


def test_edges_that_meet_begin_elsewhere_in_the_tile() -> None:
    surface = builtin("sphere")
    fins = build_fins(surface, downward(surface), TILE)
    quads, start = fins.source.reshape(-1, 4), fins.uv[::4, 0] % 1
    first = np.minimum(quads[:, 0], quads[:, 1])
    for vertex in np.unique(first)[::50]:
        here = np.sort(start[first == vertex])
        gaps = np.diff(np.append(here, here[0] + 1))
        assert len(here) < 2 or gaps.min() > 0.1 / len(here)
    np.testing.assert_array_equal(start, build_fins(surface, downward(surface), TILE).uv[::4, 0] % 1)
    assert not np.array_equal(start, build_fins(surface, downward(surface), TILE, seed=1).uv[::4, 0] % 1)


def test_angles_give_back_the_faces_normals() -> None:
    surface = builtin("torus:16x16")
    fins = build_fins(surface, downward(surface), TILE)
    n, t = surface.normals[fins.source], fins.tangents
    n = unit(n - t * np.einsum("ij,ij->i", n, t)[:, None])
    across = np.cross(t, n)
    flat = unit(face_vectors(surface.vertices, surface.faces))
    _, faces = fin_edges(surface)
    for side in range(2):
        angle = fins.angles[:, side, None]
        normal = n * np.cos(angle) + across * np.sin(angle)
        wanted = flat[np.repeat(faces[:, side], 4)]
        np.testing.assert_allclose(normal, wanted, atol=1e-9)


@pytest.mark.parametrize("name", ["torus", "plane"])
def test_the_fur_is_laid_along_v(name: str) -> None:
    surface = builtin(name)
    charts = own_charts(surface, TILE, "shape")
    direction = laid(charts, surface.normals)
    np.testing.assert_allclose(np.linalg.norm(direction, axis=1), 1)
    assert np.abs(np.einsum("ij,ij->i", direction, surface.normals)).max() < 1e-9
    if name == "plane":
        w, t, n = charts.tangents[:, 3:], charts.tangents[:, :3], surface.normals[charts.source]
        np.testing.assert_allclose(direction[charts.source], w * np.cross(n, t), atol=1e-9)


def test_directions_that_cancel_give_some_tangent() -> None:
    surface = builtin("plane")
    charts = own_charts(surface, TILE, "shape")
    twice = type(charts)(
        source=np.tile(charts.source, 2),
        faces=charts.faces,
        tangents=np.concatenate([charts.tangents, -charts.tangents * [1, 1, 1, -1]]),
        uv=np.tile(charts.uv, (2, 1)),
        weights=np.full(2 * len(charts.source), 0.5),
        group=np.tile(charts.group, 2),
    )
    direction = laid(twice, surface.normals)
    np.testing.assert_allclose(np.linalg.norm(direction, axis=1), 1)
    assert np.abs(np.einsum("ij,ij->i", direction, surface.normals)).max() < 1e-9
