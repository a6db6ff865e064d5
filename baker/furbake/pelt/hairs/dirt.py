"""Dirt in the fur: mud that sticks to the hairs, the more the nearer the tips, lit with them as one volume.

Mud dries where it ran: a clod is a string of crumbs along a hair, thick in its middle, which glues the hairs around it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from furbake.pelt.hairs.ramp import RGB
from furbake.pelt.hairs.strands import Strands
from furbake.pelt.hairs.tiling import tile_noise
from furbake.pelt.hairs.volume import PLANES, SOLID_SLAB, Volume, cross_sections

Array = NDArray[np.float64]

MUD: RGB = (0.062, 0.038, 0.021)
"""Colour of the mud, linear Rec. 709."""

SIZES = (0.016, 0.055)
"""Radius of the smallest and the largest clod in its middle, shares of the fur's height."""

COVER = 5.5
"""Sum of the crumbs' cross-sections over the tile's area."""

CRUMBS, LENGTHS, ASIDE = 7, (0.08, 0.3), 0.5
"""Crumbs of a clod, how long it is at least and at most, shares of the hair, and how far they lie aside, radii."""

TOWARDS_TIPS = 2.0
"""Clods at a share s of a hair are as many as s to this power."""

MAX_CLODS = 20_000
"""Clods at most."""

PATCHES, PATCHINESS = 3, 0.5
"""Dirtier places along a side of the tile, and how much dirtier: spread of the logarithm."""


@dataclass(frozen=True)
class Crumbs:
    """Balls of mud, each on a hair.

    centre : (n, 3), radius : (n,) tile widths; hair : (n,) index of the hair
    tangent : (n, 3) unit direction of the fibre as which it scatters: one that lies down, each its own way, so that
        together they scatter as balls do, near enough
    """

    centre: Array
    radius: Array
    hair: NDArray[np.intp]
    tangent: Array

    def on(self, hairs: NDArray[np.bool_]) -> Crumbs:
        """Those on some of the hairs, (S,)."""
        kept = hairs[self.hair]
        return Crumbs(self.centre[kept], self.radius[kept], self.hair[kept], self.tangent[kept])


def crumbs(strands: Strands, height: float, seed: int, dirt: float = 1.0) -> Crumbs:
    """Crumbs on the hairs of fur of that height, tile widths: small clods many, large ones few.

    dirt : share of the dirty fur's clods that there are, 0 to 1
    """
    rng = np.random.default_rng([seed, 2])
    size = height * SIZES[0] * (SIZES[1] / SIZES[0]) ** rng.random(MAX_CLODS) ** 2
    along = np.linspace(-1.0, 1.0, CRUMBS)
    radius = size[:, None] * np.sqrt(1 - 0.8 * along**2) * rng.uniform(0.7, 1.2, (MAX_CLODS, CRUMBS))
    clods = 1 + int(np.searchsorted(np.cumsum((np.pi * radius**2).sum(1)), COVER))
    radius = radius[:clods]

    root = strands.points[:, 0, :2]
    likely = np.exp(PATCHINESS * tile_noise(root, PATCHES, rng))
    hair = np.repeat(rng.choice(len(root), len(radius), p=likely / likely.sum()), CRUMBS)
    middle, half = rng.random(len(radius)) ** (1 / (1 + TOWARDS_TIPS)), rng.uniform(*LENGTHS, len(radius)) / 2
    at = np.clip(middle[:, None] + half[:, None] * along, 0.0, 1.0).ravel() * (strands.points.shape[1] - 1)
    low = np.minimum(at.astype(np.int64), strands.points.shape[1] - 2)
    part = (at - low)[:, None]
    centre = (1 - part) * strands.points[hair, low] + part * strands.points[hair, low + 1]
    centre += ASIDE * radius.reshape(-1, 1) * rng.normal(0.0, 1.0, centre.shape)
    angle = rng.uniform(0.0, 2 * np.pi, radius.size)
    lying = np.stack([np.cos(angle), np.sin(angle), np.zeros(radius.size)], -1)
    some = CRUMBS * round(dirt * clods)
    return Crumbs(centre[:some], radius.ravel()[:some], hair[:some], lying[:some])


def soiled(clean: Volume, mud: Crumbs, opacity: float) -> Volume:
    """The volume with mud in it, which takes the place of the hairs. Its `tint` is the share of the mud in a voxel's σ.

    opacity : of solid mud, as `Coat.opacity` of hair
    """
    layers, size, _ = clean.sigma.shape
    fill = np.zeros((layers, size * size))
    across = np.zeros((layers, 3, size * size))
    for plane in range(layers * PLANES):
        z = (plane + 0.5) / (layers * PLANES) * clean.height
        square = mud.radius**2 - (mud.centre[:, 2] - z) ** 2
        cut = square > 0
        if not cut.any():
            continue
        upright = np.tile([0.0, 0.0, 1.0], (int(cut.sum()), 1))
        cover, voxel, _ = cross_sections(mud.centre[cut, :2], np.sqrt(square[cut]), upright, size)
        here = np.zeros(size * size)
        np.maximum.at(here, voxel.ravel(), cover.ravel())
        slab = plane // PLANES
        fill[slab] += here / PLANES
        for axis in range(3):
            along = cover * mud.tangent[cut, axis, None]
            across[slab, axis] += np.bincount(voxel.ravel(), along.ravel(), size * size)
    fill = fill.reshape(clean.sigma.shape)
    lying = np.moveaxis(across.reshape(layers, 3, size, size), 1, -1)
    lying /= np.maximum(np.linalg.norm(lying, axis=-1, keepdims=True), 1e-9)
    hair, mixed = clean.sigma * (1 - fill), fill * opacity / (clean.height * SOLID_SLAB)
    share = mixed / np.maximum(hair + mixed, 1e-12)
    tangent = (1 - share)[..., None] * clean.tangent + share[..., None] * lying
    tangent /= np.maximum(np.linalg.norm(tangent, axis=-1, keepdims=True), 1e-9)
    breadth = clean.breadth * (1 - fill) + mixed
    off_axis = None if clean.off_axis is None else clean.off_axis * (1 - share[..., None]).astype(np.float32)
    sigma, breadth, tangent, tint = (part.astype(np.float32) for part in (hair + mixed, breadth, tangent, share))
    return replace(clean, sigma=sigma, breadth=breadth, tangent=tangent, tint=tint, off_axis=off_axis)
