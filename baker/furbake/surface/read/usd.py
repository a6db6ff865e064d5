"""Meshes of USD as one soup, in metres and y up where the stage says its units."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from furbake.surface.files import check_regular
from furbake.surface.limits import Budget
from furbake.surface.material import Material
from furbake.surface.read.gltf_scene import Scene
from furbake.surface.read.polygons import recut
from furbake.surface.soup import Floats, Ints, MeshError, Soup, join
from furbake.usd.stage import UsdError, UsdMesh, read_stage


def read_usd(path: Path) -> Scene:
    """All meshes of a stage. Raises MeshError where it cannot be read."""
    check_regular(path, Budget(str(path), "bytes"))
    try:
        stage = read_stage(path)
    except UsdError as error:
        raise MeshError(str(error)) from None
    soups, materials = list[Soup](), dict[Material, int]()
    for mesh in stage.meshes:
        if (found := _soup(str(path), mesh, stage.placed(mesh.points))) is not None:
            index = materials.setdefault(_material(mesh), len(materials))
            soups.append(Soup(found[0], found[1], np.full(len(found[1]), index), uv=found[2]))
    hidden = stage.hidden_meshes
    notices = [f"{layer} is missing, and what it has with it" for layer in stage.missing]
    if hidden:
        notices.append(f"{hidden} meshes are guides, proxies or invisible and left out")
    return Scene(join(soups) if soups else None, tuple(materials), 0, tuple(notices))


def _material(mesh: UsdMesh) -> Material:
    factor = (1.0, 1.0, 1.0) if mesh.colour is None else mesh.colour
    red, green, blue = (float(np.clip(part, 0.0, 1.0)) for part in factor)
    return Material(mesh.path.rpartition("/")[2], (red, green, blue, 1.0))


def _soup(name: str, mesh: UsdMesh, vertices: Floats) -> tuple[Floats, Ints, Floats | None] | None:
    """Vertices, triangles and their texture coordinates, v down; None where there is no polygon."""
    counts, corners = mesh.counts, mesh.corners
    if (counts < 0).any() or int(counts.sum()) != len(corners):
        raise MeshError(f"{name}: {mesh.path} has {len(corners)} corners, expected {int(counts.sum())} as it counts")
    if len(corners) and not 0 <= corners.min() <= corners.max() < len(vertices):
        raise MeshError(f"{name}: {mesh.path} names vertex {corners.max()} of {len(vertices)}, expected its own")
    fan = np.maximum(counts - 2, 0)
    if not fan.sum():
        return None
    first = np.repeat(np.cumsum(counts) - counts, fan)
    step = np.arange(int(fan.sum())) - np.repeat(np.cumsum(fan) - fan, fan)
    rows = np.stack([first, first + step + 1, first + step + 2], axis=1)
    rows = rows[:, ::-1] if mesh.reversed_ else rows
    faces = corners[rows]
    if mesh.uv is not None:
        return vertices, faces, np.asarray(mesh.uv[rows] * (1.0, -1.0) + (0.0, 1.0), np.float64)
    return vertices, faces if mesh.reversed_ else recut(vertices, faces), None
