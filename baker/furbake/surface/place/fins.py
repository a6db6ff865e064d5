"""Fins: a quad on every edge, upright on the skin, that shows the fur from the side where shells are seen edge-on."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from furbake.surface.mesh import Surface
from furbake.surface.repair.topology import face_vectors, unit

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

SHARPEST = np.radians(80)
"""Largest angle between the faces of a convex edge that has a fin.

An edge is on the outline for a share of all views that grows with this angle. Up to here the surface is a round one
cut into few triangles; the edges of a box (90°) are creases, whose fin would stand out as a crest from both sides.
"""

HOLLOWEST = np.radians(12)
"""The same for a concave edge. The outline runs over convex ones alone: where a face beside a hollow turns away from
the eye, the other hides it. What is as shallow as this is the chance of the mesh, not the shape of the body.
"""

STEEPEST = 0.9
"""Largest cosine between an edge and the fur's direction at one of its ends."""

GOLDEN = (np.sqrt(5) - 1) / 2


@dataclass(frozen=True)
class Fins:
    """E quads, four vertices each: root and root, tip and tip, over the two ends of an edge; all with E first.

    source : (4E,) int, vertex of the surface on which each vertex here stands
    faces : (2E, 3) int
    tangents : (4E, 3) unit, along the edge, where u grows
    uv : (4E, 2) tiles along the edge, not below 0; height: 0 at roots, 1 at tips
    angles : (4E, 2) radians, -π..π: the normals of the edge's two faces, turned about the edge t from n (the vertex
        normal made perpendicular to t) towards t × n. At a border the second is that of the direction into the face: a
        face that an eye outside the border sees from behind, so that the edge is an outline to it
    laid : (4E,) radians, -π..π: where the fur is laid, turned about the vertex normal n from t towards t × n
    """

    source: Ints
    faces: Ints
    tangents: Floats
    uv: Floats
    angles: Floats
    laid: Floats


def build_fins(
    surface: Surface, direction: Floats, tile: float, lean: float = 0.0, seed: int = 0, length: float = 0.0
) -> Fins:
    """Fins of every edge that is neither sharp nor shared by more than two faces; borders are included.

    direction : (V, 3) unit tangent vectors along which the fur is laid
    tile : width of a tile, model units
    lean : how far the hairs in the fins' texture lean along growing u, tiles
    length : of the fur, model units. Diagonals that are shorter have no fin

    u grows to where the fur is laid. Where an edge does not run that way, the tips are sheared back: across the fur's
    direction hairs stand upright. Every edge begins elsewhere in the tile: those that meet at a vertex follow each
    other by golden sections, so that none shows the tuft of its neighbour.
    """
    ends, faces = fin_edges(surface, length)
    way = surface.vertices[ends[:, 1]] - surface.vertices[ends[:, 0]]
    length = np.linalg.norm(way, axis=1)
    along = way / np.maximum(length, 1e-300)[:, None]
    laid = direction[ends].sum(axis=1)
    cosine = np.einsum("ij,ij->i", along, unit(laid))
    back = cosine < 0.0
    ends = np.where(back[:, None], ends[:, ::-1], ends)
    along = np.where(back[:, None], -along, along)

    count = len(ends)
    start = np.modf(np.random.default_rng(seed).random() + GOLDEN * np.arange(count))[0]
    end = start + length / tile
    sheared = lean * (1.0 - np.abs(cosine))
    u = np.stack([start, end, start + sheared, end + sheared], axis=1)
    u -= np.minimum(np.floor(u.min(axis=1, keepdims=True, initial=0.0)), 0.0)
    height = np.tile([0.0, 0.0, 1.0, 1.0], count)

    source = np.tile(ends, 2).reshape(-1)
    tangents = np.repeat(along, 4, axis=0)
    normals = unit(face_vectors(surface.vertices, surface.faces))[faces]
    border = faces[:, 0] == faces[:, 1]
    inward = surface.vertices[surface.faces[faces[:, 1]]].mean(axis=1) - surface.vertices[ends[:, 0]]
    inward -= along * np.einsum("ij,ij->i", inward, along)[:, None]
    normals[border, 1] = unit(inward)[border]
    first = 4 * np.arange(count)[:, None]
    return Fins(
        source=source,
        faces=(first + np.array([0, 1, 3, 0, 3, 2])).reshape(-1, 3),
        tangents=tangents,
        uv=np.column_stack([u.reshape(-1), height]),
        angles=angles_about(tangents, surface.normals[source], np.repeat(normals, 4, axis=0)),
        laid=-angles_about(surface.normals[source], tangents, direction[source][:, None])[:, 0],
    )


def fin_edges(surface: Surface, length: float = 0.0) -> tuple[Ints, Ints]:
    """Edges that get a fin: (E, 2) vertices, the lower one first, and (E, 2) faces, the same one twice at a border.

    Where triangles are smaller than the fur is long (`length`), an edge that is the longest of both its faces is left
    out: the outline goes round it over the others, and a quarter of the bytes is saved.
    """
    corners = surface.faces.reshape(-1)
    following = np.roll(surface.faces, -1, axis=1).reshape(-1)
    pairs = np.sort(np.stack([corners, following], axis=1), axis=1)
    ends, index, uses = np.unique(pairs, axis=0, return_inverse=True, return_counts=True)
    order = np.argsort(index.reshape(-1), kind="stable")
    first = np.cumsum(uses) - uses
    owner = np.repeat(np.arange(len(surface.faces)), 3)[order]
    faces = np.stack([owner[first], owner[first + np.minimum(uses, 2) - 1]], axis=1)

    normals = unit(face_vectors(surface.vertices, surface.faces))
    one, two = normals[faces[:, 0]], normals[faces[:, 1]]
    bend = np.arctan2(np.linalg.norm(np.cross(one, two), axis=1), np.einsum("ij,ij->i", one, two))
    middles = surface.vertices[surface.faces].mean(axis=1)
    convex = np.einsum("ij,ij->i", middles[faces[:, 1]] - middles[faces[:, 0]], two - one) >= 0.0
    way = surface.vertices[ends[:, 1]] - surface.vertices[ends[:, 0]]
    size = np.linalg.norm(way, axis=1)
    steep = np.abs(np.einsum("ijk,ik->ij", surface.normals[ends], unit(way))).max(axis=1)
    kept = (uses <= 2) & (bend <= np.where(convex, SHARPEST, HOLLOWEST)) & (steep <= STEEPEST)

    rank = np.argsort(np.argsort(size, kind="stable"), kind="stable")  # without ties
    longest = np.full(len(surface.faces), -1)
    np.maximum.at(longest, np.repeat(np.arange(len(surface.faces)), 3), rank[index.reshape(-1)])
    kept &= (uses == 1) | (size >= length) | (longest[faces] > rank[:, None]).any(axis=1)
    return ends[kept].astype(np.int64), faces[kept].astype(np.int64)


def angles_about(axes: Floats, zero: Floats, vectors: Floats) -> Floats:
    """(n, m) angles of vectors (n, m, 3) about unit axes (n, 3), from `zero` (n, 3) towards axis × zero, radians."""
    upright = unit(zero - axes * np.einsum("ij,ij->i", axes, zero)[:, None])
    across = np.cross(axes, upright)
    y, x = np.einsum("imk,ik->im", vectors, across), np.einsum("imk,ik->im", vectors, upright)
    return np.asarray(np.arctan2(y, x))
