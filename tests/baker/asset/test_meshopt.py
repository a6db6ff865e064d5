"""Compressed meshes, and fins as edges: what a folder says is the same with them and without."""

from __future__ import annotations

import json
import shutil
import struct
import subprocess
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from furbake import BakeOptions, bake
from furbake.asset.inspect import summary
from furbake.asset.mesh.edges import fin_mask, shell_edges
from furbake.asset.mesh.shared import skin_first
from furbake.asset.read import Asset, read_asset
from furbake.asset.validate import validate
from furbake.surface.charts import Charts
from furbake.surface.read.reading import read
from furbake.surface.repair.topology import unit
from helpers import khronos

Floats = np.ndarray[Any, Any]
EXTENSION = "EXT_meshopt_compression"
OPTIONS = {"layers": 4, "size": 8, "lights": 8}

THREE = """
    import { readFileSync } from 'node:fs';
    import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';
    const folder = process.argv[1];
    const { bufferViews } = JSON.parse(readFileSync(`${folder}/model.gltf`));
    const data = readFileSync(`${folder}/model.bin`);
    await MeshoptDecoder.ready;
    const found = bufferViews.map(({ byteOffset = 0, byteLength, extensions }) => {
        const packed = extensions?.EXT_meshopt_compression;
        if (!packed) return data.subarray(byteOffset, byteOffset + byteLength).toString('hex');
        const { count, byteStride, mode, filter } = packed;
        const target = new Uint8Array(count * byteStride);
        const source = data.subarray(packed.byteOffset, packed.byteOffset + packed.byteLength);
        MeshoptDecoder.decodeGltfBuffer(target, count, byteStride, source, mode, filter);
        return Buffer.from(target).toString('hex');
    });
    console.log(JSON.stringify(found));
"""


@pytest.fixture(scope="module")
def both(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """The same bake with compressed meshes and without."""
    place = tmp_path_factory.mktemp("both")
    for name, packed in (("packed", True), ("plain", False)):
        bake("torus:24x32", place / name, BakeOptions(**OPTIONS, meshopt=packed))  # type: ignore[arg-type]
    return place / "packed", place / "plain"


def attributes(asset: Asset, name: str) -> dict[str, Floats]:
    found = asset.primitive(asset.fur[name])["attributes"]
    return {key: asset.accessor(index) for key, index in found.items()}


def faces(asset: Asset, name: str) -> Floats:
    """(F, 9) positions of the corners of all faces, sorted; each face goes round from its lowest corner in the file."""
    primitive = asset.primitive(asset.fur[name])
    places = asset.accessor(primitive["attributes"]["POSITION"])[:, :3].astype(np.int64)
    corners = asset.accessor(primitive["indices"]).reshape(-1, 3)
    found = places[corners]
    first = np.lexsort(np.moveaxis(found, -1, 0)[::-1])[:, :1]
    found = np.take_along_axis(found, ((first + np.arange(3)) % 3)[..., None], axis=1).reshape(-1, 9)
    return found[np.lexsort(found.T[::-1])]


def test_vertices_and_faces_are_the_same(both: tuple[Path, Path]) -> None:
    packed, plain = (read_asset(folder) for folder in both)
    assert EXTENSION in packed.document["extensionsRequired"]
    assert EXTENSION not in plain.document["extensionsUsed"]
    shells = attributes(packed, "shells")
    for key, values in attributes(plain, "shells").items():
        # Texture coordinates may lose a 16th of a texel, all of _FUR but the weight two bits.
        lost = {"TEXCOORD_0": 65535 / (plain.fur["tiles"] * OPTIONS["size"] * 16), "_FUR": [0, 2, 2, 2]}.get(key, 0)
        if key != "TANGENT":
            assert (np.abs(shells[key].astype(int) - values.astype(int)) <= lost).all(), key
            continue
        one, two = (unit(found[:, :3].astype(float)) for found in (shells[key], values))
        assert np.degrees(np.arccos(np.clip((one * two).sum(axis=1), -1, 1))).max() < 1.5
        np.testing.assert_array_equal(shells[key][:, 3], values[:, 3])
    for name in ("skin", "shells"):
        np.testing.assert_array_equal(faces(packed, name), faces(plain, name))
    assert len(packed.data) < 0.5 * len(plain.data)
    assert [validate(folder) for folder in both] == [[], []]
    assert [khronos.issues(folder) for folder in both] == [[], []]


def test_a_plain_skin_is_made_of_the_shells_vertices_and_first_faces(both: tuple[Path, Path]) -> None:
    packed, plain = (read_asset(folder) for folder in both)
    skin, shells = (packed.primitive(packed.fur[name]) for name in ("skin", "shells"))
    assert set(skin["attributes"]) == {"POSITION", "NORMAL"}
    assert skin["attributes"].items() <= shells["attributes"].items()
    own, all_of_them = (packed.accessor(part["indices"]) for part in (skin, shells))
    np.testing.assert_array_equal(own, all_of_them[: len(own)])
    assert len(own) == 3 * plain.record["asset"]["skin"]["faces"] < len(all_of_them)
    assert len({packed.document["accessors"][part["indices"]]["bufferView"] for part in (skin, shells)}) == 1
    apart, below = (plain.primitive(plain.fur[name])["attributes"] for name in ("skin", "shells"))
    assert not set(apart.values()) & set(below.values())


def test_faces_of_the_skin_come_first_where_the_shells_have_all_of_them_and_no_others() -> None:
    square = np.array([[0, 1, 2], [0, 2, 3]])
    # The first face twice, the second time of further copies of its corners.
    faces, source = np.array([[0, 1, 2], [5, 2, 4], [4, 2, 3]]), np.array([0, 1, 2, 3, 0, 1])
    charts = Charts(source, faces, np.zeros((6, 4)), np.zeros((6, 2)), np.ones(6), np.arange(6))
    found = skin_first(charts, square)
    assert found is not None
    np.testing.assert_array_equal(found.faces, [[0, 1, 2], [4, 2, 3], [5, 2, 4]])
    assert skin_first(replace(charts, faces=faces[:2]), square) is None
    assert skin_first(charts, square[:1]) is None
    assert skin_first(charts, square[[0, 0, 1]]) is None


def test_threes_decoder_reads_the_same(both: tuple[Path, Path]) -> None:
    node = shutil.which("node")
    if node is None or not (khronos.ROOT / "node_modules" / "three").is_dir():
        pytest.skip("the web wing is not installed")
    command = [node, "--input-type=module", "-e", THREE, "--", str(both[0])]
    found = subprocess.run(command, capture_output=True, text=True, check=True, cwd=khronos.ROOT, timeout=60)
    asset = read_asset(both[0])
    for view, (record, own) in enumerate(zip(asset.document["bufferViews"], json.loads(found.stdout), strict=True)):
        mine, three = (np.frombuffer(data, np.int8).astype(int) for data in (asset.view(view), bytes.fromhex(own)))
        # Rounding of unit vectors differs.
        filtered = "filter" in record.get("extensions", {}).get(EXTENSION, {})
        assert np.abs(mine - three).max() <= (1 if filtered else 0)
    assert sum(EXTENSION in view.get("extensions", {}) for view in asset.document["bufferViews"]) == 3


def test_bits_say_which_edges_have_the_stored_fins(both: tuple[Path, Path]) -> None:
    packed, plain = (read_asset(folder) for folder in both)
    assert (packed.fur["version"], plain.fur["version"]) == ("2.2", "2.0")
    assert "fins" not in packed.fur
    positions = attributes(packed, "shells")["POSITION"]
    indices = packed.accessor(packed.primitive(packed.fur["shells"])["indices"])
    ends, _ = shell_edges(indices, positions)
    kept = np.unpackbits(packed.accessor(packed.fur["edges"]["mask"]), bitorder="little")[: len(ends)] == 1
    roots = attributes(plain, "fins")["POSITION"].reshape(-1, 4, 3)[:, :2]
    stored, made = (
        {tuple(sorted(map(tuple, pair.tolist()))) for pair in found} for found in (roots, positions[ends[kept]])
    )
    assert made == stored
    assert 0 < len(stored) == kept.sum()
    assert [summary(asset)["fins"]["faces"] for asset in (packed, plain)] == [2 * len(stored)] * 2


def test_fins_that_stand_elsewhere_have_no_mask() -> None:
    class Elsewhere:
        source = np.array([0, 3, 0, 3])

    corners, positions = np.array([[0, 1, 2]]), np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]])
    assert fin_mask(corners, positions, np.arange(3), Elsewhere()) is None  # type: ignore[arg-type]


def test_a_model_with_compressed_meshes_is_read(both: tuple[Path, Path]) -> None:
    packed, plain = (read(folder / "model.gltf") for folder in both)
    np.testing.assert_array_equal(*(np.unique(read.soup.vertices, axis=0) for read in (packed, plain)))
    assert len(packed.soup.faces) == len(plain.soup.faces)


def spoil(folder: Path, change: Callable[[dict[str, Any], bytearray], None]) -> Path:
    document, data = (
        json.loads((folder / "model.gltf").read_text("utf-8")),
        bytearray((folder / "model.bin").read_bytes()),
    )
    change(document, data)
    (folder / "model.gltf").write_text(json.dumps(document), "utf-8")
    (folder / "model.bin").write_bytes(data)
    return folder


def packed_view(document: dict[str, Any]) -> dict[str, Any]:
    found: dict[str, Any] = next(view for view in document["bufferViews"] if "extensions" in view)
    return found


def cut(document: dict[str, Any], data: bytearray) -> None:
    start = packed_view(document)["extensions"][EXTENSION]["byteOffset"]
    data[start : start + 8] = struct.pack("<Q", 0)


def more(document: dict[str, Any], _: bytearray) -> None:
    packed_view(document)["extensions"][EXTENSION]["count"] += 4


def huge(document: dict[str, Any], _: bytearray) -> None:
    packed_view(document)["extensions"][EXTENSION]["count"] = 10**12


def shorter(document: dict[str, Any], _: bytearray) -> None:
    document["accessors"][document["extensions"]["FUR_ptm_shells"]["edges"]["mask"]]["count"] -= 1


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (cut, "buffer view 2 cannot be decoded"),
        (more, "buffer view 2 "),
        (huge, "more than 250000000 bytes to read"),
        (shorter, "edges: a mask of "),
    ],
)
def test_broken_ones_are_told(both: tuple[Path, Path], tmp_path: Path, change: Any, message: str) -> None:
    shutil.copytree(both[0], tmp_path / "asset")
    problems = validate(spoil(tmp_path / "asset", change))
    assert any(message in problem for problem in problems), problems
    assert all("\n" not in problem for problem in problems)
