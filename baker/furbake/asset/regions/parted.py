"""Vertices of several furs on one surface: those of the coat first, then those of every region.

A face belongs to every fur that has a share at one of its corners, with vertices of its own: at a border it is there
for each of the two. Everything about a vertex but its fur is the same to the bit, so that shells of both coincide.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from furbake.asset.mesh.vertices import Attributes
from furbake.surface.charts import Charts
from furbake.surface.place.fins import Fins

Bytes = NDArray[np.uint8]
Ints = NDArray[np.int64]

REGION = "_REGION"
"""Attribute of a vertex: the two bounds between which the numbers of its fur's hairs lie, and the number of the fur."""


@dataclass(frozen=True)
class Parted:
    """Vertices of all furs, those of the coat first.

    charts : with a copy of every face for each fur that it carries
    rows : (M',) the vertices of the charts before, of which these are copies
    bounds : (M', 3) bytes of `REGION`
    """

    charts: Charts
    rows: Ints
    bounds: Bytes

    def copies(self, attributes: Attributes) -> Attributes:
        """Attributes of the vertices before, for these."""
        return {name: values[self.rows] for name, values in attributes.items()} | {REGION: self.bounds}


def parted(charts: Charts, bounds: Bytes) -> Parted:
    """The charts' vertices and faces, with a copy for each fur that they carry.

    bounds : (R + 2, V) of the surface, as of `surface.place.shares.bounds`
    """
    at = bounds[:, charts.source]
    share = np.diff(at.astype(np.int64), axis=0)
    rows, faces, cut, start = [], [], [], 0
    for i, own in enumerate(share):
        used, index = np.unique(charts.faces[(own[charts.faces] > 0).any(axis=1)], return_inverse=True)
        rows.append(used)
        faces.append(start + index.reshape(-1, 3))
        cut.append(np.column_stack([*at[i : i + 2, used], np.full(len(used), i, np.uint8)]))
        start += len(used)
    every = np.concatenate(rows)
    copies = {field: getattr(charts, field)[every] for field in ("source", "tangents", "uv", "weights", "group")}
    together = Charts(faces=np.concatenate(faces), **copies)
    return Parted(together, every, np.concatenate(cut))


def chosen_fins(each: list[Fins], bounds: Bytes, seed: int) -> tuple[Fins, tuple[int, ...]]:
    """One fin on every edge, of a fur chosen by chance and the shares at its ends; number of those of each fur.

    each : the same edges' fins of every fur
    """
    share = np.diff(bounds.astype(np.float64), axis=0)
    roots = each[0].source.reshape(-1, 4)[:, :2]
    upper = share[:, roots].mean(axis=2).cumsum(axis=0)
    chance = np.random.default_rng(seed).random(len(roots)) * upper[-1]
    fur = (chance >= upper).sum(axis=0)
    taken = [np.flatnonzero(fur == i) for i in range(len(each))]
    corners = [(4 * own[:, None] + np.arange(4)).reshape(-1) for own in taken]
    count = sum(len(own) for own in corners)
    together = {
        name: np.concatenate([getattr(fins, name)[own] for fins, own in zip(each, corners, strict=True)])
        for name in ("source", "tangents", "uv", "angles", "laid")
    }
    quads = 4 * np.arange(count // 4)[:, None] + np.array([0, 1, 3, 0, 3, 2])
    return Fins(faces=quads.reshape(-1, 3), **together), tuple(len(own) for own in taken)


def fin_bounds(quads: tuple[int, ...]) -> Attributes:
    """`REGION` of fins, which are whole: quads : number of fins of each fur, in their order"""
    fur = np.repeat(np.arange(len(quads)), 4 * np.array(quads))
    return {REGION: np.column_stack([np.zeros_like(fur), np.full_like(fur, 255), fur]).astype(np.uint8)}
