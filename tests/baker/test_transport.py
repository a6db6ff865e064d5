from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.ndimage import map_coordinates

from furbake.pelt.depth import BentDepth, FlatDepth
from furbake.pelt.fibre import THINNEST, cylinder
from furbake.pelt.paths import spread
from furbake.pelt.strands import Coat, Hairs, grow
from furbake.pelt.transport import (
    LAMP,
    LOWEST,
    Beam,
    hemisphere,
    lamp_cone,
    lowest,
    sample,
)
from furbake.pelt.volume import voxelise


def march(sigma: np.ndarray, slab: float, light: np.ndarray, step: float = 0.1) -> np.ndarray:
    """The oracle: walk from the middle of every voxel to its slab's ceiling and on, adding up σ as it is met."""
    layers, size, _ = sigma.shape
    v, u = np.mgrid[0:size, 0:size].astype(float)
    per_slab = light[:2] / light[2] * slab * size
    steps = int(np.ceil(np.hypot(*per_slab) / step)) + 4
    depth = np.zeros_like(sigma)
    for k in range(layers):
        for j in range(k + 1, layers):
            for t in j - k - 0.5 + (np.arange(steps) + 0.5) / steps:
                depth[k] += map_coordinates(
                    sigma[j], [v + per_slab[1] * t, u + per_slab[0] * t], order=1, mode="grid-wrap"
                )
        depth[k] *= slab / light[2] / steps
    return depth


def march_on_a_ball(sigma: np.ndarray, height: float, light: np.ndarray, beta: float, step: float = 0.05) -> np.ndarray:
    """The oracle: T of straight rays in space from half a slab beside every voxel's middle, in steps of `step` voxels.

    A voxel (k, v, u) lies where a point above the skin does, and a point in space is in the voxel above whose skin it
    is. The middle of the tile is on the axis z; the ball is so even that every texel's frame is that of the middle.
    """
    layers, size, _ = sigma.shape
    v, u = np.mgrid[0:size, 0:size].astype(float)
    depth = np.zeros_like(sigma)
    dt = step / (height * size)
    for k in range(layers):
        at = np.array([0.0, 0.0, beta + (k + 0.5) / layers]) + light * (0.5 / layers + dt / 2)
        while beta < np.linalg.norm(at) < beta + 1:
            above = np.linalg.norm(at) - beta
            angle = np.arccos(np.clip(at[2] / np.linalg.norm(at), -1, 1))
            foot = beta * angle * at[:2] / max(np.hypot(*at[:2]), 1e-12) * height * size
            met = map_coordinates(sigma[int(above * layers)], [v + foot[1], u + foot[0]], order=1, mode="grid-wrap")
            depth[k] += met * (beta / (beta + above)) ** 2 * dt * height
            at = at + light * dt
        if np.linalg.norm(at) < beta + 0.5:
            depth[k] = np.inf
    return np.exp(-depth)


@pytest.mark.parametrize("beta", [1.0, 4.0, 16.0])
@pytest.mark.parametrize("lz", [0.9, 0.5, 0.2, 0.05, -0.1, -0.25, -0.4])
def test_transmittance_on_a_ball_equals_brute_force(beta: float, lz: float) -> None:
    volume = voxelise(grow(Coat(), 0.6, 0), 0.6, 8, 16, 2.2)
    light = np.array([*(np.sqrt(1 - lz * lz) * np.array([0.8, 0.6])), lz])
    clear, skin = BentDepth(volume.sigma, volume.slab, beta).through(light)
    error = clear - march_on_a_ball(volume.sigma, 0.6, light, beta)
    assert np.sqrt((error**2).mean()) <= 0.002
    assert (skin.max() > 0) == (lz > 0)


@pytest.mark.parametrize("elevation", [83, 60, 35, 15, 6])
@pytest.mark.parametrize("azimuth", [20, 135])
def test_optical_depth_equals_brute_force(elevation: float, azimuth: float) -> None:
    volume = voxelise(grow(Coat(), 0.6, 0), 0.6, 8, 32, 2.2)
    e, a = np.radians([elevation, azimuth])
    light = np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
    above = FlatDepth(volume.sigma, volume.slab).above(light)
    error = np.exp(-above) - np.exp(-march(volume.sigma, volume.slab, light))
    assert np.sqrt((error**2).mean()) <= 0.002


def test_own_slab_is_crossed_from_floor_to_ceiling() -> None:
    sigma = np.full((3, 16, 16), 4.0)
    light = np.array([0.6, 0.0, 0.8])
    depth = FlatDepth(sigma, 0.1)
    above, own = depth.above(light), depth.own(light)
    np.testing.assert_allclose(own, 4 * 0.1 / 0.8, rtol=1e-5)
    np.testing.assert_allclose(above[0], 2 * 4 * 0.1 / 0.8, rtol=1e-5)


def test_hairs_on_a_ball_are_drawn_apart() -> None:
    """A short piece of a leaning hair, each end above its place in the tile: its way and length in space."""
    beta, heights, piece = 2.0, np.array([0.25, 0.75]), 1e-5
    tangent = np.array([0.36, 0.48, 0.8])
    ways, longer = spread(np.broadcast_to(tangent.astype(np.float32), (2, 1, 3)), heights, beta)
    for way, length, height in zip(ways[:, 0], longer[:, 0], heights, strict=True):
        ends = []
        for step in (0, piece):
            foot, h = tangent[:2] * step, height + tangent[2] * step
            out = np.array([*foot, np.sqrt(beta**2 - foot @ foot)]) / beta
            ends.append(out * (beta + h))
        found = (ends[1] - ends[0]) / piece
        np.testing.assert_allclose(found, way * length, atol=1e-4)


def test_steep_light_on_a_huge_ball_is_that_on_a_flat_patch() -> None:
    volume = voxelise(grow(Coat(), 0.6, 0), 0.6, 24, 32, 2.2)
    light = np.array([0.06, 0.08, np.sqrt(0.99)])
    flat, ball = FlatDepth(volume.sigma, volume.slab), BentDepth(volume.sigma, volume.slab, 1e5)
    (clear, skin), (clear_ball, skin_ball) = flat.through(light), ball.through(light)
    np.testing.assert_allclose(clear, clear_ball, atol=0.01)
    assert skin.mean() == pytest.approx(skin_ball.mean(), abs=0.002)
    np.testing.assert_allclose(flat.own(light), ball.own(light), atol=0.01)


@pytest.mark.parametrize("beta", [1.0, 4.0, 16.0])
def test_lowest_light_grazes_the_horizon_of_the_tips(beta: float) -> None:
    sigma = np.full((40, 4, 4), 0.1)
    for lower, lit in ((0.0, True), (0.02, False)):
        lz = lowest(beta) * 0.99 - lower
        clear, skin = BentDepth(sigma, 0.01, beta).through(np.array([np.sqrt(1 - lz * lz), 0, lz]))
        assert (clear[-1] > 0).all() == lit
        assert skin.max() == 0


def test_light_is_lost_smoothly_across_the_horizon() -> None:
    """From the zenith to the lowest light each slab gets less and less, and the tips the last of it."""
    fine = voxelise(grow(Coat(), 0.6, 0), 0.6, 16, 64, 2.2)
    heights = np.array([0.9, 0.6, 0.3, 0.1, 0.0, -0.1, -0.2, -0.3, -0.45, lowest() - 0.2])
    lights = np.stack([np.sqrt(1 - heights**2), 0 * heights, heights], 1)
    light = sample(fine, 8, 32, lights)
    assert np.isfinite(light).all()
    assert light.min() >= 0
    deep, top = light[:, 1].mean((1, 2)), light[:, -1].mean((1, 2))
    assert (np.diff(deep) <= 1e-3).all()
    assert deep[7] < 0.02 * deep[0]
    assert top[7] > 0.1 * top[0]
    assert light[-1].max() == 0


@pytest.mark.parametrize("seed", range(6))
def test_cylinder_is_the_mean_over_its_lit_and_seen_side(seed: int) -> None:
    rng = np.random.default_rng(seed)
    fibre = rng.normal(size=3)
    fibre[2] *= 0.05  # seen from the side, where the angle around the fibre has a meaning
    fibre /= np.linalg.norm(fibre)
    light = rng.normal(size=3)
    light[2] = abs(light[2])
    light /= np.linalg.norm(light)

    eye = np.array([0.0, 0.0, 1.0])
    toward = eye - fibre * fibre[2]
    toward /= np.linalg.norm(toward)
    beside = np.cross(fibre, toward)
    across = (np.arange(40_000) + 0.5) / 20_000 - 1  # position across the hair's picture, -1..1
    normal = np.sqrt(1 - across**2)[:, None] * toward + across[:, None] * beside
    radiance = np.maximum(normal @ light, 0).mean()  # per albedo/π and irradiance
    assert cylinder(fibre, light) == pytest.approx(4 * radiance, rel=0.02, abs=0.02)


def test_lights_are_spread_over_the_upper_hemisphere() -> None:
    lights = hemisphere(64)
    np.testing.assert_allclose(np.linalg.norm(lights, axis=1), 1)
    assert lights[:, 2].min() >= LOWEST
    np.testing.assert_allclose(lights.mean(0), [0, 0, 0.5], atol=0.02)


def test_lamp_is_a_small_disc_also_on_the_horizon() -> None:
    for light in hemisphere(40, lowest=-1):
        rays = lamp_cone(light, turn=1.0)
        np.testing.assert_allclose(np.linalg.norm(rays, axis=1), 1)
        assert np.arccos(np.clip(rays @ light, -1, 1)).max() <= LAMP * 1.01


def test_deeper_layers_are_darker_and_light_falls_from_its_side() -> None:
    fine = voxelise(grow(Coat(), 0.6, 0), 0.6, 16, 64, 2.2)
    seen: list[float] = []
    samples = sample(fine, 8, 32, np.array([[0.0, 0.0, 1.0], [0.8, 0.0, 0.6]]), progress=seen.append)
    assert samples.shape == (2, 8, 32, 32)
    assert seen == sorted(seen)
    assert seen[-1] == 1.0
    straight = samples[0].mean((1, 2))
    assert straight[0] < 0.7 * straight[-2]


def test_a_curved_body_lets_grazing_light_in() -> None:
    fine = voxelise(grow(Coat(), 0.6, 0), 0.6, 16, 64, 2.2)
    grazing = np.array([[0.98, 0.0, np.sqrt(1 - 0.98**2)]])
    flat, curved = (sample(fine, 8, 32, grazing, flat=flat)[0, :4].mean() for flat in (True, False))
    assert flat < 0.8 * curved


def test_light_along_the_hairs_passes_between_them() -> None:
    """Upright hairs: light from above is hardly shaded by them, light from the side is."""
    upright = Hairs(stray=0, curl=0, clump=0, length=(1, 1), count=400)
    coat = Coat(guard=upright, under=replace(upright, count=0), lean=(0, 0), clumps=1)
    fine = voxelise(grow(coat, 0.5, 0), 0.5, 16, 64, 4.0)
    beam = Beam(fine, 8, 32, beta=None)
    _, caught, _, floor = beam(np.array([0.0, 0.0, 1.0]), 0)
    _, _, side, _ = beam(np.array([0.8, 0.0, 0.6]), 0)
    covered = fine.coverage.max(0).mean()
    assert floor.mean() > 0.9 * (1 - covered)
    assert side[0].mean() < 0.3 * floor.mean()
    assert caught[-1].max() <= THINNEST * 1.01
