"""Samples of a tile of fur: its strands in slabs, and their light under many directions."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from furbake.beside import Beside, Later
from furbake.options import BakeOptions
from furbake.pelt.hairs.shown import shown_slabs
from furbake.pelt.hairs.states import Fur, PeltState
from furbake.pelt.hairs.strands import Strands, grow
from furbake.pelt.hairs.volume import Volume, fine_shape, voxelise
from furbake.pelt.light.transport import LOWEST, LOWEST_FLAT, Beams, Setting, hemisphere, sample
from furbake.pelt.means import Measured, coarser, measure

Floats = NDArray[np.float64]
Single = NDArray[np.float32]


FINE_SHARE = 0.8
"""Share of the time that the samples of the fit take, for the progress."""

Bodies = tuple[Measured, ...]
"""Mean light of the slabs on bodies of other radii, and from below the horizon; () where it is not measured."""


@dataclass(frozen=True)
class Lighting:
    """Directions, the held-out ones among them, and L under each.

    lights : (n, 3), held_out : (n,) bool, samples : (n, K, N, N) float32
    """

    lights: Floats
    held_out: NDArray[np.bool_]
    samples: Single
    bodies: Bodies = ()


@dataclass(frozen=True)
class Sampled:
    """A state of the fur: the stored slabs, and the light in them."""

    state: PeltState
    volume: Volume
    lighting: Lighting


def grown(options: BakeOptions) -> tuple[Strands, Volume, Volume]:
    """Dry fur on no body: its strands, the oversampled volume and the slabs that are stored of it."""
    height = options.own_height
    strands = grow(options.coat, height, options.seed)
    fine = voxelise(strands, height, *fine_shape(options.layers, options.size, height), options.coat.opacity)
    return strands, fine, shown_slabs(fine, strands, options.layers, options.size)


def light(
    fine: Volume,
    options: BakeOptions,
    step: Callable[[float], None] = lambda fraction: None,
    held_out: int | None = None,
    beams: Beams | None = None,
    bodies: Later[Bodies] | None = None,
) -> Lighting:
    """Sample the oversampled volume under the lights of the fit and others between them, by default half as many.

    beams : as of `sample`; bodies : as of `on_bodies`, begun before
    """
    lights = directions(options, held_out)
    apart = np.arange(len(lights)) >= options.lights
    bodies = bodies or on_bodies(fine, options, Beside())
    samples = under(lights, fine, options, lambda fraction: step(FINE_SHARE * fraction), beams)
    measured = bodies.result()
    step(1.0)
    return Lighting(lights, apart, samples, measured)


def on_bodies(fine: Volume, options: BakeOptions, beside: Beside) -> Later[Bodies]:
    """Mean light of the slabs on bodies of other radii, as far as these options have it measured; fine : of a state."""
    if options.curves == "none" or options.flat:
        return Later(tuple, None)
    return beside.submit(
        measure, coarser(fine, options.layers, options.size), options.layers, options.size, options.coat
    )


def directions(options: BakeOptions, held_out: int | None = None) -> Floats:
    """Lights of the fit, then others between them, by default half as many, (n, 3)."""
    lowest = LOWEST_FLAT if options.flat else LOWEST
    fitted = hemisphere(options.lights, lowest=lowest)
    return np.concatenate([fitted, hemisphere(held_out or max(8, options.lights // 2), turn=1.0, lowest=lowest)])


def setting_of(options: BakeOptions) -> Setting:
    """Hairs, skin and body under the lights, as these options have it sampled."""
    return Setting(options.coat.albedo, options.coat.skin, options.flat)


def under(
    lights: Floats,
    fine: Volume,
    options: BakeOptions,
    step: Callable[[float], None] = lambda fraction: None,
    beams: Beams | None = None,
) -> Single:
    """L of the stored texels under `lights` (n, 3), (n, K, N, N), as these options have it sampled."""
    return sample(fine, options.layers, options.size, lights, setting_of(options), beams=beams, progress=step)


def options_of(fur: Fur, options: BakeOptions) -> BakeOptions:
    """Those by which a state is lit; mud has no curves of its own."""
    options = replace(options, coat=fur.coat)
    return replace(options, curves="none") if fur.state.dirt else options


def parts(step: Callable[[float], None], count: int) -> Iterator[Callable[[float], None]]:
    """Progress of `count` equal parts of a stage."""

    def part(number: int) -> Callable[[float], None]:
        return lambda fraction: step((number + fraction) / count)

    return map(part, range(count))


def sampled(
    fur: Fur,
    fine: Volume,
    options: BakeOptions,
    step: Callable[[float], None] = lambda fraction: None,
    beams: Beams | None = None,
    bodies: Later[Bodies] | None = None,
) -> Sampled:
    """A state of the fur as stored slabs, and the light in it.

    fine : its oversampled volume; beams, bodies : as of `light`
    """
    options = options_of(fur, options)
    lighting = light(fine, options, step, beams=beams, bodies=bodies)
    return Sampled(fur.state, shown_slabs(fine, fur.strands, options.layers, options.size, fur.mud), lighting)


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
