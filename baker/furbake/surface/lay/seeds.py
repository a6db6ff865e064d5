"""Seeds of patches: farthest points, moved to the middle of their cells; and the walks from there."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import count

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.csgraph import dijkstra

from furbake.surface.charts import Floats, Ints
from furbake.surface.lay.ground import Ground

ROUNDS = 2
"""Rounds of moving each seed to the middle of its cell."""


SINGLY = 400
"""Rounds of one seed per piece."""

TURNS = 8
"""Kinds of cubes in a lattice, by odd and even places, of which no two of one kind touch."""


NEAR = 3
"""Steps around a seed within which the longest edge is looked for."""


@dataclass(frozen=True)
class Walk:
    """Shortest ways from the seeds of patches to all vertices within reach.

    patch, vertex : (n,) int; far : (n,) float, length of the way
    before : (n,) int, the vertex before this one on it, at a seed the seed itself
    """

    patch: Ints
    vertex: Ints
    far: Floats
    before: Ints


def spread(ground: Ground, targets: NDArray[np.bool_], share: float) -> Ints:
    """Seeds among the targets, farthest points first, until none is farther from one than share · radius.

    All pieces of the sheet are served at once, a seed each per round; after SINGLY rounds, all blocks of a piece that
    lie apart.
    """
    goal = np.maximum(share * ground.radius, 1e-12)
    place, far = np.flatnonzero(targets), np.full(len(targets), np.inf)
    block, turn = ground.sheet.piece[place], np.zeros(len(place), dtype=np.int64)
    seeds: list[Ints] = []
    for attempt in count():
        lacking = np.minimum(far[place] / goal[place], 1e9)
        if not (lacking > 1.0).any():
            break
        if attempt == SINGLY:
            block, turn = _blocks(ground, place, 2.0 * float(goal[place].max()))
        open_ = np.flatnonzero((lacking > 1.0) & (turn == attempt % TURNS if attempt >= SINGLY else True))
        order = open_[np.lexsort((-lacking[open_], block[open_]))]
        _, first = np.unique(block[order], return_index=True)
        if len(first) == 0:
            continue
        seeds.append(place[order[first]])
        limit = float(far[place].max())
        far = np.minimum(far, dijkstra(ground.ways, indices=seeds[-1], min_only=True, limit=limit))
    return np.concatenate(seeds) if seeds else np.zeros(0, dtype=np.int64)


def _blocks(ground: Ground, vertices: Ints, side: float) -> tuple[Ints, Ints]:
    """(n,) cube of a lattice with the piece, and (n,) its turn: cubes of one turn are at least a side apart."""
    cube = np.floor(ground.sheet.vertices[vertices] / side).astype(np.int64)
    _, block = np.unique(np.column_stack([ground.sheet.piece[vertices], cube]), axis=0, return_inverse=True)
    return block.reshape(-1).astype(np.int64), (cube % 2) @ np.array([1, 2, 4])


def centred(ground: Ground, seeds: Ints) -> tuple[Ints, Ints, Floats]:
    """Seeds moved to the middle of their cells, and for each vertex the number of its cell and the way to its seed."""
    i, j = ground.ways.nonzero()
    number = np.full(len(ground.radius), -1)

    def cells(seeds: Ints) -> tuple[Ints, Floats]:
        far, _, source = dijkstra(ground.ways, indices=seeds, min_only=True, return_predecessors=True)
        number[seeds] = np.arange(len(seeds))
        return number[source], far

    cell, far = cells(seeds)
    for _ in range(ROUNDS):
        ends = np.unique(np.r_[i[cell[i] != cell[j]], ground.border])
        if len(ends) == 0:
            break
        deep = dijkstra(ground.ways, indices=ends, min_only=True)
        deep = np.where(np.isfinite(deep), deep, -1.0)
        rank = np.lexsort((-deep, cell))
        _, first = np.unique(cell[rank], return_index=True)
        middle = rank[first]
        seeds = np.where(deep[middle] > 0.0, middle, seeds)
        cell, far = cells(seeds)
    return seeds, cell, far


def walks(ground: Ground, seeds: Ints, reach: Floats) -> Walk:
    """Walks from all seeds, `reach` (one per seed) and one edge far; those that cannot meet go together."""
    limit = reach + _longest(ground)[seeds]
    group = np.zeros((len(seeds), 3), dtype=np.int64)
    group[:, 0] = np.ceil(np.log2(limit))
    for octave in np.unique(group[:, 0]):
        at = np.flatnonzero(group[:, 0] == octave)
        block, group[at, 1] = _blocks(ground, seeds[at], 2.0 * 2.0**octave)
        order = np.argsort(block, kind="stable")
        group[at[order], 2] = np.arange(len(at)) - np.searchsorted(block[order], block[order])
    _, group_of = np.unique(group, axis=0, return_inverse=True)
    group_of = group_of.reshape(-1)

    number = np.full(len(ground.radius), -1)
    parts: list[tuple[Ints, Ints, Floats, Ints]] = []
    for k in range(int(group_of.max()) + 1):
        row = np.flatnonzero(group_of == k)
        number[seeds[row]] = row
        far, before, source = dijkstra(
            ground.ways, indices=seeds[row], min_only=True, return_predecessors=True, limit=float(limit[row].max())
        )
        at = np.flatnonzero(np.isfinite(far))
        parts.append((number[source[at]], at, far[at], np.where(before[at] < 0, at, before[at])))
    patch, vertex, far, before = (np.concatenate(column) for column in zip(*parts, strict=True))
    return Walk(patch, vertex, far, before.astype(np.int64))


def _longest(ground: Ground) -> Floats:
    """(S,) longest step at each vertex and at those a few steps around it."""
    i, j = ground.ways.nonzero()
    longest = np.zeros(len(ground.radius))
    np.maximum.at(longest, i, ground.ways.data)
    for _ in range(NEAR):
        around = longest.copy()
        np.maximum.at(around, i, longest[j])
        longest = around
    return np.maximum(longest, 1e-12)
