from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.ndimage import map_coordinates

from furbake.options import preset
from furbake.pelt.hairs.shown import shown_slabs
from furbake.pelt.hairs.strands import Coat, Hairs, grow
from furbake.pelt.hairs.volume import fine_shape, voxelise
from furbake.pelt.light.beam import Beam
from furbake.pelt.light.depth import Depth
from furbake.pelt.light.fibre import THINNEST, cylinder
from furbake.pelt.light.paths import spread
from furbake.pelt.light.transport import LOWEST, Setting, hemisphere, lowest, sample, sample_apart
from furbake.study.verify.tile import composite


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
    clear, skin = Depth(volume.sigma, volume.slab, beta).through(light)
    error = clear - march_on_a_ball(volume.sigma, 0.6, light, beta)
    assert np.sqrt((error**2).mean()) <= 0.002
    assert (skin.max() > 0) == (lz > 0)


def test_own_slab_is_crossed_over_its_thickness() -> None:
    sigma = np.full((3, 16, 16), 4.0)
    depth = Depth(sigma, 0.1, None)
    light = np.array([0.6, 0.0, 0.8])
    clear, skin = depth.through(light)
    np.testing.assert_allclose(-np.log(clear[0]), 4 * (0.25 / 0.8 - 0.05), rtol=1e-4)
    np.testing.assert_allclose(-np.log(skin), 4 * 0.3 / 0.8, rtol=1e-4)


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


@pytest.mark.parametrize("lz", [0.99, 0.5, 0.15])
def test_a_flat_patch_equals_brute_force(lz: float) -> None:
    """Against a march over a body so large that it is flat."""
    volume = voxelise(grow(Coat(), 0.6, 0), 0.6, 8, 16, 2.2)
    light = np.array([*(np.sqrt(1 - lz * lz) * np.array([0.8, 0.6])), lz])
    clear, _ = Depth(volume.sigma, volume.slab, None).through(light)
    error = clear - march_on_a_ball(volume.sigma, 0.6, light, 1e4)
    assert np.sqrt((error**2).mean()) <= 0.002


@pytest.mark.parametrize("beta", [1.0, 4.0, 16.0])
def test_lowest_light_grazes_the_horizon_of_the_tips(beta: float) -> None:
    sigma = np.full((40, 4, 4), 0.1)
    for lower, lit in ((0.0, True), (0.02, False)):
        lz = lowest(beta) * 0.99 - lower
        clear, skin = Depth(sigma, 0.01, beta).through(np.array([np.sqrt(1 - lz * lz), 0, lz]))
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
    assert top[6] > 0.3 * top[0]
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
    flat, curved = (sample(fine, 8, 32, grazing, Setting(flat=flat))[0, :4].mean() for flat in (True, False))
    assert flat < 0.8 * curved


def test_light_along_the_hairs_passes_between_them() -> None:
    """Upright hairs: light from above is hardly shaded by them, light from the side is."""
    upright = Hairs(stray=0, curl=0, clump=0, length=(1, 1), count=400)
    coat = Coat(guard=upright, under=replace(upright, count=0), lean=(0, 0), clumps=1)
    fine = voxelise(grow(coat, 0.5, 0), 0.5, 16, 64, 4.0)
    beam = Beam(fine, 8, 32, beta=None)
    _, caught, _, floor = beam(np.array([0.0, 0.0, 1.0]))
    _, _, side, _ = beam(np.array([0.8, 0.0, 0.6]))
    covered = fine.coverage.max(0).mean()
    assert floor.mean() > 0.9 * (1 - covered)
    assert side[0].mean() < 0.3 * floor.mean()
    assert caught[-1].max() <= THINNEST * 1.25  # what a hair shades of itself is given back on the mean


@pytest.mark.parametrize("size", [16, 32, 64])
@pytest.mark.parametrize("radius", [0.004, 0.012])
def test_a_hair_takes_of_light_what_meets_its_width(size: int, radius: float) -> None:
    """A lone hair, upright: its shadow on the skin, and no shadow of it on itself."""
    height, light = 0.5, np.array([0.48, 0.64, 0.6])
    alone = Hairs(stray=0, curl=0, clump=0, length=(1, 1), count=1, radius=(radius, radius))
    coat = Coat(guard=alone, under=replace(alone, count=0), lean=(0, 0), clumps=1)
    beam = Beam(voxelise(grow(coat, height, 0), height, 16, 2 * size, 4.0), 8, size, beta=None)
    passed, floor = beam.reach(light)
    shadow = 2 * radius * height * 0.8 / 0.6 + np.pi * radius**2
    assert 1 - floor.mean() / 0.6 == pytest.approx(shadow, rel=0.25)
    assert (passed * beam.breadth).sum() / beam.breadth.sum() == pytest.approx(1, rel=0.15)


@pytest.mark.parametrize("lz", [0.9, 0.5, 0.2])
def test_light_between_upright_hairs_equals_rays_against_their_cylinders(lz: float) -> None:
    """As bright at every angle as rays find it that start at the hairs' lit sides and meet discs."""
    height, radius, rng = 0.5, 0.008, np.random.default_rng(0)
    upright = Hairs(stray=0, curl=0, clump=0, length=(1, 1), count=400, radius=(radius, radius))
    coat = Coat(guard=upright, under=replace(upright, count=0), lean=(0, 0), clumps=1, tufts=0.0)
    strands = grow(coat, height, 0)
    fine = voxelise(strands, height, 32, 128, 6.0)
    light = np.array([*(np.sqrt(1 - lz * lz) * np.array([0.6, 0.8])), lz])
    beam = Beam(fine, 16, 64, beta=None)
    found = float((beam.reach(light)[0] * beam.breadth).sum() / beam.breadth.sum())

    roots, way = strands.points[:, 0, :2] % 1, light[:2] / np.linalg.norm(light[:2])
    shift = np.stack(np.meshgrid(*2 * [np.arange(-4, 5)]), -1).reshape(-1, 1, 2)
    discs = (roots + shift).reshape(-1, 2)
    lit = []
    for root in roots[rng.integers(len(roots), size=300)]:
        side = rng.uniform(-1, 1)  # across the light: as much of it falls on every part of the width
        start = root + radius * (side * np.array([-way[1], way[0]]) + np.sqrt(1 - side**2) * way)
        to = discs - start
        along, beside = to @ way, to @ np.array([-way[1], way[0]])
        met = (np.abs(beside) < radius) & (along > 1e-9) & (np.linalg.norm(discs - root, axis=1) > 1e-9)
        free = height - rng.uniform(0, height, 40)
        reach = np.min(along[met] - np.sqrt(radius**2 - beside[met] ** 2), initial=np.inf)
        lit.append((free / lz * np.sqrt(1 - lz * lz) < reach).mean())
    assert found == pytest.approx(np.mean(lit), rel=0.12)


@pytest.mark.parametrize("name", ["bunny", "paper"])
def test_fine_texels_are_lit_as_coarse_ones(name: str) -> None:
    """Seen from above: light that met one hair, and light that met several, by the same hairs in two resolutions."""
    fur, lights = preset(name), np.array([[0.3, 0.0, 0.954], [0.0, 0.8, 0.6], [-0.9, 0.3, 0.316]])
    strands, seen = grow(fur.coat, fur.height_share, fur.seed), []
    for layers, size in ((16, 64), (24, 128)):
        fine = voxelise(strands, fur.height_share, *fine_shape(layers, size, fur.height_share), fur.coat.opacity)
        alpha = shown_slabs(fine, strands, layers, size).coverage
        single, multiple, _ = sample_apart(fine, layers, size, lights, Setting(fur.coat.albedo, flat=True))
        seen.append([composite(light, alpha).mean((1, 2)) for light in (single, multiple)])
    np.testing.assert_allclose(seen[1], seen[0], rtol=0.1)
