"""Vertices, edges and faces as arrays: welding, winding, normals, neighbours."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import breadth_first_order, connected_components
from scipy.spatial import cKDTree

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

SHEET = 0.25
"""Share of a piece's area that its faces' vectors add up to, above which it is a sheet with two free sides."""

FLATTEST = 1e-4
"""Six volumes over the area (doubled) to the power 1.5: 0.2 for a ball; below it a piece encloses nothing."""


def face_vectors(vertices: Floats, faces: Ints) -> Floats:
    """(F, 3) normals of the faces, twice their area long."""
    a, b, c = (vertices[faces[:, i]] for i in range(3))
    return np.cross(b - a, c - a)


def unit(vectors: Floats) -> Floats:
    """(n, 3) vectors of length 1; a zero vector becomes +y, never NaN."""
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    up = np.broadcast_to(np.array([0.0, 1.0, 0.0]), vectors.shape)
    return np.where(length > 0.0, vectors / np.where(length > 0.0, length, 1.0), up)


def weld(vertices: Floats, faces: Ints, tolerance: float) -> tuple[Floats, Ints]:
    """Vertices and faces with all vertices that are within `tolerance` (model units) of each other made one.

    The joined vertex keeps the place of its first member.
    """
    cells = np.round((vertices - vertices.min(axis=0)) / tolerance)
    _, first, inverse = np.unique(cells, axis=0, return_index=True, return_inverse=True)
    inverse = inverse.reshape(-1)
    near = cKDTree(vertices[first]).query_pairs(tolerance, output_type="ndarray")
    graph = coo_array((np.ones(len(near)), (near[:, 0], near[:, 1])), shape=(len(first), len(first)))
    _, group = connected_components(graph, directed=False)
    label = group.astype(np.int64)[inverse]
    _, keep, index = np.unique(label, return_index=True, return_inverse=True)
    return vertices[keep], index.reshape(-1).astype(np.int64)[faces]


def duplicates(faces: Ints) -> NDArray[np.bool_]:
    """(F,) which faces repeat a corner or an earlier face, whatever its winding."""
    ordered = np.sort(faces, axis=1)
    _, first = np.unique(ordered, axis=0, return_index=True)
    again = np.ones(len(faces), dtype=bool)
    again[first] = False
    return np.asarray(again | (ordered[:, 0] == ordered[:, 1]) | (ordered[:, 1] == ordered[:, 2]))


def half_edges(faces: Ints) -> tuple[Ints, Ints, Ints]:
    """Edges as runs of half-edges: order, where and uses; edge e is order[where[e] : where[e] + uses[e]].

    Half-edge 3f + i runs from corner i of face f to the next corner.
    """
    start = faces.reshape(-1)
    end = np.roll(faces, -1, axis=1).reshape(-1)
    key = np.minimum(start, end) * np.int64(faces.max(initial=0) + 1) + np.maximum(start, end)
    order = np.argsort(key, kind="stable")
    _, where, uses = np.unique(key[order], return_index=True, return_counts=True)
    return order, where, uses


def orient(vertices: Floats, faces: Ints) -> Ints:
    """Faces wound alike over each piece of surface, closed pieces outward, sheets as most of their area was.

    Winding is carried over edges of exactly two faces: a parity along the breadth-first tree of each piece. A piece
    with a few holes counts as closed: its faces' vectors almost cancel.
    """
    count = len(faces)
    start = faces.reshape(-1)
    order, where, uses = half_edges(faces)
    pair = where[uses == 2]
    one, two = order[pair], order[pair + 1]
    a, b, clash = one // 3, two // 3, (start[one] == start[two]).astype(np.int64)

    links = csr_array((np.ones(2 * len(a)), (np.r_[a, b], np.r_[b, a])), shape=(count, count))
    pieces, piece = connected_components(links, directed=False)
    flip = _parity(links, piece, a, b, clash)
    turned = np.where(flip[:, None] == 1, faces[:, ::-1], faces)

    vectors = face_vectors(vertices, turned)
    areas = np.linalg.norm(vectors, axis=1)
    total = np.maximum(np.bincount(piece, areas, pieces), 1e-300)
    middle = _sums(piece, areas[:, None] * vertices[turned].mean(axis=1), pieces) / total[:, None]
    hollow = np.linalg.norm(_sums(piece, vectors, pieces), axis=1) / total < SHEET
    p, q, r = (vertices[turned[:, i]] - middle[piece] for i in range(3))
    volume = np.bincount(piece, np.einsum("ij,ij->i", p, np.cross(q, r)), pieces)
    # A crumpled sheet may cancel too, but it encloses nothing.
    solid = hollow & (np.abs(volume) > FLATTEST * total**1.5)
    kept = np.bincount(piece, areas * np.where(flip == 1, -1.0, 1.0), pieces)
    inside_out = np.where(solid, volume < 0.0, kept < 0.0)
    return np.where(inside_out[piece][:, None], turned[:, ::-1], turned)


def _sums(index: NDArray[np.int32], vectors: Floats, count: int) -> Floats:
    """(count, 3) sum of the vectors of each index."""
    return np.stack([np.bincount(index, vectors[:, i], count) for i in range(3)], axis=1)


def _parity(links: csr_array, piece: NDArray[np.int32], a: Ints, b: Ints, clash: Ints) -> Ints:
    """(F,) 0 or 1: flips that make neighbours a, b agree where `clash` says that they run alike along their edge."""
    count = links.shape[0]
    parent = np.arange(count)
    flip = np.zeros(count, dtype=np.int64)
    if not clash.any():
        return flip
    # One root joined to the first face of every piece makes a single tree of the forest.
    _, heads = np.unique(piece, return_index=True)
    rows, columns = np.r_[a, b, np.full(len(heads), count), heads], np.r_[b, a, heads, np.full(len(heads), count)]
    joined = csr_array((np.ones(len(rows)), (rows, columns)), shape=(count + 1, count + 1))
    _, before = breadth_first_order(joined, count, directed=False)
    parent = np.append(before[:count].astype(np.int64), count)
    flip = np.zeros(count + 1, dtype=np.int64)
    odd = csr_array((np.r_[clash, clash], (np.r_[a, b], np.r_[b, a])), shape=(count, count))
    inner = np.flatnonzero(parent[:count] < count)
    flip[inner] = np.asarray(odd[inner, parent[inner]]).reshape(-1) > 0
    while (parent != count).any():  # pointer doubling: log2 of the tree's depth
        flip ^= flip[parent]
        parent = parent[parent]
    return flip[:count]


def angle_normals(vertices: Floats, faces: Ints, at_corners: Floats | None = None) -> Floats:
    """(V, 3) unit vertex normals, each face weighted by its angle there (Thürmer and Wüthrich 1998).

    at_corners : (F, 3, 3) unit normal of each face at its corners; by default it is flat
    """
    flat = unit(face_vectors(vertices, faces))
    at_corners = np.repeat(flat[:, None], 3, axis=1) if at_corners is None else at_corners
    angles, total = corner_angles(vertices, faces), np.zeros_like(vertices)
    for i in range(3):
        np.add.at(total, faces[:, i], angles[:, i, None] * at_corners[:, i])
    # Where faces cancel (a folded leaf), any one of them will do.
    lost = np.linalg.norm(total, axis=1) < 1e-9
    any_face = np.zeros_like(total)
    any_face[faces.reshape(-1)] = np.repeat(flat, 3, axis=0)
    return unit(np.where(lost[:, None], any_face, total))


def corner_angles(vertices: Floats, faces: Ints) -> Floats:
    """(F, 3) angles of the faces at their corners, radians."""
    found = np.empty(faces.shape)
    for i in range(3):
        here, after, before = (vertices[faces[:, (i + j) % 3]] for j in range(3))
        one, two = unit(after - here), unit(before - here)
        found[:, i] = np.arctan2(np.linalg.norm(np.cross(one, two), axis=1), np.einsum("ij,ij->i", one, two))
    return found


def smoother(vertices: int, faces: Ints) -> csr_array:
    """(V, V) matrix that replaces a value by the mean of its own and of the mean over its neighbours."""
    a, b = faces.reshape(-1), np.roll(faces, -1, axis=1).reshape(-1)
    links = csr_array((np.ones(2 * len(a)), (np.r_[a, b], np.r_[b, a])), shape=(vertices, vertices))
    links.data[:] = 1.0
    degree = np.maximum(np.asarray(links.sum(axis=1)).reshape(-1), 1.0)
    rows = np.repeat(np.arange(vertices), np.diff(links.indptr))
    half = csr_array((0.5 / degree[rows], links.indices, links.indptr), shape=links.shape)
    own = csr_array((np.full(vertices, 0.5), (np.arange(vertices), np.arange(vertices))), shape=links.shape)
    return csr_array(half + own)
