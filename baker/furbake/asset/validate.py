"""Checks of a baked folder: schema, references, sizes, ranges; every problem in one sentence."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np
from jsonschema import Draft202012Validator

from furbake.asset.extension import EXTENSION
from furbake.asset.gltf import QUANTIZATION
from furbake.asset.mesh.buffer import MESHOPT
from furbake.asset.mesh.edges import shell_edges
from furbake.asset.planes import PlaneError
from furbake.asset.read import Asset, AssetError, inside, read_asset
from furbake.asset.regions.check import regions
from furbake.asset.regions.parted import REGION
from furbake.asset.rig.check import clips, drawn, joints, targets, tree
from furbake.asset.roots.check import roots
from furbake.asset.validate_pelts import curves, multiple, pelts, states

REQUIRED = ("POSITION", "NORMAL", "TANGENT", "TEXCOORD_0")
ATTRIBUTES = {
    "shells": (REQUIRED, {*REQUIRED, "COLOR_0", "_FUR", "_COMB", REGION}),
    "fins": ((*REQUIRED, "_EDGE"), {*REQUIRED, "TEXCOORD_1", "COLOR_0", "_FUR", "_EDGE", REGION}),
}
"""Attributes of the fur's vertices, required and optional."""

JOINTS = ("JOINTS_0", "WEIGHTS_0")
"""Further attributes where the node has a skin."""

BESIDE = {*JOINTS, REGION}
"""Attributes that do not count as the vertex' own."""

MAX_VERTEX_BYTES = 36
"""Bytes of a shell or fin vertex, its joints, weights and regions aside."""

MAX_JOINT_BYTES = 12
"""Bytes of the joints and weights of a vertex: 8, and 12 where there are more joints than a byte numbers."""

UNIT = 0.02
"""Tolerance of a normal's length: bytes hold it to 1/127 per component."""

FIGURES = (
    "psnr", "psnr_worst_layer", "psnr_composite", "r2", "psnr_quantised", "psnr_quantised_composite",
    "psnr_quantisation",
)  # fmt: skip


def validate(folder: Path) -> list[str]:
    """Problems of a baked folder; empty if it is valid."""
    try:
        asset = read_asset(folder)
        fur = asset.fur
    except AssetError as error:
        return [str(error)]
    problems = [f"{EXTENSION}: {_where(error)}{error.message}" for error in schema().iter_errors(fur)]
    if problems:  # the other checks need a document that fits the schema
        return problems
    checks = (
        _document,
        tree,
        _nodes,
        _skin,
        _shells,
        _fins,
        roots,
        joints,
        targets,
        clips,
        pelts,
        curves,
        multiple,
        states,
        regions,
        _record,
    )
    for check in checks:
        try:
            problems.extend(check(asset))
        except (AssetError, PlaneError) as error:
            problems.append(str(error))
        except (LookupError, TypeError, ValueError, AttributeError) as error:
            what = check.__name__.strip("_")
            problems.append(f"model.gltf: {what} is malformed ({type(error).__name__}: {error}), expected valid glTF")
    return problems


def check(folder: Path) -> None:
    """Raise AssetError, with the first problem, for a folder that is not valid."""
    if problems := validate(folder):
        more = f"; {len(problems) - 1} more, see furbake validate" if problems[1:] else ""
        raise AssetError(f"{' '.join(problems[0].split())}{more}")


@cache
def schema() -> Draft202012Validator:
    """The extension's JSON schema, ready to check with."""
    text = (files("furbake.asset") / "schema" / f"{EXTENSION}.schema.json").read_text("utf-8")
    return Draft202012Validator(json.loads(text))


def _where(error: Any) -> str:
    path = "".join(f"[{step}]" if isinstance(step, int) else f".{step}" for step in error.absolute_path)
    return f"{path.lstrip('.')}: " if path else ""


def _document(asset: Asset) -> Iterator[str]:
    document = asset.document
    if document["asset"]["version"] != "2.0":
        yield f"model.gltf: glTF {document['asset']['version']}, expected 2.0"
    used, required = document.get("extensionsUsed", []), document.get("extensionsRequired", [])
    for name, listed in ((EXTENSION, used), (QUANTIZATION, used), (QUANTIZATION, required)):
        if name not in listed:
            yield f"model.gltf: {name} is not in {'extensionsUsed' if listed is used else 'extensionsRequired'}"
    spare = [buffer for buffer in document["buffers"][1:] if "uri" not in buffer and MESHOPT in required]
    if len(document["buffers"]) != 1 + len(spare) or len(spare) > 1:
        yield f"model.gltf: {len(document['buffers'])} buffers, expected 1, and one without data where some are packed"
    size = document["buffers"][0]["byteLength"]
    if size != len(asset.data):
        yield f"{document['buffers'][0]['uri']}: {len(asset.data)} bytes, expected {size}"


def _nodes(asset: Asset) -> Iterator[str]:
    fur, nodes = asset.fur, asset.document["nodes"]
    seen = drawn(asset)
    for name in ("skin", "shells", "fins"):
        if name not in fur:
            continue
        node = fur[name]
        if node >= len(nodes) or "mesh" not in nodes[node]:
            yield f"{EXTENSION}: {name} is node {node}, expected one of {len(nodes)} nodes that has a mesh"
        elif (name == "skin") != (node in seen):
            yield f"{EXTENSION}: {name} is node {node}, expected {'in the' if name == 'skin' else 'in no'} scene"


def _skin(asset: Asset) -> Iterator[str]:
    """The body and all other meshes of the scene: materials and pictures exist."""
    nodes, fur = asset.document["nodes"], asset.fur
    for index, node in enumerate(nodes):
        if "mesh" not in node or index in (fur["shells"], fur.get("fins")):
            continue
        name = "skin" if index == fur["skin"] else f"node {index}"
        for primitive in asset.primitives(index):
            yield from _primitive(asset, name, primitive, ("POSITION", "NORMAL"))
            yield from _material(asset, name, primitive)


def _material(asset: Asset, name: str, primitive: dict[str, Any]) -> Iterator[str]:
    if "material" not in primitive:
        return
    material = asset.document["materials"][primitive["material"]]
    texture = material.get("pbrMetallicRoughness", {}).get("baseColorTexture")
    if texture is None:
        return
    if f"TEXCOORD_{texture.get('texCoord', 0)}" not in primitive["attributes"]:
        yield f"{name}: a picture but no texture coordinates, expected TEXCOORD_0"
    uri = asset.document["images"][asset.document["textures"][texture["index"]]["source"]]["uri"]
    if not inside(asset.folder, uri).is_file():
        yield f"{uri}: no such file, expected a picture of the {name}"


def _shells(asset: Asset) -> Iterator[str]:
    yield from _furry(asset, "shells")
    primitive = asset.primitive(asset.fur["shells"])
    if "_FUR" in primitive["attributes"]:
        yield from _weights(asset, primitive)


def _fins(asset: Asset) -> Iterator[str]:
    drawn = "fins" in asset.fur or "edges" in asset.fur
    for i, pelt in enumerate(asset.fur["pelts"]):
        if ("fin" in pelt) != drawn:
            yield f"{EXTENSION}: pelts[{i}] has {'no ' if drawn else 'a '}fin, expected one where there are fins"
    if "fins" in asset.fur:
        yield from _furry(asset, "fins")
    if "edges" in asset.fur:
        yield from _edges(asset)


def _edges(asset: Asset) -> Iterator[str]:
    """The mask has a bit for every edge of the shells."""
    primitive = asset.primitive(asset.fur["shells"])
    faces, positions = (asset.accessor(i) for i in (primitive["indices"], primitive["attributes"]["POSITION"]))
    count = len(shell_edges(faces, positions)[0])
    mask = asset.accessor(asset.fur["edges"]["mask"])
    if mask.dtype != np.uint8 or mask.shape != (-(-count // 8),):
        yield f"edges: a mask of {mask.shape} {mask.dtype}, expected {-(-count // 8)} bytes for {count} edges"
    elif np.unpackbits(mask, bitorder="little")[count:].any():
        yield f"edges: the mask has bits beyond the {count} edges of the shells, expected 0 there"


def _furry(asset: Asset, name: str) -> Iterator[str]:
    """Checks that shells and fins have in common."""
    required, known = ATTRIBUTES[name]
    primitive = asset.primitive(asset.fur[name])
    yield from _primitive(asset, name, primitive, required)
    attributes = primitive["attributes"]
    known = known | (set(JOINTS) if "skin" in asset.document["nodes"][asset.fur[name]] else set())
    strange = sorted(set(attributes) - known)
    if strange:
        yield f"{name}: {', '.join(strange)}, expected only {', '.join(sorted(known))}"
    for names, most in ((set(attributes) - BESIDE, MAX_VERTEX_BYTES), (set(JOINTS), MAX_JOINT_BYTES)):
        weight = _weight(asset, [index for key, index in attributes.items() if key in names])
        if weight > most:
            yield f"{name}: {weight} bytes per vertex, expected at most {most}"
    signs = np.unique(asset.accessor(attributes["TANGENT"])[:, 3])
    if not set(signs.tolist()) <= {-127, 127, -1.0, 1.0}:
        yield f"{name}: TANGENT w of {signs[0]}, expected 1 or -1"


def _weight(asset: Asset, accessors: list[int]) -> int:
    """Bytes of a vertex in these accessors."""
    views = [asset.document["bufferViews"][asset.document["accessors"][i]["bufferView"]] for i in accessors]
    return sum(view["byteStride"] for view in {json.dumps(view, sort_keys=True): view for view in views}.values())


def _primitive(asset: Asset, name: str, primitive: dict[str, Any], required: tuple[str, ...]) -> Iterator[str]:
    attributes = primitive["attributes"]
    missing = [attribute for attribute in required if attribute not in attributes]
    if missing:
        yield f"{name}: no {', '.join(missing)}, expected {', '.join(required)}"
        return
    values = {attribute: asset.accessor(index) for attribute, index in attributes.items()}
    count = len(values["POSITION"])
    for attribute, array in values.items():
        if len(array) != count:
            yield f"{name}: {len(array)} values of {attribute}, expected {count} as of POSITION"
        if not np.isfinite(array).all():
            yield f"{name}: {attribute} is not finite, expected numbers"
    indices = asset.accessor(primitive["indices"])
    if len(indices) % 3 or indices.max() >= count:
        yield f"{name}: {len(indices)} indices up to {indices.max()}, expected triangles of vertices below {count}"
    for attribute in ("NORMAL", "TANGENT"):
        if attribute in values:
            vectors = values[attribute][:, :3].astype(np.float64)
            vectors /= 127.0 if values[attribute].dtype == np.int8 else 1.0
            off = float(np.abs(np.linalg.norm(vectors, axis=1) - 1.0).max())
            if off > UNIT:
                yield f"{name}: {attribute} is {off:.3f} off unit length, expected at most {UNIT}"
    bounds = asset.document["accessors"][attributes["POSITION"]]
    low, high = values["POSITION"].min(axis=0).tolist(), values["POSITION"].max(axis=0).tolist()
    if bounds.get("min") != low or bounds.get("max") != high:
        yield f"{name}: POSITION says {bounds.get('min')} to {bounds.get('max')}, expected {low} to {high}"


def _weights(asset: Asset, primitive: dict[str, Any]) -> Iterator[str]:
    """The weights of all copies of a face sum to 1 at each of its corners, of thinned fur to 1 at most."""
    attributes = primitive["attributes"]
    weights = asset.accessor(attributes["_FUR"])[:, 0]
    if weights.dtype != np.uint8:
        return
    _, place = np.unique(asset.accessor(attributes["POSITION"]), axis=0, return_inverse=True)
    corners = asset.accessor(primitive["indices"]).reshape(-1, 3).astype(np.int64)
    faces, shares = place.reshape(-1)[corners], weights[corners].astype(np.int64)
    turn = (np.argmin(faces, axis=1)[:, None] + np.arange(3)) % 3
    faces, shares = np.take_along_axis(faces, turn, axis=1), np.take_along_axis(shares, turn, axis=1)
    _, index = np.unique(faces, axis=0, return_inverse=True)
    total = np.stack([np.bincount(index.reshape(-1), shares[:, i]) for i in range(3)], axis=1)
    # Faces that quantisation has laid on top of each other count once each.
    thinned = asset.fur.get("thinned") is True
    wrong = total > 255 * np.bincount(index.reshape(-1))[:, None] if thinned else (total == 0) | (total % 255 != 0)
    if wrong.any():
        got = total[wrong][0] / 255.0
        yield f"shells: weights of _FUR sum to {got:.3f} at {int(wrong.sum())} corners, expected 1"


def _record(asset: Asset) -> Iterator[str]:
    record = asset.record
    missing = [key for key in ("furbake", "libraries", "options", "input", "key", "fit") if key not in record]
    if missing:
        yield f"bake.json: no {', '.join(missing)}, expected the record of the bake"
        return
    figures = {name: record["fit"].get(name) for name in FIGURES}
    bound = record["fit"].get("bound", {})
    figures |= {f"bound.{name}": bound.get(name) for name in ("rank", "psnr", "psnr_composite")}
    for name, value in figures.items():
        if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
            yield f"bake.json: fit.{name} is {value!r}, expected a number"
