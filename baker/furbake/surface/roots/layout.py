"""Patches moved by whole tiles to where no two lie over each other: the tile repeats, but a picture has one place."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from scipy.ndimage import binary_dilation
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components

from furbake.surface.charts import Charts
from furbake.surface.roots.raster import covered
from furbake.surface.soup import Flags, Floats, Ints

CELLS = 8
"""Cells per tile in which patches are told apart."""

WIDTHS = (1.0, 1.1, 1.2, 1.3, 1.5)
"""Widths of the whole that are tried, over that of a square without gaps."""


@dataclass(frozen=True)
class Layout:
    """Patches in places of their own.

    uv : (M, 2) texture coordinates, tiles; patch : (M,) the patch of each vertex
    owner : (rows, columns) the patch whose vertices, roots or margin lie in each cell, -1: none
    """

    uv: Floats
    patch: Ints
    owner: Ints

    def owner_at(self, uv: Floats) -> Ints:
        """(n,) the patch that has the place (n, 2), tiles; -1: none."""
        column, row = np.floor(uv * CELLS).astype(np.int64).T
        rows, columns = self.owner.shape
        there = (row >= 0) & (row < rows) & (column >= 0) & (column < columns)
        return np.where(there, self.owner[np.clip(row, 0, rows - 1), np.clip(column, 0, columns - 1)], -1)


def patches_of(charts: Charts) -> tuple[int, Ints]:
    """Number of patches, and (M,) the patch of each vertex: vertices that faces join."""
    count = len(charts.source)
    start, end = charts.faces.reshape(-1), np.roll(charts.faces, -1, axis=1).reshape(-1)
    links = csr_array((np.ones(len(start)), (start, end)), shape=(count, count))
    patches, patch = connected_components(links, directed=False)
    return int(patches), patch.astype(np.int64)


def laid_out(charts: Charts, drift: Floats) -> Layout:
    """Texture coordinates from 0 on, with every patch in a place of its own in a square or so.

    drift : (2,) displacement of the tips from their roots, tiles: roots lie that far beside a patch
    """
    patches, patch = patches_of(charts)
    masks, lows = zip(*(_mask(charts, patch == one, drift) for one in range(patches)), strict=True)
    order = sorted(range(patches), key=lambda one: (-masks[one].size, one))
    least = int(np.ceil(np.sqrt(sum(mask.sum() for mask in masks)) / CELLS))
    widest = max(-(-mask.shape[1] // CELLS) for mask in masks)
    sides = sorted({max(int(np.ceil(least * share)), widest) for share in WIDTHS})
    packed = (_packed([masks[one] for one in order], side) for side in sides)
    places, taken, _ = min(packed, key=lambda found: found[2])
    move = np.zeros((patches, 2))
    move[order] = places
    owner = np.append(order, -1)[taken]
    return Layout(np.asarray(charts.uv + (move - np.array(lows))[patch]), patch, owner)


def _packed(masks: list[Flags], side: int) -> tuple[Floats, Ints, int]:
    """(P, 2) places of masks in a strip `side` tiles wide, the mask in each cell of it, -1: none, and its longer side.

    Each has the first free place of whole tiles, top row first.
    """
    tall = [-(-len(mask) // CELLS) for mask in masks]
    taken = np.full((sum(tall) * CELLS, side * CELLS), -1, dtype=np.int64)
    places, rows = [], 0
    for number, (mask, height) in enumerate(zip(masks, tall, strict=True)):
        windows = sliding_window_view(taken[: (rows + height) * CELLS] >= 0, mask.shape)[::CELLS, ::CELLS]
        free = ~np.any(windows & mask, axis=(2, 3))
        row, column = (int(at) for at in np.unravel_index(int(np.argmax(free)), free.shape))
        top, left = row * CELLS, column * CELLS
        taken[top : top + mask.shape[0], left : left + mask.shape[1]][mask] = number
        places.append((column, row))
        rows = max(rows, row + height)
    return np.array(places, dtype=np.float64), taken[: rows * CELLS], max(side, rows)


def _mask(charts: Charts, mine: Flags, drift: Floats) -> tuple[Flags, Floats]:
    """Cells that a patch, its roots and a margin of a cell take, from a corner of whole tiles on; and that corner."""
    faces = charts.faces[mine[charts.faces[:, 0]]]
    low = np.floor(np.minimum(charts.uv[mine], charts.uv[mine] - drift).min(axis=0) - 1.0 / CELLS)
    high = np.maximum(charts.uv[mine], charts.uv[mine] - drift).max(axis=0) + 2.0 / CELLS
    width, height = (np.ceil((high - low) * CELLS)).astype(np.int64)
    steps = int(np.ceil(np.abs(drift).max() * CELLS)) + 1
    corners = charts.uv[faces] - low
    moved = np.concatenate([corners - drift * (step / steps) for step in range(steps + 1)])
    cells = covered(moved * CELLS, (height, width))
    return binary_dilation(cells, np.ones((3, 3), dtype=bool)), low
