"""A surface cut into sheets on which one can walk: every edge has at most two faces, every vertex one fan of them.

Lengths are divided by the largest side of the surface, so that nothing here depends on the model's unit.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import connected_components

from furbake.surface.charts import Floats, Ints
from furbake.surface.mesh import Surface
from furbake.surface.repair.topology import angle_normals, unit

Complex = NDArray[np.complex128]

SHORTEST = 1e-12
"""Length that an edge has at least, share of the largest side."""


@dataclass(frozen=True)
class Sheet:
    """The faces of a surface, in their order, on vertices of their own.

    source : (S,) int, vertex of the surface that each vertex here is a copy of
    vertices : (S, 3) float, shares of the largest side; normals : (S, 3) float, unit
    faces : (F, 3) int; edges : (F, 3) int, edge from corner i to i + 1, shared by at most two faces, wound alike
    piece : (S,) int, connected piece of each vertex
    """

    source: Ints
    vertices: Floats
    normals: Floats
    faces: Ints
    edges: Ints
    piece: Ints


def cut(surface: Surface) -> Sheet:
    """Sheets of a surface: cut along edges of more than two faces, where winding clashes, and where fans only touch."""
    faces = surface.faces
    count = len(faces)
    start, end = faces.reshape(-1), np.roll(faces, -1, axis=1).reshape(-1)
    key = np.minimum(start, end) * np.int64(len(surface.vertices)) + np.maximum(start, end)
    order = np.argsort(key, kind="stable")
    _, where, uses = np.unique(key[order], return_index=True, return_counts=True)
    pair = where[uses == 2]
    one, two = order[pair], order[pair + 1]
    alike = start[one] != start[two]
    one, two = one[alike], two[alike]

    edge = np.arange(3 * count)
    edge[two] = one
    _, edges = np.unique(edge, return_inverse=True)

    after = (np.arange(3 * count).reshape(-1, 3)[:, [1, 2, 0]]).reshape(-1)
    a, b = np.r_[one, after[one]], np.r_[after[two], two]
    fans = coo_array((np.ones(len(a)), (a, b)), shape=(3 * count, 3 * count))
    _, label = connected_components(fans, directed=False)
    vertex, first, corners = np.unique(label, return_index=True, return_inverse=True)
    source = start[first]
    own = corners.reshape(-1, 3).astype(np.int64)

    low = surface.vertices.min(axis=0)
    vertices = (surface.vertices[source] - low) / surface.extent
    links = coo_array(
        (np.ones(3 * count), (own.reshape(-1), np.roll(own, -1, axis=1).reshape(-1))), shape=2 * vertex.shape
    )
    _, piece = connected_components(links, directed=False)
    return Sheet(source, vertices, angle_normals(vertices, own), own, edges.reshape(-1, 3), piece.astype(np.int64))


def frames(normals: Floats) -> tuple[Floats, Floats]:
    """(n, 3) two unit tangents e1, e2 to each unit normal, e1 × e2 = n."""
    least = np.argmin(np.abs(normals), axis=1)
    e1 = unit(np.cross(normals, np.eye(3)[least]))
    return e1, np.cross(normals, e1)


def rotated(vectors: Floats, old: Floats, new: Floats) -> Floats:
    """Tangent vectors at unit normals `old`, turned by the smallest rotation onto tangents at `new`."""
    cosine = np.einsum("ij,ij->i", old, new)
    share = np.einsum("ij,ij->i", new, vectors) / np.maximum(1.0 + cosine, 1e-9)
    return np.asarray(vectors - share[:, None] * (old + new))


def transport(normals: Floats, e1: Floats, e2: Floats, i: Ints, j: Ints) -> Complex:
    """(n,) unit complex: z in the frame of vertex i is transport · z in the frame of its neighbour j."""
    moved = rotated(e1[i], normals[i], normals[j])
    z = np.einsum("ij,ij->i", moved, e1[j]) + 1j * np.einsum("ij,ij->i", moved, e2[j])
    size = np.abs(z)
    return np.where(size > 1e-6, z / np.maximum(size, 1e-6), 1.0)


def flattened(corners: Floats) -> Complex:
    """(n, 3) triangles, (n, 3, 3) float, laid into the plane: the first corner at 0, the second on the real axis."""
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    base = np.maximum(np.linalg.norm(a, axis=1), SHORTEST)
    along = np.einsum("ij,ij->i", a, b) / base
    height = np.linalg.norm(np.cross(a, b), axis=1) / base
    return np.stack([np.zeros(len(a), dtype=complex), base + 0j, along + 1j * height], axis=1)


def cotangents(flat: Complex, least: float = 0.05, most: float = 10.0) -> Floats:
    """(n, 3) cotangent of the angle opposite to the edge from corner i to i + 1, held positive and finite."""
    weights = np.empty(flat.shape)
    for i in range(3):
        apex = flat[:, (i + 2) % 3]
        product = np.conj(flat[:, i] - apex) * (flat[:, (i + 1) % 3] - apex)
        weights[:, i] = product.real / np.maximum(np.abs(product.imag), 1e-12 * np.abs(product) + 1e-300)
    return np.clip(weights, least, most)


def ways(sheet: Sheet) -> tuple[Ints, Ints, Floats]:
    """Steps i → j of a walk and their lengths, both ways: along edges, and straight across them between two faces."""
    edge = sheet.edges.reshape(-1)
    start, end = sheet.faces.reshape(-1), np.roll(sheet.faces, -1, axis=1).reshape(-1)
    apex = np.roll(sheet.faces, -2, axis=1).reshape(-1)
    _, first, uses = np.unique(edge, return_index=True, return_counts=True)
    a, b = start[first], end[first]
    length = np.linalg.norm(sheet.vertices[a] - sheet.vertices[b], axis=1)

    order = np.argsort(edge, kind="stable")
    begins = np.cumsum(uses) - uses
    one, two = order[begins[uses == 2]], order[begins[uses == 2] + 1]
    here = flattened(sheet.vertices[np.stack([start[one], end[one], apex[one]], axis=1)])
    there = flattened(sheet.vertices[np.stack([start[one], end[one], apex[two]], axis=1)])
    p, q, base = here[:, 2], np.conj(there[:, 2]), here[:, 1].real
    rise = np.maximum(p.imag - q.imag, SHORTEST)
    crossing = p.real - p.imag * (p.real - q.real) / rise
    inside = (crossing > 0.0) & (crossing < base) & (apex[one] != apex[two])
    i, j = np.r_[a, apex[one][inside]], np.r_[b, apex[two][inside]]
    far = np.maximum(np.r_[length, np.abs(p - q)[inside]], SHORTEST)
    return np.r_[i, j], np.r_[j, i], np.r_[far, far]


def shortest(count: int, i: Ints, j: Ints, length: Floats) -> csr_array:
    """(n, n) matrix of lengths, of repeated steps the shortest."""
    key = i * np.int64(count) + j
    order = np.lexsort((length, key))
    _, first = np.unique(key[order], return_index=True)
    keep = order[first]
    return csr_array((length[keep], (i[keep], j[keep])), shape=(count, count))
