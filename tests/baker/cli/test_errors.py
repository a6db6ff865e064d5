from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from helpers.command import CUBE, TINY, files, listed


def test_states_that_there_are_not(run: Callable[..., Any]) -> None:
    done = run("bake", "plane", "-o", "out", *TINY, "--states", "dry..ice")
    assert (done.status, listed()) == (2, [])
    assert done.err == (
        "furbake: error: states: got dry..ice, expected dry..wet, or dry and then some of damp, moist, wet, soaked\n"
    )


FOREIGN = [
    ("inspect", "folder"), ("report", "folder"), ("groom", "folder", "-o", "x.npz"), ("verify", "folder"),
    ("swatch", "folder", "-o", "x.png"), ("export", "folder", "--ptm", "x.ptm"), ("export", "folder", "--glb", "x.glb"),
]  # fmt: skip

BAD_COMMANDS = {
    **dict.fromkeys(FOREIGN, "folder: holds no model.gltf, expected a folder that furbake wrote"),
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
    ("bake", "plane", "-o", "folder", "--force"): "folder: holds thing, not written by furbake, expected",
    ("bake", "plane", "-o", "out", "--length", "nan"): "length: got nan, expected a length above 0",
    ("bake", "plane", "-o", "out", "--size", "48"): "size: got 48, expected a power of two",
    ("bake", "plane", "-o", "out", "--size", "big"): "size: got 'big', expected a whole number",
    ("bake", "plane", "-o", "out", "--tile", "wide"): "tile: got 'wide', expected a number",
    ("bake", "plane", "-o", "out", "--layers"): "layers: got nothing, expected a value",
    ("bake", "plane", "-o", "out", "--basis", "fft"): "basis: got 'fft', expected ptm or eigen",
    ("bake", "plane", "-o", "out", "--coefficients", "4"): "coefficients: got 4, expected 6 for the basis ptm",
    ("bake", "plane", "-o", "out", "--guide", "comb.json"): "comb.json: no such file or directory, expected {",
    ("bake", "plane", "-o", "out", "--guide", "aside"): "guide: got 'aside', expected nose-tail, down or a .json",
    ("bake", "plane", "-o", "out", "--comb", "text.obj"): "text.obj: not JSON (Expecting value: ",
    ("bake", "plane", "-o", "out", "--comb", "empty.obj"): "empty.obj: not JSON (Expecting value: ",
    ("bake", "plane", "-o", "out", "--mask", "text.obj"): "text.obj: cannot be read as a picture, expected PNG, JPEG",
    ("bake", "plane", "-o", "out", "--length-map", "broken.png"): "broken.png: cannot be read as a picture, expected",
    ("bake", "plane", "-o", "out", "--cache", "text.obj"): "text.obj: is a file, expected a folder",
    ("bake", "plane", "-o", "out", "--cache", "text.obj/a"): "text.obj/a: not a directory, expected a folder",
    ("bake", "nope.obj", "-o", "out", "--cache", "new/pelts"): "nope.obj: no such file, expected a mesh file",
    ("bake", "plane", "-o", "out", "--uv", "round"): "uv: got 'round', expected lapped or own",
    ("bake", "plane", "-o", "out", "--max-faces", "2"): "max-faces: got 2, expected 4 to 2000000",
    ("bake", "plane", "-o", "out", "--pose", "Walk"): "pose: got 'Walk', expected CLIP@SECONDS with seconds from 0",
    ("bake", "plane", "-o", "out", "--pose", "Walk@-1"): "pose: got 'Walk@-1', expected CLIP@SECONDS",
    ("bake", "plane", "-o", "out", "--pose", "Walk@soon"): "pose: got 'Walk@soon', expected CLIP@SECONDS",
    ("bake", "plane", "-o", "out", "--pose", "@1"): "pose: got '@1', expected CLIP@SECONDS",
    ("bake", "plane", "-o", "out", "--pose", "Walk@1"): "plane: has no clips, expected a file with the clip Walk of",
    ("bake", "good.obj", "-o", "out", "--pose", "0@1"): "good.obj: has no clips, expected the clip 0 of the pose",
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
    (
        "bake",
        "plane",
        "-o",
        "out",
        "--lay",
        "8",
    ): "--lay: unknown, expected --layers, or others of 'furbake",
    ("bake", "plane", "-o", "out", "two", "three"): "two three: unknown, expected arguments of 'furbake bake --help'",
    ("bake", "plane", "-o", "out", "--force=3"): "force: got a value, expected none",
    ("bake", "-x.obj", "-o", "out"): "-x.obj: taken for an option, expected ./-x.obj for the file of that name",
    ("bake", "-y.obj", "-o", "out"): "-y.obj: unknown, expected arguments of 'furbake bake --help'",
    ("bake", "plane", "-o", "o\udce9"): "out: got 'o\\udce9', expected a path in UTF-8",
    (
        "bake",
        "plane",
        "-o",
        "out",
        "--length",
        "5e-324",
    ): "length: got 4.94066e-324, expected a length above 0",
    ("bake", "plane", "-o", "out", "--tile", "1e308"): "tile: got 1e+308, expected a length above 0 (1e-30 to 1e+30)",
    ("--lay",): "--lay: unknown, expected arguments of 'furbake --help'",
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
    ("bake", "plane"): "-o: missing, expected furbake bake [MODEL] -o DIR",
    ("bake",): "-o: missing, expected furbake bake [MODEL] -o DIR",
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
    ("swatch", "folder"): "-o: missing, expected furbake swatch DIR|FILE -o FILE.png",
    ("swatch", "folder", "-o", "x.ptm"): "out: got x.ptm, expected a name that ends in .png",
    ("swatch", "-o", "nn"): "out: got nn, expected a name that ends in .png",
    ("swatch", "nope", "-o", "x.png"): "nope: no such folder, expected a folder that furbake wrote",
    ("swatch", "folder", "-o", "x.png", "--preset", "fox"): "swatch: got 'folder' and --preset or --set, expected",
    ("swatch", "--preset", "cat", "-o", "x.png"): "preset: got 'cat', expected one of",
    ("swatch", "nope", "-o", "x.png", "--light", "1,2"): "light: got '1,2', expected three numbers X,Y,Z",
    ("report", "nope"): "nope: no such folder, expected a folder that furbake wrote",
    ("groom", "nope", "-o", "x.foo"): "out: got x.foo, expected a name that ends in .npz or .usdc or .usda or .usd",
    ("verify", "nope", "-o", "x.gif"): "out: got x.gif, expected a name that ends in .png",
    ("verify", "nope", "-o", "no/x.png"): "out: got no/x.png, expected a file in a folder that exists",
    ("verify", "nope", "--body", "--truth", "no/x.npz"): "truth: got no/x.npz, expected a file in a folder that exists",
    ("verify", "nope"): "nope: no such folder, expected a folder that furbake wrote",
    (
        "verify",
        "nope",
        "--eyes",
        "-o",
        "x.png",
    ): "verify: got --eyes and -o, expected --eyes alone",
    ("verify", "nope", "--body", "--eyes"): "verify: got --eyes and --body, expected --eyes alone",
    ("compare", "cat"): "preset: got 'cat', expected one of",
    ("compare", "paper", "--lights", "3"): "lights: got 3, expected 8 to 1024",
    ("compare", "paper", "--size", "60"): "size: got 60, expected a power of two",
    ("bend", "cat"): "preset: got 'cat', expected one of",
    ("bend", "paper", "--tips", "0.9"): "tips: got 0.9, expected 0 to 0.8",
    ("bend", "paper", "--azimuths", "0"): "azimuths: got 0, expected 1 to 64",
    ("bend", "paper", "--size", "60"): "size: got 60, expected a power of two",
    ("patches", "nope.obj"): "nope.obj: no such file, expected a mesh file or",
    ("patches", "torus:8x8", "--faces", "3"): "faces: got 3, expected 4 to 2000000",
    ("patches", "torus:8x8", "--faces", "0"): "faces: got 0, expected 4 to 2000000",
    ("patches", "torus:8x8", "--faces", "-5"): "faces: got -5, expected 4 to 2000000",
    ("inspect", "nope"): "nope: no such folder, expected a folder that furbake wrote",
    ("validate", "nope"): "nope: no such folder, expected a folder that furbake wrote",
    ("fry",): "command: got 'fry', expected bake, batch, inspect, validate, presets, report, swatch, lesson, verify, ",
    (): "COMMAND: missing, expected furbake bake, batch, inspect, validate, presets, report, swatch, lesson, verify, ",
}


@pytest.mark.parametrize("command", BAD_COMMANDS, ids=lambda command: ascii("_".join(command)))
def test_bad_input_is_one_line(run: Callable[..., Any], here: Path, command: tuple[str, ...]) -> None:
    Path("folder/thing").mkdir(parents=True)
    Path("old").mkdir()
    Path("old/bake.json").write_text("old")
    Path("empty.obj").touch()
    Path("broken.png").write_bytes(b"\x89PNG\r\n\x1a\nrest")
    Path("bad.toml").write_text("[coat.guard]\ncout = 3\n")
    Path("huge.toml").write_text("coat.guard.count = 20000\ncoat.under.count = 20000\n")
    Path("good.obj").write_text(CUBE)
    Path("-x.obj").write_text(CUBE)
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
