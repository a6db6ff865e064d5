"""Carry the numbers at the corners of one mesh over to another mesh of the same shape."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from furbake.surface.repair.near import apart, barycentric, candidates, nearest, sampled
from furbake.surface.repair.seams import islands
from furbake.surface.repair.topology import face_vectors
from furbake.surface.soup import Floats, Ints, Soup

BEYOND = 0.5
"""How far outside of an old face its texture coordinates are still continued, in that face's own size."""

FARTHEST = 8.0
"""The same where no other face will do."""


def carry(old: Soup, vertices: Floats, faces: Ints) -> Soup:
    """A soup of these triangles with the numbers of the old one.

    Each corner is read off the nearest old face that hangs together with the one under the middle of the new face.
    Texture coordinates must also agree with that one's, continued: the two sides of a seam may hang together elsewhere.
    """
    bare = replace(old, vertices=vertices, faces=faces, part=np.zeros(len(faces), dtype=np.int64))
    bare = replace(bare, uv=None, paint=None, attributes={})
    parts = np.unique(old.part)
    if not len(faces) or (len(parts) == 1 and old.uv is None and old.paint is None and not old.attributes):
        return replace(bare, part=np.full(len(faces), parts[0]))
    old_corners = old.vertices[old.faces]
    tree = sampled(old_corners)
    corners = vertices[faces]
    middle = corners.mean(axis=1)
    home = nearest(old_corners, candidates(tree, middle), middle)
    homes, places = np.repeat(home, 3), corners.reshape(-1, 3)
    inset = (0.9 * corners + 0.1 * middle[:, None]).reshape(-1, 3)
    near = candidates(tree, inset)
    island = islands(old)
    near = np.where(island[near] == island[homes][:, None], near, homes[:, None])
    on = nearest(old_corners, near, inset)
    share = np.clip(barycentric(old_corners[on], places), 0.0, 1.0)
    share /= share.sum(axis=1, keepdims=True)

    def read(values: Floats) -> Floats:
        return np.asarray(np.einsum("nk,nkd->nd", share, values[on]).reshape(len(faces), 3, -1))

    return replace(
        bare,
        part=old.part[home],
        uv=None if old.uv is None else _coordinates(old, old.uv, near, homes, places).reshape(-1, 3, 2),
        paint=None if old.paint is None else read(old.paint),
        attributes={name: read(values) for name, values in old.attributes.items()},
    )


def _coordinates(old: Soup, uv: Floats, near: Ints, homes: Ints, places: Floats) -> Floats:
    """(n, 2) texture coordinates at each place: of the nearest face that agrees with `homes`, else those continued."""
    corners = old.vertices[old.faces]
    expected = np.einsum("nk,nkd->nd", _continued(corners[homes], places, FARTHEST), uv[homes])
    area = np.linalg.norm(face_vectors(old.vertices, old.faces), axis=1)
    one, two = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
    density = np.sqrt(np.abs(one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]) / np.maximum(area, 1e-300))
    reach = density[homes] * np.linalg.norm(places - corners[homes].mean(axis=1), axis=1)
    found, nearest = expected, np.full(len(places), np.inf)
    for faces in near.T:
        there = np.einsum("nk,nkd->nd", _continued(corners[faces], places, BEYOND), uv[faces])
        distance = apart(corners[faces], places)
        agrees = (np.linalg.norm(there - expected, axis=1) <= reach) & (distance < nearest)
        found = np.where(agrees[:, None], there, found)
        nearest = np.where(agrees, distance, nearest)
    return np.asarray(found)


def _continued(triangles: Floats, places: Floats, beyond: float) -> Floats:
    share = np.clip(barycentric(triangles, places), -beyond, 1.0 + beyond)
    total = share.sum(axis=1, keepdims=True)
    return np.where(np.abs(total) > 0.1, share / np.where(np.abs(total) > 0.1, total, 1.0), 1.0 / 3.0)
