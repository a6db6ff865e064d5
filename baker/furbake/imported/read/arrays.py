"""Grooms as NumPy archives: plain ones, and those of `furbake groom`."""

from __future__ import annotations

import io
import zipfile
from typing import Any

import numpy as np
from numpy.typing import NDArray

from furbake.imported.curves import Curves, GroomError, checked

Array = NDArray[Any]

EXPECTED = "points (S, P, 3), or points (N, 3) and counts (S,)"


def read_arrays(name: str, data: bytes, most: int) -> Curves:
    """A groom of a `.npz`: `points`, `counts`, `widths` (or `radius`) and `colours` (or `colour`).

    most : bytes to which it may unpack. Raises GroomError.
    """
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as packed:
            size = sum(entry.file_size for entry in packed.infolist())
        if size > most:
            raise GroomError(f"{name}: unpacks to {size} bytes, expected {most} at most")
        with np.load(io.BytesIO(data), allow_pickle=False) as archive:
            arrays = {key: np.asarray(archive[key]) for key in archive.files if key in NAMES}
    except GroomError:
        raise
    except Exception as error:  # noqa: BLE001 — readers raise anything on a broken file
        detail = " ".join(str(error).split())[:120] or type(error).__name__
        raise GroomError(
            f"{name}: cannot be read as .npz ({detail}), expected a NumPy archive with {EXPECTED}"
        ) from None
    for key, array in arrays.items():
        if array.dtype.kind not in "fiu":
            raise GroomError(f"{name}: {key} holds {array.dtype}, expected numbers")
    if "points" not in arrays:
        raise GroomError(f"{name}: has no array 'points', expected {EXPECTED}")
    points = arrays["points"]
    if points.ndim == 3 and points.shape[2] == 3:
        counts = np.full(points.shape[0], points.shape[1], np.int64)
    elif points.ndim == 2 and points.shape[1] == 3 and arrays.get("counts", points).ndim == 1:
        counts = arrays["counts"].astype(np.int64)
    else:
        raise GroomError(f"{name}: points of shape {points.shape}, expected {EXPECTED}")
    flat = points.reshape(-1, 3)
    widths = arrays["widths"] if "widths" in arrays else 2 * arrays["radius"] if "radius" in arrays else None
    colours = arrays.get("colours", arrays.get("colour"))
    return checked(
        name, flat, counts,
        None if widths is None else _each(name, "widths", widths, counts, len(flat), ()),
        None if colours is None else _each(name, "colours", colours, counts, len(flat), (3,)),
    )  # fmt: skip


NAMES = ("points", "counts", "widths", "radius", "colours", "colour")


def _each(name: str, what: str, values: Array, counts: Array, points: int, width: tuple[int, ...]) -> Array:
    """Values at all points: given for each of them, for each strand or for all."""
    if values.shape[values.ndim - len(width) :] != width:
        raise GroomError(f"{name}: {what} of shape {values.shape}, expected three numbers for each")
    rows = values.reshape(-1, *width)
    if len(rows) == points:
        return rows
    if len(rows) == len(counts) and int(counts.sum()) == points:
        return np.repeat(rows, counts, axis=0)
    if len(rows) == 1:
        return np.broadcast_to(rows[0], (points, *width))
    raise GroomError(
        f"{name}: {len(rows)} {what}, expected one, one per strand ({len(counts)}) or per point ({points})"
    )
