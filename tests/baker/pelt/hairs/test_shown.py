from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from furbake.options import preset
from furbake.pelt.hairs.shown import (
    BETWEEN,
    PIXELS,
    open_share,
    powers,
    seen_from_above_by_slab,
    shown_slabs,
    slant,
    spread_of,
    uppermost,
)
from furbake.pelt.hairs.strands import Strands, grow
from furbake.pelt.hairs.volume import coarsen, fine_shape, moved, voxelise

PAPER = preset("paper")

HEIGHT, LAYERS, SIZE = PAPER.own_height, 8, 32


def first_hit(strands: Strands, ray: NDArray[np.float64], points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Height of the uppermost hair on rays of a slope (2,) that meet the skin at points (n, 2), −1 where there is none.

    Brute force: a segment of a hair is hit where it comes nearer to the ray than its radius.
    """
    bottom, top = strands.points[:, :-1].reshape(-1, 3), strands.points[:, 1:].reshape(-1, 3)
    thick = (strands.radius[:, :-1] + strands.radius[:, 1:]).ravel() / 2
    way = np.array([*ray, 1.0]) / np.sqrt(1 + ray @ ray)
    best = np.full(len(points), -1.0)
    for i, point in enumerate(points):
        # The copy of the tile in which each segment's middle is nearest to the ray.
        middle = (bottom + top) / 2
        shift = np.zeros_like(middle)
        shift[:, :2] = np.round(point + ray * middle[:, 2:] - middle[:, :2])
        p, d = bottom + shift - np.array([*point, 0.0]), top - bottom
        across, lay = p - (p @ way)[:, None] * way, d - (d @ way)[:, None] * way
        share = np.clip(-(across * lay).sum(1) / np.maximum((lay * lay).sum(1), 1e-18), 0, 1)
        hit = np.linalg.norm(across + share[:, None] * lay, axis=1) < thick
        if hit.any():
            best[i] = (bottom[:, 2] + share * d[:, 2])[hit].max()
    return best


@pytest.fixture(scope="module")
def strands() -> Strands:
    return grow(PAPER.coat, HEIGHT, PAPER.seed)


def test_uppermost_hairs_are_those_that_rays_from_above_hit(strands: Strands) -> None:
    pixel = np.random.default_rng(1).integers(PIXELS, size=(400, 2))
    hit = first_hit(strands, np.zeros(2), (pixel + 0.5) / PIXELS)
    hit = np.where(hit < 0, -1.0, hit / HEIGHT)
    found = uppermost(strands, HEIGHT)[pixel[:, 1] * PIXELS + pixel[:, 0]]
    assert np.mean(np.abs(found - hit) < 0.03) > 0.95


def test_slabs_show_as_much_of_each_height_as_hairs_do(strands: Strands) -> None:
    """Beside brute force on other points of the tile; without powers slabs show too little of the skin."""
    fine = voxelise(strands, HEIGHT, *fine_shape(LAYERS, SIZE, HEIGHT), PAPER.coat.opacity)
    hit = first_hit(strands, np.zeros(2), np.random.default_rng(2).random((1500, 2)))
    truth = np.array([np.mean(hit >= k / LAYERS * HEIGHT) for k in range(LAYERS)])

    def off(coverage: NDArray[np.float64]) -> float:
        hidden = 1 - np.cumprod(1 - coverage[::-1], axis=0)[::-1]
        return float(np.abs(hidden.mean((1, 2)) - truth).mean())

    before, after = coarsen(fine, LAYERS, SIZE), shown_slabs(fine, strands, LAYERS, SIZE)
    assert off(after.coverage) < 0.03 < off(before.coverage)
    np.testing.assert_array_equal(before.tint, after.tint)


def test_powers_keep_slabs_that_show_enough_already() -> None:
    coverage = np.stack([np.full((8, 8), 0.4), np.full((8, 8), 0.5)])
    np.testing.assert_allclose(powers(coverage, np.array([0.2, 0.5])), 1, atol=1e-4)
    assert powers(coverage, np.array([0.0, 0.0])).max() < 0.11
    assert powers(np.zeros((2, 8, 8)), np.array([0.2, 0.5])).max() <= 4


def test_hairs_without_length_hide_nothing() -> None:
    """Hairs of no length hide nothing, and bare skin is seen through all slabs."""
    none = Strands(np.zeros((2, 3, 3)), np.zeros((2, 3)), np.zeros((2, 3)), np.zeros((2, 3)))
    top = uppermost(none, 0.5)
    with np.errstate(all="raise"):
        assert seen_from_above_by_slab(top, 4).sum() < 1e-3


def leaning(slopes: NDArray[np.float64]) -> Strands:
    """A straight hair of each slope (n, 2), `HEIGHT` high."""
    s = np.linspace(0, 1, 5)[None, :, None]
    points = s * np.column_stack([slopes, np.ones(len(slopes))])[:, None] * HEIGHT
    return Strands(points, np.full(points.shape[:2], 0.01), np.zeros(points.shape[:2]), np.zeros(points.shape[:2]))


def test_hairs_that_lean_alike_have_no_spread() -> None:
    assert spread_of(leaning(np.full((20, 2), 0.7)), HEIGHT) == 0.01


def test_spread_is_how_far_slopes_are_from_their_mean() -> None:
    turn = np.linspace(0, 2 * np.pi, 40, endpoint=False)
    ring = np.column_stack([np.cos(turn), np.sin(turn)]) * 0.4 + [0.8, 0.1]
    assert spread_of(leaning(ring), HEIGHT) == pytest.approx(0.4)


@pytest.mark.parametrize("ray", [(1.5, 0.0), (0.0, -1.5), (0.0, -3.0)])
def test_sparse_hairs_hide_the_skin_from_aside_as_brute_force_says(ray: tuple[float, float]) -> None:
    """By their slopes within .1; as dust, by 1/n·v, they would show .15 more of it and above."""
    coat = replace(
        PAPER.coat,
        guard=replace(PAPER.coat.guard, count=80, radius=(0.012, 0.004)),
        under=replace(PAPER.coat.under, count=0),
    )
    hairs = grow(coat, HEIGHT, 1)
    slabs = shown_slabs(voxelise(hairs, HEIGHT, *fine_shape(LAYERS, SIZE, HEIGHT), coat.opacity), hairs, LAYERS, SIZE)
    share, spread = open_share(slabs.coverage), spread_of(hairs, HEIGHT)
    points = np.random.default_rng(3).random((800, 2))
    assert share == pytest.approx(np.mean(first_hit(hairs, np.zeros(2), points) < 0), abs=0.05)
    slope, truth = np.array(ray), np.mean(first_hit(hairs, np.array(ray), points) < 0)
    eye = np.append(slope, 1) / np.hypot(1, np.linalg.norm(slope))
    lean = np.gradient(slabs.drift, HEIGHT / LAYERS, axis=0)

    def clear(powers_of_slabs: list[float]) -> float:
        """Share of the skin that the eye sees through all slabs."""
        left = np.ones((SIZE, SIZE))
        for k, power in enumerate(powers_of_slabs):
            read = moved(slabs.coverage[k].astype(np.float32), slope * HEIGHT * (k + 0.5) / LAYERS * SIZE + BETWEEN)
            left *= (1 - np.minimum(read, 0.996)) ** power
        return float(left.mean())

    assert abs(clear([slant(eye, lean[k], spread, share) for k in range(LAYERS)]) - truth) < 0.1
    assert clear([1 / eye[2]] * LAYERS) - truth > 0.15


def test_dense_fur_hides_the_skin_as_dust_and_no_fur_less_than_that() -> None:
    ring = np.random.default_rng(5).normal(size=(40, 3))
    for eye in np.abs(ring) / np.linalg.norm(ring, axis=1)[:, None]:
        assert slant(eye, np.array([0.3, -0.1]), 0.2, 0.1) == pytest.approx(1 / eye[2])
        assert slant(eye, np.array([0.3, 0.4]), 0.2, 0.9) >= 1 / eye[2]
