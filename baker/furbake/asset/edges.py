"""Fins as pairs of the shells' vertices, from which a reader makes their quads."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from furbake.surface.charts import Charts
from furbake.surface.place.fins import Fins

Ints = NDArray[np.int64]


def edges_of(charts: Charts, fins: Fins) -> tuple[Ints, float] | None:
    """(E, 2) vertices of the charts at the roots of each fin, ends of an edge of one face, first end first; the
    texture coordinate at which the first begins, a share of a tile. None where an edge is in no chart.
    """
    following = np.roll(charts.faces, -1, axis=1)
    ways = np.concatenate([np.stack([charts.faces, following], -1), np.stack([following, charts.faces], -1)])
    pairs = ways.reshape(-1, 2)
    pairs = pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]
    base = int(charts.source.max()) + 1
    known, first = np.unique(charts.source[pairs] @ np.array([base, 1]), return_index=True)
    wanted = fins.source.reshape(-1, 4)[:, :2] @ np.array([base, 1])
    place = np.minimum(np.searchsorted(known, wanted), len(known) - 1)
    if (known[place] != wanted).any():
        return None
    found = pairs[first[place]]
    return found[np.lexsort((found[:, 1], found[:, 0]))].astype(np.int64), float(fins.uv[0, 0] % 1.0)
