from __future__ import annotations

import json
import os
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from furbake import BakeOptions, bake
from helpers.command import CUBE, TINY, files, listed


def test_bake_inspect_validate(run: Callable[..., Any]) -> None:
    done = run("bake", "torus:8x12", "-o", "out", *TINY)
    assert done.status == 0
    summary, hint = done.out.splitlines()
    assert re.fullmatch(r"out: torus:8x12 in 4 layers of 8 x 8, [\d.]+ dB, [\d.]+ MB, [\d.]+ s", summary)
    assert hint == "to see it: npm start, then drop the folder out on the page"
    stages = re.findall(r"furbake: (\w+) [\d.]+ s\n", done.err)
    assert stages == ["mesh", "strands", "volume", "light", "fit", "fins", "write"]
    images = {"plane0.png", "plane1.png", "colour.png", "fin0.png", "fin1.png", "fin-colour.png"}
    assert set(files(Path("out"))) == {"model.gltf", "model.bin", "bake.json", *images}
    checked = run("validate", "out")
    assert (checked.status, checked.out, checked.err) == (0, "out: valid\n", "")
    told = run("inspect", "out")
    assert "layers:                   4" in told.out
    assert json.loads(run("inspect", "out", "--json").out)["fur"]["layers"] == 4


def test_the_last_line_has_the_address_of_a_folder_of_the_page(run: Callable[..., Any]) -> None:
    place = Path("site/public/models/my torus")
    place.parent.mkdir(parents=True)
    done = run("bake", "plane", "-o", place, *TINY)
    assert done.out.splitlines()[-1] == "to see it: npm start, then ?model=models/my%20torus in its address"
    again = run("bake", "plane", "-o", place, *TINY, "--if-stale")
    assert again.out == f"{place}: up to date\n"


def test_json_is_all_there_is_on_standard_output(run: Callable[..., Any]) -> None:
    done = run("bake", "plane", "-o", "out", *TINY, "--json")
    told = json.loads(done.out)
    assert told["baked"] is True
    assert set(told["seconds"]) == {"mesh", "strands", "volume", "light", "fit", "fins", "write"}
    record = json.loads(Path("out/bake.json").read_text())
    assert {key: told[key] for key in record} == record
    assert "seconds" not in record


def test_percent_is_told_line_by_line_up_to_the_end(run: Callable[..., Any]) -> None:
    done = run("bake", "plane", "-o", "out", *TINY, "--percent", "--json", "--no-cache")
    told = [re.fullmatch(r"furbake: (\d+) % (\w+)", line) for line in done.err.splitlines() if " % " in line]
    percents = [int(line[1]) for line in told if line]
    assert len(percents) == len(told) > 7
    assert percents == sorted(set(percents))
    assert percents[-1] == 100
    assert json.loads(done.out)["baked"] is True


def test_quiet(run: Callable[..., Any]) -> None:
    done = run("bake", "plane", "-o", "out", *TINY, "--quiet")
    assert (done.status, done.out, done.err) == (0, "", "")


def test_same_input_same_folder(tiny: BakeOptions) -> None:
    """Acceptance 7: two bakes are identical, bake.json included."""
    for model in ("sphere", "torus:8x12"):
        bake(model, Path(f"{model}-a"), tiny)
        bake(model, Path(f"{model}-b"), tiny)
        assert files(Path(f"{model}-a")) == files(Path(f"{model}-b"))


def test_record_has_every_figure(tiny: BakeOptions) -> None:
    """Acceptance 7: every figure of the format, and quantisation above 48 dB."""
    result = bake("plane", Path("out"), tiny)
    fit = json.loads(Path("out/bake.json").read_text())["fit"]
    assert fit == result.record["fit"]
    assert set(fit) >= {
        "psnr", "psnr_worst_layer", "psnr_composite", "r2", "psnr_quantised", "psnr_quantised_composite",
        "psnr_quantisation", "bound",
    }  # fmt: skip
    assert set(fit["bound"]) >= {"rank", "psnr", "psnr_composite"}
    assert fit["psnr_quantisation"] >= 48


def test_preset_gives_what_is_not_given(run: Callable[..., Any]) -> None:
    run("bake", "plane", "-o", "out", *TINY, "--quiet", "--seed", "7", "--tile", "0.5", "--height", "0.25")
    options = json.loads(Path("out/bake.json").read_text())["options"]
    assert (options["seed"], options["layers"], options["tile"], options["basis"]) == (7, 4, 0.5, "ptm")
    assert json.loads(Path("out/model.gltf").read_text())["extensions"]["FUR_ptm_shells"]["length"] == 0.125


def test_samples(run: Callable[..., Any]) -> None:
    assert run("bake", "plane", "-o", "out", *TINY, "--samples", "s.npz").status == 0
    with np.load("s.npz") as samples:
        layers, size, lights = 4, 8, len(samples["lights"])
        assert samples["sigma"].shape == (layers, size, size)
        assert samples["tangent"].shape == (layers, size, size, 3)
        assert samples["L"].shape == (lights, layers, size, size)
        assert samples["L"].dtype == np.float32
        assert samples["held_out"].dtype == bool
        assert samples["strands"].shape[:2] == samples["radius"].shape
    assert listed() == ["out", "s.npz"]


def test_directions_make_a_bake_without_them_stale(run: Callable[..., Any]) -> None:
    told = [
        json.loads(run("bake", "plane", "-o", "out", *TINY, "--if-stale", "--json", *more).out)
        for more in ((), ("--directions",), ("--directions",), ())
    ]
    assert [record["baked"] for record in told] == [True, True, False, True]
    assert ["direction.png" in record["asset"]["bytes"] for record in told] == [False, True, True, False]


def test_states_make_a_bake_without_them_stale(run: Callable[..., Any]) -> None:
    more = ((), ("--states", "dry,soaked", "--dirt"), ("--states", "dry, soaked", "--dirt"), ())
    told = [json.loads(run("bake", "plane", "-o", "out", *TINY, "--if-stale", "--json", *part).out) for part in more]
    assert [record["baked"] for record in told] == [True, True, False, True]
    assert ["states" in record for record in told] == [False, True, True, False]
    assert [state["name"] for state in told[1]["states"]] == ["dry", "soaked", "dirty"]


def test_states_by_their_range(run: Callable[..., Any]) -> None:
    run("bake", "plane", "-o", "out", *TINY, "--states", "dry..wet", "--no-fins")
    assert json.loads(run("inspect", "out", "--json").out)["fur"]["pelts"] == ["dry", "damp", "moist", "wet", "soaked"]


def test_if_stale(run: Callable[..., Any]) -> None:
    Path("m.obj").write_text(CUBE)
    assert json.loads(run("bake", "m.obj", "-o", "out", "--if-stale", "--json", *TINY).out)["baked"] is True
    again = run("bake", "m.obj", "-o", "out", "--if-stale", *TINY)
    assert (again.status, again.out, again.err) == (0, "out: up to date\n", "")
    assert json.loads(run("bake", "m.obj", "-o", "out", "--if-stale", "--json", *TINY).out)["baked"] is False
    Path("m.obj").write_text(CUBE.replace("v 1", "v 2"))
    assert "up to date" not in run("bake", "m.obj", "-o", "out", "--if-stale", *TINY).out
    assert "up to date" not in run("bake", "m.obj", "-o", "out", "--if-stale", *TINY, "--seed", "3").out
    Path("out/plane0.png").unlink()
    assert "up to date" not in run("bake", "m.obj", "-o", "out", "--if-stale", *TINY, "--seed", "3").out
    assert Path("out/plane0.png").exists()


def test_a_changed_knob_makes_a_bake_stale(run: Callable[..., Any]) -> None:
    bake = ("bake", "plane", "-o", "out", "--if-stale", *TINY)
    assert "up to date" not in run(*bake).out
    assert "up to date" in run(*bake, "--set", "coat.clumps=60").out
    assert "up to date" not in run(*bake, "--set", "coat.clumps=61").out


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes with names")
def test_files_of_options_are_regular_and_bounded(run: Callable[..., Any], monkeypatch: pytest.MonkeyPatch) -> None:
    run("bake", "plane", "-o", "out", *TINY)
    os.mkfifo("pipe.json")
    Path("large.json").write_bytes(bytes(1_000_001))
    monkeypatch.setenv("FURBAKE_LIMITS", "bytes=1M")
    wrong = {
        "pipe.json": "is no regular file, expected ",
        "large.json": "more than 1000000 bytes to read, expected fewer",
    }
    options = [
        ("-o", "new", option) for option in ("--mask", "--length-map", "--comb", "--guide", "--features", "--rig")
    ]
    # Where a bake is, its key is asked for first, with the hashes of all files.
    for args in (*options, ("-o", "out", "--if-stale", "--mask")):
        for name, why in wrong.items():
            done = run("bake", "plane", *args, name, *TINY, "--quiet")
            assert (done.status, done.err.count("\n")) == (2, 1)
            assert done.err.startswith(f"furbake: error: {name}: {why}")


def test_other_libraries_make_a_bake_stale(run: Callable[..., Any]) -> None:
    bake = ("bake", "plane", "-o", "out", "--if-stale", *TINY)
    run(*bake)
    assert "up to date" in run(*bake).out
    record = json.loads(Path("out/bake.json").read_text())
    record["libraries"]["numpy"] = "1.0"
    Path("out/bake.json").write_text(json.dumps(record))
    assert "up to date" not in run(*bake).out
