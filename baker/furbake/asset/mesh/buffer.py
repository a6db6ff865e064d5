"""model.bin as it grows, with its views and accessors; views are compressed by `EXT_meshopt_compression`."""

from __future__ import annotations

import json
import re
import zlib
from dataclasses import dataclass, field
from typing import Any, Literal

import meshopt
import numpy as np
from numpy.typing import NDArray

Ints = NDArray[np.int64]
Record = dict[str, Any]
Mode = Literal["ATTRIBUTES", "TRIANGLES"]

MESHOPT = "EXT_meshopt_compression"

UNSIGNED_SHORT, UNSIGNED_INT, FLOAT = 5123, 5125, 5126
COMPONENTS = {
    np.dtype(np.int8): 5120,
    np.dtype(np.uint8): 5121,
    np.dtype(np.int16): 5122,
    np.dtype(np.uint16): UNSIGNED_SHORT,
    np.dtype(np.float32): FLOAT,
}
GZIP = 6
"""Level of zlib at which sizes are compared: that of most hosts."""

LEVEL, STREAM = 3, 0
"""Settings of the codec: the smallest streams, of the version that the extension allows."""

ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963


@dataclass
class Buffer:
    """The bytes of one glTF buffer, with its views and accessors.

    compress : compress vertices and faces where that makes them smaller as a host sends them, through gzip
    unpacked : bytes of the second buffer, which is not stored: where compressed views lie once they are decoded
    """

    compress: bool = False
    unpacked: int = 0
    data: bytearray = field(default_factory=bytearray)
    views: list[Record] = field(default_factory=list)
    accessors: list[Record] = field(default_factory=list)

    def primitive(self, attributes: dict[str, NDArray[Any]], faces: Ints) -> Record:
        """A mesh primitive: attributes (count, width) as normalised integers or as floats, and its faces.

        Joints are plain integers.
        """
        indices = {
            name: self.attribute(values, name == "POSITION", not name.startswith("JOINTS_"), name == "TANGENT")
            for name, values in attributes.items()
        }
        return {"attributes": indices, "indices": self.indices(faces, len(attributes["POSITION"]))}

    def attribute(
        self, values: NDArray[Any], bounds: bool = False, normalised: bool = True, octahedral: bool = False
    ) -> int:
        """Index of a new accessor over a view of its own, each vertex padded to whole 4 bytes.

        octahedral : compress unit vectors of bytes with a sign as places on an octahedron, which turns them by 1.4°
            at most
        """
        count, width = values.shape
        stride = -(-width * values.itemsize // 4) * 4
        padded = np.zeros((count, stride), dtype=np.uint8)
        padded[:, : width * values.itemsize] = _little(values).view(np.uint8).reshape(count, -1)
        properties = {"target": ARRAY_BUFFER, "byteStride": stride}
        view = self._packed(
            padded, "ATTRIBUTES", _octahedral(values) if octahedral and self.compress else None, **properties
        )
        return self._append({"bufferView": view} | _described(values, bounds, normalised))

    def displacements(self, values: NDArray[Any], bounds: bool = False) -> int:
        """Index of a new accessor (count, width) of a morph target; sparse where most of it is 0."""
        count = len(values)
        rows = np.flatnonzero((values != 0).any(axis=1))
        rows = rows if len(rows) else np.zeros(1, dtype=np.int64)  # a sparse accessor has one at least
        if 2 * len(rows) > count:
            return self.attribute(values, bounds)
        short = count <= 65535
        sparse = {
            "count": len(rows),
            "indices": {
                "bufferView": self._view(rows.astype("<u2" if short else "<u4").tobytes()),
                "componentType": UNSIGNED_SHORT if short else UNSIGNED_INT,
            },
            "values": {"bufferView": self._view(_little(values[rows]).tobytes())},
        }
        return self._append(_described(values, bounds) | {"sparse": sparse})

    def floats(self, values: NDArray[Any], kind: str, bounds: bool = False) -> int:
        """Index of a new accessor of packed 32-bit floats that are no vertices, a row per element.

        kind : SCALAR, VEC3, VEC4 or MAT4
        """
        stored = np.asarray(values, dtype=np.float32)
        accessor = {"bufferView": self._view(_little(stored).tobytes())} | _described(stored, bounds)
        return self._append(accessor | {"type": kind})

    def _append(self, accessor: Record) -> int:
        self.accessors.append(accessor)
        return len(self.accessors) - 1

    def indices(self, faces: Ints, vertices: int) -> int:
        """Index of a new accessor with the corners of the faces, in 16 bits where they fit (65535 is reserved)."""
        short = vertices <= 65535
        corners = faces.reshape(-1).astype("<u2" if short else "<u4")
        view = self._packed(corners, "TRIANGLES", target=ELEMENT_ARRAY_BUFFER)
        component = UNSIGNED_SHORT if short else UNSIGNED_INT
        return self._append({"bufferView": view, "componentType": component, "count": faces.size, "type": "SCALAR"})

    def first(self, accessor: int, count: int) -> int:
        """Index of a new accessor with the first elements of another."""
        return self._append(self.accessors[accessor] | {"count": count})

    def bits(self, values: NDArray[np.uint8]) -> int:
        """Index of a new accessor of bytes that are no vertices."""
        accessor = {"bufferView": self._view(values.tobytes()), "componentType": COMPONENTS[values.dtype]}
        return self._append(accessor | {"count": len(values), "type": "SCALAR"})

    def records(self, uri: str) -> Record:
        """Members of the document: accessors, views, and buffers, the first of which is the file `uri`."""
        buffers: list[Record] = [{"uri": uri, "byteLength": len(self.data)}]
        if self.unpacked:
            buffers.append({"byteLength": self.unpacked, "extensions": {MESHOPT: {"fallback": True}}})
        return {"accessors": self.accessors, "bufferViews": self.views, "buffers": buffers}

    def _packed(
        self, values: NDArray[Any], mode: Mode, octahedral: NDArray[np.uint8] | None = None, **properties: int
    ) -> int:
        """Index of a new view with a row of bytes per vertex, or with the corners of faces.

        Copies of vertices have equal bytes, which gzip finds and the codec does not: the smaller of the two is kept.

        octahedral : rows of bytes of which the codec's filter makes the vertices
        """
        plain = values.tobytes()
        stream = _encoded(values if octahedral is None else octahedral, mode) if self.compress else plain
        if not self.compress or len(zlib.compress(stream, GZIP)) >= len(zlib.compress(plain, GZIP)):
            return self._view(plain, **properties)
        packed = self.views[self._view(stream)]
        count = len(values)
        packed |= {"byteStride": len(plain) // count, "count": count, "mode": mode}
        packed |= {} if octahedral is None else {"filter": "OCTAHEDRAL"}
        place = {"buffer": 1, "byteOffset": self.unpacked, "byteLength": len(plain), **properties}
        self.unpacked += len(plain) + -len(plain) % 4
        self.views[-1] = place | {"extensions": {MESHOPT: packed}}
        return len(self.views) - 1

    def _view(self, data: bytes, **properties: int) -> int:
        self.data.extend(bytes(-len(self.data) % 4))
        self.views.append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data), **properties})
        self.data.extend(data)
        return len(self.views) - 1


def _described(values: NDArray[Any], bounds: bool, normalised: bool = True) -> Record:
    """Members of an accessor of (count, width) elements, save for where they are."""
    count, width = values.shape
    accessor: Record = {
        "componentType": COMPONENTS[values.dtype],
        "count": count,
        "type": "SCALAR" if width == 1 else f"VEC{width}",
    }
    if values.dtype != np.float32 and normalised:
        accessor["normalized"] = True
    if bounds:
        accessor |= {"min": values.min(axis=0).tolist(), "max": values.max(axis=0).tolist()}
    return accessor


def _encoded(values: NDArray[Any], mode: Mode) -> bytes:
    """The stream of rows of bytes, or of the corners of faces."""
    if mode == "TRIANGLES":
        return bytes(meshopt.encode_index_buffer(values.astype(np.uint32)))
    return bytes(meshopt.encode_vertex_buffer_level(values, LEVEL, STREAM))


def _octahedral(vectors: NDArray[np.int8]) -> NDArray[np.uint8]:
    """(n, 4) bytes of unit vectors with a sign, (n, 4): two numbers on the faces of an octahedron in place of three."""
    return np.asarray(meshopt.encode_filter_oct((vectors / 127.0).astype(np.float32), 4, 8))


def _little(values: NDArray[Any]) -> NDArray[Any]:
    """The same, packed, in the order of bytes that glTF has."""
    return np.ascontiguousarray(values, dtype=values.dtype.newbyteorder("<"))


def nested(values: NDArray[Any]) -> list[Any]:
    """An array of rows of rows as JSON numbers."""
    return [[numbers(row) for row in rows] for rows in values]


def dump(document: Any) -> str:
    """JSON with one line per object member and flat lists in one line."""
    text = json.dumps(document, indent=1, ensure_ascii=False, allow_nan=False)
    return re.sub(r"\[\s*([^\[\]{}]*?)\s*\]", lambda match: f"[{' '.join(match[1].split())}]", text) + "\n"


def numbers(values: NDArray[Any]) -> list[float]:
    """A vector as JSON numbers: nine digits, which hold every 32-bit float."""
    return [float(f"{value:.9g}") + 0.0 for value in np.asarray(values, dtype=np.float64).ravel()]
