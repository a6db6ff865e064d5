"""Multiple scattering: light that reaches a hair from other hairs and from the skin, by discrete ordinates.

Light crosses the periodic slabs along 48 directions, order after order. A hair is a Lambertian cylinder also where
light meets it again: its D is a constant and a cosine around the hair (the first terms of the Fourier series of
sin φ + (π − φ)·cos φ = 4/π + (π/2)·cos φ + …), so that four numbers of what arrives say all that it scatters:

    φ = ∫ I·sin θ dω   and   F = ∫ I·ω dω   (ω towards where the light comes from)
    source towards v = ϖ/4π · [ (4/π)·φ + (π/2)·F⊥·v / sin(t, v) ],   extinction σ·sin(t, v)

All is linear in the light that comes in, and in the unit of L, so that it adds to single scattering as it is.
"""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from numpy.typing import NDArray

from furbake.cores import cores
from furbake.pelt.light.crossing import Crossing, hemisphere_rule
from furbake.pelt.light.fibre import sine
from furbake.pelt.light.slabs import Arriving, Scattered, Slabs, Unscattered

Array = NDArray[np.float64]
Single = NDArray[np.float32]

MAX_ORDERS = 40
SPENT = 0.03
"""The order that adds less than this share to all before it is the last; those after it are a geometric series."""

TOGETHER = 6
"""Directions that cross the slabs together; their sums are the same whichever thread adds them up."""

LOST = 0.01
"""Share of the sources' energy, over all lights, that may be left out: what varies so fast is evened out anyhow."""

LOST_FAINT = 1e-3
"""The same where light is evened out already. A bunny's M under lights from the zenith down to lz = −.4 has then 3 % of
error in its slabs' means above the horizon and 4 to 14 % below it, 5 % and 22 to 84 % with `LOST` of the sources."""

THINNED = 0.5
"""Exponent of `escape`: the part of a slab's extinction that T has already, since T leaves out what a hair does to its
own light. With 0.5 M is 0.86 to 1.04 of a path tracer's (bunny, fox, paper and sheep under lights
from 75° to 20°), with 1 it is 1.1 to 1.5 of that, with 0 0.72 to 0.75 (paper)."""


def scatter(slabs: Slabs, light: Unscattered, *, albedo: float, skin: float, faint: bool = False) -> Scattered:
    """Light that is scattered at least twice, for n lights.

    albedo, skin : shares of the light that a hair and the skin scatter, the skin evenly
    faint : some of the lights are much fainter than others, and count as much

    Lights from neighbouring directions come in much the same: the sources are written in as few of their principal
    components as `LOST` allows, and only those are scattered. With `faint` these are components of the slabs' means,
    each light's brought to the same strength, and `LOST_FAINT` is what may be left out of them.
    """
    basis, arriving = _principal(light, faint)
    medium = Medium(slabs, skin)
    return Scattered(basis, medium.all_orders(medium.entering(arriving), albedo))


def _principal(light: Unscattered, faint: bool) -> tuple[Single, Arriving]:
    """Shares (n, m) of the principal components of what arrives, and these; other fields are freed with this call."""
    count, layers, size = light.caught.shape[:3]
    fields = (light.caught, light.flux, light.floor)
    sources = np.concatenate([field.reshape(count, -1) for field in fields], 1)
    basis, back = _fewer(sources, layers, faint)
    parts = (back @ sources).reshape(-1, 4 * layers + 1, size, size)
    return basis, Arriving(
        phi=np.moveaxis(parts[:, :layers], 0, 1),
        flux=np.moveaxis(parts[:, layers:-1].reshape(-1, 3, layers, size, size), 0, 2),
        floor=parts[:, -1],
    )


def between_hairs(slabs: Slabs, light: Unscattered, *, albedo: float, skin: float) -> Arriving:
    """Light that arrives at the hairs after it has been scattered at least once; parameters as of `scatter`."""
    medium = Medium(slabs, skin)
    direct = medium.entering(Arriving(np.moveaxis(light.caught, 0, 1), np.moveaxis(light.flux, 0, 2), light.floor))
    found = Arriving(*(np.zeros_like(part) for part in (direct.phi, direct.flux, light.floor)))
    for arriving, _, weight in medium.orders(direct, albedo):
        for total, part in ((found.phi, arriving.phi), (found.flux, arriving.flux), (found.floor, arriving.floor)):
            np.add(total, part * np.float32(weight), out=total)
    return found


def sent(arriving: Arriving, tangent: Single, eye: Array) -> Single:
    """Light from the hairs towards an eye in this direction, ∫I·D dω, (K, B, N, N)."""
    return _sent(arriving.phi, _perpendicular(arriving.flux, tangent), sine(tangent, eye), eye)


def _perpendicular(flux: Single, tangent: Single) -> Single:
    """F⊥, (3, K, B, N, N)."""
    across = np.moveaxis(tangent, -1, 0)[:, :, None]
    return np.asarray(flux - across * (flux * across).sum(0))


def _sent(phi: Single, perpendicular: Single, width: Single, way: Array) -> Single:
    source = np.einsum("a,akbrc->kbrc", way.astype(np.float32), perpendicular)
    source *= np.float32(np.pi / 2) / width[:, None]
    source += np.float32(4 / np.pi) * phi
    return np.asarray(source)


def _fewer(sources: Single, layers: int, faint: bool) -> tuple[Single, Single]:
    """Matrices basis (n, m) and back (m, n): basis·back·sources is nearly what the sources of n lights are, m ≤ n."""
    seen, strength = sources, np.ones(len(sources), np.float32)
    if faint:
        seen = sources.reshape(len(sources), 4 * layers + 1, -1).mean(-1)
        strength = np.maximum(np.linalg.norm(seen, axis=1), np.float32(1e-12))
        seen = seen / strength[:, None]
    energy, vectors = np.linalg.eigh((seen @ seen.T).astype(np.float64))
    left_out = np.cumsum(np.maximum(energy, 0)) / max(energy.sum(), 1e-30)
    kept = vectors[:, left_out > (LOST_FAINT if faint else LOST)].astype(np.float32)
    return (kept * strength[:, None] if faint else kept), (kept / strength[:, None]).T if faint else kept.T


class Medium:
    """Slabs of hair over a skin that reflects evenly, and the directions in which light crosses them."""

    def __init__(self, slabs: Slabs, skin: float) -> None:
        self.sigma, self.thick, self.tangent, self.skin = slabs.sigma, slabs.thick, slabs.tangent, skin
        layers, size = slabs.sigma.shape[:2]
        self.aside = np.zeros((layers, 2)) if slabs.aside is None else slabs.aside * size
        self.directions, self.solid_angles = hemisphere_rule()
        self.crossings = dict[bytes, Crossing]()

    def escape(self) -> Single:
        """Share of what a voxel's hairs scatter evenly that leaves its slab, (K, N, N).

        The mean of sin θ·(1 − e^−τ)/τ over the sphere, 1 for thin slabs.
        """
        share = np.zeros_like(self.sigma)
        for way, solid_angle in zip(self.directions, self.solid_angles, strict=True):
            width = sine(self.tangent, way)
            depth = np.maximum(self.sigma * width * np.float32(self.thick / abs(way[2])), np.float32(1e-4))
            share += np.float32(solid_angle * 2 / np.pi**2) * width * -np.expm1(-depth) / depth
        return np.minimum(share, 1)

    def entering(self, direct: Arriving) -> Arriving:
        """Light of the lamps that hairs catch, counted where it enters the slabs, as scattered light is.

        It leaves a slab thinned by `escape`, and T of the lights has only `THINNED` of that.
        """
        escape: Single = (self.escape() ** THINNED)[:, None]
        return Arriving(direct.phi / escape, direct.flux / escape, direct.floor)

    def all_orders(self, arriving: Arriving, albedo: float) -> Single:
        """Sum over all orders of what the hairs send to the eye, and of u and v of the flux, (B, 3, K, N, N)."""
        layers, count, size = arriving.phi.shape[:3]
        found = np.zeros((count, 3, layers, size, size), np.float32)
        for arrived, to_eye, weight in self.orders(arriving, albedo):
            for part, more in enumerate((to_eye, *arrived.flux[:2])):
                found[:, part] += np.float32(weight) * more.swapaxes(0, 1)
        return found

    def orders(self, arriving: Arriving, albedo: float) -> Iterator[tuple[Arriving, Single, float]]:
        """Arriving light, light to the eye, and weight of each order; the last stands for all after it."""
        total = before = 0.0
        for _ in range(MAX_ORDERS):
            arriving, to_eye = self.scattered(arriving, albedo)
            size = float(np.abs(to_eye).sum())
            total += size
            if size <= SPENT * total:
                ratio = min(size / before, 0.95) if before else 0.0
                yield arriving, to_eye, 1 / (1 - ratio)
                return
            yield arriving, to_eye, 1.0
            before = size

    def scattered(self, arriving: Arriving, albedo: float) -> tuple[Arriving, Single]:
        """Light that arrives everywhere after it is scattered once more, and ∫I·D dω of it, towards the eye.

        A voxel's own light does not count: how a hair lights itself is in D already.
        """
        share = np.float32(albedo / (4 * np.pi))
        even = arriving.phi * (share * np.float32(4 / np.pi))
        perpendicular = _perpendicular(arriving.flux, self.tangent) * (share * np.float32(np.pi / 2))
        found = Arriving(np.zeros_like(arriving.phi), np.zeros_like(arriving.flux), np.zeros_like(arriving.floor))
        to_eye, irradiance = np.zeros_like(arriving.phi), arriving.floor.copy()
        with ThreadPoolExecutor(cores()) as pool:
            for travel in (-self.directions, self.directions):
                upward = travel[0, 2] > 0
                enters = irradiance * np.float32(self.skin / np.pi) if upward else found.floor
                groups = [slice(first, first + TOGETHER) for first in range(0, len(travel), TOGETHER)]

                def sweep(some: slice, ways: Array = travel, enters: Single = enters) -> tuple[Arriving, Single]:
                    return self.sweep(even, perpendicular, enters, ways[some], self.solid_angles[some])

                for part, seen in pool.map(sweep, groups):
                    found.phi[...] += part.phi
                    found.flux[...] += part.flux
                    to_eye += seen
                    if not upward:
                        irradiance += part.floor
        return found, to_eye

    def sweep(
        self, even: Single, perpendicular: Single, light: Single, ways: Array, solid_angles: Array
    ) -> tuple[Arriving, Single]:
        """Light of D directions of travel: to the slabs, with the irradiance of the end, and to the eye, (K, B, N, N).

        even, perpendicular : (K, B, N, N) and (3, K, B, N, N), φ and F⊥ times what hairs send on of them
        light : (B, N, N) enters below where the directions go up, above where they go down
        """
        layers, count, size = even.shape[:3]
        crossing = self.crossings.get(ways.tobytes())
        if crossing is None:
            crossing = Crossing.of(self.sigma, self.thick, self.tangent, self.aside, ways, solid_angles)
            self.crossings[ways.tobytes()] = crossing
        upward, towards = ways[0, 2] > 0, ways.astype(np.float32)
        apart = -(towards * solid_angles[:, None].astype(np.float32)).T
        phi, seen, flux = np.empty_like(even), np.empty_like(even), np.empty_like(perpendicular)
        shape = count, len(ways), size, size
        enters = np.broadcast_to(light[:, None], shape)
        light, other, source = np.empty((3, *shape), np.float32)
        flat = count, len(ways), size * size
        for step, k in enumerate(range(layers) if upward else range(layers - 1, -1, -1)):
            crossing.move(light if step else enters, step, other, light)
            np.multiply(light, crossing.width[k], out=other).sum(1, out=phi[k])
            np.multiply(light, crossing.to_eye[k], out=other).sum(1, out=seen[k])
            flux[:, k] = np.matmul(apart, light.reshape(flat)).reshape(count, 3, size, size).swapaxes(0, 1)
            across = perpendicular[:, k].reshape(3, count, -1).swapaxes(0, 1)
            np.matmul(towards, across, out=source.reshape(flat))
            source *= crossing.per_sine[k]
            source += even[k][:, None]
            light -= source
            light *= crossing.passes[k]
            light += source
        crossing.move(light, layers, other, light)
        floor = (light * np.abs(apart[2])[:, None, None]).sum(1)
        return Arriving(phi, flux, floor), seen
