"""The lesson's folder holds what a bake fits, and says how good that is."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from furbake.asset.planes import Planes, read_png, unpack
from furbake.asset.read import read_asset
from furbake.asset.stored import read_pelt
from furbake.options import BakeOptions, OptionError
from furbake.pelt.hairs.strands import Coat, Hairs, grow
from furbake.pelt.texels.basis import PTM, Basis, ptm
from furbake.pelt.texels.fill import SOLID
from furbake.pelt.texels.quantise import quantise
from furbake.pipeline import bake
from furbake.show import lesson

PUBLIC = Path(__file__).parents[3] / "public"


def small(**changes: Any) -> BakeOptions:
    hairs = Hairs(count=40)
    coat = Coat(guard=hairs, under=hairs, clumps=5)
    return replace(BakeOptions(layers=4, size=16, lights=16, coat=coat), **changes)


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A small lesson; tests read it."""
    folder = tmp_path_factory.mktemp("lesson") / "out"
    lesson.write(folder, small())
    return folder


def record_of(folder: Path) -> Any:
    return json.loads((folder / "lesson.json").read_text("utf-8"))


def texels_of(folder: Path, record: Any) -> Any:
    return unpack(Planes(tuple(read_png(folder / name) for name in record["planes"]), None), 6)


def samples_of(folder: Path, entry: Any) -> np.ndarray[Any, Any]:
    """L, (lights, texels)."""
    with Image.open(folder / entry["file"]) as picture:
        return np.asarray(picture, np.float64) * entry["scale"]


@pytest.mark.parametrize("folder", ["made", "public"])
def test_the_kept_samples_fit_to_the_stored_bytes(folder: str, made: Path) -> None:
    where = PUBLIC / "lesson" if folder == "public" else made
    record = record_of(where)
    lights = np.array(record["lights"])
    seen = ptm(lights[: record["fitted"]])
    texels, scale, bias = texels_of(where, record), np.array(record["scale"]), np.array(record["bias"])
    for i, entry in enumerate(record["samples"]):
        alpha = texels.alpha[i]
        samples = samples_of(where, entry)
        assert samples.shape == (len(lights), entry["texels"])
        assert entry["texels"] == (alpha > 0).sum()
        coefficients = (np.linalg.pinv(seen) @ samples[: record["fitted"]]).T
        again = quantise(coefficients, scale, bias, seen.T @ seen / len(seen)).astype(int)
        solid = alpha[alpha > 0] >= SOLID * 255 + 1  # others take of their neighbours
        off = np.abs(again - texels.codes[i][alpha > 0])[solid]
        assert (off == 0).mean() > 0.9
        # Where the rounding of one number goes the other way, those after it make up for it: as light nothing is lost.
        lost = (scale * (again - texels.codes[i][alpha > 0])[solid]) @ seen.T
        assert np.sqrt((lost**2).mean()) < 0.002 * record["peak"]


def test_the_committed_lesson_is_of_the_committed_models() -> None:
    record = record_of(PUBLIC / "lesson")
    torus = read_asset(PUBLIC / "models" / "torus-512-colour")
    baked = {key: value for key, value in torus.record["fit"].items() if key != "fin"}
    assert record["fit"] == baked
    pelt, texels = read_pelt(torus), texels_of(PUBLIC / "lesson", record)
    for i, entry in enumerate(record["samples"]):
        np.testing.assert_array_equal(texels.codes[i], pelt.codes[entry["layer"]])
        np.testing.assert_array_equal(texels.alpha[i], pelt.alpha[entry["layer"]])
    np.testing.assert_allclose(record["scale"], pelt.scale, rtol=1e-6)
    np.testing.assert_allclose(record["bias"], pelt.bias, rtol=1e-6)
    sizes = {path.name: path.stat().st_size for path in (PUBLIC / "lesson").iterdir()}
    assert sum(sizes.values()) < 2.5e6
    assert max(size for name, size in sizes.items() if name.startswith("samples")) < 400_000
    assert sizes["strands.bin"] < 150_000


def test_the_figures_are_those_of_a_bake(tmp_path: Path, made: Path) -> None:
    record = record_of(made)
    fit = bake("plane", tmp_path / "plane", small(fins=False, curves="none", bits=8)).record["fit"]
    assert record["fit"] == fit
    assert record["key"] == lesson.lesson_key(small())

    def at(rows: str, name: str, value: int) -> Any:
        return next(row for row in record[rows] if row[name] == value)

    assert at("ptm", "numbers", 6)["psnr"] == pytest.approx(fit["psnr"], abs=1e-3)
    assert at("bound", "numbers", 6)["psnr"] == pytest.approx(fit["bound"]["psnr"], abs=1e-3)
    assert at("bits", "bits", 8)["psnr"] == pytest.approx(fit["psnr_quantised"], abs=1e-3)
    assert at("bits", "bits", 8)["noise"] == pytest.approx(fit["psnr_quantisation"], abs=1e-3)
    eigen = bake("plane", tmp_path / "four", small(fins=False, basis="eigen", coefficients=4, curves="none")).record[
        "fit"
    ]
    assert at("eigen_figures", "numbers", 4)["psnr"] == pytest.approx(eigen["psnr"], abs=1e-3)
    noise = [row["noise"] for row in record["bits"]]
    assert noise == sorted(noise), "more bits, less noise"
    for ours, best in zip(record["eigen_figures"], record["bound"][2:], strict=False):
        assert ours["psnr"] < best["psnr"], "nothing passes the bound"


def test_what_the_page_needs_besides(made: Path) -> None:
    record = record_of(made)
    lights = np.array(record["lights"])
    np.testing.assert_allclose(np.linalg.norm(lights, axis=1), 1, atol=1e-6)
    fitted = lights[: record["fitted"]]
    np.testing.assert_allclose(record["singular_values"], np.linalg.svd(ptm(fitted), compute_uv=False), rtol=1e-5)
    assert len(lights) == record["fitted"] + record["held_out"] + len(record["angles"])
    arc = lights[-len(record["angles"]) :]
    np.testing.assert_allclose(np.degrees(np.arctan2(arc[:, 1], arc[:, 2])), record["angles"], atol=1e-4)
    eigen = Basis("eigen", record["eigen"]["degree"], np.array(record["eigen"]["matrix"]))
    assert eigen(lights).shape == (len(lights), 6)
    assert PTM(lights).shape == (len(lights), 6)
    entry = record["strands"]
    numbers = np.fromfile(made / entry["file"], "<f4")
    cut = entry["strands"] * entry["points"] * 4
    curves = numbers[:cut].reshape(entry["strands"], entry["points"], 4)
    whole = grow(small().coat, record["height"], small().seed)
    np.testing.assert_allclose(curves[:, [0, -1], :3], whole.points[:, [0, -1]], atol=1e-6)
    np.testing.assert_allclose(curves[:, 0, 3], whole.radius[:, 0], rtol=1e-6)
    np.testing.assert_allclose(numbers[cut:], whole.tint[:, 0], rtol=1e-6)


def test_the_command(run: Callable[..., Any], tmp_path: Path) -> None:
    knobs = ("layers=2", "size=8", "lights=8", "coat.guard.count=12", "coat.under.count=12", "coat.clumps=3")
    args = [part for knob in knobs for part in ("--set", knob)]
    first, second = tmp_path / "first", tmp_path / "second"
    done = run("lesson", "-o", first, *args)
    assert done.status == 0
    assert done.out.startswith(f"{first}: 2 layers measured, ")
    stages = [line.split()[1] for line in done.err.splitlines()]
    assert stages == list(lesson.STAGES)
    assert run("lesson", "-o", second, *args, "--quiet").out == ""
    written = {path.name: path.read_bytes() for path in first.iterdir()}
    assert written == {path.name: path.read_bytes() for path in second.iterdir()}, "the same bytes"
    assert set(written) == {"lesson.json", *json.loads(written["lesson.json"])["bytes"]}
    assert run("lesson", "-o", first, *args, "--if-stale").out == f"{first}: up to date\n"
    told = json.loads(run("lesson", "-o", first, *args, "--if-stale", "--json", "--quiet").out)
    assert told["baked"] is False
    (first / "strands.bin").unlink()
    assert "layers measured" in run("lesson", "-o", first, *args, "--if-stale").out
    assert (first / "strands.bin").read_bytes() == written["strands.bin"]
    record = json.loads((first / "lesson.json").read_text())
    record["libraries"]["numpy"] = "1.0"
    (first / "lesson.json").write_text(json.dumps(record))
    assert "layers measured" in run("lesson", "-o", first, *args, "--if-stale").out, "made with another numpy"
    assert (first / "lesson.json").read_bytes() == written["lesson.json"]
    if hasattr(os, "mkfifo"):
        os.mkfifo(tmp_path / "lesson.json")
        assert lesson.fresh(tmp_path, BakeOptions()) is None, "a pipe is not waited for"
    changed = run("lesson", "-o", first, *args, "--set", "seed=3", "--if-stale", "--quiet")
    assert changed.status == 0
    assert (first / "strands.bin").read_bytes() != written["strands.bin"]


@pytest.mark.parametrize(
    ("args", "message"),
    [
        ((), "o: missing, expected furbake lesson -o DIR"),
        (("-o", "out", "--preset", "unicorn"), "preset: got 'unicorn', expected one of"),
        (("-o", "out", "--set", "basis=eigen"), "basis: got eigen, expected ptm"),
        (("-o", "out", "--set", "size=48"), "size: got 48, expected a power of two"),
        (("-o", "taken"), "taken: exists already, expected a new folder (or --force to replace it)"),
    ],
)
def test_bad_input(
    run: Callable[..., Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, args: Any, message: str
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "taken").mkdir()
    done = run("lesson", *args)
    assert done.status == 2
    assert done.out == ""
    assert message in done.err
    assert done.err.count("\n") == 1
    assert [path.name for path in tmp_path.iterdir()] == ["taken"]


def test_eigen_is_refused_by_the_library_too(tmp_path: Path) -> None:
    with pytest.raises(OptionError, match="basis: got eigen"):
        lesson.write(tmp_path / "out", small(basis="eigen"))
