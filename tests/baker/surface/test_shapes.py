"""Built-in shapes: counts, sides, and texture coordinates that close."""

from __future__ import annotations

import numpy as np
import pytest

from furbake.surface.mesh import MeshError
from furbake.surface.repair.topology import face_vectors, unit
from furbake.surface.shapes import builtin, is_builtin

SHAPES = ("sphere", "plane", "torus", "torus:8x12", "torus:3x3", "plane:1x1", "plane:2x5")


@pytest.mark.parametrize("name", SHAPES)
def test_faces_and_normals_look_outward(name: str) -> None:
    surface = builtin(name)
    flat = unit(face_vectors(surface.vertices, surface.faces))
    corners = surface.normals[surface.faces]
    assert (np.einsum("fi,fci->fc", flat, corners) > 0).all()
    np.testing.assert_allclose(np.linalg.norm(surface.normals, axis=1), 1.0)
    assert np.array_equal(np.unique(surface.faces), np.arange(len(surface.vertices)))


@pytest.mark.parametrize(
    ("name", "faces"), [("torus", 9216), ("torus:8x12", 192), ("torus:88x96", 16896), ("plane", 512), ("plane:1x1", 2)]
)
def test_counts(name: str, faces: int) -> None:
    assert len(builtin(name).faces) == faces


@pytest.mark.parametrize("name", ["torus", "torus:8x12"])
def test_closed_shapes_are_closed(name: str) -> None:
    faces = builtin(name).faces
    edges = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    assert (np.unique(edges, axis=0, return_counts=True)[1] == 2).all()


@pytest.mark.parametrize("tile", [0.05, 0.2, 1.7, 50.0])
def test_torus_wraps_whole_tiles(tile: float) -> None:
    surface = builtin("torus:8x12")
    assert surface.natural
    charts = surface.natural.charts(tile)
    for vertex in range(len(surface.vertices)):
        copies = charts.uv[charts.source == vertex]
        apart = copies - copies[0]
        np.testing.assert_allclose(apart, np.round(apart), atol=1e-9)
    around = np.ptp(charts.uv, axis=0)
    assert (np.round(around) >= 1).all()
    if tile < 1:
        np.testing.assert_allclose(around, np.array(surface.natural.lengths) / tile, rtol=0.15)


@pytest.mark.parametrize("name", ["plane", "plane:1x3", "torus"])
def test_tangents_follow_the_texture(name: str) -> None:
    surface = builtin(name)
    assert surface.natural
    charts = surface.natural.charts(0.2)
    place, uv = surface.vertices[charts.source][charts.faces], charts.uv[charts.faces]
    edges, steps = place[:, 1:] - place[:, :1], uv[:, 1:] - uv[:, :1]
    assert (np.linalg.det(steps) > 0).all()
    along = np.linalg.solve(steps, edges)
    normal = surface.normals[charts.source]
    tangent = charts.tangents[:, :3]
    other = charts.tangents[:, 3:] * np.cross(normal, tangent)
    np.testing.assert_allclose(np.linalg.norm(tangent, axis=1), 1.0)
    np.testing.assert_allclose(np.einsum("ij,ij->i", tangent, normal), 0.0, atol=1e-12)
    for axis, wanted in ((0, tangent), (1, other)):
        got = np.einsum("fi,fi->f", unit(along[:, axis]), wanted[charts.faces[:, 0]])
        assert got.min() > 0.99


@pytest.mark.parametrize("name", ["plane", "plane:1x1"])
def test_plane_is_the_unit_square_facing_up(name: str) -> None:
    surface = builtin(name)
    np.testing.assert_array_equal(surface.vertices.min(axis=0), [-0.5, 0, -0.5])
    np.testing.assert_array_equal(surface.vertices.max(axis=0), [0.5, 0, 0.5])
    np.testing.assert_array_equal(surface.normals, np.tile([0, 1, 0], (len(surface.vertices), 1)))


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("torus:2x3", "torus:2x3: 2 rows and 3 columns, expected 3 to 1024 of each"),
        ("torus:99999x9", "torus:99999x9: 99999 rows and 9 columns, expected 3 to 1024 of each"),
        ("torus:axb", "torus:axb: no such built-in, expected sphere, plane, torus, plane:RxC or torus:RxC"),
        ("plane:0x4", "plane:0x4: 0 rows and 4 columns, expected 1 to 1024 of each"),
        ("torus:", "torus:: no such built-in"),
        ("torus:-4x9", "torus:-4x9: no such built-in"),
        ("torus:4x9x2", "torus:4x9x2: no such built-in"),
    ],
)
def test_bad_names(name: str, message: str) -> None:
    assert is_builtin(name)
    with pytest.raises(MeshError) as caught:
        builtin(name)
    assert str(caught.value).startswith(message)


def test_files_are_no_builtins() -> None:
    assert not any(map(is_builtin, ("sphere.obj", "torus.glb", "./torus", "Plane")))
