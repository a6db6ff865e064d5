"""A character written as glTF by a few lines that share no code with the baker."""

from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import Any

import numpy as np

from furbake.surface.rig.rig import BODY, Rig

KINDS = {"f": 5126, "u1": 5121, "u4": 5125}


class Chunk:
    """Binary data with views and accessors, a view each."""

    def __init__(self) -> None:
        self.data, self.views, self.accessors = bytearray(), list[Any](), list[Any]()

    def add(self, values: Any, kind: str, shape: str, **more: Any) -> int:
        stored = np.asarray(values, "<f4" if kind == "f" else f"<{kind}")
        self.views.append({"buffer": 0, "byteOffset": len(self.data), "byteLength": stored.nbytes})
        self.data += stored.tobytes() + bytes(-stored.nbytes % 4)
        count = stored.size // {"SCALAR": 1, "VEC3": 3, "VEC4": 4, "MAT4": 16}[shape]
        record = {"bufferView": len(self.views) - 1, "componentType": KINDS[kind], "count": count, "type": shape}
        self.accessors.append(record | more)
        return len(self.accessors) - 1


def write_glb(path: Path, rig: Rig) -> Path:
    """The rig's triangles with all that moves them; the body is node 0, the rig's nodes follow."""
    chunk = Chunk()
    low, high = rig.vertices.min(axis=0).tolist(), rig.vertices.max(axis=0).tolist()
    attributes = {"POSITION": chunk.add(rig.vertices, "f", "VEC3", min=low, max=high)}
    if rig.joints:
        attributes["JOINTS_0"] = chunk.add(np.where(rig.shares > 0, rig.which, 0), "u1", "VEC4")
        attributes["WEIGHTS_0"] = chunk.add(rig.shares, "f", "VEC4")
    primitive: dict[str, Any] = {"attributes": attributes, "indices": chunk.add(rig.faces, "u4", "SCALAR")}
    mesh: dict[str, Any] = {"primitives": [primitive]}
    if rig.targets:
        primitive["targets"] = [{"POSITION": chunk.add(each.deltas, "f", "VEC3")} for each in rig.targets]
        mesh["weights"] = [each.weight for each in rig.targets]
        mesh["extras"] = {"targetNames": [each.name for each in rig.targets]}
    nodes: list[dict[str, Any]] = [{"mesh": 0, **({"skin": 0} if rig.joints else {})}]
    nodes += [
        {"name": node.name} | {path: getattr(node, path).tolist() for path in ("translation", "rotation", "scale")}
        for node in rig.nodes
    ]
    for index, node in enumerate(rig.nodes, 1):
        if node.parent >= 0:
            nodes[node.parent + 1].setdefault("children", []).append(index)
    animations = []
    for clip in rig.clips:
        samplers = [
            {"input": chunk.add(each.times, "f", "SCALAR"), "interpolation": each.interpolation,
             "output": chunk.add(each.values, "f", {"rotation": "VEC4", "weights": "SCALAR"}.get(each.path, "VEC3"))}
            for each in clip.channels
        ]  # fmt: skip
        channels = [
            {"sampler": i, "target": {"node": 0 if each.node == BODY else each.node + 1, "path": each.path}}
            for i, each in enumerate(clip.channels)
        ]
        animations.append({"name": clip.name, "channels": channels, "samplers": samplers})
    inverse = chunk.add(rig.inverse_bind.swapaxes(1, 2), "f", "MAT4") if rig.joints else -1
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "meshes": [mesh], "nodes": nodes, "animations": animations,
        "scenes": [{"nodes": [0, *(i for i, node in enumerate(rig.nodes, 1) if node.parent < 0)]}],
        "accessors": chunk.accessors, "bufferViews": chunk.views, "buffers": [{"byteLength": len(chunk.data)}],
    }  # fmt: skip
    if rig.joints:
        document["skins"] = [{"joints": [joint + 1 for joint in rig.joints], "inverseBindMatrices": inverse}]
    text = json.dumps({key: value for key, value in document.items() if value != []}).encode()
    text += b" " * (-len(text) % 4)
    parts = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(chunk.data), 0x004E4942)
    path.write_bytes(struct.pack("<III", 0x46546C67, 2, 12 + len(parts) + len(chunk.data)) + parts + bytes(chunk.data))
    return path
