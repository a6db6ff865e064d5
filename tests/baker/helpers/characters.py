"""Small glTF characters, and where they stand: plain sums over the numbers that were put in."""

from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import Any

import numpy as np

CODES = {"int8": 5120, "uint8": 5121, "int16": 5122, "uint16": 5123, "uint32": 5125, "float32": 5126}
KINDS = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}

Array = np.ndarray[Any, Any]

ROWS, COLUMNS = 13, 8
"""Rings of the tube, and vertices of each."""


class Character:
    """A .glb file as it is put together; `numbers` are those of its accessors, decoded."""

    def __init__(self) -> None:
        self.json: dict[str, Any] = {"asset": {"version": "2.0"}, "accessors": [], "bufferViews": [], "nodes": []}
        self.json |= {"scene": 0, "scenes": [{"nodes": []}], "meshes": []}
        self.data = bytearray()
        self.numbers: list[Array] = []

    def view(self, data: bytes) -> int:
        self.data += bytes(-len(self.data) % 4)
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data)})
        self.data += data
        return len(self.json["bufferViews"]) - 1

    def add(self, values: Any, kind: str = "float32", *, scalars: bool = False) -> int:
        """An accessor: float32 as it is, another kind as normalised integers; with a `!` as whole numbers."""
        values = np.asarray(values, dtype=np.float64)
        flat = values.reshape(-1, 1) if scalars else values.reshape(len(values), -1)
        dtype = np.dtype(kind.rstrip("!"))
        normalised = dtype.kind in "iu" and not kind.endswith("!")
        whole = np.rint(flat * np.iinfo(dtype).max if normalised else flat) if dtype.kind in "iu" else flat
        stored = whole.astype(dtype)
        record = {"componentType": CODES[dtype.name], "count": len(flat), "type": KINDS[flat.shape[1]]}
        self.json["accessors"].append({**record, "bufferView": self.view(stored.tobytes())})
        if normalised:
            self.json["accessors"][-1]["normalized"] = True
        scale = np.iinfo(dtype).max if normalised else 1.0
        self.numbers.append(np.maximum(stored.astype(np.float64) / scale, -1.0) if normalised else stored.astype(float))
        return len(self.numbers) - 1

    def add_sparse(self, values: Any) -> int:
        """The same in a sparse accessor without a buffer view."""
        values = np.asarray(values, dtype=np.float32)
        rows = np.flatnonzero(values.any(axis=1)).astype(np.uint16)
        sparse = {"count": len(rows), "indices": {"bufferView": self.view(rows.tobytes()), "componentType": 5123}}
        sparse["values"] = {"bufferView": self.view(values[rows].tobytes())}
        self.json["accessors"].append({"componentType": 5126, "count": len(values), "type": "VEC3", "sparse": sparse})
        self.numbers.append(values.astype(np.float64))
        return len(self.numbers) - 1

    def node(self, *, above: int | None = None, **record: Any) -> int:
        self.json["nodes"].append(record)
        index = len(self.json["nodes"]) - 1
        if above is None:
            self.json["scenes"][0]["nodes"].append(index)
        else:
            self.json["nodes"][above].setdefault("children", []).append(index)
        return index

    def mesh(self, vertices: Any, faces: Any, kind: str = "float32", **record: Any) -> int:
        attributes = {"POSITION": self.add(vertices, kind)}
        self.json["meshes"].append({"primitives": [{"attributes": attributes}], **record})
        self.json["meshes"][-1]["primitives"][0]["indices"] = self.add(faces, "uint16!", scalars=True)
        return len(self.json["meshes"]) - 1

    def primitive(self, mesh: int) -> dict[str, Any]:
        found: dict[str, Any] = self.json["meshes"][mesh]["primitives"][0]
        return found

    def skin(self, joints: list[int], inverse_bind: Any = None, **record: Any) -> int:
        if inverse_bind is not None:
            record["inverseBindMatrices"] = self.add(np.asarray(inverse_bind).transpose(0, 2, 1))
        self.json.setdefault("skins", []).append({"joints": joints, **record})
        return len(self.json["skins"]) - 1

    def clip(self, name: str | None, *channels: tuple[Any, str, Any, Any, str], kind: str = "float32") -> None:
        """Channels: node, path, times, values, interpolation."""
        record: dict[str, Any] = {"channels": [], "samplers": []} | ({} if name is None else {"name": name})
        for node, path, times, values, interpolation in channels:
            sampler = {"input": self.add(times, scalars=True), "interpolation": interpolation}
            sampler["output"] = self.add(values, kind, scalars=path == "weights")
            record["channels"].append({"sampler": len(record["samplers"]), "target": {"node": node, "path": path}})
            record["samplers"].append(sampler)
        self.json.setdefault("animations", []).append(record)

    def write(self, folder: Path, name: str = "model.glb") -> Path:
        self.json["buffers"] = [{"byteLength": len(self.data)}]
        text = json.dumps(self.json).encode()
        text += b" " * (-len(text) % 4)
        data = bytes(self.data) + bytes(-len(self.data) % 4)
        chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(data), 0x004E4942) + data
        (folder / name).write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)
        return folder / name


def tube(rows: int = ROWS, columns: int = COLUMNS) -> tuple[Array, Array]:
    """A tube along y from 0 to 3, thick 0.5."""
    height, turn = np.repeat(np.linspace(0, 3, rows), columns), np.tile(np.arange(columns) / columns * 2 * np.pi, rows)
    r, c = (index.reshape(-1) for index in np.mgrid[: rows - 1, :columns])
    a, b = r * columns + c, r * columns + (c + 1) % columns
    faces = np.concatenate([np.stack([a, b + columns, b], 1), np.stack([a, a + columns, b + columns], 1)])
    return np.stack([0.25 * np.cos(turn), height, 0.25 * np.sin(turn)], axis=1), faces


def tube_weights(vertices: Array) -> tuple[Array, Array]:
    """(V, 4) joints and weights of three joints at y = 0, 1 and 2, that take over from each other."""
    along = np.clip(vertices[:, 1] - 0.5, 0.0, 1.999)
    first = np.floor(along)
    nothing = np.zeros_like(first)
    return np.stack([first, first + 1, nothing, nothing], 1), np.stack(
        [1 - along + first, along - first] + 2 * [nothing], 1
    )


def turn(axis: Any, degrees: float) -> Array:
    """Quaternion x, y, z, w."""
    half = np.radians(degrees) / 2
    return np.append(np.sin(half) * np.asarray(axis, dtype=float) / np.linalg.norm(axis), np.cos(half))


def bent_tube(positions: str = "float32", weights: str = "float32", joints: str = "uint8!") -> Character:
    """A tube with three joints in a chain below a root that is turned, in a scene that is twice as large."""
    made = Character()
    vertices, faces = tube()
    scene = made.node(scale=[2, 2, 2], name="scene")
    small = {"float32": 1.0, "int16": 0.25, "int16!": 8000.0}[positions]  # normalised integers reach to 1
    mesh = made.mesh(small * vertices, faces, positions)
    which, share = tube_weights(vertices)
    made.primitive(mesh)["attributes"] |= {"JOINTS_0": made.add(which, joints), "WEIGHTS_0": made.add(share, weights)}
    root = made.node(above=scene, name="root", rotation=turn([0, 0, 1], 90).tolist())
    one = made.node(above=root, name="one")
    two = made.node(above=one, name="two", translation=[0, 1, 0])
    three = made.node(above=two, name="three", translation=[0, 1, 0])
    own = np.diag([1 / small, 1 / small, 1 / small, 1.0])
    inverse = np.array([np.eye(4)] * 3)
    inverse[:, 1, 3] = 0.0, -1.0, -2.0
    made.node(above=scene, name="body", mesh=mesh, skin=made.skin([one, two, three], inverse @ own))
    return made


def plate(made: Character, *targets: Any, sparse: bool = False, **node: Any) -> int:
    """A node with a grid of 5 by 5 vertices that morphs."""
    x, z = (value.reshape(-1) / 4.0 for value in np.mgrid[0:5, 0:5])
    r, c = (value.reshape(-1) for value in np.mgrid[0:4, 0:4])
    a = 5 * r + c
    faces = np.concatenate([np.stack([a, a + 1, a + 6], 1), np.stack([a, a + 6, a + 5], 1)])
    mesh = made.mesh(np.stack([x, np.zeros(25), z], axis=1), faces)
    add = made.add_sparse if sparse else made.add
    made.primitive(mesh)["targets"] = [{"POSITION": add(deltas)} for deltas in targets]
    return made.node(mesh=mesh, **node)


def humps(seed: int, number: int) -> list[Any]:
    chance = np.random.default_rng(seed)
    found = chance.normal(size=(number, 25, 3))
    found[:, ::3] = 0.0
    return list(found)


def matrix_of(record: dict[str, Any]) -> Array:
    if "matrix" in record:
        return np.array(record["matrix"], dtype=float).reshape(4, 4).T
    x, y, z, w = np.array(record.get("rotation", (0, 0, 0, 1)), dtype=float)
    found = np.eye(4)
    found[:3, 0] = 1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)
    found[:3, 1] = 2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)
    found[:3, 2] = 2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)
    found[:3, :3] *= np.array(record.get("scale", (1, 1, 1)), dtype=float)
    found[:3, 3] = record.get("translation", (0, 0, 0))
    return found


def value_at(times: Array, values: Array, kind: str, path: str, now: float) -> Array:
    """A channel at a time, key by key, as glTF 2.0's appendix C has it."""
    cubic = kind == "CUBICSPLINE"
    values = values.reshape(len(times), 3 if cubic else 1, -1)
    keys = values[:, 1] if cubic else values[:, 0]
    if now <= times[0] or now >= times[-1]:
        return np.array(keys[0 if now <= times[0] else -1])
    k = max(i for i in range(len(times)) if times[i] <= now)
    length = times[k + 1] - times[k]
    t = (now - times[k]) / length
    if kind == "STEP":
        return np.array(keys[k])
    if cubic:
        found = (2 * t**3 - 3 * t**2 + 1) * keys[k] + length * (t**3 - 2 * t**2 + t) * values[k, 2]
        found = found + (-2 * t**3 + 3 * t**2) * keys[k + 1] + length * (t**3 - t**2) * values[k + 1, 0]
        return np.array(found / np.linalg.norm(found) if path == "rotation" else found)
    if path != "rotation":
        return np.array((1 - t) * keys[k] + t * keys[k + 1])
    a, b = keys[k] / np.linalg.norm(keys[k]), keys[k + 1] / np.linalg.norm(keys[k + 1])
    cosine = a @ b
    b, cosine = (-b, -cosine) if cosine < 0 else (b, cosine)
    angle = np.arccos(min(cosine, 1.0))
    if angle < 1e-6:
        return np.array(a)
    return np.array((np.sin((1 - t) * angle) * a + np.sin(t * angle) * b) / np.sin(angle))


def standing(made: Character, clip: int | None = None, now: float = 0.0) -> Array:
    """(V, 3) all vertices of the scene in a pose of a clip: morph targets, then joints."""
    nodes = [dict(node) for node in made.json["nodes"]]
    weights: dict[int, Array] = {}
    for channel in made.json["animations"][clip]["channels"] if clip is not None else []:
        sampler = made.json["animations"][clip]["samplers"][channel["sampler"]]
        node, path = channel["target"]["node"], channel["target"]["path"]
        times, values = made.numbers[sampler["input"]][:, 0], made.numbers[sampler["output"]]
        value = value_at(times, values, sampler["interpolation"], path, now)
        if path == "weights":
            weights[node] = value
        else:
            nodes[node][path] = value / np.linalg.norm(value) if path == "rotation" else value
    world: dict[int, Array] = {}

    def walk(index: int, above: Array) -> None:
        world[index] = above @ matrix_of(nodes[index])
        for child in nodes[index].get("children", ()):
            walk(child, world[index])

    for root in made.json["scenes"][0]["nodes"]:
        walk(root, np.eye(4))
    return np.concatenate(
        [_stands(made, node, world, weights.get(i)) for i, node in enumerate(nodes) if "mesh" in node and i in world]
    )


def _stands(made: Character, node: dict[str, Any], world: dict[int, Array], weights: Array | None) -> Array:
    mesh = made.json["meshes"][node["mesh"]]
    record = mesh["primitives"][0]
    attributes = record["attributes"]
    places = made.numbers[attributes["POSITION"]]
    resting = node.get("weights", mesh.get("weights", [0.0] * len(record.get("targets", ()))))
    for weight, target in zip(resting if weights is None else weights, record.get("targets", ()), strict=True):
        places = places + weight * made.numbers[target["POSITION"]]
    places = np.column_stack([places, np.ones(len(places))])
    index = next(i for i, one in enumerate(made.json["nodes"]) if one.get("mesh") == node["mesh"])
    if "skin" not in node:
        return np.array((places @ world[index].T)[:, :3])
    skin = made.json["skins"][node["skin"]]
    bind = made.numbers[skin["inverseBindMatrices"]].reshape(-1, 4, 4).transpose(0, 2, 1)
    moved = [world[joint] @ bind[j] for j, joint in enumerate(skin["joints"])]
    total, sums = np.zeros_like(places), np.zeros((len(places), 1))
    for i in range(2):
        if f"JOINTS_{i}" not in attributes:
            break
        which, share = made.numbers[attributes[f"JOINTS_{i}"]], made.numbers[attributes[f"WEIGHTS_{i}"]]
        sums += share.sum(axis=1, keepdims=True)
        for v in range(len(places)):
            for j in range(which.shape[1]):
                total[v] += share[v, j] * (moved[int(which[v, j])] @ places[v])
    return np.array((total / sums)[:, :3])
