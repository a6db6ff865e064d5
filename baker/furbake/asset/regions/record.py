"""Images and numbers of the furs of regions, beside those of the coat."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from furbake.asset.mesh.buffer import numbers
from furbake.asset.planes import write_planes
from furbake.pelt.pelt import FinPelt, Pelt

Record = dict[str, Any]

OWN = ("height", "curves", "drift", "bent", "eye", "finEye", "surge", "short", "spread", "open", "ramp", "pelts")
"""Members of the extension's object that each region has of its own."""

CELLS = 16
"""Cells along a tile of the coat in which all hairs are of one fur: about one long hair each."""


@dataclass(frozen=True)
class RegionFur:
    """Fur of a region: its name, width of its tile over that of the coat's, and states."""

    name: str
    tile: float
    pelts: tuple[Pelt, ...]


@dataclass(frozen=True)
class Regions:
    """Furs of parts of a body beside the coat.

    bounds : (R + 2, V) of the ground, as of `surface.place.shares.bounds`
    tile : width of a tile of the coat, model units
    furs : of the regions
    quads : number of fins of each fur, the coat first; () without fins
    """

    bounds: NDArray[np.uint8]
    tile: float
    furs: tuple[RegionFur, ...]
    quads: tuple[int, ...] = ()


def regions_record(regions: Regions, furs: Sequence[Record]) -> Record:
    """The extension's object of several furs. furs : the extension's object of each region, as if alone"""
    own = []
    for fur, record in zip(regions.furs, furs, strict=True):
        kept = {key: record[key] for key in OWN if key in record}
        own.append({"name": fur.name, "tile": numbers(np.array([fur.tile]))[0]} | kept)
    return {"tile": numbers(np.array([regions.tile]))[0], "cells": CELLS, "furs": own}


def write_regions(
    folder: Path, regions: Regions | None, images: list[str], cache: Path | None = None
) -> list[tuple[RegionFur, list[str]]]:
    """Write the images of all regions; each fur with what `write_shared` returns."""
    furs = () if regions is None else regions.furs
    return [(fur, write_shared(folder, fur.pelts, f"region{i}-", images, cache)) for i, fur in enumerate(furs, 1)]


def write_shared(
    folder: Path, pelts: Sequence[Pelt], prefix: str, images: list[str], cache: Path | None = None
) -> list[str]:
    """Write the images of a region's pelts; those that are there already, byte by byte, are shared.

    prefix : of the names of all of its images; images : names in the order of `images`, which grows
    cache : optional folder of images that were encoded before

    Returns names without the prefix, at the index of each image, "" for those of other furs.
    """
    own: dict[int, str] = {}
    before = list(images)
    for i, pelt in enumerate(pelts):
        state = f"{pelt.state.name}-" if i else ""
        for name in write_planes(folder, pelt, f"{prefix}{state}", cache):
            alike = (at for at, other in enumerate(before) if at not in own and _same(folder / other, folder / name))
            at = next(alike, len(images))
            if at < len(images):
                (folder / name).unlink()
            else:
                images.append(name)
            own[at] = name.removeprefix(prefix)
    return [own.get(i, "") for i in range(len(images))]


def shaped(pelts: Sequence[Pelt], like: Pelt) -> tuple[Pelt, ...]:
    """The pelts with fins of as many rows as another's: furs of one body are stacked in one texture."""
    if like.fin is None:
        return tuple(pelts)
    rows, columns = like.fin.alpha.shape
    return tuple(replace(pelt, fin=None if pelt.fin is None else _resized(pelt.fin, rows, columns)) for pelt in pelts)


def _resized(fin: FinPelt, rows: int, columns: int) -> FinPelt:
    """A fin's texels repeated or left out."""
    if fin.alpha.shape == (rows, columns):
        return fin
    of_rows, of_columns = fin.alpha.shape
    v = ((np.arange(rows) + 0.5) * of_rows / rows).astype(np.int64)[:, None]
    u = ((np.arange(columns) + 0.5) * of_columns / columns).astype(np.int64)
    colour = None if fin.colour is None else fin.colour[v, u]
    return replace(fin, codes=fin.codes[v, u], alpha=fin.alpha[v, u], tint=fin.tint[v, u], colour=colour)


def _same(one: Path, two: Path) -> bool:
    return one.stat().st_size == two.stat().st_size and one.read_bytes() == two.read_bytes()
