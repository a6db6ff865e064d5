"""Light on hairs that are shorter than the pelt's: how it grows, in three numbers that are found for each fur.

A body's fur is shorter in places than the hairs that are sampled, share f of their length. Shells lie closer there, and
strands are pressed flat, as wide as before. The law, in the tile's frame:

- Ways. Thin hairs take from a ray along (x, y, z) what the pelt's hairs take from one along (x, y, z/f). So an eye sees
  of short fur what it sees of the pelt on that way, by the law of light and eye, by its surge and by the slabs'
  opacities: the flatter hairs lie, the more they look from aside as from above. It is more light than that: for light
  from l (held on the horizon) and an eye at v, their ways as they are here, G of `eye` is greater by

      (1 − f)·(0.3·|v_h|² + 0.4·v_h·l_h),

  two numbers for all furs, by balls of such hairs beside the path tracer.
- Light. Flat hairs show more of their sides to it, and less of it is lost between them: that of all lights counts times

      1 − ln f·(c₀ + c₁·s + c₂·s²),

  at heights s. `fit_short` finds the c by light transport through hairs that are pressed.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from furbake.pelt.bent import MONOMIALS
from furbake.pelt.hairs.strands import Coat, Strands
from furbake.pelt.hairs.volume import Volume, coarsen, fine_shape, voxelise
from furbake.pelt.light.transport import Setting, hemisphere, sample
from furbake.pelt.means import mean_light, seen_shares

Array = NDArray[np.float64]

SIZE = 32
"""Texels a side for which numbers are found: larger tiles of the same hairs have much the same."""

SHARES = (0.4, 0.1)
"""Lengths that the fit sees, shares of the pelt's."""

SHORTEST = 1 / 16
"""Share below which the law no longer changes."""

LIGHTS = 8
"""Directions above the horizon for each of them."""


def growth(share: float, s: Array, numbers: Array) -> Array:
    """Factor of the light at heights s (n,) where hairs have this share of the pelt's length, (n,)."""
    over_s = np.stack([np.ones_like(s), s, s * s], -1)
    return np.asarray(1 - np.log(min(max(share, SHORTEST), 1.0)) * (over_s @ numbers))


def pressed(strands: Strands, coat: Coat, height: float, layers: int, size: int, share: float) -> Volume:
    """The fine volume of hairs with a share of their length; parameters as of `pressed_light`."""
    short = replace(strands, points=strands.points * [1.0, 1.0, share])
    # Opacity refers to a share of the height.
    return voxelise(short, height * share, *fine_shape(layers, min(size, SIZE), height), coat.opacity * share)


def pressed_light(
    strands: Strands, coat: Coat, height: float, layers: int, size: int, share: float, lights: Array
) -> tuple[Array, Array]:
    """Mean L of the slabs where hairs have a share of their length, (n, K), and what is seen of them from above, (K,).

    height : of the pelt, tile widths; size : texels a side, of which at most `SIZE` are taken; lights : (n, 3)
    """
    few, fine = min(size, SIZE), pressed(strands, coat, height, layers, size, share)
    cover = coarsen(fine, layers, few).coverage
    found = sample(fine, layers, few, lights, Setting(coat.albedo, coat.skin))
    return mean_light(found, cover), seen_shares(cover.mean((1, 2)))


def fit_short(strands: Strands, coat: Coat, height: float, layers: int, size: int) -> Array:
    """The law's numbers c for a fur, (3,), by least squares over what is seen from above; 0 where nothing is lit.

    strands : of the dry fur; layers, size : of the pelt; height : as of `pressed_light`
    """
    lights = hemisphere(LIGHTS)
    whole, seen = pressed_light(strands, coat, height, layers, size, 1.0, lights)
    over_s = np.polynomial.legendre.legvander(2 * (np.arange(layers) + 0.5) / layers - 1, 2)
    matrix, right = np.zeros((3, 3)), np.zeros(3)
    for share in SHARES:
        light, _ = pressed_light(strands, coat, height, layers, size, share, lights)
        rows = (-np.log(share) * whole * seen)[..., None] * over_s
        matrix += np.einsum("nki,nkj->ij", rows, rows)
        right += np.einsum("nki,nk->i", rows, (light - whole) * seen)
    if not matrix[0, 0] > 0:
        return np.zeros(3)
    # A single slab knows no change over the height.
    solved = np.linalg.solve(matrix + 1e-6 * matrix[0, 0] * np.eye(3), right)
    return np.asarray(np.round(MONOMIALS.T @ solved, 3))
