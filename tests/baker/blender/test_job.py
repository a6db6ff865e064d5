"""The extension's parts that do without Blender: the command beside it, its arguments, the server."""

from __future__ import annotations

import importlib
import sys
import time
import types
from http.client import HTTPConnection
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any
from urllib.parse import urlsplit

import pytest

from furbake.cli.arguments import BAKE
from furbake.options import preset_names

BLENDER = Path(__file__).parents[3] / "baker" / "blender"


@pytest.fixture(scope="module")
def part() -> Any:
    """Modules of the extension by name, without its face, which needs Blender."""
    package = types.ModuleType("furbake_extension")
    package.__path__ = [str(BLENDER)]
    sys.modules[package.__name__] = package

    def load(name: str) -> ModuleType:
        return importlib.import_module(f"{package.__name__}.{name}")

    return load


def script(*lines: str) -> list[str]:
    return [sys.executable, "-u", "-c", "\n".join(lines)]


def test_progress_notes_and_the_last_line_are_told_apart(part: Any) -> None:
    job = part("job").Job(
        script("print('furbake: 42 % light')", "print('furbake: note: two faces left out')", "print('{}')")
    )
    assert job.result() == "{}"
    assert (job.percent, job.stage, job.notes) == (42, "light", ["two faces left out"])
    assert not job.running


def test_a_failure_is_its_sentence(part: Any) -> None:
    job = part("job").Job(script("print('furbake: error: mesh: 3 faces, need 4')", "raise SystemExit(2)"))
    with pytest.raises(part("job").JobError, match=r"^mesh: 3 faces, need 4$"):
        job.result()
    with pytest.raises(part("job").JobError, match="exit code 3"):
        part("job").Job(script("raise SystemExit(3)")).result()
    with pytest.raises(part("job").JobError, match="expected furbake"):
        part("job").Job(["/nowhere/furbake"])


def test_a_cancelled_command_clears_up(part: Any, tmp_path: Path) -> None:
    job = part("job").Job(
        script(
            "import time",
            "try:",
            "    print('furbake: 1 % light')",
            "    time.sleep(60)",
            "except KeyboardInterrupt:",
            f"    open({str(tmp_path / 'cleared')!r}, 'w').close()",
        )
    )
    while not job.percent:
        time.sleep(0.01)
    job.cancel()
    with pytest.raises(part("job").JobError, match="cancelled"):
        job.result()
    assert (tmp_path / "cleared").exists() or sys.platform == "win32"


def chosen(**changes: Any) -> SimpleNamespace:
    given = {"preset": "fox", "size": "PRESET", "basis": "PRESET", "states": "PRESET", "dirt": False}
    return SimpleNamespace(**given | {"length": 0.0, "follow": -1, "seed": 0, "more": ""} | changes)


def test_choices_are_options_of_a_bake(part: Any) -> None:
    command = part("command")
    body, hairs, out = Path("a.glb"), Path("h.npz"), Path("out")
    always = ["bake", "a.glb", "-o", "out", "--force", "--json", "--percent", "--preset", "fox"]
    assert command.arguments(chosen(length=0.2), body, None, out) == [*always, "--length", "0.2"]
    all_of = chosen(size="128", basis="eigen", states="dry..wet", dirt=True, seed=3, follow=0, more="--layers '24'")
    given = command.arguments(all_of, body, hairs, out)
    assert given == [
        *always, "--size", "128", "--basis", "eigen", "--states", "dry..wet", "--dirt", "--seed", "3",
        "--groom", "h.npz", "--follow", "0", "--layers", "24",
    ]  # fmt: skip
    known = {name for option in BAKE for name in option.opts}
    assert {name for name in given if name.startswith("-")} <= known


def test_paths_of_options_are_made_whole(part: Any) -> None:
    more = "--features //eyes.json --features=//ears.json --seed 3"
    given = part("command").arguments(
        chosen(preset="//my.toml", more=more),
        Path("a.glb"),
        None,
        Path("out"),
        lambda path: path.replace("//", "/home/"),
    )
    assert given[given.index("--preset") + 1] == "/home/my.toml"
    assert given[-5:] == ["--features", "/home/eyes.json", "--features=/home/ears.json", "--seed", "3"]


def test_another_program_is_not_taken_for_furbake(part: Any) -> None:
    said = rf"got Python {sys.version_info.major}\..*, expected the command furbake"
    with pytest.raises(part("job").JobError, match=said):
        part("command").found(sys.executable)
    assert part("command").found(str(Path(sys.executable).with_name("furbake")))


def test_the_panel_offers_the_presets_that_there_are(part: Any) -> None:
    assert sorted(part("command").PRESETS) == sorted(preset_names())


def test_the_server_gives_files_of_its_folders_alone(part: Any, tmp_path: Path) -> None:
    page, model, secret = (tmp_path / name for name in ("page", "model", "secret.json"))
    for folder in (page, model):
        folder.mkdir()
    (page / "index.html").write_text("page", "utf-8")
    (model / "model.gltf").write_text("{}", "utf-8")
    (model / "notes.txt").touch()
    secret.touch()
    server = part("serve").Server(page)
    try:
        address = urlsplit(server.show(model))
        assert address.query == "model=0"
        assert server.show(model) == address.geturl()

        def status(path: str, host: str | None = None) -> int:
            connection = HTTPConnection("127.0.0.1", address.port or 0, timeout=10)
            connection.request("GET", path, headers={} if host is None else {"Host": host})
            found = connection.getresponse()
            found.read()
            connection.close()
            return found.status

        assert [status(path) for path in ("/", "/?model=0", "/0/model.gltf")] == [200, 200, 200]
        hidden = (
            "/0/../secret.json",
            "/0/%2e%2e/secret.json",
            "/../secret.json",
            "/0/notes.txt",
            "/1/model.gltf",
            "/0/",
        )
        assert {status(path) for path in hidden} == {404}
        assert status("/0/model.gltf", "evil.example:80") == 404
    finally:
        server.close()
