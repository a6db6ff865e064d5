"""Files of regions: what they give, and one sentence for whatever is wrong in them."""

from __future__ import annotations

from pathlib import Path

import pytest

from furbake.options import BakeOptions, OptionError, preset
from furbake.options.regions import read_regions, region_files

BALL = "near = [[0, 0, 0, 1]]"


def read(tmp_path: Path, text: str, coat: BakeOptions | None = None):
    path = tmp_path / "lion.toml"
    path.write_text(text, "utf-8")
    return read_regions(str(path), coat or preset("fox"))


def test_a_region_has_the_hairs_of_its_preset_and_the_slabs_of_the_coat(tmp_path: Path) -> None:
    text = f'[mane]\n{BALL}\npreset = "teddy"\nlength = 0.2\ndensity = 0.5\ntip = [0.5, 0.2, 0.1]\n'
    text += "set = { coat.bend = 2 }"
    (mane,) = read(tmp_path, text)
    coat, teddy = preset("fox"), preset("teddy")
    assert (mane.options.layers, mane.options.size, mane.options.colour_plane) == (24, 128, coat.colour_plane)
    assert mane.options.coat.guard.radius == teddy.coat.guard.radius
    assert mane.options.coat.guard.count == round(teddy.coat.guard.count / 2)
    assert mane.options.coat.bend == 2
    assert mane.options.ramp.tip == (0.5, 0.2, 0.1)
    assert mane.options.ramp.root == teddy.ramp.root
    assert (mane.options.length, mane.options.height_share) == (0.2, teddy.height_share)
    assert mane.near == ((0.0, 0.0, 0.0, 1.0),)


def test_without_a_preset_all_is_as_in_the_coat(tmp_path: Path) -> None:
    coat = preset("wolf")
    (mane,) = read(tmp_path, f"[mane]\n{BALL}", coat)
    assert mane.options == coat


def test_own_colours_leave_the_hues_of_a_region_s_preset_out_but_not_its_own_tip(tmp_path: Path) -> None:
    coat = preset("fox", own_colours=True)
    ear, mane = read(
        tmp_path, f'[ear]\n{BALL}\npreset = "teddy"\n[mane]\n{BALL}\npreset = "teddy"\ntip = [1, 0, 0]', coat
    )
    assert ear.options.ramp == preset("teddy").ramp.grey
    assert mane.options.ramp.tip == (1, 0, 0)


def test_files_are_seen_from_the_toml_file(tmp_path: Path) -> None:
    (tmp_path / "own.toml").write_text('extends = "mole"\n')
    path = tmp_path / "lion.toml"
    path.write_text('[mane]\nmask = "mane.png"\npreset = "own.toml"\n[ear]\nmask = "vertex:ear"\n')
    mane, ear = read_regions(str(path), preset("fox"))
    assert mane.mask == str(tmp_path / "mane.png")
    assert ear.mask == "vertex:ear"
    assert mane.options.coat == preset("mole").coat
    assert region_files(str(path)) == [str(tmp_path / "mane.png"), str(tmp_path / "own.toml")]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[mane", "got no valid TOML"),
        ("", "got 0 regions, expected 1 to 3"),
        ("\n".join(f"[r{i}]\n{BALL}" for i in range(4)), "got 4 regions, expected 1 to 3"),
        ("mane = 1", "mane: got 1, expected a table"),
        (f"[coat]\n{BALL}", "coat: got a table, expected other names"),
        (f"[mane]\n{BALL}\nlenght = 1", "mane.lenght: got an unknown key, expected one of mask, material"),
        ("[mane]\nlength = 1", "mane: got no place, expected one of mask, material, near"),
        (f'[mane]\n{BALL}\nmask = "a.png"', "mane: got mask and near, expected one of"),
        ("[mane]\nmask = 3", "mane: mask: got 3, expected a text"),
        ("[mane]\nnear = [[0, 0, 0]]", "mane: near: got [0, 0, 0], expected balls"),
        ("[mane]\nnear = [[0, 0, 0, -1]]", "mane: near: got [0, 0, 0, -1], expected balls"),
        ("[mane]\nnear = []", "mane: near: got [], expected balls"),
        (f"[mane]\n{BALL}\nlength = 0", "mane: length: got 0, expected"),
        (f"[mane]\n{BALL}\nborder = nan", "mane: border: got nan, expected"),
        (f"[mane]\n{BALL}\ndensity = 100", "mane: density: got 100, expected 0.1 to 8"),
        (f'[mane]\n{BALL}\npreset = "cat"', "mane: preset: got 'cat', expected one of"),
        (f"[mane]\n{BALL}\ntip = [2, 0, 0]", "mane: tip: got 2, expected 0 to 1"),
        (f"[mane]\n{BALL}\nset = {{ layers = 8 }}", "mane: set.layers: is the same on the whole body"),
        (f"[mane]\n{BALL}\nset = {{ coat.lien = 8 }}", "mane: got 'coat.lien', expected a knob such as coat.lean"),
    ],
)
def test_whatever_is_wrong_gets_one_sentence(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(OptionError) as caught:
        read(tmp_path, text)
    assert str(caught.value).startswith(f"regions: lion.toml: {message}")
    assert "\n" not in str(caught.value)


def test_a_missing_file_gets_one_sentence() -> None:
    with pytest.raises(OptionError, match=r"regions: no.toml: got 'no.toml' \(no such file"):
        read_regions("no.toml", preset("fox"))
