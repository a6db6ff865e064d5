"""Formats of meshes and archives: each is read, or refused for the true reason."""

from __future__ import annotations

import bz2
import io
import re
import zipfile
from pathlib import Path

import numpy as np
import pytest
import trimesh

from furbake.surface.mesh import MeshError, load_mesh
from furbake.surface.read.reading import ARCHIVES, MESHES, read
from helpers.soups import volume

DOCS = Path(__file__).parents[4] / "web" / "docs" / "options.md"

HEAD = "ply\nformat {kind} 1.0\ncomment by hand\nelement vertex 8\n"
PLACE = "property float x\nproperty float y\nproperty float z\n"
COLOUR = "property uchar red\nproperty uchar green\nproperty uchar blue\n"

CUBE = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype="<f4")
QUADS = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
STRIPS = [0, 1, 2, 3, 6, 7, 4, 5, -1, 2, 6, 0, 4, 1, 5, 3, 7]
"""Two strips: four sides and two, each with a turned triangle in between."""


def text(rows: list[list[int]]) -> str:
    return "".join(f"{len(row)} {' '.join(map(str, row))}\n" for row in rows)


def binary(rows: list[list[int]], order: str, count: str) -> bytes:
    return b"".join(np.array([len(row)], count).tobytes() + np.array(row, f"{order}i4").tobytes() for row in rows)


def ply(element: str, rows: list[list[int]], kind: str, colour: bool = False, count: str = "uchar") -> bytes:
    """A cube of which one list of corners per row says the faces."""
    head = HEAD.format(kind=kind) + PLACE + (COLOUR if colour else "")
    head += f"element {element} {len(rows)}\nproperty list {count} int vertex_indices\nend_header\n"
    if kind == "ascii":
        place = "".join(f"{x:g} {y:g} {z:g}{' 255 188 0' if colour else ''}\n" for x, y, z in CUBE)
        return (head + place + text(rows)).encode()
    order = ">" if "big" in kind else "<"
    table = np.zeros(8, dtype=[("place", f"{order}f4", 3), *([("colour", "u1", 3)] if colour else [])])
    table["place"] = CUBE
    if colour:
        table["colour"] = (255, 188, 0)
    return head.encode() + table.tobytes() + binary(rows, order, f"{order}{'i4' if count == 'int' else 'u1'}")


KINDS = ("ascii", "binary_little_endian", "binary_big_endian")


@pytest.mark.parametrize("kind", KINDS)
def test_quads_of_ply(tmp_path: Path, kind: str) -> None:
    path = tmp_path / "cube.ply"
    path.write_bytes(ply("face", QUADS, kind))
    surface = load_mesh(path)
    assert len(surface.faces) == 12
    assert volume(surface) == pytest.approx(1.0)


@pytest.mark.parametrize("kind", KINDS)
def test_polygons_of_different_sizes_in_ply(tmp_path: Path, kind: str) -> None:
    path = tmp_path / "cube.ply"
    a, b, c, d = QUADS[0]
    path.write_bytes(ply("face", [[a, b, c], [a, c, d], *QUADS[1:]], kind, colour=True))
    surface = load_mesh(path)
    assert len(surface.faces) == 12
    assert volume(surface) == pytest.approx(1.0)
    assert surface.colour == pytest.approx((1.0, 0.503, 0.0), abs=0.001)


@pytest.mark.parametrize("kind", KINDS)
def test_strips_of_ply(tmp_path: Path, kind: str) -> None:
    path = tmp_path / "cube.ply"
    path.write_bytes(ply("tristrips", [STRIPS], kind, colour=True, count="int"))
    soup = read(path).soup
    corners = soup.vertices[soup.faces]
    assert len(corners) == 12
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    outward = np.einsum("ij,ij->i", normal, corners.mean(axis=1) - 0.5)
    assert (outward > 0).all() or (outward < 0).all(), "every second triangle of a strip is turned"
    surface = load_mesh(path)
    assert volume(surface) == pytest.approx(1.0)
    assert surface.colour == pytest.approx((1.0, 0.503, 0.0), abs=0.001)


@pytest.mark.parametrize("kind", KINDS)
def test_broken_strips_of_ply(tmp_path: Path, kind: str) -> None:
    path = tmp_path / "cube.ply"
    path.write_bytes(ply("tristrips", [STRIPS], kind, count="int")[:-9])
    with pytest.raises(MeshError, match=r"cube\.ply: cannot be read as ply"):
        load_mesh(path)


@pytest.mark.parametrize("name", ["a.3mf", "a.dae", "a.xyz", "a.drc", "a.step"])
def test_other_formats_are_refused_whatever_is_installed(tmp_path: Path, name: str) -> None:
    (tmp_path / name).write_bytes(b"x")
    kinds = ", ".join((*MESHES, *ARCHIVES))
    with pytest.raises(MeshError, match=rf"{name}: file type is '{name[2:]}', expected one of {re.escape(kinds)}$"):
        load_mesh(tmp_path / name)


def test_the_docs_list_exactly_what_is_read() -> None:
    _, _, rest = DOCS.read_text("utf-8").partition("<!-- formats -->\n")
    table, end, _ = rest.partition("<!-- /formats -->")
    assert end
    rows = re.findall(r"^\| (`.*?) \|", table, re.MULTILINE)
    assert [name for row in rows for name in re.findall(r"`\.([\w.]+)`", row)] == [*MESHES, *ARCHIVES]
    for name in MESHES:
        assert name in trimesh.exchange.load.mesh_formats()


def packed(path: Path, files: dict[str, bytes]) -> Path:
    with zipfile.ZipFile(path, "w") as archive:
        for name, data in files.items():
            archive.writestr(name, data)
    return path


def test_an_archive_without_a_mesh_says_so(tmp_path: Path) -> None:
    path = packed(tmp_path / "a.zip", {"docs/readme.txt": b"", "a.dae": b"", "__MACOSX/._a.obj": b"", "._b.obj": b""})
    kinds = re.escape(", ".join(MESHES))
    message = rf"a\.zip: holds no mesh \(readme\.txt, a\.dae\), expected one of {kinds} in it$"
    with pytest.raises(MeshError, match=message):
        load_mesh(path)
    with pytest.raises(MeshError, match=r"a\.zip: holds no mesh \(\[2J \.txt\), expected"):  # found by the fuzzer
        load_mesh(packed(path, {"\x1b[2J\n.txt": b""}))
    with pytest.raises(MeshError, match=r"a\.zip: holds no mesh \(no file\)"):
        load_mesh(packed(path, {}))


def test_meshes_of_an_archive_with_their_files(tmp_path: Path) -> None:
    ball = trimesh.creation.icosphere(subdivisions=1)
    stream = io.BytesIO(trimesh.Scene([ball]).export(file_type="glb"))
    coloured = (
        b"mtllib ../m/coat.mtl\nv 5 0 0\nv 6 0 0\nv 5 1 0\nv 5 0 1\nusemtl c\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
    )
    files = {
        "a/ball.glb": stream.getvalue(),
        "o/four.obj": coloured,
        "m/coat.mtl": b"newmtl c\nKd 1 0 0\n",
        "broken.glb": b"glTF",
    }
    surface = load_mesh(packed(tmp_path / "a.zip", files))
    assert len(surface.faces) == len(ball.faces) + 4
    assert surface.colours is not None
    assert surface.colours[surface.vertices[:, 0] > 2] == pytest.approx(np.array([[1.0, 0.0, 0.0]] * 4))
    with pytest.raises(MeshError, match=r"a\.zip: cannot be read as zip"):
        load_mesh(packed(tmp_path / "a.zip", {"broken.glb": b"glTF"}))


def test_a_packed_mesh(tmp_path: Path) -> None:
    (tmp_path / "a.obj.bz2").write_bytes(bz2.compress(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"))
    assert len(load_mesh(tmp_path / "a.obj.bz2").faces) == 1
