"""Lapped textures (Praun, Finkelstein and Hoppe 2000): patches along a field, pasted over each other to the last gap.

A face is repeated in every patch in which one of its corners has weight. A vertex has weight only in patches that hold
all faces around it, so the weights, interpolated over the faces, sum to 1 everywhere.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import reverse_cuthill_mckee

from furbake.surface.charts import Charts, Floats, Ints
from furbake.surface.lay.blobs import WAVES, covered, masks, paste
from furbake.surface.lay.ground import Ground, prepare
from furbake.surface.lay.patches import Patches, join, restrict
from furbake.surface.lay.seeds import centred, spread
from furbake.surface.lay.sheet import Sheet, flattened, frames, rotated
from furbake.surface.lay.unfold import PULL, align, differential, relax, sound, unfold
from furbake.surface.mesh import Surface
from furbake.surface.repair.topology import face_vectors, unit

RADIUS = 0.15
"""Radius of the largest patches, share of the model's largest side; the error of direction grows with it."""

MARGIN = 0.3
"""How far patches are grown beyond what is nearest to them, share of the radius."""

BALD = 0.2
"""A vertex that all masks together cover less than this needs another patch."""

FINER = 0.6
"""Radius of the patches that fill holes, over that of the round before."""

ROUNDS, FILLERS = 8, 4000
"""Most rounds of filling holes, and patches after which no further round begins (a surface of needles)."""

POLISH = 10
"""Rounds of the last relaxation, over what is seen of each patch."""

Progress = Callable[[float], None]


def lap(
    surface: Surface,
    direction: Floats,
    tile: float,
    seed: int = 0,
    progress: Progress | None = None,
    radius: float = RADIUS,
) -> Charts:
    """Charts of patches along a field, on every surface, whatever texture coordinates it has itself.

    direction : (V, 3) float, unit tangents: v grows along them
    tile : width of a tile, model units
    seed : of the outlines of the patches and of the piece of the tile that each shows
    progress : called with the fraction that is done
    radius : of the largest patches, share of the model's largest side
    """
    tell = progress or (lambda fraction: None)
    chance = np.random.default_rng(seed)
    ground = prepare(surface, direction, radius)
    tell(0.1)
    patches, mask = _cover(ground, chance, tell)
    weights = paste(ground, patches, mask)
    patches, weights, choice = _fill(ground, patches, weights)
    patches, weights = _polish(ground, patches, weights)
    tell(0.9)
    charts = _charts(surface, ground, patches, weights, choice, chance.uniform(size=(patches.count, 2)), tile)
    tell(1.0)
    return charts


def _cover(ground: Ground, chance: np.random.Generator, tell: Progress) -> tuple[Patches, Floats]:
    """Patches that cover all of the ground they can, and the mask of each node."""

    def waves(count: int) -> Floats:
        return chance.uniform(0.0, 2.0 * np.pi, (count, len(WAVES)))

    seeds, cell, far = centred(ground, spread(ground, np.ones(len(ground.fan), dtype=bool), 1.0))
    tell(0.3)
    radius = np.full(len(seeds), 1e-9)
    np.maximum.at(radius, cell, far)
    patches, phases = unfold(ground, seeds, (1.0 + MARGIN) * radius), waves(len(seeds))
    tell(0.6)
    hopeless, first = np.zeros(len(ground.fan), dtype=bool), patches.count
    for finer in FINER ** np.arange(1, ROUNDS + 1):
        mask = masks(ground, patches, radius, phases)
        bald = (covered(ground, patches, mask) < BALD) & ~hopeless
        seeds = spread(ground, bald, float(finer))
        if len(seeds) == 0 or patches.count - first > FILLERS:
            break
        more = unfold(ground, seeds, (1.0 + MARGIN) * finer * ground.radius[seeds])
        hopeless[seeds[np.bincount(more.face_patch, minlength=more.count) == 0]] = True
        patches, radius = join(patches, more), np.r_[radius, finer * ground.radius[seeds]]
        phases = np.concatenate([phases, waves(len(seeds))])
    return patches, masks(ground, patches, radius, phases)


def _fill(ground: Ground, patches: Patches, weights: Floats) -> tuple[Patches, Floats, Ints]:
    """Visible nodes of the patches with weights; vertices that no patch could take are shared out by faces.

    Each face around such a vertex chooses the patch that has most of its other corners, or becomes one of its own.
    Also (k, 3) int: the patch that a face has chosen for each such corner, −1 at all other corners.
    """
    faces = ground.sheet.faces
    lost = np.bincount(patches.vertex, weights, len(ground.fan)) <= 0.0
    torn = lost[faces].any(axis=1)
    alone = np.flatnonzero(torn & (np.bincount(patches.face, minlength=len(faces)) == 0))
    single = align(ground, _single(ground.sheet, alone), np.ones(3 * len(alone)))
    patches, weights = join(patches, single), np.r_[weights, np.zeros(len(single.uv))]

    merit = weights[patches.corners].sum(axis=1)
    best = np.lexsort((-merit, patches.face))
    _, first = np.unique(patches.face[best], return_index=True)
    row = best[first]
    chosen = np.full(len(faces), -1)
    chosen[patches.face[row]] = patches.face_patch[row]

    choice = np.where(lost[patches.vertex[patches.corners]], chosen[patches.face][:, None], -1)
    seen = (merit > 0.0) | (choice == patches.face_patch[:, None]).any(axis=1)
    nodes = np.unique(patches.corners[seen])
    return restrict(patches, seen), weights[nodes], choice[seen]


def _single(sheet: Sheet, faces: Ints) -> Patches:
    """Patches of one face each."""
    count = len(faces)
    return Patches(
        patch=np.repeat(np.arange(count), 3),
        vertex=sheet.faces[faces].reshape(-1),
        far=np.zeros(3 * count),
        uv=flattened(sheet.vertices[sheet.faces[faces]]).reshape(-1),
        face_patch=np.arange(count),
        face=faces,
        corners=np.arange(3 * count).reshape(-1, 3),
        count=count,
    )


def _polish(ground: Ground, patches: Patches, weights: Floats) -> tuple[Patches, Floats]:
    """Patches relaxed once more without their hidden parts, and turned along the field."""
    relaxed = relax(ground, patches, POLISH, PULL)
    broken = np.bincount(patches.face_patch, ~sound(ground, relaxed), patches.count) > 0
    patches = replace(patches, uv=np.where(broken[patches.patch], patches.uv, relaxed.uv))
    return align(ground, patches, weights + 1e-6), weights


def _charts(
    surface: Surface, ground: Ground, patches: Patches, weights: Floats, choice: Ints, start: Floats, tile: float
) -> Charts:
    """Charts of patches.

    weights : (n,) float of each node; choice : (k, 3) int as of `_fill`
    start : (count, 2) float 0..1, where in the tile the least u and v of each patch are
    """
    key = patches.corners * np.int64(patches.count + 1) + choice + 1
    copies, corners = np.unique(key, return_inverse=True)
    corners = corners.reshape(-1, 3)
    node, chosen = np.divmod(copies, np.int64(patches.count + 1))
    chosen = chosen - 1
    patch, vertex = patches.patch[node], patches.vertex[node]

    uv = np.stack([patches.uv.real, patches.uv.imag], axis=1) * (surface.extent / tile)
    least = np.full((patches.count, 2), np.inf)
    np.minimum.at(least, patches.patch, uv)
    source = ground.sheet.source[vertex]
    _, group = np.unique(np.stack([vertex, chosen], axis=1), axis=0, return_inverse=True)
    tangents = _tangents(ground, patches, corners, surface.normals[source])
    charts = Charts(
        source=source,
        faces=corners,
        tangents=np.column_stack([tangents, np.ones(len(node))]),
        uv=uv[node] - least[patch] + start[patch],
        weights=np.where(chosen < 0, weights[node], np.where(chosen == patch, 1.0, 0.0)),
        group=group.reshape(-1),
    )
    return _together(charts, patch)


def _together(charts: Charts, patch: Ints) -> Charts:
    """The charts with patches that overlap one after the other: stored copies of a vertex are near each other then.

    patch : (M,) of each copy
    """
    count = int(patch.max()) + 1
    holds = csr_array((np.ones(len(patch)), (patch, charts.source)), shape=(count, int(charts.source.max()) + 1))
    rank = np.empty(count, np.int64)
    rank[reverse_cuthill_mckee(holds @ holds.T, symmetric_mode=True)] = np.arange(count)
    order, turn = (np.argsort(rank[of], kind="stable") for of in (patch, patch[charts.faces[:, 0]]))
    place = np.empty_like(order)
    place[order] = np.arange(len(order))
    copies = {name: getattr(charts, name)[order] for name in ("source", "tangents", "uv", "weights", "group")}
    return Charts(faces=place[charts.faces[turn]], **copies)


def _tangents(ground: Ground, patches: Patches, corners: Ints, normals: Floats) -> Floats:
    """(M, 3) unit tangents along growing u: the mean over the faces of a copy, each turned into its tangent plane.

    corners : (k, 3) int, copies at the corners of the faces; normals : (M, 3) float, of the copies
    """
    sheet = ground.sheet
    places = sheet.vertices[sheet.faces[patches.face]]
    a, b = differential(ground, patches)
    along = np.conj(a) - b
    along = along / np.abs(along)
    flat = unit(face_vectors(sheet.vertices, sheet.faces)[patches.face])
    x = unit(places[:, 1] - places[:, 0])
    tangent = along.real[:, None] * x + along.imag[:, None] * np.cross(flat, x)

    total = np.zeros_like(normals)
    for corner in corners.T:
        np.add.at(total, corner, ground.area[patches.face][:, None] * rotated(tangent, flat, normals[corner]))
    total -= normals * np.einsum("ij,ij->i", total, normals)[:, None]
    heap = np.bincount(corners.reshape(-1), np.repeat(ground.area[patches.face], 3), len(normals))
    lost = np.linalg.norm(total, axis=1) <= 1e-6 * heap
    return np.where(lost[:, None], frames(normals)[0], unit(total))
