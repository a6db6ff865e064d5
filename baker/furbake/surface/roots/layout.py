"""Patches moved by whole tiles to where no two lie over each other: the tile repeats, but a picture has one place."""

from __future__ import annotations

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


def patches_of(charts: Charts) -> tuple[int, Ints]:
    """Number of patches, and (M,) the patch of each vertex: vertices that faces join."""
    count = len(charts.source)
    start, end = charts.faces.reshape(-1), np.roll(charts.faces, -1, axis=1).reshape(-1)
    links = csr_array((np.ones(len(start)), (start, end)), shape=(count, count))
    patches, patch = connected_components(links, directed=False)
    return int(patches), patch.astype(np.int64)


def laid_out(charts: Charts, drift: Floats) -> Floats:
    """(M, 2) texture coordinates, tiles from 0 on, with every patch in a place of its own in a square or so.

    drift : (2,) displacement of the tips from their roots, tiles: roots lie that far beside a patch
    """
    patches, patch = patches_of(charts)
    masks, lows = zip(*(_mask(charts, patch == one, drift) for one in range(patches)), strict=True)
    order = sorted(range(patches), key=lambda one: (-masks[one].size, one))
    least = int(np.ceil(np.sqrt(sum(mask.sum() for mask in masks)) / CELLS))
    widest = max(-(-mask.shape[1] // CELLS) for mask in masks)
    sides = sorted({max(int(np.ceil(least * share)), widest) for share in WIDTHS})
    places, _ = min((_packed([masks[one] for one in order], side) for side in sides), key=lambda packed: packed[1])
    move = np.zeros((patches, 2))
    move[order] = places
    return np.asarray(charts.uv + (move - np.array(lows))[patch])


def _packed(masks: list[Flags], side: int) -> tuple[Floats, int]:
    """(P, 2) places of masks in a strip `side` tiles wide, and the longer side of it all.

    Each has the first free place of whole tiles, top row first.
    """
    tall = [-(-len(mask) // CELLS) for mask in masks]
    taken = np.zeros((sum(tall) * CELLS, side * CELLS), dtype=bool)
    places, rows = [], 0
    for mask, height in zip(masks, tall, strict=True):
        windows = sliding_window_view(taken[: (rows + height) * CELLS], mask.shape)[::CELLS, ::CELLS]
        free = ~np.any(windows & mask, axis=(2, 3))
        row, column = (int(at) for at in np.unravel_index(int(np.argmax(free)), free.shape))
        top, left = row * CELLS, column * CELLS
        taken[top : top + mask.shape[0], left : left + mask.shape[1]] |= mask
        places.append((column, row))
        rows = max(rows, row + height)
    return np.array(places, dtype=np.float64), max(side, rows)


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
