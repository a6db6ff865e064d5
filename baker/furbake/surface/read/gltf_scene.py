"""The scene of a glTF file as one soup: nodes, primitives, skins in their bind pose, materials."""

from __future__ import annotations

from typing import Any

import numpy as np

from furbake.surface.files import Source
from furbake.surface.material import CLAMP, MIRROR, REPEAT, Material, Picture
from furbake.surface.read.gltf_data import COMPRESSED, DRACO, GltfData, Record, UndecodableError
from furbake.surface.soup import Floats, Ints, Soup, join

TRIANGLES, STRIP, FAN = 4, 5, 6

CORNERS = 3

PER_JOINED = 80
"""Numbers in memory for each vertex that joints move: the matrices of four joints, and their mean."""

STANDARD = ("POSITION", "NORMAL", "TANGENT", "TEXCOORD_", "COLOR_", "JOINTS_", "WEIGHTS_")

DIRECTIONS = ("_COMB", "_DIRECTION")
"""Attributes that are vectors in the node's space and turn with it."""


MAX_NAMES = 5
"""Clips that a notice names."""


def read_gltf(source: Source) -> tuple[Soup | None, tuple[Material, ...], int, tuple[str, ...]]:
    """Soup, materials, the number of missing pictures, and notices; no soup where the scene has no triangle.

    Raises UndecodableError, and any error for a broken file.
    """
    data = GltfData(source)
    found = [_material(data, record) for record in data.list_of("materials")]
    materials, missing = tuple(material for material, _ in found), sum(lost for _, lost in found)
    places = _places(data)
    skins: dict[int, Floats] = {}
    soups = []
    for index, place in places.items():
        node = data.list_of("nodes")[index]
        if "mesh" not in node:
            continue
        if "skin" in node and node["skin"] not in skins:
            skins[node["skin"]] = _joints(data, places, node["skin"])
        joints = skins[node["skin"]] if "skin" in node else None
        for primitive in data.item("meshes", node["mesh"])["primitives"]:
            soup = _primitive(data, primitive, place, joints, len(materials))
            if soup is not None and len(soup.faces):
                soups.append(soup)
    widths = {name: values.shape[2] for soup in soups for name, values in soup.attributes.items()}
    data.numbers.take(CORNERS * sum(len(soup.faces) for soup in soups) * sum(widths.values()))
    return (join(soups) if soups else None), (*materials, Material()), missing, _motion(data, places)


def _motion(data: GltfData, places: dict[int, Floats]) -> tuple[str, ...]:
    """A notice of clips, joints and morph targets of the scene, which a bake does not keep; () where it has none."""
    clips: list[Any] = data.list_of("animations")
    nodes = data.list_of("nodes")
    joints = sum(
        len(data.item("skins", index)["joints"]) for index in {nodes[i]["skin"] for i in places if "skin" in nodes[i]}
    )
    shapes = [data.item("meshes", nodes[i]["mesh"])["primitives"] for i in places if "mesh" in nodes[i]]
    targets = max((len(part.get("targets", ())) for parts in shapes for part in parts), default=0)
    if not clips and not joints and not targets:
        return ()
    names = [str(clip["name"])[:40] for clip in clips if isinstance(clip, dict) and clip.get("name")]
    named = f" ({', '.join(names[:MAX_NAMES])}{', ...' if len(names) > MAX_NAMES else ''})" if names else ""
    counts = ((len(clips), f"clip{'s' * (len(clips) != 1)}{named}"), (joints, f"joint{'s' * (joints != 1)}"),
              (targets, f"morph target{'s' * (targets != 1)}"))  # fmt: skip
    lost = ", ".join(f"{number} {text}" for number, text in counts if number)
    return (f"animation is not kept ({lost}): the fur stands still, in the pose that the file rests in",)


def _places(data: GltfData) -> dict[int, Floats]:
    """(4, 4) matrix of every node of the scene, parents first."""
    nodes = data.list_of("nodes")
    scenes = data.list_of("scenes")
    if scenes:
        roots = list(data.item("scenes", data.json.get("scene", 0)).get("nodes", []))
    else:
        below = {child for node in nodes for child in node.get("children", [])}
        roots = [index for index in range(len(nodes)) if index not in below]
    found: dict[int, Floats] = {}
    todo = [(root, np.eye(4)) for root in roots]
    while todo:
        index, above = todo.pop()
        node = data.item("nodes", index)
        if index in found:
            raise ValueError(f"node {index} is in the scene twice")
        found[index] = above @ _matrix(node)
        todo += [(child, found[index]) for child in node.get("children", [])]
    return dict(sorted(found.items()))


def _matrix(node: Record) -> Floats:
    if "matrix" in node:
        return np.array(node["matrix"], dtype=np.float64).reshape(4, 4).T
    x, y, z, w = np.array(node.get("rotation", (0, 0, 0, 1)), dtype=np.float64)
    turn = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
    matrix = np.eye(4)
    matrix[:3, :3] = turn * np.array(node.get("scale", (1, 1, 1)), dtype=np.float64).reshape(3)
    matrix[:3, 3] = np.array(node.get("translation", (0, 0, 0)), dtype=np.float64).reshape(3)
    return matrix


def _joints(data: GltfData, places: dict[int, Floats], index: Any) -> Floats:
    """(J, 4, 4) matrices that bring a skin's vertices to where its joints stand in the file."""
    skin = data.item("skins", index)
    stand = np.stack([places.get(joint, np.eye(4)) for joint in skin["joints"]])
    if "inverseBindMatrices" not in skin:
        return stand
    return stand @ data.accessor(skin["inverseBindMatrices"]).reshape(-1, 4, 4).transpose(0, 2, 1)


def _primitive(data: GltfData, record: Record, place: Floats, joints: Floats | None, default: int) -> Soup | None:
    """Triangles of a primitive in the scene's space; None for points and lines."""
    mode = record.get("mode", TRIANGLES)
    if mode not in (TRIANGLES, STRIP, FAN):
        return None
    extensions, attributes = record.get("extensions", {}), record["attributes"]
    squeezed: dict[str, Floats] = {}
    if DRACO in extensions:
        faces, squeezed = data.draco(extensions[DRACO])
    elif "indices" in record:
        faces = _faces(data.accessor(record["indices"]).reshape(-1).astype(np.int64), mode)
    else:
        count = int(data.item("accessors", attributes["POSITION"])["count"])
        data.numbers.take(count)
        faces = _faces(np.arange(count), mode)
    for name in (name for name in COMPRESSED if name in extensions):
        raise UndecodableError(name)

    arrays = {
        name: squeezed[name] if name in squeezed else data.accessor(index)
        for name, index in attributes.items()
        if not name.startswith(("NORMAL", "TANGENT"))
    }
    vertices = arrays["POSITION"]
    if vertices.shape[1] != 3 or any(len(values) != len(vertices) for values in arrays.values()):
        raise ValueError("attributes of different lengths")
    if len(faces) and faces.max() >= len(vertices):
        raise ValueError(f"a face uses vertex {faces.max()} of {len(vertices)}")
    data.numbers.take(CORNERS * len(faces) * sum(values.shape[1] for values in arrays.values()))
    if joints is not None:
        data.numbers.take(PER_JOINED * len(vertices))
    vertices = _moved(vertices, arrays, place, joints)
    soup = Soup(
        vertices=vertices,
        faces=faces,
        part=np.full(len(faces), record.get("material", default), dtype=np.int64),
        uv=_coordinates(data, record, arrays, faces),
        paint=_paint(arrays, faces),
        attributes=_numbers(arrays, faces, place),
    )
    mirrored = joints is None and np.linalg.det(place[:3, :3]) < 0.0
    return soup.turn(np.full(len(faces), mirrored)) if mirrored else soup


def _faces(corners: Ints, mode: int) -> Ints:
    if mode == TRIANGLES:
        return corners[: len(corners) // 3 * 3].reshape(-1, 3)
    if len(corners) < 3:
        return np.zeros((0, 3), dtype=np.int64)
    first, second, third = corners[:-2], corners[1:-1], corners[2:]
    if mode == FAN:
        return np.stack([np.full(len(third), corners[0]), second, third], axis=1)
    odd = np.arange(len(third)) % 2 == 1
    return np.stack([first, np.where(odd, third, second), np.where(odd, second, third)], axis=1)


def _moved(vertices: Floats, arrays: dict[str, Floats], place: Floats, joints: Floats | None) -> Floats:
    if joints is None or "JOINTS_0" not in arrays or "WEIGHTS_0" not in arrays:
        return vertices @ place[:3, :3].T + place[:3, 3]
    which, share = arrays["JOINTS_0"].astype(np.int64), arrays["WEIGHTS_0"]
    share = share / np.maximum(share.sum(axis=1, keepdims=True), 1e-12)
    blend = np.einsum("vj,vjab->vab", share, joints[np.clip(which, 0, len(joints) - 1)])
    return np.asarray(np.einsum("vab,vb->va", blend[:, :3, :3], vertices) + blend[:, :3, 3])


def _numbers(arrays: dict[str, Floats], faces: Ints, place: Floats) -> dict[str, Floats]:
    """Further numbers of the corners by lower-case name; `color` has the vertex colours as stored."""
    numbers = {
        name.lstrip("_").lower(): values @ place[:3, :3].T if name in DIRECTIONS and values.shape[1] == 3 else values
        for name, values in arrays.items()
        if not name.startswith(STANDARD)
    }
    if "COLOR_0" in arrays:
        numbers["color"] = arrays["COLOR_0"]
    return {name: values[faces] for name, values in numbers.items() if np.isfinite(values).all()}


def _paint(arrays: dict[str, Floats], faces: Ints) -> Floats | None:
    rgb = arrays.get("COLOR_0")
    if rgb is None or rgb.shape[1] not in (3, 4):
        return None
    alpha = rgb[:, 3:4] if rgb.shape[1] == 4 else np.ones((len(rgb), 1))
    rgba = np.nan_to_num(np.concatenate([rgb[:, :3], alpha], axis=1), nan=1.0)
    return np.asarray(np.clip(rgba, 0.0, 1.0)[faces])


def _coordinates(data: GltfData, record: Record, arrays: dict[str, Floats], faces: Ints) -> Floats | None:
    """(F, 3, 2) the coordinates of the base colour's picture, its KHR_texture_transform applied, else the first set."""
    info: Record = {}
    if "material" in record:
        material = data.item("materials", record["material"])
        info = material.get("pbrMetallicRoughness", {}).get("baseColorTexture", {})
    shift = info.get("extensions", {}).get("KHR_texture_transform", {})
    name = f"TEXCOORD_{shift.get('texCoord', info.get('texCoord', 0))}"
    values = arrays.get(name, arrays.get("TEXCOORD_0"))
    if values is None or values.shape[1] != 2:
        return None
    values = values * np.array(shift.get("scale", (1, 1)), dtype=np.float64)
    sine, cosine = np.sin(shift.get("rotation", 0.0)), np.cos(shift.get("rotation", 0.0))
    values = values @ np.array([[cosine, -sine], [sine, cosine]]) + np.array(shift.get("offset", (0, 0)))
    return np.asarray(values[faces], dtype=np.float64)


def _material(data: GltfData, record: Record) -> tuple[Material, bool]:
    """A material, and whether its picture is missing."""
    base = record.get("pbrMetallicRoughness", {})
    red, green, blue, alpha = (_share(value) for value in base.get("baseColorFactor", (1, 1, 1, 1)))
    picture, wrap, lost = None, (REPEAT, REPEAT), False
    if "baseColorTexture" in base:
        try:
            picture, wrap = _picture(data, base["baseColorTexture"])
        except (ValueError, KeyError, IndexError, TypeError, OSError):
            lost = True
    # Where a picture says what is metal, and that picture is not kept, nothing is.
    shiny = "metallicRoughnessTexture" not in base
    material = Material(
        name=str(record.get("name", "")),
        factor=(red, green, blue, alpha),
        metallic=_share(base.get("metallicFactor", 1.0)) if shiny else 0.0,
        roughness=_share(base.get("roughnessFactor", 1.0)) if shiny else 1.0,
        double_sided=bool(record.get("doubleSided", False)),
        alpha=record["alphaMode"] if record.get("alphaMode") in ("MASK", "BLEND") else "OPAQUE",
        cutoff=_share(record.get("alphaCutoff", 0.5)),
        picture=picture,
        wrap=wrap,
    )
    return material, lost


def _share(value: Any) -> float:
    """A factor, 0..1. Raises ValueError where it is no number."""
    number = float(value)
    if not np.isfinite(number):
        raise ValueError(f"a factor of {number}")
    return min(max(number, 0.0), 1.0)


def _picture(data: GltfData, info: Record) -> tuple[Picture, tuple[int, int]]:
    texture = data.item("textures", info["index"])
    webp = texture.get("extensions", {}).get("EXT_texture_webp", {})
    content = data.image(texture["source"] if "source" in texture else webp["source"])
    sampler = data.item("samplers", texture["sampler"]) if "sampler" in texture else {}
    wraps = [sampler.get(name, REPEAT) for name in ("wrapS", "wrapT")]
    across, down = (wrap if wrap in (REPEAT, CLAMP, MIRROR) else REPEAT for wrap in wraps)
    return Picture(content, media_type(content)), (across, down)


def media_type(content: bytes) -> str:
    """The media type of an image by its first bytes. Raises ValueError where it is none of glTF's."""
    if content.startswith(b"\x89PNG\r\n\x1a\n"):
        return "image/png"
    if content.startswith(b"\xff\xd8\xff"):
        return "image/jpeg"
    if content.startswith(b"RIFF") and content[8:12] == b"WEBP":
        return "image/webp"
    raise ValueError("a picture that is neither PNG, JPEG nor WebP")
