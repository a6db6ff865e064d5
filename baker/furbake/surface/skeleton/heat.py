"""Weights of a skeleton's joints by heat: bones warm the skin near them, and warmth spreads along the skin.

Baran and Popović, Automatic rigging and animation of 3D characters, 2007, section 4: of each joint the weights w are
the balance −Δw + H·w = H·p, where p is the joint's share of the bones that warm a vertex and H = 1 / distance². As
warmth spreads along the skin alone, and bones warm only what they see from inside, nothing is grabbed across a gap.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_array, csc_array, diags_array
from scipy.sparse.csgraph import connected_components
from scipy.sparse.linalg import splu

from furbake.surface.lay.sheet import cotangents, flattened
from furbake.surface.mesh import Surface
from furbake.surface.repair.seams import unique_rows
from furbake.surface.repair.topology import face_vectors
from furbake.surface.rig.rig import Floats, Ints
from furbake.surface.rig.weights import KEPT
from furbake.surface.skeleton.bones import nearest, warmed
from furbake.surface.skeleton.skeleton import Skeleton

CLOSEST = 1e-3
"""Distance of a bone from the skin below which it warms no more, share of the largest side."""


def heat_weights(surface: Surface, skeleton: Skeleton) -> Floats:
    """(V, J) shares of the joints, at most `KEPT` of them at a vertex, which sum to 1; joints without skin have none.

    Copies of a vertex in one place have equal ones. A piece of the surface that sees no bone follows the nearest ones.
    """
    first, place = unique_rows(*surface.vertices.T)
    stiffness, area = _laplacian(surface, place, len(first))
    shares, far = (values[first] for values in warmed(surface, skeleton))
    piece = connected_components(stiffness, directed=False)[1]
    cold = np.bincount(piece, shares.sum(axis=1)) <= 0.0
    if cold.any():
        others = nearest(surface, skeleton)
        blind = cold[piece]
        shares[blind], far[blind] = others[0][first][blind], others[1][first][blind]
    heat = area * shares.sum(axis=1) / np.maximum(far, CLOSEST * surface.extent) ** 2
    warm = splu(csc_array(stiffness + diags_array(heat))).solve(heat[:, None] * shares)
    return _few(np.maximum(warm, 0.0))[place]


def _few(warm: Floats) -> Floats:
    """The same shares without all but the `KEPT` largest, summing to 1.

    The next largest is taken off those that stay: a joint fades in from 0 where it overtakes another, and none jumps.
    """
    if warm.shape[1] > KEPT:
        next_one = np.partition(warm, -KEPT - 1, axis=1)[:, -KEPT - 1, None]
        less = np.maximum(warm - next_one, 0.0)
        warm = np.where(less.sum(axis=1, keepdims=True) > 0.0, less, warm)
    return np.asarray(warm / warm.sum(axis=1, keepdims=True))


def _laplacian(surface: Surface, place: Ints, count: int) -> tuple[csc_array, Floats]:
    """Stiffness (count, count), each row of which sums to 0, and (count,) area of each place."""
    faces = place[surface.faces]
    weights = 0.5 * cotangents(flattened(surface.vertices[surface.faces])).reshape(-1)
    one, two = faces.reshape(-1), np.roll(faces, -1, axis=1).reshape(-1)
    rows, columns = np.concatenate([one, two, one, two]), np.concatenate([two, one, one, two])
    values = np.concatenate([-weights, -weights, weights, weights])
    stiffness = csc_array(coo_array((values, (rows, columns)), shape=(count, count)))
    thirds = np.linalg.norm(face_vectors(surface.vertices, surface.faces), axis=1) / 6.0
    return stiffness, np.asarray(np.bincount(faces.reshape(-1), np.repeat(thirds, 3), count), dtype=np.float64)
