"""Lists of models: what they may say, and one sentence where they say something else."""

from __future__ import annotations

import json
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from helpers.batches import SETTINGS
from helpers.command import CUBE

BAD = {
    "files = 'a.obj'": "list.toml: got no list of models, expected [[model]]",
    "": "list.toml: got no list of models, expected [[model]] and then file = '...' for each",
    "model = 3": "list.toml: got no list of models, expected [[model]]",
    "[[model]": "list.toml: got no valid TOML (",
    "name = 'a'\n[[model]]\nfile = 'plane'": "list.toml: name: got it for all models, expected it below a [[model]]",
    "[[model]]\nname = 'a'": "list.toml: model 1: file: got none, expected a path, a glob or a list of them",
    "[[model]]\nfile = 'none/*.obj'": "list.toml: model 1: no model, expected files that end in glb, gltf, obj",
    "[[model]]\nfile = 'a.obj'\nlenght = 2": "list.toml: model 1: lenght: unknown, expected one of name, file, preset",
    "[[model]]\nfile = 'a.obj'\nsize = 12.5": "list.toml: model 1: size: got '12.5', expected a whole number",
    "[[model]]\nfile = 'a.obj'\nsize = true": "list.toml: model 1: size: got true, expected a number or text",
    "[[model]]\nfile = 'a.obj'\nsize = 12": "list.toml: model 1: size: got 12, expected a power of two",
    "[[model]]\nfile = 'a.obj'\nfins = 'no'": "list.toml: model 1: fins: got 'no', expected true or false",
    "[[model]]\nfile = 'a.obj'\npreset = 'cat'": "list.toml: model 1: preset: got 'cat', expected one of bunny,",
    "[[model]]\nfile = 'a.obj'\nset = { coat = 3 }": "list.toml: model 1: set: got 'coat', expected a knob such as",
    "[[model]]\nfile = 'a.obj'\nset = 3": "list.toml: model 1: set: got 3, expected a table such as",
    "[[model]]\nfile = '*.obj'\nname = 'x'": "list.toml: model 1: name: got 'x' for 2 models, expected one",
    "[[model]]\nfile = 'a.obj'\nname = '../x'": "name: got '../x' of a.obj, expected one that a folder can have",
    '[[model]]\nfile = "a.obj"\nname = "a\\u0001"': "name: got 'a\\x01' of a.obj, expected one that a folder can",
    "[[model]]\nfile = 'a.obj'\nname = 'index.html'": "name: got 'index.html' of a.obj, expected one that",
    "[[model]]\nfile = 'a.obj'\n[[model]]\nfile = 'b.obj'\nname = 'A'": "A: named so by a.obj and by b.obj, expected",
}


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    for name in ("a.obj", "b.obj"):
        Path(name).write_text(CUBE)
    return tmp_path


@pytest.mark.parametrize("text", BAD)
def test_a_bad_list_gets_a_sentence(run: Callable[..., Any], text: str) -> None:
    Path("list.toml").write_text(text)
    done = run("batch", "list.toml", "-o", "out")
    assert done.status == 2
    assert done.err.startswith(f"furbake: error: {BAD[text]}")
    assert done.err.count("\n") == 1
    assert not Path("out").exists()


ARGUMENTS = {
    ("nope.toml", "-o", "out"): "nope.toml: no such file or directory, expected a list of models",
    ("empty", "-o", "out"): "empty: no model, expected files that end in glb, gltf, obj",
    ("x*.obj", "-o", "out"): "x*.obj: no model, expected files that end in glb",
    ("a.obj", "-o", "out", "--jobs", "0"): "jobs: got 0, expected 1 or more",
    ("a.obj", "-o", "out", "--memory", "much"): "memory: got 'much', expected a number of bytes such as 8G or 500M",
    ("a.obj", "-o", "out", "--send"): "send: got no --scheduler, expected one to send to",
    ("a.obj", "-o", "out", "--preset", "cat"): "preset: got 'cat', expected one of bunny",
    ("a.obj", "-o", "b.obj"): "b.obj: is a file, expected a folder for the bakes",
    ("a.obj", "-o", "site"): "site/index.html: not written by furbake batch, expected a folder without it",
    ("a.obj", "-o", "out", "--scheduler", "there"): "scheduler: got 'there', expected local or an address such as",
}


@pytest.mark.parametrize("arguments", ARGUMENTS)
def test_bad_arguments_get_a_sentence(run: Callable[..., Any], arguments: tuple[str, ...]) -> None:
    Path("empty").mkdir()
    Path("site").mkdir()
    Path("site/index.html").write_text("mine")
    done = run("batch", *arguments)
    assert done.status == 2
    assert done.err.startswith(f"furbake: error: {ARGUMENTS[arguments]}")
    assert not Path("out").exists()
    assert [path.name for path in Path("site").iterdir()] == ["index.html"]


def test_a_folder_holds_all_that_a_bake_reads(run: Callable[..., Any]) -> None:
    Path("models").mkdir()
    with zipfile.ZipFile("models/packed.zip", "w") as packed:
        packed.write("a.obj")
    Path("models/stage.usda").write_text("#usda 1.0\n")
    Path("models/notes.txt").touch()
    done = run("batch", "models", "-o", "out", *SETTINGS, "--json", "--no-cache", "--jobs", "1")
    *rows, _ = map(json.loads, done.out.splitlines())
    assert {row["name"]: row["status"] for row in rows} == {"packed": "baked", "stage": "failed"}


def test_each_model_has_its_own_options(run: Callable[..., Any]) -> None:
    Path("list.toml").write_text(
        "seed = 3\n[[model]]\nfile = '*'\n"
        "[[model]]\nfile = 'torus:4x4'\nname = 'ring'\nlength = 0.25\nno-fins = true\nset = { coat.clumps = 7 }\n"
    )
    done = run("batch", "list.toml", "-o", "out", *SETTINGS, "--json", "--no-cache", "--jobs", "1")
    assert done.status == 0, done.err
    *rows, summary = map(json.loads, done.out.splitlines())
    assert sorted(row["name"] for row in rows) == ["a", "b", "ring"]
    assert (summary["baked"], summary["failed"]) == (3, 0)
    options = {name: json.loads(Path(f"out/{name}/bake.json").read_text())["options"] for name in ("a", "ring")}
    assert [options["a"][name] for name in ("seed", "length", "fins", "auto_length")] == [3, None, True, True]
    assert [options["ring"][name] for name in ("seed", "length", "fins")] == [3, 0.25, False]
    assert (options["ring"]["coat"]["clumps"], options["a"]["coat"]["guard"]["count"]) == (7, 12)
    again = run("batch", "list.toml", "-o", "out", *SETTINGS, "--json", "--no-cache")
    assert json.loads(again.out.splitlines()[-1])["fresh"] == 3
