"""The body in glTF: the model's own materials and pictures on the skin, and the ordinary meshes beside it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from furbake.asset.mesh.buffer import Buffer, numbers
from furbake.asset.mesh.shared import shared_primitive
from furbake.asset.mesh.vertices import Attributes, deep_shares, shares, signed
from furbake.asset.rig.stand import Stand
from furbake.surface.colours import translucent
from furbake.surface.material import Material, Picture, Skin
from furbake.surface.mesh import RGB, WHITE, Surface
from furbake.surface.place.features import Feature, ball
from furbake.surface.place.vertex_fur import VertexFur

Record = dict[str, Any]

ENDINGS = {"image/png": "png", "image/jpeg": "jpg"}
"""File name endings of pictures by media type."""

ALIKE = 0.5 / 255.0
"""Colours nearer than this are one."""

FARTHEST = 1e6
"""Largest texture coordinate: beyond it 32-bit floats do not tell texels apart."""


@dataclass
class Looks:
    """Materials, textures and images of a document; their pictures are written into `folder`.

    images : names of the image files, those of the pelt first
    """

    folder: Path
    images: list[str]
    materials: list[Record] = field(default_factory=list)
    textures: list[Record] = field(default_factory=list)
    samplers: list[Record] = field(default_factory=list)
    _pictures: dict[Picture, int] = field(default_factory=dict)

    @property
    def records(self) -> Record:
        """The document's members; glTF wants no empty ones."""
        images = [{"name": Path(uri).stem, "uri": uri} for uri in self.images]
        members = {
            "materials": self.materials,
            "textures": self.textures,
            "images": images,
            "samplers": self.samplers,
        }
        return {name: records for name, records in members.items() if records}

    def material(self, material: Material, textured: bool) -> int:
        """Index of a material; without texture coordinates (`textured`) its picture is left out."""
        surface: Record = {
            "baseColorFactor": numbers(np.array(material.factor)),
            "metallicFactor": numbers(np.array([material.metallic]))[0],
            "roughnessFactor": numbers(np.array([material.roughness]))[0],
        }
        if textured and material.picture is not None:
            surface["baseColorTexture"] = {"index": self.texture(material.picture, material.wrap)}
        record: Record = {"name": _text(material.name) or "skin", "pbrMetallicRoughness": surface}
        if material.double_sided:
            record["doubleSided"] = True
        if material.alpha != "OPAQUE":
            record["alphaMode"] = material.alpha
        if material.alpha == "MASK":
            record["alphaCutoff"] = numbers(np.array([material.cutoff]))[0]
        return _index(self.materials, record)

    def texture(self, picture: Picture, wrap: tuple[int, int], stem: str | None = None) -> int:
        """Index of a texture; stem : of its file's name, by default `skin` and a number."""
        if picture not in self._pictures:
            name = f"{stem or f'skin{len(self._pictures)}'}.{ENDINGS[picture.kind]}"
            (self.folder / name).write_bytes(picture.data)
            self._pictures[picture] = len(self.images)
            self.images.append(name)
        sampler = _index(self.samplers, dict(zip(("wrapS", "wrapT"), wrap, strict=True)))
        return _index(self.textures, {"sampler": sampler, "source": self._pictures[picture]})


def bare_colour(surface: Surface, fur: VertexFur, bare: RGB | None) -> RGB:
    """Linear colour of a skin without materials: the surface's, or `bare` where nothing colours it."""
    coloured = surface.skin or surface.colour != WHITE or fur.colour is not None
    return surface.colour if coloured or bare is None else bare


def skin_primitives(
    stand: Stand,
    own: RGB,
    colours: NDArray[np.float64] | None,
    buffer: Buffer,
    looks: Looks,
    shells: tuple[Record, NDArray[np.int64]] | None = None,
) -> list[Record]:
    """The skin's primitives, one per material of the model; one in the surface's colour where it brings none.

    own : colour of a skin that brings no materials
    colours : (V, 3) linear, a factor of the colour of a skin that brings no materials
    shells : their primitive, of which a skin that brings no materials takes vertices and first faces, and (M,) the
        vertices of the skin that the shells' are copies of; None: the skin has its own
    """
    surface, normals = stand.surface, signed(stand.surface.normals)
    plain = Material("skin", factor=(*own, 1.0))
    if shells is not None:
        primitive = shared_primitive(*shells, len(surface.faces), colours, buffer)
        return [primitive | {"material": looks.material(plain, textured=False)}]
    if not surface.skin:
        all_of_it = np.arange(len(normals))
        body: Attributes = {"POSITION": stand.positions, "NORMAL": normals}
        if colours is not None:
            body["COLOR_0"] = shares(colours)
        body |= stand.joints(all_of_it)
        primitive = buffer.primitive(body, surface.faces) | stand.skin_targets(buffer, all_of_it)
        return [primitive | {"material": looks.material(plain, textured=False)}]
    return [
        buffer.primitive(_attributes(piece, stand.positions, normals) | stand.joints(piece.source), piece.faces)
        | stand.skin_targets(buffer, piece.source)
        | {"material": looks.material(_material(piece, surface), piece.uv is not None)}
        for piece in surface.skin
    ]


def fur_colour(surface: Surface, own: RGB, fur: VertexFur, tinted: bool = True) -> VertexFur:
    """The fur with the whole colour of the skin below it, or none where the skin's first material has it.

    own : as of `skin_primitives`; it colours no fur
    tinted : False for fur that is white, whatever the skin
    """
    first = _material(surface.skin[0], surface).factor[:3] if surface.skin else own
    whole = np.array(surface.colour) * (np.ones(3) if fur.colour is None else fur.colour)
    whole = fur.own if fur.own is not None else whole if tinted else np.ones(3)
    same = bool((np.abs(whole - np.array(first)) < ALIKE).all())
    return replace(fur, colour=None if same else np.broadcast_to(whole, (len(fur.lengths), 3)))


def feature_nodes(features: Iterable[Feature], buffer: Buffer, looks: Looks, meshes: list[Record]) -> list[Record]:
    """A node for each feature, placed and turned; all share the vertices of one ball of radius 1, or of half of it.

    meshes : of the document so far; those of the features are added, one per material
    """
    nodes: list[Record] = []
    shapes: dict[bool, Record] = {}
    for feature in features:
        if feature.half not in shapes:
            vertices, faces = ball(feature.half)
            # Normals of a ball are its positions.
            shapes[feature.half] = buffer.primitive({"POSITION": np.rint(32767.0 * vertices).astype(np.int16),
                                                     "NORMAL": signed(vertices)}, faces)  # fmt: skip
        wears = Material(feature.name, factor=(*feature.colour, 1.0), roughness=feature.roughness)
        mesh = {
            "name": _text(feature.name),
            "primitives": [shapes[feature.half] | {"material": looks.material(wears, textured=False)}],
        }
        meshes.append(mesh)
        nodes.append(
            {
                "name": mesh["name"],
                "mesh": len(meshes) - 1,
                "translation": numbers(np.array(feature.centre)),
                "rotation": numbers(feature.turn),
                "scale": numbers(np.array(feature.radii)),
            }
        )
    return nodes


def _attributes(piece: Skin, positions: NDArray[np.uint16], normals: NDArray[np.int8]) -> Attributes:
    found: Attributes = {"POSITION": positions[piece.source], "NORMAL": normals[piece.source]}
    if piece.uv is not None and piece.material.picture is not None:
        found["TEXCOORD_0"] = np.clip(piece.uv, -FARTHEST, FARTHEST).astype(np.float32)
    if piece.colour is not None:
        found["COLOR_0"] = deep_shares(piece.colour)
    return found


def _material(piece: Skin, surface: Surface) -> Material:
    """The model's own material, opaque unless some of it lets light through.

    Where it is all there is to the skin's colour, that is the surface's: an exporter's grey counts as white.
    """
    material = piece.material
    if material.alpha == "BLEND" and not translucent(piece):
        material = replace(material, alpha="OPAQUE")
    plain = len(surface.skin) == 1 and piece.colour is None and (piece.uv is None or material.picture is None)
    return replace(material, factor=(*surface.colour, material.factor[3])) if plain else material


def _text(name: str) -> str:
    """A name without lone surrogates, which UTF-8 cannot hold."""
    return name.encode("utf-8", "replace").decode()


def _index(records: list[Record], record: Record) -> int:
    """Index of a record in the list; a new one is appended."""
    if record not in records:
        records.append(record)
    return records.index(record)
