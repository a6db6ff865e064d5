"""A pelt of photographs in place of grown hairs."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from furbake.options import BakeOptions
from furbake.pelt.hairs.ramp import Ramp
from furbake.pelt.hairs.volume import Volume
from furbake.pelt.texels.quantise import srgb_bytes
from furbake.rti.measured import Measured, measure
from furbake.tile.fitting import fit_pelt
from furbake.tile.lighting import Lighting
from furbake.tile.tile import Fitted


def measured_pelts(swatch: Path, options: BakeOptions, height: float) -> tuple[Fitted, tuple[str, ...]]:
    """The pelt of a swatch and its figures, and what is to be told of it. Raises RtiError.

    height : of the skin that it becomes, tile widths
    """
    found = measure(swatch, options.layers, options.size)
    lighting = Lighting(found.lights, found.held_out, found.samples)
    pelt, figures = fit_pelt(_volume(found, height), lighting, replace(options, colour_plane=False))
    red, green, blue = (float(channel) for channel in found.colour.mean((0, 1)))
    mean = red, green, blue
    colour = np.broadcast_to(srgb_bytes(found.colour), (options.layers, *found.colour.shape))
    dressed = replace(pelt, colour=np.ascontiguousarray(colour), ramp=Ramp(mean, mean, mean, 1.0))
    return [(dressed, figures)], found.notices


def _volume(found: Measured, height: float) -> Volume:
    """Slabs of that coverage, whose hairs stand upright."""
    layers, size, _ = found.alpha.shape
    sigma = -np.log1p(-np.minimum(found.alpha, 1 - 1e-9)) * layers / height
    upright = np.broadcast_to(np.array([0.0, 0.0, 1.0]), (layers, size, size, 3))
    even = np.ones((layers, size, size))
    radius = np.full(layers, 0.5 / size)
    return Volume(sigma, sigma, radius, upright, even, np.zeros_like(even), np.zeros((layers, 2)), height)
