from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

from helpers.characters import bent_tube
from helpers.command import TINY, listed


def test_validate_lists_what_is_wrong(run: Callable[..., Any]) -> None:
    run("bake", "plane", "-o", "out", *TINY)
    Path("out/plane0.png").unlink()
    Path("out/bake.json").unlink()
    done = run("validate", "out")
    assert done.status == 1
    assert len(done.out.splitlines()) == 2
    assert done.err == ""


def test_presets_and_version(run: Callable[..., Any]) -> None:
    told = run("presets")
    assert told.status == 0
    assert any(line.startswith("paper ") for line in told.out.splitlines())
    assert json.loads(run("presets", "--json").out)["paper"]["layers"] == 16
    version = run("--version")
    assert version.status == 0
    assert re.fullmatch(r"furbake \d+\.\d+\.\d+\n", version.out)


def test_a_preset_can_be_printed_copied_and_changed(run: Callable[..., Any]) -> None:
    told = run("presets", "fox")
    assert told.out.startswith("# A red fox: ")
    Path("mine.toml").write_text(told.out)
    copied, fox = (json.loads(run("presets", name, "--json").out) for name in ("mine.toml", "fox"))
    assert copied == fox | {"preset": "mine"}
    Path("mine.toml").write_text('extends = "fox"\ncoat.guard.count = 20\n')
    changes = ("--set", "coat.under.count=30", "--set", "coat.lean=0.1,0.2", "--set", "seed=4", "--seed", "5")
    assert run("bake", "plane", "-o", "out", "--preset", "mine.toml", *changes, *TINY).status == 0
    options = json.loads(Path("out/bake.json").read_text())["options"]
    assert (options["preset"], options["seed"], options["layers"]) == ("mine", 5, 4)
    assert (options["coat"]["guard"]["count"], options["coat"]["under"]["count"]) == (20, 30)
    assert options["coat"]["lean"] == [0.1, 0.2]
    assert options["ramp"] == fox["ramp"]


def test_swatch_of_a_folder_and_of_a_preset(run: Callable[..., Any]) -> None:
    run("bake", "plane", "-o", "out", *TINY)
    done = run("swatch", "out", "-o", "a.png", "--light", "-1,0,1", "--tiles", "2", "--pixels", "32")
    assert (done.status, done.out, done.err) == (0, "a.png\n", "")
    told = run("swatch", "out", "-o", "a.png", "--pixels", "32", "--json")
    assert json.loads(told.out) == {"file": "a.png", "width": 32, "height": 32}
    small = [f"--set={knob}" for knob in ("layers=4", "size=8", "lights=8")]
    assert run("swatch", "-o", "b.png", *small, "--pixels", "32", "--quiet").status == 0
    assert listed() == ["a.png", "b.png", "out"]
    assert all(Path(name).read_bytes().startswith(b"\x89PNG") for name in ("a.png", "b.png"))


def test_swatch_of_a_state(run: Callable[..., Any]) -> None:
    run("bake", "plane", "-o", "out", *TINY, "--states", "dry,soaked", "--dirt", "--no-fins")
    for state in ("dry", "soaked", "dirty"):
        assert run("swatch", "out", "-o", f"{state}.png", "--state", state, "--pixels", "32").status == 0
    assert len({Path(f"{state}.png").read_bytes() for state in ("dry", "soaked", "dirty")}) == 3
    done = run("swatch", "out", "-o", "x.png", "--state", "damp")
    assert done.err == "furbake: error: state: got 'damp', expected one of dry, soaked, dirty\n"
    small = [f"--set={knob}" for knob in ("layers=4", "size=8", "lights=8")]
    assert run("swatch", "-o", "b.png", *small, "--pixels", "32", "--state", "dirty", "--quiet").status == 0
    assert run("swatch", "-o", "c.png", *small, "--state", "frozen").status == 2
    assert not Path("c.png").exists()
    assert run("report", "out", "--no-model", "--quiet").status == 0
    assert Path("out/report.html").read_text().count(' fur">') >= 3


def test_a_swatch_that_cannot_be_written(run: Callable[..., Any]) -> None:
    run("bake", "plane", "-o", "out", *TINY)
    Path("dd.png").mkdir()
    for out, wrong in (
        ("dd.png", "dd.png: is a directory, expected a new picture"),
        ("no/a.png", "out: got no/a.png, expected a file in a folder that exists"),
    ):
        done = run("swatch", "out", "-o", out, "--pixels", "32")
        assert (done.status, done.err) == (2, f"furbake: error: {wrong}\n")
    assert listed() == ["dd.png", "out"]


def test_a_groom_of_a_body_with_joints_is_told(run: Callable[..., Any]) -> None:
    model = bent_tube().write(Path())
    assert run("bake", model, "-o", "out", *TINY, "--no-fins", "--quiet").status == 0
    done = run("groom", "out", "-o", "a.npz")
    assert done.err.splitlines()[-1] == (
        "furbake: note: joints move the body: strands stand on it in its rest pose and follow none of them"
    )


def test_report(run: Callable[..., Any]) -> None:
    run("bake", "plane", "-o", "out", *TINY)
    done = run("report", "out", "--no-model")
    assert (done.status, done.out) == (0, "out/report.html\n")
    assert "furbake: strands" in done.err
    assert Path("out/report.html").exists()
