from __future__ import annotations

import json
import re
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from furbake.cli import actions
from helpers.command import TINY


def test_verify_without_mitsuba_says_how_to_get_it(run: Callable[..., Any], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "mitsuba", None)
    run("bake", "plane", "-o", "out", "--flat", *TINY)
    done = run("verify", "out")
    assert (done.status, done.out) == (2, "")
    assert re.fullmatch(r"furbake: error: mitsuba: .* pip install .*\[verify\].*\n", done.err)


def test_verify_prints_the_figures(run: Callable[..., Any], monkeypatch: pytest.MonkeyPatch) -> None:
    given: dict[str, Any] = {}

    def compared(folder: Path, **told: Any) -> dict[str, Any]:
        given.update(told, folder=folder)
        part = {"r": 0.9, "r_worst": 0.8, "r_brightness": 0.99, "ratio": 0.75}
        return {
            "samples": part,
            "fit": part,
            "coverage": {"pelt": 0.9, "traced": 0.8, "r": 0.7},
            "met": {"fit.r": {"got": 0.7, "target": 0.74, "met": False}},
            "spp": told["spp"],
            "depth": 32,
            "pixels": 64,
        }

    monkeypatch.setattr(actions, "verify", compared)
    out = run("verify", "out", "-o", "side.png", "--spp", "9").out.splitlines()
    assert out[0] == "path traced: depth 32, 9 paths per pixel, 64 pixels a side"
    assert out[-1] == "missed: fit.r 0.700 < 0.74"
    assert (given["folder"], given["picture"], given["spp"]) == (Path("out"), Path("side.png"), 9)
    assert json.loads(run("verify", "out", "--json").out)["samples"]["r"] == 0.9


def test_compare_is_a_table(run: Callable[..., Any]) -> None:
    Path("tiny.toml").write_text("layers = 4\nsize = 8\ncoat.guard.count = 20\ncoat.under.count = 20\n")
    done = run("compare", "tiny.toml", "--lights", "64", "--quiet")
    assert (done.status, done.err) == (0, "")
    assert done.out.startswith("| fur | basis |")
    assert len(done.out.splitlines()) == 12
    assert "| tiny | ptm, 6 numbers, curves |" in done.out


def test_patches_is_a_table(run: Callable[..., Any]) -> None:
    done = run("patches", "torus:16x16", "sphere", "--faces", "512")
    assert (done.status, done.err) == (0, "")
    assert [line.split(" | ")[1:3] for line in done.out.splitlines()[2:]] == [["512", "100.00%"]] * 2
