"""Projection onto six sides: nothing mirrored, nothing bald, few repeated faces."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st

from furbake.surface.mesh import Surface, clean
from furbake.surface.projection import AXES, frames, nose, project
from furbake.surface.shapes import builtin
from furbake.surface.topology import face_vectors


def torus_by_projection() -> Surface:
    return replace(builtin("torus"), natural=None)


def blob(seed: int) -> Surface:
    """A lumpy closed body."""
    chance = np.random.default_rng(seed)
    ball = trimesh.creation.icosphere(subdivisions=3)
    lumps = chance.normal(size=(6, 3))
    swell = 1 + 0.15 * np.sin(3 * ball.vertices @ lumps.T).sum(axis=1) / 6**0.5
    stretch = chance.uniform(0.5, 1.5, 3)
    return clean("blob", np.asarray(ball.vertices) * swell[:, None] * stretch, np.asarray(ball.faces))


def knife() -> Surface:
    """A thin sharp wedge, all of whose vertices lie on edges."""
    vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 0.02], [1, 0, 0.02], [0, 1, 0.02]], dtype=float)
    faces = [(0, 2, 1), (3, 4, 5), (0, 1, 4), (0, 4, 3), (1, 2, 5), (1, 5, 4), (2, 0, 3), (2, 3, 5)]
    return clean("knife", vertices, np.array(faces))


def box() -> Surface:
    solid = trimesh.creation.box()
    return clean("box", np.asarray(solid.vertices, dtype=float), np.asarray(solid.faces))


def check(surface: Surface, tile: float = 0.2) -> float:
    """Everything that must hold of charts; the share of faces repeated."""
    charts = project(surface, tile)
    uv = charts.uv[charts.faces]
    assert (np.linalg.det(uv[:, 1:] - uv[:, :1]) > 0).all(), "a face is mirrored"

    groups, index = np.unique(charts.group, return_inverse=True)
    np.testing.assert_allclose(np.bincount(index, charts.weights), 1.0, atol=1e-6)
    assert charts.weights.min() >= 0
    assert len(groups) >= len(surface.vertices)

    # Coverage of every corner of every face of the surface, summed over its copies.
    key = np.sort(surface.faces, axis=1)
    order = {tuple(row): i for i, row in enumerate(key.tolist())}
    source = charts.source[charts.faces]
    face = np.array([order[tuple(row)] for row in np.sort(source, axis=1).tolist()])
    coverage = np.zeros((len(surface.faces), 3))
    for corner in range(3):
        slot = np.argmax(surface.faces[face] == source[:, corner, None], axis=1)
        np.add.at(coverage, (face, slot), charts.weights[charts.faces[:, corner]])
    np.testing.assert_allclose(coverage, 1.0, atol=1e-6)

    normal = surface.normals[charts.source]
    tangent = charts.tangents[:, :3]
    np.testing.assert_allclose(np.linalg.norm(tangent, axis=1), 1.0)
    np.testing.assert_allclose(np.einsum("ij,ij->i", tangent, normal), 0.0, atol=1e-9)
    assert set(np.unique(charts.tangents[:, 3])) <= {-1.0, 1.0}

    # One tile is one tile wide where a side is seen straight on, and never wider: projection only shrinks uv.
    place = surface.vertices[charts.source][charts.faces]
    step, length = uv[:, 1] - uv[:, 0], np.linalg.norm(place[:, 1] - place[:, 0], axis=1)
    assert (np.linalg.norm(step, axis=1) * tile <= length + 1e-9).all()
    return len(charts.faces) / len(surface.faces)


@pytest.mark.parametrize(("make", "most"), [(lambda: builtin("sphere"), 1.9), (torus_by_projection, 1.9), (box, 1.0)])
def test_charts(make: Callable[[], Surface], most: float) -> None:
    assert check(make()) <= most


@pytest.mark.parametrize("make", [knife, box])
def test_sharp_bodies(make: Callable[[], Surface]) -> None:
    check(make())


@given(st.integers(0, 1000))
def test_lumpy_bodies(seed: int) -> None:
    assert check(blob(seed)) <= 2.0


def test_b_grows_with_v() -> None:
    surface = builtin("sphere")
    charts = project(surface, 0.2)
    place, uv = surface.vertices[charts.source][charts.faces], charts.uv[charts.faces]
    step = np.linalg.solve(uv[:, 1:] - uv[:, :1], place[:, 1:] - place[:, :1])[:, 1]
    tangent = charts.tangents[charts.faces]
    other = tangent[..., 3:] * np.cross(surface.normals[charts.source][charts.faces], tangent[..., :3])
    used = charts.weights[charts.faces] > 0.05
    assert (np.einsum("fi,fci->fc", step, other)[used] > 0).all()


def test_sides_are_right_handed_and_laid_as_asked() -> None:
    surface = builtin("sphere")
    for guide in ("nose-tail", "down"):
        u, v = frames(surface, guide)
        np.testing.assert_allclose(np.cross(u, v), AXES, atol=1e-12)
    _, v = frames(surface, "nose-tail")
    np.testing.assert_allclose(v[2:4], [[0, 0, -1]] * 2, atol=1e-12)  # above, below: to the tail
    np.testing.assert_allclose(v[4:6], [[0, -1, 0]] * 2, atol=1e-12)  # front, back: down
    assert (v[:2, 2] < -0.9).all()  # flanks: to the tail ...
    assert (v[:2, 1] < -0.2).all()  # ... and a little down
    _, v = frames(surface, "down")
    np.testing.assert_allclose(v[[0, 1, 4, 5]], [[0, -1, 0]] * 4, atol=1e-12)


def animal(length: float, head: float) -> Surface:
    """A long low box with a raised end at `head` (the sign of x)."""
    body = trimesh.creation.box((length, 0.4, 0.4))
    top = trimesh.creation.box((0.3, 0.5, 0.3))
    top.apply_translation([head * (0.5 * length - 0.15), 0.5, 0])
    both = trimesh.util.concatenate([body, top])
    return clean("animal", np.asarray(both.vertices), np.asarray(both.faces))


def test_nose() -> None:
    assert nose(builtin("sphere")).tolist() == [0, 0, 1]
    assert nose(animal(2.0, 1.0)).tolist() == [1, 0, 0]
    assert nose(animal(2.0, -1.0)).tolist() == [-1, 0, 0]
    turned = animal(2.0, 1.0)
    turned = replace(turned, vertices=turned.vertices[:, [2, 1, 0]])
    assert nose(turned).tolist() == [0, 0, 1]


def test_tile_scales_the_texture() -> None:
    surface = builtin("sphere")
    one, two = project(surface, 0.1), project(surface, 0.2)
    np.testing.assert_allclose(np.ptp(one.uv, axis=0) > np.ptp(two.uv, axis=0), True)
    one_uv, two_uv = one.uv[one.faces], two.uv[two.faces]
    np.testing.assert_allclose(one_uv[:, 1:] - one_uv[:, :1], 2 * (two_uv[:, 1:] - two_uv[:, :1]), atol=1e-9)


def test_natural_coordinates_come_first() -> None:
    surface = builtin("torus:8x12")
    charts = project(surface, 0.2)
    assert len(charts.faces) == len(surface.faces)
    assert (charts.weights == 1).all()


def test_stretch_of_a_ball() -> None:
    surface = builtin("sphere")
    charts = project(surface, 0.2)
    place, uv = surface.vertices[charts.source][charts.faces], 0.2 * charts.uv[charts.faces]
    area = 0.5 * np.linalg.norm(face_vectors(surface.vertices[charts.source], charts.faces), axis=1)
    edges, steps = place[:, 1:] - place[:, :1], uv[:, 1:] - uv[:, :1]
    mapped = np.linalg.norm(np.linalg.solve(steps, edges), axis=(1, 2)) / 2**0.5
    weight = area * charts.weights[charts.faces].mean(axis=1)
    assert np.average(mapped, weights=weight) < 1.15
