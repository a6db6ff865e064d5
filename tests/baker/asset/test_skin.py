"""The body wears what the model wore: its materials, its pictures byte for byte, its coordinates and colours."""

from __future__ import annotations

import io
import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from PIL import Image

from furbake.asset.gltf import FurModel, write_gltf
from furbake.asset.inspect import summary
from furbake.asset.read import Asset, read_asset
from furbake.asset.stored import read_pelt, skin_colour
from furbake.asset.validate import validate
from furbake.pelt.pelt import Pelt
from furbake.surface.charts import Charts
from furbake.surface.lay.field import comb_field
from furbake.surface.lay.lapped import lap
from furbake.surface.material import CLAMP, MIRROR, REPEAT, Material, Picture, Skin
from furbake.surface.mesh import Surface, load_mesh
from furbake.surface.place.features import Feature
from furbake.surface.place.vertex_fur import VertexFur
from furbake.surface.shapes import builtin
from helpers.khronos import issues


def lapped(surface: Surface) -> Charts:
    return lap(surface, comb_field(surface).direction, 0.2)


@pytest.fixture
def write(tmp_path: Path, make_pelt: Callable[..., Pelt]) -> Callable[..., Asset]:
    def build(surface: Surface, fur: VertexFur | None = None, **rest: Any) -> Asset:
        folder = tmp_path / "asset"
        folder.mkdir()
        fur = fur or VertexFur.even(len(surface.vertices))
        write_gltf(folder, FurModel(surface, lapped(surface), fur, (make_pelt(),), 0.12, **rest))
        document = {"furbake": "0", "libraries": {}, "options": {}, "input": {}, "key": "", "fit": figures()}
        (folder / "bake.json").write_text(json.dumps(document))
        return read_asset(folder)

    return build


def figures() -> dict[str, Any]:
    names = ("psnr", "psnr_worst_layer", "psnr_composite", "r2", "psnr_quantised", "psnr_quantised_composite")
    bound = {"rank": 1, "psnr": 1, "psnr_composite": 1}
    return dict.fromkeys((*names, "psnr_quantisation"), 1.0) | {"bound": bound}


def picture(kind: str = "PNG", alpha: int | None = None) -> Picture:
    pixels = np.random.default_rng(0).integers(0, 256, (8, 8, 3 if alpha is None else 4), dtype=np.uint8)
    if alpha is not None:
        pixels[..., 3] = alpha
    stream = io.BytesIO()
    Image.fromarray(pixels).save(stream, kind)
    return Picture(stream.getvalue(), f"image/{kind.lower()}")


def halves(*materials: Material, colour: bool = False) -> Surface:
    """A sphere cut into one piece per material, with coordinates where there is a picture."""
    ball = builtin("sphere")
    pieces = []
    for i, material in enumerate(materials):
        source, faces = np.unique(ball.faces[i :: len(materials)], return_inverse=True)
        uv = ball.vertices[source][:, :2] * 3.0 if material.picture else None
        paint = np.abs(np.column_stack([ball.vertices[source], np.ones(len(source))])) if colour else None
        pieces.append(Skin(material, source, faces.reshape(-1, 3), uv, paint))
    return replace(ball, skin=tuple(pieces))


def test_skin_without_a_colour_takes_that_of_the_roots(write: Callable[..., Asset]) -> None:
    asset = write(builtin("sphere"), bare=(0.2, 0.1, 0.05))
    (skin,) = asset.document["materials"]
    assert skin["pbrMetallicRoughness"]["baseColorFactor"] == [0.2, 0.1, 0.05, 1]
    assert skin_colour(asset) == (1, 1, 1), "it doesn't tint the fur"
    assert validate(asset.folder) == []


def test_skin_with_a_colour_keeps_it(write: Callable[..., Asset]) -> None:
    asset = write(replace(builtin("sphere"), colour=(0.5, 0.25, 0.125)), bare=(0.2, 0.1, 0.05))
    assert asset.document["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] == [0.5, 0.25, 0.125, 1]
    assert skin_colour(asset) == (0.5, 0.25, 0.125)


def test_a_primitive_for_each_material(write: Callable[..., Asset]) -> None:
    fine = Material("wool", (0.5, 0.25, 0.125, 1.0), 0.25, 0.75, True, "MASK", 0.3, picture(), (CLAMP, MIRROR))
    surface = halves(fine, Material("leather", (0.1, 0.2, 0.3, 1.0)), colour=True)
    asset = write(surface)
    assert validate(asset.folder) == []
    first, second = asset.primitives(0)
    for primitive, piece in zip((first, second), surface.skin, strict=True):
        place, got = asset.document["nodes"][0], primitive["attributes"]
        back = np.array(place["translation"]) + np.array(place["scale"]) * asset.accessor(got["POSITION"]) / 65535
        assert np.abs(back - surface.vertices[piece.source]).max() < 1e-4
        np.testing.assert_array_equal(asset.accessor(primitive["indices"]).reshape(-1, 3), piece.faces)
        assert piece.colour is not None
        assert np.abs(asset.accessor(got["COLOR_0"]) / 65535 - piece.colour).max() < 1e-5
    assert surface.skin[0].uv is not None
    np.testing.assert_array_equal(asset.accessor(first["attributes"]["TEXCOORD_0"]), surface.skin[0].uv.astype("f4"))
    assert "TEXCOORD_0" not in second["attributes"]
    wool = asset.document["materials"][first["material"]]
    assert wool == {
        "name": "wool",
        "pbrMetallicRoughness": {
            "baseColorFactor": [0.5, 0.25, 0.125, 1],
            "metallicFactor": 0.25,
            "roughnessFactor": 0.75,
            "baseColorTexture": {"index": 0},
        },
        "doubleSided": True,
        "alphaMode": "MASK",
        "alphaCutoff": 0.3,
    }
    assert asset.document["samplers"] == [{"wrapS": CLAMP, "wrapT": MIRROR}]
    assert asset.document["materials"][second["material"]]["pbrMetallicRoughness"]["roughnessFactor"] == 1


def test_pictures_come_after_the_pelt_and_once_each(
    write: Callable[..., Asset], make_pelt: Callable[..., Pelt]
) -> None:
    png, jpeg = picture(), picture("JPEG")
    looks = [Material(picture=png), Material("b", picture=jpeg), Material("c", picture=png, wrap=(REPEAT, CLAMP))]
    asset = write(halves(*looks))
    uris = [image["uri"] for image in asset.document["images"]]
    assert uris == ["plane0.png", "plane1.png", "colour.png", "skin0.png", "skin1.jpg"]
    assert [texture["source"] for texture in asset.document["textures"]] == [3, 4, 3]
    assert (asset.folder / "skin0.png").read_bytes() == png.data
    assert (asset.folder / "skin1.jpg").read_bytes() == jpeg.data
    np.testing.assert_array_equal(read_pelt(asset).codes, make_pelt().codes)
    figures = summary(asset)
    assert figures["skin"]["faces"] == 5120
    assert figures["files"]["skin1.jpg"] == len(jpeg.data)
    (asset.folder / "skin1.jpg").unlink()
    assert validate(asset.folder) == ["skin1.jpg: no such file, expected a picture of the skin"]


def test_shells_bring_the_whole_colour_of_the_skin(write: Callable[..., Asset]) -> None:
    surface = halves(Material("a", (0.5, 0.25, 1.0, 1.0)), Material("b"))
    colour = np.random.default_rng(0).random((2562, 3))
    asset = write(surface, replace(VertexFur.even(2562), colour=colour))
    got = asset.accessor(asset.primitive(1)["attributes"]["COLOR_0"]) / 255
    source = lapped(surface).source
    assert np.abs(got - colour[source]).max() <= 0.5 / 255 + 1e-9
    np.testing.assert_allclose(skin_colour(asset), got.mean(axis=0), atol=1e-6)
    assert all("COLOR_0" not in primitive["attributes"] for primitive in asset.primitives(0))


def test_white_fur_over_skin_that_is_not_says_so(write: Callable[..., Asset]) -> None:
    asset = write(halves(Material("a", (0.5, 0.25, 1.0, 1.0)), Material("b")))
    assert (asset.accessor(asset.primitive(1)["attributes"]["COLOR_0"]) == 255).all()
    assert skin_colour(asset) == (1.0, 1.0, 1.0)


def test_an_exporters_grey_is_white_and_opaque(write: Callable[..., Asset]) -> None:
    asset = write(halves(Material("base", (0.8, 0.8, 0.8, 1.0), 0.0, 0.5, True, "BLEND")))
    assert asset.document["materials"] == [
        {
            "name": "base",
            "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 1], "metallicFactor": 0, "roughnessFactor": 0.5},
            "doubleSided": True,
        }
    ]
    assert "COLOR_0" not in asset.primitive(1)["attributes"]


@pytest.mark.parametrize(
    "material", [Material(factor=(1, 1, 1, 0.5), alpha="BLEND"), Material(alpha="BLEND", picture=picture(alpha=90))]
)
def test_what_lets_light_through_stays_so(write: Callable[..., Asset], material: Material) -> None:
    assert write(halves(material)).document["materials"][0]["alphaMode"] == "BLEND"


def test_names_are_text(write: Callable[..., Asset]) -> None:
    asset = write(halves(Material("\ud800 [x]"), Material("")))
    assert [material["name"] for material in asset.document["materials"]] == ["? [x]", "skin"]


def test_features_are_nodes_of_the_scene(write: Callable[..., Asset]) -> None:
    eye = Feature("eye", (0.0, 0.2, 2.0), (0.1, 0.2, 0.05), (1.0, 0.0, 0.0), colour=(0.1, 0.0, 0.2), roughness=0.25)
    nose = Feature("nose", (0.0, 0.0, 3.0), (0.2, 0.1, 0.1), on=True)
    asset = write(builtin("sphere"), features=(eye, nose))
    assert validate(asset.folder) == []
    document = asset.document
    assert document["scenes"] == [{"nodes": [0, 2, 3]}]
    assert [node["name"] for node in document["nodes"]] == ["skin", "shells", "eye", "nose"]
    node = document["nodes"][2]
    assert (node["translation"], node["scale"]) == ([0, 0.2, 2], [0.1, 0.2, 0.05])
    np.testing.assert_allclose(node["rotation"], [0, np.sqrt(0.5), 0, np.sqrt(0.5)], atol=1e-8)  # +z to +x
    np.testing.assert_allclose(document["nodes"][3]["translation"], [0, 0, 1], atol=1e-3)
    one, two = asset.primitive(2), asset.primitive(3)
    assert one["attributes"] == two["attributes"]
    ball = asset.accessor(one["attributes"]["POSITION"]) / 32767
    np.testing.assert_allclose(np.linalg.norm(ball, axis=1), 1, atol=1e-4)
    assert len(asset.accessor(one["indices"])) == 3 * 320
    material = document["materials"][one["material"]]
    assert material["pbrMetallicRoughness"]["baseColorFactor"] == [0.1, 0, 0.2, 1]
    assert material["pbrMetallicRoughness"]["roughnessFactor"] == 0.25


def two_looks(path: Path) -> Path:
    """A GLB of two boxes: one with a picture, one plain."""
    image = Image.open(io.BytesIO(picture().data))
    box, other = trimesh.creation.box(), trimesh.creation.icosphere(2)
    looks = trimesh.visual.material.PBRMaterial(name="checks", baseColorTexture=image, roughnessFactor=0.5)
    box.visual = trimesh.visual.TextureVisuals(uv=box.vertices[:, :2] + 0.5, material=looks)
    plain = trimesh.visual.material.PBRMaterial(name="red", baseColorFactor=[200, 10, 10, 255], metallicFactor=0.0)
    other.visual = trimesh.visual.TextureVisuals(uv=other.vertices[:, :2], material=plain)
    other.apply_translation([3, 0, 0])
    trimesh.Scene({"box": box, "ball": other}).export(path)
    return path


def test_the_khronos_validator_finds_no_error(write: Callable[..., Asset], tmp_path: Path) -> None:
    surface = load_mesh(two_looks(tmp_path / "two.glb"))
    assert len(surface.skin) == 2
    assert surface.colours is not None
    fur = replace(VertexFur.even(len(surface.vertices)), colour=surface.colours)
    eye = Feature("eye", (0.0, 2.0, 0.0), (0.1, 0.2, 0.1))
    asset = write(surface, fur, features=(eye,))
    assert validate(asset.folder) == []
    assert len(asset.primitives(0)) == 2
    assert issues(asset.folder) == []
