"""Finished pelts are taken from the cache, and only where they are the right ones."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import pytest

from furbake.asset import planes
from furbake.options import BakeOptions
from furbake.options.bake_options import OF_BODY
from furbake.pelt.hairs.ramp import Ramp
from furbake.pelt.hairs.strands import Coat
from furbake.tile import kept
from furbake.tile.tile import Tile
from helpers.command import TINY, files

FUR = (*TINY, "--set", "coat.guard.count=20", "--set", "coat.under.count=20")


@pytest.fixture
def grown(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """Heights of the tiles that were grown: none where a pelt comes from the cache."""
    heights: list[float] = []
    grow = Tile.grow

    def noted(options: BakeOptions, height: float, *more: Any) -> Tile:
        heights.append(height)
        return grow(options, height, *more)

    monkeypatch.setattr(Tile, "grow", noted)
    return heights


@pytest.fixture
def encoded(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Names of the pelts' images that were encoded: none where their bytes come from the cache."""
    names: list[str] = []
    write = planes.write_png

    def noted(path: Path, *more: Any) -> None:
        names.append(path.name)
        write(path, *more)

    monkeypatch.setattr(planes, "write_png", noted)
    return names


def bake(run: Callable[..., Any], model: object, out: str, *options: str) -> None:
    done = run("bake", model, "-o", out, *FUR, "--quiet", *options)
    assert done.status == 0, done.err


def test_bytes_are_the_same_with_and_without_the_cache(run: Callable[..., Any], grown: list[float]) -> None:
    states = ("--states", "dry,wet", "--dirt", "--directions")
    bake(run, "torus:8x12", "without", "--no-cache", *states)
    assert len(grown) == 1
    bake(run, "torus:8x12", "first", "--cache", "pelts", *states)
    assert len(grown) == 2
    bake(run, "torus:8x12", "second", "--cache", "pelts", *states)
    assert len(grown) == 2
    assert files(Path("without")) == files(Path("first")) == files(Path("second"))


def test_another_body_of_another_size_takes_the_same_pelt(run: Callable[..., Any], grown: list[float]) -> None:
    bake(run, "plane:4x4", "plane", "--cache", "pelts", "--no-fins")
    bake(run, "torus:8x12", "torus", "--cache", "pelts", "--length", "0.2", "--uv", "own")
    assert len(grown) == 2, "the first had no fins"
    bake(run, "sphere", "sphere", "--cache", "pelts", "--guide", "down")
    assert len(grown) == 2
    bake(run, "sphere", "alone", "--no-cache", "--guide", "down")
    assert files(Path("sphere")) == files(Path("alone"))


def test_images_of_another_body_are_not_encoded_again(run: Callable[..., Any], encoded: list[str]) -> None:
    bake(run, "torus:8x12", "torus", "--cache", "pelts", "--dirt")
    assert sorted(encoded) == sorted(path.name for path in Path("torus").glob("*.png"))
    bake(run, "sphere", "sphere", "--cache", "pelts", "--dirt")
    assert len(encoded) == len(set(encoded))
    bake(run, "sphere", "alone", "--no-cache", "--dirt")
    assert files(Path("sphere")) == files(Path("alone"))


def test_images_whose_entry_was_removed_or_cut_short_are_encoded_anew(
    run: Callable[..., Any], encoded: list[str]
) -> None:
    bake(run, "plane", "first", "--cache", "pelts", "--dirt")
    removed, cut = sorted(Path("pelts").glob("*-images.npz"))
    removed.unlink()
    cut.write_bytes(cut.read_bytes()[:-9])
    bake(run, "plane", "second", "--cache", "pelts", "--dirt")
    assert sorted(encoded) == sorted(2 * [path.name for path in Path("first").glob("*.png")])
    assert files(Path("first")) == files(Path("second"))


def test_another_encoder_encodes_images_anew(
    run: Callable[..., Any], encoded: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    bake(run, "plane", "first", "--cache", "pelts")
    once = len(encoded)
    monkeypatch.setattr(planes, "encoder", lambda: "changed")
    bake(run, "plane", "second", "--cache", "pelts")
    assert len(encoded) == 2 * once


def test_another_fur_is_not_served_this_one(run: Callable[..., Any], grown: list[float]) -> None:
    bake(run, "torus:8x12", "out", "--cache", "pelts")
    bake(run, "torus:8x12", "other", "--cache", "pelts", "--seed", "1")
    bake(run, "torus:8x12", "alone", "--no-cache", "--seed", "1")
    assert len(grown) == 3
    assert files(Path("other")) == files(Path("alone"))


@pytest.mark.parametrize(
    "other",
    [
        {"layers": 5}, {"size": 16}, {"lights": 9}, {"basis": "eigen"}, {"coefficients": 5}, {"curves": "none"},
        {"seed": 1}, {"flat": True}, {"coat": Coat(clumps=7)}, {"ramp": Ramp(power=2)}, {"colour_plane": False},
        {"directions": True}, {"states": ("dry", "wet")}, {"dirt": True},
    ],
    ids=lambda other: next(iter(other)),
)  # fmt: skip
def test_all_that_is_the_tile_s_own_counts(other: dict[str, Any]) -> None:
    keys = {kept.pelt_key(replace(BakeOptions(), **own).of_tile(), 0.5) for own in ({}, other)}
    assert len(keys) == 2
    assert kept.pelt_key(BakeOptions().of_tile(), 0.6) not in keys
    of_body = replace(BakeOptions(), preset="x", length=1.0, guide="down", mask="vertex:red", fins=False, **other)
    assert kept.pelt_key(of_body.of_tile(), 0.5) in keys


def test_other_code_makes_its_own_pelts(
    run: Callable[..., Any], grown: list[float], monkeypatch: pytest.MonkeyPatch
) -> None:
    bake(run, "plane", "out", "--cache", "pelts")
    monkeypatch.setattr(kept, "code_hash", lambda rooms: "changed")
    bake(run, "plane", "again", "--cache", "pelts")
    assert len(grown) == 2


def test_samples_are_taken_anew(run: Callable[..., Any], grown: list[float]) -> None:
    bake(run, "plane", "out", "--cache", "pelts")
    bake(run, "plane", "again", "--cache", "pelts", "--samples", "light.npz")
    assert len(grown) == 2
    assert Path("light.npz").stat().st_size > 0


def test_the_environment_names_a_folder(run: Callable[..., Any], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("FURBAKE_CACHE", "named")
    bake(run, "plane", "out")
    assert list(Path("named").glob("*.npz"))
    monkeypatch.setenv("FURBAKE_CACHE", "")
    monkeypatch.setenv("XDG_CACHE_HOME", "home")
    bake(run, "plane", "again")
    assert not Path("home").exists()


def test_a_folder_and_no_cache_at_once_are_refused(run: Callable[..., Any]) -> None:
    done = run("bake", "plane", "-o", "out", *FUR, "--cache", "pelts", "--no-cache")
    assert done.status == 2
    assert done.err == "furbake: error: cache: got 'pelts' and --no-cache, expected one of them\n"


def test_a_tile_sees_nothing_of_its_body() -> None:
    names = {field.name for field in fields(BakeOptions)}
    assert set(OF_BODY) <= names
    own = names - set(OF_BODY)
    assert own == {
        "layers", "size", "lights", "basis", "coefficients", "curves", "seed", "flat", "coat", "ramp", "colour_plane",
        "directions", "states", "dirt", "bits", "swatch",
    }, "a new option is the tile's own until it is named in OF_BODY: say here which it is"  # fmt: skip
