"""Fins as edges of the shells, from which a reader makes their quads: a bit for each edge, in an order both know."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from furbake.asset.mesh.buffer import Buffer, numbers
from furbake.surface.charts import Charts
from furbake.surface.place.fins import Fins

Ints = NDArray[np.int64]
Bytes = NDArray[np.uint8]


def shell_edges(faces: NDArray[Any], positions: NDArray[Any]) -> tuple[Ints, Ints]:
    """Edges of the shells' surface, each once, in the order in which faces bring them: (E, 2) vertices, and (E,) keys
    that say which points an edge joins.

    faces : (F', 3); each is gone round from its lowest vertex
    positions : (M, 3) as stored: copies of a point are equal
    """
    corners = turned(faces)
    ends = np.stack([corners, np.roll(corners, -1, axis=1)], axis=-1).reshape(-1, 2)
    _, point = np.unique(positions, axis=0, return_inverse=True)
    joined = np.sort(point.reshape(-1)[ends], axis=1) @ np.array([len(positions), 1])
    _, first = np.unique(joined, return_index=True)
    order = np.sort(first)
    return ends[order], joined[order]


def turned(faces: NDArray[Any]) -> Ints:
    """(F, 3) the same faces, each gone round from its lowest vertex."""
    corners = np.asarray(faces, dtype=np.int64).reshape(-1, 3)
    turn = (np.argmin(corners, axis=1)[:, None] + np.arange(3)) % 3
    return np.asarray(np.take_along_axis(corners, turn, axis=1))


def fin_mask(faces: Ints, positions: NDArray[Any], source: Ints, fins: Fins) -> Bytes | None:
    """Bits of the edges that have a fin, lowest first, in bytes; None where a fin stands on no edge of the shells.

    faces, positions : as of `shell_edges`; source : (M,) vertices of the surface of which the shells' are copies
    """
    _, joined = shell_edges(faces, positions)
    _, point = np.unique(positions, axis=0, return_inverse=True)
    points = np.full(int(max(source.max(), fins.source.max())) + 1, -1, dtype=np.int64)
    points[source] = point.reshape(-1)
    ends = np.sort(points[fins.source.reshape(-1, 4)[:, :2]], axis=1)
    wanted = ends @ np.array([len(positions), 1])
    if (ends < 0).any() or not np.isin(wanted, joined).all():
        return None
    return np.packbits(np.isin(joined, wanted), bitorder="little")


def edges_record(charts: Charts, positions: NDArray[Any], fins: Fins, buffer: Buffer) -> dict[str, Any] | None:
    """The extension's object of fins on edges of the shells; None where they stand elsewhere.

    positions : (M, 3) of the shells, as stored; buffer : that takes the bits
    """
    mask = fin_mask(charts.faces, positions, charts.source, fins)
    if mask is None:
        return None
    return {"mask": buffer.bits(mask), "start": numbers(np.array([fins.uv[0, 0] % 1.0]))[0]}
