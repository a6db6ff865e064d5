"""The law of light on bent hairs: its numbers, general and baked."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from furbake.asset.extension import EXTENSION
from furbake.asset.gltf import FurModel, write_gltf
from furbake.asset.read import read_asset
from furbake.asset.stored import read_pelt
from furbake.asset.validate import validate
from furbake.options import BakeOptions, preset
from furbake.pelt.bent import (
    MAX_TIP,
    MIN_FACTOR,
    bent_light,
    factor,
    fit_bends,
    general,
    sheared,
    terms,
    tips_of,
    unbent_light,
)
from furbake.pelt.curves import lean_direction
from furbake.pelt.hairs.strands import Coat, Strands, grow
from furbake.pelt.hairs.volume import coarsen, fine_shape, voxelise
from furbake.pelt.light.transport import hemisphere
from furbake.pelt.pelt import Pelt
from furbake.pipeline import bake
from furbake.surface.place.vertex_fur import VertexFur
from furbake.surface.shapes import builtin
from furbake.tile.fitting import fit_pelt
from furbake.tile.lighting import light

Array = NDArray[np.float64]

LIGHTS = hemisphere(40)
SMALL = replace(preset("paper"), size=16, layers=6, lights=24)


def test_general_numbers() -> None:
    lean = np.array([0.2, -0.4])
    for tip in (np.array([0.3, 0.4]), np.array([-0.5, 0.1])):
        for s in (0.1, 0.9):
            up, along, square = LIGHTS[:, 2], LIGHTS[:, :2] @ tip, tip @ tip
            told = 1 - 0.5 * (tip @ lean) + s * (square * (2.7 * up - 1.5) - 1.8 * along * up)
            np.testing.assert_allclose(
                factor(LIGHTS, tip, lean, s, general(lean)), np.maximum(told, MIN_FACTOR), atol=1e-12
            )


def test_terms() -> None:
    """In the order of the format; a far bend counts as one of `MAX_TIP`, and fur that stands leans along v."""
    x, q, along = 0.36 * 0.3 + 0.48 * 0.2, 0.13, -0.48
    told = terms(np.array([[0.36, -0.48, 0.8]]), np.array([0.3, -0.2]), np.zeros(2))
    expected = [x * 0.8, -0.2, q * 0.8, q, x, q * along, q * along * 0.8, x * along]
    np.testing.assert_allclose(told, [expected], atol=1e-12)
    far, lean = np.array([0.6, 0.8]), np.array([0.1, 0.2])
    np.testing.assert_allclose(terms(LIGHTS, far, lean), terms(LIGHTS, MAX_TIP * far, lean))
    turned = terms(LIGHTS, 0.5 * far, lean)
    np.testing.assert_allclose(terms(LIGHTS, 0.5 * far, 3 * lean), turned)


def pelt_of(options: BakeOptions) -> Pelt:
    strands = grow(options.coat, options.height_share, options.seed)
    shape = fine_shape(options.layers, options.size, options.height_share)
    fine = voxelise(strands, options.height_share, *shape, options.coat.opacity)
    return fit_pelt(coarsen(fine, options.layers, options.size), light(fine, options), options)[0]


@pytest.fixture
def small() -> Pelt:
    return pelt_of(SMALL)


def hairs_of(pelt: Pelt, options: BakeOptions) -> tuple[Strands, Coat, float, int, int]:
    return grow(options.coat, pelt.height, options.seed), options.coat, pelt.height, pelt.layers, pelt.size


def numbers_of(pelt: Pelt, options: BakeOptions = SMALL) -> Array | None:
    """Numbers of the law for a small pelt, of light that is found for them."""
    hairs = hairs_of(pelt, options)
    light = [bent_light(*hairs, tip) for tip in tips_of(pelt.drift[-1] / pelt.height)]
    return fit_bends(pelt, light, unbent_light(*hairs))


@pytest.mark.parametrize("name", ["teddy", "sheep", "wolf"])
def test_slabs_are_as_bright_as_bent_hairs_are_under_low_lights(name: str) -> None:
    """Against light transport through hairs that no fit has seen bent this way."""
    options = replace(preset(name), size=16, layers=6, lights=24)
    pelt = pelt_of(options)
    numbers, lean = numbers_of(pelt, options), pelt.drift[-1] / pelt.height
    assert numbers is not None
    lights, alpha, off = hemisphere(16, turn=0.5), pelt.alpha / 255, []
    low = lights[:, 2] < 0.45
    for displaced, degrees in ((0.3, 0), (0.3, 180), (0.5, 90), (0.5, 270)):
        turn = np.arctan2(*lean_direction(lean)[::-1]) + np.radians(degrees)
        tip = displaced * np.array([np.cos(turn), np.sin(turn)])
        truth = np.einsum("nkrc,krc->n", bent_light(*hairs_of(pelt, options), tip), alpha)
        law = np.zeros(len(lights))
        for k in range(pelt.layers):
            s = (k + 0.5) / pelt.layers
            ways = sheared(lights, tip, s)
            slab = pelt.light(ways)[:, k]
            law += np.einsum("nrc,rc->n", slab, alpha[k]) * factor(lights, tip, lean, s, numbers)
        off.append((law[low] / truth[low]).mean() - 1)
    assert abs(np.mean(off)) < 0.02


def test_black_texels_have_no_numbers(small: Pelt) -> None:
    assert numbers_of(replace(small, scale=0 * small.scale)) is None


def test_numbers_are_the_same_twice(small: Pelt) -> None:
    numbers = numbers_of(small)
    assert numbers is not None
    assert numbers.shape == (3, 8)
    np.testing.assert_array_equal(numbers, numbers_of(small))
    np.testing.assert_array_equal(numbers, np.round(numbers, 3))


@pytest.mark.parametrize("layers", [1, 4])
@pytest.mark.parametrize("basis", [("ptm", 6), ("eigen", 3)])
def test_a_bake_stores_them(tmp_path: Path, tiny: BakeOptions, layers: int, basis: tuple[str, int]) -> None:
    options = replace(tiny, layers=layers, basis=basis[0], coefficients=basis[1], fins=False)  # type: ignore[arg-type]
    bake("plane", tmp_path / "fur", options)
    asset = read_asset(tmp_path / "fur")
    numbers = read_pelt(asset).bent
    assert numbers is not None
    assert np.isfinite(numbers).all()
    assert asset.fur["bent"] == numbers.tolist()
    assert validate(tmp_path / "fur") == []


def test_flat_bakes_have_none(tmp_path: Path, tiny: BakeOptions) -> None:
    bake("plane", tmp_path / "fur", replace(tiny, flat=True, fins=False))
    asset = read_asset(tmp_path / "fur")
    assert "bent" not in asset.fur
    assert read_pelt(asset).bent is None


def test_stored_and_read_back(tmp_path: Path, make_pelt: Callable[..., Pelt]) -> None:
    surface = builtin("plane")
    charts, fur = surface.natural.charts(1.0), VertexFur.even(len(surface.vertices))
    numbers = np.round(np.random.default_rng(1).normal(size=(3, 8)), 3)
    write_gltf(tmp_path, FurModel(surface, charts, fur, (replace(make_pelt(), bent=numbers),), 0.5))
    np.testing.assert_array_equal(read_pelt(read_asset(tmp_path)).bent, numbers)
    document = json.loads((tmp_path / "model.gltf").read_text("utf-8"))
    document["extensions"][EXTENSION]["bent"].pop()
    (tmp_path / "model.gltf").write_text(json.dumps(document), "utf-8")
    assert any("bent" in problem for problem in validate(tmp_path))
