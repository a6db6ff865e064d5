"""A glTF file as JSON and arrays: container, buffers, accessors (glTF 2.0, section 3.6), Draco, meshopt.

Read here and not by trimesh because trimesh 5.2 takes normalised integers for lengths, leaves sparse accessors zero,
knows only the first set of texture coordinates and rounds colours to bytes.
"""

from __future__ import annotations

import base64
import binascii
import json
import struct
from typing import Any
from urllib.parse import unquote

import DracoPy
import numpy as np
from numpy.typing import NDArray

from furbake.surface.files import Source
from furbake.surface.read.accessors import TYPES, WIDTHS, elements
from furbake.surface.read.meshopt import EXTENSIONS, compression, decoded
from furbake.surface.soup import Floats, Ints, MeshError

Record = dict[str, Any]

DRACO = "KHR_draco_mesh_compression"
BROKEN = (ValueError, LookupError, TypeError, AttributeError, OverflowError, OSError)
"""Errors of a broken file. A MeshError is one of them: it must be let through."""

COMPRESSED = (*EXTENSIONS, "MESHOPT_compression")
"""Extensions of a primitive that nothing decodes."""


class UndecodableError(ValueError):
    """Geometry in a compression that cannot be decoded; the message names the extension."""


class GltfData:
    """The JSON of a .gltf or .glb file, and what its accessors, images and compressed primitives hold."""

    def __init__(self, source: Source) -> None:
        """Raises ValueError, KeyError, TypeError, IndexError or OSError, whatever breaks first."""
        data = source.data
        self.source = source
        self.chunk: memoryview | None = None
        if data[:4] == b"glTF":
            data = self._unpack(data)
        self.json: Record = json.loads(data.decode("utf-8-sig"))
        if not isinstance(self.json, dict) or not isinstance(self.json.get("asset"), dict):
            raise ValueError("no glTF asset")
        if not str(self.json["asset"].get("version", "")).startswith("2"):
            raise ValueError(f"glTF version {self.json['asset'].get('version')}")
        self._lists: dict[str, list[Record]] = {}
        self._buffers: dict[int, memoryview] = {}
        self._images: dict[int, bytes] = {}
        self._decoded: dict[int, memoryview] = {}
        self.numbers = source.budgets.numbers

    def list_of(self, name: str) -> list[Record]:
        """A top-level array, empty where there is none."""
        if name not in self._lists:
            self._lists[name] = list(self.json.get(name, []))
        return self._lists[name]

    def item(self, name: str, index: Any) -> Record:
        """One object of a top-level array. Raises IndexError; a negative index is none."""
        if not isinstance(index, int) or not 0 <= index < len(self.list_of(name)):
            raise IndexError(f"{name}[{index}] of {len(self.list_of(name))}")
        record: Record = self.list_of(name)[index]
        return record

    def accessor(self, index: Any) -> Floats:
        """(count, width) numbers of an accessor; normalised integers as -1..1 or 0..1."""
        record = self.item("accessors", index)
        count, width = int(record["count"]), WIDTHS[record["type"]]
        kind = np.dtype(TYPES[record["componentType"]])
        if count < 0:
            raise ValueError(f"accessor of {count} elements")
        self.numbers.take(count * width)
        if "bufferView" in record:
            values = self._elements(record["bufferView"], record.get("byteOffset", 0), count, width, kind)
        else:
            values = np.zeros((count, width), dtype=kind)
        if "sparse" in record:
            values = values.copy()
            sparse, some = record["sparse"], int(record["sparse"]["count"])
            self.numbers.take(max(some, 0) * (width + 1))
            where = sparse["indices"]
            rows = self._elements(
                where["bufferView"], where.get("byteOffset", 0), some, 1, np.dtype(TYPES[where["componentType"]])
            )
            part = sparse["values"]
            values[rows[:, 0]] = self._elements(part["bufferView"], part.get("byteOffset", 0), some, width, kind)
        numbers = values.astype(np.float64)
        if record.get("normalized") and kind.kind in "iu":
            numbers = np.maximum(numbers / np.iinfo(kind).max, -1.0)
        return numbers

    def draco(self, extension: Record) -> tuple[Ints, dict[str, Floats]]:
        """Faces and attributes of a compressed primitive. Raises UndecodableError."""
        try:
            mesh = DracoPy.decode(bytes(self.view(extension["bufferView"])))
            ids = {int(one["unique_id"]): np.asarray(one["data"], dtype=np.float64) for one in mesh.attributes}
            named = {name: ids[int(number)] for name, number in extension["attributes"].items()}
            faces = np.asarray(mesh.faces, dtype=np.int64).reshape(-1, 3)
        except Exception as error:  # a decoder raises anything on a broken stream
            raise UndecodableError(DRACO) from error
        return faces, {name: values.reshape(len(values), -1) for name, values in named.items()}

    def view(self, index: Any) -> memoryview:
        """Bytes of a buffer view. Raises UndecodableError where they are compressed."""
        record = self.item("bufferViews", index)
        if COMPRESSED[-1] in record.get("extensions", {}):
            raise UndecodableError(COMPRESSED[-1])
        packed = compression(record)
        if packed is None:
            return self._part(record, f"buffer view {index}")
        if index not in self._decoded:
            stream = self._part(packed, f"buffer view {index}")
            try:
                self._decoded[index] = memoryview(decoded(stream, packed, self.source.budgets.copied.take))
            except MeshError:
                raise
            except Exception as error:  # a decoder raises anything on a broken stream
                raise UndecodableError(EXTENSIONS[0]) from error
        return self._decoded[index]

    def _part(self, record: Record, name: str) -> memoryview:
        start, length = int(record.get("byteOffset", 0)), int(record["byteLength"])
        data = self._buffer(record["buffer"])
        if start < 0 or length < 0 or start + length > len(data):
            raise ValueError(f"{name} ends at {start + length} of {len(data)} bytes")
        return data[start : start + length]

    def image(self, index: Any) -> bytes:
        """File of an image, as it is stored."""
        record = self.item("images", index)
        if index not in self._images:
            stored = self.view(record["bufferView"]) if "bufferView" in record else self._uri(str(record["uri"]))
            self.source.budgets.copied.take(len(stored))
            self._images[index] = bytes(stored)
        return self._images[index]

    def _uri(self, uri: str) -> bytes:
        """Bytes of a data URI or of a file beside this one."""
        if uri.startswith("data:"):
            head, _, body = uri.partition(",")
            try:
                return base64.b64decode(body) if head.endswith(";base64") else unquote(body).encode("latin-1")
            except (binascii.Error, UnicodeEncodeError) as error:
                raise ValueError("a broken data URI") from error
        if "://" in uri:
            raise ValueError(f"a remote file, {uri}")
        return self.source.read(unquote(uri))

    def _buffer(self, index: Any) -> memoryview:
        record = self.item("buffers", index)
        if index not in self._buffers:
            if "uri" in record:
                self._buffers[index] = memoryview(self._uri(str(record["uri"])))
            elif self.chunk is not None and index == 0:
                self._buffers[index] = self.chunk
            else:
                raise ValueError(f"buffer {index} has no data")
        return self._buffers[index]

    def _elements(self, view: Any, offset: Any, count: int, width: int, kind: np.dtype[Any]) -> NDArray[Any]:
        stride = int(self.item("bufferViews", view).get("byteStride", 0))
        return elements(self.view(view), int(offset), count, width, kind, stride)

    def _unpack(self, data: bytes) -> bytes:
        """JSON chunk of a .glb; the binary chunk is kept."""
        version, length = struct.unpack_from("<II", data, 4)
        if version != 2 or length > len(data):
            raise ValueError(f"glb version {version}, {length} of {len(data)} bytes")
        chunks: dict[int, memoryview] = {}
        whole, at = memoryview(data), 12
        while at + 8 <= length:
            size, kind = struct.unpack_from("<II", data, at)
            if at + 8 + size > len(data):
                raise ValueError("a glb chunk is cut off")
            chunks.setdefault(kind, whole[at + 8 : at + 8 + size])
            at += 8 + size
        self.chunk = chunks.get(0x004E4942)
        return bytes(chunks[0x4E4F534A])
