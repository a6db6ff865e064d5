"""A mesh file as one soup: glTF by our own reader, everything else by trimesh, unprocessed."""

from __future__ import annotations

import io
import logging
import re
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import trimesh

from furbake.surface.colours import from_srgb
from furbake.surface.gltf_data import UndecodableError
from furbake.surface.gltf_scene import media_type, read_gltf
from furbake.surface.material import Material, Picture
from furbake.surface.polygons import recut
from furbake.surface.soup import Floats, Ints, MeshError, Soup, join


@dataclass(frozen=True)
class Reading:
    """What a file holds: triangles, the materials that `soup.part` counts, and how many pictures are not to be had."""

    soup: Soup
    materials: tuple[Material, ...]
    missing: int = 0


def read(path: Path) -> Reading:
    """Everything of a file that fur can use. Raises MeshError for every file that has no triangle."""
    name = str(path)
    try:
        if path.is_dir():
            raise MeshError(f"{name}: is a folder, expected a mesh file")
        if not path.exists():
            raise MeshError(f"{name}: no such file, expected a mesh file or sphere, plane, plane:RxC, torus, torus:RxC")
        if path.stat().st_size == 0:
            raise MeshError(f"{name}: 0 bytes, expected a mesh file")
        with path.open("rb"):
            pass
    except (OSError, ValueError) as error:
        if isinstance(error, MeshError):
            raise
        raise MeshError(f"{name}: {reason(error)}, expected a readable mesh file") from error
    known = sorted(trimesh.exchange.load.mesh_formats() | set(trimesh.exchange.load.compressed_loaders))
    kind = trimesh.util.split_extension(path.name).lower()
    if kind not in known:
        raise MeshError(f"{name}: file type is '{kind}', expected one of {', '.join(known)}")
    with _quiet() as told:
        try:
            soup, materials, missing = read_gltf(path) if kind in ("glb", "gltf") else _read_other(path)
        except UndecodableError as error:
            raise _undecodable(name, str(error)) from error
        except Exception as error:  # readers raise anything on a broken file: struct.error, KeyError, MemoryError, ...
            raise MeshError(f"{name}: cannot be read as {kind} ({reason(error)}), expected a valid file") from error
    for line in told:
        # Compressed geometry that trimesh cannot decode (a glTF in a zip) is left as zeros, with only a log line.
        if "placeholder zeros" in line:
            raise _undecodable(name, " ".join(re.findall(r"[A-Z]+_[a-z]+_[a-z_]+", line)) or "its compression")
    if soup is None:
        raise MeshError(f"{name}: no faces, expected a surface of triangles")
    return Reading(soup, materials, missing)


def _undecodable(name: str, codec: str) -> MeshError:
    return MeshError(f"{name}: geometry that cannot be decoded ({codec}), expected intact Draco or plain data")


def _read_other(path: Path) -> tuple[Soup | None, tuple[Material, ...], int]:
    """Soup, materials and no missing picture; no soup where there is no triangle."""
    scene = trimesh.load_scene(str(path), process=False)
    parts = [part for part in scene.dump() if isinstance(part, trimesh.Trimesh) and len(part.faces)]
    materials: list[Material] = []
    soups: list[Soup] = []
    for part in parts:
        visual: Any = part.visual
        material = _material(path, visual)
        if material not in materials:
            materials.append(material)
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
                part=np.full(len(faces), materials.index(material)),
                uv=_coordinates(visual, faces) if inside else None,
                paint=_paint(visual, faces) if inside else None,
                attributes={name: values[faces] for name, values in numbers.items()} if inside else {},
            )
        )
    return (join(soups) if soups else None), tuple(materials), 0


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


def _material(path: Path, visual: Any) -> Material:
    """Of trimesh's simple or PBR material. Without a picture grey is what exporters write by default: white."""
    known = getattr(visual, "material", None)
    if known is None:
        return Material()
    picture = getattr(known, "image", None) or getattr(known, "baseColorTexture", None)
    factor = getattr(known, "diffuse", None)
    rgb = np.ones(3) if factor is None else from_srgb(np.asarray(factor, dtype=np.float64)[:3] / 255.0)
    if picture is not None or np.ptp(rgb) < 0.01:
        rgb = np.ones(3)
    kept = None if picture is None else _picture(path, picture)
    name = str(getattr(known, "name", "") or "")
    return Material(name=name, factor=(float(rgb[0]), float(rgb[1]), float(rgb[2]), 1.0), picture=kept)


def _picture(path: Path, image: Any) -> Picture:
    """The file that an image came from, byte for byte where it lies beside the model, else as PNG."""
    beside = path.parent / str(image.info.get("file_path", "")).replace("\\", "/")
    try:
        content = beside.read_bytes()
        return Picture(content, media_type(content))
    except (OSError, ValueError):
        stream = io.BytesIO()
        image.convert("RGBA").save(stream, "PNG")
        return Picture(stream.getvalue(), "image/png")


@contextmanager
def _quiet() -> Iterator[list[str]]:
    """Collects what trimesh logs as a warning, and keeps it and Python's own warnings off the terminal."""
    told: list[str] = []

    class Collect(logging.Handler):
        def emit(self, record: logging.LogRecord) -> None:
            told.append(record.getMessage())

    logger, handler = logging.getLogger("trimesh"), Collect(logging.WARNING)
    propagate = logger.propagate
    logger.addHandler(handler)
    logger.propagate = False
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            yield told
    finally:
        logger.removeHandler(handler)
        logger.propagate = propagate


def _one_line(text: str, longest: int = 160) -> str:
    """Printable text without line breaks, shortened."""
    line = " ".join("".join(c if c.isprintable() else " " for c in text).split())
    return line if len(line) <= longest else line[: longest - 3] + "..."


def reason(error: BaseException) -> str:
    """What an exception says, in one line."""
    if isinstance(error, OSError) and error.strerror:
        return error.strerror[:1].lower() + error.strerror[1:]
    return _one_line(f"{type(error).__name__}: {error}" if str(error) else type(error).__name__)
