from __future__ import annotations

import numpy as np
import pytest

from furbake.pelt.light import crossing
from furbake.pelt.light import scatter as module
from furbake.pelt.light.crossing import hemisphere_rule
from furbake.pelt.light.depth import passing
from furbake.pelt.light.fibre import cylinder, sine
from furbake.pelt.light.scatter import Medium, scatter
from furbake.pelt.light.slabs import Arriving, Slabs, Unscattered

UPRIGHT = np.array([0.0, 0.0, 1.0], np.float32)
RNG = np.random.default_rng(0)


def hairs(shape: tuple[int, ...], direction: np.ndarray = UPRIGHT) -> np.ndarray:
    """Hairs that all lie one way, (*shape, 3)."""
    return np.broadcast_to(direction.astype(np.float32), (*shape, 3))


def dust(sigma: np.ndarray, slab: float, reaching: np.ndarray, albedo: float) -> np.ndarray:
    """∫I dω over all orders, (K, N, N), where light (K, N, N) comes in and all scatter evenly over a black skin."""
    medium = Medium(Slabs(sigma.astype(np.float32), slab, hairs(sigma.shape)), skin=0.0)
    field = reaching[:, None].astype(np.float32)
    nothing, floor = np.zeros((3, *field.shape), np.float32), np.zeros((1, *sigma.shape[1:]), np.float32)
    total = np.zeros_like(field)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(crossing, "sine", lambda tangent, way: np.ones(tangent.shape[:-1], np.float32))
        for _ in range(60):
            field = medium.scattered(Arriving(field, nothing, floor), albedo * np.pi / 4)[0].phi
            total += field
    return total[:, 0]


def chandrasekhar_h(cosine: float, albedo: float) -> float:
    """H(μ): light that leaves the surface of a half-space of evenly scattering matter (Chandrasekhar 1960, ch. V)."""
    node, weight = np.polynomial.legendre.leggauss(64)
    mu, weight = (node + 1) / 2, weight / 2
    h = np.ones(64)
    for _ in range(500):
        h = 1 / (np.sqrt(1 - albedo) + albedo / 2 * ((mu * weight * h) / (mu[:, None] + mu)).sum(1))
    return float(1 / (np.sqrt(1 - albedo) + albedo / 2 * (mu * weight * h / (mu + cosine)).sum()))


@pytest.mark.parametrize("albedo", [0.5, 0.85])
@pytest.mark.parametrize("cosine", [1.0, 0.6, 0.3])
def test_surface_of_deep_even_matter_shines_as_chandrasekhar_says(albedo: float, cosine: float) -> None:
    slabs, depth = 90, 4.0
    step = depth / slabs / cosine
    single = np.exp(-np.arange(slabs)[::-1] * step)
    reaching = np.tile(single[:, None, None], (1, 2, 2))
    light = single + dust(np.full((slabs, 2, 2), depth), 1 / slabs, reaching, albedo)[:, 0, 0]
    assert light[-1] == pytest.approx(chandrasekhar_h(cosine, albedo), rel=0.04)


def test_white_hairs_lose_no_light() -> None:
    """Light that hairs in all directions catch either meets others once it is scattered, or leaves."""
    slabs, slab = 60, 0.01
    sigma = np.full((slabs, 2, 2), 2.0, np.float32)
    tangent = RNG.normal(size=(slabs, 2, 2, 3)).astype(np.float32)
    tangent /= np.linalg.norm(tangent, axis=-1, keepdims=True)
    light = np.array([0.6, 0.0, 0.8])
    width = sine(tangent, light)
    step = sigma * width * slab / light[2]
    above = np.exp(-(np.cumsum(step[::-1], 0)[::-1] - step / 2))

    medium = Medium(Slabs(sigma, slab, tangent), skin=0.0)
    floor = np.zeros((1, 2, 2), np.float32)
    flux = light.astype(np.float32)[:, None, None, None, None] * above[None, :, None]
    arriving = Arriving((above * width)[:, None], flux, floor)
    across = np.moveaxis(tangent, -1, 0)[:, :, None]
    perpendicular = flux - across * (flux * across).sum(0)
    leaves = 0.0
    directions, solid_angles = hemisphere_rule()
    even, across_hairs = arriving.phi / np.pi**2, perpendicular / 8  # what white hairs send on of φ and F⊥
    for ways in (directions, -directions):
        part, _ = medium.sweep(even, across_hairs, floor, ways, solid_angles)
        leaves += part.floor.mean()
    again, _ = medium.scattered(arriving, albedo=1.0)

    def caught(phi: np.ndarray) -> float:
        return float((sigma[:, None] * phi).sum(0).mean() * slab)

    assert leaves > 0.2
    assert caught(again.phi) + leaves == pytest.approx(caught(arriving.phi), rel=0.05)


def test_thick_slabs_scatter_as_much_as_thin_ones(monkeypatch: pytest.MonkeyPatch) -> None:
    """The same fur cut coarser: what a slab takes of its own light must not get lost."""
    monkeypatch.setattr(module, "THINNED", 1.0)  # hairs so thin that none shades itself

    def glow(layers: int) -> float:
        shape = (layers, 2, 2)
        sigma, slab = np.full(shape, 20.0, np.float32), 1.0 / layers
        light, tangent = np.array([[0.0, 0.0, 1.0]]), hairs(shape, np.array([0.8, 0.0, 0.6]))
        depth = sigma * sine(tangent, light[0]) * slab
        above = np.cumsum(depth[::-1], 0)[::-1] - depth
        reaching = (np.exp(-above) * passing(depth))[None]
        none = np.zeros((1, 2, 2), np.float32)
        unscattered = Unscattered(light, 0.8 * reaching, reaching, none)
        seen = scatter(Slabs(sigma, slab, tangent), unscattered, albedo=0.85, skin=0.0).seen[0]
        clear = np.exp(-sigma * slab)
        above = np.cumprod(clear[::-1], 0)[::-1] / clear
        return float((above * (1 - clear) * seen).sum(0).mean())

    assert glow(32) == pytest.approx(glow(128), rel=0.15)
    assert glow(64) == pytest.approx(glow(128), rel=0.02)


def test_light_moves_to_the_side_the_way_it_goes() -> None:
    """One lit column: its neighbours get the same on both sides, the farther the less."""
    reaching = np.zeros((6, 16, 16))
    reaching[3, 8, 8] = 1
    light = dust(np.full((6, 16, 16), 2.0), 0.1, reaching, albedo=0.85)
    np.testing.assert_allclose(light[2, 8, 9:12], light[2, 8, 5:8][::-1], rtol=0.05)
    assert light[2, 8, 9] > light[2, 8, 11] > light[2, 8, 15] > 0
    assert 0.4 < light[4:].sum() / (light[4:].sum() + light[:3].sum()) < 0.6


def fields(lights: np.ndarray, shape: tuple[int, int, int]) -> Unscattered:
    """Some light that reaches hairs, times 0.8 for what they catch of it, and the skin."""
    reaching = RNG.uniform(0.2, 1, (len(lights), *shape)).astype(np.float32)
    return Unscattered(lights, 0.8 * reaching, reaching, RNG.random((len(lights), *shape[1:])).astype(np.float32))


def test_a_bright_skin_lights_the_roots() -> None:
    light = np.array([[0.0, 0.0, 1.0]])
    slabs = Slabs(np.full((6, 8, 8), 2.0, np.float32), 0.1, hairs((6, 8, 8), np.array([0.8, 0, 0.6])))
    given = fields(light, (6, 8, 8))
    black, white = (scatter(slabs, given, albedo=0.85, skin=skin).seen[0].mean((1, 2)) for skin in (0.0, 0.8))
    assert (white > black).all()
    assert (white - black)[0] > (white - black)[-1]


def test_many_lights_at_once_equal_each_alone() -> None:
    shape = (4, 8, 8)
    lights = RNG.normal(size=(5, 3))
    lights /= np.linalg.norm(lights, axis=1, keepdims=True)
    hair = RNG.normal(size=(*shape, 3)).astype(np.float32)
    hair /= np.linalg.norm(hair, axis=-1, keepdims=True)
    slabs = Slabs(RNG.uniform(0, 4, shape).astype(np.float32), 0.1, hair)
    light = fields(lights, shape)
    together = scatter(slabs, light, albedo=0.85, skin=0.25).seen
    for i in range(5):
        one = slice(i, i + 1)
        alone = scatter(slabs, light.of(one), albedo=0.85, skin=0.25).seen
        np.testing.assert_allclose(together[one], alone, rtol=0.03, atol=1e-3)


def test_faint_lights_keep_what_they_scatter() -> None:
    """Among strong lights with a pattern each, one a thousand times fainter: its slabs' means are its own."""
    shape = (4, 8, 8)
    lights = RNG.normal(size=(9, 3))
    lights /= np.linalg.norm(lights, axis=1, keepdims=True)
    slabs = Slabs(RNG.uniform(0, 4, shape).astype(np.float32), 0.1, hairs(shape))
    light = fields(lights, shape)
    for field in (light.caught, light.reaching, light.floor):
        field[-1] *= 1e-3
    light.caught[-1, :-1] = light.reaching[-1, :-1] = 0  # it only reaches the top
    given = {"albedo": 0.85, "skin": 0.25}
    together = scatter(slabs, light, **given, faint=True).seen[-1]
    alone = scatter(slabs, light.of(slice(-1, None)), **given).seen[0]
    np.testing.assert_allclose(together.mean((1, 2)), alone.mean((1, 2)), rtol=0.1)


def test_cylinder_sends_on_all_that_it_takes() -> None:
    """Light that is the same from everywhere: a hair sends as much of it to the eye whichever way it lies."""
    directions, solid_angles = hemisphere_rule()
    both, twice = np.concatenate([directions, -directions]), np.tile(solid_angles, 2)
    for tangent in ([1.0, 0, 0], [0, 0.6, 0.8], [0.6, 0, 0.8], [0.0, 0.0, 1.0]):
        sent = sum(w * cylinder(np.array(tangent), d) for d, w in zip(both, twice, strict=True))
        assert sent == pytest.approx(4 * np.pi, rel=0.04)


def test_light_from_behind_a_lying_hair_hardly_reaches_the_eye() -> None:
    shape = (4, 4, 4)
    light, none = np.array([[0.0, 0.0, 1.0]]), np.zeros((1, *shape), np.float32)
    sigma, skin = np.full(shape, 1e-3, np.float32), np.ones((1, 4, 4), np.float32)
    lying, upright = (
        scatter(
            Slabs(sigma, 0.1, hairs(shape, way)), Unscattered(light, none, none, skin), albedo=0.85, skin=1.0
        ).seen.mean()
        for way in (np.array([1.0, 0, 0]), UPRIGHT)
    )
    assert lying < 0.4 * upright
