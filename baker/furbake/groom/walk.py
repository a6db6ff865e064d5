"""From a place in a patch to another: across the edges of its faces, for many places at once."""

from __future__ import annotations

import numpy as np

from furbake.groom.ground import Floats, Ground, Ints
from furbake.groom.roots import barycentric

MAX_STEPS = 200
"""Faces that a step of a hair may cross."""


def walk(ground: Ground, face: Ints, uv: Floats) -> tuple[Ints, Floats]:
    """The faces (n,) that hold the places uv (n, 2), walked to from the faces (n,), and uv as it is there.

    Each step crosses the edge beyond which the place lies farthest. Where all those are ends of the patch the walk
    ends too: the place is then beyond the edge, in the plane of the last face.
    """
    face, uv = face.copy(), uv.copy()
    going = np.arange(len(face))
    for step in range(MAX_STEPS):
        shares = barycentric(ground, face[going], uv[going])
        across = np.where((shares < -1e-9) & (ground.beside[face[going]] >= 0), shares, np.inf)
        edge = np.argmin(across, axis=1)
        # Between needles the farthest edge may lead round in a circle: take the nearest now and then.
        if step % 16 == 15:
            edge = np.argmax(np.where(np.isfinite(across), across, -np.inf), axis=1)
        leaves = np.isfinite(across[np.arange(len(going)), edge])
        going, edge = going[leaves], edge[leaves]
        if len(going) == 0:
            break
        uv[going] += ground.shift[face[going], edge]
        face[going] = ground.beside[face[going], edge]
    return face, uv
