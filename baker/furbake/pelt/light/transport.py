"""Light through the fur: every layer sampled under many light directions (paper, section 3, "sampling each layer").

Directions are unit vectors (lu, lv, lz) towards the light in the tile's frame. The unit of L is
4π · radiance / (albedo · irradiance perpendicular to the light).

L = T·D + M: T is the transmittance along the bent paths of `paths` (straight ones on a flat patch), D the scattering of
the side of the hair that is seen (`fibre`, `sides`), M what is scattered more than once (`scatter`). How a hair shades
itself is in D: T starts half a fine slab from a voxel's middle and is divided by what the voxel's own hair leaves of it
from there on. M is worked out in flat slabs with the hairs as thin and as long as on the body.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from furbake.cores import cores
from furbake.pelt.hairs.volume import Volume
from furbake.pelt.light.beam import Beam, Fields
from furbake.pelt.light.paths import BODY_RADIUS, lowest
from furbake.pelt.light.scatter import scatter
from furbake.pelt.light.slabs import Unscattered

__all__ = ["BODY_RADIUS", "LOWEST", "LOWEST_FLAT", "hemisphere", "lowest", "sample", "sample_apart"]

Array = NDArray[np.float64]
Single = NDArray[np.float32]

LOWEST, LOWEST_FLAT = 0.02, 0.1
"""lz of the lowest light of a fit. None is below the horizon: polynomials follow no light there, only mean curves do.

Light along a flat patch crosses it without end and leaves it black at once, which no polynomial follows and no body
shows. Flat patches are sampled from a little higher.
"""

Beams = Callable[[Beam, Array], Iterator[Fields]]
"""One light through the oversampled volume, as of `Beam`; all lights, in order."""

AT_A_TIME = 8
"""Lights for which cores are counted anew."""

SINGLE_SHARE = 0.8
"""Share of the time that single scattering takes, for the progress."""


def hemisphere(count: int, turn: float = 0.0, lowest: float = LOWEST) -> Array:
    """`count` evenly spread directions with lz ≥ `lowest`, (count, 3): a Fibonacci spiral turned by `turn` radians."""
    i = np.arange(count) + 0.5
    z = lowest + (1 - lowest) * (1 - i / count)
    angle = np.pi * (3 - np.sqrt(5)) * i + turn
    across = np.sqrt(1 - z * z)
    return np.stack([across * np.cos(angle), across * np.sin(angle), z], -1)


@dataclass(frozen=True)
class Setting:
    """Hairs and skin under the lights, and the body below them.

    albedo, skin : shares of the light that hairs and skin scatter on; L is in units of the former
    flat : without the curve of the body, over black skin: a patch that other renderers can check
    beta : radius of the body, lengths of its fur
    """

    albedo: float = 0.85
    skin: float = 0.25
    flat: bool = False
    beta: float = BODY_RADIUS

    @property
    def radius(self) -> float | None:
        """Radius of the body, lengths of its fur; None where it is flat."""
        return None if self.flat else self.beta


def sample(
    fine: Volume,
    layers: int,
    size: int,
    lights: Array,
    setting: Setting = Setting(),
    *,
    beams: Beams | None = None,
    progress: Callable[[float], None] = lambda fraction: None,
) -> Single:
    """L of every stored texel under every light, (n, layers, size, size) float32: T·D + M of `sample_apart`;
    T·D by way of `beams`, or here.
    """
    single, multiple, _ = _apart(fine, layers, size, lights, setting, beams=beams, progress=progress)
    for number, several in enumerate(multiple):
        single[number] += several
    return single


def sample_apart(
    fine: Volume,
    layers: int,
    size: int,
    lights: Array,
    setting: Setting = Setting(),
    *,
    darker: tuple[float, NDArray[np.intp]] | None = None,
    progress: Callable[[float], None] = lambda fraction: None,
) -> tuple[Single, Single, Single | None]:
    """T·D and M of every stored texel under every light, (n, layers, size, size) float32 each.

    fine : the oversampled volume; results are averaged down
    lights : (n, 3) as low as `lowest(beta)`; lower ones reach nothing
    darker : share of albedo and skin, and indices of lights under which M is sampled once more with these
    """
    single, multiple, less = _apart(fine, layers, size, lights, setting, darker=darker, progress=progress)
    return single, np.stack(list(multiple)), None if less is None else np.stack(list(less))


def _apart(
    fine: Volume,
    layers: int,
    size: int,
    lights: Array,
    setting: Setting,
    *,
    darker: tuple[float, NDArray[np.intp]] | None = None,
    beams: Beams | None = None,
    progress: Callable[[float], None],
) -> tuple[Single, Iterator[Single], Iterator[Single] | None]:
    """As `sample_apart`, M light by light."""
    single = np.empty((len(lights), layers, size, size), np.float32)
    beam = Beam(fine, layers, size, setting.radius)
    caught, reaching = np.empty((2, len(lights), layers, beam.even, beam.even), np.float32)
    floor = np.empty((len(lights), beam.even, beam.even), np.float32)
    for i, fields in enumerate((beams or beams_here)(beam, lights)):
        single[i], caught[i], reaching[i], floor[i] = fields
        progress((i + 1) / len(lights) * SINGLE_SHARE)
    slabs, light = beam.slabs(), Unscattered(lights, caught, reaching, floor)
    albedo, skin = setting.albedo, 0.0 if setting.flat else setting.skin

    def more(share: float, some: slice | NDArray[np.intp]) -> Iterator[Single]:
        found = scatter(slabs, light.of(some), albedo=share * albedo, skin=share * skin, faint=not setting.flat)
        return (beam.several(found.under(number)) for number in range(len(found.shares)))

    multiple = more(1.0, slice(None))
    progress(1.0)
    return single, multiple, None if darker is None else more(*darker)


def beams_here(beam: Beam, lights: Array, busy: Callable[[], int] = lambda: 0) -> Iterator[Fields]:
    """Fields of each light, with a thread for each core but those that are busy with something else."""
    for first in range(0, len(lights), AT_A_TIME):
        with ThreadPoolExecutor(max(1, cores() - busy())) as workers:
            yield from workers.map(beam, lights[first : first + AT_A_TIME])
