"""Width of a tile and length of the fur on a body, in its own units: as given, or from the body's thickness."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from furbake.options import BakeOptions
from furbake.surface.mesh import Surface
from furbake.surface.place.fitted import fitted

FINEST = 0.4
"""Width of a tile on a body that wants short fur, share of the usual one: patches are as many as tiles."""

FLATTEST = 0.05
"""Longest fur of such a body, tile widths."""

SHORT = 0.5
"""Share of the longest fur below which a body is said to have short parts."""

LONG, WIDE = 0.5, 2.0
"""Fur longer, a tile wider than this share of the model's largest side are questioned."""

TINY = 1 / 2000
"""Fur shorter, a tile narrower than this share of it are questioned, too."""


@dataclass(frozen=True)
class Size:
    """tile, length : model units; shares : (V,) 0..1 of the length at each vertex; notices : one sentence each."""

    tile: float
    length: float
    shares: NDArray[np.float64]
    notices: tuple[str, ...] = ()


def sized(ground: Surface, extent: float, options: BakeOptions) -> Size:
    """Tile and fur on a surface of a model whose largest side is `extent`.

    Raises OptionError when length and tile together give a height out of range.
    """
    tile, length = options.dimensions(extent)
    if not options.auto_length:
        return Size(tile, length, np.ones(len(ground.vertices)))
    fit = fitted(ground)
    if options.length_given:
        usual = min(options.own_height * options.tile_share * extent, fit.longest)
        return Size(tile, length, fit.shares(length, usual))
    longest = min(length, fit.longest)
    if options.tile is None:
        tile = max(longest / options.own_height, FINEST * tile)
    length = max(longest, FLATTEST * tile) if options.height is None else options.height * tile
    shares = fit.shares(length, length)
    least = float(shares.min()) * length
    span = f"{least:.3g} to {length:.3g}" if least < SHORT * length else f"{length:.3g}"
    told = (
        f"length: {span}, from the body's thickness; --length {2 * length:.2g} makes it twice as long, "
        "--no-length-by-thickness the same everywhere"
    )
    return Size(tile, length, shares, (told,))


def questions(tile: float, length: float, extent: float, options: BakeOptions) -> tuple[str, ...]:
    """Doubts about lengths that were given: one whose unit cannot be the model's, in a sentence each."""
    usual = options.own_height * options.tile_share * extent
    asked = []
    for name, value, high, ordinary in (
        ("length", length if options.length is not None else None, LONG, usual),
        ("tile", tile if options.tile is not None else None, WIDE, options.tile_share * extent),
    ):
        if value is None or TINY <= value / extent <= high:
            continue
        share = f"{value / extent:.3g} times" if value > extent else f"1/{extent / value:.3g} of"
        asked.append(
            f"{name}: {value:g} is {share} the model's largest side ({extent:.4g}), is it in the model's own units? "
            f"{ordinary:.2g} is usual"
        )
    return tuple(asked)
