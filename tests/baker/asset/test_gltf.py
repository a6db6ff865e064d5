"""Written values are the given ones, within half a step of their bytes."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from furbake.asset.gltf import FurModel, dump, write_gltf
from furbake.asset.mesh.buffer import numbers
from furbake.asset.read import AssetError, inside, read_asset
from furbake.asset.stored import read_pelt
from furbake.asset.validate import schema
from furbake.pelt.hairs.states import PeltState
from furbake.pelt.pelt import Pelt
from furbake.pelt.texels.basis import Basis, environment
from furbake.surface.lay.own import own_charts
from furbake.surface.place.fins import build_fins
from furbake.surface.place.thickness import length_by_thickness
from furbake.surface.place.vertex_fur import VertexFur
from furbake.surface.shapes import builtin
from helpers.gltf import lapped


def test_large_surfaces_take_32_bit_indices(write: Callable[..., Any]) -> None:
    torus = builtin("torus:257x257")
    assert len(torus.vertices) > 65535
    # Patches would take a hundred times as long as all else.
    asset, surface, *_ = write(surface=torus, charts=own_charts(torus, 0.2, "torus"))
    accessor = asset.document["accessors"][asset.primitive(0)["indices"]]
    assert accessor["componentType"] == 5125
    np.testing.assert_array_equal(asset.accessor(asset.primitive(0)["indices"]).reshape(-1, 3), surface.faces)


def test_document(write: Callable[..., Any]) -> None:
    asset, surface, charts, record = write()
    document = asset.document
    assert document["asset"] == {"version": "2.0", "generator": "furbake 0.1.0"}
    assert document["extensionsUsed"] == ["FUR_ptm_shells", "KHR_mesh_quantization"]
    assert document["extensionsRequired"] == ["KHR_mesh_quantization"]  # the fur itself is optional
    assert document["scenes"] == [{"nodes": [0]}]
    assert [node["name"] for node in document["nodes"]] == ["skin", "shells"]
    assert "material" not in document["meshes"][1]["primitives"][0]
    assert document["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] == [1, 1, 1, 1]
    assert [image["uri"] for image in document["images"]] == ["plane0.png", "plane1.png", "colour.png"]
    assert record["skin"] == {"vertices": len(surface.vertices), "faces": len(surface.faces)}
    assert record["shells"] == {"vertices": len(charts.source), "faces": len(charts.faces)}
    assert set(record["bytes"]) == {file.name for file in asset.folder.iterdir()}
    assert all((asset.folder / name).stat().st_size == size for name, size in record["bytes"].items())


def test_base_colour_is_kept(write: Callable[..., Any]) -> None:
    surface = replace(builtin("plane"), colour=(0.4, 0.2, 0.1))
    asset, *_ = write(surface=surface)
    assert asset.document["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] == [0.4, 0.2, 0.1, 1]


@pytest.mark.parametrize(("coefficients", "kind"), [(6, "ptm"), (6, "eigen"), (4, "eigen"), (3, "eigen")])
def test_extension_holds_the_pelt(
    write: Callable[..., Any], make_pelt: Callable[..., Pelt], coefficients: int, kind: str
) -> None:
    pelt = make_pelt(coefficients=coefficients, kind=kind, colour=coefficients == 6)
    asset, *_ = write("plane", pelt=pelt)
    fur = asset.fur
    assert list(schema().iter_errors(fur)) == []
    assert (fur["layers"], fur["size"], fur["coefficients"]) == (4, 8, coefficients)
    assert (fur["length"], fur["height"]) == (0.12, 0.6)
    assert fur["basis"]["kind"] == kind
    state = fur["pelts"][0]
    assert state["planes"] == ([0] if coefficients == 3 else [0, 1])
    assert state.get("colour") == (2 if coefficients == 6 else None)
    np.testing.assert_allclose(state["scale"], pelt.scale, rtol=1e-8)
    np.testing.assert_allclose(state["bias"], pelt.bias, rtol=1e-8)
    np.testing.assert_allclose(fur["environment"], environment(pelt.basis), rtol=1e-8)
    np.testing.assert_allclose(fur["drift"], pelt.drift, rtol=1e-8)
    if kind == "eigen":
        assert pelt.basis.matrix is not None
        np.testing.assert_allclose(fur["basis"]["matrix"], pelt.basis.matrix, rtol=1e-8)


def test_eigen_needs_its_matrix(write: Callable[..., Any], make_pelt: Callable[..., Pelt]) -> None:
    with pytest.raises(ValueError, match="got eigen without its matrix"):
        write("plane", pelt=replace(make_pelt(kind="eigen"), basis=Basis("eigen")))


def test_same_input_same_bytes(tmp_path: Path, make_pelt: Callable[..., Pelt]) -> None:
    surface = builtin("sphere")
    fur = replace(VertexFur.even(len(surface.vertices)), lengths=length_by_thickness(surface))
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
        fins = build_fins(surface, np.roll(surface.normals, 1, axis=1), 0.2)
        write_gltf(tmp_path / name, FurModel(surface, lapped(surface), fur, (make_pelt(),), 0.1, fins))
    for file in (tmp_path / "a").iterdir():
        assert file.read_bytes() == (tmp_path / "b" / file.name).read_bytes()


@given(st.lists(st.floats(allow_nan=False, allow_infinity=False, width=32)))
def test_numbers_hold_32_bit_floats(values: list[float]) -> None:
    back = np.array(json.loads(dump(numbers(np.array(values)))), dtype=np.float32)
    np.testing.assert_array_equal(back, np.array(values, dtype=np.float32))


def test_dump_keeps_flat_lists_in_one_line_and_refuses_nan() -> None:
    assert dump({"a": [1.5, 2.5], "b": [{"c": [1]}]}) == '{\n "a": [1.5, 2.5],\n "b": [\n  {\n   "c": [1]\n  }\n ]\n}\n'
    with pytest.raises(ValueError, match="not JSON compliant"):
        dump({"a": float("nan")})


@pytest.mark.parametrize("uri", ["../x.png", "/etc/passwd", "http://x/y.png", "data:,x", "", ".", "a/b.png", 3, None])
def test_uris_stay_in_the_folder(tmp_path: Path, uri: Any) -> None:
    with pytest.raises(AssetError, match="expected the name of a file in the folder"):
        inside(tmp_path, uri)


def test_states_come_back(tmp_path: Path, make_pelt: Callable[..., Pelt]) -> None:
    wet = PeltState("wet", wetness=0.75, length=0.9, shade=0.6, gloss=2.0, sharpness=3.0)
    dirty = PeltState("dirty", dirt=1.0, mud=(0.1, 0.05, 0.02))
    dry = make_pelt()
    others = (
        replace(make_pelt(seed=1), scale=dry.scale, bias=dry.bias, state=wet, height=0.9 * dry.height),
        replace(make_pelt(seed=2, colour=False), scale=dry.scale, bias=dry.bias, state=dirty),
    )
    surface = builtin("plane")
    fur = VertexFur.even(len(surface.vertices))
    write_gltf(tmp_path, FurModel(surface, lapped(surface), fur, (dry, *others), 0.1))
    asset = read_asset(tmp_path)
    assert asset.fur["version"] == "1.1"
    assert asset.fur["mud"] == [0.1, 0.05, 0.02]
    assert not list(schema().iter_errors(asset.fur))
    uris = [image["uri"] for image in asset.document["images"]]
    assert [uri for uri in uris if "plane" in uri] == [
        "plane0.png", "plane1.png", "wet-plane0.png", "wet-plane1.png", "dirty-plane0.png", "dirty-plane1.png",
    ]  # fmt: skip
    for i, pelt in enumerate((dry, *others)):
        back = read_pelt(asset, i)
        np.testing.assert_array_equal(back.codes, pelt.codes)
        np.testing.assert_array_equal(back.tint, pelt.tint)
        assert back.state == pelt.state
        assert back.height == pytest.approx(pelt.height, rel=1e-6)
        assert (back.colour is None) == (pelt.colour is None)


def test_one_state_is_written_as_ever(write: Callable[..., Any]) -> None:
    asset, *_ = write("plane")
    assert asset.fur["version"] == "1.0"
    assert "mud" not in asset.fur
    assert set(asset.fur["pelts"][0]) == {"name", "planes", "scale", "bias", "colour"}
