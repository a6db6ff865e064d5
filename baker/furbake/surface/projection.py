"""Texture coordinates for any surface by projection onto the six sides of a box, blended where two sides meet.

Each side is one patch. Patches overlap softly: a vertex has a weight in each, by how far its smoothed normal turns to
that side, and the weights sum to 1. A face is repeated in every patch in which one of its corners has weight.
"""

from __future__ import annotations

from typing import Literal

import numpy as np

from furbake.surface.charts import Charts, Floats, Ints
from furbake.surface.mesh import Surface
from furbake.surface.topology import face_vectors, smoother, unit

Guide = Literal["nose-tail", "down"]

AXES: Floats = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], dtype=np.float64)

STEEPEST = 0.15
"""Cosine between a face and the side it is projected on: below it the face is never projected there."""

FULL = 0.35
"""Cosine above which steepness no longer takes weight away."""

SHARPNESS = 4.0
"""Exponent of the weight: larger makes narrower overlaps."""

SHARE = 0.12
"""A side with less than this share of a vertex is cut there, and the rest is spread over the others."""

LEAST = 1.0 / 255.0
"""A weight that a byte can hold; less is none."""

SINK = 0.35
"""How far hair on the flanks turns down while it runs from the nose to the tail."""

SMOOTHING = 3
"""Rounds of smoothing of the normals that decide the weights."""


def project(surface: Surface, tile: float, guide: Guide = "nose-tail") -> Charts:
    """Charts with tiles `tile` model units wide: the surface's natural ones if it has them, else the six sides.

    Hair leans along growing v. `nose-tail` lays v from the nose to the tail, on the flanks a little down, on the
    front and the back straight down; `down` lays it down, on the upper and lower side from the nose to the tail.
    """
    if surface.natural is not None:
        return surface.natural.charts(tile)
    normals = unit(face_vectors(surface.vertices, surface.faces))
    corner_group, group_source, weights = _weights(surface, normals)

    patches: list[tuple[Ints, Ints]] = []
    for i in range(6):
        faces = np.flatnonzero((weights[corner_group, i] > LEAST).any(axis=1))
        groups, index = np.unique(corner_group[faces], return_inverse=True)
        patches.append((groups, index.reshape(-1, 3)))
    starts = np.cumsum([0] + [len(groups) for groups, _ in patches])

    group = np.concatenate([groups for groups, _ in patches])
    side = np.repeat(np.arange(6), np.diff(starts))
    source = group_source[group]
    along_u, along_v = frames(surface, guide)
    # The golden ratio keeps the same hairs from facing each other across a border.
    offset = np.modf(np.arange(6)[:, None] * np.array([0.7548776662466927, 0.5698402909980532]))[0]
    place = surface.vertices[source]
    u = np.einsum("ij,ij->i", place, along_u[side]) / tile + offset[side, 0]
    v = np.einsum("ij,ij->i", place, along_v[side]) / tile + offset[side, 1]
    return Charts(
        source=source,
        faces=np.concatenate([index + start for (_, index), start in zip(patches, starts, strict=False)]),
        tangents=_tangents(surface.normals[source], along_u[side], along_v[side]),
        uv=np.stack([u, v], axis=1),
        weights=weights[group, side],
        group=group,
    )


def frames(surface: Surface, guide: Guide) -> tuple[Floats, Floats]:
    """(6, 3) unit u axes and (6, 3) unit v axes of the sides in the order of `AXES`; u × v points outward."""
    tail, down = -nose(surface), np.array([0.0, -1.0, 0.0])
    laid = tail + SINK * down if guide == "nose-tail" else down
    wish = np.tile(laid, (6, 1))
    wish[2:4] = tail
    wish[np.abs(AXES @ tail) > 0.5] = down
    along_v = unit(wish - AXES * np.einsum("ij,ij->i", wish, AXES)[:, None])
    return np.cross(along_v, AXES), along_v


def nose(surface: Surface) -> Floats:
    """(3,) axis from the tail to the nose: along the longer horizontal side of the model.

    Along z the nose is at +z, as glTF has it; along x it is at the end whose outer third stands higher (a head is
    carried above a tail), +x where both are level.
    """
    x, _, z = np.ptp(surface.vertices, axis=0)
    if x <= 1.05 * z:
        return np.array([0.0, 0.0, 1.0])
    middle = surface.vertices[surface.faces].mean(axis=1)
    area = np.linalg.norm(face_vectors(surface.vertices, surface.faces), axis=1)
    low, high = surface.vertices[:, 0].min(), surface.vertices[:, 0].max()
    ends = [area * (middle[:, 0] < low + (high - low) / 3.0), area * (middle[:, 0] > high - (high - low) / 3.0)]
    first, last = (float(end @ middle[:, 1]) / max(float(end.sum()), 1e-300) for end in ends)
    return np.array([-1.0 if first > last + 0.01 * surface.extent else 1.0, 0.0, 0.0])


def _weights(surface: Surface, normals: Floats) -> tuple[Ints, Ints, Floats]:
    """Groups of face corners that share weights: (F, 3) group of each corner, (G,) its vertex, (G, 6) its weights.

    A vertex is one group, unless it has faces that no single side sees (the corner of a cube): then the faces around
    it fall into groups by the side that each faces most.
    """
    count = len(surface.vertices)
    corners = surface.faces.reshape(-1)
    facing = np.repeat(normals @ AXES.T, 3, axis=0)
    steepest = np.ones((count, 6))
    np.minimum.at(steepest, corners, facing)
    whole = np.asarray(steepest.max(axis=1) > STEEPEST)

    best = np.argmax(facing, axis=1)
    key = np.where(whole[corners], corners, count + corners * 6 + best)
    keys, corner_group = np.unique(key, return_inverse=True)
    split = keys >= count
    group_source = np.where(split, (keys - count) // 6, keys)

    smooth = surface.normals
    average = smoother(count, surface.faces)
    for _ in range(SMOOTHING):
        smooth = unit(average @ smooth)
    turned = np.clip(unit(smooth) @ AXES.T, 0.02, 1.0) ** SHARPNESS
    ramp = np.clip((steepest - STEEPEST) / (FULL - STEEPEST), 0.0, 1.0)
    soft = turned * ramp * ramp * (3.0 - 2.0 * ramp)
    soft /= np.maximum(soft.sum(axis=1, keepdims=True), 1e-300)
    # A side that keeps less than SHARE fades out smoothly, the largest one always stays.
    rest = np.maximum(soft - np.minimum(SHARE, 0.5 * soft.max(axis=1, keepdims=True)), 0.0)
    rest /= np.maximum(rest.sum(axis=1, keepdims=True), 1e-300)
    rest[rest <= LEAST] = 0.0
    rest /= np.maximum(rest.sum(axis=1, keepdims=True), 1e-300)

    weights = rest[group_source]
    weights[split] = np.eye(6)[(keys[split] - count) % 6]
    return corner_group.reshape(-1, 3), group_source, weights


def _tangents(normals: Floats, along_u: Floats, along_v: Floats) -> Floats:
    """(M, 4) the u axis laid into the tangent plane, unit, with the sign that lets B grow with v."""
    flat = along_u - normals * np.einsum("ij,ij->i", normals, along_u)[:, None]
    upright = np.linalg.norm(flat, axis=1) < 1e-6
    other = np.cross(along_v, normals)
    tangent = unit(np.where(upright[:, None], other, flat))
    sign = np.where(np.einsum("ij,ij->i", np.cross(normals, tangent), along_v) < 0.0, -1.0, 1.0)
    return np.column_stack([tangent, sign])
