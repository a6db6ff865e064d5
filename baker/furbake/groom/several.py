"""Hairs of several furs on one body: a hair stands where the number of its cell lies between its fur's bounds."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from furbake.asset.read import Asset
from furbake.asset.regions.parted import REGION
from furbake.groom.ground import Floats, Ground, Ints, number, read_ground
from furbake.groom.roots import Roots, barycentric


def tile_of(asset: Asset, fur: int) -> float:
    """Width of a tile of one of the furs, 0: the coat, over that of the coat's."""
    return 1.0 if fur == 0 else float(asset.fur["regions"]["furs"][fur - 1]["tile"])


def own_ground(asset: Asset, base: tuple[float, float, float], fur: int) -> Ground:
    """The faces of one of the furs, in tiles of its own. base : as of `read_ground`"""
    ground = read_ground(asset, base)
    index = asset.primitive(asset.fur["shells"])["attributes"][REGION]
    mine = asset.accessor(index)[:, 2][ground.faces[:, 0]] == fur
    order = np.where(mine, np.cumsum(mine) - 1, -1)
    beside, tile = ground.beside[mine], tile_of(asset, fur)
    return replace(
        ground,
        faces=ground.faces[mine],
        uv=ground.uv / tile,
        beside=np.where(beside < 0, -1, order[beside]),
        shift=ground.shift[mine] / tile,
        surface=ground.surface[mine],
        tile=float(asset.fur["regions"]["tile"]) * tile,
    )


def own_roots(asset: Asset, ground: Ground, roots: Roots, fur: int) -> Roots:
    """Roots in the fur's own cells. ground : of `own_ground`"""
    index = asset.primitive(asset.fur["shells"])["attributes"][REGION]
    lower, upper = number(asset, index)[:, :2].T
    shares = barycentric(ground, roots.face, roots.uv)
    low, high = (np.einsum("nc,nc->n", shares, bound[ground.faces[roots.face]]) for bound in (lower, upper))
    at = cell_numbers(np.floor(roots.uv * tile_of(asset, fur) * asset.fur["regions"]["cells"]).astype(np.int64))
    kept = (low <= at) & ((at < high) | (high >= 1.0 - 1e-9))
    return Roots(roots.hair[kept], roots.face[kept], roots.uv[kept])


def cell_numbers(cells: Ints) -> Floats:
    """(n,) numbers 0..1 of cells (n, 2), as the format has them: PCG (M. E. O'Neill 2014) of their places."""
    low, high = (np.asarray(place & 0xFFFF, np.uint32) for place in cells.T)
    h = (low | (high << np.uint32(16))) * np.uint32(747796405) + np.uint32(2891336453)
    h = ((h >> ((h >> np.uint32(28)) + np.uint32(4))) ^ h) * np.uint32(277803737)
    h = (h >> np.uint32(22)) ^ h
    return np.asarray((h >> np.uint32(8)).astype(np.float64) / 2.0**24)
