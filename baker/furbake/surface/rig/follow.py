"""Joints and displacements of new vertices, by the nearest point of the original surface."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from furbake.surface.repair.near import around, candidates, closest, nearest, sampled
from furbake.surface.repair.seams import unique_rows
from furbake.surface.repair.topology import face_vectors, unit
from furbake.surface.rig.rig import Floats, Ints, Rig
from furbake.surface.rig.weights import as_bytes, strongest

SAME = 1e-7
"""Places nearer than this, in the largest side of the model, are one."""

ASIDE, WIDER = 0.003, 3.0
"""How much farther a face may be that looks the vertex's way: in the largest side of the model, and in the distance
of the nearest face."""


@dataclass(frozen=True)
class Follow:
    """How vertices follow a rig.

    joints : (V, 4) index in `Rig.joints`, 0 where the weight is 0
    weights : (V, 4), each row sums to 255
    deltas : (T, V, 3) displacement by each of `Rig.targets`, bind pose
    """

    joints: NDArray[np.uint16]
    weights: NDArray[np.uint8]
    deltas: Floats


def follow(rig: Rig, vertices: Floats, normals: Floats) -> Follow:
    """How vertices of the posed model follow its rig: as the nearest point of `rig.posed` that faces their way.

    vertices, normals : (V, 3). A vertex in the place of one of the original's follows as that one does.
    """
    corners, extent = rig.posed[rig.faces], float(np.ptp(rig.posed, axis=0).max())
    faces = _faces(rig, corners, extent, vertices, normals)
    shares, _ = closest(corners[faces], vertices)
    at_corner = np.linalg.norm(corners[faces] - vertices[:, None], axis=2)
    here = (at_corner.min(axis=1) <= SAME * extent)[:, None]
    shares = np.where(here, np.eye(3)[at_corner.argmin(axis=1)], shares)
    one = rig.faces[faces]
    deltas = np.zeros((len(rig.targets), len(vertices), 3))
    for i, target in enumerate(rig.targets):
        deltas[i] = np.einsum("nk,nkd->nd", shares, target.deltas[one])
    blended = (shares[:, :, None] * rig.shares[one]).reshape(len(vertices), -1)
    which, kept, _ = strongest(rig.which[one].reshape(len(vertices), -1), blended)
    return Follow(*as_bytes(which, kept), deltas)


def _faces(rig: Rig, corners: Floats, extent: float, vertices: Floats, normals: Floats) -> Ints:
    """(V,) the face that each vertex follows."""
    first = nearest(corners, candidates(sampled(corners), vertices), vertices)
    limit = closest(corners[first], vertices)[1]
    rows, faces = around(corners, vertices, limit)
    rows, faces = np.append(rows, np.arange(len(first))), np.append(faces, first)
    out = _outward(rig, first, normals)
    distance = closest(corners[faces], vertices[rows])[1]
    least = np.full(len(vertices), np.inf)
    np.minimum.at(least, rows, distance)
    agree = np.einsum("ij,ij->i", out[faces], normals[rows])
    best = _first(rows, distance > least[rows] + SAME * extent, -np.round(agree, 6), faces)
    found = faces[best]

    # Thin parts: behind a vertex of the front there may be a face of the back that is nearer than its own.
    away = np.flatnonzero(agree[best] < 0.0)
    if len(away):
        rows, faces = around(corners, vertices[away], WIDER * least[away] + ASIDE * extent)
        distance = closest(corners[faces], vertices[away][rows])[1]
        agree = np.einsum("ij,ij->i", out[faces], normals[away][rows])
        good = (agree > 0.0) & (distance <= WIDER * least[away][rows] + ASIDE * extent)
        rows, faces, distance = rows[good], faces[good], distance[good]
        best = _first(rows, distance, faces)
        found[away[rows[best]]] = faces[best]
    return found


def _first(rows: Ints, *keys: NDArray[np.generic]) -> Ints:
    """Index of the first entry of each row in the order of the keys."""
    order = np.lexsort((*keys[::-1], rows))
    return order[np.unique(rows[order], return_index=True)[1]]


def _outward(rig: Rig, faces: Ints, normals: Floats) -> Floats:
    """(F, 3) unit normals of the original's faces; pieces that are wound the other way than the vertices are turned.

    faces : (V,) the nearest one to each vertex
    """
    flat = face_vectors(rig.posed, rig.faces)
    area = np.linalg.norm(flat, axis=1)
    flat = np.where((area > 0.0)[:, None], unit(flat), 0.0)
    first, place = unique_rows(*rig.posed.T)
    a, b = place[rig.faces[:, :2]].reshape(-1), place[rig.faces[:, 1:]].reshape(-1)
    links = coo_array((np.ones(len(a)), (a, b)), shape=(len(first), len(first)))
    piece = connected_components(links, directed=False)[1][place[rig.faces[:, 0]]]
    votes = np.bincount(piece[faces], np.einsum("ij,ij->i", flat[faces], normals), piece.max(initial=0) + 1)
    return np.where((votes < 0.0)[piece][:, None], -flat, flat)
