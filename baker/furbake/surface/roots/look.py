"""The model's own base colour at any point of its skin: factor × picture × vertex colour, as glTF says."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from furbake.surface.colours import LINEAR, Bytes, decode, sample_picture
from furbake.surface.material import Picture, Skin
from furbake.surface.mesh import Surface
from furbake.surface.repair.near import candidates, closest, sampled
from furbake.surface.roots.raster import drawn
from furbake.surface.soup import Flags, Floats, Ints

AT_ONCE = 200_000
"""Points that are looked at together."""

NEIGHBOURS = [(y, x) for y in (-1, 0, 1) for x in (-1, 0, 1) if (y, x) != (0, 0)]


@dataclass(frozen=True)
class Points:
    """Points on a skin: (n,) faces, counted piece by piece, and (n, 3) shares of their corners."""

    face: Ints
    shares: Floats


class BaseColours:
    """Base colours of a skin. Its pictures are decoded once; between their faces they have the colours inside."""

    def __init__(self, surface: Surface) -> None:
        self.surface = surface
        faces: dict[Picture, list[Floats]] = {}
        for piece in surface.skin:
            if piece.uv is not None and piece.material.picture is not None:
                faces.setdefault(piece.material.picture, []).append(_coordinates(piece, np.arange(len(piece.faces))))
        decoded = {picture: decode(picture) for picture in faces}
        self.pixels = {
            picture: spread(pixels[..., :3], faces[picture])
            for picture, pixels in decoded.items()
            if pixels is not None
        }

    def at(self, points: Points) -> Floats:
        """(n, 3) linear base colours."""
        colour = np.ones((len(points.face), 3))
        for piece, rows, mine in _by_piece(self.surface, points):
            material = piece.material
            colour[rows] *= material.factor[:3]
            if piece.colour is not None:
                corners = piece.colour[piece.faces[mine.face], :3]
                colour[rows] *= np.einsum("nc,nck->nk", mine.shares, corners)
            if piece.uv is None or material.picture not in self.pixels:
                continue
            pixels = self.pixels[material.picture]
            for some in np.array_split(np.arange(len(rows)), len(rows) // AT_ONCE + 1):
                uv = np.einsum("nc,nck->nk", mine.shares[some], _coordinates(piece, mine.face[some]))
                colour[rows[some]] *= sample_picture(pixels, uv, material.wrap, LINEAR)
        return colour


def spread(pixels: Bytes, coordinates: list[Floats]) -> Bytes:
    """A picture whose texels beside islands have the colours inside, so that none of what lies between shows at seams.

    pixels : (height, width, 3); coordinates : (F, 3, 2) of faces. A picture that repeats under a face stays as it is.
    """
    corners = np.concatenate(coordinates)
    whole = np.floor(corners.min(axis=1))
    if (corners.max(axis=1) - whole > 1.0 + 1e-6).any():
        return pixels
    height, width = pixels.shape[:2]
    inside = np.zeros((height, width), dtype=bool)
    for _, row, column, _ in drawn((corners - whole[:, None]) * (width, height), (height, width)):
        inside[row, column] = True
    found = pixels.copy()
    for _ in range(2):
        rim, colours = _rim(found, inside)
        found[rim] = colours
        inside[rim] = True
    return found


def _rim(pixels: Bytes, inside: Flags) -> tuple[tuple[Ints, Ints], Bytes]:
    """Texels outside that have a neighbour inside, and the mean of such neighbours."""
    height, width = inside.shape
    padded = np.pad(inside, 1)
    shifted = [padded[1 + y : 1 + y + height, 1 + x : 1 + x + width] for y, x in NEIGHBOURS]
    number = np.asarray(np.sum(shifted, axis=0, dtype=np.uint8))
    row, column = np.nonzero(~inside & (number > 0))
    total = np.zeros((len(row), 3))
    for y, x in NEIGHBOURS:
        there = np.clip(row + y, 0, height - 1), np.clip(column + x, 0, width - 1)
        total += np.where((padded[row + 1 + y, column + 1 + x])[:, None], pixels[there], 0.0)
    return (row, column), np.rint(total / number[row, column][:, None]).astype(np.uint8)


def on_skin(surface: Surface, faces: Ints) -> tuple[Ints, Ints] | None:
    """Faces (n, 3) of the surface as faces of its skin: (n,) their numbers there, and (n, 3) which of the corners here
    each corner there is. None where the skin has not all of them.
    """
    there, lead = _turned(_skin_faces(surface))
    here, first = _turned(faces)
    _, index = np.unique(np.concatenate([there, here]), axis=0, return_inverse=True)
    index = index.reshape(-1)
    number = np.full(int(index.max()) + 1, -1, dtype=np.int64)
    number[index[: len(there)]] = np.arange(len(there))
    found = number[index[len(there) :]]
    if (found < 0).any():
        return None
    return found, (np.arange(3)[None] + (first - lead[found])[:, None]) % 3


def nearest_on_skin(surface: Surface, places: Floats) -> Points:
    """Points of the surface's skin next to (n, 3) places, in any part of it."""
    corners = surface.vertices[_skin_faces(surface)]
    tree = sampled(corners)
    face, shares = np.zeros(len(places), dtype=np.int64), np.zeros((len(places), 3))
    for some in np.array_split(np.arange(len(places)), len(places) // AT_ONCE + 1):
        best = np.full(len(some), np.inf)
        for near in candidates(tree, places[some]).T:
            found, far = closest(corners[near], places[some])
            better = far < best
            best = np.where(better, far, best)
            face[some] = np.where(better, near, face[some])
            shares[some] = np.where(better[:, None], found, shares[some])
    return Points(face, shares)


def textured(surface: Surface) -> bool:
    """True where a picture colours some of the surface's skin."""
    return any(piece.uv is not None and piece.material.picture is not None for piece in surface.skin)


def _skin_faces(surface: Surface) -> Ints:
    """(F, 3) faces of the skin, piece by piece, as vertices of the surface."""
    return np.concatenate([piece.source[piece.faces] for piece in surface.skin])


def _turned(faces: Ints) -> tuple[Ints, Ints]:
    """Faces from their lowest vertex on, and (F,) which corner that was."""
    first = np.argmin(faces, axis=1)
    return np.take_along_axis(faces, (first[:, None] + np.arange(3)) % 3, axis=1), first


def _by_piece(surface: Surface, points: Points) -> Iterator[tuple[Skin, Ints, Points]]:
    """Each piece with the rows of its points, and these, counted in the piece."""
    first = 0
    for piece in surface.skin:
        rows = np.flatnonzero((points.face >= first) & (points.face < first + len(piece.faces)))
        if len(rows):
            yield piece, rows, Points(points.face[rows] - first, points.shares[rows])
        first += len(piece.faces)


def _coordinates(piece: Skin, faces: Ints) -> Floats:
    """(n, 3, 2) texture coordinates of faces of a piece that has a picture."""
    uv = np.zeros((0, 2)) if piece.uv is None else piece.uv
    return np.asarray(uv[piece.faces[faces]])
