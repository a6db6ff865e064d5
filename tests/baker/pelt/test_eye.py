"""The law of light and eye: its terms, what rays share, and what its numbers mend."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from furbake.asset.extension import EXTENSION
from furbake.asset.gltf import FurModel, write_gltf
from furbake.asset.read import read_asset
from furbake.asset.stored import read_pelt
from furbake.asset.validate import validate
from furbake.options import BakeOptions, preset
from furbake.pelt.bent import MIN_FACTOR
from furbake.pelt.eye import (
    TERMS,
    WIDTHS,
    EyeLaw,
    Pairs,
    factor,
    fit_eye,
    fit_pairs,
    fit_surge,
    gauge,
    rings,
    seen_hairs,
    surge,
    terms,
    towards,
)
from furbake.pelt.hairs.strands import Strands, grow
from furbake.pelt.hairs.volume import Volume
from furbake.pelt.light.fibre import ABOVE
from furbake.pelt.pelt import Pelt
from furbake.pelt.seen import LitHairs, ShownTexels, moved, shared_depth
from furbake.pipeline import bake
from furbake.surface.place.vertex_fur import VertexFur
from furbake.surface.shapes import builtin
from furbake.tile.fitting import fit_pelt
from furbake.tile.lighting import grown, light

SMALL = replace(preset("paper"), size=16, layers=6, lights=32)
MIDDLE = (np.arange(6) + 0.5) / 6


Small = tuple[Pelt, Strands, Volume]


@pytest.fixture(scope="module")
def small() -> Small:
    """A small pelt, its strands and its fine volume."""
    strands, fine, volume = grown(SMALL)
    return fit_pelt(volume, light(fine, SMALL), SMALL)[0], strands, fine


def law_of(pelt: Pelt, strands: Strands) -> EyeLaw:
    hairs = strands, SMALL.coat, pelt.height, pelt.layers, pelt.size
    law = fit_eye(pelt, seen_hairs(*hairs), gauge(*hairs))
    assert law is not None
    return law


def test_terms() -> None:
    """In the order of the format; nothing of an eye straight above, and what is below the horizon is held on it."""
    light, eye, lean = np.array([0.36, -0.48, 0.8]), np.array([0.6, 0.64, 0.48]), np.array([3.0, 4.0])
    a, b, p, z, q = 0.36 * 0.6 - 0.48 * 0.64, 0.36 * 0.6 - 0.48 * 0.8, 0.36 + 0.64 * 0.8, 0.8, 1 - 0.48**2
    expected = [q, a, q * b, p * b, q * z, q * b * b, p, a * a, p * a * b, q * p, q * b * z, q * a * b]
    expected += [a * z, p * z, q * z * z, q * p * b]
    np.testing.assert_allclose(terms(light, eye, lean), expected, atol=1e-12)
    assert not terms(rings((0.5, -0.2), 5), ABOVE, lean).any()
    low, level = np.array([0.48, 0.64, -0.6]), np.array([0.6, 0.8, 0.0])
    np.testing.assert_allclose(terms(low, eye, lean), terms(level, eye, lean), atol=1e-12)
    np.testing.assert_allclose(terms(light, low, lean), terms(light, level, lean), atol=1e-12)


def test_factor_is_held() -> None:
    numbers = np.zeros((3, TERMS))
    numbers[0, 0] = -10.0
    eyes = rings((0.5,), 3)
    told = factor(np.repeat(ABOVE[None], 4, 0), eyes, np.zeros(2), MIDDLE, numbers)
    np.testing.assert_allclose(told, np.repeat([[1.0], [MIN_FACTOR], [MIN_FACTOR], [MIN_FACTOR]], 6, 1))


@pytest.mark.parametrize("angle", [0.0, 15.0, 40.0, 100.0])
def test_rays_share_the_discs_that_both_meet(angle: float) -> None:
    """Against discs that are strewn at random around a point, by counting which of two rays they stop."""
    chance, radius, filled, reach = np.random.default_rng(3), 0.05, 0.15, 0.4
    trials, half = 6000, np.radians(angle / 2)
    count = chance.poisson(filled / (np.pi * radius**2), trials)
    clear = np.ones((trials, 2), bool)
    ways = np.array([[np.cos(half), np.sin(half)], [np.cos(half), -np.sin(half)]])
    for trial, discs in enumerate(count):
        centre = chance.random((discs, 2)) - 0.5
        along = np.clip(centre @ ways.T, 0, reach)
        nearest = np.linalg.norm(centre[:, None] - along[..., None] * ways, axis=-1)
        # The hair itself is no other hair: discs over the point are left out.
        clear[trial] = ~((nearest < radius) & (np.linalg.norm(centre, axis=1) >= radius)[:, None]).any(0)
    depths, joint = -np.log(clear.mean(0)), clear.all(1).mean()
    one, turn, hair = (np.full(1, value, np.float32) for value in (depths.min(), ways[0] @ ways[1], filled))
    shared = shared_depth(one[:, None, None], turn[:, None, None], hair)
    told = float(np.exp(-depths.sum() + shared.item()))
    assert told == pytest.approx(joint, rel=0.15)
    apart = float(np.exp(-depths.sum()))
    if angle < 20:  # without what is shared it would be far off
        assert joint > 1.3 * apart


def around_eyes() -> tuple[np.ndarray, np.ndarray]:
    """Lights beside four eyes, and the eye of each."""
    eyes = np.repeat(rings((0.9, 0.4), 2)[1:], 4, 0)
    angles = np.tile(np.radians([0, 4, 9, 20]), 4)
    level = np.hypot(eyes[:, 0], eyes[:, 1])
    up = np.column_stack([-eyes[:, :2] / level[:, None] * eyes[:, 2:], level])
    return np.cos(angles)[:, None] * eyes + np.sin(angles)[:, None] * up, eyes


def test_surge_is_found_again() -> None:
    lights, eyes = around_eyes()
    numbers = np.array([0.3, 0.2, WIDTHS[20]])
    shown = np.linspace(0.5, 2, len(lights))
    found = fit_surge(lights, eyes, shown, shown * surge(lights, eyes, numbers), 1 / shown)
    np.testing.assert_allclose(found, numbers, atol=2e-3)


def test_both_factors_are_found_together() -> None:
    """A level that only eyes aside lack is no surge, and a surge is no level."""
    near = around_eyes()
    ways = rings((0.9, 0.6, 0.3), 5), rings((0.8, 0.45), 4, 0.7)
    lights = np.concatenate([np.repeat(ways[0], len(ways[1]), 0), near[0]])
    eyes = np.concatenate([np.tile(ways[1], (len(ways[0]), 1)), near[1]])
    texels = 0.2 + np.random.default_rng(2).random((len(lights), 6))
    weights, peak = np.zeros((3, TERMS)), np.array([0.4, 0.3, WIDTHS[18]])
    weights[0, :2] = -0.3, 0.25
    hairs = texels * factor(lights, eyes, np.zeros(2), MIDDLE, weights) * surge(lights, eyes, peak)[:, None]
    law = fit_pairs(Pairs(lights, eyes, hairs, texels, 1 / hairs.sum(-1)), np.zeros(2))
    np.testing.assert_allclose(law.surge, peak, atol=0.06)
    told = factor(lights, eyes, np.zeros(2), MIDDLE, law.weights) * surge(lights, eyes, law.surge)[:, None]
    np.testing.assert_allclose((texels * told).sum(-1), hairs.sum(-1), rtol=0.02)


def test_images_are_read_between_texels() -> None:
    image = np.random.default_rng(4).random((2, 8, 8)).astype(np.float32)
    row, column = 3, 6
    told = moved(image, np.array([2.25, -1.5]))[:, row, column]
    rows, columns = np.array([1, 2]), np.array([0, 1])  # row 1.5, column 8.25 of a periodic image
    near = image[:, rows[:, None], columns]
    np.testing.assert_allclose(told, np.einsum("nrc,r,c->n", near, [0.5, 0.5], [0.75, 0.25]), rtol=1e-5)


@pytest.mark.parametrize("beta", [None, 4.0])
def test_even_shells_hide_what_is_behind_them(make_pelt: Callable[..., Pelt], beta: float | None) -> None:
    """Against the shells that a ray meets one after the other, of one coverage everywhere, which hairs leave apart."""
    pelt = make_pelt()
    stored = np.round(255 * np.linspace(0.5, 0.1, pelt.layers))
    even = np.broadcast_to(stored[:, None, None], pelt.alpha.shape)
    pelt = replace(pelt, alpha=even.astype(np.uint8))
    eye = np.array([0.48, 0.64, 0.6])
    radius = (1e5 if beta is None else beta) + (np.arange(pelt.layers) + 0.5) / pelt.layers
    area = (radius / (radius[0] - 0.5 / pelt.layers)) ** 2
    coverage = 1 - (1 - stored / 255) ** (1 / area)
    expected = []
    for k, r in enumerate(radius):
        clear = 1.0
        for alpha, outer in zip(coverage[k + 1 :], radius[k + 1 :], strict=True):
            clear *= (1 - alpha) ** (1 / np.sqrt(1 - (0.8 * r / outer) ** 2))
        expected.append(clear * (1 - (1 - coverage[k]) ** (1 / 0.6)) * 0.6 * area[k])
    see = ShownTexels(pelt, ABOVE[None], beta).visible(eye)
    np.testing.assert_allclose(see.mean((1, 2)), expected, rtol=1e-3)
    np.testing.assert_allclose(np.ptp(see, (1, 2)), 0, atol=1e-5)


def test_numbers_mend_what_eyes_aside_see(small: Small) -> None:
    """Under lights and eyes that no fit has seen; twice the same numbers; above nothing changes."""
    pelt, strands, fine = small
    law = law_of(pelt, strands)
    lights, eyes = rings((0.75, 0.45, 0.2), 4, 0.7), rings((0.7, 0.35), 5, 0.2)
    lit, shown = LitHairs(fine, 6, 16, lights, SMALL.coat), ShownTexels(pelt, lights)
    before, after = [], []
    for eye in eyes[1:]:
        *each, all_hairs = lit.towards(eye, np.arange(len(lights)))
        (texels, all_texels), hairs = shown.towards(eye, np.arange(len(lights))), sum(each)
        pairs = lights, np.repeat(eye[None], len(lights), 0)
        told = factor(*pairs, fine.drift[-1] / fine.height, MIDDLE, law.weights) * surge(*pairs, law.surge)[:, None]
        seen = hairs.sum(-1) / all_hairs.sum()
        before.append(np.abs(np.log(texels.sum(-1) / all_texels / seen)))
        after.append(np.abs(np.log((texels * told).sum(-1) / all_texels / seen)))
    assert np.mean(after) < 0.4 * np.mean(before)
    assert np.mean(after) < 0.16
    again = law_of(pelt, strands)
    np.testing.assert_array_equal(law.weights, again.weights)
    np.testing.assert_array_equal(law.surge, again.surge)


@pytest.mark.parametrize(("height", "traced"), [(0.3, 0.542), (0.6, 0.907)])
def test_light_across_the_eye_is_a_path_tracers(height: float, traced: float) -> None:
    """Hairs of `teddy` on a ball of β = 4; nearly all of this light has met several of them.

    traced : mean radiance towards an eye at v·n = .5 from 160 places of the path-traced ball (.006 to .007 of noise)
    """
    teddy = replace(preset("teddy"), size=64, layers=16)
    strands = grow(teddy.coat, teddy.own_height, teddy.seed)
    hairs = strands, teddy.coat, teddy.own_height, teddy.layers, teddy.size
    lights = rings((height,), 4)[1:]
    eyes = rings((0.5,), 4)[1:] * [-1, -1, 1]
    seen = towards(eyes, list(np.arange(4)[:, None]), lights, *hairs)
    coarse, told = (
        float(np.mean([light.sum() / all_hairs.sum() for light, all_hairs in zip(each, seen.seen, strict=True)]))
        for each in ([sum(pair) for pair in zip(seen.once, seen.several, strict=True)], seen.light(gauge(*hairs)))
    )
    assert told == pytest.approx(traced, rel=0.12)
    assert coarse > 1.15 * traced


def test_the_side_towards_the_light_is_the_brighter_one(small: Small) -> None:
    pelt, strands, _ = small
    law = law_of(pelt, strands)
    light = np.array([[0.0, -0.8, 0.6]])
    there, against = (
        float(factor(light, np.array([[0.0, side, 0.6]]), np.array([0.0, 1.0]), np.array([0.8]), law.weights).item())
        for side in (-0.8, 0.8)
    )
    assert there > 1.3 * against


@pytest.mark.parametrize("curves", ["slab", "none"])
def test_a_bake_stores_them_beside_mean_curves(tmp_path: Path, tiny: BakeOptions, curves: str) -> None:
    bake("plane", tmp_path / "fur", replace(tiny, curves=curves, fins=False))  # type: ignore[arg-type]
    asset = read_asset(tmp_path / "fur")
    pelt = read_pelt(asset)
    assert validate(tmp_path / "fur") == []
    if curves == "none":
        assert pelt.eye is None
        assert pelt.surge is None
        return
    assert pelt.eye is not None
    assert pelt.surge is not None
    assert asset.fur["eye"] == pelt.eye.tolist()
    assert asset.fur["surge"] == pelt.surge.tolist()


def test_stored_and_read_back(tmp_path: Path, make_pelt: Callable[..., Pelt]) -> None:
    surface = builtin("plane")
    charts, fur = surface.natural.charts(1.0), VertexFur.even(len(surface.vertices))
    numbers, of_fins = np.round(np.random.default_rng(1).normal(size=(2, 3, TERMS)), 3)
    of_fins[:, 12:] = 0
    peak = np.array([0.25, -0.125, 0.0625])
    made = replace(make_pelt(), eye=numbers, fin_eye=of_fins, surge=peak, spread=0.25, open=0.5)
    write_gltf(tmp_path, FurModel(surface, charts, fur, (made,), 0.5))
    shorten(tmp_path, "finEye")
    pelt = read_pelt(read_asset(tmp_path))
    np.testing.assert_array_equal(pelt.eye, numbers)
    np.testing.assert_array_equal(pelt.fin_eye, of_fins)
    np.testing.assert_array_equal(pelt.surge, peak)
    assert (pelt.spread, pelt.open) == (0.25, 0.5)
    shorten(tmp_path, "eye", 11)
    assert any("eye" in problem for problem in validate(tmp_path))


def shorten(folder: Path, name: str, terms: int = 12) -> None:
    """Leave the first terms of a stored law."""
    document = json.loads((folder / "model.gltf").read_text("utf-8"))
    fur = document["extensions"][EXTENSION]
    fur[name] = [row[:terms] for row in fur[name]]
    (folder / "model.gltf").write_text(json.dumps(document), "utf-8")
