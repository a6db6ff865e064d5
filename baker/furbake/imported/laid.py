"""How fur has to stand for the tips of a groom: length, comb and the lean that all places share."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from furbake.imported.curves import Floats
from furbake.imported.fields import Fields, averaging
from furbake.surface.mesh import Surface
from furbake.surface.place.vertex_fur import FARTHEST

TALL = 0.95
"""Share of the strands that are no taller than the fur."""

FLAT = 0.04
"""Least height of a tip that is told from the skin, share of its strand."""

COMBED = 0.01
"""Cost of a comb beside a tip that is missed by its strand's length: light on the tile knows its lean."""

ROUNDS = 3
"""Rounds of averages over the edges, for length and comb: where one leaps, light does."""

LEANS = 33
"""Leans that are tried."""


@dataclass(frozen=True)
class Laid:
    """Fur on V vertices whose tips stand where those of the strands do.

    taller : height of the fur over the mean height of the strands; longest : fur of the part that it is for
    reach : (V,) length of the fur; comb : (V,) displacement of its tips, share of that
    lean : displacement of a mean strand's tip inside the tile, model units
    short : (V,) displacement of a mean strand's tip along the direction that is left, model units
    missed : mean distance by which tips along the surface are off, share of the strands' length
    """

    taller: float
    longest: float
    reach: Floats
    comb: Floats
    lean: float
    short: Floats
    missed: float


def laid(surface: Surface, fields: Fields, direction: Floats, tall: Floats, part: NDArray[np.bool_]) -> Laid:
    """Fur of these fields along a direction (V, 3), for a part of the vertices (V,).

    tall : (S,) height of each strand's tip over that of the field at its root

    At a height of 1 / taller a shell stands at h and has moved by r·c / taller²; the tile adds the lean. The lean is
    the one that leaves the least to be wished: a comb is at most `FARTHEST`, and light on it is less exact.
    """
    taller = max(1.0, float(np.quantile(tall, TALL)))
    height = np.maximum(fields.height, FLAT * fields.length)
    along = np.einsum("ij,ij->i", fields.reach, direction)
    weight = np.maximum(fields.area * fields.density * (part & ~fields.bald), 1e-12 * fields.area)
    usual = float(np.average(fields.length, weights=weight))
    best: tuple[float, Laid] | None = None
    for lean in np.linspace(0.0, 1.5 * max(0.0, float(np.average(along, weights=weight))), LEANS):
        slope = taller * (along - lean) / height
        comb = np.clip(slope / np.sqrt(1 + slope * slope), -FARTHEST, FARTHEST)
        reach = taller * height / np.sqrt(1 - comb * comb)
        missed = np.abs(reach * comb / taller**2 + lean - along)
        off = float(np.average(missed / (fields.length + usual) + COMBED * comb * comb, weights=weight))
        if best is None or off < best[0] - 1e-4:
            mean = float(np.average(missed, weights=weight)) / usual
            best = off, Laid(taller, 0.0, reach, comb, float(lean), np.zeros_like(along), mean)
    assert best is not None  # noqa: S101 — for the types
    found, even = best[1], averaging(surface, ROUNDS)
    covered = np.maximum(even(weight), 1e-30)
    reach, comb = (even(weight * values) / covered for values in (found.reach, found.comb))
    short = along - found.lean - reach * comb / taller**2
    return replace(found, longest=float(reach[part].max()), reach=reach, comb=comb, short=short)
