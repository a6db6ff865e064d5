"""Fur as eyes aside see it: its hairs in the fine volume, and its texels on the shells of a page.

Both are light per area of skin, in the unit of L, slab by slab. A ray from a hair to the eye and one to the light meet
the same neighbours at first: `shared_depth` is what they share of their optical depths.
"""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from functools import partial

import numpy as np
from numpy.typing import NDArray

from furbake.cores import cores
from furbake.pelt.hairs.shown import BETWEEN, MAX_COVERAGE, MIN_SPREAD, slant
from furbake.pelt.hairs.strands import Coat
from furbake.pelt.hairs.volume import SOLID_SLAB, Volume, moved, pool
from furbake.pelt.light.beam import Beam
from furbake.pelt.light.fibre import THINNEST, Cylinders
from furbake.pelt.light.paths import BODY_RADIUS, FLAT
from furbake.pelt.light.scatter import between_hairs, sent
from furbake.pelt.light.slabs import Slabs, Unscattered
from furbake.pelt.pelt import Pelt

Array = NDArray[np.float64]
Single = NDArray[np.float32]

DARK = 1e-6
"""Least T that is distinguished from 0."""

CONTRAST = 1.75
"""Contrast of the texels' light on a page over the stored one: `CONTRAST` of web/fur/light/texels.ts."""

ASIDE = np.float32(0.86), np.float32(0.15)
"""Light that met one hair over the path tracer's, c₀ + c₁·max(cos φ, 0), φ between light and eye around the hair.

On balls in `teddy`, `sheep`, `bunny`, `fox` and `wolf`, by hairs in 64 texels, it is .93 to .98 of it without this and
.97 to 1.02 with it; 1.00 to 1.03 (1.00 to 1.03) where the eye is beside the light, .90 to .93 (.97 to 1.00) at 90° from
it, .76 to .98 (.84 to 1.07) opposite (40 pairs each).
"""

SHOWN_SIZE = 64
"""Texels a side that are composited at most: a page shows larger tiles by their smaller levels."""


class LitHairs:
    """Hairs of a fine volume under n lights, each a whole cylinder: it shades itself by the mean of it."""

    def __init__(
        self,
        fine: Volume,
        layers: int,
        size: int,
        lights: Array,
        coat: Coat,
        beta: float | None = BODY_RADIUS,
        *,
        coarse: bool = True,
    ) -> None:
        """fine : the oversampled volume of `layers` slabs of `size` × `size`; lights : (n, 3); beta : as of `Beam`

        coarse : light between hairs is scattered in half as many voxels a side as in the samples
        """
        self.layers, self.size, self.lights = layers, size, lights
        self.beam = Beam(fine, layers, size, beta)
        stored = self.beam.slabs()
        scale = even if coarse else np.asarray
        sigma, tangent = scale(stored.sigma), scale(stored.tangent)
        self.tangent = tangent / np.linalg.norm(tangent, axis=-1, keepdims=True)
        self.filled = np.float32(fine.height * SOLID_SLAB / coat.opacity) * fine.sigma.mean((1, 2)).astype(np.float32)
        self.along = [self.beam.along(light) for light in lights]
        with ThreadPoolExecutor(cores()) as workers:
            passed, floor = zip(*workers.map(partial(self.beam.reach, sides=False), lights), strict=True)
            pairs = workers.map(self.beam.caught, passed, self.along)
            caught, reaching = (scale(np.stack(each)) for each in zip(*pairs, strict=True))
        self.depths = [-np.log(np.maximum(each, DARK)) for each in passed]
        skin = 0.0 if beta is None else coat.skin
        light = Unscattered(lights, caught, reaching, pool(np.stack(floor), sigma.shape[-1]))
        slabs = Slabs(sigma, stored.thick, self.tangent)
        self.arriving = between_hairs(slabs, light, albedo=coat.albedo, skin=skin)

    def towards(self, eye: Array, some: NDArray[np.intp]) -> tuple[Array, Array, Array]:
        """Light of the slabs towards an eye under `some` of the lights, (m, K), that met one hair, and that met
        several, and what the eye sees of their hairs, (K,).
        """
        clear, hairs = self.beam.reach(eye, sides=False)[0], Cylinders(self.beam.along(eye))
        depth = -np.log(np.maximum(clear, DARK))
        see = clear * self.beam.breadth * np.maximum(hairs.sin_view, THINNEST) * np.float32(self.beam.slab)
        once = []
        for number in some:
            sin_light, turn = hairs.around(self.along[number], float(self.lights[number] @ eye))
            others = self.depths[number]
            seen = shared_depth(np.maximum(np.minimum(depth, others), 0), turn, self.filled)
            seen -= others
            np.exp(seen, out=seen)
            seen *= hairs.scattered(sin_light, turn)
            seen *= see
            seen /= ASIDE[0] + ASIDE[1] * np.maximum(turn, 0)
            once.append(_sums(seen, self.layers))
        onwards = np.maximum(sent(self.arriving, self.tangent, eye)[:, some], 0)
        blocks = pool(see.reshape(self.layers, -1, *see.shape[1:]).sum(1), onwards.shape[-1])
        more = (blocks * np.moveaxis(onwards, 1, 0)).mean((-1, -2), dtype=np.float64)
        return np.stack(once), more, _sums(see, self.layers)


class ShownTexels:
    """Texels of a pelt under n lights, as shells show them."""

    def __init__(self, pelt: Pelt, lights: Array, beta: float | None = BODY_RADIUS) -> None:
        """lights : (n, 3); beta : as of `Beam`"""
        size = min(pelt.size, SHOWN_SIZE)
        self.height, self.beta = pelt.height, FLAT if beta is None else beta
        self.coverage = np.minimum(pool(pelt.alpha.astype(np.float32) / 255, size), np.float32(MAX_COVERAGE))
        light = pelt.light(lights, BODY_RADIUS if beta is None else beta, CONTRAST)
        self.light = moved(pool(light, size), np.full(2, BETWEEN))
        self.slopes = np.gradient(pelt.drift, pelt.height / pelt.layers, axis=0) if pelt.layers > 1 else 0 * pelt.drift
        self.spread, self.open = pelt.spread or MIN_SPREAD, pelt.open

    def towards(self, eye: Array, some: NDArray[np.intp]) -> tuple[Array, float]:
        """Light of the slabs towards an eye under `some` of the lights, (m, K), and what it sees of all texels."""
        see = self.visible(eye)
        light = np.einsum("nkrc,krc->nk", self.light[some], see, dtype=np.float64) / see[0].size
        return light, float(see.mean((-1, -2), dtype=np.float64).sum())

    def visible(self, eye: Array) -> Single:
        """Visible share of the slabs per area of skin, (K, N, N), for an eye at v where they are.

        A shell hides 1 − (1 − α)^`slant`. What is above a point is met along a straight ray over a ball of radius β,
        as in `Rays`, and hairs diverge: shells hide 1 − (1 − α)^((β/(β + s))²) there, seen from straight above.
        """
        layers, size, _ = self.coverage.shape
        radius = self.beta + (np.arange(layers) + 0.5) / layers
        fewer = ((self.beta / radius) ** 2).astype(np.float32)[:, None, None]
        coverage = -np.expm1(np.log1p(-self.coverage) * fewer)
        across = float(np.sqrt(max(1 - eye[2] ** 2, 0)))
        way = eye[:2] / max(across, 1e-9) * self.height * size
        found = np.empty_like(self.coverage)
        for k, r in enumerate(radius):
            rise = np.sqrt(np.maximum(1 - (r / radius[k + 1 :] * across) ** 2, 0))
            t = radius[k + 1 :] * rise - r * eye[2]
            feet = self.beta * np.arctan2(t * across, r + t * eye[2])
            clear = np.log1p(-moved(coverage[k], np.full(2, BETWEEN))) * self.power(eye, k)
            own = -np.expm1(clear)
            depth = np.zeros_like(own)
            for above, (foot, up) in enumerate(zip(feet, rise, strict=True), k + 1):
                there = np.append(eye[:2] / max(across, 1e-9) * np.sqrt(1 - up * up), up)
                depth += np.log1p(-moved(coverage[above], way * foot + BETWEEN)) * self.power(there, above)
            found[k] = np.exp(depth) * own * np.float32(eye[2] * (r / self.beta) ** 2)
        return found

    def power(self, eye: Array, slab: int) -> np.float32:
        """Power of a slab for an eye at v where it is."""
        return np.float32(slant(eye, self.slopes[slab], self.spread, self.open))


def even(field: Single) -> Single:
    """Half as fine, (..., N, N) or vectors (..., N, N, 3): what is scattered often is smooth."""
    if field.shape[-1] == field.shape[-2]:
        return pool(field, field.shape[-1] // 2)
    return np.stack([pool(part, part.shape[-1] // 2) for part in np.moveaxis(field, -1, 0)], -1)


def shared_depth(depth: Single, cos_phi: Single, filled: Single) -> Single:
    """Optical depth that the rays from a hair to light and eye share, (K, N, N).

    depth : the lesser of the two rays'; cos_phi : of the angle φ between them around the hair; filled : (K,) share of
    the volume that hairs fill, about as parallel

    Seen along the hairs these are discs, and the rays part at φ. Two parallel rays x apart that meet discs of radius r
    share 1 − x/2r of them, so that no more than filled/(π·sin(φ/2)) is shared.
    """
    most = np.sqrt(np.maximum((1 - cos_phi) / 2, np.float32(1e-6)))
    most *= np.float32(np.pi)
    np.divide(filled[:, None, None], most, out=most)
    held_depth = np.minimum(depth, 2 * most)
    return np.asarray(held_depth * (1 - held_depth / np.maximum(4 * most, np.float32(1e-30))), np.float32)


def _sums(voxels: Single, layers: int) -> Array:
    """Sum over the fine slabs of each stored one of their means, (K,)."""
    return np.asarray(voxels.mean((-1, -2), dtype=np.float64).reshape(layers, -1).sum(1))
