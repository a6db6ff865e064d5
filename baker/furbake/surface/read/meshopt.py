"""Buffer views compressed by `EXT_meshopt_compression`, or by its successor `KHR_meshopt_compression`."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import meshopt

EXTENSIONS = ("EXT_meshopt_compression", "KHR_meshopt_compression")
"""Extensions of a buffer view that `decoded` reads, by name."""


def compression(view: Mapping[str, Any]) -> dict[str, Any] | None:
    """The object that says how a buffer view is compressed; None: it is not."""
    extensions = view.get("extensions", {})
    return next((extensions[name] for name in EXTENSIONS if name in extensions), None)


def decoded(stream: bytes | memoryview, extension: Mapping[str, Any], take: Callable[[int], None]) -> bytes:
    """Bytes of a buffer view. Raises ValueError for a broken stream.

    stream : compressed
    extension : of the view, as of `compression`
    take : called with the number of bytes before they are made; raises where there are too many
    """
    count, stride = extension["count"], extension["byteStride"]
    if any(isinstance(number, bool) or not isinstance(number, int) or number < 1 for number in (count, stride)):
        raise ValueError(f"{count!r} elements of {stride!r} bytes")
    take(count * stride)
    found = meshopt.decode_gltf_buffer(bytes(stream), count, stride, extension["mode"], extension.get("filter", "NONE"))
    return bytes(found.tobytes())
