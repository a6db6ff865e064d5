"""The body of a baked folder as an ordinary GLB, read again by trimesh and by plain sums."""

from __future__ import annotations

import io
import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

from furbake.asset.read import AssetError, read_asset
from furbake.groom.ground import read_skin
from furbake.show.plain import write_plain

ROOT = Path(__file__).parents[3]
CHARACTER, BUNNY = ROOT / "tests" / "golden" / "character", ROOT / "public" / "models" / "bunny"


def plain(folder: Path) -> tuple[bytes, dict[str, Any]]:
    """The GLB of a folder, and its JSON."""
    file = io.BytesIO()
    write_plain(file, folder)
    data = file.getvalue()
    magic, version, total, length, kind = struct.unpack_from("<4sIIII", data)
    assert (magic, version, total, kind) == (b"glTF", 2, len(data), 0x4E4F534A)
    return data, json.loads(data[20 : 20 + length])


def numbers(data: bytes, document: dict[str, Any], index: int) -> np.ndarray[Any, Any]:
    """An accessor of floats."""
    accessor = document["accessors"][index]
    view = document["bufferViews"][accessor["bufferView"]]
    start = 28 + struct.unpack_from("<I", data, 12)[0] + view["byteOffset"]
    return np.frombuffer(data[start : start + view["byteLength"]], "<f4").reshape(accessor["count"], -1)


def test_the_body_is_where_the_skin_is_without_any_extension() -> None:
    data, document = plain(BUNNY)
    assert not {"extensions", "extensionsUsed", "extensionsRequired"} & set(document)
    assert "shells" not in {node["name"] for node in document["nodes"]}
    scene = trimesh.load(io.BytesIO(data), file_type="glb", process=False)
    (skin,) = [name for name in scene.graph.nodes_geometry if name == "skin"]
    turn, mesh = scene.graph[skin]
    vertices, faces = read_skin(read_asset(BUNNY))
    found = trimesh.transform_points(scene.geometry[mesh].vertices, turn)
    # One for each point of the body, where the file has the shells' copies.
    assert len(found) == len(vertices) < read_asset(BUNNY).document["accessors"][0]["count"]
    np.testing.assert_allclose(found[scene.geometry[mesh].faces], vertices[faces], atol=1e-5)
    nodes = json.loads((BUNNY / "model.gltf").read_text("utf-8"))["nodes"]
    shown = [node for node in nodes if "mesh" in node and node["name"] not in {"shells", "fins"}]
    assert len(scene.graph.nodes_geometry) == len(shown) > 10  # with eyes, nose, mouth, whiskers
    assert not document.get("images")  # the planes are the fur's


def test_a_character_keeps_joints_targets_and_clips() -> None:
    before = json.loads((CHARACTER / "model.gltf").read_text("utf-8"))
    data, document = plain(CHARACTER)
    names = [node["name"] for node in document["nodes"]]
    assert names == [node["name"] for node in before["nodes"] if node["name"] not in {"shells", "fins"}]
    assert [names[joint] for joint in document["skins"][0]["joints"]] == ["root", "half"]
    assert [names[root] for root in document["scenes"][0]["nodes"]] == ["skin", "stand"]
    clips = [
        [(names[channel["target"]["node"]], channel["target"]["path"]) for channel in clip["channels"]]
        for clip in document["animations"]
    ]
    old = [node["name"] for node in before["nodes"]]
    moved = [
        [(old[channel["target"]["node"]], channel["target"]["path"]) for channel in clip["channels"]
         if old[channel["target"]["node"]] not in {"shells", "fins"}]
        for clip in before["animations"]
    ]  # fmt: skip
    assert clips == moved != []
    inverse = numbers(data, document, document["skins"][0]["inverseBindMatrices"]).reshape(-1, 4, 4)
    assert np.allclose(inverse[:, :, 3], [0, 0, 0, 1])
    (primitive,) = document["meshes"][0]["primitives"]
    weights = numbers(data, document, primitive["attributes"]["WEIGHTS_0"])
    np.testing.assert_allclose(weights.sum(axis=1), 1, atol=1e-6)
    assert document["accessors"][primitive["attributes"]["JOINTS_0"]]["componentType"] in {5121, 5123}
    assert len(primitive["targets"]) == len(before["meshes"][0]["primitives"][0]["targets"])


def test_a_broken_folder_is_a_sentence(tmp_path: Path) -> None:
    for name in ("model.gltf", "model.bin"):
        (tmp_path / name).write_bytes((CHARACTER / name).read_bytes())
    document = json.loads((tmp_path / "model.gltf").read_text("utf-8"))
    document["skins"][0]["joints"] = "none"
    (tmp_path / "model.gltf").write_text(json.dumps(document), "utf-8")
    with pytest.raises(AssetError, match=r"^[^\n]+$"):
        write_plain(io.BytesIO(), tmp_path)
