"""Fur in hollows: hairs lean out of them where straight ones would cross and shells fold over themselves."""

from __future__ import annotations

import numpy as np

from furbake.surface.mesh import Floats, Surface
from furbake.surface.place.vertex_fur import tangential
from furbake.surface.repair.topology import smoother, unit

CLOSEST = 0.15
"""Distance between tips over that between roots, in the direction in which they come closest: below it hairs lean."""

ROUNDS = 30
"""At most; the hairs that move are chosen anew in each."""

SWEEPS = 4
"""Smoothings in a round; each passes a lean on to the neighbours."""


def out_of_hollows(surface: Surface, lengths: Floats, comb: Floats) -> Floats:
    """(V, 3) comb as of `VertexFur`, with leans out of the hollows whose radius is less than the fur's length.

    lengths : (V,) of the hairs, model units

    Hairs where tips come closer than `CLOSEST` take the mean direction of their neighbours, round by round. The rest
    keep theirs. A hollow that asks for more than the longest comb stays folded.
    """
    comb = tangential(comb, surface.normals)
    faces, corners = surface.faces, surface.vertices[surface.faces]
    average = smoother(len(lengths), surface.faces)
    for _ in range(ROUNDS):
        hairs = _directions(comb, surface.normals)
        folded = _closeness(corners, lengths[faces, None], hairs[faces]) < CLOSEST
        if not folded.any():
            break
        near = np.zeros(len(lengths))
        near[faces[folded]] = 1.0
        moved = average @ near > 0.0
        for _ in range(SWEEPS):
            hairs[moved] = unit(average[moved] @ hairs)
        comb[moved] = tangential(hairs[moved], surface.normals[moved])
    return comb


def _closeness(corners: Floats, lengths: Floats, hairs: Floats) -> Floats:
    """(F,) least distance between tips over that between roots, seen along the mean hair; below 0: they cross.

    corners, hairs : (F, 3, 3) roots, and unit vectors to the tips; lengths : (F, 3, 1)

    1 for faces that are turned away from their hairs.
    """
    flat = _across(hairs.sum(axis=1), corners[:, 1] - corners[:, 0])
    roots, tips = (flat @ (at[:, 1:] - at[:, :1]).transpose(0, 2, 1) for at in (corners, corners + lengths * hairs))
    seen = np.linalg.det(roots) > 0.0
    stretch = tips[seen] @ np.linalg.inv(roots[seen])
    half = 0.5 * (stretch[:, 0, 0] - stretch[:, 1, 1])
    shear = 0.5 * (stretch[:, 0, 1] + stretch[:, 1, 0])
    least = np.ones(len(corners))
    least[seen] = 0.5 * (stretch[:, 0, 0] + stretch[:, 1, 1]) - np.hypot(half, shear)
    return least


def _directions(comb: Floats, normals: Floats) -> Floats:
    """(V, 3) unit vectors from roots to tips."""
    rise = np.sqrt(np.maximum(1.0 - np.einsum("ij,ij->i", comb, comb), 0.0))
    return np.asarray(rise[:, None] * normals + comb)


def _across(axes: Floats, along: Floats) -> Floats:
    """(F, 2, 3) two unit vectors at right angles to each axis and to each other, the first as `along` as can be."""
    third = unit(axes)
    one = unit(along - third * np.einsum("ij,ij->i", along, third)[:, None])
    return np.stack([one, np.cross(third, one)], axis=1)
