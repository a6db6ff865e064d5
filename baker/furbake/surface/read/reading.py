"""A model file as one soup: glTF by our own reader, everything else by trimesh, archives file by file."""

from __future__ import annotations

import logging
import posixpath
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from furbake.surface.files import Source, source
from furbake.surface.material import Material
from furbake.surface.read.archive import sources
from furbake.surface.read.gltf_data import UndecodableError
from furbake.surface.read.gltf_scene import Scene, read_gltf
from furbake.surface.read.usd import read_usd
from furbake.surface.rig.rig import Rig
from furbake.surface.soup import MeshError, Soup, join

MESHES = ("glb", "gltf", "obj", "off", "ply", "stl", "stl_ascii")
"""Ends of the names of files that are read."""

ARCHIVES = ("zip", "tar.gz", "tar.bz2", "bz2")
"""Ends of the names of archives in which such files are found."""

STAGES = ("usd", "usda", "usdc", "usdz")
"""Ends of the names of stages of USD, of which an optional extra reads the meshes."""

STATUE = "joints, clips and morph targets of {} models in an archive left out: the fur stands still"


@dataclass(frozen=True)
class Reading:
    """Contents of a file: triangles, the materials that `soup.part` counts, number of missing pictures, notices.

    rig : all that moves the triangles, whose vertices are its own; None: nothing does
    """

    soup: Soup
    materials: tuple[Material, ...]
    missing: int = 0
    notices: tuple[str, ...] = ()
    rig: Rig | None = None


def read(path: Path) -> Reading:
    """Everything of a file that fur can use. Raises MeshError for every file that has no triangle."""
    name, kind = str(path), kind_of(path.name)
    try:
        if path.is_dir():
            raise MeshError(f"{name}: is a folder, expected a mesh file")
        if not path.exists():
            raise MeshError(f"{name}: no such file, expected a mesh file or sphere, plane, plane:RxC, torus, torus:RxC")
        if kind in STAGES:
            return _reading(name, read_usd(path))
        if kind == "blend":
            raise MeshError(f"{name}: is a scene of Blender, expected a mesh file such as .glb, or a bake in Blender")
        if kind not in (*MESHES, *ARCHIVES):
            raise MeshError(f"{name}: file type is '{kind}', expected one of {', '.join((*MESHES, *ARCHIVES))}")
        model = source(path)
        if not model.data:
            raise MeshError(f"{name}: 0 bytes, expected a mesh file")
    except (OSError, ValueError) as error:
        if isinstance(error, MeshError):
            raise
        raise MeshError(f"{name}: {reason(error)}, expected a readable mesh file") from error
    with _quiet():
        try:
            scene = _read_archive(model, kind) if kind in ARCHIVES else _read_one(model, kind)
        except MeshError:
            raise
        except UndecodableError as error:
            codec = str(error)
            raise MeshError(
                f"{name}: geometry that cannot be decoded ({codec}), expected intact Draco or plain data"
            ) from error
        except Exception as error:  # readers raise anything on a broken file: struct.error, KeyError, MemoryError, ...
            raise MeshError(f"{name}: cannot be read as {kind} ({reason(error)}), expected a valid file") from error
    return _reading(name, scene)


def _reading(name: str, scene: Scene) -> Reading:
    """A scene that has triangles. Raises MeshError for one that has none."""
    if scene.soup is None:
        raise MeshError(f"{name}: no faces, expected a surface of triangles")
    return Reading(scene.soup, scene.materials, scene.missing, scene.notices, scene.rig)


def kind_of(name: str) -> str:
    """End of a file's name, lower-case: the part behind its last dot, or two of them where it is a packed tar."""
    name = name.lower()
    return next((end for end in ARCHIVES if name.endswith(f".{end}")), name.rpartition(".")[2])


def _read_one(model: Source, kind: str) -> Scene:
    if kind in {"glb", "gltf"}:
        return read_gltf(model)
    from furbake.surface.read.others import read_other  # noqa: PLC0415 — trimesh takes 0.1 s

    return read_other(model, kind)


def _read_archive(archive: Source, kind: str) -> Scene:
    """All meshes of an archive, those left out that cannot be read, unless that is all of them."""
    models, names = sources(archive, kind, MESHES)
    if not models:
        some = ", ".join(_one_line(posixpath.basename(name), 40) for name in names[:5]) + (", ..." if names[5:] else "")
        raise MeshError(
            f"{archive.name}: holds no mesh ({some or 'no file'}), expected one of {', '.join(MESHES)} in it"
        )
    found: list[Soup] = []
    materials: dict[Material, int] = {}
    notices: list[str] = []
    rigs: list[Rig | None] = []
    missing, broken = 0, None
    for model in models:
        try:
            soup, own, lost, told, rig = _read_one(model, kind_of(model.name))
        except (MeshError, UndecodableError):
            raise
        except Exception as error:  # noqa: BLE001 — as above
            broken = error
            continue
        missing += lost
        notices += told
        if soup is not None:
            places = np.array([materials.setdefault(material, len(materials)) for material in own])
            found.append(replace(soup, part=places[soup.part]))
            rigs.append(rig)
    if not found and broken is not None:
        raise broken
    if len(found) > 1 and any(rig is not None for rig in rigs):
        notices.append(STATUE.format(len(found)))
    rig = rigs[0] if len(rigs) == 1 else None
    return Scene(join(found) if found else None, tuple(materials), missing, tuple(notices), rig)


@contextmanager
def _quiet() -> Iterator[list[str]]:
    """Collect warnings that trimesh logs, and keep them and Python's own off the terminal."""
    logged: list[str] = []

    class Collect(logging.Handler):
        def emit(self, record: logging.LogRecord) -> None:
            logged.append(record.getMessage())

    logger, handler = logging.getLogger("trimesh"), Collect(logging.WARNING)
    propagate = logger.propagate
    logger.addHandler(handler)
    logger.propagate = False
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            yield logged
    finally:
        logger.removeHandler(handler)
        logger.propagate = propagate


def _one_line(text: str, longest: int = 160) -> str:
    """Printable text without line breaks, shortened."""
    line = " ".join("".join(c if c.isprintable() else " " for c in text).split())
    return line if len(line) <= longest else line[: longest - 3] + "..."


def reason(error: BaseException) -> str:
    """Message of an exception, in one line."""
    if isinstance(error, OSError) and error.strerror:
        return error.strerror[:1].lower() + error.strerror[1:]
    return _one_line(f"{type(error).__name__}: {error}" if str(error) else type(error).__name__)
