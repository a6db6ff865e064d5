"""Shares of several furs at every vertex of a surface: soft at their borders, 1 in sum."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array, diags_array
from scipy.sparse.linalg import splu

from furbake.surface.mesh import Floats, MeshError, Surface

Bytes = NDArray[np.uint8]

STEPS = 255
"""Steps in which shares are stored."""

EDGE = 2.43
"""Width from a tenth to nine tenths of a step that heat has softened, over the square root of the time."""

TAIL = 0.06
"""Softened shares below it count as none: heat is everywhere."""


def in_balls(surface: Surface, balls: Sequence[tuple[float, float, float, float]], border: float) -> Floats:
    """(V,) 0..1: 1 inside of the nearest ball (x, y, z, radius), 0 outside, linear over a border around its surface."""
    inside = [radius - np.linalg.norm(surface.vertices - place, axis=1) for *place, radius in balls]
    return np.asarray(np.clip(np.max(inside, axis=0) / border + 0.5, 0.0, 1.0))


def on_material(surface: Surface, covered: Surface, name: str, label: str) -> Floats:
    """(V,) 1 where the material of this name covers the skin nearest to a vertex, else 0.

    covered : the surface with its skin; label : of the region. Raises MeshError where no material has this name.
    """
    from scipy.spatial import cKDTree  # noqa: PLC0415 — 0.1 s, for this alone

    names = sorted({piece.material.name for piece in covered.skin})
    mine = [piece.source for piece in covered.skin if piece.material.name == name]
    if not mine:
        have = ", ".join(names) or "a model with materials"
        raise MeshError(f"regions: {label}.material: got {name!r}, expected {have}")
    flags = np.zeros(len(covered.vertices))
    flags[np.concatenate(mine)] = 1.0
    nearest = cKDTree(covered.vertices).query(surface.vertices)[1]
    return np.asarray(flags[nearest])


def soften(surface: Surface, shares: Floats, border: float) -> Floats:
    """(V,) 0..1 shares whose steps are `border` wide, model units; by heat that flows along the surface."""
    triangles = surface.vertices[surface.faces]
    count, faces = len(surface.vertices), surface.faces
    area, mass = face_areas(surface), vertex_areas(surface)
    rows, columns, values = [], [], []
    for corner in range(3):
        one, two = (corner + 1) % 3, (corner + 2) % 3
        to_one, to_two = triangles[:, one] - triangles[:, corner], triangles[:, two] - triangles[:, corner]
        cotangent = np.einsum("ij,ij->i", to_one, to_two) / np.maximum(2.0 * area, 1e-300)
        rows.append(faces[:, one])
        columns.append(faces[:, two])
        values.append(0.5 * np.clip(cotangent, 0.05, 20.0))  # above 0: shares stay within 0..1
    half = csr_array((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), shape=(count, count))
    links = half + half.T
    laplacian = diags_array(links.sum(axis=1)) - links
    mass = np.maximum(mass, 1e-6 * mass.mean())
    system = (diags_array(mass) + (border / EDGE) ** 2 * laplacian).tocsc()
    spread = splu(system).solve(mass * shares)
    return np.asarray(np.clip((spread - TAIL) / (1.0 - 2.0 * TAIL), 0.0, 1.0))


def face_areas(surface: Surface) -> Floats:
    """(F,) area of each face."""
    corners = surface.vertices[surface.faces]
    return np.asarray(
        0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    )


def vertex_areas(surface: Surface) -> Floats:
    """(V,) a third of the faces around each vertex."""
    shares = np.repeat(face_areas(surface) / 3, 3)
    return np.asarray(np.bincount(surface.faces.reshape(-1), shares, len(surface.vertices)), dtype=np.float64)


def bounds(masks: Sequence[Floats] | Floats) -> Bytes:
    """(R + 2, V) rising bounds, 0 to 255: hairs whose number lies between bounds r and r + 1 belong to fur r.

    masks : (V,) 0..1 of each region; fur 0, the coat, has what they leave. Where they sum to more than 1 they share.
    """
    shares = np.array(masks)
    shares = shares / np.maximum(shares.sum(axis=0), 1.0)
    rising = np.concatenate([1.0 - shares.sum(axis=0, keepdims=True), shares]).cumsum(axis=0)
    codes = np.rint(STEPS * np.clip(rising, 0.0, 1.0)).astype(np.uint8)
    codes[-1] = STEPS
    return np.concatenate([np.zeros_like(codes[:1]), codes])
