"""Whatever triangles come in, a surface that every later step can stand on goes out, or one sentence."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
import trimesh

from furbake.surface.mesh import MeshError, clean
from furbake.surface.repair.repair import MAX_FACES_READ
from furbake.surface.repair.topology import face_vectors
from helpers.soups import Mesh, assert_sound, strip, volume


def test_moebius_strip_gets_two_sides() -> None:
    surface = clean("band", *strip(40, 1))
    assert_sound(surface)
    assert len(surface.faces) == 80
    assert [line for line in surface.notices if "one-sided" in line] == [
        "band: 1 edge cut to give a one-sided surface two sides"
    ]
    assert not any("one-sided" in line for line in clean("band", *strip(40, 2)).notices)


def test_notices_count(cube: Mesh) -> None:
    vertices, faces = cube
    split = vertices[faces].reshape(-1, 3)
    corners = np.arange(36).reshape(-1, 3)
    junk = np.array([[0, 0, 1], corners[0], corners[3][::-1]])
    turned = np.where(np.arange(12)[:, None] < 3, corners[:, ::-1], corners)
    surface = clean("cube", np.concatenate([split, [[9, 9, 9]]]), np.concatenate([turned, junk]))
    assert surface.notices == (
        "cube: 1 vertex without a face dropped",
        "cube: 36 vertices welded into 8",
        "cube: 2 duplicate faces dropped",
        "cube: 1 face without area dropped",
        "cube: 3 faces turned over",
    )
    assert volume(surface) == pytest.approx(1.0)
    assert clean("cube", vertices, faces).notices == ()


def test_two_boxes_that_share_an_edge_stay_two(cube: Mesh) -> None:
    vertices, faces = cube
    both = np.concatenate([vertices, vertices + np.array([1, 1, 0])])
    surface = clean("boxes", both, np.concatenate([faces, faces + 8]))
    assert_sound(surface)
    assert len(surface.vertices) == 16
    assert volume(surface) == pytest.approx(2.0)
    assert surface.notices == (
        "boxes: 16 vertices welded into 14",
        "boxes: 1 edge of more than two faces cut",
    )
    for corners in (surface.faces[:12], surface.faces[12:]):
        assert len(np.unique(corners)) == 8


def test_bodies_that_touch_in_a_point_are_split(cube: Mesh) -> None:
    vertices, faces = cube
    surface = clean("x", np.concatenate([vertices, vertices + 1]), np.concatenate([faces, faces + 8]))
    assert len(surface.vertices) == 16
    assert surface.notices[-1] == "x: 1 vertex split where pieces touch in a point"


def test_a_wall_on_a_floor_leaves_the_floor_whole() -> None:
    vertices = [(x, 0, z) for x in (-1, 0, 1) for z in (0, 1)] + [(0, 1, 0), (0, 1, 1)]
    floor = [(0, 1, 2), (2, 1, 3), (2, 3, 4), (4, 3, 5)]
    surface = clean("x", np.array(vertices, dtype=float), np.array([*floor, (2, 3, 6), (6, 3, 7)]))
    assert_sound(surface)
    assert len(np.unique(surface.faces[:4])) == 6
    assert len(surface.vertices) == 10


def test_body_with_a_hole_is_turned_outward() -> None:
    ball = trimesh.creation.icosphere(subdivisions=2)
    faces = ball.faces[20:, ::-1]
    surface = clean("ball", ball.vertices, faces)
    assert (
        np.einsum("ij,ij->i", face_vectors(surface.vertices, surface.faces), surface.vertices[surface.faces[:, 0]]) > 0
    ).all()
    assert surface.notices[-1] == f"ball: {len(faces)} faces turned over"


def test_a_cap_in_an_edge_closes_without_a_slit() -> None:
    # A square cut in two; one half is cut again at the middle of the diagonal, and a face without area fills the slit.
    vertices = np.array([(0, 0, 0), (1, 0, 0), (1, 0, -1), (0, 0, -1), (0.5, 0, -0.5)])
    surface = clean("x", vertices, np.array([(0, 1, 2), (0, 4, 3), (4, 2, 3), (0, 2, 4)]))
    assert_sound(surface)
    assert len(surface.faces) == 4
    edges = np.sort(np.stack([surface.faces, np.roll(surface.faces, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    assert (np.unique(edges, axis=0, return_counts=True)[1] == 1).sum() == 4
    assert surface.notices == ("x: 1 sliver mended",)


def test_needle_is_closed_at_its_short_side() -> None:
    disc = [(np.cos(t), 0.0, -np.sin(t)) for t in 2 * np.pi * np.array([0.0, 0.2, 0.2 + 1e-6, 0.5, 0.8])]
    faces = np.array([(0, 1 + i, 1 + (i + 1) % 5) for i in range(5)])
    surface = clean("x", np.array([(0, 0, 0), *disc]), faces)
    assert len(surface.faces) == 4
    assert surface.notices == ("x: 1 sliver mended",) or "welded" in surface.notices[0]


def test_too_many_faces_are_decimated(tmp_path: Path) -> None:
    ball = trimesh.creation.icosphere(subdivisions=5)
    surface = clean("ball", ball.vertices, ball.faces, max_faces=2000)
    assert_sound(surface)
    assert 1800 <= len(surface.faces) <= 2100
    assert volume(surface) == pytest.approx(4 / 3 * np.pi, rel=0.01)
    assert surface.notices == (f"ball: 20480 faces decimated to {len(surface.faces)}",)
    np.testing.assert_allclose(np.linalg.norm(surface.vertices, axis=1), 1.0, atol=0.01)


def test_loose_pieces_are_decimated_or_refused() -> None:
    corners = np.random.default_rng(0).normal(size=(3000, 3))
    try:
        surface = clean("x", corners, np.arange(3000).reshape(-1, 3), max_faces=100)
    except MeshError as error:
        assert re.match(r"x: 1000 faces in pieces too small to simplify, expected at most 100 or", str(error))  # noqa: PT017
    else:
        assert_sound(surface)
        assert len(surface.faces) <= 105


def test_more_faces_than_can_be_handled() -> None:
    faces = np.zeros((MAX_FACES_READ + 1, 3), dtype=np.int64)
    with pytest.raises(MeshError, match=rf"^x: {MAX_FACES_READ + 1} faces, expected at most {MAX_FACES_READ}$"):
        clean("x", np.eye(3), faces)


@pytest.mark.parametrize("scale", [1e-6, 1e-3, 1.0, 1e3, 1e6])
def test_unit_does_not_matter(cube: Mesh, scale: float) -> None:
    surface = clean("cube", scale * cube[0], cube[1])
    assert surface.extent == pytest.approx(scale)
    assert len(surface.vertices) == 8
    assert volume(surface) == pytest.approx(scale**3)
