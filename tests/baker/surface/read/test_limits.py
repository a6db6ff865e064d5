"""No small file takes much memory or time, and nothing is read but regular files in the model's own folder."""

from __future__ import annotations

import base64
import io
import json
import os
import re
import tarfile
import zipfile
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from furbake.identity import input_hash
from furbake.surface.files import source
from furbake.surface.limits import Limits, limits
from furbake.surface.mesh import MeshError, load_mesh
from furbake.surface.read.companions import companions
from furbake.surface.read.gltf_data import GltfData
from furbake.surface.read.polygons import recut

DOCS = Path(__file__).parents[4] / "web" / "docs" / "options.md"

OBJ = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
CORNERS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], dtype="<f4").tobytes()
DATA = f"data:;base64,{base64.b64encode(CORNERS).decode()}"


def gltf(path: Path, **parts: Any) -> Path:
    """One triangle as glTF; `parts` replace lists of it."""
    document = {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"componentType": 5126, "count": 3, "type": "VEC3", "bufferView": 0}],
        "bufferViews": [{"buffer": 0, "byteLength": len(CORNERS)}],
        "buffers": [{"byteLength": len(CORNERS), "uri": DATA}],
    }
    path.write_text(json.dumps(document | parts))
    return path


NOTHING = {"componentType": 5126, "count": 3_000_000, "type": "VEC3"}
MANY = {f"_A{i}": 0 for i in range(400)}

GREEDY: dict[str, dict[str, Any]] = {
    "accessors without a buffer": {
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "_A": 1}}]}],
        "accessors": [NOTHING, NOTHING],
    },
    "one accessor": {"accessors": [NOTHING | {"count": 10**15}]},
    "sparse": {
        "accessors": [
            {
                "componentType": 5126,
                "count": 1,
                "type": "VEC3",
                "sparse": {"count": 10**9, "indices": {"bufferView": 0, "componentType": 5125}, "values": {}},
            }
        ]
    },
    "corners": {
        "meshes": [{"primitives": [{"attributes": MANY | {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"componentType": 5126, "count": 3, "type": "VEC3", "bufferView": 0},
            {"componentType": 5121, "count": 300_000, "type": "SCALAR"},
        ],
    },
    "attributes of other parts": {
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, f"_A{i}": 0}} for i in range(1500)]}],
    },
    "one mesh at many nodes": {
        "nodes": [{"mesh": 0} for _ in range(4)],
        "scenes": [{"nodes": [*range(4)]}],
        "accessors": [NOTHING | {"count": 900_000}],
    },
}


@pytest.mark.parametrize("kind", GREEDY)
def test_numbers_are_bounded_per_file(tmp_path: Path, kind: str) -> None:
    path = gltf(tmp_path / "a.gltf", **GREEDY[kind])
    message = r"a\.gltf: more than \d+ numbers to read, expected fewer, or a higher bound in FURBAKE_LIMITS \(numbers"
    with pytest.raises(MeshError, match=message):
        load_mesh(path)


def test_lists_of_a_gltf_are_not_copied_for_each_look(tmp_path: Path) -> None:
    data = GltfData(source(gltf(tmp_path / "a.gltf")))
    assert data.list_of("nodes") is data.list_of("nodes")
    view = data.view(0)
    assert view.obj is data.view(0).obj, "views share the buffer"


def test_a_library_named_with_many_blanks(tmp_path: Path) -> None:
    path = tmp_path / "a.obj"
    path.write_text(f"mtllib a{' ' * 400_000}b\n{OBJ}")  # hours by a quadratic search
    assert companions(path) == []
    assert len(load_mesh(path).faces) == 4


def test_hollow_polygons_have_a_bounded_time() -> None:
    """Spirals, whose ears are found late, stay as they are once all steps are taken."""
    turn = np.linspace(0.0, 60.0, 200)
    arms = [np.stack([r * np.cos(turn), r * np.sin(turn), 0 * turn], axis=1) for r in (1 + turn, 1.5 + turn)]
    ring = np.concatenate([arms[0], arms[1][::-1]])
    fan = np.stack([np.zeros(398), np.arange(1, 399), np.arange(2, 400)], axis=1).astype(np.int64)
    count = 12
    faces = np.concatenate([fan + 400 * i for i in range(count)])
    cut = recut(np.tile(ring, (count, 1)), faces).reshape(count, 398, 3) - 400 * np.arange(count)[:, None, None]
    anew = [not np.array_equal(one, fan) for one in cut]
    assert anew == sorted(anew, reverse=True)
    assert anew[0]
    assert not anew[-1]


@pytest.fixture
def secret(tmp_path: Path) -> Path:
    """A model's folder, beside a file that is none of its business."""
    (tmp_path / "secret").write_bytes(CORNERS)
    (tmp_path / "secret.png").write_bytes(png(4))
    (tmp_path / "secret.mtl").write_text("newmtl m\nKd 1 0 0\n")
    folder = tmp_path / "model"
    folder.mkdir()
    (folder / "link").symlink_to(tmp_path / "secret")
    (folder / "link.png").symlink_to(tmp_path / "secret.png")
    os.mkfifo(folder / "pipe")
    return folder


def png(side: int) -> bytes:
    stream = io.BytesIO()
    Image.new("RGB", (side, side), (200, 30, 30)).save(stream, "PNG")
    return stream.getvalue()


OUTSIDE = ("../secret", "{folder}/../secret", "link", "/dev/zero", "/etc/passwd", "..%2Fsecret", "x/../../secret")


@pytest.mark.parametrize("uri", [*OUTSIDE, "pipe", "."])
def test_buffers_are_regular_files_of_the_own_folder(secret: Path, uri: str) -> None:
    uri = uri.format(folder=secret)
    path = gltf(secret / "a.gltf", buffers=[{"byteLength": len(CORNERS), "uri": uri}])
    what = {"pipe": "is no regular file", ".": "is a directory"}.get(uri, "names a file outside its folder")
    with pytest.raises(MeshError, match=rf"a\.gltf: cannot be read as gltf \({what}"):
        load_mesh(path)
    assert companions(path) == []


@pytest.mark.parametrize("uri", ["../secret.png", "link.png", "pipe", "/dev/zero"])
def test_pictures_are_regular_files_of_the_own_folder(secret: Path, uri: str) -> None:
    square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nusemtl m\nf 1/1 2/2 3/3\n"
    (secret / "a.mtl").write_text(f"newmtl m\nmap_Kd {uri}\n")
    path = secret / "a.obj"
    path.write_text(f"mtllib a.mtl\n{square}")
    assert not any(skin.material.picture for skin in load_mesh(path).skin)
    assert [file.name for file in companions(path)] == ["a.mtl"]
    path.write_text(f"mtllib {'../secret.mtl' if uri != 'pipe' else 'pipe'}\n{square}")
    assert load_mesh(path).colour == (1.0, 1.0, 1.0)
    assert companions(path) == []


def test_a_model_is_a_regular_file(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "a.obj")
    with pytest.raises(MeshError, match=r"a\.obj: is no regular file, expected a readable mesh file$"):
        load_mesh(tmp_path / "a.obj")
    with pytest.raises(OSError, match="is no regular file"):
        input_hash(str(tmp_path / "a.obj"))


def test_bytes_of_a_model_are_bounded_with_its_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "a.bin").write_bytes(CORNERS + bytes(3000))
    path = gltf(tmp_path / "a.gltf", buffers=[{"byteLength": len(CORNERS), "uri": "a.bin"}])
    for bound, what in ((100, "100"), (3200, "3200")):
        monkeypatch.setenv("FURBAKE_LIMITS", f"bytes={bound}")
        with pytest.raises(MeshError, match=rf"a\.gltf: more than {what} bytes to read, expected fewer"):
            load_mesh(path)
    monkeypatch.setenv("FURBAKE_LIMITS", "bytes=4K")
    assert len(load_mesh(path).faces) == 1


def test_pixels_are_bounded_alike_in_obj_and_gltf(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "a.png").write_bytes(png(20))
    (tmp_path / "a.mtl").write_text("newmtl m\nmap_Kd a.png\n")
    obj = tmp_path / "a.obj"
    obj.write_text("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nusemtl m\nf 1/1 2/2 3/3\n")
    primitive = {"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}
    textured = gltf(
        tmp_path / "a.gltf",
        meshes=[{"primitives": [primitive]}],
        accessors=[{"componentType": 5126, "count": 3, "type": kind, "bufferView": 0} for kind in ("VEC3", "VEC2")],
        materials=[{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        textures=[{"source": 0}],
        images=[{"uri": "a.png"}],
    )
    for path in (obj, textured):
        monkeypatch.delenv("FURBAKE_LIMITS", raising=False)
        assert load_mesh(path).skin[0].material.picture
        monkeypatch.setenv("FURBAKE_LIMITS", "pixels=399")
        surface = load_mesh(path)
        assert not any(skin.material.picture for skin in surface.skin)
        assert surface.notices == (f"{path}: 1 picture left out that cannot be read",)


def test_a_large_picture_of_an_obj_file_is_never_decoded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("FURBAKE_LIMITS", "pixels=15")
    stream = io.BytesIO()
    Image.new("RGB", (4, 4)).save(stream, "BMP")
    (tmp_path / "a.bmp").write_bytes(stream.getvalue())
    (tmp_path / "a.mtl").write_text("newmtl m\nmap_Kd a.bmp\n")
    path = tmp_path / "a.obj"
    path.write_text("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n")
    assert [line for line in load_mesh(path).notices if "picture" in line] == [
        f"{path}: 1 picture left out that cannot be read"
    ]
    monkeypatch.delenv("FURBAKE_LIMITS")
    assert load_mesh(path).skin[0].material.picture


def pack(kind: str, files: dict[str, bytes]) -> bytes:
    stream = io.BytesIO()
    if kind == "zip":
        with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
            for name, data in files.items():
                archive.writestr(name, data)
    else:
        with tarfile.open(fileobj=stream, mode=f"w:{kind[4:]}") as tar:  # type: ignore[call-overload]
            for name, data in files.items():
                info = tarfile.TarInfo(name)
                info.size = len(data)
                tar.addfile(info, io.BytesIO(data))
    return stream.getvalue()


@pytest.mark.parametrize("kind", ["zip", "tar.gz", "tar.bz2"])
def test_archives_unpack_to_a_bounded_size(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, kind: str) -> None:
    path = tmp_path / f"a.{kind}"
    path.write_bytes(pack(kind, {"a.obj": OBJ.encode(), "b.obj": bytes(2_000_000)}))
    monkeypatch.setenv("FURBAKE_LIMITS", "bytes=1M")
    with pytest.raises(MeshError, match=rf"a\.{kind}: more than 1000000 bytes to read"):
        load_mesh(path)
    monkeypatch.setenv("FURBAKE_LIMITS", "members=1")
    with pytest.raises(MeshError, match=rf"a\.{kind}: more than 1 members to read"):
        load_mesh(path)
    monkeypatch.delenv("FURBAKE_LIMITS")
    assert len(load_mesh(path).faces) == 4


def test_a_size_that_a_zip_file_announces_is_not_believed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    data = bytearray(pack("zip", {"a.obj": bytes(2_000_000)}))
    place = data.index(b"PK\x01\x02") + 24
    data[place : place + 4] = (2_000_000_000).to_bytes(4, "little")
    path = tmp_path / "a.zip"
    path.write_bytes(data)
    monkeypatch.setenv("FURBAKE_LIMITS", "bytes=1M")
    with pytest.raises(MeshError, match="more than 1000000 bytes"):
        load_mesh(path)


def test_bounds_of_the_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("FURBAKE_LIMITS", "bytes=2G, pixels=16384M,")
    assert limits() == Limits(bytes=2 * 10**9, pixels=16384 * 10**6)
    monkeypatch.setenv("FURBAKE_LIMITS", "")
    assert limits() == Limits()


def test_every_bound_is_in_the_docs() -> None:
    _, _, rest = DOCS.read_text("utf-8").partition("<!-- limits -->\n")
    rows = re.findall(r"^\| `(\w+)` \| ([\d ]+) \|", rest.partition("<!-- /limits -->")[0], re.MULTILINE)
    assert {name: int(most.replace(" ", "")) for name, most in rows} == asdict(Limits())


@pytest.mark.parametrize("value", ["bytes", "bytes=", "bytes=-1", "bytes=1T", "faces=3", "bytes=1=2", "bytes=٣"])
def test_malformed_bounds(monkeypatch: pytest.MonkeyPatch, tmp_path: Path, value: str) -> None:
    monkeypatch.setenv("FURBAKE_LIMITS", value)
    (tmp_path / "a.obj").write_text(OBJ)
    with pytest.raises(MeshError, match=r"^FURBAKE_LIMITS: got '.*', expected NAME=NUMBER with one of bytes, numbers"):
        load_mesh(tmp_path / "a.obj")
