from __future__ import annotations

import json
import math
from dataclasses import replace
from typing import Any

import pytest

from furbake.options import BakeOptions, OptionError, preset, preset_names, preset_summary
from furbake.pelt.pelt import Ramp
from furbake.pelt.strands import Coat, Hairs


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"preset": "cat"}, "preset: got 'cat', expected one of paper"),
        ({"layers": 0}, "layers: got 0, expected 1 to 64"),
        ({"size": 0}, "size: got 0, expected 8 to 512"),
        ({"size": 48}, "size: got 48, expected a power of two"),
        ({"lights": 3}, "lights: got 3, expected 8 to 1024"),
        ({"basis": "sh"}, "basis: got 'sh', expected ptm or eigen"),
        ({"coefficients": 3}, "coefficients: got 3, expected 6 for the basis ptm (eigen takes 3 to 6)"),
        ({"basis": "eigen", "coefficients": 7}, "coefficients: got 7, expected 3 to 6"),
        ({"length": -1.0}, "length: got -1, expected a length above 0"),
        ({"tile": math.nan}, "tile: got nan, expected a length above 0"),
        ({"height": 99.0}, "height: got 99, expected 0.02 to 4"),
        ({"length": 1.0, "tile": 1.0, "height": 1.0}, "length: got length, tile and height, expected at most two"),
        ({"seed": -1}, "seed: got -1, expected 0 to"),
        ({"guide": "up"}, "guide: got 'up', expected nose-tail or down"),
        ({"coat": Coat(opacity=0)}, "coat.opacity: got 0, expected 0.05 to 50"),
        ({"coat": Coat(guard=Hairs(radius=(1, 0.1)))}, "coat.guard.radius: got 1, expected 0.0001 to 0.1"),
        ({"coat": Coat(Hairs(count=0), Hairs(count=0))}, "coat.guard.count + coat.under.count: got 0, expected 1 to"),
        ({"ramp": Ramp(tip=(2.0, 0, 0))}, "ramp.tip: got 2, expected 0 to 1"),
    ],
)
def test_out_of_range_names_the_option_and_what_was_expected(change: dict[str, Any], message: str) -> None:
    with pytest.raises(OptionError) as caught:
        replace(BakeOptions(), **change).check()
    assert str(caught.value).startswith(message)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("name", preset_names())
def test_presets_are_whole_and_in_range(name: str) -> None:
    options = preset(name)
    options.check()
    assert options.preset == name
    assert preset_summary(name)


def test_paper_is_the_articles_volume() -> None:
    paper = preset("paper")
    assert (paper.layers, paper.size, paper.basis, paper.coefficients) == (16, 64, "ptm", 6)
    assert paper.colour_plane
    assert paper == BakeOptions()


def test_a_record_gives_the_options_back_from_json() -> None:
    options = replace(preset("paper"), length=0.25, seed=7, coat=Coat(guard=Hairs(count=12)))
    assert BakeOptions.from_record(json.loads(json.dumps(options.as_record()))) == options


def test_length_is_height_times_tile() -> None:
    def size(**given: float) -> tuple[float, float]:
        return replace(BakeOptions(height_share=0.5, tile_share=0.1), **given).dimensions(extent=20)

    assert size() == (2, 1)
    assert size(tile=4) == (4, 2)
    assert size(height=2) == (2, 4)
    assert size(length=3) == (6, 3)
    assert size(length=3, height=1) == (3, 3)
    assert size(length=3, tile=4) == (4, 3)
    with pytest.raises(OptionError, match=r"height \(length / tile\): got 30, expected 0.02 to 4"):
        size(length=30, tile=1)
