"""Where texture coordinates cut a surface apart: vertices that need copies, faces that still hang together."""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from furbake.surface.repair.topology import half_edges
from furbake.surface.soup import Floats, Ints, Soup

SAME = 1e-5
"""Texture coordinates nearer than this, in images, are one."""


def unique_rows(*columns: Floats | Ints) -> tuple[Ints, Ints]:
    """Where each different row of these (n,) columns comes first, and (n,) which of those it is."""
    key = np.zeros(len(columns[0]), dtype=np.int64)
    for column in columns:
        _, code = np.unique(column, return_inverse=True)
        _, key = np.unique(key * np.int64(code.max(initial=0) + 1) + code, return_inverse=True)
    _, first = np.unique(key, return_index=True)
    return first, key


def islands(soup: Soup) -> Ints:
    """(F,) which faces hang together with the same material and texture coordinates along their edges."""
    order, where, uses = half_edges(soup.faces)
    two = where[uses == 2]
    one, other = order[two], order[two + 1]
    a, b = one // 3, other // 3
    together = soup.part[a] == soup.part[b]
    if soup.uv is not None:
        first, second = one % 3, other % 3
        crossed = soup.faces[a, first] != soup.faces[b, second]
        for i in range(2):
            mine = soup.uv[a, (first + i) % 3]
            theirs = soup.uv[b, (second + np.where(crossed, 1 - i, i)) % 3]
            together &= np.isclose(mine, theirs, rtol=0.0, atol=SAME, equal_nan=True).all(axis=1)
    count = len(soup.faces)
    links = coo_array((np.ones(int(together.sum())), (a[together], b[together])), shape=(count, count))
    return connected_components(links, directed=False)[1].astype(np.int64)
