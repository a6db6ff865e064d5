"""Mud sits on hairs, most of it near the tips, and takes up the room that it takes up."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from furbake.pelt.hairs.dirt import COVER, CRUMBS, MUD, SIZES, Crumbs, crumbs, soiled
from furbake.pelt.hairs.states import DIRTY, in_state
from furbake.pelt.hairs.strands import Coat, Strands, grow
from furbake.pelt.hairs.volume import coarsen, voxelise

HEIGHT = 0.5
COAT = Coat()


@pytest.fixture(scope="module")
def dry() -> Strands:
    return grow(COAT, HEIGHT, 0)


def test_seeded(dry: Strands) -> None:
    one, again, other = (crumbs(dry, HEIGHT, seed) for seed in (3, 3, 4))
    np.testing.assert_array_equal(one.centre, again.centre)
    assert len(one.centre) != len(other.centre) or np.abs(one.centre - other.centre).max() > 0.1


def test_crumbs_are_on_their_hairs_and_most_near_the_tips(dry: Strands) -> None:
    mud = crumbs(dry, HEIGHT, 0)
    apart = np.linalg.norm(dry.points[mud.hair] - mud.centre[:, None], axis=-1).min(1)
    assert np.percentile(apart / mud.radius, 95) < 3
    share = mud.centre[:, 2] / dry.points[mud.hair, -1, 2]
    assert (share > 0.5).mean() > 0.7
    assert np.allclose(np.linalg.norm(mud.tangent, axis=1), 1)


def test_as_much_mud_as_told(dry: Strands) -> None:
    mud = crumbs(dry, HEIGHT, 0)
    assert (np.pi * mud.radius**2).sum() == pytest.approx(COVER, rel=0.05)
    assert mud.radius.max() <= 1.2 * HEIGHT * SIZES[1]
    half = crumbs(dry, HEIGHT, 0, 0.5)
    assert len(half.radius) == pytest.approx(len(mud.radius) / 2, abs=CRUMBS)
    np.testing.assert_array_equal(half.centre, mud.centre[: len(half.centre)])


def ball(radius: float = 0.1, height: float = 0.25) -> Crumbs:
    return Crumbs(np.array([[0.5, 0.5, height]]), np.array([radius]), np.zeros(1, np.intp), np.array([[1.0, 0, 0]]))


def test_a_ball_fills_its_volume(dry: Strands) -> None:
    bare = voxelise(dry, HEIGHT, 32, 64, COAT.opacity)
    bare = replace(bare, sigma=0 * bare.sigma)
    found = soiled(bare, ball(), COAT.opacity)
    solid = COAT.opacity / (HEIGHT / 16)
    assert found.sigma.max() == pytest.approx(solid)
    volume = found.sigma.sum() / solid * HEIGHT / 32 / 64**2
    assert volume == pytest.approx(4 / 3 * np.pi * 0.1**3, rel=0.03)
    assert found.tint.max() == pytest.approx(1)
    np.testing.assert_allclose(found.tangent[16, 32, 32], [1, 0, 0], atol=1e-9)


def test_mud_takes_the_place_of_hairs(dry: Strands) -> None:
    clean = voxelise(dry, HEIGHT, 16, 32, COAT.opacity)
    found = soiled(clean, crumbs(dry, HEIGHT, 0), COAT.opacity)
    assert found.sigma.max() <= COAT.opacity / (HEIGHT / 16) * (1 + 1e-9)
    assert (found.coverage.sum() > clean.coverage.sum()).all()
    untouched = found.tint == 0
    assert 0.02 < untouched.mean() < 1
    np.testing.assert_allclose(found.sigma[untouched], clean.sigma[untouched])
    np.testing.assert_allclose(np.linalg.norm(found.tangent, axis=-1), 1, atol=1e-6)


def test_share_of_mud_is_that_of_what_is_seen(dry: Strands) -> None:
    """A lid of mud over the hairs: all of the texel's coverage is mud."""
    lid = Crumbs(np.array([[0.5, 0.5, HEIGHT]]), np.array([2.0]), np.zeros(1, np.intp), np.array([[1.0, 0.0, 0.0]]))
    clean = voxelise(dry, HEIGHT, 8, 16, COAT.opacity)
    stored = coarsen(soiled(clean, lid, COAT.opacity), 4, 8)
    assert stored.tint.min() > 0.99


def test_dirty_fur_is_dry_fur_with_mud(dry: Strands) -> None:
    fur = in_state(DIRTY, COAT, dry, HEIGHT, 0)
    assert fur.strands is dry
    assert (fur.height, fur.coat) == (HEIGHT, COAT)
    assert fur.state.mud == MUD
    share = coarsen(fur.voxels(8, 16), 8, 16).tint
    assert 0 <= share.min() < share.max() <= 1
    assert share[5:].mean() > share[:3].mean()
