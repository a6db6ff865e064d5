"""The package as it would be published: built, whole, installed elsewhere and used there."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tarfile
import venv
import zipfile
from pathlib import Path

import pytest

from furbake.asset.validate import validate
from helpers.command import TINY

ROOT = Path(__file__).parents[2]
BAKER = ROOT / "baker"
VERSION = json.loads((ROOT / "package.json").read_text("utf-8"))["version"]


def build(folder: Path, out: Path, *targets: str) -> None:
    """Build in this environment, which has the build system."""
    chosen = [part for target in targets for part in ("-t", target)]
    command = [sys.executable, "-m", "hatchling", "build", "-d", str(out), *chosen]
    subprocess.run(command, cwd=folder, check=True, capture_output=True)


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path, Path]:
    """Wheel, source distribution, and the wheel that is built from that."""
    folder = tmp_path_factory.mktemp("packages")
    build(BAKER, folder, "wheel", "sdist")
    (sdist,) = folder.glob("*.tar.gz")
    with tarfile.open(sdist) as archive:
        archive.extractall(folder / "source", filter="data")
    (source,) = (folder / "source").iterdir()
    build(source, folder / "again", "wheel")
    return next(folder.glob("*.whl")), sdist, next((folder / "again").glob("*.whl"))


def test_the_version_is_that_of_package_json(built: tuple[Path, Path, Path]) -> None:
    assert [path.name for path in built] == [
        f"furbake-{VERSION}-py3-none-any.whl", f"furbake-{VERSION}.tar.gz", f"furbake-{VERSION}-py3-none-any.whl",
    ]  # fmt: skip


def test_both_wheels_hold_all_of_the_package(built: tuple[Path, Path, Path]) -> None:
    names = []
    for wheel in (built[0], built[2]):
        with zipfile.ZipFile(wheel) as archive:
            names.append(sorted(archive.namelist()))
    assert names[0] == names[1]
    info = f"furbake-{VERSION}.dist-info"
    sources = {
        path.relative_to(BAKER).as_posix()
        for path in (BAKER / "furbake").rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }
    assert {name for name in names[0] if not name.startswith(info)} == sources
    assert f"{info}/licenses/LICENSE" in names[0]


def test_the_licence_is_that_of_the_repository() -> None:
    assert (BAKER / "LICENSE").read_bytes() == (ROOT / "LICENSE").read_bytes()


@pytest.mark.skipif(os.environ.get("FURBAKE_TEST_ALL") != "1", reason="installs from PyPI: npm test -- --all")
def test_it_is_used_from_a_fresh_environment(built: tuple[Path, Path, Path], tmp_path: Path) -> None:
    venv.create(tmp_path / "fresh", with_pip=True)
    bin_ = tmp_path / "fresh" / ("Scripts" if os.name == "nt" else "bin")
    locked = BAKER / "requirements" / "use.txt"

    def call(name: str, *arguments: object) -> str:
        command = [str(bin_ / name), *map(str, arguments)]
        done = subprocess.run(command, cwd=tmp_path, check=False, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return done.stdout

    call("python", "-m", "pip", "install", "--quiet", "--require-hashes", "--requirement", locked)
    call("python", "-m", "pip", "install", "--quiet", "--no-deps", built[0])
    assert call("furbake", "--version") == f"furbake {VERSION}\n"
    call("furbake", "bake", "torus:8x8", "-o", "ring", *TINY, "--preset", "fox", "--no-cache")
    assert validate(tmp_path / "ring") == []
    call("furbake", "batch", "plane", "-o", "many", "--set", "layers=4", "--set", "size=8", "--no-cache")
    assert validate(tmp_path / "many" / "plane") == []
    assert (tmp_path / "many" / "index.html").exists()
