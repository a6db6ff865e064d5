"""Light that is seen of a body from straight above: what its shells show, brought to what its hairs send there.

A slab hides those below it as if hairs lay anyhow, while a hair that stands hides itself. So shells show fur higher up
than an eye sees it, where grazing light is brighter: from straight above a mole's show twice the light of its hairs
under lights at the horizon, a teddy's 1.5 times as much. What is seen of all slabs is compared, light by light, as in
`eye`; the ratio goes by the light's height, is the horizon's for lights below it, and mean curves count times it.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from furbake.pelt.curves import KNOTS, RADII, Curves, abscissa, hats
from furbake.pelt.eye import SIZE
from furbake.pelt.hairs.strands import Coat, Strands
from furbake.pelt.hairs.volume import Volume, fine_shape, voxelise
from furbake.pelt.light.fibre import ABOVE
from furbake.pelt.means import directions, rounded
from furbake.pelt.pelt import Pelt
from furbake.pelt.seen import DARK, LitHairs, ShownTexels

Array = NDArray[np.float64]

SMOOTH = 0.1
"""Weight of differences between a ratio's knots beside the lights: they go on alike where no light is."""

FAINT = 0.01
"""Share of the greatest light that is added to the scale of relative errors."""


def as_seen(pelt: Pelt, strands: Strands, coat: Coat) -> Curves | None:
    """The pelt's mean curves times what hairs send straight up over what its texels show there; None without curves."""
    if pelt.curves is None:
        return None
    size = min(pelt.size, SIZE)
    fine = voxelise(strands, pelt.height, *fine_shape(pelt.layers, size, pelt.height), coat.opacity)
    ratio = np.stack([ratio_of(pelt, fine, size, coat, beta) for beta in RADII])
    curves = pelt.curves
    return replace(curves, even=rounded(curves.even * ratio), along=rounded(curves.along * ratio))


def ratio_of(pelt: Pelt, fine: Volume, size: int, coat: Coat, beta: float) -> Array:
    """The ratio at the knots of the tables for a body of radius β, (17,); fine : the oversampled volume."""
    lights = directions(beta)
    lights = lights[lights[:, 2] > 0]
    some = np.arange(len(lights))
    hairs, seen_hairs = LitHairs(fine, pelt.layers, size, lights, coat, beta).towards(ABOVE, some)
    texels, seen_texels = ShownTexels(pelt, lights, beta).towards(ABOVE, some)
    wanted = hairs.sum(1) * (seen_texels / max(seen_hairs, DARK))
    return smooth_ratio(abscissa(lights[:, 2], beta), wanted, texels.sum(1))


def smooth_ratio(x: Array, wanted: Array, shown: Array) -> Array:
    """Knots (17,) of a factor over x that brings what is shown, (n,) at these x, to what is wanted."""
    scale = shown + FAINT * max(float(shown.max()), DARK)
    rows = np.concatenate([hats(x) * (shown / scale)[:, None], SMOOTH * np.diff(np.eye(KNOTS), axis=0)])
    right = np.concatenate([wanted / scale, np.zeros(KNOTS - 1)])
    return np.maximum(np.linalg.lstsq(rows, right, rcond=None)[0], 0)
