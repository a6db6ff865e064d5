"""The only writer of glTF: skin, shells and the extension `FUR_ptm_shells`, as `schema/README.md` fixes them."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass, field
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from furbake.asset.planes import pack, write_png
from furbake.pelt.pelt import Pelt
from furbake.surface.charts import Charts
from furbake.surface.mesh import Surface

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bytes = NDArray[np.uint8]
Record = dict[str, Any]

EXTENSION = "FUR_ptm_shells"
VERSION = "1.0"
QUANTIZATION = "KHR_mesh_quantization"

BYTE, UNSIGNED_BYTE, UNSIGNED_SHORT, UNSIGNED_INT, FLOAT = 5120, 5121, 5123, 5125, 5126
ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963


def write_gltf(
    folder: Path, surface: Surface, charts: Charts, lengths: Floats, pelt: Pelt, length: float
) -> dict[str, Any]:
    """Write model.gltf, model.bin and the planes into `folder`; counts and file sizes for the record.

    lengths : (V,) float 0..1, share of `length` (model units) of the fur at each vertex of the surface
    """
    images = _write_planes(folder, pelt)
    buffer = _Buffer()
    positions, offset, scale = quantise_positions(surface.vertices)
    skin = {
        "attributes": {
            "POSITION": buffer.attribute(positions, UNSIGNED_SHORT, bounds=True),
            "NORMAL": buffer.attribute(signed(surface.normals), BYTE),
        },
        "indices": buffer.indices(surface.faces, len(surface.vertices)),
        "material": 0,
    }
    source = charts.source
    attributes = {
        "POSITION": buffer.attribute(positions[source], UNSIGNED_SHORT, bounds=True),
        "NORMAL": buffer.attribute(signed(surface.normals)[source], BYTE),
        "TANGENT": buffer.attribute(signed(charts.tangents), BYTE),
        "TEXCOORD_0": buffer.attribute(charts.uv.astype(np.float32), FLOAT),
    }
    weights = quantise_weights(charts.weights, charts.group)
    if (weights != 255).any():
        attributes["_WEIGHT"] = buffer.attribute(weights[:, None], UNSIGNED_BYTE)
    shares = np.clip(np.rint(255.0 * lengths), 0, 255).astype(np.uint8)
    if (shares != 255).any():
        attributes["_LENGTH"] = buffer.attribute(shares[source, None], UNSIGNED_BYTE)
    shells = {"attributes": attributes, "indices": buffer.indices(charts.faces, len(source))}

    place = {"translation": numbers(offset), "scale": numbers(np.full(3, scale))}
    document = {
        "asset": {"version": "2.0", "generator": f"furbake {version('furbake')}"},
        "extensionsUsed": [EXTENSION, QUANTIZATION],
        "extensionsRequired": [QUANTIZATION],
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "skin", "mesh": 0, **place}, {"name": "shells", "mesh": 1, **place}],
        "meshes": [{"name": "skin", "primitives": [skin]}, {"name": "shells", "primitives": [shells]}],
        "materials": [
            {
                "name": "skin",
                "pbrMetallicRoughness": {
                    "baseColorFactor": [*numbers(np.array(surface.colour)), 1.0],
                    "metallicFactor": 0.0,
                    "roughnessFactor": 1.0,
                },
            }
        ],
        "images": [{"name": uri.removesuffix(".png"), "uri": uri} for uri in images],
        "accessors": buffer.accessors,
        "bufferViews": buffer.views,
        "buffers": [{"uri": "model.bin", "byteLength": len(buffer.data)}],
        "extensions": {EXTENSION: extension(pelt, length, images)},
    }
    (folder / "model.bin").write_bytes(bytes(buffer.data))
    (folder / "model.gltf").write_text(dump(document), "utf-8", newline="\n")
    return {
        "skin": {"vertices": len(surface.vertices), "faces": len(surface.faces)},
        "shells": {"vertices": len(source), "faces": len(charts.faces)},
        "bytes": {name: (folder / name).stat().st_size for name in ("model.gltf", "model.bin", *images)},
    }


def extension(pelt: Pelt, length: float, images: list[str]) -> dict[str, Any]:
    """The JSON object of the extension, for nodes 0 (skin) and 1 (shells) and the images in the order of writing.

    length : longest fur, model units
    """
    basis: dict[str, Any] = {"kind": pelt.kind}
    if pelt.kind == "eigen":
        if pelt.matrix is None or pelt.degree is None:
            raise ValueError("basis: got eigen without its matrix, expected (C, 27) weights")
        basis |= {"degree": pelt.degree, "matrix": [numbers(row) for row in pelt.matrix]}
    state: dict[str, Any] = {
        "name": "dry",
        "planes": [i for i, uri in enumerate(images) if uri.startswith("plane")],
        "scale": numbers(pelt.scale),
        "bias": numbers(pelt.bias),
    }
    if "colour.png" in images:
        state["colour"] = images.index("colour.png")
    return {
        "version": VERSION,
        "skin": 0,
        "shells": 1,
        "layers": pelt.layers,
        "size": pelt.size,
        "coefficients": pelt.coefficients,
        "length": numbers(np.array([length]))[0],
        "height": numbers(np.array([pelt.height]))[0],
        "basis": basis,
        "environment": [numbers(row) for row in pelt.environment],
        "drift": [numbers(row) for row in pelt.drift],
        "ramp": {
            "root": numbers(np.array(pelt.ramp.root)),
            "tip": numbers(np.array(pelt.ramp.tip)),
            "tip2": numbers(np.array(pelt.ramp.tip2)),
            "power": float(pelt.ramp.power),
        },
        "pelts": [state],
    }


def quantise_positions(vertices: Floats) -> tuple[NDArray[np.uint16], Floats, float]:
    """(V, 3) 16-bit positions, and the (3,) offset and the scale that bring them back: offset + scale · code / 65535.

    One scale for all axes, so that normals need no correction; the error is at most scale / 131070 per axis.
    """
    offset = vertices.min(axis=0)
    scale = float(np.ptp(vertices, axis=0).max())
    return np.rint((vertices - offset) * (65535.0 / scale)).astype(np.uint16), offset, scale


def quantise_weights(weights: Floats, group: Ints) -> Bytes:
    """(M,) weights as bytes that sum to exactly 255 in each group (largest remainders), as the weights sum to 1."""
    exact = 255.0 * np.clip(weights, 0.0, 1.0)
    floor = np.floor(exact + 1e-9)
    _, index = np.unique(group, return_inverse=True)
    missing = np.rint(255.0 - np.bincount(index, floor)).astype(np.int64)
    order = np.lexsort((np.arange(len(index)), floor - exact, index))
    start = np.searchsorted(index[order], np.arange(len(missing)))
    rank = np.empty(len(index), dtype=np.int64)
    rank[order] = np.arange(len(index)) - start[index[order]]
    return np.asarray(floor + (rank < missing[index]), dtype=np.uint8)


def signed(vectors: Floats) -> NDArray[np.int8]:
    """Components -1..1 as normalised signed bytes."""
    return np.clip(np.rint(127.0 * vectors), -127, 127).astype(np.int8)


def numbers(values: NDArray[Any]) -> list[float]:
    """A vector as JSON numbers: nine digits, which hold every 32-bit float."""
    return [float(f"{value:.9g}") + 0.0 for value in np.asarray(values, dtype=np.float64).ravel()]


def dump(document: Any) -> str:
    """JSON with one line per object member and flat lists in one line."""
    text = json.dumps(document, indent=1, ensure_ascii=False, allow_nan=False)
    return re.sub(r"\[\s*([^\[\]{}]*?)\s*\]", lambda match: f"[{' '.join(match[1].split())}]", text) + "\n"


def _write_planes(folder: Path, pelt: Pelt) -> list[str]:
    """Write the images of a pelt; their names in the order of `images`."""
    planes = pack(pelt)
    names = []
    for i, pixels in enumerate(planes.coefficients):
        names.append(f"plane{i}.png")
        write_png(folder / names[-1], pixels)
    if planes.colour is not None:
        names.append("colour.png")
        write_png(folder / names[-1], planes.colour, srgb=True)
    return names


@dataclass
class _Buffer:
    """model.bin as it grows, with its views and accessors."""

    data: bytearray = field(default_factory=bytearray)
    views: list[Record] = field(default_factory=list)
    accessors: list[Record] = field(default_factory=list)

    def attribute(self, values: NDArray[Any], component: int, bounds: bool = False) -> int:
        """Index of a new accessor over a view of its own, each vertex padded to whole 4 bytes."""
        count, width = values.shape
        stride = -(-width * values.itemsize // 4) * 4
        padded = np.zeros((count, stride), dtype=np.uint8)
        flat = np.ascontiguousarray(values, dtype=values.dtype.newbyteorder("<"))
        padded[:, : width * values.itemsize] = flat.view(np.uint8).reshape(count, -1)
        accessor: Record = {
            "bufferView": self._view(padded.tobytes(), target=ARRAY_BUFFER, byteStride=stride),
            "componentType": component,
            "count": count,
            "type": "SCALAR" if width == 1 else f"VEC{width}",
        }
        if component != FLOAT:
            accessor["normalized"] = True
        if bounds:
            accessor |= {"min": values.min(axis=0).tolist(), "max": values.max(axis=0).tolist()}
        self.accessors.append(accessor)
        return len(self.accessors) - 1

    def indices(self, faces: Ints, vertices: int) -> int:
        """Index of a new accessor with the corners of the faces, in 16 bits where they fit (65535 is reserved)."""
        short = vertices <= 65535
        self.accessors.append(
            {
                "bufferView": self._view(
                    faces.astype("<u2" if short else "<u4").tobytes(), target=ELEMENT_ARRAY_BUFFER
                ),
                "componentType": UNSIGNED_SHORT if short else UNSIGNED_INT,
                "count": faces.size,
                "type": "SCALAR",
            }
        )
        return len(self.accessors) - 1

    def _view(self, data: bytes, **properties: int) -> int:
        self.data.extend(bytes(-len(self.data) % 4))
        self.views.append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data), **properties})
        self.data.extend(data)
        return len(self.views) - 1
