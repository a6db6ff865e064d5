"""Joints of a vertex: how many are kept, and their shares as bytes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from furbake.surface.rig.rig import Floats, Ints

KEPT = 4
"""Joints that move a vertex."""

WHOLE = 255
"""Sum of a vertex's shares as bytes."""


ROWS = 1 << 16
"""Vertices that are counted together."""


def strongest(which: Ints, shares: Floats) -> tuple[Ints, Floats, Ints]:
    """(V, 4) joints and shares that sum to 1, the strongest first, and (V,) how many different joints there were.

    which, shares : (V, n), n >= 1, shares >= 0 and at least one above 0. A joint may be named twice; of equals the
    lower number counts. Joints without a share are 0.
    """
    blocks = [_strongest(which[i : i + ROWS], shares[i : i + ROWS]) for i in range(0, max(len(which), 1), ROWS)]
    joints, kept, number = zip(*blocks, strict=True)
    return np.concatenate(joints), np.concatenate(kept), np.concatenate(number)


def _strongest(which: Ints, shares: Floats) -> tuple[Ints, Floats, Ints]:
    missing = max(KEPT - which.shape[1], 0)
    which, shares = np.pad(which, ((0, 0), (0, missing))), np.pad(shares, ((0, 0), (0, missing)))
    rows = np.arange(len(which))[:, None]
    order = np.argsort(which, axis=1, kind="stable")
    which, shares = which[rows, order], shares[rows, order]
    first = np.concatenate([np.ones((len(which), 1), dtype=bool), which[:, 1:] != which[:, :-1]], axis=1)
    slot = np.cumsum(first, axis=1) - 1
    total = np.zeros_like(shares)
    np.add.at(total, (rows, slot), shares)
    named = np.zeros_like(which)
    named[np.broadcast_to(rows, slot.shape), slot] = which
    order = np.argsort(-total, axis=1, kind="stable")[:, :KEPT]
    kept = total[rows, order]
    kept = kept / np.maximum(kept.sum(axis=1, keepdims=True), 1e-300)
    return np.where(kept > 0.0, named[rows, order], 0), kept, np.count_nonzero(total > 0.0, axis=1)


def as_bytes(which: Ints, shares: Floats) -> tuple[NDArray[np.uint16], NDArray[np.uint8]]:
    """(V, 4) joints and shares as bytes, which sum to 255: the largest rests are rounded up. Shares of 0 name joint 0.

    shares : (V, 4), of which each row sums to 1
    """
    exact = WHOLE * shares
    whole = np.floor(exact).astype(np.int64)
    short = WHOLE - whole.sum(axis=1, keepdims=True)
    rank = np.argsort(np.argsort(whole - exact, axis=1, kind="stable"), axis=1, kind="stable")
    whole += rank < short
    return np.where(whole > 0, which, 0).astype(np.uint16), whole.astype(np.uint8)
