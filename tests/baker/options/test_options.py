from __future__ import annotations

import json
import math
import os
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from furbake.options import BakeOptions, OptionError, as_toml, override, preset, preset_names, preset_summary
from furbake.options.bake_options import FILES
from furbake.options.knobs import KNOBS
from furbake.pelt.hairs.ramp import Ramp
from furbake.pelt.hairs.strands import Coat, Hairs


@pytest.mark.parametrize(
    ("change", "message"),
    [
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
        ({"seed": 10**400}, "seed: got 1000000000"),
        ({"coat": Coat(guard=Hairs(fade=(1.0, 3.0)))}, "coat.guard.fade: got 3, expected 0 to 2"),
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


def test_the_presets_of_the_product_are_there() -> None:
    assert preset_names() == ["bunny", "fox", "mole", "paper", "sheep", "teddy", "wolf"]


@pytest.mark.parametrize("name", preset_names())
def test_presets_are_whole_and_in_range(name: str) -> None:
    options = preset(name)
    options.check()
    assert options.preset == name
    assert preset_summary(name).endswith(".")
    assert options.layers in range(16, 25)
    assert options.size in (64, 128)


@pytest.mark.parametrize("name", preset_names())
def test_a_preset_written_out_and_read_again_is_the_same(name: str, tmp_path: Path) -> None:
    (tmp_path / "copy.toml").write_text(as_toml(preset(name)), "utf-8")
    assert preset(tmp_path / "copy.toml") == replace(preset(name), preset="copy")


def test_every_knob_of_the_options_can_be_set() -> None:
    def names(table: dict[str, Any], prefix: str = "") -> set[str]:
        return {
            name
            for key, value in table.items()
            for name in (names(value, f"{prefix}{key}.") if isinstance(value, dict) else {prefix + key})
        }

    only_for_one_bake = {
        "preset",
        "length",
        "tile",
        "flat",
        "height_share",
        "max_faces",
        "bits",
        "meshopt",
        "follow",
        *FILES,
    }
    assert set(KNOBS) == names(BakeOptions().as_record()) - only_for_one_bake


def test_a_file_sets_what_it_names_over_what_it_extends(tmp_path: Path) -> None:
    (tmp_path / "base.toml").write_text('extends = "fox"\nlayers = 20\n[coat.guard]\ncount = 12\n')
    (tmp_path / "mine.toml").write_text('extends = "base.toml"\n[coat.guard]\ncurl = 0.2\n')
    fox, mine = preset("fox"), preset(str(tmp_path / "mine.toml"))
    guard = replace(fox.coat.guard, count=12, curl=0.2)
    assert mine == replace(fox, preset="mine", layers=20, coat=replace(fox.coat, guard=guard))


def test_a_file_that_extends_nothing_starts_from_the_defaults(tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text("height = 0.25\n[coat.under]\ncount = 5\n")
    default = BakeOptions()
    coat = replace(default.coat, under=replace(default.coat.under, count=5))
    assert preset(tmp_path / "mine.toml") == replace(default, preset="mine", height_share=0.25, coat=coat)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes with names")
def test_preset_files_are_regular_and_bounded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    os.mkfifo(tmp_path / "pipe.toml")
    with pytest.raises(OptionError, match=r"pipe\.toml' \(is no regular file\), expected a \.toml file"):
        preset(tmp_path / "pipe.toml")
    (tmp_path / "large.toml").write_text("#" * 1001)
    monkeypatch.setenv("FURBAKE_LIMITS", "bytes=1000")
    with pytest.raises(OptionError, match=r"large\.toml: more than 1000 bytes to read"):
        preset(tmp_path / "large.toml")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("coat.guard.cout = 3", "my.toml: got 'coat.guard.cout', expected a knob such as coat.guard.count"),
        ("[coat.gard]\ncurl = 0.1", "my.toml: got 'coat.gard.curl', expected a knob such as coat.guard.curl"),
        ("layer = 3", "my.toml: got 'layer', expected a knob such as layers"),
        ("coat = 3", "my.toml: got 'coat', expected a knob such as"),
        ("layers.top = 3", "my.toml: got 'layers.top', expected a knob such as layers"),
        ("preset = 'fox'", "my.toml: got 'preset', expected a knob such as"),
        ("layers = 'many'", "my.toml: layers: got 'many', expected a whole number, 1 to 64"),
        ("layers = 16.0", "my.toml: layers: got 16.0, expected a whole number, 1 to 64"),
        ("layers = true", "my.toml: layers: got true, expected a whole number, 1 to 64"),
        ("layers = 99", "my.toml: layers: got 99, expected 1 to 64"),
        ("coat.guard.count = 99999", "my.toml: coat.guard.count: got 99999, expected 0 to 20000"),
        ("coat.bend = nan", "my.toml: coat.bend: got nan, expected 1 to 4"),
        ("coat.lean = 0.3", "my.toml: coat.lean: got 0.3, expected two numbers, each -2 to 2"),
        ("coat.lean = [1, 2, 3]", "my.toml: coat.lean: got [1, 2, 3], expected two numbers, each -2 to 2"),
        ("coat.lean = [1, 'x']", 'my.toml: coat.lean: got [1, "x"], expected two numbers, each -2 to 2'),
        ("ramp.tip = [2, 0, 0]", "my.toml: ramp.tip: got 2, expected 0 to 1"),
        ("colour_plane = 1", "my.toml: colour_plane: got 1, expected true or false"),
        ("basis = 'sh'", "my.toml: basis: got 'sh', expected ptm or eigen"),
        ("basis = []", "my.toml: basis: got [], expected ptm or eigen"),
        ("coat.shade = 2020-01-01", 'my.toml: coat.shade: got "2020-01-01", expected a number, 0 to 0.5'),
        ("layers = ", "my.toml: got no valid TOML (Invalid value (at end of document)), expected lines such as"),
        ("layers = 1\nlayers = 2", "my.toml: got no valid TOML (Cannot overwrite a value"),
        ("x = " + "[" * 9999, "my.toml: got no valid TOML (too deeply nested)"),
        ("seed = " + "1" * 5000, "my.toml: got no valid TOML ("),
        ("seed = " + "1" * 500, "my.toml: seed: got 1111"),
        (b"\xff = 1", "preset: got "),
        ("extends = 3", "my.toml: extends: got 3, expected the name of a preset or a .toml file"),
        ("extends = 'cat'", "my.toml: extends: got 'cat', expected one of bunny, fox, "),
        ("extends = 'my.toml'", "my.toml: extends: got a circle of files that extend each other, expected an end"),
        ("extends = 'no.toml'", "my.toml: extends: got "),
    ],
)
def test_a_bad_file_is_told_in_one_sentence(text: str | bytes, message: str, tmp_path: Path) -> None:
    path = tmp_path / "my.toml"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(OptionError) as caught:
        preset(str(path)).check()
    assert str(caught.value).startswith(message)
    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) < 300


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("cat", "preset: got 'cat', expected one of bunny, fox, mole, paper, sheep, teddy, wolf, or a .toml file"),
        ("../presets/fox", "preset: got '../presets/fox', expected one of"),
        ("nowhere/my.toml", "preset: got 'nowhere/my.toml' (no such file or directory), expected a .toml file"),
        ("folder.toml", "preset: got 'folder.toml' (is a directory), expected a .toml file"),
        ("nul\0.toml", "preset: got "),
    ],
)
def test_unknown_presets(name: str, message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "folder.toml").mkdir()
    with pytest.raises(OptionError) as caught:
        preset(name)
    assert str(caught.value).startswith(message)


def test_override() -> None:
    fox = preset("fox")
    texts = {
        "coat.guard.count": "7",
        "coat.lean": "0.1, -0.2",
        "coat.under.fade": "[0.5, 1]",
        "ramp.tip": ".5,0.4,.3",
        "basis": "eigen",
        "colour_plane": "false",
        "height": "0.4",
    }
    changed = override(replace(fox, height=0.9), texts)
    coat = replace(
        fox.coat,
        lean=(0.1, -0.2),
        guard=replace(fox.coat.guard, count=7),
        under=replace(fox.coat.under, fade=(0.5, 1.0)),
    )
    ramp = replace(fox.ramp, tip=(0.5, 0.4, 0.3))
    assert changed == replace(fox, coat=coat, ramp=ramp, basis="eigen", colour_plane=False, height_share=0.4)
    assert override(fox, {}) == fox


@pytest.mark.parametrize("name", preset_names())
def test_own_colours_leave_the_light_and_dark_of_a_preset(name: str) -> None:
    dyed, grey = preset(name), preset(name, own_colours=True)
    assert replace(grey, ramp=dyed.ramp, own_colours=False) == dyed
    colours = np.array([[getattr(ramp, part) for part in ("root", "tip", "tip2")] for ramp in (dyed.ramp, grey.ramp)])
    assert (colours[1] == colours[1, :, :1]).all()
    assert colours[1].max() == 1
    light = colours @ [0.2126, 0.7152, 0.0722]
    np.testing.assert_allclose(light[1] / light[1].max(), light[0] / light[0, 1:].max(), atol=1e-12)
    assert grey.ramp.power == dyed.ramp.power
    assert not grey.ramp.hued


def test_which_ramps_have_a_hue() -> None:
    assert preset("fox").ramp.hued
    assert not Ramp(root=(0.5, 0.2, 0.1), tip=(1, 1, 1), tip2=(0.9, 0.8, 0.75)).hued
    assert not Ramp(tip=(0, 0, 0), tip2=(0, 0, 0)).hued
    assert Ramp(tip=(0, 0, 0), tip2=(0, 0, 0)).grey.tip == (0, 0, 0)


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("coat.guard.cout", "3", "got 'coat.guard.cout', expected a knob such as coat.guard.count"),
        ("", "3", "got '', expected a knob such as "),
        ("layers", "many", "layers: got 'many', expected a whole number, 1 to 64"),
        ("layers", "", "layers: got '', expected a whole number, 1 to 64"),
        ("layers", "1\nsize = 2", "layers: got '1\\nsize = 2', expected a whole number, 1 to 64"),
        ("layers", "65", "layers: got 65, expected 1 to 64"),
        ("coat.lean", "1", "coat.lean: got [1], expected two numbers, each -2 to 2"),
        ("coat.bend", "inf", "coat.bend: got inf, expected 1 to 4"),
        ("coat.bend", "2..5", "coat.bend: got '2..5', expected a number, 1 to 4"),
        ("basis", "fft", "basis: got 'fft', expected ptm or eigen"),
    ],
)
def test_override_tells_what_is_wrong(name: str, text: str, message: str) -> None:
    with pytest.raises(OptionError) as caught:
        override(BakeOptions(), {name: text})
    assert str(caught.value).startswith(message)


@pytest.mark.parametrize(
    "record", [{"layers": "x"}, {"coat": 3}, {"coat": {"guard": {"cout": 1}}}, {"no": 1}, {"size": 3}]
)
def test_a_record_that_is_none_is_told(record: dict[str, Any]) -> None:
    with pytest.raises(OptionError):
        BakeOptions.from_record(record)


def test_paper_is_the_articles_volume() -> None:
    paper = preset("paper")
    assert (paper.layers, paper.size, paper.basis, paper.coefficients) == (16, 64, "ptm", 6)
    assert paper.colour_plane
    assert paper == replace(BakeOptions(), seed=paper.seed)


def test_a_record_gives_the_options_back_from_json() -> None:
    options = replace(preset("paper"), length=0.25, seed=7, coat=Coat(guard=Hairs(count=12)))
    assert BakeOptions.from_record(json.loads(json.dumps(options.as_record()))) == options


def test_only_a_record_of_a_bake_with_directions_names_them() -> None:
    assert "directions" not in BakeOptions().as_record()
    options = BakeOptions(directions=True)
    assert options.as_record()["directions"] is True
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
