"""Read a mesh, clean it, orient it: whatever comes in, a `Surface` or a `MeshError` of one sentence goes out.

The surface is welded by position: seams of texture or normal would otherwise split patches and grow fins.
"""

from __future__ import annotations

import logging
import re
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import trimesh
from numpy.typing import NDArray

from furbake.surface.topology import angle_normals, duplicates, face_vectors, orient, weld

if TYPE_CHECKING:
    from furbake.surface.charts import Natural

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
RGB = tuple[float, float, float]

SMALLEST, LARGEST = 1e-9, 1e9
"""Largest side of a mesh that 32-bit floats can still carry with its fur, model units."""

WELD = 1e-6
"""Vertices nearer than this share of the largest side become one."""

SLIVER = 1e-12
"""Faces whose area is below this share of the largest side squared are dropped."""


class MeshError(ValueError):
    """A mesh that cannot carry fur; the message starts with its name and says what was got and expected."""


@dataclass(frozen=True)
class Surface:
    """A welded, consistently wound triangle mesh, right-handed, y up, in the model's own units.

    vertices : (V, 3) float, each used by a face
    faces : (F, 3) int, counter-clockwise seen from outside
    normals : (V, 3) float, unit, outward
    natural : texture coordinates that a built-in shape has by itself
    colour : linear base colour of the model's own material, white where it has none
    """

    vertices: Floats
    faces: Ints
    normals: Floats
    natural: Natural | None = None
    colour: RGB = (1.0, 1.0, 1.0)

    @property
    def extent(self) -> float:
        """Largest side of the bounding box, model units."""
        return float(np.ptp(self.vertices, axis=0).max())


def load_mesh(path: Path) -> Surface:
    """Surface of a file that trimesh reads; the parts of a scene are joined where their transforms put them.

    Raises MeshError for every file that does not give one.
    """
    name = str(path)
    try:
        if path.is_dir():
            raise MeshError(f"{name}: is a folder, expected a mesh file")
        if not path.exists():
            raise MeshError(f"{name}: no such file, expected a mesh file or sphere, plane, torus, torus:RxC")
        if path.stat().st_size == 0:
            raise MeshError(f"{name}: 0 bytes, expected a mesh file")
        with path.open("rb"):
            pass
    except (OSError, ValueError) as error:
        if isinstance(error, MeshError):
            raise
        raise MeshError(f"{name}: {_reason(error)}, expected a readable mesh file") from error
    vertices, faces, colour = _read(path)
    return clean(name, vertices, faces, colour)


def clean(name: str, vertices: Floats, faces: Ints, colour: RGB = (1.0, 1.0, 1.0)) -> Surface:
    """Surface of triangles: welded, without degenerate, repeated and unused parts, wound outward.

    vertices : (V, 3) float, model units; faces : (F, 3) int. Raises MeshError, starting with `name`.
    """
    if len(faces) == 0:
        raise MeshError(f"{name}: no faces, expected a surface of triangles")
    if faces.min() < 0 or faces.max() >= len(vertices):
        got = faces.min() if faces.min() < 0 else faces.max()
        raise MeshError(f"{name}: a face uses vertex {got}, expected 0 to {len(vertices) - 1}")
    used = np.unique(faces)
    bad = int((~np.isfinite(vertices[used]).all(axis=1)).sum())
    if bad:
        raise MeshError(f"{name}: {bad} of {len(used)} vertices are not finite, expected numbers (no NaN, no infinity)")
    with np.errstate(over="ignore"):
        extent = float(np.ptp(vertices[used], axis=0).max())
    if extent == 0.0:
        raise MeshError(f"{name}: all faces have zero area, expected a surface")
    if not SMALLEST <= extent <= LARGEST:
        raise MeshError(f"{name}: largest side is {extent:.3g} units, expected {SMALLEST:g} to {LARGEST:g}")

    vertices, faces = weld(vertices, faces, WELD * extent)
    area = 0.5 * np.linalg.norm(face_vectors(vertices / extent, faces), axis=1)
    faces = faces[(area > SLIVER) & ~duplicates(faces)]
    if len(faces) == 0:
        raise MeshError(f"{name}: all faces have zero area, expected a surface")
    used, index = np.unique(faces, return_inverse=True)
    vertices, faces = vertices[used], orient(vertices[used] / extent, index.reshape(-1, 3))
    return Surface(vertices, faces, angle_normals(vertices, faces), colour=colour)


def _read(path: Path) -> tuple[Floats, Ints, RGB]:
    """Triangles of a file as trimesh reads it, unprocessed. Raises MeshError."""
    name = str(path)
    known = sorted(trimesh.exchange.load.mesh_formats() | set(trimesh.exchange.load.compressed_loaders))
    kind = trimesh.util.split_extension(path.name).lower()
    if kind not in known:
        raise MeshError(f"{name}: file type is '{kind}', expected one of {', '.join(known)}")
    with _trimesh_warnings() as told:
        try:
            scene = trimesh.load_scene(str(path), process=False)
            parts = [part for part in scene.dump() if isinstance(part, trimesh.Trimesh) and len(part.faces)]
            places = [np.asarray(part.vertices, dtype=np.float64).reshape(-1, 3) for part in parts]
            corners = [np.asarray(part.faces, dtype=np.int64).reshape(-1, 3) for part in parts]
            colour = _base_colour(parts)
        except Exception as error:  # readers raise anything on a broken file: struct.error, KeyError, MemoryError, ...
            raise MeshError(f"{name}: cannot be read as {kind} ({_reason(error)}), expected a valid file") from error
    for line in told:
        # Compressed geometry that trimesh cannot decode is left as zeros, with nothing but a log line.
        if "placeholder zeros" in line:
            codec = " ".join(re.findall(r"[A-Z]+_[a-z]+_[a-z_]+", line)) or "its compression"
            raise MeshError(f"{name}: geometry that cannot be decoded ({codec}), expected intact Draco or plain data")
    if not parts:
        raise MeshError(f"{name}: no faces, expected a surface of triangles")
    starts = np.cumsum([0] + [len(place) for place in places])
    faces = [corner + start for corner, start in zip(corners, starts, strict=False)]
    return np.concatenate(places), np.concatenate(faces), colour


def _base_colour(parts: list[trimesh.Trimesh]) -> RGB:
    """Linear base colour that all parts share. Grey is what exporters write by default and counts as white."""
    factors: set[RGB] = set()
    for part in parts:
        factor = getattr(getattr(part.visual, "material", None), "baseColorFactor", None)
        rgb = np.ones(3) if factor is None else np.asarray(factor, dtype=np.float64)[:3]
        if factor is not None and np.asarray(factor).dtype.kind in "ui":
            rgb = rgb / 255.0
        factors.add((float(rgb[0]), float(rgb[1]), float(rgb[2])))
    if len(factors) != 1:
        return (1.0, 1.0, 1.0)
    colour = factors.pop()
    hueless = max(colour) - min(colour) < 1.5 / 255.0
    return (1.0, 1.0, 1.0) if hueless else colour


@contextmanager
def _trimesh_warnings() -> Iterator[list[str]]:
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


def _reason(error: BaseException) -> str:
    """What an exception says, in one line."""
    if isinstance(error, OSError) and error.strerror:
        return error.strerror[:1].lower() + error.strerror[1:]
    return _one_line(f"{type(error).__name__}: {error}" if str(error) else type(error).__name__)
