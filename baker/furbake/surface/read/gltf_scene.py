"""The scene of a glTF file as one soup in its bind pose, with its materials and all that moves it."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from furbake.surface.files import Source
from furbake.surface.material import CLAMP, MIRROR, REPEAT, Material, Picture
from furbake.surface.read.gltf_data import GltfData, Record
from furbake.surface.read.gltf_nodes import places
from furbake.surface.read.gltf_parts import CORNERS, read_part
from furbake.surface.read.moving.rig import rigged
from furbake.surface.rig.rig import Rig
from furbake.surface.soup import Soup, join


class Scene(NamedTuple):
    """Soup, None where the scene has no triangle; materials; number of missing pictures; notices; what moves it."""

    soup: Soup | None
    materials: tuple[Material, ...]
    missing: int
    notices: tuple[str, ...]
    rig: Rig | None = None


def read_gltf(source: Source) -> Scene:
    """Everything of a file's scene that fur can use.

    Raises UndecodableError, and any error for a broken file.
    """
    data = GltfData(source)
    found = [_material(data, record) for record in data.list_of("materials")]
    materials, missing = tuple(material for material, _ in found), sum(lost for _, lost in found)
    where, parents = places(data)
    parts = []
    for index in where:
        node = data.list_of("nodes")[index]
        if "mesh" not in node:
            continue
        for primitive in data.item("meshes", node["mesh"])["primitives"]:
            part = read_part(data, primitive, index, node.get("skin"), len(materials))
            if part is not None:
                parts.append(part)
    moving = rigged(data, where, parents, parts)
    soups = [part.placed(matrix) for part, matrix in zip(parts, moving.binds, strict=True)]
    widths = {name: values.shape[2] for soup in soups for name, values in soup.attributes.items()}
    data.numbers.take(CORNERS * sum(len(soup.faces) for soup in soups) * sum(widths.values()))
    soup = join(soups) if soups else None
    rig, notices = moving.whole(soup)
    return Scene(soup, (*materials, Material()), missing, notices, rig)


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
