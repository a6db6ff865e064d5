from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter

from furbake.options import preset, preset_names
from furbake.pelt.hairs.strands import Coat, Hairs, Strands, grow
from furbake.pelt.hairs.tiling import nearest, scattered_points, shuffle, tile_noise

PLAIN = Hairs(stray=0.0, curl=0.0, clump=0.0, length=(1.0, 1.0))


def alone(hairs: Hairs, **coat: object) -> Strands:
    """Only guard hairs, upright unless told otherwise, 0.5 high."""
    told = {"lean": (0.0, 0.0), "tufts": 0.0, "even": 0.0, **coat}
    return grow(Coat(guard=hairs, under=replace(hairs, count=0), **told), 0.5, 0)  # type: ignore[arg-type]


def sideways(strands: Strands) -> np.ndarray:
    return strands.points[..., :2] - strands.points[:, :1, :2]


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
    roots = scattered_points(400, np.random.default_rng(0))
    cells, counts = np.unique((roots * 20).astype(int), axis=0, return_counts=True)
    assert len(cells) == 400
    assert counts.max() == 1


def test_hairs_lean_as_told() -> None:
    straight = Hairs(stray=0.0, curl=0.0, clump=0.0, length=(1.0, 1.0))
    strands = grow(Coat(guard=straight, under=replace(straight, count=0), lean=(0.1, -0.2), clumps=1, even=0), 0.5, 0)
    sideways = strands.points[:, -1, :2] - strands.points[:, 0, :2]
    np.testing.assert_allclose(sideways, np.broadcast_to([0.1, -0.2], sideways.shape), atol=1e-12)


def test_clumped_tips_are_nearer_to_each_other_than_roots_are() -> None:
    def spread(clump: float) -> float:
        hairs = Hairs(stray=0.0, curl=0.0, clump=clump)
        tips = grow(Coat(guard=hairs, under=replace(hairs, count=0), lean=(0, 0), even=0.0), 0.5, 0).points[:, -1, :2]
        apart = tips[:, None] - tips[None]
        apart -= np.round(apart)
        return float(np.sort(np.linalg.norm(apart, axis=-1), axis=1)[:, 1].mean())

    assert spread(0.9) < 0.5 * spread(0.0)


@pytest.mark.parametrize("name", preset_names())
def test_every_preset_reaches_its_height_and_stays_in_range(name: str) -> None:
    coat = preset(name).coat
    strands = grow(coat, 0.5, 1)
    assert strands.points[..., 2].max() == pytest.approx(0.5, abs=1e-12)
    assert strands.points[..., 2].min() == 0.0
    assert len(strands.points) == coat.guard.count + coat.under.count
    assert strands.radius.shape == strands.tint.shape == strands.hue.shape == strands.points.shape[:2]
    assert (strands.radius > 0).all()
    for shade in (strands.tint, strands.hue):
        assert 0 <= shade.min() <= shade.max() <= 1


def test_radius_tapers_as_told() -> None:
    for taper in (0.5, 1.0, 4.0):
        radius = alone(replace(PLAIN, radius=(0.02, 0.01), taper=taper)).radius
        s = np.linspace(0, 1, radius.shape[1])
        np.testing.assert_allclose(radius / radius[:, :1], np.broadcast_to(1 - 0.5 * s**taper, radius.shape))
        assert 0.8 * 0.02 <= radius[:, 0].min() < radius[:, 0].max() <= 1.2 * 0.02


def test_a_helix_winds_as_often_and_as_wide_as_told() -> None:
    strands = alone(replace(PLAIN, curl=0.1, turns=3.0, lock=1.0, curl_shape=0.5))
    offset = sideways(strands)
    s = np.linspace(0, 1, offset.shape[1])
    np.testing.assert_allclose(
        np.linalg.norm(offset, axis=-1), np.broadcast_to(0.08 * s**0.5, offset.shape[:2]), atol=1e-9
    )
    angle = np.unwrap(np.arctan2(offset[:, 1:, 1], offset[:, 1:, 0]))
    np.testing.assert_allclose((angle[:, -1] - angle[:, 0]) / (2 * np.pi), 3 * (1 - s[1]), atol=1e-9)


def test_tight_curls_get_the_points_they_need() -> None:
    assert alone(PLAIN).points.shape[1] == 25
    assert alone(replace(PLAIN, curl=0.1, turns=10.0)).points.shape[1] == 81
    assert alone(replace(PLAIN, curl=0.0, turns=10.0)).points.shape[1] == 25
    assert alone(replace(PLAIN, frizz=0.1, kinks=12.0)).points.shape[1] == 49


def test_a_wave_stays_in_its_plane() -> None:
    offset = sideways(alone(replace(PLAIN, wave=0.1, waves=2.0)))
    flat = offset - offset.mean(1, keepdims=True)
    assert np.linalg.svd(flat, compute_uv=False)[:, 1].max() < 1e-9
    assert 0.05 < np.abs(offset).max() <= 0.14


def test_a_lock_turns_together_and_loose_hairs_do_not() -> None:
    def disagreement(lock: float) -> float:
        tips = sideways(alone(replace(PLAIN, curl=0.1, turns=2.0, lock=lock), clumps=1))[:, -1]
        return float(tips.std(0).mean())

    assert disagreement(1.0) < 1e-9
    assert disagreement(0.0) > 0.05


def test_frizz_grows_to_the_tip_and_differs_from_hair_to_hair() -> None:
    offset = sideways(alone(replace(PLAIN, frizz=0.05, kinks=4.0)))
    spread = offset.std(0).mean(-1)
    assert spread[0] == 0.0
    assert spread[-1] == pytest.approx(0.05, rel=0.15)
    assert spread[len(spread) // 2] == pytest.approx(0.025, rel=0.2)


def test_clump_shape_is_where_along_the_hair_it_pulls() -> None:
    def half_way(shape: float) -> float:
        offset = np.linalg.norm(sideways(alone(replace(PLAIN, clump=0.9, clump_shape=shape))), axis=-1)
        return float(np.median(offset[:, 12] / offset[:, -1]))

    assert half_way(0.5) == pytest.approx(0.5**0.5)
    assert half_way(4.0) == pytest.approx(0.5**4)


def test_tufts_shorten_whole_clumps() -> None:
    strands = alone(PLAIN, tufts=0.5, clumps=8)
    lengths = np.unique(strands.points[:, -1, 2].round(9))
    assert len(lengths) == 8
    assert lengths[-1] == 0.5
    assert lengths[0] < 0.6 * lengths[-1]


def test_patches_are_thick_and_thin_and_keep_the_number_of_hairs() -> None:
    def unevenness(patchiness: float) -> float:
        hairs = alone(replace(PLAIN, count=2000), patchiness=patchiness, patches=2)
        assert len(hairs.points) == 2000
        counts, *_ = np.histogram2d(*hairs.points[:, 0, :2].T, bins=10, range=[[0, 1], [0, 1]])
        return float(counts.std() / counts.mean())

    assert unevenness(0.0) < 0.1
    assert unevenness(0.3) > 2 * unevenness(0.0)
    assert unevenness(0.9) > unevenness(0.3)


def test_flow_is_smooth_and_periodic() -> None:
    strands = alone(replace(PLAIN, count=2500), flow=0.1)
    tips, roots = sideways(strands)[:, -1], strands.points[:, 0, :2]
    assert tips.std() == pytest.approx(0.1, rel=0.35)
    shifted = (roots[:, None] - roots[None] + 0.5) % 1 - 0.5  # nearest neighbour across the borders
    distance = np.linalg.norm(shifted, axis=-1) + 9 * np.eye(len(roots))
    assert np.abs(tips - tips[distance.argmin(1)]).mean() < 0.3 * tips.std()


def test_colour_changes_along_the_hair_as_told() -> None:
    strands = alone(replace(PLAIN, tint=0.5, fade=(0.4, 1.2), hue=(0.2, 0.2), ticking=1.0, ticked=0.5), shade=0.0)
    np.testing.assert_allclose(strands.tint[:, [0, -1]], [[0.2, 0.6]] * len(strands.tint))
    np.testing.assert_allclose(strands.hue[:, :13], 0.2, atol=1e-12)
    np.testing.assert_allclose(strands.hue[:, -1], 1.0)


def test_shade_is_the_spread_from_hair_to_hair() -> None:
    assert alone(PLAIN, shade=0.0).tint.std() == 0.0
    assert 0.05 < alone(PLAIN, shade=0.08).tint[:, 0].std() < 0.12


def test_noise_fits_the_tile() -> None:
    at = np.random.default_rng(1).random((4000, 2))
    noise, again = (tile_noise(points, 3, np.random.default_rng(5)) for points in (at, at + np.array([1, -2])))
    np.testing.assert_allclose(noise, again, atol=1e-9)
    assert abs(noise.mean()) < 0.1
    assert noise.std() == pytest.approx(1, abs=0.1)


def test_neighbouring_clumps_differ() -> None:
    """A value that neighbours share shows the tile's repeat from afar: their mean varies less than by chance."""
    centre = scattered_points(100, np.random.default_rng(0))
    values = shuffle(centre, np.random.default_rng(1))
    np.testing.assert_allclose(np.sort(values), (np.arange(100) + 0.5) / 100)
    apart = centre[:, None] - centre
    apart -= np.round(apart)
    near = np.argsort(np.linalg.norm(apart, axis=-1), axis=1)[:, :7]
    by_chance = np.random.default_rng(2).permutation(values)
    assert values[near].mean(1).std() < 0.7 * by_chance[near].mean(1).std()


def test_nearest_centre_is_found_across_the_borders() -> None:
    index, way = nearest(np.array([[0.02, 0.5], [0.6, 0.5]]), np.array([[0.95, 0.5], [0.5, 0.5]]))
    assert index.tolist() == [0, 1]
    np.testing.assert_allclose(way, [[-0.07, 0.0], [-0.1, 0.0]], atol=1e-12)


def test_hairs_bend_to_where_the_skin_would_show() -> None:
    def thinnest(even: float) -> float:
        points = grow(Coat(even=even), 0.5, 7).points
        column, row = np.floor(points[points[..., 2] > 0.25, :2].T * 64).astype(int) % 64
        density = np.bincount(row * 64 + column, minlength=64 * 64).reshape(64, 64)
        density = gaussian_filter(density.astype(float), 3, mode="wrap")
        return float(density.min() / density.mean())

    assert thinnest(1.0) > thinnest(0.0) + 0.2
    assert thinnest(0.0) < thinnest(0.5) < thinnest(1.0)
    roots = [grow(Coat(even=even), 0.5, 7).points[:, 0] for even in (0.0, 1.0)]
    np.testing.assert_array_equal(*roots)
