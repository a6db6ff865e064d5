"""Photographs of one thing under one lamp each, read one at a time: a set may be larger than the memory."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from furbake.pelt.texels.basis import PTM
from furbake.rti.lp import find, read_lp
from furbake.rti.ptm import read_bytes
from furbake.rti.relit import Array, Bytes, RtiError
from furbake.surface.colours import decode, picture_size
from furbake.surface.limits import limits
from furbake.surface.material import Picture

LEAST = 6
"""Photographs of a set: a polynomial has six numbers."""

TELLS = 1e-6
"""Least singular value of the functions at the lamps that tells them apart."""

NAMED = 3
"""Names that a notice lists at the most."""


@dataclass(frozen=True)
class Photographs:
    """A set of photographs of one size.

    paths : of the files; lights : (n, 3) towards the lamp of each; notices : what was left out, one sentence each
    """

    name: str
    paths: tuple[Path, ...]
    lights: Array
    width: int
    height: int
    notices: tuple[str, ...] = ()

    def __iter__(self) -> Iterator[Bytes]:
        """The photographs one after the other, (H, W, 3) bytes, row 0 on top. Raises RtiError for a broken one."""
        for path in self.paths:
            pixels = decode(Picture(read_bytes(path), ""))
            if pixels is None or pixels.shape[:2] != (self.height, self.width):
                raise RtiError(f"{path}: cannot be read, expected a picture of {self.width} x {self.height}")
            yield pixels[..., :3]

    def sampled(self, most: int) -> Bytes:
        """The same pixels of every photograph, at most so many, spread evenly, (n, pixels, 3)."""
        step = max(int(np.ceil(np.sqrt(self.width * self.height / most))), 1)
        return np.stack([pixels[step // 2 :: step, step // 2 :: step].reshape(-1, 3) for pixels in self])

    def some(self, kept: NDArray[np.bool_]) -> Photographs:
        """Those of a mask (n,)."""
        paths = tuple(path for path, keep in zip(self.paths, kept, strict=True) if keep)
        return replace(self, paths=paths, lights=self.lights[kept])


def read_photographs(path: Path) -> Photographs:
    """The set that an `.lp` file lists; what is missing, or of another size, is left out and told.

    Raises RtiError where fewer than `LEAST` are left.
    """
    lamps = read_lp(path)
    places = [find(path, name) for name in lamps.names]
    sizes = [None if place is None else _size(place) for place in places]
    size, _ = Counter(size for size in sizes if size is not None).most_common(1)[0] if any(sizes) else ((0, 0), 0)
    missing = [name for name, found in zip(lamps.names, places, strict=True) if found is None]
    broken = [
        name for name, place, own in zip(lamps.names, places, sizes, strict=True) if place is not None and own is None
    ]
    other = [name for name, own in zip(lamps.names, sizes, strict=True) if own is not None and own != size]
    kept = [i for i, own in enumerate(sizes) if own is not None and own == size]
    told = [
        f"{path}: {what} {_listed(names)}: left out"
        for what, names in (
            ("not found beside it:", missing),
            ("cannot be read:", broken),
            (f"not of {size[0]} x {size[1]} pixels:", other),
        )
        if names
    ]
    if len(kept) < LEAST:
        reason = f" ({told[0].partition(': ')[2].removesuffix(': left out')})" if told else ""
        raise RtiError(f"{path}: {len(kept)} photographs of one size{reason}, expected {LEAST} or more")
    if size[0] * size[1] > limits().pixels:
        raise RtiError(f"{path}: photographs of {size[0]} x {size[1]}, expected at most {limits().pixels} pixels")
    lights = lamps.lights[kept]
    if (rank := np.linalg.matrix_rank(PTM(lights), tol=TELLS)) < LEAST:
        told.append(f"{path}: its lamps tell {rank} of the {LEAST} numbers of a PTM apart: the others are a guess")
    if below := int((lights[:, 2] <= 0).sum()):
        told.append(f"{path}: {below} of {len(lights)} lamps are not above the horizon, where a PTM has no light")
    for name, count in Counter(lamps.names).items():
        if count > 1:
            told.append(f"{path}: lists {name} {count} times")
    taken = tuple(place for i in kept if (place := places[i]) is not None)
    return Photographs(str(path), taken, lights, *size, (*lamps.notices, *told))


def _size(path: Path) -> tuple[int, int] | None:
    try:
        return picture_size(Picture(read_bytes(path), ""))
    except RtiError:
        return None


def _listed(names: list[str]) -> str:
    more = f" and {len(names) - NAMED} more" if len(names) > NAMED else ""
    return ", ".join(names[:NAMED]) + more
