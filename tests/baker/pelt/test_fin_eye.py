"""The law of light and eye for fins: what its numbers mend, and which bakes have them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from furbake.asset.read import read_asset
from furbake.asset.stored import read_pelt
from furbake.options import BakeOptions, preset
from furbake.pelt.eye import factor, gauge, rings
from furbake.pelt.fin_eye import fin_light, fit_fin_eye, level_hairs
from furbake.pelt.hairs.volume import fine_shape, voxelise
from furbake.pelt.seen import LitHairs
from furbake.pipeline import bake
from furbake.tile.tile import Fitted, Tile

SMALL = replace(preset("paper"), size=16, layers=6, lights=32)
MIDDLE = (np.arange(6) + 0.5) / 6


@pytest.fixture(scope="module")
def baked() -> tuple[Tile, Fitted]:
    """A small tile and its pelt with fins."""
    tile = Tile.grow(SMALL, SMALL.own_height)
    fitted = tile.fit(tile.sample(lambda fraction: None), lambda fraction: None)
    return tile, tile.fit_fins(fitted)


def test_numbers_bring_fins_to_the_hairs_that_level_eyes_see(baked: tuple[Tile, Fitted]) -> None:
    """From eyes along the lean, against it and across it, under lights that no fit has seen, with the law of shells and
    with that of fins; twice the same numbers.
    """
    tile, ((pelt, _),) = baked
    assert pelt.eye is not None
    assert pelt.fin is not None
    assert pelt.fin_eye is not None
    fine = voxelise(tile.strands, pelt.height, *fine_shape(6, 16, pelt.height), SMALL.coat.opacity)
    lights = rings((0.75, 0.45, 0.15), 6, 0.7)[1:]
    lit, light = LitHairs(fine, 6, 16, lights, SMALL.coat), fin_light(pelt, pelt.fin, lights)
    off: dict[str, list[float]] = {"eye": [], "fin_eye": []}
    for eye in np.array([[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0]]):
        *each, seen = lit.towards(eye, np.arange(len(lights)))
        hairs = sum(each)
        for name, found in off.items():
            told = factor(lights, np.repeat(eye[None], len(lights), 0), pelt.drift[-1], MIDDLE, getattr(pelt, name))
            ratio = (light * told) @ seen / hairs.sum(-1)
            found.append(float(np.sqrt(np.mean(np.log(ratio) ** 2))))
    assert max(off["fin_eye"]) < 0.2
    assert np.mean(off["fin_eye"]) < 0.75 * np.mean(off["eye"])
    hairs = tile.strands, SMALL.coat, pelt.height, 6, 16
    again = fit_fin_eye(pelt, pelt.fin, level_hairs(*hairs), gauge(*hairs))
    np.testing.assert_array_equal(again, pelt.fin_eye)


@pytest.mark.parametrize(("changed", "there"), [({}, True), ({"curves": "none"}, False), ({"fins": False}, False)])
def test_a_bake_stores_them_with_its_fins(
    tmp_path: Path, tiny: BakeOptions, changed: dict[str, object], there: bool
) -> None:
    bake("plane", tmp_path / "fur", replace(tiny, **changed))  # type: ignore[arg-type]
    asset = read_asset(tmp_path / "fur")
    found = read_pelt(asset).fin_eye
    assert ("finEye" in asset.fur) == (found is not None) == there
    assert found is None or asset.fur["finEye"] == found.tolist()


def test_flat_fur_has_none(tmp_path: Path, tiny: BakeOptions) -> None:
    """Nothing is seen of a field without end by a level eye."""
    bake("plane", tmp_path / "fur", replace(tiny, flat=True))
    assert "finEye" not in read_asset(tmp_path / "fur").fur
