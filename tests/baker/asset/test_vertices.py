from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from furbake.asset.mesh.vertices import grid, quantise_positions, quantise_weights, shifted_by_tiles, signed
from furbake.asset.read import Asset
from furbake.surface.lay.own import own_charts
from furbake.surface.place.fins import build_fins
from furbake.surface.place.vertex_fur import FARTHEST, VertexFur
from furbake.surface.shapes import builtin
from helpers.gltf import lapped


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
    uv = shifted_by_tiles(charts)
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
    turned = attribute(asset, 2, "_FUR")[:, 0] / 255.0 - fins.laid / (2 * np.pi)
    assert np.abs(turned - np.rint(turned)).max() <= 0.5 / 255 + 1e-12
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
    asset, *_ = write(surface=skin, ground=base, fur=uneven(len(base.vertices)))
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
