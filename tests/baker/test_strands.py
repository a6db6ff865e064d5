from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from furbake.pelt.strands import Coat, Hairs, grow, scatter


@pytest.mark.parametrize("seed", range(4))
def test_longest_hair_ends_at_the_height(seed: int) -> None:
    strands = grow(Coat(), height=0.7, seed=seed)
    assert strands.points[:, -1, 2].max() == pytest.approx(0.7, abs=1e-12)
    assert strands.points[:, 0, 2].max() == 0.0


def test_same_seed_same_hairs_other_seed_others() -> None:
    one, again, other = (grow(Coat(), 0.6, seed).points for seed in (3, 3, 4))
    np.testing.assert_array_equal(one, again)
    assert np.abs(one - other).max() > 0.1


def test_roots_leave_no_bald_spot() -> None:
    roots = scatter(400, np.random.default_rng(0))
    cells, counts = np.unique((roots * 20).astype(int), axis=0, return_counts=True)
    assert len(cells) == 400
    assert counts.max() == 1


def test_hairs_lean_as_told() -> None:
    straight = Hairs(stray=0.0, curl=0.0, clump=0.0, length=(1.0, 1.0))
    strands = grow(Coat(guard=straight, under=replace(straight, count=0), lean=(0.1, -0.2), clumps=1), 0.5, 0)
    sideways = strands.points[:, -1, :2] - strands.points[:, 0, :2]
    np.testing.assert_allclose(sideways, np.broadcast_to([0.1, -0.2], sideways.shape), atol=1e-12)


def test_clumped_tips_are_nearer_to_each_other_than_roots_are() -> None:
    def spread(clump: float) -> float:
        hairs = Hairs(stray=0.0, curl=0.0, clump=clump)
        tips = grow(Coat(guard=hairs, under=replace(hairs, count=0), lean=(0, 0)), 0.5, 0).points[:, -1, :2]
        apart = tips[:, None] - tips[None]
        apart -= np.round(apart)
        return float(np.sort(np.linalg.norm(apart, axis=-1), axis=1)[:, 1].mean())

    assert spread(0.9) < 0.5 * spread(0.0)
