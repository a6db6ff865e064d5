"""Encoded images that are kept: the same pixels are written as they were encoded before."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from furbake.cache.entries import Cache

Images = Mapping[str, tuple[NDArray[np.uint8], bool]]
"""Pixels by the name of the file, and whether they are sRGB. All of them are one entry, whatever their names."""


def write_kept(cache: Path, folder: Path, images: Images, encoder: str) -> bool:
    """Write images as they were encoded before; False where they are to be encoded.

    cache : folder of entries; folder : of the files; encoder : all that decides a file beside its pixels
    """
    files = Cache(cache, ()).get(_key(images, encoder))
    if files is None or len(files) != len(images):
        return False
    for name, data in zip(images, files, strict=True):
        (folder / name).write_bytes(data.tobytes())
    return True


def keep_images(cache: Path, folder: Path, images: Images, encoder: str) -> None:
    """Keep the files of these images as they are in the folder."""
    files = [np.frombuffer((folder / name).read_bytes(), np.uint8) for name in images]
    Cache(cache, ()).put(_key(images, encoder), files)


def _key(images: Images, encoder: str) -> str:
    found = hashlib.sha256(encoder.encode())
    for pixels, srgb in images.values():
        found.update(f"{pixels.shape} {srgb}".encode())
        found.update(np.ascontiguousarray(pixels).tobytes())
    return f"{found.hexdigest()}-images"
