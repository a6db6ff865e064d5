"""Patches: pieces of a sheet with places in the plane, all in the same arrays; growing them and keeping them discs."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from furbake.surface.charts import Floats, Ints
from furbake.surface.lay.seeds import Walk
from furbake.surface.lay.sheet import Complex, Sheet

Bools = NDArray[np.bool_]

SHRINK = 0.8
"""Factor by which the radius of a patch that is no disc is made smaller."""

TRIES = 13
"""Radii that are tried before the fan of the seed alone."""


@dataclass(frozen=True)
class Patches:
    """Pieces of a sheet in the plane.

    patch, vertex : (n,) int, of each node; far : (n,) float, way from the seed
    uv : (n,) complex, shares of the model's largest side
    face_patch, face : (k,) int, of each face; corners : (k, 3) int, its nodes
    count : number of patches, those without faces included
    """

    patch: Ints
    vertex: Ints
    far: Floats
    uv: Complex
    face_patch: Ints
    face: Ints
    corners: Ints
    count: int


def build(sheet: Sheet, walk: Walk, place: Complex, reach: Floats) -> Patches:
    """Patches of all faces that have a corner within reach of their seed and three corners that the walk has come to.

    place : (n,) complex, of each step of the walk; reach : one per patch
    """
    size, faces = len(sheet.vertices), len(sheet.faces)
    around = coo_array(
        (np.ones(3 * faces, dtype=np.int8), (sheet.faces.reshape(-1), np.repeat(np.arange(faces), 3))),
        shape=(size, faces),
    ).tocsr()
    inner = walk.far <= reach[walk.patch]
    starts, ends = around.indptr[walk.vertex[inner]], around.indptr[walk.vertex[inner] + 1]
    sizes = (ends - starts).astype(np.int64)
    offset = np.arange(sizes.sum()) - np.repeat(np.cumsum(sizes) - sizes, sizes)
    face = around.indices[np.repeat(starts, sizes) + offset].astype(np.int64)
    patch, face = np.divmod(np.unique(np.repeat(walk.patch[inner], sizes) * faces + face), faces)

    key = walk.patch * size + walk.vertex
    order = np.argsort(key)
    wanted = patch[:, None] * size + sheet.faces[face]
    at = np.minimum(np.searchsorted(key[order], wanted), len(key) - 1)
    whole = (key[order[at]] == wanted).all(axis=1)
    step, corners = np.unique(order[at[whole]], return_inverse=True)
    return Patches(
        patch=walk.patch[step],
        vertex=walk.vertex[step],
        far=walk.far[step],
        uv=place[step],
        face_patch=patch[whole],
        face=face[whole],
        corners=corners.reshape(-1, 3),
        count=len(reach),
    )


def restrict(patches: Patches, keep: Bools) -> Patches:
    """The same patches with some of their faces.

    keep : (k,) which
    """
    nodes, corners = np.unique(patches.corners[keep], return_inverse=True)
    return replace(
        patches,
        patch=patches.patch[nodes],
        vertex=patches.vertex[nodes],
        far=patches.far[nodes],
        uv=patches.uv[nodes],
        face_patch=patches.face_patch[keep],
        face=patches.face[keep],
        corners=corners.reshape(-1, 3),
    )


def join(one: Patches, two: Patches) -> Patches:
    """Both, the second's patches numbered after the first's."""
    return Patches(
        patch=np.r_[one.patch, two.patch + one.count],
        vertex=np.r_[one.vertex, two.vertex],
        far=np.r_[one.far, two.far],
        uv=np.r_[one.uv, two.uv],
        face_patch=np.r_[one.face_patch, two.face_patch + one.count],
        face=np.r_[one.face, two.face],
        corners=np.concatenate([one.corners, two.corners + len(one.uv)]),
        count=one.count + two.count,
    )


def discs(sheet: Sheet, patches: Patches, keep: Bools) -> Patches:
    """Patches of the faces to keep, made smaller until each is one disc around its seed.

    keep : (k,) which faces may stay. The last that is tried is the fan of the seed; where that is no disc either, the
    patch is left empty.
    """
    level = patches.far[patches.corners].min(axis=1)
    radius = np.zeros(patches.count)
    np.maximum.at(radius, patches.face_patch, level)
    left = np.ones(patches.count, dtype=bool)
    stay = np.zeros(len(keep), dtype=bool)
    for attempt in range(TRIES + 1):
        tried = np.flatnonzero(keep & left[patches.face_patch] & (level <= radius[patches.face_patch]))
        chosen, good = _around_seeds(sheet, patches, tried, level)
        stay[chosen[(left & good)[patches.face_patch[chosen]]]] = True
        left &= ~good
        if not left.any():
            break
        radius = SHRINK * radius if attempt < TRIES - 1 else np.zeros(patches.count)
    return restrict(patches, stay)


def _around_seeds(sheet: Sheet, patches: Patches, tried: Ints, level: Floats) -> tuple[Ints, Bools]:
    """The tried faces that are joined to their seed over edges, and (count,) whether they are a disc.

    A connected surface with a border is a disc where vertices − edges + faces = 1.
    """
    owner = patches.face_patch[tried]
    sides = 3 * len(sheet.faces)
    key = owner[:, None] * sides + sheet.edges[patches.face[tried]]
    order = np.argsort(key, axis=None, kind="stable")
    ranked = key.reshape(-1)[order]
    twin = np.flatnonzero(ranked[1:] == ranked[:-1])
    a, b = order[twin] // 3, order[twin + 1] // 3
    links = coo_array((np.ones(len(a)), (a, b)), shape=(len(tried), len(tried)))
    _, part = connected_components(links, directed=False)

    nearest = np.lexsort((level[tried], owner))
    present, first = np.unique(owner[nearest], return_index=True)
    home = np.full(patches.count, -1)
    home[present] = part[nearest[first]]
    seeded = np.zeros(patches.count, dtype=bool)
    seeded[present] = level[tried[nearest[first]]] <= 0.0

    inside = part == home[owner]
    chosen = tried[inside]
    faces = np.bincount(owner[inside], minlength=patches.count)
    edges = np.bincount(np.unique(key[inside]) // sides, minlength=patches.count)
    nodes = np.bincount(patches.patch[np.unique(patches.corners[chosen])], minlength=patches.count)
    return chosen, np.asarray(seeded & (nodes - edges + faces == 1))
