"""Elements of glTF accessors as they are stored (glTF 2.0, section 3.6): the one reader of them."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

TYPES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
"""Types of components by their number in the format."""

WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}
"""Components of an element by its name in the format."""


def elements(
    data: bytes | memoryview, offset: int, count: int, width: int, kind: np.dtype[Any], stride: int = 0
) -> NDArray[Any]:
    """(count, width) components of type `kind`.

    data : of the buffer view; offset : of the first element in it, bytes
    stride : bytes from element to element, 0: they are packed

    Raises ValueError where they leave the view.
    """
    size = width * kind.itemsize
    stride = stride or size
    if count < 0 or offset < 0 or stride < size or (count and offset + (count - 1) * stride + size > len(data)):
        raise ValueError(f"{count} elements of {stride} bytes in a buffer view of {len(data)}")
    if not count:
        return np.zeros((0, width), dtype=kind)
    flat = np.frombuffer(data, dtype=np.uint8)[offset:]
    rows = np.lib.stride_tricks.as_strided(flat, (count, size), (stride, 1))
    return np.ascontiguousarray(rows).view(kind).reshape(count, width)
