"""How much of the fur each patch carries where: round masks with soft rims, pasted over each other."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from furbake.surface.charts import Floats
from furbake.surface.lay.ground import Ground
from furbake.surface.lay.patches import Bools, Patches

RIM = 0.1
"""Width of the soft rim, share of the radius."""

WOBBLE = 0.08
"""How far the outline of a blob is from a circle, share of the radius."""

WAVES = ((2, 0.5), (3, 0.35), (5, 0.25))
"""Waves around the outline and their shares of WOBBLE."""

SHORE = 0.3
"""Distance from the open border of a patch within which its mask fades, share of the radius."""

SHARE = 0.2
"""A patch with less than this share of a vertex is cut there, and the rest is spread over the others."""

MIN_WEIGHT = 1.0 / 255.0
"""A weight that a byte can hold; less is none."""


def masks(ground: Ground, patches: Patches, radius: Floats, phases: Floats) -> Floats:
    """(n,) mask 0..1 of each node: 1 within the blob of its patch, 0 without and on the patch's open border.

    Blobs grow until they meet: where distance / radius (in uv) is the same in two patches, both masks are a half, and
    the rim lies evenly about that line. So they cover the surface and no more.

    radius : (count,) float, of the blobs; phases : (count, 3) float, radians, of the waves around their outlines
    """
    whole = inner(ground, patches)
    theta = np.angle(patches.uv)
    outline = 1.0 + WOBBLE * sum(
        share * np.cos(wave * theta + phase[patches.patch])
        for (wave, share), phase in zip(WAVES, phases.T, strict=True)
    )
    own = radius[patches.patch]
    deep = np.clip(_depth(patches, whole) / (SHORE * own), 0.0, 1.0)
    deep[whole & (patches.far <= 0.0)] = 1.0
    rho = np.abs(patches.uv) / (own * outline) + 3.0 * (1.0 - deep)

    order = np.lexsort((rho, patches.vertex))
    vertex, ranked = patches.vertex[order], rho[order]
    first = np.searchsorted(vertex, vertex)
    next_ = np.minimum(first + 1, len(vertex) - 1)
    second = np.where((vertex[next_] == vertex) & (next_ != first), ranked[next_], np.inf)
    rival = np.empty(len(rho))
    rival[order] = np.where(first == np.arange(len(vertex)), second, ranked[first])
    t = np.where(whole, np.minimum(np.clip(0.5 + (rival - rho) / (2.0 * RIM), 0.0, 1.0), deep), 0.0)
    return np.asarray(t * t * (3.0 - 2.0 * t))


def inner(ground: Ground, patches: Patches) -> Bools:
    """(n,) which nodes have all faces of their vertex in the patch."""
    return np.asarray(np.bincount(patches.corners.reshape(-1), minlength=len(patches.uv)) == ground.fan[patches.vertex])


def _depth(patches: Patches, whole: Bools) -> Floats:
    """(n,) distance in uv to the nearest node on the open border of the patch, infinite where there is none."""
    deep = np.where(whole, np.inf, 0.0)
    if whole.any() and not whole.all():
        # Patches are laid side by side, farther apart than any of them is wide.
        apart = 4.0 * (1.0 + np.abs(patches.uv).max())
        place = np.stack([patches.uv.real, patches.uv.imag, apart * patches.patch], axis=1)
        deep[whole], _ = cKDTree(place[~whole]).query(place[whole], distance_upper_bound=0.9 * apart)
    return deep


def covered(ground: Ground, patches: Patches, mask: Floats) -> Floats:
    """(S,) how much of each vertex all masks together cover, 0..1."""
    through = np.bincount(patches.vertex, np.log(np.maximum(1.0 - mask, 1e-12)), len(ground.fan))
    return np.asarray(1.0 - np.exp(through))


def paste(ground: Ground, patches: Patches, mask: Floats) -> Floats:
    """(n,) weights W = m · Π (1 − m of later patches), brought to the sum 1 at each vertex that a mask covers."""
    order = np.lexsort((-patches.patch, patches.vertex))
    vertex = patches.vertex[order]
    light = np.r_[0.0, np.cumsum(np.log(np.maximum(1.0 - mask[order], 1e-30)))[:-1]]
    weights = np.empty(len(mask))
    weights[order] = mask[order] * np.exp(light - light[np.searchsorted(vertex, vertex)])

    weights = _to_sum_1(ground, patches, weights)
    most = np.zeros(len(ground.fan))
    np.maximum.at(most, patches.vertex, weights)
    # Weights below SHARE fade out smoothly, the largest always stays.
    weights = np.maximum(weights - np.minimum(SHARE, 0.5 * most)[patches.vertex], 0.0)
    weights = _to_sum_1(ground, patches, weights)
    return _to_sum_1(ground, patches, np.where(weights > MIN_WEIGHT, weights, 0.0))


def _to_sum_1(ground: Ground, patches: Patches, weights: Floats) -> Floats:
    total = np.bincount(patches.vertex, weights, len(ground.fan))
    return np.asarray(weights / np.where(total > 0.0, total, 1.0)[patches.vertex])
