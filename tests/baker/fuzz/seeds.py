"""Sound inputs of every format, small, from which broken ones are made."""

from __future__ import annotations

import base64
import bz2
import gzip
import io
import json
import struct
import tarfile
import zipfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import DracoPy
import numpy as np
import trimesh
from PIL import Image

from furbake import BakeOptions, bake
from furbake.pelt.hairs.strands import Coat, Hairs
from helpers import museum


@dataclass(frozen=True)
class Seed:
    """Files of one input by name; `main` is the one to read, "" a baked folder."""

    name: str
    main: str
    files: dict[str, bytes]


def picture(kind: str = "PNG") -> bytes:
    pixels = np.random.default_rng(1).integers(0, 256, (6, 5, 3), dtype=np.uint8)
    stream = io.BytesIO()
    Image.fromarray(pixels).save(stream, kind)
    return stream.getvalue()


def ball() -> trimesh.Trimesh:
    return trimesh.creation.icosphere(subdivisions=1)


class _Buffer:
    """Arrays in one buffer, with their views and accessors."""

    def __init__(self) -> None:
        self.data = b""
        self.views: list[dict[str, Any]] = []
        self.accessors: list[dict[str, Any]] = []

    def view(self, data: bytes) -> int:
        self.views.append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data)})
        self.data += data + bytes(-len(data) % 4)
        return len(self.views) - 1

    def add(self, values: np.ndarray[Any, Any], kind: str, component: int, **more: Any) -> int:
        view = self.view(np.ascontiguousarray(values).tobytes())
        entry = {"bufferView": view, "componentType": component, "count": len(values), "type": kind}
        self.accessors.append(entry | more)
        return len(self.accessors) - 1


def scene(skinned: bool) -> tuple[dict[str, Any], bytes]:
    """A glTF with texture, colours, a sparse accessor and, if asked for, joints, targets and a clip."""
    body, mesh = _Buffer(), ball()
    count = len(mesh.vertices)
    chance = np.random.default_rng(2)
    attributes = {
        "POSITION": body.add(mesh.vertices.astype("<f4"), "VEC3", 5126),
        "TEXCOORD_0": body.add(chance.integers(0, 65536, (count, 2)).astype("<u2"), "VEC2", 5123, normalized=True),
        "COLOR_0": body.add(chance.integers(0, 256, (count, 4)).astype("<u1"), "VEC4", 5121, normalized=True),
        "_LENGTH": body.add(chance.random(count).astype("<f4"), "SCALAR", 5126),
    }
    body.accessors[0]["sparse"] = {
        "count": 1,
        "indices": {"bufferView": body.view(struct.pack("<H", 3)), "componentType": 5123},
        "values": {"bufferView": body.view(struct.pack("<3f", 0.0, 2.0, 0.0))},
    }
    nodes: list[dict[str, Any]] = [
        {"children": [1, 2], "rotation": [0, 0.6, 0, 0.8], "translation": [1, 0, 0]},
        {"mesh": 0, "scale": [1, 2, -1]},
        {"matrix": np.eye(4).reshape(-1).tolist()},
    ]
    document: dict[str, Any] = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": nodes,
        "meshes": [{"primitives": [{"attributes": attributes, "indices": 4, "material": 0, "mode": 4}]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "baseColorFactor": [1, 1, 0.5, 1]}}],
        "textures": [{"source": 0, "sampler": 0}],
        "samplers": [{"wrapS": 33071}],
        "images": [{"uri": "coat.png"}],
    }
    body.add(mesh.faces.reshape(-1).astype("<u2"), "SCALAR", 5123)
    if skinned:
        attributes["JOINTS_0"] = body.add(chance.integers(0, 2, (count, 4)).astype("<u1"), "VEC4", 5121)
        attributes["WEIGHTS_0"] = body.add(chance.random((count, 4)).astype("<f4"), "VEC4", 5126)
        inverse = body.add(np.tile(np.eye(4).reshape(16), (2, 1)).astype("<f4"), "MAT4", 5126)
        document["skins"] = [{"joints": [0, 2], "inverseBindMatrices": inverse}]
        nodes[1]["skin"] = 0
        moving(document, body, count)
    document |= {"accessors": body.accessors, "bufferViews": body.views}
    document["buffers"] = [{"byteLength": len(body.data), "uri": "body.bin"}]
    return document, body.data


def moving(document: dict[str, Any], body: _Buffer, count: int) -> None:
    """Two morph targets, one of them sparse, and clips of every interpolation for nodes and targets."""
    chance = np.random.default_rng(3)
    mesh = document["meshes"][0]
    sparse = {
        "count": 2,
        "indices": {"bufferView": body.view(struct.pack("<2H", 1, 5)), "componentType": 5123},
        "values": {"bufferView": body.view(struct.pack("<6f", 0, 1, 0, 1, 0, 0))},
    }
    body.accessors.append({"componentType": 5126, "count": count, "type": "VEC3", "sparse": sparse})
    targets = [len(body.accessors) - 1, body.add(chance.random((count, 3)).astype("<f4"), "VEC3", 5126)]
    mesh["primitives"][0]["targets"] = [{"POSITION": target} for target in targets]
    mesh |= {"weights": [0.0, 0.5], "extras": {"targetNames": ["smile", "blink"]}}
    times = body.add(np.array([0, 0.5, 1], "<f4"), "SCALAR", 5126)
    turns = chance.integers(-127, 128, (3, 4)).astype("<i1")
    outputs = [
        ("translation", "LINEAR", body.add(chance.random((3, 3)).astype("<f4"), "VEC3", 5126)),
        ("rotation", "STEP", body.add(turns, "VEC4", 5120, normalized=True)),
        ("scale", "CUBICSPLINE", body.add(chance.random((9, 3)).astype("<f4"), "VEC3", 5126)),
        ("weights", "LINEAR", body.add(chance.random(6).astype("<f4"), "SCALAR", 5126)),
    ]
    document["animations"] = [
        {
            "name": "walk",
            "samplers": [{"input": times, "output": one, "interpolation": kind} for _, kind, one in outputs],
            "channels": [
                {"sampler": i, "target": {"node": 1 if path == "weights" else 2, "path": path}}
                for i, (path, _, _) in enumerate(outputs)
            ],
        }
    ]


def glb(text: bytes, data: bytes) -> bytes:
    text += b" " * (-len(text) % 4)
    data += bytes(-len(data) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(data), 0x004E4942) + data
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def packed(document: dict[str, Any], data: bytes) -> bytes:
    """The same in one file: the buffer as chunk, the picture in it."""
    image = picture("JPEG")
    view = {"buffer": 0, "byteOffset": len(data), "byteLength": len(image)}
    views = [*document["bufferViews"], view]
    document = document | {
        "buffers": [{"byteLength": len(data) + len(image)}],
        "bufferViews": views,
        "images": [{"bufferView": len(views) - 1, "mimeType": "image/jpeg"}],
    }
    return glb(json.dumps(document).encode(), data + image)


def draco() -> bytes:
    mesh = ball()
    stream = DracoPy.encode(mesh.vertices, mesh.faces)
    attributes = {"POSITION": 0}
    primitive = {
        "attributes": attributes,
        "extensions": {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": attributes}},
    }
    document = {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [primitive]}],
        "accessors": [{"componentType": 5126, "count": len(mesh.vertices), "type": "VEC3"}],
        "buffers": [{"byteLength": len(stream)}],
        "bufferViews": [{"buffer": 0, "byteLength": len(stream)}],
    }
    return glb(json.dumps(document).encode(), stream)


def obj() -> dict[str, bytes]:
    mesh = ball()
    lines = ["mtllib coat.mtl"]
    lines += [f"v {x:.4f} {y:.4f} {z:.4f}" for x, y, z in mesh.vertices]
    lines += ["vt 0 0", "vt 1 0", "vt 0.5 1", "vn 0 0 1", "usemtl skin"]
    lines += [f"f {a + 1}/1/1 {b + 1}/2/1 {c + 1}/3/1" for a, b, c in mesh.faces[:60]]
    lines += ["usemtl plain", "f 1 2 3 4 5 6 7", *(f"f {a + 1} {b + 1} {c - 42}" for a, b, c in mesh.faces[60:])]
    coat = "newmtl skin\nKd 0.8 0.4 0.2\nmap_Kd coat.png\nnewmtl plain\nKd 1 0 0\nd 0.5\n"
    return {"a.obj": "\n".join(lines).encode(), "coat.mtl": coat.encode(), "coat.png": picture()}


def ply(kind: str, strips: bool) -> bytes:
    mesh = ball()
    head = f"ply\nformat {kind} 1.0\ncomment TextureFile coat.png\nelement vertex {len(mesh.vertices)}\n"
    head += "".join(f"property {t} {n}\n" for t, n in zip(("float",) * 5 + ("uchar",) * 3, "xyzstrgb", strict=True))
    head = head.replace(" r\n", " red\n").replace(" g\n", " green\n").replace(" b\n", " blue\n")
    element = "tristrips" if strips else "face"
    rows = [[*mesh.faces.reshape(-1)[:40], -1, *range(12)]] if strips else [*mesh.faces[:70].tolist(), [0, 1, 2, 3]]
    count = "int" if strips else "uchar"
    head += f"element {element} {len(rows)}\nproperty list {count} int vertex_indices\nend_header\n"
    if kind == "ascii":
        text = "".join(f"{x:.3f} {y:.3f} {z:.3f} 0.5 0.25 9 8 7\n" for x, y, z in mesh.vertices)
        return (head + text + "".join(f"{len(row)} {' '.join(map(str, row))}\n" for row in rows)).encode()
    table = np.zeros(len(mesh.vertices), dtype=[("f", "<f4", 5), ("c", "u1", 3)])
    table["f"][:, :3] = mesh.vertices
    body = b"".join(struct.pack("<i" if strips else "<B", len(row)) + np.array(row, "<i4").tobytes() for row in rows)
    return head.encode() + table.tobytes() + body


def archive(kind: str, files: dict[str, bytes]) -> bytes:
    stream = io.BytesIO()
    if kind == "zip":
        with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as zipped:
            for name, data in files.items():
                zipped.writestr(zipfile.ZipInfo(name), data)
        return stream.getvalue()
    with tarfile.open(fileobj=stream, mode="w") as tar:
        for name, data in files.items():
            info = tarfile.TarInfo(name)
            info.size = len(data)
            tar.addfile(info, io.BytesIO(data))
    data = stream.getvalue()
    return gzip.compress(data, mtime=0) if kind == "tar.gz" else bz2.compress(data)


def baked(folder: Path, model: str) -> dict[str, bytes]:
    """Files of a tiny bake."""
    hairs = Hairs(count=12)
    options = BakeOptions(layers=2, size=8, lights=8, coat=Coat(guard=hairs, under=hairs, clumps=3))
    out = folder / f"baked-{Path(model).stem}"
    bake(model, out, options)
    return {path.name: path.read_bytes() for path in out.iterdir()}


def relit(folder: Path) -> list[Seed]:
    """Files of museums."""
    planes = np.random.default_rng(3).integers(0, 256, (museum.H, museum.W, 9), dtype=np.uint8)
    scale, bias = [0.5, 0.75, 0.25, 1.0, 0.5, 2.0], [167, 97, 120, 128, 30, 0]
    plain = planes.tobytes()
    found = [
        Seed(f"ptm {kind.lower()}", "a.ptm", {"a.ptm": museum.head(kind, museum.W, museum.H, scale, bias) + body})
        for kind, body in (("LRGB", plain), ("RGB", plain * 2))
    ]
    found.append(Seed("ptm jpeg", "a.ptm", {"a.ptm": museum.jpeg_ptm(planes, scale, bias)[0]}))
    place = folder / "photographs"
    place.mkdir()
    museum.photographed(place, museum.lamps(9), "jpg", width=6, height=5)
    found.append(Seed("lp", "set.lp", {path.name: path.read_bytes() for path in place.iterdir()}))
    for kind, space, material in (
        ("ptm", "lrgb", {}),
        ("rbf", "mrgb", {"range": [200.0] * 9}),
        ("bilinear", "mycc", {"range": [200.0] * 9}),
    ):
        info = {"type": kind, "colorspace": space, "nplanes": 9, "format": "png", "width": 5, "height": 6}
        info |= {"materials": [{"scale": [1.0] * 9, "bias": [0.1] * 9, **material}], "yccplanes": [5, 2, 2]}
        info |= {"lights": [0.0, 0.6, 0.8] * 4, "sigma": 0.3, "resolution": 2, "basis": [100] * 120}
        pictures = {f"plane_{i}.png": picture() for i in range(3)}
        found.append(Seed(f"relight {kind}", "info.json", {"info.json": json.dumps(info).encode()} | pictures))
    return found


def seeds(folder: Path) -> list[Seed]:
    """All seeds; `folder` is for what is written on the way."""
    found = []
    for skinned in (False, True):
        document, data = scene(skinned)
        kind = "skin" if skinned else "body"
        files = {"a.gltf": json.dumps(document).encode(), "body.bin": data, "coat.png": picture("WEBP")}
        found.append(Seed(f"gltf {kind}", "a.gltf", files))
        uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
        inline = document | {"buffers": [{"byteLength": len(data), "uri": uri}]}
        found.append(Seed(f"gltf {kind} inline", "a.gltf", {"a.gltf": json.dumps(inline).encode()}))
        found.append(Seed(f"glb {kind}", "a.glb", {"a.glb": packed(document, data)}))
    found.append(Seed("draco", "a.glb", {"a.glb": draco()}))
    found.append(Seed("obj", "a.obj", obj()))
    for kind in ("ascii", "binary_little_endian"):
        for strips in (False, True):
            name = f"ply {kind}{' strips' if strips else ''}"
            found.append(Seed(name, "a.ply", {"a.ply": ply(kind, strips), "coat.png": picture()}))
    found.append(Seed("off", "a.off", {"a.off": str(ball().export(file_type="off")).encode()}))
    found.append(Seed("stl", "a.stl", {"a.stl": bytes(ball().export(file_type="stl"))}))
    found.append(Seed("stl text", "a.stl", {"a.stl": str(ball().export(file_type="stl_ascii")).encode()}))
    found += [Seed(kind, f"a.{kind}", {f"a.{kind}": archive(kind, obj())}) for kind in ("zip", "tar.gz", "tar.bz2")]
    found.append(Seed("bz2", "a.obj.bz2", {"a.obj.bz2": bz2.compress(obj()["a.obj"])}))
    found.append(Seed("baked", "", baked(folder, "sphere")))
    character = folder / "character.glb"
    character.write_bytes(packed(*scene(True)))
    found.append(Seed("baked character", "", baked(folder, str(character))))
    return found + relit(folder)
