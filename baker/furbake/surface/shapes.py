"""Built-in surfaces, right-handed, y up: `sphere`, `plane`, `plane:RxC`, `torus` and `torus:RxC`."""

from __future__ import annotations

import re

import numpy as np

from furbake.surface.charts import Floats, Ints, Natural
from furbake.surface.mesh import MeshError, Surface
from furbake.surface.repair.topology import unit

NAMES = ("sphere", "plane", "torus")
MIN_CELLS, MAX_CELLS = {"plane": 1, "torus": 3}, 1024
"""Least and most rows and columns."""

SUBDIVISIONS = 4
"""Subdivisions of the sphere's icosahedron: 20·4⁴ = 5 120 triangles."""

CELLS = 16
"""Squares along each side of the default plane: 512 triangles."""

RING, TUBE = 0.7, 0.3
"""Radii of the torus, model units; its largest side is 2."""

ROWS, COLUMNS = 48, 96
"""Rows and columns of the default torus: 9 216 triangles."""


def is_builtin(name: str) -> bool:
    """True if `name` means a built-in shape (well formed or not), not a file."""
    return name in NAMES or name.startswith(("plane:", "torus:"))


def builtin(name: str) -> Surface:
    """Surface of a built-in shape. Raises MeshError where the name is none."""
    if name == "sphere":
        return sphere()
    if name == "plane":
        return plane(CELLS, CELLS)
    if name == "torus":
        return torus(ROWS, COLUMNS)
    size = re.fullmatch(r"(plane|torus):(\d{1,9})x(\d{1,9})", name, re.ASCII)
    if not size:
        raise MeshError(f"{name}: no such built-in, expected sphere, plane, torus, plane:RxC or torus:RxC")
    shape, rows, columns = size[1], int(size[2]), int(size[3])
    fewest = MIN_CELLS[shape]
    if not (fewest <= rows <= MAX_CELLS and fewest <= columns <= MAX_CELLS):
        raise MeshError(f"{name}: {rows} rows and {columns} columns, expected {fewest} to {MAX_CELLS} of each")
    return (plane if shape == "plane" else torus)(rows, columns)


def sphere() -> Surface:
    """Ball of radius 1. A subdivided icosahedron: no poles, and no texture coordinates of its own."""
    import trimesh  # noqa: PLC0415 — 0.1 s, for this alone

    ball = trimesh.creation.icosphere(subdivisions=SUBDIVISIONS)
    vertices = np.asarray(ball.vertices, dtype=np.float64)
    return Surface(vertices, np.asarray(ball.faces, dtype=np.int64), unit(vertices))


def plane(rows: int, columns: int) -> Surface:
    """Square of side 1 in x and z that faces +y. u grows along +x, v along -z: from the nose to the tail."""
    u, v = _lattice(rows, columns)
    vertices = np.stack([u - 0.5, np.zeros_like(u), 0.5 - v], axis=1)
    count = len(vertices)
    faces = _cells(rows, columns)
    tangents = np.tile([1.0, 0.0, 0.0, 1.0], (count, 1))
    natural = Natural(np.arange(count), faces, tangents, np.stack([u, v], axis=1), (1.0, 1.0), (False, False))
    return Surface(vertices, faces, np.tile([0.0, 1.0, 0.0], (count, 1)), natural)


def torus(rows: int, columns: int) -> Surface:
    """Lying ring of 2 · rows · columns triangles: rows around the tube (u), columns around the ring (v)."""
    u, v = _lattice(rows, columns)
    tube, ring = 2.0 * np.pi * u, 2.0 * np.pi * v
    zero = np.zeros_like(u)
    out = np.stack([np.cos(ring), zero, np.sin(ring)], axis=1)
    normals = np.cos(tube)[:, None] * out + np.stack([zero, np.sin(tube), zero], axis=1)
    along = -np.sin(tube)[:, None] * out + np.stack([zero, np.cos(tube), zero], axis=1)

    # The lattice repeats its first row and column at the end: those are copies of the same source vertex.
    row, column = np.divmod(np.arange((rows + 1) * (columns + 1)), columns + 1)
    source = (row % rows) * columns + column % columns
    keep = (row < rows) & (column < columns)
    vertices = (RING * out + TUBE * normals)[keep]
    lattice = _cells(rows, columns)
    natural = Natural(
        source=source,
        faces=lattice,
        tangents=np.column_stack([along, np.ones(len(u))]),
        uv=np.stack([u, v], axis=1),
        lengths=(2.0 * np.pi * TUBE, 2.0 * np.pi * RING),
        closed=(True, True),
    )
    return Surface(vertices, source[lattice], normals[keep], natural)


def _lattice(rows: int, columns: int) -> tuple[Floats, Floats]:
    """u and v, 0..1, of (rows + 1)·(columns + 1) points, v fastest."""
    u, v = np.meshgrid(np.arange(rows + 1) / rows, np.arange(columns + 1) / columns, indexing="ij")
    return u.reshape(-1), v.reshape(-1)


def _cells(rows: int, columns: int) -> Ints:
    """(2 · rows · columns, 3) triangles of the lattice, counter-clockwise in (u, v)."""
    i, j = np.meshgrid(np.arange(rows), np.arange(columns), indexing="ij")
    a = (i * (columns + 1) + j).reshape(-1)
    b, c, d = a + columns + 1, a + columns + 2, a + 1
    return np.stack([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)], axis=1).reshape(-1, 3)
