"""Light through the fur: every layer sampled under many light directions (paper, section 3, "sampling each layer").

Directions are unit vectors (lu, lv, lz) towards the light in the tile's frame. The unit of L is
4π · radiance / (albedo · irradiance perpendicular to the light).

L = T·D + M: T is the transmittance along the bent paths of `paths` (straight ones on a flat patch), D the hair's own
scattering (`fibre`), M what is scattered more than once (`scatter`). How a hair shades itself is in D: T starts half a
fine slab from a voxel's middle and is divided by what its own hair leaves of it from there on. M is worked out in flat
slabs with the hairs as thin and as long as on the body.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from furbake.cores import cores
from furbake.pelt.hairs.drawn import through_own
from furbake.pelt.hairs.volume import Volume, doubled, joined, parted, pool, slab_means
from furbake.pelt.light.depth import Depth
from furbake.pelt.light.fibre import ABOVE, Cylinders, shown
from furbake.pelt.light.paths import BODY_RADIUS, lowest, spread, thinned
from furbake.pelt.light.scatter import Slabs, Unscattered, scatter

__all__ = ["BODY_RADIUS", "LOWEST", "LOWEST_FLAT", "hemisphere", "lowest", "sample", "sample_apart"]

Array = NDArray[np.float64]
Single = NDArray[np.float32]

LOWEST, LOWEST_FLAT = 0.02, 0.1
"""lz of the lowest light of a fit. None is below the horizon: polynomials follow no light there, only mean curves do.

Light along a flat patch crosses it without end and leaves it black at once, which no polynomial follows and no body
shows. Flat patches are sampled from a little higher.
"""

HIDDEN = 0.02
"""Weight of occluded hairs in the mean of their texel (visible = 1)."""

MERGED = 2
"""Fine slabs that a bent ray crosses as one where a stored slab has twice as many or more: T changes little between."""

CHUNK = 2**16
"""Voxels that are worked on together: a core's cache holds what is between."""

Fields = tuple[Single, Single, Single, Single]
Beams = Callable[["Beam", Array], Iterator[Fields]]
"""One light through the oversampled volume, as of `Beam`; all lights, in order."""

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
    for i, more in enumerate(multiple):
        single[i] += doubled(more)
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
    return single, doubled(multiple), None if less is None else doubled(less)


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
) -> tuple[Single, Single, Single | None]:
    """As `sample_apart`, M at half the resolution."""
    single = np.empty((len(lights), layers, size, size), np.float32)
    caught, reaching = np.empty((2, len(lights), layers, size // 2, size // 2), np.float32)
    floor = np.empty((len(lights), size // 2, size // 2), np.float32)
    beam = Beam(fine, layers, size, setting.radius)
    for i, fields in enumerate((beams or beams_here)(beam, lights)):
        single[i], caught[i], reaching[i], floor[i] = fields
        progress((i + 1) / len(lights) * SINGLE_SHARE)
    slabs, light = beam.slabs(), Unscattered(lights, caught, reaching, floor)
    albedo, skin = setting.albedo, 0.0 if setting.flat else setting.skin

    def more(share: float, some: slice | NDArray[np.intp]) -> Single:
        return scatter(slabs, light.of(some), albedo=share * albedo, skin=share * skin, faint=not setting.flat)

    multiple = more(1.0, slice(None))
    progress(1.0)
    return single, multiple, None if darker is None else more(*darker)


def mean_share(part: Single, whole: Single) -> Array:
    """Mean of each slab's `part` over that of its `whole`, (K, N, N) both → (K,); 1 where both are 0."""
    some, all_of_it = (field.sum((1, 2), dtype=np.float64) + 1e-9 for field in (part, whole))
    return np.asarray(some / all_of_it)


def transmitted(
    sigma: Single,
    width: Single,
    radius: Array,
    slab: float,
    light: Array,
    beta: float | None,
    *,
    aside: Array | None = None,
    merged: int = 1,
) -> tuple[Single, Single]:
    """T of voxels, (K, N, N), and the skin's irradiance, (N, N), under a light.

    sigma : (K, N, N) extinction across the hairs; width : sine between hairs and light, as of `sine`
    radius : (K,) of the hairs, tile widths; slab : thickness, tile widths
    beta : radius of the body, None: flat; aside : as of `Volume`
    merged : slabs that a ray crosses as one

    What a hair does to its own light is divided out of T: it is in D.
    """
    caught = sigma * width
    slabs = len(caught) // merged
    depth = Depth(joined(caught, merged), slab * merged, beta, None if aside is None else slab_means(aside, slabs))
    own = through_own(radius, caught.shape[-1], slab * merged / 2, mean_share(caught, sigma))
    del caught
    clear, floor = depth.through(light)
    clear = parted(clear, merged)
    clear /= own.astype(np.float32)[:, None, None]
    return clear, floor * np.float32(max(light[2], 0))


def mean_direction(parts: list[Single]) -> Single:
    """Unit vectors, (..., 3), of three components; upright where all are 0."""
    vectors = np.stack(parts, -1)
    vectors[..., 2] += 1e-9
    vectors /= np.linalg.norm(vectors, axis=-1, keepdims=True)
    return vectors


def beams_here(beam: Beam, lights: Array) -> Iterator[Fields]:
    """Fields of each light, with a thread for each core."""
    with ThreadPoolExecutor(cores()) as workers:
        yield from workers.map(beam, lights)


class Beam:
    """One light through the oversampled volume, before anything is scattered twice."""

    def __init__(self, fine: Volume, layers: int, size: int, beta: float | None) -> None:
        """beta : radius of the body; None: flat."""
        self.beta, self.layers, self.size, self.half, self.slab = beta, layers, size, size // 2, fine.slab
        self.aside, self.height = fine.aside, fine.height
        coverage = fine.coverage.astype(np.float32)
        clear = np.cumprod(1 - coverage[::-1], axis=0, dtype=np.float32)[::-1]
        above = np.concatenate([clear[1:], np.ones_like(clear[:1])])
        # Hairs that the eye sees through all that lies above count most in their texel.
        self.shares = np.maximum(coverage * (above + HIDDEN), np.float32(1e-6), dtype=np.float32)
        self.breadth, self.sigma = fine.breadth.astype(np.float32), fine.extinction.astype(np.float32)
        tangent = fine.tangent.astype(np.float32)
        if beta is not None:
            middle = (np.arange(len(self.sigma)) + 0.5) / len(self.sigma)
            tangent, longer = spread(tangent, middle, beta)
            self.breadth *= longer
            self.sigma *= longer
        self.axes = np.ascontiguousarray(np.moveaxis(tangent, -1, 0))
        self.from_above = Cylinders(self.along(ABOVE))
        self.seen = self._pooled(self.shares, self.size)
        self.hair: Single = np.maximum(self.stored(self.breadth), np.float32(1e-6))
        per_slab = len(self.sigma) // layers
        self.merged = MERGED if per_slab >= 2 * MERGED and per_slab % MERGED == 0 else 1
        self.radius = fine.radius

    def __call__(self, light: Array) -> Fields:
        """T·D averaged down, (K, N, N); T·sin θ and T on average over the hairs, (K, N/2, N/2); the skin's irradiance.

        A hair that the light runs along catches less of it and shades less: its σ counts times the sine between the
        two.
        """
        along = self.along(light)
        passed, skin = self._reach(light, along)
        return self.to_eye(passed, light, along), *self.caught(passed, along), pool(skin, self.half)

    def along(self, way: Array) -> Single:
        """Cosines between the hairs and a direction, (K, N, N)."""
        return np.asarray(np.tensordot(way.astype(np.float32), self.axes, 1))

    def to_eye(self, passed: Single, light: Array, along: Single) -> Single:
        """T·D averaged down, (layers, N, N); passed : T of the fine voxels; along : of the light."""
        single = np.empty((self.layers, self.size, self.size), np.float32)
        for some, fine in self._chunks():
            lit = self.from_above.lit(along[fine], float(light[2]), fine)
            lit *= passed[fine]
            lit *= self.shares[fine]
            np.divide(self._pooled(lit, self.size), self.seen[some], out=single[some])
        return single

    def caught(self, passed: Single, along: Single) -> tuple[Single, Single]:
        """T·sin θ and T on average over the hairs, (layers, N/2, N/2); parameters as of `to_eye`."""
        caught, reaching = np.empty((2, *self.hair.shape), np.float32)
        for some, fine in self._chunks():
            lit = passed[fine] * self.breadth[fine]
            np.divide(self.stored(lit), self.hair[some], out=reaching[some])
            lit *= shown(along[fine])
            np.divide(self.stored(lit), self.hair[some], out=caught[some])
        return caught, reaching

    def reach(self, light: Array) -> tuple[Single, Single]:
        """T of the fine voxels, (K, N, N), and the skin's irradiance, (N, N)."""
        return self._reach(light, self.along(light))

    def _reach(self, light: Array, along: Single) -> tuple[Single, Single]:
        return transmitted(
            self.sigma, shown(along), self.radius, self.slab, light, self.beta, aside=self.aside, merged=self.merged
        )

    def slabs(self) -> Slabs:
        """The stored slabs at half the resolution, as thin as hair is on the body, for `scatter`."""
        tangent = mean_direction([self.stored(self.breadth * axis) for axis in self.axes])
        sigma = self.stored(self.breadth)
        if self.beta is not None:
            sigma *= thinned((np.arange(self.layers) + 0.5) / self.layers, self.beta).astype(np.float32)[:, None, None]
        aside = None if self.aside is None else slab_means(self.aside, self.layers)
        return Slabs(sigma, self.height / self.layers, tangent, aside)

    def stored(self, fine: Single) -> Single:
        """Means over blocks of the fine voxels of whole stored slabs, at half the stored resolution."""
        return self._pooled(fine, self.half)

    def _pooled(self, fine: Single, size: int) -> Single:
        per_slab = len(self.sigma) // self.layers
        return pool(fine.reshape(-1, per_slab, *fine.shape[1:]).mean(1), size)

    def _chunks(self) -> Iterator[tuple[slice, slice]]:
        """Some stored slabs after the other, and the fine slabs that they are made of."""
        per_slab = len(self.sigma) // self.layers
        count = max(CHUNK // (per_slab * self.sigma[0].size), 1)
        for first in range(0, self.layers, count):
            last = min(first + count, self.layers)
            yield slice(first, last), slice(first * per_slab, last * per_slab)
