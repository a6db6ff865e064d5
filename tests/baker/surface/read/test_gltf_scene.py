"""glTF as the specification has it: what trimesh leaves out counts here."""

from __future__ import annotations

import base64
import io
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from furbake.surface.material import CLAMP, MIRROR, Picture
from furbake.surface.mesh import MeshError, load_mesh

SQUARE = np.array([[0, 0, 0], [1, 0, 0], [1, 0, -1], [0, 0, -1]], dtype=np.float32)
TWO = np.array([0, 1, 2, 0, 2, 3], dtype=np.uint16)
CODES = {"int8": 5120, "uint8": 5121, "int16": 5122, "uint16": 5123, "uint32": 5125, "float32": 5126}
KINDS = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}


class Document:
    """A .gltf file as it is put together."""

    def __init__(self) -> None:
        self.json: dict[str, Any] = {"asset": {"version": "2.0"}, "accessors": [], "bufferViews": [], "buffers": []}
        self.json |= {"scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "meshes": [{"primitives": []}]}
        self.data = bytearray()

    def view(self, data: bytes) -> int:
        self.data += bytes(-len(self.data) % 4)
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data)})
        self.data += data
        return len(self.json["bufferViews"]) - 1

    def accessor(self, values: Any, **more: Any) -> int:
        array = np.asarray(values)
        flat = array.reshape(len(array), -1)
        record = {"componentType": CODES[array.dtype.name], "count": len(array), "type": KINDS[flat.shape[1]]}
        self.json["accessors"].append({**record, "bufferView": self.view(array.tobytes()), **more})
        return len(self.json["accessors"]) - 1

    def primitive(self, **attributes: Any) -> dict[str, Any]:
        record = {"attributes": {"POSITION": self.accessor(SQUARE), **attributes}, "indices": self.accessor(TWO)}
        self.json["meshes"][0]["primitives"].append(record)
        return record

    def write(self, folder: Path) -> Path:
        uri = "data:application/octet-stream;base64," + base64.b64encode(bytes(self.data)).decode()
        self.json["buffers"] = [{"uri": uri, "byteLength": len(self.data)}]
        path = folder / "model.gltf"
        path.write_text(json.dumps(self.json))
        return path


@pytest.fixture
def document() -> Document:
    return Document()


def png(pixels: Any) -> bytes:
    stream = io.BytesIO()
    Image.fromarray(np.asarray(pixels, dtype=np.uint8)).save(stream, "PNG")
    return stream.getvalue()


def textured(document: Document, picture: bytes, **material: Any) -> None:
    document.json["images"] = [{"bufferView": document.view(picture), "mimeType": "image/png"}]
    document.json["samplers"] = [{"wrapS": CLAMP, "wrapT": MIRROR}]
    document.json["textures"] = [{"source": 0, "sampler": 0}]
    base = {"baseColorTexture": {"index": 0}, **material}
    document.json["materials"] = [{"name": "coat", "doubleSided": True, "pbrMetallicRoughness": base}]


def test_normalised_integers(document: Document, tmp_path: Path) -> None:
    record = document.primitive()
    places = np.rint(32767 * SQUARE).astype(np.int16)
    record["attributes"]["POSITION"] = document.accessor(
        np.column_stack([places, places[:, :1]])[:, :3], normalized=True
    )
    document.json["nodes"] = [{"mesh": 0, "scale": [2, 2, 2], "translation": [0, 3, 0]}]
    surface = load_mesh(document.write(tmp_path))
    np.testing.assert_allclose(np.sort(surface.vertices[:, 0]), [0, 0, 2, 2])
    np.testing.assert_allclose(surface.vertices[:, 1], 3)


def test_nodes_nest_and_mirror(document: Document, tmp_path: Path) -> None:
    document.primitive()
    document.json["nodes"] = [
        {"children": [1, 2], "rotation": [0, 0, np.sqrt(0.5), np.sqrt(0.5)]},
        {"mesh": 0, "scale": [-1, 1, 1]},
        {"mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1]},
        {"mesh": 0, "name": "in no scene"},
    ]
    surface = load_mesh(document.write(tmp_path))
    assert len(surface.faces) == 4
    # A quarter turn about z lays +x along +y and the normal along -x, for the mirrored one too.
    np.testing.assert_allclose(surface.normals, np.tile([-1.0, 0, 0], (len(surface.normals), 1)), atol=1e-6)
    np.testing.assert_allclose([surface.vertices[:, 1].min(), surface.vertices[:, 1].max()], [-1, 6], atol=1e-6)
    assert surface.notices == (f"{tmp_path / 'model.gltf'}: 8 vertices welded into 7",) or len(surface.vertices) == 8


def test_a_node_below_itself_is_refused(document: Document, tmp_path: Path) -> None:
    document.primitive()
    document.json["nodes"] = [{"mesh": 0, "children": [0]}]
    with pytest.raises(MeshError, match=r"cannot be read as gltf \(ValueError: node 0 is in the scene twice\)"):
        load_mesh(document.write(tmp_path))


def test_sparse_accessor(document: Document, tmp_path: Path) -> None:
    record = document.primitive()
    place = document.json["accessors"][record["attributes"]["POSITION"]]
    indices, values = document.view(np.array([1, 2], np.uint8).tobytes()), document.view((3 * SQUARE[1:3]).tobytes())
    place["sparse"] = {
        "count": 2,
        "indices": {"bufferView": indices, "componentType": 5121},
        "values": {"bufferView": values},
    }
    assert load_mesh(document.write(tmp_path)).extent == 3.0


@pytest.mark.parametrize(("mode", "corners"), [(5, [0, 1, 3, 2]), (6, [0, 1, 2, 3])])
def test_strips_and_fans(document: Document, tmp_path: Path, mode: int, corners: list[int]) -> None:
    record = document.primitive()
    record |= {"mode": mode, "indices": document.accessor(np.array(corners, dtype=np.uint8))}
    surface = load_mesh(document.write(tmp_path))
    assert len(surface.faces) == 2
    np.testing.assert_allclose(surface.normals, np.tile([0.0, 1, 0], (4, 1)))


def test_skinned_model_stands_as_its_joints_do(document: Document, tmp_path: Path) -> None:
    joints, weights = np.zeros((4, 4), np.uint8), np.tile(np.float32([1, 0, 0, 0]), (4, 1))
    document.primitive(JOINTS_0=document.accessor(joints), WEIGHTS_0=document.accessor(weights))
    bind = np.eye(4, dtype=np.float32)
    bind[3, :3] = (0, -1, 0)
    document.json["skins"] = [{"joints": [1], "inverseBindMatrices": document.accessor(bind[None])}]
    document.json["nodes"] = [{"mesh": 0, "skin": 0, "translation": [9, 9, 9]}, {"translation": [0, 5, 0]}]
    document.json["scenes"] = [{"nodes": [0, 1]}]
    np.testing.assert_allclose(load_mesh(document.write(tmp_path)).vertices[:, 1], 4.0)


def test_what_moves_is_said(document: Document, tmp_path: Path) -> None:
    def told() -> str:
        return load_mesh(document.write(tmp_path)).notices[-1]

    part = document.primitive()
    assert load_mesh(document.write(tmp_path)).notices == ()
    part["targets"] = [{"POSITION": document.accessor(SQUARE)}]
    assert told().endswith(": 1 morph target is kept")
    times, weights = (document.accessor(np.float32([0, 1])) for _ in range(2))
    sampler = {"input": times, "output": weights}
    channel = {"sampler": 0, "target": {"node": 0, "path": "weights"}}
    document.json["animations"] = [
        {"name": f"clip {i}", "channels": [channel], "samplers": [sampler]} for i in range(7)
    ]
    assert told().endswith(": 7 clips (clip 0, clip 1, clip 2, clip 3, clip 4, ...) and 1 morph target are kept")


def test_colour_is_factor_times_picture_times_vertex_colour(document: Document, tmp_path: Path) -> None:
    picture = png(np.full((4, 4, 3), 188))
    uv = document.accessor(np.float32([[0.2, 0.2], [0.8, 0.2], [0.8, 0.8], [0.2, 0.8]]))
    document.primitive(TEXCOORD_0=uv, COLOR_0=document.accessor(np.full((4, 4), 32768, np.uint16), normalized=True))
    document.json["meshes"][0]["primitives"][0]["material"] = 0
    textured(document, picture, baseColorFactor=[1.0, 0.5, 0.25, 1.0])
    surface = load_mesh(document.write(tmp_path))
    assert surface.colours is None
    assert surface.colour == pytest.approx(0.5 * 0.503 * np.array([1.0, 0.5, 0.25]), abs=1e-3)
    assert surface.attributes["color"] == pytest.approx(np.full((4, 4), 0.5), abs=1e-4)

    (skin,) = surface.skin
    assert skin.material.name == "coat"
    assert skin.material.factor == (1.0, 0.5, 0.25, 1.0)
    assert skin.material.double_sided
    assert skin.material.wrap == (CLAMP, MIRROR)
    assert skin.material.picture == Picture(picture, "image/png")
    assert skin.colour == pytest.approx(np.full((4, 4), 0.5), abs=1e-4)
    assert skin.uv is not None
    places = surface.vertices[skin.source]
    np.testing.assert_allclose(skin.uv, np.stack([0.2 + 0.6 * places[:, 0], 0.2 - 0.6 * places[:, 2]], 1), atol=1e-6)
    np.testing.assert_array_equal(skin.source[skin.faces], surface.faces)


def test_picture_colours_vertices(document: Document, tmp_path: Path) -> None:
    pixels = np.zeros((64, 64, 3))
    pixels[:, 32:] = 255
    uv = document.accessor(np.float32([[0, 0], [1, 0], [1, 1], [0, 1]]))
    document.primitive(TEXCOORD_0=uv)["material"] = 0
    textured(document, png(pixels))
    surface = load_mesh(document.write(tmp_path))
    assert surface.colours is not None
    np.testing.assert_allclose(surface.colours[:, 0], surface.vertices[:, 0], atol=0.2)
    assert surface.colour == (1.0, 1.0, 1.0)


def test_second_coordinates_and_their_transform(document: Document, tmp_path: Path) -> None:
    first = document.accessor(np.zeros((4, 2), np.float32))
    second = document.accessor(np.array([[0, 0], [255, 0], [255, 255], [0, 255]], np.uint8), normalized=True)
    document.primitive(TEXCOORD_0=first, TEXCOORD_1=second)["material"] = 0
    textured(document, png(np.zeros((2, 2, 3))))
    info = document.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]
    info |= {"texCoord": 1, "extensions": {"KHR_texture_transform": {"scale": [2, 4], "offset": [0.5, 0]}}}
    surface = load_mesh(document.write(tmp_path))
    assert surface.uv is not None
    np.testing.assert_allclose(surface.uv.reshape(-1, 2).max(axis=0), [2.5, 4.0])


def test_broken_picture_is_a_notice(document: Document, tmp_path: Path) -> None:
    document.primitive(TEXCOORD_0=document.accessor(np.zeros((4, 2), np.float32)))["material"] = 0
    textured(document, png(np.zeros((2, 2, 3)))[:30])
    path = document.write(tmp_path)
    surface = load_mesh(path)
    assert surface.notices == (f"{path}: 1 picture left out that cannot be read",)
    assert surface.skin[0].material.picture is None
    document.json["images"] = [{"uri": "nowhere.png"}]
    assert load_mesh(document.write(tmp_path)).notices == surface.notices


def test_webp_becomes_png(document: Document, tmp_path: Path) -> None:
    stream = io.BytesIO()
    Image.fromarray(np.full((4, 4, 3), 99, dtype=np.uint8)).save(stream, "WEBP")
    document.primitive(TEXCOORD_0=document.accessor(np.zeros((4, 2), np.float32)))["material"] = 0
    textured(document, stream.getvalue())
    document.json["textures"] = [{"extensions": {"EXT_texture_webp": {"source": 0}}}]
    picture = load_mesh(document.write(tmp_path)).skin[0].material.picture
    assert picture
    assert picture.kind == "image/png"
    assert picture.data.startswith(b"\x89PNG")


def test_attributes_of_its_own(document: Document, tmp_path: Path) -> None:
    lengths = np.array([0, 255, 255, 0], dtype=np.uint8)
    comb = np.tile(np.float32([1, 0, 0]), (4, 1))
    document.primitive(_LENGTH=document.accessor(lengths, normalized=True), _COMB=document.accessor(comb))
    document.json["nodes"] = [{"mesh": 0, "rotation": [0, np.sqrt(0.5), 0, np.sqrt(0.5)]}]
    surface = load_mesh(document.write(tmp_path))
    np.testing.assert_allclose(surface.attributes["length"][:, 0], -surface.vertices[:, 2], atol=1e-6)
    np.testing.assert_allclose(surface.attributes["comb"], np.tile([0, 0, -1], (4, 1)), atol=1e-6)


BROKEN = {
    "a buffer view beyond its buffer": lambda gltf: gltf["bufferViews"][0].update(byteLength=9999),
    "an accessor beyond its view": lambda gltf: gltf["accessors"][0].update(count=9999),
    "a negative count": lambda gltf: gltf["accessors"][0].update(count=-1),
    "an unknown type": lambda gltf: gltf["accessors"][0].update(type="VEC9"),
    "no such accessor": lambda gltf: gltf["meshes"][0]["primitives"][0]["attributes"].update(POSITION=77),
    "no such mesh": lambda gltf: gltf["nodes"][0].update(mesh=-1),
    "no such material": lambda gltf: gltf["meshes"][0]["primitives"][0].update(material=3),
    "no asset": lambda gltf: gltf.pop("asset"),
    "version 1": lambda gltf: gltf["asset"].update(version="1.0"),
    "no numbers": lambda gltf: gltf["nodes"][0].update(scale=["a", "b", "c"]),
    "a remote buffer": lambda gltf: gltf["buffers"][0].update(uri="https://example.org/x.bin"),
}


@pytest.mark.parametrize("what", BROKEN)
def test_broken_document_is_one_sentence(document: Document, tmp_path: Path, what: str) -> None:
    document.primitive()
    path = document.write(tmp_path)
    BROKEN[what](document.json)
    path.write_text(json.dumps(document.json))
    with pytest.raises(MeshError, match=r"^[^\n]+: cannot be read as gltf \([^\n]+\), expected a valid file$"):
        load_mesh(path)
