"""The body of a baked folder as an ordinary GLB, without fur or extensions, for programs that edit meshes."""

from __future__ import annotations

import json
import struct
from collections.abc import Iterator
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from furbake.asset.extension import EXTENSION
from furbake.asset.gltf import QUANTIZATION
from furbake.asset.mesh.buffer import MESHOPT
from furbake.asset.read import Asset, AssetError, inside, read_asset

OWN = (EXTENSION, MESHOPT, QUANTIZATION)
"""Extensions that the body alone does without."""

FLOAT = 5126
"""glTF's code of single precision."""

CHUNK_JSON, CHUNK_DATA = 0x4E4F534A, 0x004E4942


def write_plain(file: BinaryIO, folder: Path) -> None:
    """Write the skin, the features, their materials, joints, morph targets and clips as a GLB.

    Raises AssetError where the folder is no readable asset.
    """
    asset = read_asset(folder)
    try:
        document, data = _body(asset)
    except (LookupError, TypeError, AttributeError, ValueError) as error:
        if isinstance(error, AssetError):
            raise
        detail = f"{type(error).__name__}: {error}"
        raise AssetError(f"{folder}: malformed body ({detail}), see furbake validate") from error
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    file.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(data)))
    file.writelines(
        struct.pack("<II", len(chunk), kind) + chunk for kind, chunk in ((CHUNK_JSON, text), (CHUNK_DATA, data))
    )


def _body(asset: Asset) -> tuple[dict[str, Any], bytes]:
    """The glTF of the body and its buffer."""
    document = json.loads(json.dumps(asset.document))
    for name in ("extensions", "extensionsUsed", "extensionsRequired"):
        kept = document.pop(name, {})
        kept = {key: kept[key] for key in kept if key not in OWN} if isinstance(kept, dict) else set(kept) - set(OWN)
        if kept:
            document[name] = kept if isinstance(kept, dict) else sorted(kept)
    data = _Data(document)
    for primitive in asset.primitives(asset.fur["skin"]):
        data.weld(asset, primitive)
    gone = {asset.fur[name] for name in ("shells", "fins") if name in asset.fur}
    _drop_nodes(document, gone)
    _keep(document, "meshes", [(node, "mesh") for node in document["nodes"] if "mesh" in node])
    _keep(document, "images", [(texture, "source") for texture in document.get("textures", [])])
    seen: dict[tuple[int, bool], int] = {}
    for place, key, whole in _uses(document):
        wanted = place[key], whole
        if wanted not in seen:
            seen[wanted] = data.accessor(asset, *wanted)
        place[key] = seen[wanted]
    for image in document.get("images", []):
        data.image(image, asset)
    document |= {"accessors": data.accessors, "bufferViews": data.views, "buffers": [{"byteLength": len(data.bytes)}]}
    return document, bytes(data.bytes)


def _drop_nodes(document: dict[str, Any], gone: set[int]) -> None:
    """Take nodes out, and number all that names the others anew."""
    kept = [index for index in range(len(document["nodes"])) if index not in gone]
    new = {index: place for place, index in enumerate(kept)}
    document["nodes"] = [document["nodes"][index] for index in kept]
    for owner in [*document["scenes"], *document["nodes"], *document.get("skins", [])]:
        for name in ("nodes", "children"):
            if name in owner:
                owner[name] = [new[index] for index in owner[name] if index not in gone]
        if "joints" in owner:
            owner["joints"] = [new[index] for index in owner["joints"]]
        if "skeleton" in owner:
            owner["skeleton"] = new[owner["skeleton"]]
    for clip in document.get("animations", []):
        clip["channels"] = [one for one in clip["channels"] if one["target"]["node"] in new]
        for channel in clip["channels"]:
            channel["target"]["node"] = new[channel["target"]["node"]]


def _keep(document: dict[str, Any], name: str, uses: list[tuple[dict[str, Any], str]]) -> None:
    """Keep of a list of the document what is used, in its order."""
    order = sorted({place[key] for place, key in uses})
    for place, key in uses:
        place[key] = order.index(place[key])
    if kept := [document[name][index] for index in order]:
        document[name] = kept
    else:
        document.pop(name, None)


def _uses(document: dict[str, Any]) -> Iterator[tuple[dict[str, Any], str, bool]]:
    """All places that name an accessor, the key, and whether they are whole numbers."""
    for mesh in document.get("meshes", []):
        for primitive in mesh["primitives"]:
            for attributes in (primitive["attributes"], *primitive.get("targets", [])):
                yield from ((attributes, name, name.startswith("JOINTS_")) for name in attributes)
            if "indices" in primitive:
                yield primitive, "indices", True
    for skin in document.get("skins", []):
        if "inverseBindMatrices" in skin:
            yield skin, "inverseBindMatrices", False
    for clip in document.get("animations", []):
        for sampler in clip["samplers"]:
            yield from ((sampler, name, False) for name in ("input", "output"))


class _Data:
    """The buffer of a GLB while it grows; accessors are numbered as they are added."""

    def __init__(self, document: dict[str, Any]) -> None:
        self.old = document["accessors"]
        self.bytes, self.views, self.accessors = bytearray(), list[dict[str, Any]](), list[dict[str, Any]]()
        self.chosen = dict[int, NDArray[np.int64]]()
        self.numbered = dict[int, NDArray[Any]]()

    def weld(self, asset: Asset, primitive: dict[str, Any]) -> None:
        """Let a primitive without morph targets have one vertex for equal ones, and none that no face has.

        A skin may have the vertices of its shells, with a copy of each in every patch.
        """
        if "targets" in primitive:
            return
        index = primitive["attributes"].values()
        corners = asset.accessor(primitive["indices"])
        rows = np.column_stack([np.ascontiguousarray(asset.accessor(i)).view(np.uint8) for i in index])[corners]
        _, first, point = np.unique(rows, axis=0, return_index=True, return_inverse=True)
        order = np.argsort(first)
        self.chosen |= dict.fromkeys(index, corners[first[order]])
        self.numbered[primitive["indices"]] = np.argsort(order)[point.reshape(-1)].astype(corners.dtype)

    def view(self, data: bytes) -> int:
        self.views.append({"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(data)})
        self.bytes += data + bytes(-len(data) % 4)
        return len(self.views) - 1

    def accessor(self, asset: Asset, index: int, whole: bool) -> int:
        """Copy an accessor, tightly packed; whole : of integers, else in single precision."""
        values: NDArray[Any] = self.numbered[index] if index in self.numbered else asset.accessor(index)
        values = values[self.chosen[index]] if index in self.chosen else values
        drop = ("bufferView", "byteOffset", "sparse")
        record = {key: value for key, value in self.old[index].items() if key not in drop} | {"count": len(values)}
        if not whole and record["componentType"] != FLOAT:
            if record.pop("normalized", False):
                values = np.maximum(values / float(np.iinfo(values.dtype).max), -1.0)
            values, record["componentType"] = values.astype(np.float32), FLOAT
            if "min" in record:
                record |= {"min": values.min(axis=0).tolist(), "max": values.max(axis=0).tolist()}
        self.accessors.append(record | {"bufferView": self.view(values.tobytes())})
        return len(self.accessors) - 1

    def image(self, image: dict[str, Any], asset: Asset) -> None:
        """Take a picture into the buffer."""
        if "uri" not in image:
            found = asset.view(image["bufferView"])
            if found is None:
                raise AssetError("model.gltf: a picture leaves its buffer, expected it inside")
            image["bufferView"] = self.view(bytes(found))
            return
        path = inside(asset.folder, image.pop("uri"))
        image["bufferView"] = self.view(path.read_bytes())
        image["mimeType"] = f"image/{'jpeg' if path.suffix.lower() in {'.jpg', '.jpeg'} else path.suffix[1:].lower()}"
