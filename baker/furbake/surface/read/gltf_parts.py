"""A primitive of a glTF file in its own space, and as triangles of the scene."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from furbake.surface.read.gltf_data import BROKEN, COMPRESSED, DRACO, GltfData, Record, UndecodableError
from furbake.surface.soup import Floats, Ints, MeshError, Soup

TRIANGLES, STRIP, FAN = 4, 5, 6

CORNERS = 3

PER_JOINED = 80
"""Numbers in memory for each vertex that joints move: the matrices of four joints, and their mean."""

STANDARD = ("POSITION", "NORMAL", "TANGENT", "TEXCOORD_", "COLOR_", "JOINTS_", "WEIGHTS_")

DIRECTIONS = ("_COMB", "_DIRECTION")
"""Attributes that are vectors in the node's space and turn with it."""

FARTHEST = 1e9
"""Displacements and weights of a target beyond this are taken for broken ones."""


@dataclass(frozen=True)
class Morph:
    """Displacements of a part by one target, in its own space; None: none. `broken`: there were some."""

    deltas: Floats | None = None
    broken: bool = False


@dataclass(frozen=True)
class Part:
    """A primitive of a node.

    node : its number; skin : the number of the skin that moves it, as the file has it, None: the node alone does
    soup : its triangles in its own space
    arrays : its attributes by their names in the file
    morphs : its targets
    """

    node: int
    skin: Any
    soup: Soup
    arrays: dict[str, Floats]
    morphs: tuple[Morph, ...]

    def placed(self, matrix: Floats) -> Soup:
        """Its triangles in the scene, with directions turned."""
        soup = self.soup
        vertices = soup.vertices @ matrix[:3, :3].T + matrix[:3, 3]
        attributes = _numbers(self.arrays, soup.faces, matrix)
        placed = Soup(vertices, soup.faces, soup.part, soup.uv, soup.paint, attributes)
        mirrored = np.linalg.det(matrix[:3, :3]) < 0.0
        return placed.turn(np.full(len(soup.faces), mirrored)) if mirrored else placed

    def influences(self) -> tuple[Floats, Floats] | None:
        """(V, n) joints and their weights as stored, of all sets; None where there are none."""
        joints: list[Floats] = []
        weights: list[Floats] = []
        while f"JOINTS_{len(joints)}" in self.arrays and f"WEIGHTS_{len(joints)}" in self.arrays:
            which, share = self.arrays[f"JOINTS_{len(joints)}"], self.arrays[f"WEIGHTS_{len(joints)}"]
            if which.shape != share.shape:
                break
            joints.append(which)
            weights.append(share)
        return (np.concatenate(joints, axis=1), np.concatenate(weights, axis=1)) if joints else None


def read_part(data: GltfData, record: Record, node: int, skin: Any, default: int) -> Part | None:
    """Triangles of a primitive in its own space; None for points and lines, and where it has none.

    default : number of the material of parts that name none
    """
    mode = record.get("mode", TRIANGLES)
    if mode not in (TRIANGLES, STRIP, FAN):
        return None
    extensions, attributes = record.get("extensions", {}), record["attributes"]
    squeezed: dict[str, Floats] = {}
    if DRACO in extensions:
        faces, squeezed = data.draco(extensions[DRACO])
    elif "indices" in record:
        faces = _faces(data.accessor(record["indices"]).reshape(-1).astype(np.int64), mode)
    else:
        count = int(data.item("accessors", attributes["POSITION"])["count"])
        data.numbers.take(count)
        faces = _faces(np.arange(count), mode)
    for name in (name for name in COMPRESSED if name in extensions):
        raise UndecodableError(name)

    arrays = {
        name: squeezed[name] if name in squeezed else data.accessor(index)
        for name, index in attributes.items()
        if not name.startswith(("NORMAL", "TANGENT"))
    }
    vertices = arrays["POSITION"]
    if vertices.shape[1] != 3 or any(len(values) != len(vertices) for values in arrays.values()):
        raise ValueError("attributes of different lengths")
    if len(faces) and faces.max() >= len(vertices):
        raise ValueError(f"a face uses vertex {faces.max()} of {len(vertices)}")
    data.numbers.take(CORNERS * len(faces) * sum(values.shape[1] for values in arrays.values()))
    if skin is not None:
        data.numbers.take(PER_JOINED * len(vertices))
    if not len(faces):
        return None
    soup = Soup(
        vertices=vertices,
        faces=faces,
        part=np.full(len(faces), record.get("material", default), dtype=np.int64),
        uv=_coordinates(data, record, arrays, faces),
        paint=_paint(arrays, faces),
    )
    targets = record.get("targets", [])
    morphs = tuple(_morph(data, target, len(vertices)) for target in targets) if isinstance(targets, list) else ()
    return Part(node, skin, soup, arrays, morphs)


def _morph(data: GltfData, target: Any, count: int) -> Morph:
    try:
        if "POSITION" not in target:
            return Morph()
        deltas = data.accessor(target["POSITION"])
    except MeshError:
        raise
    except BROKEN:
        return Morph(broken=True)
    whole = deltas.shape == (count, 3) and bool((np.abs(deltas) <= FARTHEST).all())
    return Morph(deltas) if whole else Morph(broken=True)


def _faces(corners: Ints, mode: int) -> Ints:
    if mode == TRIANGLES:
        return corners[: len(corners) // 3 * 3].reshape(-1, 3)
    if len(corners) < 3:
        return np.zeros((0, 3), dtype=np.int64)
    first, second, third = corners[:-2], corners[1:-1], corners[2:]
    if mode == FAN:
        return np.stack([np.full(len(third), corners[0]), second, third], axis=1)
    odd = np.arange(len(third)) % 2 == 1
    return np.stack([first, np.where(odd, third, second), np.where(odd, second, third)], axis=1)


def _numbers(arrays: dict[str, Floats], faces: Ints, place: Floats) -> dict[str, Floats]:
    """Further numbers of the corners by lower-case name; `color` has the vertex colours as stored."""
    numbers = {
        name.lstrip("_").lower(): values @ place[:3, :3].T if name in DIRECTIONS and values.shape[1] == 3 else values
        for name, values in arrays.items()
        if not name.startswith(STANDARD)
    }
    if "COLOR_0" in arrays:
        numbers["color"] = arrays["COLOR_0"]
    return {name: values[faces] for name, values in numbers.items() if np.isfinite(values).all()}


def _paint(arrays: dict[str, Floats], faces: Ints) -> Floats | None:
    rgb = arrays.get("COLOR_0")
    if rgb is None or rgb.shape[1] not in (3, 4):
        return None
    alpha = rgb[:, 3:4] if rgb.shape[1] == 4 else np.ones((len(rgb), 1))
    rgba = np.nan_to_num(np.concatenate([rgb[:, :3], alpha], axis=1), nan=1.0)
    return np.asarray(np.clip(rgba, 0.0, 1.0)[faces])


def _coordinates(data: GltfData, record: Record, arrays: dict[str, Floats], faces: Ints) -> Floats | None:
    """(F, 3, 2) the coordinates of the base colour's picture, its KHR_texture_transform applied, else the first set."""
    info: Record = {}
    if "material" in record:
        material = data.item("materials", record["material"])
        info = material.get("pbrMetallicRoughness", {}).get("baseColorTexture", {})
    shift = info.get("extensions", {}).get("KHR_texture_transform", {})
    name = f"TEXCOORD_{shift.get('texCoord', info.get('texCoord', 0))}"
    values = arrays.get(name, arrays.get("TEXCOORD_0"))
    if values is None or values.shape[1] != 2:
        return None
    values = values * np.array(shift.get("scale", (1, 1)), dtype=np.float64)
    sine, cosine = np.sin(shift.get("rotation", 0.0)), np.cos(shift.get("rotation", 0.0))
    values = values @ np.array([[cosine, -sine], [sine, cosine]]) + np.array(shift.get("offset", (0, 0)))
    return np.asarray(values[faces], dtype=np.float64)
