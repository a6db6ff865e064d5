"""What is written is what was meant, within half a step of its bytes."""

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

from furbake.asset.buffer import numbers
from furbake.asset.gltf import dump, write_gltf
from furbake.asset.read import Asset, AssetError, inside, read_asset
from furbake.asset.stored import read_pelt
from furbake.asset.validate import schema
from furbake.asset.vertices import grid, quantise_positions, quantise_weights, settle, signed
from furbake.pelt.basis import environment
from furbake.pelt.pelt import Pelt, State
from furbake.surface.charts import Charts
from furbake.surface.coat import FARTHEST, VertexFur
from furbake.surface.field import comb_field
from furbake.surface.fins import build_fins
from furbake.surface.lapped import lap
from furbake.surface.mesh import Surface
from furbake.surface.own import own_charts
from furbake.surface.shapes import builtin
from furbake.surface.thickness import length_by_thickness


def lapped(surface: Surface) -> Charts:
    return lap(surface, comb_field(surface).direction, 0.2)


@pytest.fixture
def write(tmp_path: Path, make_pelt: Callable[..., Pelt]) -> Callable[..., Any]:
    def build(name: str = "sphere", fur: Any = None, pelt: Any = None, surface: Any = None, **rest: Any) -> Any:
        surface = surface or builtin(name)
        charts = rest.pop("charts", None) or lapped(rest.get("base", surface))
        folder = tmp_path / "asset"
        folder.mkdir(exist_ok=True)
        fur = fur or VertexFur.even(len(rest.get("base", surface).vertices))
        record = write_gltf(folder, surface, charts, fur, pelt or make_pelt(), 0.12, **rest)
        return read_asset(folder), surface, charts, record

    return build


def attribute(asset: Asset, node: int, name: str) -> np.ndarray[Any, Any]:
    return asset.accessor(asset.primitive(node)["attributes"][name])


def uneven(count: int) -> VertexFur:
    """Fur whose every attribute differs from vertex to vertex."""
    chance = np.random.default_rng(0)
    comb, colour = chance.normal(0, 0.6, (count, 3)), chance.random((count, 3))
    return VertexFur(chance.random(count), chance.random(count), chance.random(count), comb, colour)


def test_shells_come_back(write: Callable[..., Any]) -> None:
    fur = uneven(2562)
    asset, surface, charts, _ = write(fur=fur)
    node = asset.document["nodes"][1]
    codes = attribute(asset, 1, "POSITION")
    back = np.array(node["translation"]) + np.array(node["scale"]) * codes / 65535
    assert np.abs(back - surface.vertices[charts.source]).max() <= surface.extent / 65535 / 2 * 1.001
    normals = attribute(asset, 1, "NORMAL") / 127.0
    assert np.abs(normals - surface.normals[charts.source]).max() <= 0.5 / 127 + 1e-12
    tangents = attribute(asset, 1, "TANGENT") / 127.0
    assert np.abs(tangents - charts.tangents).max() <= 0.5 / 127 + 1e-12
    assert set(np.unique(tangents[:, 3])) <= {-1.0, 1.0}
    tiles = asset.fur["tiles"]
    moved = attribute(asset, 1, "TEXCOORD_0") / 65535 * tiles - charts.uv
    assert np.abs(moved - np.rint(moved)).max() <= 0.5 * tiles / 65535 + 1e-9
    packed = attribute(asset, 1, "_FUR") / 255.0
    assert np.abs(packed[:, 0] - charts.weights).max() <= 1 / 255
    for channel, values in enumerate((fur.lengths, fur.occlusion, fur.tip)):
        assert np.abs(packed[:, 1 + channel] - values[charts.source]).max() <= 0.5 / 255 + 1e-12
    assert fur.colour is not None
    assert np.abs(attribute(asset, 1, "COLOR_0") / 255.0 - fur.colour[charts.source]).max() <= 0.5 / 255 + 1e-12
    np.testing.assert_array_equal(attribute(asset, 1, "COLOR_0"), attribute(asset, 0, "COLOR_0")[charts.source])
    np.testing.assert_array_equal(asset.accessor(asset.primitive(1)["indices"]).reshape(-1, 3), charts.faces)
    np.testing.assert_array_equal(asset.accessor(asset.primitive(0)["indices"]).reshape(-1, 3), surface.faces)


def test_combs_come_back_in_each_copys_frame(write: Callable[..., Any]) -> None:
    fur = uneven(2562)
    asset, surface, charts, _ = write(fur=fur)
    t, n = attribute(asset, 1, "TANGENT") / 127.0, surface.normals[charts.source]
    stored = attribute(asset, 1, "_COMB") / 127.0
    b = t[:, 3:] * np.cross(n, t[:, :3])
    comb = fur.comb[charts.source]
    flat = comb - n * np.einsum("ij,ij->i", comb, n)[:, None]
    flat *= np.minimum(1, FARTHEST / np.linalg.norm(flat, axis=1))[:, None]
    assert np.linalg.norm(stored[:, :1] * t[:, :3] + stored[:, 1:] * b - flat, axis=1).max() < 0.02


def test_patches_move_by_whole_tiles_to_where_coordinates_are_small() -> None:
    charts = lapped(builtin("sphere"))
    uv = settle(charts)
    moved = uv - charts.uv
    np.testing.assert_allclose(moved, np.rint(moved), atol=1e-9)
    assert (np.rint(moved)[charts.faces] == np.rint(moved)[charts.faces[:, :1]]).all()
    assert uv.min() >= 0
    assert uv.max() <= np.ptp(charts.uv, axis=0).max() + 1


def test_fins_come_back(write: Callable[..., Any]) -> None:
    surface, fur = builtin("sphere"), uneven(2562)
    laid = np.cross(surface.normals, np.cross([0.0, -1.0, 0.0], surface.normals))
    fins = build_fins(surface, laid / np.maximum(np.linalg.norm(laid, axis=1), 1e-9)[:, None], 0.2, 0.3)
    asset, *_, record = write(surface=surface, fur=fur, fins=fins)
    assert record["fins"] == {"vertices": len(fins.source), "faces": len(fins.faces)}
    assert asset.document["nodes"][asset.fur["fins"]]["name"] == "fins"
    skin = attribute(asset, 0, "POSITION")
    np.testing.assert_array_equal(attribute(asset, 2, "POSITION"), skin[fins.source])
    tangents = attribute(asset, 2, "TANGENT") / 127.0
    assert np.abs(tangents[:, :3] - fins.tangents).max() <= 0.5 / 127 + 1e-12
    assert (tangents[:, 3] == 1).all()
    tiles = asset.fur["tiles"]
    assert np.abs(attribute(asset, 2, "TEXCOORD_0") / 65535 * tiles - fins.uv).max() <= 0.5 * tiles / 65535 + 1e-9
    edge = attribute(asset, 2, "_EDGE") / 127.0
    assert np.abs(edge[:, :2] * np.pi - fins.angles).max() <= np.pi / 254 + 1e-12
    assert (attribute(asset, 2, "_FUR")[:, 0] == 255).all()
    np.testing.assert_array_equal(attribute(asset, 2, "COLOR_0"), attribute(asset, 0, "COLOR_0")[fins.source])
    np.testing.assert_array_equal(asset.accessor(asset.primitive(2)["indices"]).reshape(-1, 3), fins.faces)

    n, t = surface.normals[fins.source], fins.tangents
    across = np.cross(t, n)
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    comb = edge[:, 2:3] * np.cross(n, across) + edge[:, 3:] * across
    flat = fur.comb[fins.source] - n * np.einsum("ij,ij->i", fur.comb[fins.source], n)[:, None]
    flat *= np.minimum(1, FARTHEST / np.linalg.norm(flat, axis=1))[:, None]
    assert np.abs(comb - flat).max() < 0.02


def test_fur_may_stand_on_a_simpler_copy_of_the_skin(write: Callable[..., Any]) -> None:
    skin, base = builtin("torus:48x48"), builtin("torus:16x16")
    asset, *_ = write(surface=skin, base=base, fur=uneven(len(base.vertices)))
    assert len(attribute(asset, 0, "POSITION")) == len(skin.vertices)
    node = asset.document["nodes"][1]
    assert node["scale"] == asset.document["nodes"][0]["scale"]
    back = np.array(node["translation"]) + np.array(node["scale"]) * attribute(asset, 1, "POSITION") / 65535
    charts = lapped(base)
    assert np.abs(back - base.vertices[charts.source]).max() <= skin.extent / 65535 / 2 * 1.001
    assert "COLOR_0" not in asset.primitive(0)["attributes"]  # its vertices are others


def test_copies_of_a_vertex_are_equal_to_the_bit(write: Callable[..., Any]) -> None:
    asset, _, charts, _ = write()
    skin = attribute(asset, 0, "POSITION")
    np.testing.assert_array_equal(attribute(asset, 1, "POSITION"), skin[charts.source])
    for key in ("translation", "scale"):
        assert asset.document["nodes"][0][key] == asset.document["nodes"][1][key]
    assert len(set(asset.document["nodes"][1]["scale"])) == 1


def test_weights_of_copies_sum_to_255(write: Callable[..., Any]) -> None:
    asset, _, charts, _ = write()
    weights = attribute(asset, 1, "_FUR")[:, 0].astype(int)
    _, index = np.unique(charts.group, return_inverse=True)
    assert (np.bincount(index, weights) == 255).all()


@given(st.integers(0, 2**32 - 1))
def test_weights_sum_whatever_they_are(seed: int) -> None:
    chance = np.random.default_rng(seed)
    group = chance.integers(0, 30, 100) * 7
    weights = chance.random(100) ** 4
    totals = np.bincount(group, weights)
    weights /= totals[group]
    codes = quantise_weights(weights, group)
    sums = np.bincount(group, codes)
    assert (sums[np.unique(group)] == 255).all()
    assert np.abs(codes / 255.0 - weights).max() < 1 / 255


@given(st.integers(0, 2**32 - 1), st.floats(1e-6, 1e6))
def test_positions_stay_within_half_a_step(seed: int, size: float) -> None:
    vertices = size * np.random.default_rng(seed).normal(size=(50, 3)) + size
    offset, scale = grid(vertices)
    codes = quantise_positions(vertices, offset, scale)
    assert np.abs(offset + scale * codes / 65535.0 - vertices).max() <= 0.5001 * scale / 65535


def test_signed_bytes_leave_out_minus_128() -> None:
    assert signed(np.array([-1.0, 0.0, 1.0, -1.01])).tolist() == [-127, 0, 127, -127]


def test_trivial_attributes_are_left_out(write: Callable[..., Any]) -> None:
    torus = builtin("torus:8x12")
    asset, *_ = write(surface=torus, charts=own_charts(torus, 0.2, "torus"))
    assert set(asset.primitive(1)["attributes"]) == {"POSITION", "NORMAL", "TANGENT", "TEXCOORD_0"}
    asset, *_ = write("sphere")
    assert set(asset.primitive(1)["attributes"]) == {"POSITION", "NORMAL", "TANGENT", "TEXCOORD_0", "_FUR"}


def test_a_vertex_is_at_most_32_bytes_with_all_it_can_have(write: Callable[..., Any]) -> None:
    surface = builtin("sphere")
    fins = build_fins(surface, np.roll(surface.normals, 1, axis=1), 0.2)
    asset, *_ = write(fur=uneven(2562), fins=fins)
    for node in (1, 2):
        attributes = asset.primitive(node)["attributes"]
        assert len(attributes) == 7
        accessors = [asset.document["accessors"][i] for i in attributes.values()]
        assert all(accessor["normalized"] for accessor in accessors)
        views = [asset.document["bufferViews"][accessor["bufferView"]] for accessor in accessors]
        assert sum(view["byteStride"] for view in views) <= 32
        assert all(view["byteStride"] % 4 == 0 and view["byteOffset"] % 4 == 0 for view in views)


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
        assert pelt.matrix is not None
        np.testing.assert_allclose(fur["basis"]["matrix"], pelt.matrix, rtol=1e-8)


def test_eigen_needs_its_matrix(write: Callable[..., Any], make_pelt: Callable[..., Pelt]) -> None:
    with pytest.raises(ValueError, match="got eigen without its matrix"):
        write("plane", pelt=replace(make_pelt(kind="eigen"), matrix=None))


def test_same_input_same_bytes(tmp_path: Path, make_pelt: Callable[..., Pelt]) -> None:
    surface = builtin("sphere")
    fur = replace(VertexFur.even(len(surface.vertices)), lengths=length_by_thickness(surface))
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
        fins = build_fins(surface, np.roll(surface.normals, 1, axis=1), 0.2)
        write_gltf(tmp_path / name, surface, lapped(surface), fur, make_pelt(), 0.1, fins)
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
    wet = State("wet", wetness=0.75, length=0.9, shade=0.6, gloss=2.0, sharpness=3.0)
    dirty = State("dirty", dirt=1.0, mud=(0.1, 0.05, 0.02))
    dry = make_pelt()
    others = (
        replace(make_pelt(seed=1), scale=dry.scale, bias=dry.bias, state=wet, height=0.9 * dry.height),
        replace(make_pelt(seed=2, colour=False), scale=dry.scale, bias=dry.bias, state=dirty),
    )
    surface = builtin("plane")
    write_gltf(tmp_path, surface, lapped(surface), VertexFur.even(len(surface.vertices)), dry, 0.1, states=others)
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
