"""Random pelts, fins and curves of the golden assets."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from expected import LAYERS, SIZE

from furbake.pelt.curves import Curves
from furbake.pelt.hairs.ramp import Ramp
from furbake.pelt.hairs.states import PeltState
from furbake.pelt.pelt import FinPelt, Pelt
from furbake.pelt.texels.basis import Basis

STATES = (
    PeltState("moist", wetness=0.5, length=0.95, shade=0.8, gloss=1.5, sharpness=2.0),
    PeltState("wet", wetness=0.75, length=0.9, shade=0.7, gloss=2.0, sharpness=3.0),
    PeltState("soaked", wetness=1.0, length=0.85, shade=0.5, gloss=2.5, sharpness=4.0),
    PeltState("dirty", dirt=1.0, mud=(0.25, 0.2, 0.1)),
)


def golden_states() -> list[Pelt]:
    """The dry pelt and those of `STATES`, of the same λ and Ω; each with a fin."""
    dry = replace(golden_pelt("ptm", 6), fin=golden_fin())
    pelts = [dry]
    for i, state in enumerate(STATES):
        rng = np.random.default_rng([7, i])
        shape = dry.codes.shape
        tint = rng.integers(0, 256, shape[:3], dtype=np.uint8) if state.dirt else dry.tint
        codes = rng.integers(0, 256, shape, dtype=np.uint8)
        fin = replace(golden_fin(10 + i), scale=dry.fin.scale, bias=dry.fin.bias)
        pelts.append(replace(dry, codes=codes, tint=tint, fin=fin, state=state))
    return pelts


def golden_fin(seed: int = 8) -> FinPelt:
    """A side view of random bytes, covered less and less from root to tip."""
    rng = np.random.default_rng(seed)
    shape = (8, 16)
    return FinPelt(
        codes=rng.integers(0, 256, (*shape, 6), dtype=np.uint8),
        alpha=np.repeat(np.arange(255, 0, -32, dtype=np.uint8)[:, None], 16, axis=1),
        tint=np.full(shape, 255, np.uint8),
        colour=None,
        scale=rng.uniform(0.004, 0.012, 6),
        bias=rng.uniform(60, 130, 6),
    )


def golden_pelt(kind: str, count: int) -> Pelt:
    """A pelt of random bytes whose light lies around 0..3."""
    rng = np.random.default_rng([count, len(kind)])
    matrix = rng.normal(0, 0.5, (count, 27)) if kind == "eigen" else None
    basis = Basis("ptm") if matrix is None else Basis("eigen", 4, matrix)
    shape = (LAYERS, SIZE, SIZE)
    return Pelt(
        codes=rng.integers(0, 256, (*shape, count), dtype=np.uint8),
        alpha=np.full(shape, 255, np.uint8),
        tint=np.full(shape, 255, np.uint8),
        colour=None,
        scale=rng.uniform(0.004, 0.012, count),
        bias=rng.uniform(60, 130, count),
        basis=basis,
        drift=np.stack([np.zeros(LAYERS), np.linspace(0, 0.2, LAYERS)], -1),
        height=0.5,
        ramp=Ramp((1.0, 1.0, 1.0), (1.0, 1.0, 1.0), (1.0, 1.0, 1.0), 1.0),
    )


def golden_curves(pelt: Pelt) -> Pelt:
    """The pelt with three random curves and random weights, light up to about 3, and a lean of (3, 4) parts."""
    rng = np.random.default_rng(17)
    x = np.arange(17)
    rise = np.where(x == 0, 0, (x / 16) ** rng.uniform(0.5, 3, (3, 3, 1)))
    even = rise * rng.uniform(0.5, 1, (3, 3, 17))
    along = np.minimum(x, 16 - x) / 8 * even * rng.uniform(-0.8, 0.8, (3, 3, 1))
    tables = (np.array([float(f"{value:.4g}") for value in part.ravel()]).reshape(3, 3, 17) for part in (even, along))
    weights = np.round(rng.uniform(0.1, 0.7, (LAYERS, 3)), 4)
    drift = np.linspace(0, 0.2, LAYERS)[:, None] * [0.6, 0.8]
    return replace(pelt, drift=drift, curves=Curves(*tables, np.array([0.6, 0.8])), weights=weights)
