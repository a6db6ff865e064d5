"""A good folder has no problem; every way to spoil it has one, in a sentence."""

from __future__ import annotations

import contextlib
import json
import shutil
from collections.abc import Callable, Iterator
from copy import deepcopy
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from jsonschema import Draft202012Validator

from furbake import BakeOptions, bake
from furbake.asset.inspect import summary
from furbake.asset.planes import write_png
from furbake.asset.read import AssetError, read_asset
from furbake.asset.stored import read_pelt
from furbake.asset.validate import schema, validate


@pytest.fixture
def spoil(good: Path, tmp_path: Path) -> Callable[..., Path]:
    """Change the glTF of a copy, by a function of its document: spoil(lambda document: ...)."""

    def change(edit: Any = lambda document: None) -> Path:
        folder = tmp_path / "asset"
        shutil.copytree(good, folder)
        path = folder / "model.gltf"
        document = json.loads(path.read_text())
        edit(document)
        path.write_text(json.dumps(document))
        return folder

    return change


def fur(document: dict[str, Any]) -> Any:
    return document["extensions"]["FUR_ptm_shells"]


def side(document: dict[str, Any]) -> Any:
    return fur(document)["pelts"][0]["fin"]


def shells(document: dict[str, Any]) -> Any:
    return document["meshes"][1]["primitives"][0]["attributes"]


def put(target: Any, key: Any, value: Any) -> None:
    target[key] = value


def test_good(good: Path) -> None:
    assert validate(good) == []


def test_schema_is_a_schema() -> None:
    Draft202012Validator.check_schema(schema().schema)


EDITS = {
    "no extension": (lambda d: d.pop("extensions"), "model.gltf: no FUR_ptm_shells"),
    "newer version": (lambda d: put(fur(d), "version", "3.0"), "FUR_ptm_shells: version: '3.0' does not match"),
    "no curves": (lambda d: fur(d).pop("curves"), "FUR_ptm_shells: 'curves' is a required property"),
    "no weights": (lambda d: fur(d)["pelts"][0].pop("weights"), "pelts[0]: 'weights' is a required property"),
    "old version": (lambda d: put(fur(d), "version", "1.1"), "FUR_ptm_shells: 'environment' is a required property"),
    "short table": (lambda d: fur(d)["curves"]["even"][0][1].pop(), "curves.even[0][1]: [0"),
    "two bodies": (lambda d: fur(d)["curves"]["along"][0].pop(), "FUR_ptm_shells: curves.along[0]: [["),
    "a curve less": (lambda d: fur(d)["curves"]["along"].pop(), "curves.along has 3 tables, expected 4 as curves.even"),
    "light below": (lambda d: put(fur(d)["curves"]["even"][0][0], 0, 0.1), "curves.even is not 0 at the first knot"),
    "slabs unweighted": (lambda d: fur(d)["pelts"][0]["weights"].pop(), "pelts[0].weights has 3 rows, expected 4"),
    "curve unweighted": (lambda d: fur(d)["pelts"][0]["weights"][2].pop(), "pelts[0].weights has a row of 3 numbers"),
    "an environment": (
        lambda d: put(side(d), "environment", [[0] * 9] * 6),
        "an environment in version 2.0, expected none",
    ),
    "no layers": (lambda d: fur(d).pop("layers"), "FUR_ptm_shells: 'layers' is a required property"),
    "zero size": (lambda d: put(fur(d), "size", 0), "FUR_ptm_shells: size: 0 is less than the minimum of 8"),
    "odd size": (lambda d: put(fur(d), "size", 12), "FUR_ptm_shells: size 12, expected a power of two"),
    "text as length": (lambda d: put(fur(d), "length", "long"), "FUR_ptm_shells: length: 'long' is not of type"),
    "other layers": (lambda d: put(fur(d), "layers", 5), "FUR_ptm_shells: drift has 4 rows, expected 5"),
    "other size": (lambda d: put(fur(d), "size", 16), "plane0.png: 8 × 32 texels with 4 channels, expected 16 × 64"),
    "short scale": (lambda d: fur(d)["pelts"][0]["scale"].pop(), "pelts[0].scale has 5 rows, expected 6"),
    "no planes": (lambda d: put(fur(d)["pelts"][0], "planes", []), "FUR_ptm_shells: pelts[0].planes: [] should be"),
    "one plane": (lambda d: fur(d)["pelts"][0]["planes"].pop(), "pelts[0].planes has 1 rows, expected 2"),
    "image 9": (lambda d: put(fur(d)["pelts"][0], "planes", [0, 9]), "a pelt uses image 9, expected one of 6"),
    "skin is shells": (lambda d: put(fur(d), "skin", 1), "skin is node 1, expected in the scene"),
    "no such node": (lambda d: put(fur(d), "shells", 7), "shells is node 7, expected one of 3 nodes"),
    "shells drawn": (lambda d: put(d["scenes"][0], "nodes", [0, 1]), "shells is node 1, expected in no scene"),
    "no tangents": (lambda d: d["meshes"][1]["primitives"][0]["attributes"].pop("TANGENT"), "shells: no TANGENT"),
    "not required": (lambda d: d.pop("extensionsRequired"), "KHR_mesh_quantization is not in extensionsRequired"),
    "not used": (lambda d: d["extensionsUsed"].pop(0), "FUR_ptm_shells is not in extensionsUsed"),
    "long buffer": (lambda d: put(d["buffers"][0], "byteLength", 9), "bytes, expected 9"),
    "path": (lambda d: put(d["images"][0], "uri", "../plane0.png"), "uri '../plane0.png', expected the name"),
    "no buffer": (lambda d: d.pop("buffers"), "model.gltf: no buffer"),
    "no accessors": (lambda d: d.pop("accessors"), "is malformed (KeyError: 'accessors')"),
    "far accessor": (lambda d: put(d["accessors"][0], "count", 10**9), "accessor 0 leaves its buffer"),
    "negative": (lambda d: put(d["accessors"][0], "byteOffset", -4), "got -4, expected a number 0, 1, 2"),
    "wrong bounds": (lambda d: put(d["accessors"][0], "max", [1, 2, 3]), "shells: POSITION says"),
    "no fin": (lambda d: fur(d)["pelts"][0].pop("fin"), "pelts[0] has no fin, expected one where there are fins"),
    "no fins": (lambda d: fur(d).pop("fins"), "pelts[0] has a fin, expected one where there are fins"),
    "fins drawn": (lambda d: put(d["scenes"][0], "nodes", [0, 2]), "fins is node 2, expected in no scene"),
    "no edges": (lambda d: d["meshes"][2]["primitives"][0]["attributes"].pop("_EDGE"), "fins: no _EDGE, expected"),
    "wide fin": (lambda d: put(side(d), "width", 16), "fin0.png: 8 × 8 texels with 4 channels, expected 16 × 8"),
    "short fin": (lambda d: side(d)["scale"].pop(), "FUR_ptm_shells: fin.scale has 5 rows, expected 6"),
    "one fin plane": (lambda d: side(d)["planes"].pop(), "FUR_ptm_shells: fin.planes has 1 rows, expected 2"),
    "fin image 9": (lambda d: put(side(d), "colour", 9), "a pelt uses image 9, expected one of 6"),
    "no tile": (lambda d: put(fur(d), "tiles", 0), "FUR_ptm_shells: tiles: 0 is less than the minimum of 1"),
    "old attribute": (
        lambda d: put(shells(d), "_WEIGHT", shells(d).pop("_FUR")),
        "shells: _WEIGHT, expected only COLOR_0, NORMAL",
    ),
    "old glTF": (lambda d: put(d["asset"], "version", "1.0"), "model.gltf: glTF 1.0, expected 2.0"),
}


def test_directions(tmp_path: Path) -> None:
    folder = tmp_path / "asset"
    bake("plane", folder, BakeOptions(layers=4, size=8, lights=8, directions=True))
    assert validate(folder) == []
    found = summary(read_asset(folder))["fur"]
    assert found["direction plane"] is True
    assert found["texture bytes"] == 4 * (4 * 4 * 64 + 3 * 8 * 8)
    write_png(folder / "direction.png", np.zeros((24, 8, 3), np.uint8))
    assert validate(folder) == ["direction.png: 8 × 24 texels with 3 channels, expected 8 × 32 with 3"]
    with pytest.raises(AssetError, match="a plane is 8 x 24, expected 8 x 32"):
        read_pelt(read_asset(folder))
    path = folder / "model.gltf"
    document = json.loads(path.read_text())
    for reference, message in ((9, "a pelt uses image 9, expected one of 7"), ("up", "'up' is not of type 'integer'")):
        put(fur(document)["pelts"][0], "direction", reference)
        path.write_text(json.dumps(document))
        assert any(message in problem for problem in validate(folder)), validate(folder)


@pytest.mark.parametrize("name", EDITS)
def test_spoilt_document(spoil: Callable[..., Path], name: str) -> None:
    edit, message = EDITS[name]
    problems = validate(spoil(edit))
    assert any(message in problem for problem in problems), problems


def change_bytes(folder: Path, accessor: int, value: bytes, count: int = 4) -> None:
    asset = read_asset(folder)
    view = asset.document["bufferViews"][asset.document["accessors"][accessor]["bufferView"]]
    data = bytearray(asset.data)
    start = view["byteOffset"]
    data[start : start + count] = value * count
    (folder / "model.bin").write_bytes(data)


def test_weights_that_do_not_sum_to_one(spoil: Callable[..., Path]) -> None:
    folder = spoil()
    attributes = read_asset(folder).primitive(1)["attributes"]
    change_bytes(folder, attributes["_FUR"], b"\x11")
    assert any("shells: weights of _FUR sum to" in problem for problem in validate(folder))


def test_normals_that_are_not_unit(spoil: Callable[..., Path]) -> None:
    folder = spoil()
    change_bytes(folder, read_asset(folder).primitive(1)["attributes"]["NORMAL"], b"\x10")
    assert any("shells: NORMAL is" in problem for problem in validate(folder))


def test_texture_coordinates_that_are_not_finite(spoil: Callable[..., Path]) -> None:
    def as_floats(document: dict[str, Any]) -> None:
        accessor = document["accessors"][document["meshes"][1]["primitives"][0]["attributes"]["TEXCOORD_0"]]
        accessor |= {"componentType": 5126, "normalized": False, "count": accessor["count"] // 2}
        document["bufferViews"][accessor["bufferView"]]["byteStride"] = 8

    folder = spoil(as_floats)
    change_bytes(folder, read_asset(folder).primitive(1)["attributes"]["TEXCOORD_0"], b"\xff")
    assert "shells: TEXCOORD_0 is not finite, expected numbers" in validate(folder)


def test_indices_beyond_the_vertices(spoil: Callable[..., Path]) -> None:
    folder = spoil()
    asset = read_asset(folder)
    indices = asset.primitive(1)["indices"]
    change_bytes(folder, indices, b"\xf0")
    told = f"shells: {len(asset.accessor(indices))} indices up to 61680"
    assert any(told in problem for problem in validate(folder))


def test_missing_and_broken_files(spoil: Callable[..., Path]) -> None:
    folder = spoil()
    (folder / "plane1.png").unlink()
    assert any("plane1.png" in problem for problem in validate(folder))
    write_png(folder / "plane1.png", np.zeros((32, 8, 3), np.uint8))
    assert "plane1.png: 8 × 32 texels with 3 channels, expected 8 × 32 with 4" in validate(folder)
    (folder / "plane1.png").write_bytes(b"\x89PNG\r\n\x1a\nrest")
    assert any("plane1.png" in problem for problem in validate(folder))
    (folder / "model.bin").unlink()
    assert validate(folder) == ["model.bin: no such file or directory, expected the buffer"]
    (folder / "model.gltf").write_text("{")
    assert validate(folder)[0].startswith("model.gltf: not JSON")
    (folder / "model.gltf").write_text("[]")
    assert validate(folder) == ["model.gltf: a JSON list, expected an object"]
    (folder / "model.gltf").unlink()
    assert validate(folder) == [f"{folder}: holds no model.gltf, expected a folder that furbake wrote"]


def test_record(spoil: Callable[..., Path]) -> None:
    folder = spoil()
    path = folder / "bake.json"
    record = json.loads(path.read_text())
    del record["fit"]["bound"]["rank"]
    record["fit"]["psnr"] = "high"
    path.write_text(json.dumps(record))
    assert validate(folder) == [
        "bake.json: fit.psnr is 'high', expected a number",
        "bake.json: fit.bound.rank is None, expected a number",
    ]
    path.unlink()
    assert validate(folder)[0].startswith("bake.json: no furbake, libraries, options, input, key, fit")


JUNK = st.recursive(
    st.none() | st.booleans() | st.integers(-5, 10**10) | st.floats() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=3), inner, max_size=3),
    max_leaves=5,
)


def places(value: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """Every path into a JSON document."""
    steps = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, inner in steps:
        yield (*path, key)
        yield from places(inner, (*path, key))


@given(data=st.data())
def test_any_junk_anywhere_is_told_not_raised(good: Path, tmp_path_factory: pytest.TempPathFactory, data: Any) -> None:
    document = json.loads((good / "model.gltf").read_text())
    spoilt = deepcopy(document)
    *path, last = data.draw(st.sampled_from(list(places(document))))
    target = spoilt
    for step in path:
        target = target[step]
    target[last] = data.draw(JUNK)
    folder = tmp_path_factory.mktemp("junk") / "asset"
    shutil.copytree(good, folder)
    (folder / "model.gltf").write_text(json.dumps(spoilt))
    assert all(isinstance(problem, str) for problem in validate(folder))
    with contextlib.suppress(AssetError):
        json.dumps(summary(read_asset(folder)))


@pytest.fixture(scope="module")
def living(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("living") / "asset"
    bake("plane:1x1", folder, BakeOptions(layers=4, size=8, lights=8, states=("dry", "soaked"), dirt=True))
    return folder


@pytest.mark.parametrize(
    ("edit", "problem"),
    [
        (lambda pelts, fur: pelts[0].update(wetness=0.5), "pelts[0] is not dry and clean"),
        (lambda pelts, fur: pelts[1].update(name="dry"), "names that differ"),
        (lambda pelts, fur: fur.pop("mud"), "there is no mud"),
        (lambda pelts, fur: pelts[1].update(wetness=0), "wetness 0, 0, expected one that rises"),
        (lambda pelts, fur: pelts[2].update(wetness=0.5), "pelt dirty is wet and dirty"),
        (lambda pelts, fur: pelts.append(pelts[2] | {"name": "dirtier"}), "2 pelts are dirty, expected one"),
        (lambda pelts, fur: pelts[1].pop("colour"), "one of pelts[0] and pelts[1] has no colour"),
        (lambda pelts, fur: pelts[1]["scale"].__setitem__(2, 9.0), "pelts[1].scale differs"),
        (lambda pelts, fur: pelts[2]["fin"]["bias"].__setitem__(0, 9.0), "pelts[2].fin.bias differs"),
        (lambda pelts, fur: pelts[1].update(wetness=1.5), "1.5 is greater than the maximum"),
        (lambda pelts, fur: pelts[1].update(length=0), "0 is less than or equal to the minimum"),
        (lambda pelts, fur: pelts[1].update(planes=pelts[1]["planes"][:1]), "pelts[1].planes has 1 rows"),
        (lambda pelts, fur: fur.update(mud=[2, 0, 0]), "2 is greater than the maximum"),
    ],
)
def test_states_that_cannot_be_mixed(living: Path, tmp_path: Path, edit: Any, problem: str) -> None:
    assert validate(living) == []
    folder = Path(shutil.copytree(living, tmp_path / "asset"))
    document = json.loads((folder / "model.gltf").read_text())
    edit(fur(document)["pelts"], fur(document))
    (folder / "model.gltf").write_text(json.dumps(document))
    assert any(problem in found for found in validate(folder)), validate(folder)
