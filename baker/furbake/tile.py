"""The tile of fur, which no mesh has a say in: strands, slabs, samples, and the pelts that are fitted to them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from furbake.options import BakeOptions
from furbake.pelt.basis import PTM, Basis
from furbake.pelt.curves import Curves, unit
from furbake.pelt.eigen import eigen, eigen_of_slabs
from furbake.pelt.fill import fill, fill_directions
from furbake.pelt.fit import Judge, fit, relight
from furbake.pelt.means import Measured, mean_light, measure, shared, tables
from furbake.pelt.multiple import Multiple, multiple_of
from furbake.pelt.pelt import Pelt, State
from furbake.pelt.quantise import byte_range, dequantise, gram, quantise, signed_bytes, srgb_bytes, unit_bytes
from furbake.pelt.states import Fur
from furbake.pelt.strands import Strands, grow
from furbake.pelt.transport import BODY_RADIUS, LOWEST, LOWEST_FLAT, hemisphere, sample
from furbake.pelt.volume import Volume, coarsen, fine_shape, voxelise

Floats = NDArray[np.float64]
Single = NDArray[np.float32]


FINE_SHARE = 0.8
"""Share of the time that the samples of the fit take, for the progress."""


@dataclass(frozen=True)
class Lighting:
    """Directions, which of them the fit does not see, and L under each of them.

    lights : (n, 3), held_out : (n,) bool, samples : (n, K, N, N) float32
    bodies : mean light of the slabs on bodies of other radii, and from below the horizon; none where it isn't asked for
    """

    lights: Floats
    held_out: NDArray[np.bool_]
    samples: Single
    bodies: tuple[Measured, ...] = ()


@dataclass(frozen=True)
class Sampled:
    """A state of the fur: the stored slabs, and the light in them."""

    state: State
    volume: Volume
    lighting: Lighting


def grown(options: BakeOptions) -> tuple[Strands, Volume, Volume]:
    """Dry fur on no body: its strands, the oversampled volume and the slabs that are stored of it."""
    height = options.own_height
    strands = grow(options.coat, height, options.seed)
    fine = voxelise(strands, height, *fine_shape(options.layers, options.size, height), options.coat.opacity)
    return strands, fine, coarsen(fine, options.layers, options.size)


def light(
    fine: Volume,
    options: BakeOptions,
    step: Callable[[float], None] = lambda fraction: None,
    held_out: int | None = None,
) -> Lighting:
    """Sample the oversampled volume under the lights of the fit and others between them, by default half as many."""
    lowest = LOWEST_FLAT if options.flat else LOWEST
    fitted = hemisphere(options.lights, lowest=lowest)
    others = hemisphere(held_out or max(8, options.lights // 2), turn=1.0, lowest=lowest)
    lights = np.concatenate([fitted, others])
    apart = np.arange(len(lights)) >= len(fitted)
    if options.curves == "none" or options.flat:
        return Lighting(lights, apart, under(lights, fine, options, step))
    samples = under(lights, fine, options, lambda fraction: step(FINE_SHARE * fraction))
    bodies = measure(fine, options.layers, options.size, options.coat)
    step(1.0)
    return Lighting(lights, apart, samples, bodies)


def under(
    lights: Floats, fine: Volume, options: BakeOptions, step: Callable[[float], None] = lambda fraction: None
) -> Single:
    """L of the stored texels under `lights` (n, 3), (n, K, N, N), as these options have it sampled."""
    coat, layers, size = options.coat, options.layers, options.size
    return sample(fine, layers, size, lights, albedo=coat.albedo, skin=coat.skin, flat=options.flat, progress=step)


def parts(step: Callable[[float], None], count: int) -> Iterator[Callable[[float], None]]:
    """Progress of `count` equal parts of a stage."""

    def part(number: int) -> Callable[[float], None]:
        return lambda fraction: step((number + fraction) / count)

    return map(part, range(count))


def sampled(
    fur: Fur, fine: Volume, options: BakeOptions, step: Callable[[float], None] = lambda fraction: None
) -> Sampled:
    """A state of the fur as stored slabs, and the light in it; fine : its oversampled volume."""
    options = replace(options, coat=fur.coat)
    # Mud has no curves of its own.
    lighting = light(fine, replace(options, curves="none") if fur.state.dirt else options, step)
    return Sampled(fur.state, coarsen(fine, options.layers, options.size), lighting)


def fit_pelt(volume: Volume, lighting: Lighting, options: BakeOptions) -> tuple[Pelt, dict[str, Any]]:
    """Coefficients, bytes and the figures that `bake.json` reports, of dry fur alone."""
    return fit_pelts([Sampled(State(), volume, lighting)], options)[0]


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
    scale, bias = byte_range(np.concatenate(filled), alphas)
    found = []
    for state, fitted, stored, own, mean, multiple in zip(
        states, coefficients, filled, weights, means, multiples, strict=True
    ):
        volume, alpha = state.volume, state.volume.coverage
        dirty = state.state.dirt > 0
        codes = quantise(stored, scale, bias, gram(basis(seen), mean))
        colour = options.ramp.colour(volume.tint, volume.hue) if options.colour_plane and not dirty else None
        pelt = Pelt(
            codes=codes,
            alpha=unit_bytes(alpha),
            tint=unit_bytes(fill(volume.tint[..., None], alpha)[..., 0]),
            colour=None if colour is None else srgb_bytes(fill(colour, alpha)),
            scale=scale,
            bias=bias,
            kind=basis.kind,
            degree=basis.degree,
            matrix=basis.matrix,
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
        exact, whole, bytes_ = (
            relight(some, basis, unseen, there) for some in (fitted, stored, dequantise(codes, scale, bias))
        )
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
    """Curves for all states, and the weights of each. Mud's share is told by texel: a dirty state has the first's."""
    lean = unit(states[0].volume.drift[-1])
    clean = [state for state in states if not state.state.dirt] or list(states[:1])
    each = [tables(own_light(state), state.lighting.bodies, lean) for state in clean]
    curves, weights = shared(each, [state.volume.coverage.mean((1, 2)) for state in clean], lean)
    of_clean = dict(zip(map(id, clean), weights, strict=True))
    return curves, [of_clean.get(id(state), weights[0]) for state in states]


def several(
    states: Sequence[Sampled], curves: Curves | None, weights: Sequence[Floats | None], options: BakeOptions
) -> list[Multiple | None]:
    """What of the states' light has met several hairs. A dirty state has the first's, as it has its weights."""
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


def write_samples(archive: BinaryIO, dry: Sampled, strands: Strands) -> None:
    """The physics of the dry fur for others to check, as a NumPy archive."""
    volume, lighting = dry.volume, dry.lighting
    np.savez_compressed(
        archive,
        sigma=volume.sigma,
        tangent=volume.tangent,
        tint=volume.tint,
        height=volume.height,
        lights=lighting.lights,
        held_out=lighting.held_out,
        L=lighting.samples,
        strands=strands.points,
        radius=strands.radius,
    )
