"""Roots of hairs: every root of the tile in every face of a patch, thinned where patches overlap."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from furbake.groom.ground import Floats, Ground, Ints

CELLS = 32
"""Cells per side of a tile, of the grid in which roots are looked up."""

AT_ONCE = 2_000_000
"""Cells of faces that are looked through at a time."""


@dataclass(frozen=True)
class Roots:
    """Hairs on the body: which strand of the tile, in which face, at which place of the patch (n, 2), tiles."""

    hair: Ints
    face: Ints
    uv: Floats


def place_roots(ground: Ground, seeds: Floats, groups: Ints, seed: int) -> Roots:
    """The roots of a tile on the body.

    seeds : (S, 2) roots, tile widths; groups : (S,) kinds of hair, each of which is thinned by itself
    seed : of the choice where patches overlap

    A root inside a face is kept with a probability that is the copy's weight there: by systematic sampling (Madow
    1949) along the body, so that the number that is kept of each kind is the sum of the weights, rounded, of the whole
    body and, within one, of every run of faces.
    """
    found = _inside(ground, seeds - np.floor(seeds))
    shares = barycentric(ground, found.face, found.uv)
    weight = np.einsum("ij,ij->i", shares, ground.weight[ground.faces[found.face]])
    chance = np.random.default_rng(seed)
    order = np.lexsort((chance.random(len(weight)), _along(ground)[found.face], groups[found.hair]))
    kind = groups[found.hair][order]
    total = np.concatenate([[0.0], np.cumsum(np.where(weight > 1 - 1e-9, 1.0, weight)[order])])
    starts = np.searchsorted(kind, np.unique(kind))
    offset = np.zeros(len(order))
    for start, jitter in zip(starts, chance.random(len(starts)), strict=True):
        offset[start:] = jitter - total[start]
    ends = np.floor(total[1:] + offset + 1e-9) > np.floor(total[:-1] + offset + 1e-9)
    kept = np.sort(order[ends])
    return Roots(found.hair[kept], found.face[kept], found.uv[kept])


def barycentric(ground: Ground, face: Ints, uv: Floats) -> Floats:
    """(n, 3) of places (n, 2), tiles, in faces (n,); they sum to 1, and are below 0 outside."""
    a, b, c = np.moveaxis(ground.uv[ground.faces[face]], 1, 0)
    one, two, at = b - a, c - a, uv - a
    area = one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]
    area = np.where(np.abs(area) < 1e-14, 1e-14, area)
    second = (at[:, 0] * two[:, 1] - at[:, 1] * two[:, 0]) / area
    third = (one[:, 0] * at[:, 1] - one[:, 1] * at[:, 0]) / area
    return np.stack([1 - second - third, second, third], axis=1)


def _inside(ground: Ground, seeds: Floats) -> Roots:
    """All roots in all faces, those of every tile that a face shows. One on an edge belongs to one of its faces."""
    cell = np.floor(seeds * CELLS).astype(np.int64) % CELLS
    key = cell[:, 0] * CELLS + cell[:, 1]
    sorted_ = np.argsort(key, kind="stable")
    begin = np.searchsorted(key[sorted_], np.arange(CELLS * CELLS))
    count = np.bincount(key, minlength=CELLS * CELLS)

    corners = ground.uv[ground.faces]
    low = np.floor(corners.min(axis=1) * CELLS).astype(np.int64)
    wide = np.floor(corners.max(axis=1) * CELLS).astype(np.int64) - low + 1
    cells = wide.prod(axis=1)
    parts = np.searchsorted(np.cumsum(cells), np.arange(AT_ONCE, cells.sum() + AT_ONCE, AT_ONCE)) + 1
    found: list[Roots] = []
    for faces in np.split(np.arange(len(cells)), np.unique(parts[parts < len(cells)])):
        face, number = _repeat(faces, cells[faces])
        i, j = np.divmod(number, wide[face, 1])
        at = np.stack([low[face, 0] + i, low[face, 1] + j], axis=1)
        box, tile = at % CELLS, at // CELLS
        here = box[:, 0] * CELLS + box[:, 1]
        row, nth = _repeat(np.arange(len(face)), count[here])
        hair = sorted_[begin[here[row]] + nth]
        uv = seeds[hair] + tile[row]
        hit = _covers(ground, face[row], uv)
        found.append(Roots(hair[hit], face[row][hit], uv[hit]))
    return Roots(*(np.concatenate([getattr(part, name) for part in found]) for name in ("hair", "face", "uv")))


def _covers(ground: Ground, face: Ints, uv: Floats) -> np.ndarray[tuple[int, ...], np.dtype[np.bool_]]:
    """(n,) whether a place is inside a face. Both faces of an edge compute with the same ends: one of them has it."""
    inside = np.ones(len(face), bool)
    corners = ground.faces[face]
    for i in range(3):
        start, end = corners[:, i], corners[:, (i + 1) % 3]
        low, high = np.minimum(start, end), np.maximum(start, end)
        a, way = ground.uv[low], ground.uv[high] - ground.uv[low]
        left = way[:, 0] * (uv[:, 1] - a[:, 1]) - way[:, 1] * (uv[:, 0] - a[:, 0]) >= 0
        inside &= left == (start == low)
    return inside


def _repeat(items: Ints, times: Ints) -> tuple[Ints, Ints]:
    """Each item as many times as it says, and the number of each repeat."""
    ends = np.cumsum(times)
    return np.repeat(items, times), np.arange(ends[-1] if len(ends) else 0) - np.repeat(ends - times, times)


def _along(ground: Ground) -> Ints:
    """(F,) rank of each face on a curve through the body (Morton's), equal in all copies of a face."""
    middle = ground.vertices[ground.faces].mean(axis=1)
    low, extent = middle.min(axis=0), max(float(np.ptp(middle, axis=0).max()), 1e-12)
    cell = np.minimum((1024 * (middle - low) / extent).astype(np.int64), 1023)
    code = np.zeros(len(cell), np.int64)
    for bit in range(10):
        for axis in range(3):
            code |= ((cell[:, axis] >> bit) & 1) << (3 * bit + axis)
    order = np.lexsort((ground.surface, code))
    rank = np.empty(len(order), np.int64)
    rank[order] = np.arange(len(order))
    least = np.full(int(ground.surface.max()) + 1, len(order))
    np.minimum.at(least, ground.surface, rank)
    return np.asarray(least[ground.surface])
