"""The commands for museums: relighting and fitting what they have, writing what they read, fur of their photographs."""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from furbake.asset.read import read_asset
from furbake.asset.stored import read_pelt
from furbake.show.swatch import render
from helpers.command import TINY, listed
from helpers.museum import head, jpeg_ptm, known, lamps, photographed, picture_under, ptm_under, relight_under

LIGHT = np.array([-0.48, 0.6, 0.64])
TOWARDS = ("--light", "-0.48,0.6,0.64")


def shown(name: str) -> np.ndarray:
    return np.asarray(Image.open(name).convert("RGB"), float)


def test_photographs_are_fitted_relit_and_written(run: Callable[..., Any]) -> None:
    photographed(Path(), lamps(20))
    done = run("swatch", "set.lp", "-o", "a.png", *TOWARDS)
    assert (done.status, done.err.count("error")) == (0, 0)
    rows = [line.split() for line in done.out.splitlines()]
    assert rows[0] == ["fit", "numbers", "dB", "lamps"]
    assert [row[:2] for row in rows[1:7]] == [
        ["ptm", "rgb"],
        ["ptm", "lrgb"],
        *(["eigen", f"{i}"] for i in (3, 4, 5, 6)),
    ]
    assert rows[-1] == ["a.png:", "ptm", "lrgb,", "13", "x", "9"]
    assert np.abs(shown("a.png") - 255 * picture_under(LIGHT, *known())).max() < 4
    assert run("swatch", "set.lp", "-o", "own.ptm", "--format", "rgb", "--quiet").out == ""
    assert np.abs(ptm_under(Path("own.ptm").read_bytes(), LIGHT) - 255 * picture_under(LIGHT, *known())).max() < 4
    done = run("swatch", "set.lp", "own.ptm", "-o", "b.png", "--json")
    fits = {fit["name"]: fit for fit in json.loads(done.out)["fits"]}
    assert fits["own.ptm (ptm rgb)"]["psnr"] > 48
    assert fits["own.ptm (ptm rgb)"]["left_out"] is False
    assert fits["ptm rgb"]["left_out"] is True
    assert run("swatch", "own.ptm", "-o", "c.png", *TOWARDS, "--quiet").status == 0
    assert np.abs(shown("c.png") - ptm_under(Path("own.ptm").read_bytes(), LIGHT)).max() <= 1


def test_nothing_that_is_read_is_written_over(run: Callable[..., Any], fur: Path) -> None:
    photographed(Path(), lamps(9))
    assert run("swatch", "set.lp", "-o", "own.ptm", "--quiet").status == 0
    assert run("export", fur, "--relight", "planes", "--planes", "png", "--pixels", "16", "--quiet").status == 0
    before = {path: path.read_bytes() for path in Path().rglob("*") if path.is_file()}
    for files, out in (
        (("set.lp",), "photo 03.png"),
        (("set.lp", "own.ptm"), "own.ptm"),
        (("planes",), "planes/plane_1.png"),
        (("planes/info.json",), "./planes/plane_0.png"),
    ):
        done = run("swatch", *files, "-o", out)
        assert done.status == 2
        assert done.err.endswith(f"out: got {Path(out)}, which is read for it, expected another file\n")
    assert {path: path.read_bytes() for path in Path().rglob("*") if path.is_file()} == before


def test_lamps_that_tell_no_polynomial_are_told(run: Callable[..., Any]) -> None:
    ring = lamps(12) * [1, 1, 0] + [0, 0, 1]
    ring[:, :2] /= np.hypot(*ring[:, :2].T)[:, None]
    photographed(Path(), ring / np.sqrt(2))
    done = run("swatch", "set.lp", "-o", "a.png")
    assert "note: set.lp: its lamps tell 5 of the 6 numbers of a PTM apart: the others are a guess" in done.err
    photographed(Path(), lamps(12) * [1, 1, -1])
    done = run("swatch", "set.lp", "-o", "below.png")
    assert done.status == 2
    assert "set.lp: 0 of 12 lamps above the horizon, expected 6 or more" in done.err
    assert not Path("below.png").exists()
    photographed(Path(), lamps(12) * np.where(np.arange(12) < 3, -1, 1)[:, None] ** [2, 2, 1])
    with Path("set.lp").open("a") as file:
        file.write("photo 05.png 0 0 1\n")
    done = run("swatch", "set.lp", "-o", "a.png")
    assert "note: set.lp: 3 of 13 lamps are not above the horizon, where a PTM has no light" in done.err
    assert "note: set.lp: lists photo 05.png 2 times" in done.err


def test_an_export_is_whole_or_nothing(run: Callable[..., Any], fur: Path) -> None:
    Path("there").mkdir()
    done = run("export", fur, "--glb", "a.glb", "--ptm", "a.ptm", "--relight", "there", "--quiet")
    assert done.status == 2
    done = run("export", fur, "--glb", "a.glb", "--ptm", "a.ptm", "--state", "wett", "--quiet")
    assert done.status == 2
    assert sorted(path.name for path in Path().iterdir() if path.suffix in {".glb", ".ptm"}) == []


def test_what_is_left_out_is_told(run: Callable[..., Any]) -> None:
    photographed(Path(), lamps(9))
    Path("photo 03.png").unlink()
    done = run("swatch", "set.lp", "-o", "a.png")
    assert "furbake: note: set.lp: not found beside it: photo 03.png: left out\n" in done.err
    assert done.status == 0


@pytest.fixture(scope="module")
def fur(tmp_path_factory: pytest.TempPathFactory) -> Path:
    from furbake import cli  # noqa: PLC0415 — as the fixture `run` does

    here = tmp_path_factory.mktemp("fur")
    before = Path.cwd()
    os.chdir(here)
    try:
        assert cli.main(["bake", "plane", "-o", "out", *TINY, "--no-fins", "--quiet", "--lights", "16"]) == 0
    finally:
        os.chdir(before)
    return here / "out"


@pytest.mark.parametrize("kind", ["lrgb", "rgb"])
def test_a_pelt_from_above_is_what_the_swatch_shows(run: Callable[..., Any], fur: Path, kind: str) -> None:
    done = run(
        "export",
        fur,
        "--ptm",
        "a.ptm",
        "--relight",
        "r",
        "--planes",
        "png",
        "--format",
        kind,
        "--pixels",
        "32",
        "--json",
    )
    record = json.loads(done.out)
    assert done.status == 0
    assert (record["kind"], record["width"], record["height"], record["coding"]) == (f"ptm {kind}", 32, 32, "srgb")
    found = ptm_under(Path("a.ptm").read_bytes(), LIGHT)
    wanted = render(fur, tuple(LIGHT), tiles=2, size=32).astype(float)
    error = 10 * np.log10(255**2 / ((found - wanted) ** 2).mean())
    assert error > record["psnr"] - 6
    assert np.corrcoef(found.ravel(), wanted.ravel())[0, 1] > 0.97
    for light in lamps(4):
        assert np.abs(relight_under(Path("r"), light) - ptm_under(Path("a.ptm").read_bytes(), light)).max() < 1e-2


def test_a_slab_alone_has_its_own_light(run: Callable[..., Any], fur: Path) -> None:
    assert run("export", fur, "--ptm", "a.ptm", "--layer", "2", "--linear", "--format", "rgb", "--quiet").status == 0
    pelt = read_pelt(read_asset(fur))
    assert pelt.colour is not None
    light = pelt.light(LIGHT[None])[0, 2] * pelt.alpha[2] * (pelt.colour[2].mean(-1) / 255) ** 2.2
    found = ptm_under(Path("a.ptm").read_bytes(), LIGHT).mean(-1)[::-1]
    assert found.shape == light.shape
    assert np.corrcoef(found.ravel(), light.ravel())[0, 1] > 0.9
    refused = run("export", fur, "--ptm", "b.ptm", "--layer", "4")
    assert refused.err == "furbake: error: layer: got '4', expected composite or 0 to 3\n"
    assert not Path("b.ptm").exists()


def test_photographs_become_a_skin(run: Callable[..., Any]) -> None:
    photographed(Path(), lamps(24), width=40, height=32)
    done = run("bake", "torus:8x12", "-o", "out", "--swatch", "set.lp", "--size", "16", "--quiet")
    assert (done.status, done.err) == (0, "")
    assert run("validate", "out").status == 0
    fur = read_asset(Path("out")).fur
    assert (fur["layers"], fur["height"], "fins" in fur) == (1, 0.05, False)
    pelt = read_pelt(read_asset(Path("out")))
    assert pelt.colour is not None
    assert (pelt.alpha == 255).all()
    assert json.loads(Path("out/bake.json").read_text())["fit"]["psnr"] > 40
    again = run("bake", "torus:8x12", "-o", "out", "--swatch", "set.lp", "--size", "16", "--if-stale")
    assert again.out == "out: up to date\n"
    Path("photo 05.png").write_bytes(Path("photo 06.png").read_bytes())
    assert (
        "out: torus:8x12"
        in run("bake", "torus:8x12", "-o", "out", "--swatch", "set.lp", "--size", "16", "--if-stale").out
    )


def test_strands_of_photographs_are_not_to_be_had(run: Callable[..., Any]) -> None:
    photographed(Path(), lamps(12), width=16, height=16)
    baked = run("bake", "torus:8x12", "-o", "out", "--swatch", "set.lp", "--size", "8", "--seed", "3", "--quiet")
    assert baked.status == 0
    for command in (("groom", "out", "-o", "a.npz"), ("report", "out", "--no-model"), ("verify", "out")):
        done = run(*command)
        assert done.status == 2
        assert "fur that was photographed (set.lp), expected grown hairs" in done.err.splitlines()[-1]


PTM = head("LRGB", 2, 2, [1.0] * 6, [0] * 6)
BAD = {
    ("swatch", "short.ptm", "-o", "a.png"): "short.ptm: 9 bytes of pixels, expected 36 for 2 x 2 LRGB",
    ("swatch", "large.ptm", "-o", "a.png"): "large.ptm: more than 250000000 bytes to read, expected fewer",
    ("swatch", "none.lp", "-o", "a.png"): "none.lp: 0 photographs of one size (not found beside it: a.jpg, b.jpg)",
    ("swatch", "count.lp", "-o", "a.png"): "count.lp: line 1 is 'a.jpg 0 0 1', expected the number of photographs",
    ("swatch", "gone.lp", "-o", "a.png"): "gone.lp: no such file or directory, expected a file to read",
    ("swatch", "set.rti", "-o", "a.png"): "set.rti: unknown kind, expected FILE.ptm, FILE.lp, or info.json of relight",
    ("swatch", "none.lp", "-o", "a.jpg"): "out: got a.jpg, expected a name that ends in .png or .ptm",
    ("swatch", "short.ptm", "-o", "a.ptm"): "out: got a.ptm, expected a name that ends in .png",
    (
        "swatch",
        "good.ptm",
        "good.ptm",
        "-o",
        "a.png",
    ): "swatch: got good.ptm beside good.ptm, expected it beside an .lp",
    (
        "swatch",
        "good.ptm",
        "--preset",
        "fox",
        "-o",
        "a.png",
    ): "swatch: got good.ptm and --preset, expected the file alone",
    ("swatch", "good.ptm", "--format", "hsh", "-o", "a.png"): "format: got 'hsh', expected lrgb or rgb",
    ("swatch", "folder", "other", "-o", "a.png"): "swatch: got other beside folder, expected one baked folder",
    ("export", "folder"): "export: got none of --ptm, --relight and --glb, expected one of them",
    ("export", "folder", "--ptm", "a.ptm", "--planes", "gif"): "planes: got 'gif', expected jpg or png",
    ("export", "folder", "--ptm", "a.ptm", "--planes", "png"): "export: got --ptm and --planes, expected --relight",
    ("export", "folder", "--glb", "a.glb", "--planes", "png"): "export: got --glb and --planes, expected --relight",
    ("export", "folder", "--glb", "a.glb", "--tiles", "0"): "export: got --glb and --tiles, expected --ptm or",
    ("export", "folder", "--glb", "a.glb", "--linear"): "export: got --glb and --linear, expected --ptm or --relight",
    ("export", "folder", "--glb", "a.glb", "--format", "rgb"): "export: got --glb and --format, expected --ptm or",
    ("export", "folder", "--ptm", "a.ptm", "--layer", "1", "--tiles", "2"): "export: got --layer and --tiles, expected",
    ("export", "folder", "--ptm", "a.png"): "ptm: got a.png, expected a name that ends in .ptm",
    ("export", "folder", "--ptm", "a.ptm", "--glb", "a.ptm"): "glb: got a.ptm, expected a name that ends in .glb",
    ("export", "folder", "--ptm", "a.ptm", "--relight", "./a.ptm"): "export: got ./a.ptm twice, expected a place of",
    ("swatch", "folder", "-o", "a.png", "--format", "rgb"): "swatch: got folder and --format, expected it beside an",
    ("swatch", "-o", "a.png", "--format", "rgb"): "swatch: got no .lp and --format, expected it beside an .lp",
    ("swatch", "good.ptm", "-o", "a.png", "--format", "rgb"): "swatch: got good.ptm and --format, expected it beside",
    ("swatch", "good.ptm", "-o", "a.png", "--tiles", "2"): "swatch: got good.ptm and --tiles, expected the file alone",
    ("swatch", "none.lp", "-o", "a.png", "--pixels", "9"): "swatch: got none.lp and --pixels, expected the file alone",
    ("swatch", "none.lp", "-o", "a.ptm", "--light", "0,0,1"): "swatch: got a.ptm and --light, expected a .png to be",
    ("bake", "plane", "-o", "out", "--swatch", "none.lp"): "none.lp: 0 photographs of one size",
    ("bake", "plane", "-o", "out", "--swatch", "good.ptm", "--dirt"): "swatch: got good.ptm beside wet or dirty states",
    ("bake", "plane", "-o", "out", "--swatch", "good.ptm", "--lights", "32"): "lights: got 32 beside a swatch",
    ("bake", "plane", "-o", "out", "--swatch", "good.ptm", "--device", "cuda"): "device: got cuda beside a swatch",
    ("bake", "plane", "-o", "out", "--swatch", "good.ptm", "--set", "coat.bend=1"): "coat.bend: got 1 beside a swatch",
    ("bake", "plane", "-o", "out", "--swatch", "good.ptm", "--samples", "a.npz"): "samples: got a.npz beside a swatch",
}


@pytest.mark.parametrize("command", BAD, ids=" ".join)
def test_bad_files_end_in_one_line_and_leave_nothing(run: Callable[..., Any], command: tuple[str, ...]) -> None:
    Path("short.ptm").write_bytes(PTM + bytes(9))
    Path("good.ptm").write_bytes(PTM + bytes(36))
    Path("large.ptm").write_bytes(head("LRGB", 10**9, 10**9, [1.0] * 6, [0] * 6))
    Path("none.lp").write_text("2\na.jpg 0 0 1\nb.jpg 0 0.6 0.8\n")
    Path("count.lp").write_text("a.jpg 0 0 1\n")
    Path("folder").mkdir()
    before = listed()
    done = run(*command)
    assert (done.status, done.out) == (2, "")
    assert done.err.splitlines()[-1].startswith(f"furbake: error: {BAD[command]}")
    assert listed() == before


def test_a_packed_ptm_is_relit(run: Callable[..., Any]) -> None:
    planes = np.full((16, 24, 9), 128, np.uint8)
    planes[..., 5] = np.linspace(40, 200, 24).astype(np.uint8)
    scale, bias = [0.5] * 5 + [1.0], [128] * 5 + [0]
    stored, found = jpeg_ptm(planes, scale, bias)
    Path("a.ptm").write_bytes(stored)
    body = found[..., :6].astype(np.uint8).tobytes() + found[..., 6:].astype(np.uint8).tobytes()
    assert run("swatch", "a.ptm", "-o", "a.png", *TOWARDS).status == 0
    wanted = ptm_under(head("LRGB", 24, 16, scale, bias) + body, LIGHT)
    assert np.abs(shown("a.png") - wanted).max() <= 1


def test_a_folder_of_relight_is_compared_and_relit(run: Callable[..., Any], fur: Path) -> None:
    assert run("export", fur, "--relight", "r", "--pixels", "16", "--tiles", "1", "--quiet").status == 0
    assert run("swatch", "r", "-o", "a.png", *TOWARDS, "--quiet").status == 0
    assert np.abs(shown("a.png") - relight_under(Path("r"), LIGHT)).max() <= 1
    again = run("export", fur, "--relight", "r", "--quiet")
    assert again.err == "furbake: error: r: exists already, expected a new folder\n"
    shutil.rmtree("r")
