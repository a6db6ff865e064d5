"""A glTF reader of a few lines that poses what it reads: plain numpy, an oracle that shares no code with the baker."""

from __future__ import annotations

import base64
import json
import struct
from pathlib import Path
from typing import Any

import numpy as np

KINDS = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
MOST = {5120: 127.0, 5121: 255.0, 5122: 32767.0, 5123: 65535.0}


class Moving:
    """A glTF file."""

    def __init__(self, path: Path) -> None:
        data = path.read_bytes()
        chunk = b""
        if data[:4] == b"glTF":
            size = struct.unpack_from("<I", data, 12)[0]
            data, chunk = data[20 : 20 + size], data[20 + size + 8 :]
        self.document: dict[str, Any] = json.loads(data)
        self.buffers = []
        for buffer in self.document["buffers"]:
            uri = buffer.get("uri")
            inline = uri is not None and uri.startswith("data:")
            self.buffers.append(
                chunk if uri is None
                else base64.b64decode(uri.partition(",")[2]) if inline
                else (path.parent / uri).read_bytes()
            )  # fmt: skip

    def _raw(self, view: int, offset: int, kind: int, width: int, count: int) -> np.ndarray[Any, Any]:
        record = self.document["bufferViews"][view]
        data, item = self.buffers[record["buffer"]], np.dtype(KINDS[kind]).itemsize * width
        start, stride = record.get("byteOffset", 0) + offset, record.get("byteStride", item)
        rows = [data[start + i * stride : start + i * stride + item] for i in range(count)]
        return np.frombuffer(b"".join(rows), KINDS[kind]).reshape(count, width)

    def raw(self, index: int) -> np.ndarray[Any, Any]:
        """Numbers as they are stored, (count, width), sparse ones put in."""
        record = self.document["accessors"][index]
        kind, width, count = record["componentType"], WIDTHS[record["type"]], record["count"]
        values = np.zeros((count, width), KINDS[kind])
        if "bufferView" in record:
            values = self._raw(record["bufferView"], record.get("byteOffset", 0), kind, width, count).copy()
        if "sparse" in record:
            sparse = record["sparse"]
            where, what = sparse["indices"], sparse["values"]
            rows = self._raw(where["bufferView"], where.get("byteOffset", 0), where["componentType"], 1, sparse["count"])
            values[rows[:, 0]] = self._raw(what["bufferView"], what.get("byteOffset", 0), kind, width, sparse["count"])
        return values

    def values(self, index: int) -> np.ndarray[Any, Any]:
        """The same as the numbers that they stand for."""
        record, values = self.document["accessors"][index], self.raw(index).astype(np.float64)
        return np.maximum(values / MOST[record["componentType"]], -1.0) if record.get("normalized") else values

    @staticmethod
    def own(node: dict[str, Any], moved: dict[str, Any] | None = None) -> np.ndarray[Any, Any]:
        """Matrix of a node in its parent; `moved` has numbers in place of its own."""
        if "matrix" in node:
            return np.array(node["matrix"], np.float64).reshape(4, 4).T
        node = node | (moved or {})
        x, y, z, w = node.get("rotation", (0, 0, 0, 1)) / np.linalg.norm(node.get("rotation", (0, 0, 0, 1)))
        turn = np.array([[w, -z, y], [z, w, -x], [-y, x, w]])
        imaginary = np.array([x, y, z])
        rotation = turn @ turn + np.outer(imaginary, imaginary)
        found = np.eye(4)
        found[:3, :3] = rotation * np.array(node.get("scale", (1, 1, 1)))
        found[:3, 3] = node.get("translation", (0, 0, 0))
        return found

    def worlds(self, pose: dict[int, dict[str, Any]] | None = None) -> dict[int, np.ndarray[Any, Any]]:
        """Matrices of all nodes of the scene; `pose` has numbers of nodes in place of their own."""
        nodes, found = self.document["nodes"], {}
        todo = [(root, np.eye(4)) for root in self.document["scenes"][self.document.get("scene", 0)]["nodes"]]
        while todo:
            index, above = todo.pop()
            found[index] = above @ self.own(nodes[index], (pose or {}).get(index))
            todo += [(child, found[index]) for child in nodes[index].get("children", ())]
        return found

    def clip(self, index: int, seconds: float) -> dict[int, dict[str, Any]]:
        """Numbers of nodes at a time of an animation."""
        found: dict[int, dict[str, Any]] = {}
        animation = self.document["animations"][index]
        for channel in animation["channels"]:
            sampler, target = animation["samplers"][channel["sampler"]], channel["target"]
            if "node" not in target:
                continue
            times, values = self.values(sampler["input"])[:, 0], self.values(sampler["output"])
            cubic = sampler.get("interpolation") == "CUBICSPLINE"
            rows = values.reshape(len(times), 3 if cubic else 1, -1)
            numbers = at(times, rows, seconds, sampler.get("interpolation", "LINEAR"), target["path"] == "rotation")
            found.setdefault(target["node"], {})[target["path"]] = numbers
        return found

    def seconds(self, index: int) -> float:
        """Length of an animation."""
        samplers = self.document["animations"][index]["samplers"]
        return float(max(self.values(sampler["input"]).max() for sampler in samplers))

    def posed(
        self, node: int, primitive: int = 0, pose: dict[int, dict[str, Any]] | None = None, skin: int | None = None
    ) -> dict[str, np.ndarray[Any, Any]]:
        """Places, normals and tangents of a primitive in the scene: morphed, then moved by joints, or by the node.

        skin : node whose morph weights count; None: this one
        """
        record = self.document["nodes"][node]
        mesh = self.document["meshes"][record["mesh"]]
        part = mesh["primitives"][primitive]
        names = [name for name in ("POSITION", "NORMAL", "TANGENT") if name in part["attributes"]]
        found = {name: self.values(part["attributes"][name])[:, :3] for name in names}
        weights = (pose or {}).get(node if skin is None else skin, {}).get("weights", mesh.get("weights"))
        for target, weight in zip(part.get("targets", ()), () if weights is None else weights, strict=False):
            for name in names:
                if name in target:
                    found[name] = found[name] + weight * self.values(target[name])
        worlds = self.worlds(pose)
        if "skin" in record:
            rig = self.document["skins"][record["skin"]]
            inverse = self.values(rig["inverseBindMatrices"]).reshape(-1, 4, 4).swapaxes(1, 2)
            joints = np.array([worlds[joint] for joint in rig["joints"]]) @ inverse
            matrices = np.zeros((len(found["POSITION"]), 4, 4))
            for k in range(8):
                if f"JOINTS_{k}" in part["attributes"]:
                    which = self.raw(part["attributes"][f"JOINTS_{k}"])
                    shares = self.values(part["attributes"][f"WEIGHTS_{k}"])
                    for i in range(4):
                        matrices += shares[:, i, None, None] * joints[which[:, i]]
        else:
            matrices = np.tile(worlds[node] if node in worlds else self.own(record), (len(found["POSITION"]), 1, 1))
        for name in names:
            moved = np.einsum("vij,vj->vi", matrices[:, :3, :3], found[name])
            if name == "POSITION":
                found[name] = moved + matrices[:, :3, 3]
            else:
                found[name] = moved / np.maximum(np.linalg.norm(moved, axis=1, keepdims=True), 1e-30)
        return found


def at(times: Any, rows: Any, seconds: float, kind: str, turns: bool) -> np.ndarray[Any, Any]:
    """Numbers of a sampler at a time; rows : (K, 1 or 3, n)."""
    if seconds <= times[0]:
        return np.asarray(rows[0][len(rows[0]) // 2])
    if seconds >= times[-1]:
        return np.asarray(rows[-1][len(rows[0]) // 2])
    i = int(np.searchsorted(times, seconds, side="right")) - 1
    span = times[i + 1] - times[i]
    t = (seconds - times[i]) / span
    if kind == "STEP":
        return np.asarray(rows[i][0])
    if kind == "CUBICSPLINE":
        (_, a, out), (into, b, _) = rows[i], rows[i + 1]
        found = (
            (2 * t**3 - 3 * t**2 + 1) * a + span * (t**3 - 2 * t**2 + t) * out
            + (3 * t**2 - 2 * t**3) * b + span * (t**3 - t**2) * into
        )  # fmt: skip
        return found / np.linalg.norm(found) if turns else np.asarray(found)
    a, b = rows[i][0], rows[i + 1][0]
    if not turns:
        return np.asarray((1 - t) * a + t * b)
    cosine = float(a @ b)
    b, cosine = (b, cosine) if cosine >= 0 else (-b, -cosine)
    angle = np.arccos(min(cosine, 1.0))
    if angle < 1e-4:
        return np.asarray((1 - t) * a + t * b)
    return np.asarray((np.sin((1 - t) * angle) * a + np.sin(t * angle) * b) / np.sin(angle))
