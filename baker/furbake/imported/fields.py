"""Fields over a surface from the strands on it: length, direction, density and colours at every vertex."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array

from furbake.imported.bind import Bound, Ground
from furbake.imported.curves import Floats, Ints
from furbake.surface.lay.field import comb_field
from furbake.surface.lay.guide import Guide
from furbake.surface.mesh import Surface

FIRM = 1000.0
"""Weight of the strands against that of the guide, for the direction: they are everywhere."""

UNSURE = 0.02
"""Length of a mean direction below which strands do not agree on one."""

SPREAD = 1.5
"""Distance over which strands are averaged, distances between strands."""

MOST_ROUNDS = 400

BALD = 0.15
"""Density below which a place is bald, shares of the median."""


@dataclass(frozen=True)
class Fields:
    """Means over the strands around each of the V vertices.

    length : (V,) along the strands; height : (V,) of the tips; reach : (V, 3) of the tips along the surface, a vector
    way : (V, 3) mean direction from root to tip, tangent; its length is how far strands agree
    firm : (V,) 0..1, share of the way from root to tip along the surface; curl : (V,) length over that way, less 1
    width : (V,) of the strands
    density : (V,) strands per area; bald : (V,) where there are none
    root, tip : (V, 3) linear colours, or None
    area : (V,) of the surface around the vertex
    """

    length: Floats
    height: Floats
    reach: Floats
    way: Floats
    firm: Floats
    curl: Floats
    width: Floats
    density: Floats
    bald: NDArray[np.bool_]
    root: Floats | None
    tip: Floats | None
    area: Floats


@dataclass(frozen=True)
class Standing:
    """Where S strands stand on a surface: face (S,), shares (S, 3) of its corners."""

    ground: Ground
    face: Ints
    shares: Floats

    def at(self, values: Floats) -> Floats:
        """Values of the vertices (V, ...) at the strands, (S, ...)."""
        return self.ground.at(values, self.face, self.shares)

    def some(self, which: NDArray[np.bool_]) -> Standing:
        """Some of the strands, (S,)."""
        return Standing(self.ground, self.face[which], self.shares[which])


def standing(ground: Ground, bound: Bound, skin: Ground) -> Standing:
    """Strands that are bound to a skin on another copy of it."""
    if ground.surface is skin.surface:
        return Standing(ground, bound.face, bound.shares)
    feet = np.einsum("nc,nck->nk", bound.shares, skin.corners[bound.face])
    face, shares, _ = ground.feet(feet)
    return Standing(ground, face, shares)


def fields_of(stands: Standing, bound: Bound) -> Fields:
    """Smooth means over the strands."""
    surface = stands.ground.surface
    area = areas(surface)
    step = averaging(surface, rounds_for(surface, area, bound.count))
    corners = surface.faces[stands.face]
    count = len(surface.vertices)

    def summed(values: Floats) -> Floats:
        """Sums of values (S, ...) of the strands at the vertices, spread over the surface."""
        flat = values.reshape(bound.count, -1)
        each = (stands.shares * column[:, None] for column in flat.T)
        parts = [np.bincount(corners.reshape(-1), part.reshape(-1), count) for part in each]
        return step(np.stack(parts, -1)).reshape(count, *values.shape[1:])

    mass, ground = summed(np.ones(bound.count)), step(area)
    density = mass / ground
    typical = float(np.median(stands.at(density)))
    bald = density < BALD * typical

    def mean(values: Floats) -> Floats:
        total = summed(values)
        whole = np.maximum(mass, 1e-12).reshape(-1, *[1] * (total.ndim - 1))
        rest = values.mean(axis=0)
        return np.where(mass.reshape(whole.shape) > 1e-9 * typical * area.mean(), total / whole, rest)

    normals = surface.normals
    return Fields(
        length=mean(bound.length),
        height=mean(bound.height),
        reach=_tangent(mean(bound.reach[:, None] * bound.way), normals),
        way=_tangent(mean(bound.firm[:, None] * bound.way), normals),
        firm=mean(bound.firm),
        curl=mean(bound.length / np.maximum(np.hypot(bound.height, bound.reach), 1e-30) - 1),
        width=mean(bound.width),
        density=density,
        bald=bald,
        root=None if bound.root is None else mean(bound.root),
        tip=None if bound.tip is None else mean(bound.tip),
        area=area,
    )


def direction_of(surface: Surface, fields: Fields, guide: Guide) -> Floats:
    """(V, 3) unit tangents along which the strands lie; along the guide where there are none."""
    size = np.linalg.norm(fields.way, axis=1, keepdims=True)
    return comb_field(surface, guide, (), fields.way / np.maximum(size, UNSURE), FIRM).direction


def areas(surface: Surface) -> Floats:
    """(V,) a third of the area of the faces around each vertex."""
    corners = surface.vertices[surface.faces]
    doubled = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    return np.asarray(
        np.bincount(surface.faces.reshape(-1), np.repeat(doubled / 6.0, 3), len(surface.vertices)), np.float64
    )


def rounds_for(surface: Surface, area: Floats, strands: int) -> int:
    """Rounds of averages that spread each strand over the distance to the next ones."""
    start, end = surface.faces.reshape(-1), np.roll(surface.faces, -1, axis=1).reshape(-1)
    edge = float(np.linalg.norm(surface.vertices[start] - surface.vertices[end], axis=1).mean())
    spacing = np.sqrt(area.sum() / strands)
    return int(np.clip(np.ceil((SPREAD * spacing / edge) ** 2), 1, MOST_ROUNDS))


def averaging(surface: Surface, rounds: int) -> Callable[[Floats], Floats]:
    """Rounds of averages over the edges of sums at the vertices, (V, ...): half stays, half is shared out."""
    start, end = surface.faces.reshape(-1), np.roll(surface.faces, -1, axis=1).reshape(-1)
    count = len(surface.vertices)
    ends = np.r_[start, end], np.r_[end, start]
    links = coo_array((np.ones(2 * len(start)), ends), shape=(count, count)).tocsr()
    links.data[:] = 1.0
    degree = np.maximum(np.bincount(links.indices, minlength=count), 1.0)

    def even(values: Floats) -> Floats:
        for _ in range(rounds):
            values = 0.5 * values + 0.5 * (links @ (values.T / degree).T)
        return np.asarray(values)

    return even


def _tangent(vectors: Floats, normals: Floats) -> Floats:
    return np.asarray(vectors - normals * np.einsum("ij,ij->i", vectors, normals)[:, None])
