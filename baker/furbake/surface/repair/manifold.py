"""Cut a surface so that every edge has at most two faces and every vertex one fan or disc of them.

After Guéziec et al. 2001, "Cutting and stitching": faces that meet at a bad edge are paired where they fit best, the
rest becomes border, and a vertex is repeated once for every fan that this leaves around it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from furbake.surface.repair.topology import Floats, Ints, face_vectors, half_edges, unit

MAX_PAIRED = 16
"""Faces at one edge that are still paired; with more, all of them end there."""

CONVEX = 0.01
"""How much better two faces fit that bend away from their outside: two boxes that touch stay two."""


ROUNDS = 4
"""Rounds of cutting; the second is rare, the third has not been seen."""


@dataclass(frozen=True)
class Manifold:
    """A surface whose vertices are copies.

    source : (V',) int, vertex that each is a copy of, ascending
    faces : (F, 3) int, into the copies, in the order they had
    crowded : edges of three or more faces that were there
    torn : edges of two faces that were cut because their faces run against each other (a one-sided surface)
    split : vertices of more than one fan that were there
    """

    source: Ints
    faces: Ints
    crowded: int
    torn: int
    split: int


def separate(vertices: Floats, faces: Ints) -> Manifold:
    """Cut oriented faces apart wherever they do not make a surface."""
    order, where, uses = half_edges(faces)
    start = faces.reshape(-1)
    two = where[uses == 2]
    one, other = order[two], order[two + 1]
    runs_on = start[one] != start[other]
    fitted = _fit(vertices, faces, order, where[uses > 2], uses[uses > 2])
    source, cut = _copies(
        faces, np.concatenate([one[runs_on], fitted[:, 0]]), np.concatenate([other[runs_on], fitted[:, 1]])
    )
    split = int((np.bincount(source) > 1).sum())
    # Two couples can still share both ends of their edge, where a fan winds around twice: those come apart too.
    for _ in range(ROUNDS):
        order, where, again = half_edges(cut)
        start = cut.reshape(-1)
        two = where[again == 2]
        one, other = order[two], order[two + 1]
        if (again <= 2).all() and (start[one] != start[other]).all():
            break
        fine = start[one] != start[other]
        more, cut = _copies(cut, one[fine], other[fine])
        source = source[more]
    return Manifold(source, cut, int((uses > 2).sum()), int((~runs_on).sum()), split)


def _copies(faces: Ints, left: Ints, right: Ints) -> tuple[Ints, Ints]:
    """Vertex that each copy stems from, and (F, 3) faces of copies: one copy per fan of corners around a vertex.

    left, right : (P,) half-edges of two faces that continue each other there, the opposite way
    """
    start = faces.reshape(-1)
    following = np.arange(faces.size).reshape(-1, 3)[:, [1, 2, 0]].reshape(-1)
    near = np.concatenate([left, following[left]])
    far = np.concatenate([following[right], right])
    links = coo_array((np.ones(len(near)), (near, far)), shape=(faces.size, faces.size))
    _, fan = connected_components(links, directed=False)
    # In the order of the sources: a surface with nothing to cut keeps its numbering.
    _, first, index = np.unique(fan, return_index=True, return_inverse=True)
    rank = np.argsort(start[first], kind="stable")
    place = np.empty_like(rank)
    place[rank] = np.arange(len(rank))
    return start[first][rank], place[index].reshape(-1, 3)


def _fit(vertices: Floats, faces: Ints, order: Ints, where: Ints, uses: NDArray[np.int64]) -> Ints:
    """(P, 2) half-edges of crowded edges that continue each other: opposite ways, the flattest couples first."""
    few = uses <= MAX_PAIRED
    where, uses = where[few], uses[few]
    start, end = faces.reshape(-1), np.roll(faces, -1, axis=1).reshape(-1)
    normals, middles = unit(face_vectors(vertices, faces)), vertices[faces].mean(axis=1)
    ones, others, edges = [], [], []
    for i in range(int(uses.max(initial=0))):
        for j in range(int(uses.max(initial=0))):
            there = np.flatnonzero((i < uses) & (j < uses))
            one, other = order[where[there] + i], order[where[there] + j]
            fits = (start[one] < end[one]) & (start[one] == end[other])
            ones.append(one[fits])
            others.append(other[fits])
            edges.append(there[fits])
    if not ones:
        return np.zeros((0, 2), dtype=np.int64)
    one, other, edge = np.concatenate(ones), np.concatenate(others), np.concatenate(edges)
    a, b = one // 3, other // 3
    misfit = 1.0 - np.einsum("ij,ij->i", normals[a], normals[b])
    misfit -= CONVEX * (np.einsum("ij,ij->i", middles[b] - middles[a], normals[a]) < 0.0)
    chosen = []
    for _ in range(MAX_PAIRED):
        best = np.lexsort((other, one, misfit, edge))
        _, first = np.unique(edge[best], return_index=True)
        take = best[first]
        if not len(take):
            break
        chosen.append(np.stack([one[take], other[take]], axis=1))
        rest = ~(np.isin(one, one[take]) | np.isin(other, other[take]))
        one, other, edge, misfit = one[rest], other[rest], edge[rest], misfit[rest]
    return np.concatenate(chosen) if chosen else np.zeros((0, 2), dtype=np.int64)
