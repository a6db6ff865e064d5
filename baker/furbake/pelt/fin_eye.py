"""The law of light and eye for fins, which are seen from the side alone.

Fins stand where the skin turns away from the eye, so that any eye is on their horizon. Their own weights of `eye.terms`
bring the mean light of their texels, height by height, to what the hairs of the fine volume send to a level eye, from
whichever side it sees them; the texels are lit as an eye straight above sees them.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from furbake.pelt.eye import FAINT, LIGHT_HEIGHTS, SeenHairs, rings, solve, terms, towards
from furbake.pelt.fin import overlap, polynomial, row_means
from furbake.pelt.hairs.strands import Coat, Strands
from furbake.pelt.pelt import FinPelt, Pelt
from furbake.pelt.seen import DARK
from furbake.pelt.texels.fit import relight

Array = NDArray[np.float64]

EYES = 6
"""Level eyes, all around: at an outline hairs lean towards the eye, away from it or to a side."""

SPOKES = 8
"""Lights in each ring of `LIGHT_HEIGHTS`."""

HIDDEN = 0.1
"""Share of the mean slab that is added to what is seen of each: deep ones hardly are, and have a sound light, too."""


def level_hairs(strands: Strands, coat: Coat, height: float, layers: int, size: int) -> SeenHairs:
    """Hairs as `fit_fin_eye` has them seen; layers, size : of the pelt."""
    lights, azimuth = rings(LIGHT_HEIGHTS, SPOKES), 2 * np.pi * np.arange(EYES) / EYES
    eyes = np.stack([np.cos(azimuth), np.sin(azimuth), np.zeros_like(azimuth)], -1)
    return towards(eyes, [np.arange(len(lights))] * len(eyes), lights, strands, coat, height, layers, size)


def fit_fin_eye(pelt: Pelt, fin: FinPelt, hairs: SeenHairs, finer: Array) -> Array:
    """Weights (3, 16) of the law for the fins of this dry fur, for s⁰, s¹, s². The pelt has mean curves.

    hairs, finer : its own, as of `level_hairs` and `eye.gauge`
    """
    lights, eyes = hairs.lights, hairs.eyes
    light, sends, texels = fin_light(pelt, fin, lights), [], []
    for sent, seen in zip(hairs.light(finer), hairs.seen, strict=True):
        share = np.where(seen > DARK * seen.sum(), seen / seen.sum() + HIDDEN / pelt.layers, 0)
        sends.append(sent / np.maximum(seen, 1e-30) * share)
        texels.append(light * share)
    wanted = np.concatenate(sends)
    whole = wanted.sum(-1)
    found = terms(np.tile(lights, (len(eyes), 1)), np.repeat(eyes, len(lights), 0), pelt.drift[-1])
    return np.round(solve(wanted, np.concatenate(texels), found, 1 / (whole + FAINT * whole.max())), 3)


def fin_light(pelt: Pelt, fin: FinPelt, lights: Array) -> Array:
    """Mean L of a fin's texels at the heights of the slabs, lights (n, 3) in the tile's frame → (n, K)."""
    rows, alpha = len(fin.alpha), fin.alpha / 255
    light = relight(fin.values, polynomial, lights, row_means(pelt, rows, lights))
    means = (light * alpha).sum(-1) / np.maximum(alpha.sum(-1), 1e-9)
    return np.asarray(means @ overlap(rows, pelt.layers).T)
