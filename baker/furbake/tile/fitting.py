"""Pelts fitted to the samples of a tile of fur."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from furbake.options import BakeOptions
from furbake.pelt.curves import Curves, lean_direction
from furbake.pelt.hairs.states import PeltState
from furbake.pelt.hairs.volume import Volume
from furbake.pelt.light.transport import BODY_RADIUS
from furbake.pelt.means import Measured, mean_light, shared, tables
from furbake.pelt.multiple import Multiple, multiple_of
from furbake.pelt.pelt import Pelt
from furbake.pelt.texels.basis import PTM, Basis
from furbake.pelt.texels.eigen import eigen, eigen_of_slabs
from furbake.pelt.texels.fill import fill, fill_directions
from furbake.pelt.texels.fit import Judge, fit, relight
from furbake.pelt.texels.quantise import (
    byte_range,
    gram,
    quantise,
    signed_bytes,
    srgb_bytes,
    step_of,
    steps,
    unit_bytes,
)
from furbake.tile.lighting import Lighting, Sampled

Floats = NDArray[np.float64]
Single = NDArray[np.float32]


def fit_pelt(volume: Volume, lighting: Lighting, options: BakeOptions) -> tuple[Pelt, dict[str, Any]]:
    """Coefficients, bytes and the figures that `bake.json` reports, of dry fur alone."""
    return fit_pelts([Sampled(PeltState(), volume, lighting)], options)[0]


def fit_pelts(states: Sequence[Sampled], options: BakeOptions) -> list[tuple[Pelt, dict[str, Any]]]:
    """As `fit_pelt`, of several states of the same fur under the same lights.

    They have one basis, one λ and Ω, and the same curves; each has weights of its own, a dirty one those of the first.
    """
    held_out, lights = states[0].lighting.held_out, states[0].lighting.lights
    seen, unseen = lights[~held_out], lights[held_out]
    samples = [state.lighting.samples[~held_out] for state in states]
    alphas = np.concatenate([state.volume.coverage for state in states])
    joined = samples[0] if len(states) == 1 else np.concatenate(samples, axis=1)
    curves, weights = (None, [None] * len(states)) if options.curves == "none" else mean_curves(states)
    multiples = several(states, curves, weights, options)
    means = [None if curves is None or w is None else curves.mean(seen, w) for w in weights]
    of_all = None if curves is None else np.concatenate([mean for mean in means if mean is not None], axis=1)
    basis = choose_basis(joined, alphas, seen, options, of_all)
    coefficients = [fit(part, basis, seen, mean) for part, mean in zip(samples, means, strict=True)]
    filled = [fill(part, state.volume.coverage) for part, state in zip(coefficients, states, strict=True)]
    step = step_of(options.bits)
    scale, bias = byte_range(np.concatenate(filled), alphas, 256 - step)
    found = []
    for state, fitted, stored, own, mean, multiple in zip(
        states, coefficients, filled, weights, means, multiples, strict=True
    ):
        volume, alpha = state.volume, state.volume.coverage
        each = steps(alpha, step)
        dirty = state.state.dirt > 0
        codes = quantise(stored, scale, bias, gram(basis(seen), mean), 256 - step, each)
        colour = options.ramp.colour(volume.tint, volume.hue) if options.colour_plane and not dirty else None
        pelt = Pelt(
            codes=codes,
            alpha=unit_bytes(alpha),
            tint=unit_bytes(fill(volume.tint[..., None], alpha)[..., 0], each),
            colour=None if colour is None else srgb_bytes(fill(colour, alpha)),
            scale=scale,
            bias=bias,
            basis=basis,
            drift=volume.drift,
            height=volume.height,
            ramp=options.ramp,
            direction=signed_bytes(fill_directions(volume.tangent, alpha)) if options.directions else None,
            curves=curves,
            weights=own,
            multiple=multiple,
            state=state.state,
        )
        judge = Judge(state.lighting.samples[held_out], alpha, np.ones_like(alpha) if dirty else volume.tint)
        there = pelt.mean(unseen)
        exact, whole, bytes_ = (relight(some, basis, unseen, there) for some in (fitted, stored, pelt.values))
        quantised = judge.figures(bytes_)
        figures = judge.figures(exact) | {
            "psnr_quantised": quantised["psnr"],
            "psnr_quantised_composite": quantised["psnr_composite"],
            "psnr_quantisation": judge.between(bytes_, whole),
            "bound": judge.bound(basis.coefficients),
        }
        found.append((pelt, figures))
    return found


def mean_curves(states: Sequence[Sampled]) -> tuple[Curves, list[Floats]]:
    """Curves for all states, and the weights of each. A dirty state has the first's: mud is stored by texel."""
    lean = lean_direction(states[0].volume.drift[-1])
    clean = [state for state in states if not state.state.dirt] or list(states[:1])
    each = [tables(own_light(state), state.lighting.bodies, lean) for state in clean]
    curves, weights = shared(each, [state.volume.coverage.mean((1, 2)) for state in clean], lean)
    of_clean = dict(zip(map(id, clean), weights, strict=True))
    return curves, [of_clean.get(id(state), weights[0]) for state in states]


def several(
    states: Sequence[Sampled], curves: Curves | None, weights: Sequence[Floats | None], options: BakeOptions
) -> list[Multiple | None]:
    """Light of the states that has met several hairs. A dirty state has the first's, as it has its weights."""
    found = list[Multiple | None]()
    for state, own in zip(states, weights, strict=True):
        if curves is None or own is None or not state.lighting.bodies:
            found.append(found[0] if found else None)
            continue
        volume = state.volume
        colour = options.ramp.colour(volume.tint, volume.hue) if options.colour_plane else None
        found.append(multiple_of(state.lighting.bodies, curves, own, volume, colour))
    return found


def own_light(state: Sampled) -> Measured:
    """Mean light of the slabs in the samples of the fit."""
    lighting = state.lighting
    seen = ~lighting.held_out
    return Measured(BODY_RADIUS, lighting.lights[seen], mean_light(lighting.samples[seen], state.volume.coverage))


def choose_basis(
    samples: Single, alpha: Floats, lights: Floats, options: BakeOptions, mean: Floats | None = None
) -> Basis:
    """The paper's polynomial, or the light curves that suit this fur best; mean : (n, K) curves that multiply them."""
    if options.basis == "ptm":
        return PTM
    if mean is None:
        return eigen(samples.reshape(len(samples), -1), alpha.ravel(), lights, options.coefficients)
    return eigen_of_slabs(samples, alpha, lights, mean, options.coefficients)
