"""The fur cut from the side: a fin's texture, lit from all around and fitted with a polynomial of its own.

A fin's frame is t (along the fin: the tile's v, along which hairs lean), n (out of the skin) and w = t × n (the tile's
u), where the eye is. Its texels are a row of whole tufts, `THICKNESS` deep, projected along w onto the plane of t, n.

Light is that of the whole fur, in the same unit. T is the transmittance of the optical depth from the light to the
hair, as in `transport`, at half the resolution and without the lamp's width, which six numbers cannot tell. M is
scattered as in `scatter`, coarser still. D and M are what the eye above sees, as in the shells: those show their light
from above at the outline, too, and beside them the fin's own view would be half as bright under a high lamp.
"""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from furbake.cores import cores
from furbake.pelt.curves import at_heights
from furbake.pelt.hairs.dirt import Crumbs, soiled
from furbake.pelt.hairs.drawn import extinction
from furbake.pelt.hairs.strands import Coat, Strands
from furbake.pelt.hairs.volume import Volume, pool, voxelise
from furbake.pelt.light.beam import mean_direction, transmitted
from furbake.pelt.light.fibre import cylinder, sine
from furbake.pelt.light.paths import BODY_RADIUS
from furbake.pelt.light.scatter import scatter
from furbake.pelt.light.slabs import Slabs, Unscattered
from furbake.pelt.pelt import FinPelt, Pelt
from furbake.pelt.texels.basis import PTM, harmonics
from furbake.pelt.texels.fill import fill
from furbake.pelt.texels.fit import fit
from furbake.pelt.texels.quantise import byte_range, gram, quantise, srgb_bytes, unit_bytes

Array = NDArray[np.float64]
Single = NDArray[np.float32]

THICKNESS = 0.25
"""Depth of the row of tufts, tile widths."""

EYE = np.array([1.0, 0.0, 0.0])
"""w in the tile's frame."""

FIN_FRAME = [1, 2, 0]
"""Components of a vector of the tile's frame along t, n and w."""

MAX_ROWS = 64

MAX_VOXELS = 2**22
"""Voxels of the tufts up to which they are half a texel wide; beyond it they are a texel wide."""

HIDDEN = 1e-3
"""Voxels of which the eye sees less are left out."""

EVEN = 4
"""M is this much coarser than the texels: it is smooth."""


@dataclass(frozen=True)
class SideView:
    """One tile along the fin and the fur's height, W × H texels, row 0 at the roots; periodic along the fin.

    alpha, tint, hue : (H, W) 0..1
    light : (n, H, W) L under each light
    """

    alpha: Array
    tint: Array
    hue: Array
    light: Array


def polynomial(lights: Array) -> Array:
    """φ of a fin, lights (n, 3) in the tile's frame → (n, 6)."""
    return PTM(lights[:, FIN_FRAME])


def fin_shape(size: int, height: float) -> tuple[int, int]:
    """Rows and columns of the texture: the tile's texels along the fin, about square ones, rows a power of two."""
    return int(np.clip(2 ** round(np.log2(size * height)), 8, min(size, MAX_ROWS))), size


def side_view(
    strands: Strands,
    fine: Volume,
    layers: int,
    size: int,
    lights: Array,
    coat: Coat,
    *,
    flat: bool = False,
    beta: float = BODY_RADIUS,
    height: float | None = None,
    mud: Crumbs | None = None,
) -> SideView:
    """A row of the tile's tufts seen from w, in the light that the whole fur lets through.

    fine : the oversampled volume; layers, size : slabs and texels per side of what is stored of it
    lights : (n, 3) in the tile's frame
    coat : for its opacity, albedo and skin; flat, beta : as of `transport.Setting`
    height : of the fur for which the texture has its rows, tile widths: that of the dry fur in all of its states
    mud : on the strands; then `tint` is its share
    """
    rows, columns = fin_shape(size, height or fine.height)
    medium = WholeFur(fine, layers, size, coat, None if flat else beta)
    slabs = medium.slabs * -(-rows // medium.slabs)
    width = size * (2 if slabs * (2 * size) ** 2 <= MAX_VOXELS else 1)
    row = in_the_row(strands)
    tufts = voxelise(strands.some(row), fine.height, slabs, width, coat.opacity)
    if mud is not None:
        tufts = soiled(tufts, mud.on(row), coat.opacity)
    shares = seen_from_the_side(tufts)
    upright, along = overlap(len(shares), rows), overlap(shares.shape[1], columns)

    def texels(voxels: Array) -> Array:
        """Means of (K, N) over texels, (H, W)."""
        return np.asarray(upright @ voxels @ along.T)

    alpha = texels(shares.sum(2))
    tint, hue = (texels((shares * part).sum(2)) / np.maximum(alpha, 1e-9) for part in (tufts.tint, tufts.hue))
    return SideView(alpha, tint, hue, medium.light(tufts, shares, lights, rows))


def in_the_row(strands: Strands) -> NDArray[np.bool_]:
    """Which hairs are rooted in a strip of the tile, (S,). They are whole: a cut through the volume chops some."""
    off = np.abs(strands.points[:, 0, 0] % 1.0 - 0.5)
    return np.asarray(off <= max(THICKNESS / 2, float(off.min())))


def seen_from_the_side(volume: Volume) -> Array:
    """Visible share of every voxel from w, through those before it: α·Π(1 − α), (K, N, N)."""
    size = volume.sigma.shape[2]
    coverage = -np.expm1(-volume.sigma * sine(volume.tangent, EYE) / size)
    clear = np.cumprod(1 - coverage[..., ::-1], axis=-1)[..., ::-1]
    return np.asarray(coverage * np.concatenate([clear[..., 1:], np.ones_like(clear[..., :1])], -1))


class WholeFur:
    """The whole fur at half the fine resolution, and coarser where light is scattered again."""

    def __init__(self, fine: Volume, layers: int, size: int, coat: Coat, beta: float | None) -> None:
        """beta : radius of the body, None: flat."""
        self.size, self.beta, self.height = size, beta, fine.height
        self.albedo, self.skin = coat.albedo, 0.0 if beta is None else coat.skin
        self.slabs = halved(len(fine.sigma))
        self.even = halved(halved(self.slabs) if self.slabs > layers else self.slabs), max(size // EVEN, 2)
        self.breadth, self.radius = self._coarse(fine.breadth), fine.radius.reshape(self.slabs, -1).mean(1)
        self.sigma = extinction(self.breadth, self.radius)
        self.tangent = mean_direction([self._coarse(fine.breadth * fine.tangent[..., axis]) for axis in range(3)])

    def light(self, tufts: Volume, shares: Array, lights: Array, rows: int) -> Array:
        """L of the tufts' texels, (n, rows, N): means over what is seen of them, by `shares` of their voxels."""
        weight = self._fine(shares)
        voxel = np.nonzero(weight > HIDDEN)
        slab, row, _ = voxel
        seen, count = weight[voxel], len(weight)
        direction = mean_direction([self._fine(shares * tufts.tangent[..., axis])[voxel] for axis in range(3)])
        behind = slab * self.slabs // count, *voxel[1:]
        hair: Single = np.maximum(self._even(self.breadth), np.float32(1e-6))

        def beam(light: Array) -> tuple[Array, Single, Single, Single]:
            """T·D summed over what is seen, (K·N,), and what `scatter` takes: caught, reaching and the skin's light."""
            width = sine(self.tangent, light)
            thick = self.height / self.slabs
            clear, skin = transmitted(self.sigma, width, self.radius, thick, light, self.beta)
            lambert = seen * clear[behind] * cylinder(direction, light)
            single = np.asarray(np.bincount(slab * self.size + row, lambert, count * self.size), np.float64)
            lit: Single = self.breadth * clear
            return single, self._even(lit * width) / hair, self._even(lit) / hair, pool(skin, self.even[1])

        with ThreadPoolExecutor(cores()) as workers:
            single, caught, reaching, floor = (np.stack(part) for part in zip(*workers.map(beam, lights), strict=True))
        tangent = mean_direction([self._even(self.breadth * self.tangent[..., axis]) for axis in range(3)])
        several = scatter(
            Slabs(self._even(self.breadth), self.height / self.even[0], tangent),
            Unscattered(lights, caught, reaching, floor),
            albedo=self.albedo,
            skin=self.skin,
            faint=self.beta is not None,
        )
        where = self._even(weight) + np.float32(1e-6)
        multiple = (several.seen * where).sum(3) / where.sum(2)

        upright = overlap(count, rows)
        total = np.bincount(slab * self.size + row, seen, count * self.size).reshape(count, self.size)
        once = (upright @ single.reshape(-1, count, self.size)) / np.maximum(upright @ total, 1e-9)
        high, wide = between(self.even[0], rows), between(self.even[1], self.size, periodic=True)
        return np.asarray(once + high @ multiple @ wide.T)

    def _fine(self, tufts: Array) -> Single:
        """Means over the voxels of a texel, in the tufts' own slabs."""
        return pool(np.asarray(tufts, np.float32), self.size)

    def _coarse(self, fine: Array) -> Single:
        """Means over blocks of fine voxels."""
        blocks = np.asarray(fine, np.float32).reshape(self.slabs, -1, *fine.shape[1:]).mean(1)
        return pool(blocks, self.size)

    def _even(self, values: Single) -> Single:
        """Means over still larger blocks."""
        slabs, size = self.even
        return pool(values.reshape(slabs, -1, *values.shape[1:]).mean(1), size)


def halved(count: int) -> int:
    """Half of an even number, an odd one as it is."""
    return count // 2 if count % 2 == 0 else count


def overlap(count: int, wanted: int) -> Array:
    """Matrix (wanted, count) that takes means of `count` equal cells over `wanted` equal cells."""
    low, high = (np.arange(count) + side for side in (0.0, 1.0))
    first, last = ((np.arange(wanted) + side) * count / wanted for side in (0.0, 1.0))
    shared = np.minimum(high, last[:, None]) - np.maximum(low, first[:, None])
    return np.asarray(np.maximum(shared, 0.0) * wanted / count)


def between(count: int, wanted: int, periodic: bool = False) -> Array:
    """Matrix (wanted, count) that interpolates linearly between the middles of `count` cells."""
    at = (np.arange(wanted) + 0.5) * count / wanted - 0.5
    cell = np.floor(at).astype(np.int64)
    matrix = np.zeros((wanted, count))
    for step, share in ((0, 1 - (at - cell)), (1, at - cell)):
        column = (cell + step) % count if periodic else np.clip(cell + step, 0, count - 1)
        np.add.at(matrix, (np.arange(wanted), column), share)
    return matrix


def row_means(pelt: Pelt, rows: int, lights: Array, beta: float = BODY_RADIUS) -> Array | None:
    """Mean curves of a fin's rows under lights (n, 3) in the tile's frame, (n, rows); None where the pelt has none."""
    if pelt.curves is None or pelt.weights is None:
        return None
    weights = at_heights(pelt.weights, (np.arange(rows) + 0.5) / rows)
    return pelt.curves.of_fin().mean(lights, weights, beta)


def fit_fins(
    views: Sequence[SideView],
    lights: Array,
    colours: Sequence[Array | None],
    means: Sequence[Array | None] | None = None,
    step: int = 1,
) -> list[FinPelt]:
    """The texels' polynomials in (l·t, l·n) as bytes, of all states of a fur with one λ and Ω.

    lights : (n, 3) of the views, in the tile's frame; colours : (H, W, 3) linear original colours, or None
    means : (n, H) of `row_means`, by which the polynomials are multiplied, or None
    step : of which codes and tints are multiples
    """
    means = means or [None] * len(views)
    filled = [
        fill_fin(fit(view.light, polynomial, lights, mean), view.alpha) for view, mean in zip(views, means, strict=True)
    ]
    scale, bias = byte_range(np.stack(filled), np.stack([view.alpha for view in views]), 256 - step)
    phi = polynomial(lights)
    return [
        FinPelt(
            codes=quantise(coefficients, scale, bias, gram(phi, mean), 256 - step, step),
            alpha=unit_bytes(view.alpha),
            tint=unit_bytes(fill_fin(view.tint[..., None], view.alpha)[..., 0], step),
            colour=None if colour is None else srgb_bytes(fill_fin(colour, view.alpha)),
            scale=scale,
            bias=bias,
        )
        for view, coefficients, colour, mean in zip(views, filled, colours, means, strict=True)
    ]


def fill_fin(values: Array, alpha: Array) -> Array:
    """As `fill`, (H, W, C) by coverage (H, W): a fin goes round along its rows and is mirrored at roots and tips."""
    rows, columns = alpha.shape

    def square(image: Array) -> Array:
        tall = np.concatenate([image, image[::-1]])
        return np.concatenate([tall] * -(-columns // len(tall)))[None, :columns]

    if 2 * rows <= columns:
        return np.asarray(fill(square(values), square(alpha))[0, :rows])
    return np.asarray(fill(values[None], alpha[None])[0])


def fin_environment(rings: int = 8, spokes: int = 16) -> Array:
    """∫ Y_j(ω)·φ_i(ω) dω over the half sphere around n, (6, 9), in the fin's frame; exact for the polynomial."""
    node, weight = np.polynomial.legendre.leggauss(rings)
    outward = np.repeat((node + 1) / 2, spokes)
    azimuth = np.tile((np.arange(spokes) + 0.5) / spokes * 2 * np.pi, rings)
    across = np.sqrt(1 - outward * outward)
    directions = np.stack([across * np.cos(azimuth), outward, across * np.sin(azimuth)], -1)
    area = np.repeat(weight, spokes) * np.pi / spokes
    return np.asarray(PTM(directions).T @ (harmonics(directions) * area[:, None]))
