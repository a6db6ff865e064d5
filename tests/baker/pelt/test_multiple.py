"""Light that met several hairs: what is stored of it, held against transport between hairs of other colours."""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from furbake import bake
from furbake.asset.read import read_asset
from furbake.asset.stored import read_pelt
from furbake.asset.validate import validate
from furbake.options import BakeOptions, preset
from furbake.pelt.curves import lean_direction
from furbake.pelt.eye import EyeLaw, factor, fit_eye, gauge, rings, seen_hairs, surge
from furbake.pelt.hairs.ramp import Ramp
from furbake.pelt.hairs.states import DIRTY, PeltState, in_state, moistened
from furbake.pelt.hairs.strands import grow
from furbake.pelt.hairs.volume import Volume, coarsen
from furbake.pelt.light.paths import BODY_RADIUS
from furbake.pelt.light.transport import Setting, hemisphere, sample_apart
from furbake.pelt.means import Measured, coarser, directions, mean_light, seen_shares
from furbake.pelt.multiple import Multiple, leaning, multiple_of, shares_of, shrinking, terms, too_much
from furbake.pelt.pelt import Pelt
from furbake.pelt.seen import LitHairs, ShownTexels
from furbake.pelt.short import pressed
from furbake.show.swatch import radiance
from furbake.tile.fitting import fit_pelt, fit_pelts
from furbake.tile.lighting import grown, light, sampled

Array = NDArray[np.float64]

RNG = np.random.default_rng(8)


def small(name: str) -> BakeOptions:
    return replace(preset(name), layers=8, size=16, lights=16)


@pytest.fixture(scope="module", params=["fox", "teddy"])
def baked(request: pytest.FixtureRequest) -> tuple[BakeOptions, Volume, Pelt]:
    options = small(request.param)
    _, fine, volume = grown(options)
    return options, fine, fit_pelt(volume, light(fine, options), options)[0]


def told(pelt: Pelt) -> Multiple:
    assert pelt.multiple is not None
    return pelt.multiple


@pytest.mark.parametrize("colour", [0.05, 0.3, 0.6])
def test_fur_of_other_greys_is_as_bright_as_transport_has_it(
    baked: tuple[BakeOptions, Volume, Pelt], colour: float
) -> None:
    options, fine, pelt = baked
    coat, multiple = options.coat, told(pelt)
    lights = hemisphere(10)
    wide = coarser(fine, 8, 16)
    alpha = coarsen(wide, 8, 16).coverage
    share = colour / coat.albedo
    darker = share, np.arange(len(lights))
    single, white, dark = sample_apart(wide, 8, 16, lights, Setting(coat.albedo, coat.skin), darker=darker)
    assert dark is not None
    above = np.cumprod((1 - alpha)[::-1], axis=0)[::-1]
    seen = (np.concatenate([above[1:], np.ones_like(above[:1])]) * alpha).mean((1, 2))
    direct, many, right = (mean_light(part, alpha) for part in (single, white, dark))
    stored = (direct + many) * (1 + multiple.share(lights) * (multiple.gain(np.array([colour])) - 1))
    counted = 1 - too_much(lights[:, 2:], fine.drift[-1] / fine.height)
    truth = direct + many + counted * (right - many)
    truth, found, before = ((part @ seen).sum() for part in (truth, stored, direct + many))
    assert found == pytest.approx(truth, rel=0.06)
    assert before > 1.15 * truth


def ring(height: float, azimuth: Array) -> Array:
    """Unit vectors at a height, (n, 3)."""
    level = np.sqrt(1 - height * height)
    return np.stack([level * np.cos(azimuth), level * np.sin(azimuth), np.full(len(azimuth), height)], -1)


@dataclass(frozen=True)
class SeenAside:
    """A fur and its law of light and eye, and what its texels send to eyes aside."""

    options: BakeOptions
    fine: Volume
    pelt: Pelt
    law: EyeLaw

    @property
    def lean(self) -> Array:
        return self.fine.drift[-1] / self.fine.height

    def factors(self, lights: Array, eyes: Array) -> tuple[Array, Array]:
        """Nap and surge, of pairs."""
        middle = (np.arange(8) + 0.5) / 8
        return factor(lights, eyes, self.lean, middle, self.law.weights), surge(lights, eyes, self.law.surge)

    def texels(self, lights: Array, eyes: Array) -> Array:
        """Light of the slabs without the law, (n, K)."""
        shown = ShownTexels(self.pelt, lights)
        return np.concatenate([shown.towards(eye, np.array([i]))[0] for i, eye in enumerate(eyes)])


def seen_aside(name: str) -> SeenAside:
    options = replace(preset(name), layers=8, size=32, lights=24)
    strands, fine, volume = grown(options)
    pelt = fit_pelt(volume, light(fine, options), options)[0]
    hairs = strands, options.coat, pelt.height, pelt.layers, pelt.size
    law = fit_eye(pelt, seen_hairs(*hairs), gauge(*hairs))
    assert law is not None
    return SeenAside(options, fine, pelt, law)


TRACED = {(0.8, 0.3, 0): 0.27, (0.5, 0.3, 0): 0.19, (0.8, 0.3, 180): 0.80, (0.5, 0.3, 180): 0.95}
"""By v·n, l·n and the degrees between them around the normal: share of the light to an eye that has met several hairs,
means of 16 places of a path-traced ball in `teddy`, depth 32 and 2, noise .01.
"""


def test_shares_for_eyes_aside_are_a_path_tracers() -> None:
    fur, off = seen_aside("teddy"), []
    for (up, height, apart), traced in TRACED.items():
        azimuth = np.arange(4) * np.pi / 2 + 0.4
        lights, eyes = ring(height, azimuth), ring(up, azimuth + np.radians(apart))
        nap, beside = fur.factors(lights, eyes)
        texels = fur.texels(lights, eyes)
        sent = texels * nap * beside[:, None]
        found = (sent * told(fur.pelt).towards(lights, eyes, fur.lean, nap, beside)).sum() / sent.sum()
        assert found == pytest.approx(traced, rel=0.2)
        off.append([found - traced, (texels * told(fur.pelt).share(lights)).sum() / sent.sum() - traced])
    mended, before = np.sqrt(np.square(off).mean(0))
    assert mended < 0.4 * before


@pytest.mark.parametrize("name", ["fox", "wolf"])
def test_more_of_light_to_eyes_opposite_has_met_several(name: str) -> None:
    """Against hairs of the fine volume: .85 to .95 of light past hairs that lean."""
    fur, azimuth, off = seen_aside(name), np.arange(6) * np.pi / 3 + 0.4, []
    for up, height in ((0.6, 0.2), (0.3, -0.2)):
        lights, eyes = ring(height, azimuth), ring(up, azimuth + np.pi)
        lit = LitHairs(fur.fine, 8, 32, lights, fur.options.coat)
        once, several = np.sum([lit.towards(eye, np.array([i]))[:2] for i, eye in enumerate(eyes)], 0).sum((1, 2))
        nap, beside = fur.factors(lights, eyes)
        sent = fur.texels(lights, eyes) * nap * beside[:, None]
        # Eyes at the lights have the law without that part.
        shares = [told(fur.pelt).towards(lights, at, fur.lean, nap, beside) for at in (eyes, lights)]
        off.append([(sent * x).sum() / sent.sum() - several / (once + several) for x in shares])
    mended, before = np.sqrt(np.square(off).mean(0))
    assert mended < 0.65 * before


@pytest.mark.parametrize("name", ["teddy", "fox", "sheep", "wolf"])
def test_more_of_light_towards_the_lean_has_met_several(name: str) -> None:
    """Against hairs of the fine volume, seen by eyes all around: slope of log x over b at lights of one height."""
    options = replace(preset(name), layers=8, size=32)
    _, fine, _ = grown(options)
    lights, eyes = rings((0.8, 0.5, 0.2), 6)[1:], rings((0.85, 0.5, 0.2), 6)
    lit, lean = LitHairs(fine, 8, 32, lights, options.coat), fine.drift[-1] / fine.height
    once, several = np.sum([lit.towards(eye, np.arange(len(lights)))[:2] for eye in eyes], 0).sum(-1)
    over_b = []
    for x in (several / (once + several), leaning(lights, lean)):
        logs = np.log(x).reshape(3, 6)
        b = (lights[:, :2] @ lean_direction(lean)).reshape(3, 6)
        over_b.append(float(((logs - logs.mean(1, keepdims=True)) * b).sum() / (b**2).sum()))
    assert over_b[1] == pytest.approx(over_b[0], abs=0.12)
    assert np.hypot(*lean) < 0.2 or over_b[0] > 0.1


@pytest.mark.parametrize("name", ["teddy", "fox", "sheep"])
def test_pressed_hairs_share_less_of_steep_light(name: str) -> None:
    options = replace(preset(name), layers=8, size=32)
    strands, fine, _ = grown(options)
    lights, found = hemisphere(12), []
    for length in (1.0, 0.4):
        short = pressed(strands, options.coat, fine.height, 8, 32, length)
        cover = coarsen(short, 8, 32).coverage
        one, several, _ = sample_apart(short, 8, 32, lights, Setting(options.coat.albedo, options.coat.skin))
        seen = seen_shares(cover.mean((1, 2)))
        met, once = (mean_light(light, cover) @ seen for light in (several, one))
        found.append(met / (met + once))
    numbers = Multiple(options.coat.albedo, np.array([[0.5, 0.0, 0.0]]), *np.ones((3, 1)))
    law = (numbers.share(lights, length=0.4) / numbers.share(lights))[:, 0]
    steep = lights[:, 2] > 0.5
    assert np.mean(found[1][steep]) < 0.93 * np.mean(found[0][steep])
    assert np.mean(found[1][steep] / found[0][steep]) == pytest.approx(np.mean(law[steep]), rel=0.13)
    assert np.mean(found[1][~steep] / found[0][~steep]) == pytest.approx(np.mean(law[~steep]), rel=0.13)


def test_stored_numbers_are_those_of_the_slabs(baked: tuple[BakeOptions, Volume, Pelt]) -> None:
    options, _, pelt = baked
    multiple = told(pelt)
    assert multiple.albedo == options.coat.albedo
    assert multiple.seen.sum() == pytest.approx(1, abs=1e-3)
    # Light deep in the fur has met more hairs, and meets more of them.
    share = multiple.share(np.array([[0.0, 0.6, 0.8]]))[0]
    assert share[0] > 0.7
    assert share[-1] < 0.5
    assert multiple.ratio[0] > multiple.ratio[-1] > 0.2
    assert (multiple.colour is not None) == options.colour_plane
    np.testing.assert_allclose(multiple.gain(np.array([multiple.albedo])), 1, atol=1e-9)


def test_known_shares_and_ratios_come_back() -> None:
    numbers = np.array([[0.9, -0.3, 0.02], [0.3, 0.2, -0.1]])
    albedo, ratio, lean = 0.8, np.array([0.9, 0.4]), np.array([0.2, 0.1])
    bodies = []
    for beta in (1.0, BODY_RADIUS, 16.0):
        lights = directions(beta)
        light = RNG.uniform(0.2, 2, (len(lights), 2))
        rows = terms(lights, beta) * leaning(lights, lean)[:, None]
        many = rows @ numbers.T * light / (1 - too_much(lights[:, 2:], lean))
        grown = (1 - 0.5 * ratio * albedo) / (0.5 * (1 - ratio * albedo))
        bodies.append(Measured(beta, lights, light, albedo, many, grown if beta == BODY_RADIUS else None))
    np.testing.assert_allclose(shares_of(bodies, lean), numbers, atol=1e-6)
    np.testing.assert_allclose(shrinking(bodies), ratio, atol=1e-6)


def test_nothing_is_told_without_curves_or_of_a_flat_patch() -> None:
    options = small("paper")
    for other in (replace(options, curves="none"), replace(options, flat=True)):
        _, fine, volume = grown(other)
        assert fit_pelt(volume, light(fine, other), other)[0].multiple is None


def test_states_have_numbers_of_their_own_and_mud_those_of_the_dry() -> None:
    options = small("paper")
    strands = grow(options.coat, options.own_height, options.seed)
    furs = [
        in_state(state, options.coat, strands, options.own_height, options.seed)
        for state in (PeltState(), moistened("soaked", 1.0), DIRTY)
    ]
    found = fit_pelts([sampled(fur, fur.voxels(8, 16), options) for fur in furs], options)
    dry, soaked, dirty = (told(pelt) for pelt, _ in found)
    assert dirty is dry
    assert soaked.albedo < dry.albedo
    assert np.abs(soaked.shares - dry.shares).max() > 0.02


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("multiple") / "asset"
    bake("sphere", path, replace(small("fox"), layers=4, size=8, lights=8))
    return path


def test_files_hold_them(folder: Path) -> None:
    assert validate(folder) == []
    multiple = told(read_pelt(read_asset(folder)))
    stored: dict[str, Any] = read_asset(folder).fur["pelts"][0]["multiple"]
    assert multiple.shares.shape == (4, 3)
    np.testing.assert_allclose(multiple.colour, stored["colour"])
    np.testing.assert_allclose(multiple.ratio, stored["ratio"])


@pytest.mark.parametrize(
    ("edit", "problem"),
    [
        (lambda told: told["ratio"].pop(), "pelts[0].multiple.ratio has 3 rows, expected 4"),
        (lambda told: told.pop("colour"), "one of pelts[0].multiple and pelts[0] has no colour, expected both or none"),
    ],
)
def test_validate_says_what_is_wrong(folder: Path, tmp_path: Path, edit: Any, problem: str) -> None:
    copy = tmp_path / "asset"
    copy.mkdir()
    for file in folder.iterdir():
        (copy / file.name).write_bytes(file.read_bytes())
    document = json.loads((copy / "model.gltf").read_text("utf-8"))
    edit(document["extensions"]["FUR_ptm_shells"]["pelts"][0]["multiple"])
    (copy / "model.gltf").write_text(json.dumps(document), "utf-8")
    assert any(problem in line for line in map(str, validate(copy)))


def test_no_bodies_tell_nothing(baked: tuple[BakeOptions, Volume, Pelt]) -> None:
    _, fine, pelt = baked
    assert pelt.curves is not None
    assert pelt.weights is not None
    assert multiple_of((), pelt.curves, pelt.weights, coarsen(fine, 8, 16), None) is None


def test_the_pelt_on_the_cpu_is_darker_between_dark_hairs(baked: tuple[BakeOptions, Volume, Pelt]) -> None:
    _, _, pelt = baked
    multiple = replace(told(pelt), tint=np.ones(8), colour=None)
    lights = np.array([[0.6, 0.0, 0.8]])

    def shown(grey: float, known: bool) -> float:
        ramp = Ramp((grey,) * 3, (grey,) * 3, (grey,) * 3)
        plain = replace(
            pelt, ramp=ramp, colour=None, tint=np.full_like(pelt.tint, 255), multiple=multiple if known else None
        )
        return float(radiance(plain, lights, 16).mean())

    assert shown(multiple.albedo, True) == pytest.approx(shown(multiple.albedo, False), rel=1e-6)
    assert 0.35 < shown(0.2, True) / shown(0.2, False) < 0.75
