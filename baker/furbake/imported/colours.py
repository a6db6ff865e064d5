"""Colours of a groom: a ramp for all of it, a factor from place to place, and what is left from hair to hair."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from furbake.imported.bind import Bound
from furbake.imported.curves import Floats
from furbake.imported.fields import Fields, Standing
from furbake.pelt.hairs.ramp import LUMINANCE, Ramp

BRIGHT = 0.95
"""Share of places, and of hairs, that are no brighter than the ramp."""

EVEN = 0.02
"""Spread of brightness from hair to hair below which there is none."""


@dataclass(frozen=True)
class Colours:
    """ramp : of the whole groom; places : (V, 3) 0..1, factors of it; tint : (S,) 0..1 of the strands."""

    ramp: Ramp
    places: Floats
    tint: Floats


def colours_of(bound: Bound, stands: Standing, fields: Fields) -> Colours | None:
    """Colours of a groom; None where it brings none."""
    if bound.root is None or bound.tip is None or fields.root is None or fields.tip is None:
        return None
    here = (fields.root + fields.tip) / 2
    most = np.maximum(np.quantile(here[~fields.bald], BRIGHT, axis=0), 1e-4)
    places = np.clip(here / most, 0.0, 1.0)
    mean = np.maximum(stands.at(here) @ LUMINANCE, 1e-6)
    brightness = ((bound.root + bound.tip) / 2 @ LUMINANCE) / mean
    brightest = float(np.quantile(brightness, BRIGHT)) if brightness.std() > EVEN else 1.0
    tint = np.clip(brightness / brightest, 0.0, 1.0)
    weight = (fields.area * fields.density * ~fields.bald)[:, None]
    ends = [
        np.clip(brightest * (end * weight).sum(0) / np.maximum((places * weight).sum(0), 1e-30), 0.0, 1.0)
        for end in (fields.root, fields.tip)
    ]
    root, tip = ((float(r), float(g), float(b)) for r, g, b in ends)
    return Colours(Ramp(root, tip, tip, 1.0), places, tint)
