"""Openness of each place of a body to its surroundings: between legs and behind ears fur is darker."""

from __future__ import annotations

import numpy as np

from furbake.surface.lay.sheet import frames
from furbake.surface.mesh import Floats, Surface
from furbake.surface.place.thickness import distances
from furbake.surface.repair.topology import smoother

RAYS = 64
"""Outward per vertex, evenly spread over what arrives at a plane: as many from each equal share of the light."""

REACH = 0.6
"""Distance beyond which a body no longer hides anything, share of its largest side."""

ROUNDS = 2
"""Rounds of smoothing over the mesh."""


def openness(surface: Surface) -> Floats:
    """(V,) float 0..1, cosine-weighted share of the hemisphere above each vertex that the body leaves open."""
    normals = surface.normals
    one, two = frames(normals)
    i = np.arange(RAYS) + 0.5
    across, angle = np.sqrt(i / RAYS), np.pi * (3 - np.sqrt(5)) * i
    local = np.stack([across * np.cos(angle), across * np.sin(angle), np.sqrt(1 - i / RAYS)], axis=1)
    ways = np.einsum("ra,avx->vrx", local, np.stack([one, two, normals]))
    start = np.broadcast_to((surface.vertices + 1e-3 * surface.extent * normals)[:, None], ways.shape)
    far = distances(surface, start.reshape(-1, 3), ways.reshape(-1, 3)).reshape(-1, RAYS)
    seen = np.clip(far / (REACH * surface.extent), 0.0, 1.0).mean(axis=1)
    average = smoother(len(surface.vertices), surface.faces)
    for _ in range(ROUNDS):
        seen = average @ seen
    return np.asarray(np.clip(seen, 0.0, 1.0))
