"""Divide faces along sharp edges, so that the normals of a coarse mesh turn there within a hair's length.

A vertex has one normal. On a box of twelve faces it is the mean of three sides, and shells between such vertices are
those of a round body: fur leans, and is lit, as on a ball. The shape stays, as does every normal of a smooth surface.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from furbake.surface.material import Skin
from furbake.surface.mesh import Surface
from furbake.surface.repair.bisect import Pieces, bisect, whole
from furbake.surface.repair.seams import unique_rows
from furbake.surface.repair.topology import angle_normals, corner_angles, face_vectors, unit
from furbake.surface.soup import Floats, Ints

SHARP = np.cos(np.radians(40))
"""Cosine between the normals of a vertex and of a face there below which the face is divided.

The edges of a box have 45°, tubes of five and more sides at most 36°: those are round bodies cut into few faces.
"""

FINEST = 0.01
"""Least length of edges that are divided, share of the largest side."""

COARSER = 2**0.5
"""Growth of that length where there would be too many faces."""

FEW = 0.01
"""Share of the area up to which faces along sharp edges are left: creases by chance of a round body."""


def divide(surface: Surface, lengths: Floats, most: int) -> Surface:
    """The surface with the faces along its sharp edges divided until they are as small as the `lengths` there.

    lengths : (V,) model units; most : faces; where there would be more, those along sharp edges stay larger. The
    surface itself is returned where there are hardly any, and of built-in shapes.
    """
    if len(surface.faces) >= most or surface.natural is not None:
        return surface
    smooth = _corner_normals(surface.vertices, surface.faces)
    sizes = np.maximum(lengths, FINEST * surface.extent)
    while len((pieces := _divided(surface, smooth, sizes, most)).faces) > most:
        sizes *= COARSER
    areas = np.linalg.norm(face_vectors(surface.vertices, surface.faces), axis=1)
    parted = np.bincount(pieces.parent) > 1
    return _carried(surface, pieces, smooth) if areas[parted].sum() > FEW * areas.sum() else surface


def _divided(surface: Surface, smooth: Floats, sizes: Floats, most: int) -> Pieces:
    """Triangles that touch a sharp edge are no larger than `sizes`, (V,); it stops above `most` of them."""
    pieces = whole(surface.vertices, surface.faces)
    while len(pieces.faces) <= most:
        own = _interpolated(pieces, smooth)
        normals = angle_normals(pieces.vertices, pieces.faces, own)
        sharp = (np.einsum("fij,fij->fi", own, normals[pieces.faces]) < SHARP).any(axis=1)
        corners = pieces.vertices[pieces.faces]
        wanted = pieces.carried(sizes[surface.faces][..., None]).max(axis=(1, 2))
        large = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2).max(axis=1) > wanted
        if not (sharp & large).any():
            break
        pieces = bisect(pieces, sharp & large)
    return pieces


def _corner_normals(vertices: Floats, faces: Ints) -> Floats:
    """(F, 3, 3) unit normal of the smooth surface that a face belongs to, at each of its corners.

    It is the vertex normal; where a vertex is sharp, the mean of the faces there that look the same way.
    """
    flat = unit(face_vectors(vertices, faces))
    found = angle_normals(vertices, faces)[faces]
    sharp = np.zeros(len(vertices), bool)
    sharp[faces[np.einsum("fij,fj->fi", found, flat) < SHARP]] = True
    corner = np.flatnonzero(sharp[faces].reshape(-1))
    corner = corner[np.argsort(faces.reshape(-1)[corner], kind="stable")]
    _, start, uses = np.unique(faces.reshape(-1)[corner], return_index=True, return_counts=True)
    # Every corner with every corner at the same vertex.
    many = np.repeat(uses, uses)
    one = np.repeat(np.arange(len(corner)), many)
    two = np.repeat(np.repeat(start, uses) - np.cumsum(many) + many, many) + np.arange(len(one))
    way, weight = flat[corner // 3], corner_angles(vertices, faces).reshape(-1)[corner]
    alike = np.einsum("ij,ij->i", way[one], way[two]) > SHARP
    total = np.zeros((len(corner), 3))
    np.add.at(total, one[alike], (weight[:, None] * way)[two[alike]])
    found.reshape(-1, 3)[corner] = unit(total)
    return found


def _interpolated(pieces: Pieces, smooth: Floats) -> Floats:
    """(F, 3, 3) `_corner_normals` of the pieces: interpolated, unit (Phong 1975)."""
    return unit(pieces.carried(smooth).reshape(-1, 3)).reshape(-1, 3, 3)


def _carried(surface: Surface, pieces: Pieces, smooth: Floats) -> Surface:
    """The surface in pieces, with all that its faces and vertices have."""
    _, first = np.unique(pieces.faces, return_index=True)

    def at_vertices(values: Floats) -> Floats:
        return pieces.carried(values[surface.faces]).reshape(-1, values.shape[1])[first]

    return replace(
        surface,
        vertices=pieces.vertices,
        faces=pieces.faces,
        normals=angle_normals(pieces.vertices, pieces.faces, _interpolated(pieces, smooth)),
        colours=None if surface.colours is None else at_vertices(surface.colours),
        uv=None if surface.uv is None else pieces.carried(surface.uv),
        attributes={name: at_vertices(values) for name, values in surface.attributes.items()},
        skin=tuple(_piece(skin, surface.faces, pieces) for skin in surface.skin),
    )


def _piece(skin: Skin, faces: Ints, pieces: Pieces) -> Skin:
    """A piece of skin, divided as the surface below it."""
    own = skin.source[skin.faces]
    _, key = unique_rows(*np.sort(np.concatenate([faces, own]), axis=1).T)
    covers = np.full(int(key.max()) + 1, -1)
    covers[key[len(faces) :]] = np.arange(len(own))
    beneath = covers[key[: len(faces)]][pieces.parent]
    mine = beneath >= 0
    corners = pieces.faces[mine].reshape(-1)

    def carried(values: Floats) -> Floats:
        at = replace(pieces, parent=beneath[mine], shares=pieces.shares[mine])
        return at.carried(values[skin.faces]).reshape(len(corners), -1)

    uv = None if skin.uv is None else carried(skin.uv)
    colour = None if skin.colour is None else carried(skin.colour)
    columns = [corners[:, None], *(values for values in (uv, colour) if values is not None)]
    first, index = unique_rows(*np.concatenate(columns, axis=1).T)
    return replace(
        skin,
        source=corners[first],
        faces=index.reshape(-1, 3),
        uv=None if uv is None else uv[first],
        colour=None if colour is None else colour[first],
    )
