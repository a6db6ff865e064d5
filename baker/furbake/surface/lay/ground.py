"""The sheet on which patches grow, with the field, the ways across it, and radii of patches."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array

from furbake.surface.charts import Floats, Ints
from furbake.surface.lay.sheet import Complex, Sheet, cut, frames, rotated, shortest, transport, ways
from furbake.surface.mesh import Surface
from furbake.surface.repair.topology import face_vectors, smoother, unit

TURN = 0.32
"""How far the field may turn from the middle of a patch to its rim, radians: smaller patches where it turns more."""

BEND = 0.9
"""Radius of a patch times the square root of the Gaussian curvature: smaller patches where the surface is no plane."""

SMALLEST, TIGHTEST = 0.22, 0.1
"""Radius of the smallest patches that are asked for, share of the largest: for the field's sake, for the surface's."""


@dataclass(frozen=True)
class Ground:
    """A sheet and what is known of each of its vertices and faces before the first patch; lengths as in `Sheet`.

    ways : (S, S) lengths of the steps of a walk
    e1, e2 : (S, 3) float, unit tangents, right-handed; e2 is the field
    heading : (F,) complex, the field in the plane of each `flattened` face, length up to 1
    area : (F,) float; fan : (S,) int, faces around each vertex
    radius : (S,) float, of a patch in the middle of which the vertex is
    border : (b,) int, vertices at which the sheet ends
    """

    sheet: Sheet
    ways: csr_array
    e1: Floats
    e2: Floats
    heading: Complex
    area: Floats
    fan: Ints
    radius: Floats
    border: Ints


def prepare(surface: Surface, direction: Floats, radius: float) -> Ground:
    """The ground of a surface.

    direction : (V, 3) float, the field, tangent or nearly so
    radius : of the largest patches, share of the largest side
    """
    sheet = cut(surface)
    normals, faces = sheet.normals, sheet.faces
    along = direction[sheet.source] - normals * np.einsum("ij,ij->i", direction[sheet.source], normals)[:, None]
    lost = ~(np.linalg.norm(along, axis=1) > 1e-6)
    e2 = np.where(lost[:, None], frames(normals)[1], unit(along))
    e1 = np.cross(e2, normals)

    across = face_vectors(sheet.vertices, faces)
    flat = unit(across)
    x = unit(sheet.vertices[faces[:, 1]] - sheet.vertices[faces[:, 0]])
    mean = sum((rotated(e2[corner], normals[corner], flat) for corner in faces.T), np.zeros_like(flat)) / 3.0
    heading = np.einsum("ij,ij->i", mean, x) + 1j * np.einsum("ij,ij->i", mean, np.cross(flat, x))

    i, j, length = ways(sheet)
    return Ground(
        sheet=sheet,
        ways=shortest(len(normals), i, j, length),
        e1=e1,
        e2=e2,
        heading=heading,
        area=0.5 * np.linalg.norm(across, axis=1),
        fan=np.bincount(faces.reshape(-1), minlength=len(normals)),
        radius=_radius(sheet, np.abs(np.angle(transport(normals, e1, e2, i, j))), i, length, radius),
        border=_border(sheet),
    )


def _radius(sheet: Sheet, turn: Floats, i: Ints, length: Floats, most: float) -> Floats:
    """(S,) radius of patches: `most`, less where the field turns or the surface bends, both averaged over a patch.

    turn : (n,) radians that the field turns over each step from i
    """
    count, faces = len(sheet.vertices), sheet.faces
    rate = np.bincount(i, turn * length, count) / np.maximum(np.bincount(i, length * length, count), 1e-300)
    area = 0.5 * np.linalg.norm(face_vectors(sheet.vertices, faces), axis=1)
    mass = np.bincount(faces.reshape(-1), np.repeat(area / 3.0, 3), count)

    angle = np.zeros(count)
    for k in range(3):
        here, one, two = (sheet.vertices[faces[:, (k + n) % 3]] for n in range(3))
        a, b = one - here, two - here
        opening = np.arctan2(np.linalg.norm(np.cross(a, b), axis=1), np.einsum("ij,ij->i", a, b))
        angle += np.bincount(faces[:, k], opening, count)
    defect = 2.0 * np.pi - angle
    defect[_border(sheet)] = 0.0

    turned, bent = rate * mass, defect
    average = smoother(count, faces)
    for _ in range(int(np.clip((0.6 * most / np.median(length)) ** 2, 1, 60))):
        turned, bent, mass = average @ turned, average @ bent, average @ mass
    mass = np.maximum(mass, 1e-300)
    by_turn = TURN / np.maximum(turned / mass, 1e-9)
    by_bend = BEND / np.sqrt(np.maximum(np.abs(bent) / mass, 1e-12))
    radius = np.clip(np.minimum(np.maximum(by_turn, SMALLEST * most), by_bend), TIGHTEST * most, most)
    # A face that stands alone is one patch however long its sides are, not three.
    edge = np.full(count, np.inf)
    np.minimum.at(edge, i, length)
    border = _border(sheet)
    radius[border] = np.maximum(radius[border], 1.01 * edge[border])
    return np.asarray(radius)


def _border(sheet: Sheet) -> Ints:
    """Vertices of the edges that have one face only."""
    lone = np.bincount(sheet.edges.reshape(-1))[sheet.edges] == 1
    return np.unique(np.r_[sheet.faces[lone], np.roll(sheet.faces, -1, axis=1)[lone]])
