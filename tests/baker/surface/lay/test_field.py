"""The field: smooth, tangent, never zero, along the guide where there is one, along a stroke where it was combed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import trimesh
from scipy.spatial import cKDTree

from furbake.surface.lay.field import Field, Stroke, comb_field, guide_axis
from furbake.surface.mesh import Surface, clean
from furbake.surface.repair.topology import unit
from furbake.surface.shapes import builtin


def flat(vectors: np.ndarray, normals: np.ndarray) -> np.ndarray:
    """Unit tangent part."""
    return unit(vectors - normals * np.einsum("ij,ij->i", vectors, normals)[:, None])


def degrees(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return np.degrees(np.arccos(np.clip(np.einsum("ij,ij->i", a, b), -1, 1)))


def check(surface: Surface, field: Field) -> None:
    np.testing.assert_allclose(np.linalg.norm(field.direction, axis=1), 1.0, atol=1e-9)
    np.testing.assert_allclose(np.einsum("ij,ij->i", field.direction, surface.normals), 0.0, atol=1e-9)
    assert ((field.strength >= 0) & (field.strength <= 1)).all()


@pytest.mark.parametrize("guide", ["nose-tail", "down"])
@pytest.mark.parametrize("name", ["sphere", "torus:24x48", "plane"])
def test_unit_tangents(name: str, guide: str) -> None:
    surface = builtin(name)
    check(surface, comb_field(surface, guide))


def test_a_plane_is_combed_straight() -> None:
    surface = builtin("plane")
    for guide in ("nose-tail", "down"):
        field = comb_field(surface, guide)
        np.testing.assert_allclose(field.direction, np.tile([0, 0, -1], (len(surface.vertices), 1)), atol=1e-4)


@pytest.mark.parametrize("guide", ["nose-tail", "down"])
def test_on_a_ball_the_field_runs_along_meridians(guide: str) -> None:
    # By symmetry about the guide's axis the smoothed field is the guide's own, laid into the tangent planes.
    surface = builtin("sphere")
    axis = guide_axis(surface, guide)
    field = comb_field(surface, guide)
    away = np.abs(surface.vertices @ axis) < np.cos(0.25)
    off = degrees(field.direction, flat(np.tile(axis, (len(surface.vertices), 1)), surface.normals))
    assert off[away].max() < 3
    # A ball has to have two whorls: they are where the guide enters and leaves, the nose and the tail.
    weak = surface.vertices[field.strength < 0.2]
    assert len(weak)
    assert (np.abs(weak @ axis) > np.cos(0.3)).all()
    assert (weak @ axis > 0).any()
    assert (weak @ axis < 0).any()


def test_hair_lies_down_on_flanks() -> None:
    surface = builtin("sphere")
    flank = np.abs(surface.vertices[:, 0]) > 0.95
    direction = comb_field(surface, "nose-tail").direction[flank]
    assert (direction[:, 2] < -0.85).all()
    assert (direction[:, 1] < -0.2).all()
    assert (comb_field(surface, "down").direction[flank, 1] < -0.9).all()


def arc(turn: float) -> np.ndarray:
    """A line over the unit ball, at an angle to the guide."""
    t = np.linspace(-0.6, 0.6, 7)
    return np.stack([np.cos(t), np.sin(t) * np.cos(turn), np.sin(t) * np.sin(turn)], axis=1)


def off_stroke(surface: Surface, field: Field, line: np.ndarray) -> float:
    """Mean angle between the field and a finely sampled line on the surface."""
    fine = np.linspace(0, len(line) - 1, 200)
    along = np.stack([np.interp(fine, np.arange(len(line)), line[:, axis]) for axis in range(3)], axis=1)
    _, vertex = cKDTree(surface.vertices).query(along)
    way = flat(np.gradient(along, axis=0), surface.normals[vertex])
    return float(degrees(field.direction[vertex], way).mean())


@pytest.mark.parametrize("turn", [0.0, 1.0, 2.0, 3.0, 4.5])
def test_a_stroke_turns_the_fur_along_it(turn: float) -> None:
    surface, line = builtin("sphere"), arc(turn)
    assert off_stroke(surface, comb_field(surface, strokes=[Stroke(line)]), line) < 5
    check(surface, comb_field(surface, strokes=[Stroke(line)]))


def test_strength_of_strokes() -> None:
    surface, line = builtin("sphere"), arc(1.0)
    plain = comb_field(surface)
    off = [off_stroke(surface, comb_field(surface, strokes=[Stroke(line, s)]), line) for s in (0.0, 0.01, 0.1, 1.0)]
    assert off == sorted(off, reverse=True)
    np.testing.assert_allclose(comb_field(surface, strokes=[Stroke(line, 0.0)]).direction, plain.direction, atol=1e-9)
    far = surface.vertices[:, 0] < -0.9
    combed = comb_field(surface, strokes=[Stroke(line)])
    assert degrees(combed.direction[far], plain.direction[far]).max() < 15


def test_a_stroke_stays_on_its_side() -> None:
    slab = trimesh.creation.box((1.0, 0.01, 1.0))
    for _ in range(4):
        slab = slab.subdivide()
    surface = clean("slab", np.asarray(slab.vertices), np.asarray(slab.faces))
    line = np.array([[-0.2, 0.005, 0.0], [0.2, 0.005, 0.0]])
    change = degrees(comb_field(surface, strokes=[Stroke(line)]).direction, comb_field(surface).direction)
    middle = np.linalg.norm(surface.vertices[:, [0, 2]], axis=1) < 0.1
    top = surface.vertices[:, 1] > 0
    assert change[middle & top].min() > 60
    assert change[middle & ~top].max() < 5


@pytest.mark.parametrize("points", [np.zeros((0, 3)), np.zeros((1, 3)), np.zeros((5, 3)), np.full((4, 3), np.nan)])
def test_strokes_that_are_none(points: np.ndarray) -> None:
    surface = builtin("plane")
    field = comb_field(surface, strokes=[Stroke(points)])
    np.testing.assert_array_equal(field.direction, comb_field(surface).direction)


def test_an_attribute_leads() -> None:
    surface = builtin("sphere")
    around = np.cross([0.0, 1.0, 0.0], surface.vertices)
    field = comb_field(surface, attribute=around)
    away = np.abs(surface.vertices[:, 1]) < 0.9
    assert degrees(field.direction, flat(around, surface.normals))[away].mean() < 2
    check(surface, field)
    broken = around.copy()
    broken[::3] = np.nan
    check(surface, comb_field(surface, attribute=broken))
    half = comb_field(surface, attribute=np.where(surface.vertices[:, :1] > 0, around, 0.0))
    left = surface.vertices[:, 0] < -0.7
    assert degrees(half.direction[left], comb_field(surface).direction[left]).mean() < 10


@pytest.mark.parametrize("scale", [1e-6, 1e6])
def test_units_do_not_matter(scale: float) -> None:
    surface = builtin("torus:16x24")
    other = replace(surface, vertices=scale * surface.vertices + 3 * scale)
    line = np.array([[0.4, 0.3, 0.5], [0.7, 0.3, 0.0]])
    one = comb_field(surface, strokes=[Stroke(line)])
    two = comb_field(other, strokes=[Stroke(scale * line + 3 * scale)])
    np.testing.assert_allclose(one.direction, two.direction, atol=1e-3)


def test_a_field_on_anything() -> None:
    chance = np.random.default_rng(0)
    for count in (3, 30, 300):
        corners = chance.normal(size=(count, 3)) * [1, 1e-3, 1]
        surface = clean("soup", corners, chance.integers(0, count, (4 * count, 3)))
        for guide in ("nose-tail", "down"):
            check(surface, comb_field(surface, guide))
