"""Wet fur has the same hairs, drawn together and lower, the more the nearer their tips."""

from __future__ import annotations

import numpy as np
import pytest

from furbake.pelt.hairs.states import WETNESS, chosen, in_state, moistened
from furbake.pelt.hairs.strands import Coat, Strands, grow
from furbake.pelt.hairs.tiling import nearest
from furbake.pelt.hairs.volume import voxelise
from furbake.pelt.hairs.wet import ALBEDO, FEWER, SHADE, SHORTER, middles, wet

HEIGHT = 0.5
COAT = Coat()


@pytest.fixture(scope="module")
def dry() -> Strands:
    return grow(COAT, HEIGHT, 0)


def moved(dry: Strands, wetness: float) -> np.ndarray:
    """How far the points of hairs go aside, (S, P, 2)."""
    return wet(dry, wetness, COAT.clumps, 0).points[..., :2] - dry.points[..., :2]


def test_dry_hairs_are_left_alone(dry: Strands) -> None:
    assert wet(dry, 0.0, COAT.clumps, 0) is dry


def test_the_same_hairs_in_every_state(dry: Strands) -> None:
    soaked = wet(dry, 1.0, COAT.clumps, 0)
    np.testing.assert_array_equal(soaked.points[:, 0], dry.points[:, 0])
    assert soaked.radius is dry.radius
    assert soaked.tint is dry.tint
    np.testing.assert_array_equal(soaked.points, wet(dry, 1.0, COAT.clumps, 0).points)
    assert np.abs(soaked.points - wet(dry, 1.0, COAT.clumps, 1).points).max() > 0.02


def test_hairs_go_in_proportion_to_wetness(dry: Strands) -> None:
    np.testing.assert_allclose(moved(dry, 0.25) * 4, moved(dry, 1.0), atol=1e-12)


def test_height_shrinks_by_its_share(dry: Strands) -> None:
    for wetness in (0.5, 1.0):
        found = wet(dry, wetness, COAT.clumps, 0).points[..., 2]
        np.testing.assert_allclose(found, dry.points[..., 2] * (1 - SHORTER * wetness), rtol=1e-12)
    assert SHORTER == 0.15


def test_tips_meet_in_fewer_points(dry: Strands) -> None:
    def crowding(strands: Strands) -> float:
        tips = strands.points[:, -1, :2]
        apart = tips[:, None] - tips[None]
        return float(np.sort(np.hypot(*np.moveaxis(apart - np.round(apart), -1, 0)), axis=1)[:, 1:6].mean())

    assert crowding(wet(dry, 1.0, COAT.clumps, 0)) < 0.6 * crowding(dry)


def test_pull_grows_with_the_square_of_the_way_to_the_tip() -> None:
    """Upright hairs at one place of their own: all go towards the one centre there is."""
    roots = np.array([[0.45, 0.5], [0.5, 0.5], [0.55, 0.5]])
    s = np.linspace(0, 1, 25)
    points = np.concatenate([np.repeat(roots[:, None], 25, 1), np.broadcast_to(HEIGHT * s[:, None], (3, 25, 1))], -1)
    even = np.ones((3, 25))
    strands = Strands(points, 0.01 * even, even, even)
    aside = wet(strands, 1.0, 1, 0).points[..., :2] - points[..., :2]
    np.testing.assert_allclose(aside, aside[:, -1:] * (s * s)[:, None], atol=1e-12)
    assert (np.linalg.norm(aside[:, -1], axis=1) > 0).all()


def test_clumps_reach_across_the_border() -> None:
    _, way = nearest(np.array([[0.98, 0.5]]), np.array([[0.02, 0.5]]))
    np.testing.assert_allclose(way, [[0.04, 0.0]], atol=1e-12)


def test_middle_of_a_clump_leans_as_its_hairs_do() -> None:
    s = np.linspace(0, 1, 25)
    lean = 0.2 * s
    points = np.stack([np.stack([x + lean, 0 * s, HEIGHT * s], -1) for x in (0.2, 0.3)])
    even = np.ones((2, 25))
    found = middles(Strands(points, even, even, even), np.zeros(2, np.intp), 1)
    np.testing.assert_allclose(found[..., 0], np.broadcast_to(lean, (2, 25)), atol=1e-9)
    np.testing.assert_allclose(found[..., 1], 0, atol=1e-12)


def test_skin_shows_between_soaked_clumps(dry: Strands) -> None:
    def bare(strands: Strands, height: float) -> float:
        alpha = voxelise(strands, height, 16, 64, COAT.opacity).coverage
        return float((np.prod(1 - alpha[8:], axis=0) > 0.5).mean())  # through the upper half

    assert bare(wet(dry, 1.0, COAT.clumps, 0), 0.85 * HEIGHT) > bare(dry, HEIGHT) + 0.1


def test_what_a_state_does_to_its_hairs(dry: Strands) -> None:
    assert [state.name for state in chosen(tuple(WETNESS), True)] == [*WETNESS, "dirty"]
    assert list(WETNESS.values()) == [0, 0.25, 0.5, 0.75, 1]
    plain, soaked = moistened("dry", 0.0), moistened("soaked", 1.0)
    assert (plain.length, plain.shade, plain.gloss, plain.sharpness, plain.mud) == (1, 1, 1, 1, None)
    assert (soaked.length, soaked.shade) == (1 - SHORTER, SHADE)
    assert soaked.gloss > 1
    assert soaked.sharpness > 1
    fur = in_state(soaked, COAT, dry, HEIGHT, 0)
    assert fur.coat.albedo == pytest.approx(0.6)
    assert COAT.albedo * ALBEDO == pytest.approx(0.6)
    assert fur.height == pytest.approx(0.85 * HEIGHT)
    assert fur.voxels(4, 16).height == fur.height
    assert 0 < FEWER < 1
