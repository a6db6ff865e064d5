"""Read a baked folder: its JSON, its accessors as arrays, its images."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from furbake.asset.extension import EXTENSION
from furbake.asset.planes import Bytes, read_png
from furbake.surface.files import read_regular
from furbake.surface.limits import Budget, limits
from furbake.surface.read.accessors import TYPES, WIDTHS, elements
from furbake.surface.read.meshopt import compression, decoded


class AssetError(ValueError):
    """A folder that is no readable asset; the message names the file, what was got and what was expected."""


@dataclass(frozen=True)
class Asset:
    """A baked folder.

    document : the glTF, record : bake.json (empty if there is none), data : model.bin, or what the buffer names
    """

    folder: Path
    document: dict[str, Any]
    record: dict[str, Any]
    data: bytes
    _views: dict[int, memoryview] = field(default_factory=dict, repr=False, compare=False)

    @property
    def fur(self) -> dict[str, Any]:
        """The extension's object. Raises AssetError where there is none."""
        found = self.document.get("extensions")
        fur = found.get(EXTENSION) if isinstance(found, dict) else None
        if not isinstance(fur, dict):
            raise AssetError(f"model.gltf: no {EXTENSION}, expected a folder that furbake wrote")
        return fur

    def primitive(self, node: int) -> dict[str, Any]:
        """The first primitive of a node's mesh: all of it, save of a skin of several materials."""
        return self.primitives(node)[0]

    def primitives(self, node: int) -> list[dict[str, Any]]:
        """All primitives of a node's mesh, at least one."""
        found = self.document["meshes"][self.document["nodes"][node]["mesh"]]["primitives"]
        if not isinstance(found, list) or not found or not all(isinstance(primitive, dict) for primitive in found):
            raise TypeError("primitives are no objects")
        return found

    def accessor(self, index: int) -> NDArray[Any]:
        """(count, width) components as stored, or (count,) for scalars. Raises AssetError where it leaves the data."""
        accessor = self.document["accessors"][_index(index)]
        kind, width, count = (
            np.dtype(TYPES[accessor["componentType"]]),
            WIDTHS[accessor["type"]],
            _index(accessor["count"]),
        )
        if "sparse" not in accessor:
            values = self._elements(index, accessor, kind, width, count)
            return values[:, 0] if width == 1 else values
        if not 1 <= count * width <= limits().numbers:
            raise AssetError(f"model.gltf: accessor {index} has {count} elements, expected 1 to {limits().numbers}")
        sparse, values = accessor["sparse"], np.zeros((count, width), dtype=kind)
        if "bufferView" in accessor:
            values = self._elements(index, accessor, kind, width, count).copy()
        some, where = _index(sparse["count"]), sparse["indices"]
        rows = self._elements(index, where, np.dtype(TYPES[where["componentType"]]), 1, some)[:, 0]
        if rows.max() >= count:
            raise AssetError(f"model.gltf: accessor {index} replaces element {rows.max()}, expected 0 to {count - 1}")
        values[rows] = self._elements(index, sparse["values"], kind, width, some)
        return values[:, 0] if width == 1 else values

    def _elements(self, index: int, place: dict[str, Any], kind: np.dtype[Any], width: int, count: int) -> NDArray[Any]:
        """(count, width) elements at the `bufferView` and `byteOffset` of a place in accessor `index`."""
        where = _index(place["bufferView"])
        view = self.document["bufferViews"][where]
        inner, stride = _index(place.get("byteOffset", 0)), _index(view.get("byteStride", 0))
        found = self.view(where)
        if count < 1 or found is None:
            raise AssetError(f"model.gltf: accessor {index} leaves its buffer, expected 1 or more elements in it")
        try:
            return elements(found, inner, count, width, kind, stride)
        except ValueError as error:
            raise AssetError(f"model.gltf: accessor {index} leaves its buffer ({error}), expected it inside") from error

    def view(self, index: int) -> memoryview | None:
        """Bytes of a buffer view, decoded; None where it leaves the data. Raises AssetError for a broken stream."""
        if index in self._views:
            return self._views[index]
        view = self.document["bufferViews"][index]
        packed = compression(view)
        place = view if packed is None else packed
        start, length = _index(place.get("byteOffset", 0)), _index(place["byteLength"])
        if start + length > len(self.data) or _index(place["buffer"]) != 0:
            return None
        found = memoryview(self.data)[start : start + length]
        if packed is not None:
            try:
                found = memoryview(decoded(found, packed, Budget(f"buffer view {index}", "bytes").take))
            except (ValueError, RuntimeError, LookupError, TypeError) as error:
                raise AssetError(f"model.gltf: buffer view {index} cannot be decoded ({error})") from error
            if len(found) != _index(view["byteLength"]):
                raise AssetError(f"model.gltf: buffer view {index} has {len(found)} bytes, not {view['byteLength']}")
        self._views[index] = found
        return found

    def image(self, index: int) -> Bytes:
        """(height, width, channels) bytes of an image. Raises AssetError or PlaneError."""
        return read_png(inside(self.folder, self.document["images"][_index(index)]["uri"]))


def read_asset(folder: Path) -> Asset:
    """The folder's contents. Raises AssetError where there is no readable glTF in it."""
    if not folder.is_dir():
        what = "is a file" if folder.exists() else "no such folder"
        raise AssetError(f"{folder}: {what}, expected a folder that furbake wrote")
    if not (folder / "model.gltf").exists():
        raise AssetError(f"{folder}: holds no model.gltf, expected a folder that furbake wrote")
    document = read_json(folder / "model.gltf")
    record = read_json(folder / "bake.json") if (folder / "bake.json").exists() else {}
    uri = "model.bin"
    try:
        uri = document["buffers"][0]["uri"]
        data = read_regular(inside(folder, uri), Budget(str(folder), "bytes"))
    except (LookupError, TypeError) as error:
        raise AssetError("model.gltf: no buffer, expected one with its uri") from error
    except OSError as error:
        raise AssetError(f"{uri}: {(error.strerror or 'cannot be read').lower()}, expected the buffer") from error
    return Asset(folder, document, record, data)


def inside(folder: Path, uri: Any) -> Path:
    """Path of a uri that names a file in the folder. Raises AssetError for every other."""
    if not isinstance(uri, str) or not uri or Path(uri).name != uri or uri in (".", "..") or ":" in uri:
        raise AssetError(f"model.gltf: uri {uri!r}, expected the name of a file in the folder")
    return folder / uri


def _index(value: Any) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or value < 0:
        raise AssetError(f"model.gltf: got {value!r}, expected a number 0, 1, 2 ...")
    return value


def read_json(path: Path) -> dict[str, Any]:
    """A JSON object in a regular file. Raises AssetError."""
    try:
        found = json.loads(read_regular(path, Budget(path.name, "bytes")).decode("utf-8"))
    except OSError as error:
        raise AssetError(f"{path.name}: {(error.strerror or 'cannot be read').lower()}, expected JSON") from error
    except (ValueError, RecursionError) as error:
        raise AssetError(f"{path.name}: not JSON ({str(error).splitlines()[0]}), expected a JSON object") from error
    if not isinstance(found, dict):
        raise AssetError(f"{path.name}: a JSON {type(found).__name__}, expected an object")
    return found
