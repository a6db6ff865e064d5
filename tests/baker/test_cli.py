"""The command, as scripts see it: exit status, the one line, and what is on disk afterwards."""

from __future__ import annotations

import json
import re
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import furbake
from furbake import BakeOptions, bake, cli
from furbake.cli import actions

TINY = ("--layers", "4", "--size", "8", "--lights", "8")
CUBE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"


def files(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def listed() -> list[str]:
    return sorted(path.name for path in Path().iterdir())


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_public_names() -> None:
    assert sorted(furbake.__all__) == [
        "BakeOptions", "BakeResult", "MeshError", "OptionError", "StoreError", "bake", "preset", "preset_names",
        "validate",
    ]  # fmt: skip
    assert all(hasattr(furbake, name) for name in furbake.__all__)


def test_bake_inspect_validate(run: Callable[..., Any]) -> None:
    done = run("bake", "torus:8x12", "-o", "out", *TINY)
    assert done.status == 0
    assert re.fullmatch(r"out: torus:8x12 in 4 layers of 8 x 8, [\d.]+ dB, [\d.]+ MB, [\d.]+ s\n", done.out)
    stages = re.findall(r"furbake: (\w+) [\d.]+ s\n", done.err)
    assert stages == ["mesh", "strands", "volume", "light", "fit", "fins", "write"]
    images = {"plane0.png", "plane1.png", "colour.png", "fin0.png", "fin1.png", "fin-colour.png"}
    assert set(files(Path("out"))) == {"model.gltf", "model.bin", "bake.json", *images}
    checked = run("validate", "out")
    assert (checked.status, checked.out, checked.err) == (0, "out: valid\n", "")
    told = run("inspect", "out")
    assert "layers:                   4" in told.out
    assert json.loads(run("inspect", "out", "--json").out)["fur"]["layers"] == 4


def test_json_is_all_there_is_on_standard_output(run: Callable[..., Any]) -> None:
    done = run("bake", "plane", "-o", "out", *TINY, "--json")
    told = json.loads(done.out)
    assert told["baked"] is True
    assert set(told["seconds"]) == {"mesh", "strands", "volume", "light", "fit", "fins", "write"}
    record = json.loads(Path("out/bake.json").read_text())
    assert {key: told[key] for key in record} == record
    assert "seconds" not in record


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


def test_states_that_there_are_not(run: Callable[..., Any]) -> None:
    done = run("bake", "plane", "-o", "out", *TINY, "--states", "dry..ice")
    assert (done.status, listed()) == (2, [])
    assert done.err == (
        "furbake: error: states: got dry..ice, expected dry..wet, or dry and then some of damp, moist, wet, soaked\n"
    )


BAD_COMMANDS = {
    # Acceptance 9.
    (
        "bake",
        "nope.obj",
        "-o",
        "out",
    ): "nope.obj: no such file, expected a mesh file or sphere, plane, plane:RxC, torus, torus:RxC",
    ("bake", "folder", "-o", "out"): "folder: is a folder, expected a mesh file",
    ("bake", "empty.obj", "-o", "out"): "empty.obj: 0 bytes, expected a mesh file",
    ("bake", "text.obj", "-o", "out"): "text.obj: no faces, expected a surface of triangles",
    ("bake", "points.obj", "-o", "out"): "points.obj: no faces, expected a surface of triangles",
    ("bake", "nan.obj", "-o", "out"): "nan.obj: 1 of 4 vertices are not finite, expected numbers (no NaN, no infinity)",
    ("bake", "zero.obj", "-o", "out"): "zero.obj: all faces have zero area, expected a surface",
    ("bake", "plane", "-o", "out", "--size", "0"): "size: got 0, expected 8 to 512",
    ("bake", "plane", "-o", "out", "--lights", "3"): "lights: got 3, expected 8 to 1024",
    ("bake", "plane", "-o", "out", "--length", "-1"): "length: got -1, expected a length above 0",
    ("bake", "plane", "-o", "old"): "old: exists already, expected a new folder (or --force to replace it)",
    ("bake", "plane", "-o", "/proc/nowhere/out"): "/proc/nowhere/out: no such file or directory, expected a folder",
    # And their relatives.
    ("bake", "plane", "-o", "text.obj"): "text.obj: is a file, expected a new folder",
    ("bake", "plane", "-o", "folder", "--force"): "folder: holds the folder thing and is no bake, expected a",
    ("bake", "plane", "-o", "out", "--length", "nan"): "length: got nan, expected a length above 0",
    ("bake", "plane", "-o", "out", "--size", "48"): "size: got 48, expected a power of two",
    ("bake", "plane", "-o", "out", "--size", "big"): "size: got 'big', expected a whole number",
    ("bake", "plane", "-o", "out", "--tile", "wide"): "tile: got 'wide', expected a number",
    ("bake", "plane", "-o", "out", "--layers"): "layers: got nothing, expected a value",
    ("bake", "plane", "-o", "out", "--basis", "fft"): "basis: got 'fft', expected ptm or eigen",
    ("bake", "plane", "-o", "out", "--coefficients", "4"): "coefficients: got 4, expected 6 for the basis ptm",
    ("bake", "plane", "-o", "out", "--guide", "comb.json"): "comb.json: no such file or directory, expected {",
    ("bake", "plane", "-o", "out", "--guide", "aside"): "guide: got 'aside', expected nose-tail, down or a .json",
    ("bake", "plane", "-o", "out", "--comb", "text.obj"): "text.obj: JSONDecodeError: ",
    ("bake", "plane", "-o", "out", "--uv", "round"): "uv: got 'round', expected lapped or own",
    ("bake", "plane", "-o", "out", "--max-faces", "2"): "max-faces: got 2, expected 4 to 2000000",
    ("bake", "plane", "-o", "out", "--mask", "none.png"): "none.png: ",
    (
        "bake",
        "plane",
        "-o",
        "out",
        "--mask",
        "vertex:red",
    ): "vertex:red: got 'red', expected a model with",
    ("bake", "plane", "-o", "out", "--guide", "a.json", "--comb", "b.json"): "comb: got b.json beside the strokes of",
    ("bake", "good.obj", "-o", "out", "--uv", "own"): "good.obj: the model has no texture coordinates, expected",
    ("bake", "plane", "-o", "out", "--preset", "nope"): "preset: got 'nope', expected one of ",
    ("bake", "plane", "-o", "out", "--lay", "8"): "--lay 8: unknown, expected arguments of",
    (
        "bake",
        "plane",
        "-o",
        "out",
        "--length",
        "1",
        "--tile",
        "1",
        "--height",
        "1",
    ): "length: got length, tile and height",
    ("bake", "torus:2x3", "-o", "out"): "torus:2x3: 2 rows and 3 columns, expected 3 to 1024 of each",
    ("bake", "plane", "-o", "out", "--samples", "folder"): "folder: is a folder, expected a file to write",
    ("bake", "plane"): "-o: missing, expected furbake bake MODEL -o DIR",
    ("bake",): "MODEL, -o: missing, expected furbake bake MODEL -o DIR",
    ("bake", "", "-o", "out"): "MODEL: got '', expected a path",
    ("bake", "a\0b", "-o", "out"): "MODEL: got 'a\\x00b', expected a path",
    (
        "bake",
        "plane",
        "-o",
        "out",
        "--preset",
        "no.toml",
    ): "preset: got 'no.toml' (no such file or directory), expected",
    ("bake", "plane", "-o", "out", "--preset", "bad.toml"): "bad.toml: got 'coat.guard.cout', expected a knob such as "
    "coat.guard.count",
    ("bake", "plane", "-o", "out", "--set", "layers"): "set: got 'layers', expected KNOB=VALUE such as",
    ("bake", "plane", "-o", "out", "--set", "=3"): "set: got '=3', expected KNOB=VALUE such as",
    ("bake", "plane", "-o", "out", "--set", "coat.gard.count=3"): "set: got 'coat.gard.count', expected a knob such as "
    "coat.guard.count",
    ("bake", "plane", "-o", "out", "--set", "coat.bend=x"): "set: coat.bend: got 'x', expected a number, 1 to 4",
    ("bake", "plane", "-o", "out", "--set", "coat.bend=9"): "set: coat.bend: got 9, expected 1 to 4",
    ("bake", "plane", "-o", "out", "--preset", "huge.toml"): "coat.guard.count + coat.under.count: got 40000, expected",
    (
        "presets",
        "cat",
    ): "preset: got 'cat', expected one of bunny, fox, mole, paper, sheep, teddy, wolf, or a .toml file",
    ("swatch", "folder"): "-o: missing, expected furbake swatch DIR -o FILE.png",
    ("swatch", "nope", "-o", "x.png"): "nope: no such folder, expected a folder that furbake wrote",
    ("swatch", "folder", "-o", "x.png", "--preset", "fox"): "swatch: got 'folder' and --preset or --set, expected",
    ("swatch", "--preset", "cat", "-o", "x.png"): "preset: got 'cat', expected one of",
    ("swatch", "nope", "-o", "x.png", "--light", "1,2"): "light: got '1,2', expected three numbers X,Y,Z",
    ("report", "nope"): "nope: no such folder, expected a folder that furbake wrote",
    ("verify", "nope"): "nope: no such folder, expected a folder that furbake wrote",
    ("compare", "cat"): "preset: got 'cat', expected one of",
    ("compare", "paper", "--lights", "3"): "lights: got 3, expected 8 to 1024",
    ("compare", "paper", "--size", "60"): "size: got 60, expected a power of two",
    ("bend", "cat"): "preset: got 'cat', expected one of",
    ("bend", "paper", "--tips", "0.9"): "tips: got 0.9, expected 0 to 0.8",
    ("bend", "paper", "--azimuths", "0"): "azimuths: got 0, expected 1 to 64",
    ("bend", "paper", "--size", "60"): "size: got 60, expected a power of two",
    ("inspect", "nope"): "nope: no such folder, expected a folder that furbake wrote",
    ("inspect", "folder"): "model.gltf: no such file or directory, expected JSON",
    ("validate", "nope"): "nope: no such folder, expected a folder that furbake wrote",
    (
        "fry",
    ): "command: got 'fry', expected bake, inspect, validate, presets, report, swatch, lesson, verify, compare, states",
    (): "COMMAND: missing, expected furbake bake, inspect, validate, presets, report, swatch, lesson, verify, ",
}


@pytest.mark.parametrize("command", BAD_COMMANDS, ids=lambda command: "_".join(command).replace("\0", "0") or "nothing")
def test_bad_input_is_one_line(run: Callable[..., Any], here: Path, command: tuple[str, ...]) -> None:
    Path("folder/thing").mkdir(parents=True)
    Path("old").mkdir()
    Path("old/bake.json").write_text("old")
    Path("empty.obj").touch()
    Path("bad.toml").write_text("[coat.guard]\ncout = 3\n")
    Path("huge.toml").write_text("coat.guard.count = 20000\ncoat.under.count = 20000\n")
    Path("good.obj").write_text(CUBE)
    Path("text.obj").write_text("Dear diary,\nno triangles today.\n")
    Path("points.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\n")
    Path("nan.obj").write_text(CUBE.replace("v 1", "v nan"))
    Path("zero.obj").write_text("v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\n")
    before = sorted(str(path) for path in here.rglob("*"))
    args = ["bake", *TINY, *command[1:]] if command[0:1] == ("bake",) and "-o" in command else command
    done = run(*args)
    assert (done.status, done.out) == (2, "")
    lines = done.err.splitlines()
    if "--samples" not in command:  # that file is only written at the end
        assert len(lines) == 1
    assert lines[-1].startswith(f"furbake: error: {BAD_COMMANDS[command]}")
    assert sorted(str(path) for path in here.rglob("*")) == before
    assert Path("old/bake.json").read_text() == "old"


def test_undecodable_draco(run: Callable[..., Any], here: Path) -> None:
    """Acceptance 9, through a process of its own: nothing else may reach the terminal."""
    text = json.dumps(
        {
            "asset": {"version": "2.0"},
            "scenes": [{"nodes": [0]}],
            "nodes": [{"mesh": 0}],
            "meshes": [
                {
                    "primitives": [
                        {
                            "attributes": {"POSITION": 1},
                            "indices": 0,
                            "extensions": {
                                "KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}
                            },
                        }
                    ]
                }
            ],
            "accessors": [
                {"componentType": 5123, "count": 6, "type": "SCALAR"},
                {"componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 1]},
            ],
            "bufferViews": [{"buffer": 0, "byteLength": 12}],
            "buffers": [{"byteLength": 12, "uri": "data:application/octet-stream;base64,RFJBQ08BAgMEBQYH"}],
            "extensionsUsed": ["KHR_draco_mesh_compression"],
            "extensionsRequired": ["KHR_draco_mesh_compression"],
        }
    )
    Path("bad.gltf").write_text(text)
    command = [sys.executable, "-m", "furbake.cli", "bake", "bad.gltf", "-o", "out"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == (
        "furbake: error: bad.gltf: geometry that cannot be decoded (KHR_draco_mesh_compression), "
        "expected intact Draco or plain data\n"
    )
    assert listed() == ["bad.gltf"]


def test_failed_bake_keeps_the_old_folder(run: Callable[..., Any]) -> None:
    assert run("bake", "plane", "-o", "out", *TINY).status == 0
    before = files(Path("out"))
    assert run("bake", "plane", "-o", "out", *TINY).status == 2
    assert run("bake", "nope.obj", "-o", "out", "--force", *TINY).status == 2
    assert files(Path("out")) == before
    assert run("bake", "plane", "-o", "out", "--force", *TINY, "--seed", "1").status == 0
    assert files(Path("out")) != before
    assert listed() == ["out"]


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


def test_validate_lists_what_is_wrong(run: Callable[..., Any]) -> None:
    run("bake", "plane", "-o", "out", *TINY)
    Path("out/plane0.png").unlink()
    Path("out/bake.json").unlink()
    done = run("validate", "out")
    assert done.status == 1
    assert len(done.out.splitlines()) == 2
    assert done.err == ""


def test_presets_and_version(run: Callable[..., Any], capsys: pytest.CaptureFixture[str]) -> None:
    told = run("presets")
    assert told.status == 0
    assert any(line.startswith("paper ") for line in told.out.splitlines())
    assert json.loads(run("presets", "--json").out)["paper"]["layers"] == 16
    with pytest.raises(SystemExit) as stop:
        cli.main(["--version"])
    assert stop.value.code == 0
    assert re.fullmatch(r"furbake \d+\.\d+\.\d+\n", capsys.readouterr().out)


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


def test_a_changed_knob_makes_a_bake_stale(run: Callable[..., Any]) -> None:
    bake = ("bake", "plane", "-o", "out", "--if-stale", *TINY)
    assert "up to date" not in run(*bake).out
    assert "up to date" in run(*bake, "--set", "coat.clumps=60").out
    assert "up to date" not in run(*bake, "--set", "coat.clumps=61").out


def test_swatch_of_a_folder_and_of_a_preset(run: Callable[..., Any]) -> None:
    run("bake", "plane", "-o", "out", *TINY)
    done = run("swatch", "out", "-o", "a.png", "--light", "-1,0,1", "--tiles", "2", "--pixels", "32")
    assert (done.status, done.out, done.err) == (0, "a.png\n", "")
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
    assert run("report", "out", "--quiet").status == 0
    assert Path("out/report.html").read_text().count(' fur">') >= 3


def test_report(run: Callable[..., Any]) -> None:
    run("bake", "plane", "-o", "out", *TINY)
    done = run("report", "out")
    assert (done.status, done.out) == (0, "out/report.html\n")
    assert "furbake: strands" in done.err
    assert Path("out/report.html").exists()


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


def test_interrupt(run: Callable[..., Any], monkeypatch: pytest.MonkeyPatch) -> None:
    def stop(*args: Any, **kwargs: Any) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(actions, "bake", stop)
    done = run("bake", "plane", "-o", "out")
    assert (done.status, done.out, done.err) == (130, "", "furbake: interrupted, nothing written\n")


def test_bar_on_a_terminal(run: Callable[..., Any], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TTY_COMPATIBLE", "1")
    monkeypatch.setenv("FORCE_COLOR", "1")
    done = run("bake", "plane", "-o", "out", *TINY)
    assert done.status == 0
    assert "%" in done.err
    assert "\x1b[" in done.err
    assert "furbake: mesh" not in done.err


def test_sigkill_leaves_no_folder(here: Path) -> None:
    """Acceptance 9: a bake killed half-way leaves no DIR, and the next one clears up behind it."""
    command = [sys.executable, "-m", "furbake.cli", "bake", "sphere", "-o", "out", "--quiet"]
    with subprocess.Popen([*command, "--layers", "64", "--size", "128", "--lights", "512"]) as process:
        limit = time.monotonic() + 60
        while not [name for name in listed() if name.startswith(".out.")]:
            assert process.poll() is None
            assert time.monotonic() < limit
            time.sleep(0.01)
        process.send_signal(signal.SIGKILL)
    assert not Path("out").exists()
    assert len(listed()) == 1
    assert subprocess.run([*command, *TINY], check=False).returncode == 0
    assert listed() == ["out"]
