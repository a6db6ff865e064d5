"""Mean curves: what is known comes back, what tips do not see is dark, and numbers beside them are found again."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from furbake.options import BakeOptions, preset
from furbake.pelt.curves import RADII, Curves, abscissa, elevation, lean_direction, shares
from furbake.pelt.hairs.states import DIRTY, PeltState, in_state
from furbake.pelt.hairs.strands import grow
from furbake.pelt.hairs.volume import coarsen
from furbake.pelt.light.paths import lowest
from furbake.pelt.light.transport import Setting, hemisphere, sample_apart
from furbake.pelt.means import Measured, coarser, directions, mean_light, measure, rounded, shared, tables
from furbake.pelt.texels.basis import PTM, Basis, smooth_terms
from furbake.pelt.texels.eigen import eigen, eigen_of_slabs
from furbake.pelt.texels.fit import Judge, fit, relight
from furbake.pelt.texels.quantise import byte_range, dequantise, gram, quantise
from furbake.tile.fitting import fit_pelts, mean_curves
from furbake.tile.lighting import Sampled, grown, light, sampled, under

RNG = np.random.default_rng(5)
LEAN = np.array([0.6, 0.8])
SMALL = replace(preset("paper"), layers=6, size=16, lights=32)


def known(count: int = 2) -> tuple[Curves, np.ndarray]:
    """Smooth curves that are dark where tips see nothing, and weights of five slabs."""
    x = np.arange(17) / 16
    even = np.stack([[x ** (1 + q) * (1 + 0.2 * r) for r in range(3)] for q in range(count)])
    along = even * (1 - x) * np.linspace(-0.8, 0.8, count)[:, None, None]
    return Curves(even, along, LEAN), RNG.uniform(0.2, 1, (5, count))


def around(beta: float, count: int) -> np.ndarray:
    """Lights evenly spread from the lowest that tips see to the zenith, (count, 3)."""
    z = elevation((np.arange(count) + 0.5) / count * 16, beta)
    azimuth = 2.4 * np.arange(count)
    return np.stack([*(np.sqrt(1 - z * z) * [np.cos(azimuth), np.sin(azimuth)]), z], -1)


def measured(curves: Curves, weights: np.ndarray, beta: float, lights: np.ndarray) -> Measured:
    return Measured(beta, lights, curves.mean(lights, weights, beta))


@pytest.mark.parametrize("beta", [1.0, 4.0, 7.0, 16.0])
def test_abscissa_goes_from_the_lowest_light_to_the_zenith(beta: float) -> None:
    z = np.array([-1.0, lowest(beta), lowest(beta) / 2, 0.0, 0.04, 0.25, 1.0])
    np.testing.assert_allclose(abscissa(z, beta), [0, 0, 3, 6, 8, 11, 16], atol=1e-9)
    x = np.linspace(0.1, 16, 50)
    np.testing.assert_allclose(abscissa(elevation(x, beta), beta), x, atol=1e-9)


def test_known_curves_come_back_from_their_values() -> None:
    curves, weights = known()
    bodies = [measured(curves, weights, beta, directions(beta)) for beta in RADII]
    each = tables(measured(curves, weights, 4.0, hemisphere(64)), bodies, LEAN)
    found, (own,) = shared([each], [np.ones(5)], LEAN, 2)
    assert found.count == 2
    for beta in (1.0, 3.0, 4.0, 16.0):
        lights = around(beta, 500)
        right = curves.mean(lights, weights, beta)
        assert np.abs(found.mean(lights, own, beta) - right).max() < 0.015 * right.max()


def test_light_below_the_horizon_is_nearly_as_dim_as_in_the_hairs() -> None:
    """On a body between two of the tables' radii, of the light that an eye above sees; once it was 1.35 of it."""
    options = replace(SMALL, layers=8)
    _, fine, volume = grown(options)
    own = under(hemisphere(32), fine, options)
    home = Measured(4.0, hemisphere(32), mean_light(own, volume.coverage))
    lean = lean_direction(fine.drift[-1])
    each = tables(home, measure(fine, 8, 16, options.coat), lean)
    cover = volume.coverage.mean((1, 2))
    curves, (weights,) = shared([each], [cover], lean)
    seen = cover * [np.prod(1 - cover[k + 1 :]) for k in range(8)]
    for share in (0.1, 0.2, 0.3):
        z, azimuth = share * lowest(8.0), np.arange(8) * np.pi / 4 + 0.3
        lights = np.stack([*(np.sqrt(1 - z * z) * np.array([np.cos(azimuth), np.sin(azimuth)])), np.full(8, z)], -1)
        parts = sample_apart(fine, 8, 16, lights, Setting(options.coat.albedo, options.coat.skin, beta=8.0))[:2]
        right = sum(mean_light(part, volume.coverage) for part in parts)
        assert 0.9 < (curves.mean(lights, weights, 8.0) @ seen).sum() / (right @ seen).sum() < 1.28


def test_coarse_voxels_that_are_too_bright_are_scaled() -> None:
    curves, weights = known()
    bodies = [measured(curves, 1.5 * weights, beta, directions(beta)) for beta in RADII]
    own = measured(curves, weights, 4.0, hemisphere(64))
    each = tables(own, bodies, LEAN)
    found, (again,) = shared([each], [np.ones(5)], LEAN)
    lights = around(1.0, 200)
    right = curves.mean(lights, weights, 1.0)
    assert np.abs(found.mean(lights, again, 1.0) - right).max() < 0.02 * right.max()


def test_nothing_below_the_horizon_lights_a_flat_patch() -> None:
    curves, weights = known()
    own = measured(curves, weights, 4.0, hemisphere(64, lowest=0.1))
    found, (again,) = shared([tables(own, (), LEAN)], [np.ones(5)], LEAN)
    below = around(4.0, 64)[:23]
    assert (below[:, 2] < 0).all()
    assert (found.mean(below, again) == 0).all()
    np.testing.assert_allclose(found.mean(own.lights, again), own.values, atol=0.02 * own.values.max())
    np.testing.assert_array_equal(found.mean(own.lights, again, 1.0), found.mean(own.lights, again, 16.0))


def test_tables_are_nowhere_below_0() -> None:
    chance = np.random.default_rng(1)
    bodies = [Measured(beta, directions(beta), chance.uniform(0, 1, (32, 8)) ** 4) for beta in RADII]
    even, along = np.moveaxis(
        tables(Measured(4.0, hemisphere(64), chance.uniform(0, 1, (64, 8)) ** 4), bodies, LEAN), 1, 0
    )
    across = np.sqrt(1 - np.maximum(elevation(np.arange(17.0), 4.0), 0) ** 2)
    assert (even >= np.abs(along) * across - 1e-9).all()
    assert np.abs(along).max() > 0.1


def test_numbers_are_rounded_as_they_are_written() -> None:
    assert rounded(np.array([0.000123456, -12345.6, 0.0])).tolist() == [0.0001235, -12350.0, 0.0]


def test_coefficients_that_curves_multiply_are_found_again() -> None:
    curves, weights = known()
    lights = hemisphere(40)
    mean = curves.mean(lights, weights)
    right = RNG.uniform(-0.2, 0.2, (5, 4, 4, 6)) + np.eye(6)[5]
    samples = relight(right, PTM, lights, mean)
    assert samples.min() > 0
    np.testing.assert_allclose(fit(samples.astype(float), PTM, lights, mean), right, atol=1e-4)
    below = around(4.0, 64)[:20]
    dim = relight(right, PTM, below, curves.mean(below, weights))
    held = np.concatenate([below[:, :2] / np.hypot(*below[:, :2].T)[:, None], np.zeros((20, 1))], 1)
    plain = relight(right, PTM, held) * curves.mean(below, weights)[:, :, None, None]
    np.testing.assert_allclose(dim, np.maximum(plain, 0), rtol=1e-5)


def test_eigen_finds_the_functions_that_curves_multiply() -> None:
    curves, weights = known()
    lights = hemisphere(64)
    mean = curves.mean(lights, weights)
    terms = smooth_terms(2)
    functions = Basis("eigen", 2, np.concatenate([np.eye(1, terms), RNG.normal(0, 0.2, (3, terms))]))
    right = RNG.normal(0, 1, (5, 8, 8, 4)) + 2 * np.eye(4)[0]
    samples = np.einsum("nk,nc,kyxc->nkyx", mean, functions(lights), right)
    alpha = np.ones((5, 8, 8))
    found = eigen_of_slabs(samples, alpha, lights, mean, 4)
    plain = eigen(samples.reshape(len(lights), -1), alpha.ravel(), lights, 4)

    def off(basis: Basis, curve: np.ndarray | None) -> float:
        phi = basis(lights)
        fitted = fit(samples, basis, lights, curve)
        scale = np.ones_like(mean) if curve is None else curve
        return float(np.abs(np.einsum("nk,nc,kyxc->nkyx", scale, phi, fitted) - samples).mean() / samples.std())

    assert off(found, mean) < 0.02
    assert off(found, mean) < 0.2 * off(plain, None)
    assert found.coefficients == 4
    np.testing.assert_array_equal(found(lights)[:, 0], 1)
    means = fit(samples, found, lights, mean).mean((1, 2)) @ found(lights).T
    np.testing.assert_allclose(means.T * mean, samples.mean((2, 3)), atol=0.02 * samples.std())


def test_bytes_suit_each_slab() -> None:
    """Rounding errors are played off in the light of the slab itself: closer than with one Gram matrix for all."""
    curves, weights = known()
    lights = hemisphere(64)
    mean = curves.mean(lights, weights) * np.linspace(0, 3, 5)
    coefficients = RNG.normal(0, 0.3, (5, 16, 16, 6)) + np.eye(6)[5]
    scale, bias = byte_range(coefficients, np.ones((5, 16, 16)))
    phi = PTM(lights)

    def noise(codes: np.ndarray) -> float:
        error = dequantise(codes, scale, bias) - coefficients
        return float((np.einsum("nk,nc,kyxc->nkyx", mean, phi, error) ** 2).mean())

    own = gram(phi, mean)
    assert own.shape == (5, 6, 6)
    np.testing.assert_allclose(own[3], (phi * mean[:, 3:4]).T @ (phi * mean[:, 3:4]) / 64, rtol=1e-6)
    assert noise(quantise(coefficients, scale, bias, own)) < 0.99 * noise(
        quantise(coefficients, scale, bias, gram(phi))
    )
    assert np.abs(dequantise(quantise(coefficients, scale, bias, own), scale, bias)[0] - coefficients[0]).max() < 0.2


def test_measured_means_are_those_of_the_samples() -> None:
    _, fine, _ = grown(SMALL)
    bodies = measure(fine, 6, 16, SMALL.coat)
    coverage = coarsen(fine, 6, 16).coverage
    assert [body.beta for body in bodies] == list(RADII)
    dark = [body.values[body.lights[:, 2] < 0].max(0) for body in bodies]
    assert (dark[0] > dark[2]).all()  # the smaller the body, the farther light comes round it
    home = bodies[1]
    samples = under(home.lights, fine, SMALL)
    for lit, values in zip(samples[18:22], home.values[18:22], strict=True):
        for slab, alpha, value in zip(lit, coverage, values, strict=True):
            assert np.average(slab.ravel(), weights=alpha.ravel()) == pytest.approx(value, rel=1e-4)


@pytest.mark.parametrize("beta", [2.0, 8.0])
def test_bodies_between_two_tables_are_lit_as_light_transport_has_them(beta: float) -> None:
    """From the middle of the dip below the horizon up. Mixed by log β they would be up to 1.2 times as bright."""
    _, fine, volume = grown(replace(SMALL, size=32))
    x = np.repeat([5.0, 6.3, 8.0, 11.0], 6)

    def lit(radius: float) -> np.ndarray:
        z, azimuth = elevation(x, radius), np.arange(len(x)) * np.pi / 3
        lights = np.stack([*(np.sqrt(1 - z * z) * [np.cos(azimuth), np.sin(azimuth)]), z], -1)
        parts = sample_apart(fine, 6, 32, lights, Setting(SMALL.coat.albedo, SMALL.coat.skin, beta=radius))[:2]
        cover = volume.coverage.mean((1, 2))
        seen = cover * np.append(np.cumprod(1 - cover[:0:-1])[::-1], 1)
        return (mean_light(parts[0] + parts[1], volume.coverage) @ seen).reshape(-1, 6).mean(1)

    mixed = sum(share * lit(radius) for share, radius in zip(shares(beta), RADII, strict=True) if share > 0)
    np.testing.assert_allclose(mixed / lit(beta), 1, atol=0.06)


def test_coarser_voxels_hide_as_much() -> None:
    _, fine, _ = grown(replace(SMALL, size=64))
    wide = coarser(fine, 6, 32)
    assert wide.sigma.shape[2] == 64
    each = (1 - np.prod(1 - volume.coverage, axis=0) for volume in (fine, wide))
    np.testing.assert_allclose(*(cover.mean() for cover in each), rtol=0.05)
    assert coarser(wide, 6, 32) is wide


def test_curves_serve_the_fit() -> None:
    """On lights that no fit has seen, at the same bytes."""
    _, fine, volume = grown(SMALL)
    lighting = light(fine, SMALL, held_out=64)
    state = Sampled(PeltState(), volume, lighting)
    (curved, figures), (plain, before) = (
        fit_pelts([state], replace(SMALL, curves=curves))[0] for curves in ("slab", "none")
    )
    assert figures["psnr"] > before["psnr"] + 1.3
    assert figures["psnr_quantisation"] > 50
    assert curved.codes.shape == plain.codes.shape
    assert (plain.curves, plain.weights) == (None, None)
    unseen = lighting.lights[lighting.held_out]
    judge = Judge(lighting.samples[lighting.held_out], volume.coverage, volume.tint)
    bytes_ = relight(curved.values, PTM, unseen, curved.mean(unseen))
    assert judge.figures(bytes_)["psnr"] == pytest.approx(figures["psnr_quantised"])


def test_states_share_curves_and_mud_has_those_of_dry_fur() -> None:
    options = replace(SMALL, lights=16)
    strands = grow(options.coat, options.own_height, 0)
    wet = PeltState("wet", wetness=1.0)
    furs = [in_state(state, options.coat, strands, options.own_height, 0) for state in (PeltState(), wet, DIRTY)]
    states = [sampled(fur, fur.voxels(6, 16), options) for fur in furs]
    assert [len(state.lighting.bodies) for state in states] == [3, 3, 0]
    curves, (dry, soaked, dirty) = mean_curves(states)
    assert dirty is dry
    assert np.abs(dry - soaked).max() > 0.01
    pelts = [pelt for pelt, _ in fit_pelts(states, options)]
    for pelt in pelts:
        assert pelt.curves is not None
        np.testing.assert_array_equal(pelt.curves.even, curves.even)


def test_records_without_curves_are_those_of_the_polynomials_alone() -> None:
    record = BakeOptions().as_record()
    assert record["curves"] == "slab"
    assert BakeOptions.from_record(record).curves == "slab"
    del record["curves"]
    assert BakeOptions.from_record(record).curves == "none"
