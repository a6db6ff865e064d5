"""model.bin as it grows, with its views and accessors."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

Ints = NDArray[np.int64]
Record = dict[str, Any]

UNSIGNED_SHORT, UNSIGNED_INT, FLOAT = 5123, 5125, 5126
COMPONENTS = {
    np.dtype(np.int8): 5120,
    np.dtype(np.uint8): 5121,
    np.dtype(np.int16): 5122,
    np.dtype(np.uint16): UNSIGNED_SHORT,
    np.dtype(np.float32): FLOAT,
}
ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963


@dataclass
class Buffer:
    """The bytes of one glTF buffer, with its views and accessors."""

    data: bytearray = field(default_factory=bytearray)
    views: list[Record] = field(default_factory=list)
    accessors: list[Record] = field(default_factory=list)

    def primitive(self, attributes: dict[str, NDArray[Any]], faces: Ints) -> Record:
        """A mesh primitive: attributes (count, width) as normalised integers or as floats, and its faces.

        Joints are plain integers.
        """
        indices = {
            name: self.attribute(values, name == "POSITION", normalised=not name.startswith("JOINTS_"))
            for name, values in attributes.items()
        }
        return {"attributes": indices, "indices": self.indices(faces, len(attributes["POSITION"]))}

    def attribute(self, values: NDArray[Any], bounds: bool = False, normalised: bool = True) -> int:
        """Index of a new accessor over a view of its own, each vertex padded to whole 4 bytes."""
        count, width = values.shape
        stride = -(-width * values.itemsize // 4) * 4
        padded = np.zeros((count, stride), dtype=np.uint8)
        padded[:, : width * values.itemsize] = _little(values).view(np.uint8).reshape(count, -1)
        view = self._view(padded.tobytes(), target=ARRAY_BUFFER, byteStride=stride)
        return self._append({"bufferView": view} | _described(values, bounds, normalised))

    def displacements(self, values: NDArray[Any], bounds: bool = False) -> int:
        """Index of a new accessor (count, width) of a morph target; sparse where most of it is 0."""
        count, width = values.shape
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
        view = self._view(faces.astype("<u2" if short else "<u4").tobytes(), target=ELEMENT_ARRAY_BUFFER)
        component = UNSIGNED_SHORT if short else UNSIGNED_INT
        return self._append(
            {"bufferView": view, "componentType": component, "count": faces.size, "type": "SCALAR"}
        )

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


def _little(values: NDArray[Any]) -> NDArray[Any]:
    """The same, packed, in the order of bytes that glTF has."""
    return np.ascontiguousarray(values, dtype=values.dtype.newbyteorder("<"))


def numbers(values: NDArray[Any]) -> list[float]:
    """A vector as JSON numbers: nine digits, which hold every 32-bit float."""
    return [float(f"{value:.9g}") + 0.0 for value in np.asarray(values, dtype=np.float64).ravel()]
