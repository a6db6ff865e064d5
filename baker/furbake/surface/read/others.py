"""Formats that trimesh reads, unprocessed; files beside a model are handed to it by our own bounds."""

from __future__ import annotations

import io
from typing import Any, NoReturn

import numpy as np
import trimesh
from trimesh.resolvers import Resolver

from furbake.surface.colours import as_png, decode, from_srgb
from furbake.surface.files import Source
from furbake.surface.material import Material, Picture
from furbake.surface.read.gltf_scene import Scene, media_type
from furbake.surface.read.ply import has_strips, triangulated
from furbake.surface.read.polygons import recut
from furbake.surface.rig.kept import shown
from furbake.surface.soup import Floats, Ints, Soup, join

STAND_IN = as_png(np.zeros((1, 1, 4), np.uint8)).data
"""A picture of one pixel."""


class _Beside(Resolver):
    """Files beside a model, for trimesh, which decodes none of the pictures: it is given a stand-in for each.

    trimesh takes libraries of materials by `[name]` and pictures by `get(name)`.

    pictures : names of those that were found; missing : of those that were not, or are too large
    libraries : names of those of materials that were not
    """

    def __init__(self, model: Source) -> None:
        self._model = model
        self.pictures: list[str] = []
        self.missing: set[str] = set()
        self.libraries: list[str] = []

    def __getitem__(self, key: str) -> bytes:
        try:
            return self._model.find(key)
        except (OSError, ValueError):
            self.libraries.append(key)
            raise

    def get(self, key: str) -> bytes:
        try:
            self._model.find(key)
        except (OSError, ValueError):
            self.missing.add(key)
            raise
        self.pictures.append(key)
        return STAND_IN

    def keys(self) -> list[str]:
        return []

    def write(self, name: str, data: Any) -> NoReturn:
        raise NotImplementedError

    def namespaced(self, namespace: str) -> NoReturn:
        raise NotImplementedError


def read_other(model: Source, kind: str) -> Scene:
    """The scene of a file; no soup where there is no triangle."""
    files = _Beside(model)
    scene = _scene(model.data, kind, files)
    parts = [part for part in scene.dump() if isinstance(part, trimesh.Trimesh) and len(part.faces)]
    materials: dict[Material, int] = {}
    pictures: dict[str, Picture | None] = {}
    soups: list[Soup] = []
    for part in parts:
        visual: Any = part.visual
        material = _material(visual, model, files, pictures)
        index = materials.setdefault(material, len(materials))
        faces = np.asarray(part.faces, dtype=np.int64).reshape(-1, 3)
        vertices = np.asarray(part.vertices, dtype=np.float64).reshape(-1, 3)
        numbers = {
            str(name).lstrip("_").lower(): np.asarray(values, dtype=np.float64).reshape(len(vertices), -1)
            for name, values in part.vertex_attributes.items()
            if np.asarray(values).dtype.kind in "iuf" and np.shape(values)[:1] == (len(vertices),)
        }
        if visual.kind == "vertex" and len(visual.vertex_colors) == len(vertices):
            numbers["color"] = np.asarray(visual.vertex_colors, dtype=np.float64) / 255.0
        inside = faces.min() >= 0 and faces.max() < len(vertices)
        if inside:
            faces = recut(vertices, faces)
        soups.append(
            Soup(
                vertices=vertices,
                faces=faces,
                part=np.full(len(faces), index),
                uv=_coordinates(visual, faces) if inside else None,
                paint=_paint(visual, faces) if inside else None,
                attributes={name: values[faces] for name, values in numbers.items()} if inside else {},
            )
        )
    missing = len(files.missing) + sum(picture is None for picture in pictures.values())
    told = tuple(f"materials of {shown(name)} left out, which cannot be read" for name in files.libraries)
    return Scene(join(soups) if soups else None, tuple(materials), missing, told)


def _scene(data: bytes, kind: str, files: _Beside) -> trimesh.Scene:
    """The scene as trimesh reads it; a PLY file that it cannot read with its polygons cut."""

    def load(data: bytes) -> trimesh.Scene:
        return trimesh.load_scene(io.BytesIO(data), file_type=kind, resolver=files, process=False)

    if kind == "ply" and has_strips(data):
        return load(triangulated(data))
    try:
        return load(data)
    except Exception as error:
        if kind != "ply":
            raise
        try:
            cut = triangulated(data)
        except (ValueError, LookupError):
            raise error from None
        return load(cut)


def _coordinates(visual: Any, faces: Ints) -> Floats | None:
    """(F, 3, 2) texture coordinates, v down: trimesh counts it upward."""
    uv = getattr(visual, "uv", None)
    if uv is None or np.ndim(uv) != 2 or np.shape(uv)[1] < 2 or len(uv) <= faces.max():
        return None
    values = np.asarray(uv, dtype=np.float64)[:, :2] * (1.0, -1.0) + (0.0, 1.0)
    return np.asarray(values[faces])


def _paint(visual: Any, faces: Ints) -> Floats | None:
    """(F, 3, 4) linear colours of vertices or faces."""
    if visual.kind == "vertex" and len(visual.vertex_colors) > faces.max():
        rgba = np.asarray(visual.vertex_colors, dtype=np.float64)[faces] / 255.0
    elif visual.kind == "face" and len(visual.face_colors) == len(faces):
        rgba = np.repeat(np.asarray(visual.face_colors, dtype=np.float64)[:, None] / 255.0, 3, axis=1)
    else:
        return None
    return np.concatenate([from_srgb(rgba[..., :3]), rgba[..., 3:4]], axis=-1)


def _material(visual: Any, model: Source, files: _Beside, pictures: dict[str, Picture | None]) -> Material:
    """Material from trimesh's simple or PBR one. Without a picture grey, the default of exporters, counts as white.

    pictures : by name, to which what is new is added
    """
    known = getattr(visual, "material", None)
    if known is None:
        return Material()
    image = getattr(known, "image", None) or getattr(known, "baseColorTexture", None)
    factor = getattr(known, "diffuse", None)
    rgb = np.ones(3) if factor is None else from_srgb(np.asarray(factor, dtype=np.float64)[:3] / 255.0)
    if image is not None or np.ptp(rgb) < 0.01:
        rgb = np.ones(3)
    kept = None
    if image is not None:
        file = str(image.info.get("file_path", "")) or "".join(files.pictures[-1:])
        if file not in pictures:  # trimesh's own picture has no file: it stands for coordinates without a material
            pictures[file] = _picture(model.find(file)) if file else as_png(np.asarray(image.convert("RGBA")))
        kept = pictures[file]
    name = str(getattr(known, "name", "") or "")
    return Material(name=name, factor=(float(rgb[0]), float(rgb[1]), float(rgb[2]), 1.0), picture=kept)


def _picture(content: bytes) -> Picture | None:
    """A picture byte for byte where glTF has its format, else as PNG; None where it is broken or too large."""
    try:
        return Picture(content, media_type(content))
    except ValueError:
        pixels = decode(Picture(content, ""))
        return None if pixels is None else as_png(pixels)
