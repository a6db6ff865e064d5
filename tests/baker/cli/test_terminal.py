from __future__ import annotations

import errno
import json
import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from furbake import cli
from furbake.cli import baking
from helpers.command import TINY, listed


@pytest.fixture(scope="module")
def bake(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("terminal") / "out"
    assert cli.main(["bake", "plane", "-o", str(folder), *TINY, "--quiet"]) == 0
    return folder


@pytest.fixture
def baked(bake: Path, here: Path) -> Path:
    """A copy of a bake, to be broken."""
    return Path(shutil.copytree(bake, here / "out"))


def rewrite(path: Path, change: Callable[[Any], Any]) -> None:
    document = json.loads(path.read_text("utf-8"))
    change(document)
    path.write_text(json.dumps(document), "utf-8")


def process(*arguments: str, **settings: Any) -> subprocess.CompletedProcess[str]:
    # Jobs in a shell's background ignore Ctrl-C, and so would their children.
    heed = "import signal; signal.signal(signal.SIGINT, signal.default_int_handler)"
    program = f"{heed}; import sys; from furbake.cli import main; sys.exit(main())"
    command = [sys.executable, "-c", program, *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False, **settings)


@pytest.mark.parametrize("arguments", [("--help",), ("bake", "--help"), ("bake", "--lay")])
def test_help_and_wrong_options_wait_for_no_library(arguments: tuple[str, ...]) -> None:
    program = f"import sys; from furbake.cli import main; main({arguments}); sys.exit('numpy' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", program], capture_output=True, check=False).returncode == 0


def test_interrupt_while_libraries_are_imported(here: Path) -> None:
    (here / "modules").mkdir()
    # As initialisers in C do, it makes another error of the interrupt.
    text = (
        "import os, signal\n"
        "try:\n    os.kill(os.getpid(), signal.SIGINT)\n    [None for _ in range(1000)]\n"
        "except KeyboardInterrupt:\n    raise ImportError('initialization failed')\n"
    )
    (here / "modules" / "OpenImageIO.py").write_text(text)
    paths = os.pathsep.join([str(here / "modules"), *(path for path in sys.path if path)])
    done = process("bake", "plane", "-o", "out", env={**os.environ, "PYTHONPATH": paths})
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "furbake: interrupted, nothing written\n")
    assert listed() == ["modules"]


@pytest.mark.skipif(os.name != "posix", reason="closes by the shell")
def test_closed_standard_output() -> None:
    program = "import sys; from furbake.cli import main; sys.exit(main(sys.argv[1:]))"
    script = '"$0" -c "$1" presets paper >&-; echo $?; "$0" -c "$1" presets nope >&- 2>&-; echo $?'
    done = subprocess.run(["sh", "-c", script, sys.executable, program], capture_output=True, text=True, check=False)
    assert (done.stdout, done.stderr) == ("0\n2\n", "")


def test_a_reader_that_has_left(baked: Path) -> None:
    reading, writing = os.pipe()
    os.close(reading)
    program = "import sys; from furbake.cli import main; sys.exit(main(sys.argv[1:]))"
    command = [sys.executable, "-c", program, "presets", "--json"]
    done = subprocess.run(command, stdout=writing, stderr=subprocess.PIPE, check=False)
    os.close(writing)
    assert (done.returncode, done.stderr) == (1, b"")


@pytest.mark.parametrize("command", [("validate",), ("report", "--quiet"), ("swatch", "-o", "x.png")])
def test_a_broken_plane_is_told_by_furbake_alone(
    baked: Path, capfd: pytest.CaptureFixture[str], command: tuple[str, ...]
) -> None:
    data = bytearray((baked / "plane0.png").read_bytes())
    data[len(data) // 2] ^= 0xFF
    (baked / "plane0.png").write_bytes(data)
    capfd.readouterr()
    assert cli.main([*command, "out"]) in {1, 2}
    told = capfd.readouterr()
    lines = (told.out + told.err).splitlines()
    assert len(lines) == 1
    assert "plane0.png: is broken or cut short, expected a whole picture" in lines[0]
    assert "libpng" not in lines[0]


def test_a_broken_mask_is_told_by_furbake_alone(here: Path, baked: Path, capfd: pytest.CaptureFixture[str]) -> None:
    (here / "mask.png").write_bytes((baked / "plane0.png").read_bytes()[:60])
    capfd.readouterr()
    assert cli.main(["bake", "plane", "-o", "new", *TINY, "--quiet", "--mask", "mask.png"]) == 2
    assert len(capfd.readouterr().err.splitlines()) == 1


@pytest.mark.parametrize("command", [("report", "--quiet"), ("swatch", "-o", "x.png"), ("groom", "-o", "x.npz")])
@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda fur: fur["pelts"].__setitem__(0, [[0]]), "FUR_ptm_shells: pelts[0]: [[0]] is not of type 'object'"),
        (
            lambda fur: fur.update(basis={"kind": "eigen", "degree": 4, "matrix": [[float("nan")] * 27] * 6}),
            "FUR_ptm_shells: basis.matrix is not finite, expected numbers",
        ),
    ],
    ids=["pelts", "nan"],
)
def test_readers_ask_what_is_valid(
    run: Callable[..., Any], baked: Path, command: tuple[str, ...], change: Callable[[Any], Any], message: str
) -> None:
    rewrite(baked / "model.gltf", lambda document: change(document["extensions"]["FUR_ptm_shells"]))
    done = run(*command, "out")
    assert (done.status, done.out, done.err) == (2, "", f"furbake: error: {message}\n")


@pytest.mark.parametrize("command", [("inspect",), ("validate",)])
def test_names_from_files_do_not_steer_the_terminal(
    run: Callable[..., Any], baked: Path, command: tuple[str, ...]
) -> None:
    def change(record: Any) -> None:
        record["input"]["name"] = record["key"] = "a\x1b[31m\u202eb\x9b"
        record["fit"]["psnr"] = "\x1b[2J"

    rewrite(baked / "bake.json", change)
    told = run(*command, "out")
    assert "\x1b" not in told.out
    assert command != ("inspect",) or r"a\x1b[31m\u202eb\x9b" in told.out
    assert run("inspect", "\x1b[2J").err.startswith(r"furbake: error: \x1b[2J: no such folder")


@pytest.mark.parametrize("number", [errno.ENOSPC, errno.EDQUOT, errno.EFBIG])
def test_a_full_disk_names_the_folder(run: Callable[..., Any], monkeypatch: pytest.MonkeyPatch, number: int) -> None:
    def full(*arguments: Any, **settings: Any) -> None:
        raise OSError(number, os.strerror(number))

    monkeypatch.setattr(baking, "bake", full)
    done = run("bake", "plane", "-o", "some/out", *TINY)
    assert done.err == f"furbake: error: some/out: {os.strerror(number).lower()}, expected room to write\n"
