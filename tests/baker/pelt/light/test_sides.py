"""Lit and dark sides of hairs."""

from __future__ import annotations

import numpy as np
import pytest

from furbake.pelt.hairs.strands import Strands
from furbake.pelt.hairs.volume import voxelise
from furbake.pelt.light.beam import Beam
from furbake.pelt.light.fibre import cylinder
from furbake.pelt.light.sides import Sides

RADIUS, SIZE, HEIGHT = 0.08, 32, 0.5


def unit(vector: np.ndarray) -> np.ndarray:
    return vector / np.linalg.norm(vector)


def ways(seed: int) -> tuple[np.ndarray, np.ndarray]:
    """A fibre that lies nearly level, where the angle around it has a meaning, and a light."""
    rng = np.random.default_rng(seed)
    fibre, light = rng.normal(size=(2, 3))
    return unit(fibre * [1, 1, 0.05]), unit(np.abs(light) * [*np.sign(light[:2]), 1])


def surface(fibre: np.ndarray, place: np.ndarray) -> np.ndarray:
    """Normals (n, 3) of a fibre's surface, seen from above, `place` (n,) radii beside its axis."""
    toward = unit(np.array([0.0, 0.0, 1.0]) - fibre * fibre[2])
    return np.sqrt(1 - place**2)[:, None] * toward + place[:, None] * np.cross(fibre, toward)


@pytest.mark.parametrize("seed", range(8))
def test_part_of_the_width_is_the_mean_of_its_surface(seed: int) -> None:
    fibre, light = ways(seed)
    # A row of voxels beside the axis, as wide as half a radius; then one that shows all of the width.
    level = unit(np.array([fibre[1], -fibre[0]]))
    middles = np.arange(-1, 1.25, 0.5)
    axes = np.broadcast_to(fibre.astype(np.float32)[:, None, None, None], (3, 1, 1, len(middles)))
    off_axis = (middles[:, None] * level)[None, None].astype(np.float32)
    there = np.ones(axes.shape[1:], bool)
    sides = Sides(axes, there, off_axis, np.array([2.0 / len(middles)]))
    along = np.tensordot(light.astype(np.float32), axes, 1)
    found = sides.lit(light, along, slice(0, 1))[0, 0]
    for middle, value in zip(middles, found, strict=True):
        low, high = np.clip([middle - 0.25, middle + 0.25], -1, 1)
        place = low + (np.arange(2000) + 0.5) / 2000 * (high - low)
        radiance = np.maximum(surface(fibre, place) @ light, 0).mean()
        assert value == pytest.approx(4 * radiance, rel=0.03, abs=0.03)
    whole = Sides(axes, there, None, np.array([1.0])).lit(light, along, slice(0, 1))
    np.testing.assert_allclose(whole, cylinder(fibre, light), rtol=1e-3, atol=1e-3)


def broad_hair(lean: tuple[float, float]) -> tuple[Beam, np.ndarray, np.ndarray]:
    """Light in a tile with one broad hair, the hair's direction, and where texels lie beside its axis, radii."""
    s = np.linspace(0, 1, 9)[:, None]
    step = np.array([*lean, HEIGHT])
    points = np.array([0.5, 0.5, 0.0]) - [*(np.array(lean) / 2), 0] + s * step
    strands = Strands(points[None], np.full((1, 9), RADIUS), np.full((1, 9), 0.5), np.zeros((1, 9)))
    beam = Beam(voxelise(strands, HEIGHT, 16, 2 * SIZE, 50.0), 8, SIZE, None)
    middle = (np.arange(SIZE) + 0.5) / SIZE - 0.5
    z = ((np.arange(8) + 0.5) / 8 - 0.5)[:, None, None]
    fibre = unit(step)
    u, v = middle[None, None, :] - lean[0] * z, middle[None, :, None] - lean[1] * z
    return beam, fibre, (u * fibre[1] - v * fibre[0]) / np.hypot(*fibre[:2]) / RADIUS


@pytest.mark.parametrize("lean", [(0.5, 0.0), (-0.2, 0.45)])
@pytest.mark.parametrize("azimuth", [0.4, 2.0, 3.6, 5.2])
def test_texels_of_a_broad_hair_have_the_light_of_their_side(lean: tuple[float, float], azimuth: float) -> None:
    beam, fibre, place = broad_hair(lean)
    light = np.array([0.9 * np.cos(azimuth), 0.9 * np.sin(azimuth), np.sqrt(0.19)])
    seen = beam.to_eye(np.ones_like(beam.sigma), light, beam.along(light))
    inside = (np.abs(place) < 0.8) & (beam.seen > 0.02)
    wanted = 4 * np.maximum(surface(fibre, place[inside]) @ light, 0)
    apart = seen[inside] - wanted
    assert np.sqrt((apart**2).mean()) < 0.4 * wanted.std() + 0.1
    assert abs(apart.mean()) < 0.1 * wanted.mean() + 0.1


@pytest.mark.parametrize("azimuth", [1.2, 2.0, 3.6, 5.2])
def test_a_broad_hair_shades_itself_once(azimuth: float) -> None:
    """Its lit side has all of the light, though T is less on the mean of the hair's voxels."""
    beam, fibre, place = broad_hair((0.5, 0.0))
    light = np.array([0.9 * np.cos(azimuth), 0.9 * np.sin(azimuth), np.sqrt(0.19)])
    seen = beam(light)[0]
    inside = (np.abs(place) < 0.8) & (beam.seen > 0.02)
    wanted = 4 * np.maximum(surface(fibre, place[inside]) @ light, 0)
    assert seen[inside].mean() == pytest.approx(wanted.mean(), rel=0.12)
    lit = wanted > wanted.max() / 2
    assert seen[inside][lit].mean() == pytest.approx(wanted[lit].mean(), rel=0.12)


def test_hairs_take_light_of_others_on_the_side_from_which_it_comes() -> None:
    """A flux F adds 2·n·F to what is even, half of a lamp's contrast (`sides`)."""
    beam, _, place = broad_hair((0.5, 0.0))
    even = np.full((3, 8, SIZE // 2, SIZE // 2), [[[[1.0]]], [[[0.0]]], [[[0.3]]]], np.float32)
    seen = beam.several(even)
    inside = (np.abs(place) < 0.8) & (beam.seen > 0.02)
    # u × (towards the eye) is −v: the side towards +v has x < 0.
    np.testing.assert_allclose(seen[inside], 1 - 2 * place[inside] * 0.3, atol=0.12)
    bare = beam.seen <= 1e-6
    np.testing.assert_allclose(seen[bare], 1, atol=1e-6)
