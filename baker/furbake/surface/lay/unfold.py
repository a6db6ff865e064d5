"""Patches laid into the plane: discrete exponential map, then as rigid as possible, for all patches at once.

Exponential map: Schmidt, Grimm and Wyvill, Interactive decal compositing with discrete exponential maps, 2006.
As rigid as possible: Liu, Zhang, Xu, Gotsman and Gortler, A local/global approach to mesh parameterization, 2008.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.linalg import splu

from furbake.surface.charts import Floats, Ints
from furbake.surface.lay.ground import Ground
from furbake.surface.lay.patches import Bools, Patches, build, discs
from furbake.surface.lay.seeds import Walk, walks
from furbake.surface.lay.sheet import Complex, cotangents, flattened, transport

FREE, PULLED = 4, 8
"""Rounds of the local and the global step: rigid alone, and drawn to the field."""

PULL = 0.18
"""Share of the field in the rotation of a face: trades stretch for direction."""

MAX_STRETCH = 3.0
"""Stretch, and its inverse, up to which a face may stay in a patch."""

PIN = 1e-9
"""Weight that holds every node where it is, so that the system has one solution."""


def unfold(ground: Ground, seeds: Ints, reach: Floats) -> Patches:
    """Patches around seeds, as far as `reach` (one per seed), the field along +v.

    They are discs without mirrored or overstretched faces, smaller than asked for where that is needed.
    """
    sheet = ground.sheet
    walk = walks(ground, seeds, reach)
    patches = build(sheet, walk, _exponential(ground, walk), reach)
    patches = discs(sheet, patches, np.ones(len(patches.face), dtype=bool))
    for _ in range(2):
        patches = align(ground, relax(ground, patches, FREE, 0.0), 1.0 / (0.01 + patches.far))
        patches = relax(ground, patches, PULLED, PULL)
        patches = discs(sheet, patches, sound(ground, patches))
    return patches


def _exponential(ground: Ground, walk: Walk) -> Complex:
    """(n,) place of every step of the walk, in the frame of its seed.

    Each step is an affine map from the frame of a vertex into that of the one before; they are chained by pointer
    doubling, so that there are as many rounds as the logarithm of the longest way.
    """
    normals, e1, e2 = ground.sheet.normals, ground.e1, ground.e2
    i, j = walk.before, walk.vertex
    back = np.conj(transport(normals, e1, e2, i, j))
    way = ground.sheet.vertices[j] - ground.sheet.vertices[i]
    there, here = (np.einsum("ij,ij->i", way, e1[k]) + 1j * np.einsum("ij,ij->i", way, e2[k]) for k in (i, j))
    both = _sign(there) + back * _sign(here)
    both = np.where(np.abs(both) > 0.1, both, there)
    step = np.linalg.norm(way, axis=1) * _sign(both)

    size = len(normals)
    key = walk.patch * size + walk.vertex
    order = np.argsort(key)
    parent = order[np.searchsorted(key[order], walk.patch * size + walk.before)]
    turn, place = np.where(i == j, 1.0, back), np.where(i == j, 0.0, step)
    while (parent != parent[parent]).any():
        turn, place, parent = turn[parent] * turn, turn[parent] * place + place[parent], parent[parent]
    return np.asarray(place)


def relax(ground: Ground, patches: Patches, rounds: int, pull: float) -> Patches:
    """Patches as rigid as possible, from where they are, the rotation of each face drawn to the field by `pull`."""
    count = len(patches.uv)
    if count == 0:
        return patches
    flat = flattened(ground.sheet.vertices[ground.sheet.faces[patches.face]])
    weights = cotangents(flat)
    edges = np.roll(flat, -1, axis=1) - flat
    i, j = patches.corners.reshape(-1), np.roll(patches.corners, -1, axis=1).reshape(-1)
    w, index = weights.reshape(-1), np.arange(count)
    system = coo_array(
        (np.r_[w, w, -w, -w, np.full(count, PIN)], (np.r_[i, j, i, j, index], np.r_[i, j, j, i, index])),
        shape=(count, count),
    ).tocsc()
    solve = splu(system, permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True}).solve
    along_field = 1j * np.conj(ground.heading[patches.face])
    uv = patches.uv
    for _ in range(rounds):
        fit = (weights * np.conj(edges) * (uv[j] - uv[i]).reshape(-1, 3)).sum(axis=1)
        spin = _sign((1.0 - pull) * _sign(fit) + pull * along_field)
        force = (weights * spin[:, None] * edges).reshape(-1)
        right = [
            np.bincount(j, part, count) - np.bincount(i, part, count) + PIN * held
            for part, held in ((force.real, uv.real), (force.imag, uv.imag))
        ]
        both = solve(np.stack(right, axis=1))
        uv = both[:, 0] + 1j * both[:, 1]
    return replace(patches, uv=uv)


def align(ground: Ground, patches: Patches, weights: Floats) -> Patches:
    """Patches turned about their seeds so that the mean field is along +v.

    weights : (n,) float, of each node in the mean
    """
    a, b = differential(ground, patches)
    heading = ground.heading[patches.face]
    field = a * heading + b * np.conj(heading)
    field = field * ground.area[patches.face] * weights[patches.corners].sum(axis=1)
    owner = patches.face_patch
    mean = np.bincount(owner, field.real, patches.count) + 1j * np.bincount(owner, field.imag, patches.count)
    spin = _sign(1j * np.conj(mean))
    return replace(patches, uv=patches.uv * spin[patches.patch])


def differential(ground: Ground, patches: Patches) -> tuple[Complex, Complex]:
    """(k,) a and b of uv = a·z + b·conj(z) + constant over each face, z in the plane of the `flattened` face.

    |a| + |b| and |a| − |b| are its singular values, the latter negative where the face is mirrored.
    """
    flat, uv = flattened(ground.sheet.vertices[ground.sheet.faces[patches.face]]), patches.uv[patches.corners]
    p, q = flat[:, 1] - flat[:, 0], flat[:, 2] - flat[:, 0]
    s, t = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
    twice = p * np.conj(q) - np.conj(p) * q
    twice = np.where(np.abs(twice) > 1e-300, twice, 1e-300)
    return (s * np.conj(q) - t * np.conj(p)) / twice, (t * p - s * q) / twice


def sound(ground: Ground, patches: Patches) -> Bools:
    """(k,) which faces are neither mirrored nor stretched beyond MAX_STRETCH."""
    a, b = (np.abs(x) for x in differential(ground, patches))
    return np.asarray((a - b > 1.0 / MAX_STRETCH) & (a + b < MAX_STRETCH))


def _sign(z: Complex) -> Complex:
    """Numbers brought to length 1; 0 becomes 1."""
    size = np.abs(z)
    return np.where(size > 1e-200, z / np.where(size > 1e-200, size, 1.0), 1.0)
