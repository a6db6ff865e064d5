"""Variation from place to place: smooth noise over a body, and its pale underside."""

from __future__ import annotations

import numpy as np

from furbake.surface.mesh import Floats, Surface

WAVES = 24
"""Plane waves that add up to the noise."""

SPOTS = 2.0
"""Changes of the noise along the model's largest side."""


def noise(surface: Surface, seed: int) -> Floats:
    """(V,) float 0..1, smooth over the surface, evenly spread (as much of it below any value as the value says)."""
    chance = np.random.default_rng(seed)
    ways = chance.normal(size=(WAVES, 3))
    ways *= SPOTS * chance.uniform(0.5, 1.5, (WAVES, 1)) / np.linalg.norm(ways, axis=1, keepdims=True)
    place = (surface.vertices - surface.vertices.min(axis=0)) / surface.extent
    waves = np.cos(2 * np.pi * place @ ways.T + chance.uniform(0, 2 * np.pi, WAVES)).sum(axis=1)
    rank = np.argsort(np.argsort(waves, kind="stable"), kind="stable")
    return np.asarray((rank + 0.5) / len(rank))


def underside(surface: Surface) -> Floats:
    """(V,) float 0..1: 1 where the body looks down (belly, chin), 0 from its flanks up, soft between."""
    down = np.clip((-surface.normals[:, 1] + 0.1) / 0.8, 0.0, 1.0)
    return np.asarray(down * down * (3 - 2 * down))
