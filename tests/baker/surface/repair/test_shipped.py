from __future__ import annotations

import base64
import contextlib
import io
import re
import shutil
from pathlib import Path

import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from furbake import cli, validate
from furbake.surface.mesh import MAX_FACES, MeshError, load_mesh
from helpers.soups import Mesh, assert_sound, fans, nests, scales, slivers, soups, strips

PACKAGES = Path(__file__).parents[4] / "node_modules"


TINY = ("--layers", "4", "--size", "8", "--lights", "8", "--quiet")


SMALL = 2_000_000
"""Bytes of a file that is baked here too."""


SUFFIXES = {".glb", ".gltf", ".obj", ".ply", ".stl", ".off", ".3mf", ".dae"}


def shipped() -> list[Path]:
    """Mesh files of the packages that this project depends on; @pmndrs/assets wraps its own in JavaScript."""
    if not PACKAGES.exists():
        return []
    roots = [PACKAGES, Path(trimesh.__file__).parents[1]]
    found = {path for root in roots for path in root.rglob("*") if path.suffix.lower() in SUFFIXES and path.is_file()}
    return sorted(found | set(PACKAGES.glob("@pmndrs/assets/models/*.glb.js")))


def unpacked(path: Path, folder: Path) -> Path:
    """The mesh file itself."""
    if path.suffix != ".js":
        return path
    data = re.search(r"base64,([A-Za-z0-9+/=]+)", path.read_text())
    assert data
    inner = folder / path.name.removesuffix(".js")
    inner.write_bytes(base64.b64decode(data[1]))
    return inner


@pytest.mark.parametrize("path", shipped(), ids=lambda path: path.name)
def test_shipped_meshes(tmp_path: Path, path: Path) -> None:
    path = unpacked(path, tmp_path)
    try:
        surface = load_mesh(path)
    except MeshError as error:
        assert re.fullmatch(re.escape(str(path)) + r": [^\n]+", str(error))  # noqa: PT017 — refusing is as good
        return
    assert_sound(surface)
    assert len(surface.faces) <= 1.05 * MAX_FACES


def assert_baked_or_refused(path: Path, folder: Path) -> None:
    """Exit 0 with a valid asset, or exit 2 with one line and nothing written."""
    shutil.rmtree(folder, ignore_errors=True)
    errors = io.StringIO()
    with contextlib.redirect_stderr(errors):
        status = cli.main(["bake", str(path), "-o", str(folder), *TINY])
    if status == 0:
        assert validate(folder) == []
    else:
        assert status == 2
        assert re.fullmatch(r"furbake: error: [^\n]+\n", errors.getvalue())
        assert not folder.exists()


@pytest.mark.parametrize("path", [p for p in shipped() if p.stat().st_size < SMALL], ids=lambda path: path.name)
def test_shipped_meshes_are_baked(tmp_path: Path, path: Path) -> None:
    assert_baked_or_refused(unpacked(path, tmp_path), tmp_path / "out")


# Repair itself sees more of them in test_any.py.
@settings(max_examples=15)
@given(st.one_of(soups(), strips(), fans(), slivers(), nests()), scales)
def test_any_mesh_is_baked_or_refused(tmp_path_factory: pytest.TempPathFactory, mesh: Mesh, scale: float) -> None:
    folder = tmp_path_factory.mktemp("any")
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in (scale * mesh[0]).tolist()]
    lines += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in mesh[1].tolist()]
    (folder / "mesh.obj").write_text("\n".join(lines))
    assert_baked_or_refused(folder / "mesh.obj", folder / "out")
