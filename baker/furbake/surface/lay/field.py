"""Direction of the fur: a smooth field of unit tangents, from a guide, from strokes and from a model's attributes.

One sparse solve of the connection Laplacian (Knöppel, Crane, Pinkall and Schröder, Globally optimal direction fields,
2013) with all wishes as soft constraints: a field over the whole surface that turns as little as they allow.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_array, csr_array
from scipy.spatial import cKDTree

from furbake.surface.charts import Floats, Ints
from furbake.surface.lay.guide import SINK, Guide, nose
from furbake.surface.lay.sheet import Complex, cotangents, flattened, frames, transport
from furbake.surface.mesh import Surface
from furbake.surface.repair.topology import face_vectors, unit

SMOOTHING = 0.25
"""Distance over which the guide is smoothed, share of the largest side."""

ASIDE = 0.15
"""How far `down` turns to the tail where the surface is level (a back, a belly)."""

CLEAR = 0.25
"""Length of the solution, where wishes have length 1, from which on a direction is as strong as can be."""

FIRM = 300.0
"""Weight of a stroke or an attribute of strength 1 against that of the guide."""

BRUSH = 0.05
"""Distance from a stroke at which it no longer counts, share of the largest side."""

WIDEST = 4.0 * BRUSH
"""The same on a coarse mesh, where a stroke reaches the next vertices, at the most."""

SAMPLES = 4096
"""Most points of one stroke."""


PRECISION, ITERATIONS = 1e-6, 3000
"""Residual of the solve, share of the right side, and its most rounds."""


@dataclass(frozen=True)
class Stroke:
    """A line on the surface, or near it, along which the fur is combed.

    points : (n, 3) float, model units, from its beginning to its end
    strength : 0..1, how firmly
    """

    points: Floats
    strength: float = 1.0


@dataclass(frozen=True)
class Field:
    """Direction of the fur at every vertex of a surface.

    direction : (V, 3) float, unit, tangent: where the tips are laid
    strength : (V,) float 0..1, how much of a direction there is: small where the field turns about a point
    """

    direction: Floats
    strength: Floats


def comb_field(
    surface: Surface,
    guide: Guide = "nose-tail",
    strokes: Sequence[Stroke] = (),
    attribute: Floats | None = None,
    firmness: float = FIRM,
) -> Field:
    """The smoothest field that follows the guide, the strokes and the attribute, the latter two before the guide.

    attribute : (V, 3) float, direction at each vertex of the surface, model axes; its length (up to 1) is its strength
    firmness : weight of an attribute of strength 1 against that of the guide
    """
    vertices = (surface.vertices - surface.vertices.min(axis=0)) / surface.extent
    normals = surface.normals
    e1, e2 = frames(normals)
    area = np.linalg.norm(face_vectors(vertices, surface.faces), axis=1) / 6.0
    mass = np.bincount(surface.faces.reshape(-1), np.repeat(area, 3), len(vertices))
    mass = np.maximum(mass, 1e-6 * mass.mean()) / SMOOTHING**2

    wish, weight = _along(np.broadcast_to(guide_axis(surface, guide), normals.shape), e1, e2), np.ones(len(vertices))
    for stroke in strokes:
        direction, near = _brush(surface, vertices, stroke)
        wish, weight = wish + FIRM * near * _along(direction, e1, e2), weight + FIRM * near
    if attribute is not None:
        given = np.where(np.isfinite(attribute).all(axis=1, keepdims=True), attribute, 0.0)
        length = np.linalg.norm(given, axis=1)
        firm = firmness * np.minimum(length, 1.0)
        wish, weight = wish + firm * _heading(_along(unit(given), e1, e2)), weight + firm
    z = _solve(_stiffness(vertices, surface.faces, normals, e1, e2), mass * weight, mass * wish)
    size = np.abs(z)
    lost = ~(size > 1e-9)
    heading = np.where(lost, 1.0, z / np.where(lost, 1.0, size))
    return Field(_unit_tangent(heading, normals, e1, e2), np.where(lost, 0.0, np.minimum(size / CLEAR, 1.0)))


def guide_axis(surface: Surface, guide: Guide) -> Floats:
    """(3,) unit direction of a guide, model axes, before it is laid into the tangent planes."""
    tail, down = -nose(surface), np.array([0.0, -1.0, 0.0])
    laid = tail + SINK * down if guide == "nose-tail" else down + ASIDE * tail
    return np.asarray(laid / np.linalg.norm(laid))


def _along(vectors: Floats, e1: Floats, e2: Floats) -> Complex:
    """(n,) the tangent part of vectors, in the frames."""
    return np.asarray(np.einsum("ij,ij->i", vectors, e1) + 1j * np.einsum("ij,ij->i", vectors, e2))


def _heading(z: Complex) -> Complex:
    """Numbers brought to length 1 where they have a clear direction, shorter where they have not."""
    return np.asarray(z / np.maximum(np.abs(z), 0.2))


def _unit_tangent(heading: Complex, normals: Floats, e1: Floats, e2: Floats) -> Floats:
    """(n, 3) unit vectors in space, perpendicular to the normals to the last digit."""
    vectors = heading.real[:, None] * e1 + heading.imag[:, None] * e2
    return unit(vectors - normals * np.einsum("ij,ij->i", vectors, normals)[:, None])


def _stiffness(vertices: Floats, faces: Ints, normals: Floats, e1: Floats, e2: Floats) -> csr_array:
    """(V, V) Hermitian matrix of Σ w |z_j − r_ij z_i|² over the edges, r the transport from i to j."""
    count = len(vertices)
    weights = 0.5 * cotangents(flattened(vertices[faces])).reshape(-1)
    i, j = faces.reshape(-1), np.roll(faces, -1, axis=1).reshape(-1)
    # Across a knife's edge there is no one way to turn.
    weights = weights * np.clip(1.0 + np.einsum("ij,ij->i", normals[i], normals[j]), 0.0, 1.0) + 1e-9
    over = weights * transport(normals, e1, e2, i, j)
    data = np.r_[weights, weights, -over, -np.conj(over)].astype(complex)
    rows, columns = np.r_[i, j, j, i], np.r_[i, j, i, j]
    return coo_array((data, (rows, columns)), shape=(count, count)).tocsr()


def _solve(stiffness: csr_array, held: Floats, right: Complex) -> Complex:
    """(V,) z of (stiffness + held on the diagonal) · z = right, by conjugate gradients on the diagonal brought to 1.

    Written out, and with sums by einsum: the threads of a BLAS wait for each other on a busy machine, and make the
    library's solvers, direct or not, a hundred times slower there.
    """
    scale = 1.0 / np.sqrt(stiffness.diagonal().real + held)
    index = np.arange(len(held))
    outer = coo_array((scale.astype(complex), (index, index)), shape=stiffness.shape).tocsr()
    system = outer @ (stiffness + coo_array((held.astype(complex), (index, index)), shape=stiffness.shape)) @ outer
    z = right / held / scale
    rest = right * scale - system @ z
    way, size = rest, _square(rest)
    enough = PRECISION**2 * _square(right * scale)
    for _ in range(ITERATIONS):
        if size <= enough:
            break
        moved = system @ way
        step = size / float(np.einsum("i,i->", np.conj(way), moved).real)
        z, rest = z + step * way, rest - step * moved
        last, size = size, _square(rest)
        way = rest + (size / last) * way
    return np.asarray(z * scale)


def _square(z: Complex) -> float:
    return float(np.einsum("i,i->", z.real, z.real) + np.einsum("i,i->", z.imag, z.imag))


def _brush(surface: Surface, vertices: Floats, stroke: Stroke) -> tuple[Floats, Floats]:
    """(V, 3) direction of the stroke's nearest point, and (V,) its weight, 0 away from the stroke.

    vertices : (V, 3) float, shares of the largest side
    """
    nothing = np.zeros_like(vertices), np.zeros(len(vertices))
    line = np.asarray(stroke.points, dtype=np.float64).reshape(-1, 3)
    line = (line[np.isfinite(line).all(axis=1)] - surface.vertices.min(axis=0)) / surface.extent
    steps = np.linalg.norm(np.diff(line, axis=0), axis=1)
    line, steps = line[np.r_[True, steps > 1e-9][: len(line)]], steps[steps > 1e-9]
    if len(line) < 2:
        return nothing
    place = np.r_[0.0, np.cumsum(steps)]
    along = np.linspace(0.0, place[-1], int(np.clip(np.ceil(place[-1] / (0.2 * BRUSH)), 8, SAMPLES)))
    points = np.stack([np.interp(along, place, line[:, axis]) for axis in range(3)], axis=1)
    direction = unit(np.gradient(points, axis=0))

    ground = np.asarray(cKDTree(vertices).query(points)[1])
    edges = vertices[surface.faces] - vertices[np.roll(surface.faces, -1, axis=1)]
    reach = np.zeros(len(vertices))
    np.maximum.at(reach, surface.faces.reshape(-1), np.repeat(np.linalg.norm(edges, axis=2).max(axis=1), 3))
    reach = np.maximum(BRUSH, np.minimum(reach, WIDEST))
    far, nearest = (np.asarray(found) for found in cKDTree(points).query(vertices))
    # A stroke along one side of an ear leaves the other alone.
    same = np.einsum("ij,ij->i", surface.normals, surface.normals[ground[nearest]]) > 0.2
    near = np.where(same, np.clip(1.0 - (far / reach) ** 2, 0.0, 1.0) ** 2, 0.0)
    tangent = direction[nearest] - surface.normals * np.einsum("ij,ij->i", surface.normals, direction[nearest])[:, None]
    length = np.linalg.norm(tangent, axis=1)
    return unit(tangent), np.clip(stroke.strength, 0.0, 1.0) * near * np.clip(length / 0.2, 0.0, 1.0)
