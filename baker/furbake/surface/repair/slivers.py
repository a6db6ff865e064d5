"""Mend slivers: collapse needles at their short edge, flip caps into the face beyond their long edge.

Simply dropped, a cap would leave a slit in the surface, and every step after that would take it for a border.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from furbake.surface.repair.topology import face_vectors, half_edges, unit
from furbake.surface.soup import Flags, Floats, Ints, Soup

THIN = 1e-4
"""Height over longest side below which a face is a sliver."""

NEEDLE = 4.0 * THIN
"""Shortest over longest side below which a sliver is a needle, not a cap."""

BENT = 0.5
"""Cosine between a face and those it is flipped into, at least."""

ROUNDS = 12
"""A round mends slivers that are not neighbours; the next one takes what is left."""


def mend(soup: Soup) -> tuple[Soup, int]:
    """The soup with fewer slivers, and how many were mended. What cannot be mended stays.

    Faces must have three different corners; the result may have flat and repeated ones.
    """
    mended = 0
    for _ in range(ROUNDS):
        sides, thin = _measure(soup.vertices, soup.faces)
        if not (thin < THIN).any():
            break
        needle = (thin < THIN) & (sides.min(axis=1) < NEEDLE * sides.max(axis=1))
        soup, gone = _collapse(soup, sides, needle)
        soup, flipped = _flip(soup)
        mended += gone + flipped
        if not gone + flipped:
            break
    return soup, mended


def _measure(vertices: Floats, faces: Ints) -> tuple[Floats, Floats]:
    """(F, 3) lengths of the sides after each corner, and (F,) height over longest side."""
    corners = vertices[faces]
    sides = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
    longest = np.maximum(sides.max(axis=1), 1e-300)
    return sides, np.linalg.norm(face_vectors(vertices, faces) / longest[:, None], axis=1) / longest


def first_claim(things: NDArray[np.int64], count: int) -> Flags:
    """(n,) which rows of (n, m) things come before every other row that wants one of the same things."""
    rank = np.arange(len(things))
    owner = np.full(count, len(things))
    np.minimum.at(owner, things, rank[:, None])
    return np.asarray((owner[things] == rank[:, None]).all(axis=1))


def _collapse(soup: Soup, sides: Floats, needle: Flags) -> tuple[Soup, int]:
    """Needles shut: the two ends of their shortest side become one vertex. Faces that this flattens go."""
    which = np.flatnonzero(needle)
    if not len(which):
        return soup, 0
    which = which[np.argsort(sides[which].min(axis=1), kind="stable")]
    corner = np.argmin(sides[which], axis=1)
    ends = np.stack([soup.faces[which, corner], soup.faces[which, (corner + 1) % 3]], axis=1)
    ends = ends[first_claim(ends, len(soup.vertices))]
    into = np.arange(len(soup.vertices))
    into[ends.max(axis=1)] = ends.min(axis=1)
    faces = into[soup.faces]
    whole = (faces != np.roll(faces, 1, axis=1)).all(axis=1)
    return replace(soup, faces=faces).take(whole), int((~whole & needle).sum())


def _flip(soup: Soup) -> tuple[Soup, int]:
    """Caps gone: a cap's apex splits the face beyond its longest side, and the two halves take both places."""
    vertices, faces = soup.vertices, soup.faces
    sides, thin = _measure(vertices, faces)
    order, where, uses = half_edges(faces)
    beyond = np.full(faces.size, -1)
    pair = where[uses == 2]
    beyond[order[pair]], beyond[order[pair + 1]] = order[pair + 1], order[pair]

    cap = np.flatnonzero(thin < THIN)
    cap = cap[np.argsort(thin[cap], kind="stable")]
    side = 3 * cap + np.argmax(sides[cap], axis=1)
    cap, side, across = (values[beyond[side] >= 0] for values in (cap, side, beyond[side]))
    apex = faces.reshape(-1)[3 * cap + (side + 2) % 3]
    other, j = across // 3, across % 3
    p, q, d = (faces[other, (j + i) % 3] for i in range(3))
    halves = np.stack([np.stack([p, apex, d], axis=1), np.stack([apex, q, d], axis=1)], axis=1)

    flat = halves.reshape(-1, 3)
    _, better = _measure(vertices, flat)
    facing = np.einsum(
        "kij,kj->ki",
        unit(face_vectors(vertices, flat)).reshape(-1, 2, 3),
        unit(face_vectors(vertices, faces[other])),
    )
    present = np.minimum(faces, np.roll(faces, -1, axis=1)) * np.int64(len(vertices)) + np.maximum(
        faces, np.roll(faces, -1, axis=1)
    )
    crossing = np.minimum(apex, d) * np.int64(len(vertices)) + np.maximum(apex, d)
    fine = (
        (better.reshape(-1, 2).min(axis=1) > np.maximum(2.0 * thin[cap], 1e-12))
        & (facing.min(axis=1) > BENT)
        & (apex != d)
        & ~np.isin(crossing, present)
    )
    cap, other, j, apex, halves = (values[fine] for values in (cap, other, j, apex, halves))
    free = first_claim(np.stack([cap, other], axis=1), len(faces))
    cap, other, j, apex, halves = (values[free] for values in (cap, other, j, apex, halves))
    return _replaced(soup, cap, other, j, apex, halves), len(cap)


def _replaced(soup: Soup, cap: Ints, other: Ints, j: Ints, apex: Ints, halves: Ints) -> Soup:
    """Halves in the places of caps and of the faces beyond them, whose corner data they take along side j."""
    p, q = (soup.vertices[soup.faces[other, (j + i) % 3]] for i in range(2))
    along = q - p
    length = np.maximum(np.einsum("ij,ij->i", along, along), 1e-300)
    t = np.clip(np.einsum("ij,ij->i", soup.vertices[apex] - p, along) / length, 0.0, 1.0)[:, None]

    def split(values: Floats) -> Floats:
        one, two, far = (values[other, (j + i) % 3] for i in range(3))
        between = (1.0 - t) * one + t * two
        result = values.copy()
        result[cap] = np.stack([one, between, far], axis=1)
        result[other] = np.stack([between, two, far], axis=1)
        return result

    faces, part = soup.faces.copy(), soup.part.copy()
    faces[cap], faces[other] = halves[:, 0], halves[:, 1]
    part[cap] = part[other]
    return replace(
        soup,
        faces=faces,
        part=part,
        uv=None if soup.uv is None else split(soup.uv),
        paint=None if soup.paint is None else split(soup.paint),
        attributes={name: split(values) for name, values in soup.attributes.items()},
    )
