"""Light on bent hairs: the law by which stored texels are lit, and the numbers in it that suit one fur best.

Hairs bend as shells do: what is at a height s, 0 at the skin and 1 at the tip, moves by d·H·s², and the whole sinks
to c·H, c² = 1 − |d|². The law, for light from l with z = l·n, on fur that leans along m:

- Transmittance. Between s and the tip the hairs are sheared by (1 + s)·d on the whole and pressed together to c. Thin
  hairs take from a ray what they took before from the ray that this makes of it, whatever its slant: texels are
  looked up for the direction of (l − (1 + s)/c·z·d, z/c).
- Visibility. A factor 1 + Σ c_f(s)·f over the terms f of `terms`, each c_f a parabola over s.
  `fit_bends` finds these 24 numbers by light transport through hairs that are bent; `general` are those of any fur.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from furbake.pelt.curves import lean_direction
from furbake.pelt.hairs.shown import shown_slabs
from furbake.pelt.hairs.strands import Coat, Strands
from furbake.pelt.hairs.volume import Volume, fine_shape, voxelise
from furbake.pelt.light.transport import Setting, hemisphere, sample
from furbake.pelt.pelt import Pelt
from furbake.pelt.texels.fill import fill
from furbake.pelt.texels.fit import fit, relight

Array = NDArray[np.float64]
Single = NDArray[np.float32]

MIN_FACTOR = 0.1
"""Least factor of this law and of that of light and eye."""

MAX_TIP = 2 / 3
"""Displacement of the tip, share of the length, from which on the factor no longer changes."""

SIZE = 32
"""Texels a side for which numbers are fitted: larger tiles of the same hairs have much the same."""

BENDS = ((0.4, 45), (0.4, 225), (0.6, 135), (0.6, 315))
"""Bends that the fit sees: displacement of the tip, share of the length, and degrees from the lean."""

LIGHTS, LIGHTS_UNBENT = 16, 32
"""Lights of the fit, and of the small unbent pelt that it makes for larger ones."""

Unbent = tuple[Single, Array]
"""L of unbent hairs under `LIGHTS_UNBENT` lights, (n, K, N, N), and their coverage, (K, N, N)."""

FAINT = 0.05
"""Share of the greatest light that is added to the scale of relative errors."""

RIDGE = 3e-4
"""Regularisation, share of the diagonal: terms that the bends hardly determine stay small."""

MONOMIALS = np.array([[1.0, 0, 0], [-1, 2, 0], [1, -6, 6]])
"""Legendre polynomials in 2s − 1 as rows of weights of 1, s, s²."""


def terms(lights: Array, tip: Array, lean: Array) -> Array:
    """[x·z, d·m, q·z, q, x, q·(l·m), q·(l·m)·z, x·(l·m)] with x = d·l and q = |d|², (n, 8)."""
    d = tip * min(1.0, MAX_TIP / max(float(np.hypot(*tip)), 1e-9))
    m, z, x, q = lean_direction(lean), lights[:, 2], lights[:, :2] @ d, float(d @ d)
    along, even = lights[:, :2] @ m, np.ones(len(lights))
    return np.stack([x * z, d @ m * even, q * z, q * even, x, q * along, q * along * z, x * along], 1)


def general(lean: Array) -> Array:
    """Numbers of the law where none were baked, (3, 8) for s⁰, s¹, s²: −0.5·d·lean + s·(|d|²·(2.7·z − 1.5) − 1.8·x·z).

    Least squares over seven presets at 32 texels a side. Hairs that lie show their upper side, which has much of the
    light from above and little of light from the side; fur bent the way it leans covers its roots.
    """
    numbers = np.zeros((3, 8))
    numbers[0, 1] = -0.5 * np.hypot(*lean)
    numbers[1, [0, 2, 3]] = -1.8, 2.7, -1.5
    return numbers


def sheared(lights: Array, tip: Array, s: float) -> Array:
    """The law's directions, (n, 3)."""
    rise, up = np.sqrt(1 - tip @ tip), lights[:, 2:]
    way = np.concatenate([lights[:, :2] - (1 + s) / rise * up * tip, up / rise], 1)
    return np.asarray(way / np.linalg.norm(way, axis=1, keepdims=True))


def factor(lights: Array, tip: Array, lean: Array, s: float, numbers: Array) -> Array:
    """The law's factors, (n,)."""
    return np.maximum(1 + terms(lights, tip, lean) @ (np.array([1, s, s * s]) @ numbers), MIN_FACTOR)


def bent(strands: Strands, height: float, tip: Array, opacity: float, layers: int, size: int) -> Volume:
    """Bent hairs, finely, in voxels that follow them. Hairs are as dense as they were.

    height : of the fur, tile widths; tip : how far tips are displaced, shares of that
    """
    rise = float(np.sqrt(1 - tip @ tip))
    s = strands.points[..., 2:] / height
    points = np.concatenate([strands.points[..., :2] + height * s**2 * tip, strands.points[..., 2:] * rise], -1)
    slabs, fine = fine_shape(layers, size, height)
    middle = (np.arange(slabs) + 0.5) / slabs
    aside = height * middle[:, None] ** 2 * tip
    # Opacity refers to a share of the height, which has sunk.
    return voxelise(replace(strands, points=points), height * rise, slabs, fine, opacity * rise, aside)


def tips_of(lean: Array) -> Array:
    """Displacements of the tips of `BENDS`, shares of the length, (n, 2)."""
    turn = np.arctan2(*lean_direction(lean)[::-1]) + np.radians([azimuth for _, azimuth in BENDS])
    return np.asarray([share for share, _ in BENDS] * np.array([np.cos(turn), np.sin(turn)])).T


def bent_light(strands: Strands, coat: Coat, height: float, layers: int, size: int, tip: Array) -> Single:
    """L of hairs that are bent under `LIGHTS` lights, (n, K, N, N), for `fit_bends`.

    layers, size : of the pelt; tip : as of `bent`
    """
    few = min(size, SIZE)
    volume = bent(strands, height, tip, coat.opacity, layers, few)
    return sample(volume, layers, few, hemisphere(LIGHTS, turn=0.5), Setting(coat.albedo, coat.skin))


def unbent_light(strands: Strands, coat: Coat, height: float, layers: int, size: int) -> Unbent | None:
    """The same hairs upright, for a pelt of more texels than the fit takes; None where it has no more."""
    if size <= SIZE:
        return None
    fine = voxelise(strands, height, *fine_shape(layers, SIZE, height), coat.opacity)
    seen = sample(fine, layers, SIZE, hemisphere(LIGHTS_UNBENT), Setting(coat.albedo, coat.skin))
    return seen, shown_slabs(fine, strands, layers, SIZE).coverage


def fit_bends(pelt: Pelt, light: Sequence[Single], unbent: Unbent | None) -> Array | None:
    """The 24 numbers of the law for a pelt, (3, 8) for s⁰, s¹, s²; None where its texels are black.

    light, unbent : of its hairs, as of `bent_light` with each of `tips_of`, and of `unbent_light`
    """
    basis, lean = pelt.basis, pelt.drift[-1] / pelt.height
    lights = hemisphere(LIGHTS, turn=0.5)
    if unbent is None:
        texels, alpha = pelt.values, pelt.alpha / 255
    else:
        samples, alpha = unbent
        seen = hemisphere(LIGHTS_UNBENT)
        texels = fill(fit(samples, basis, seen, pelt.mean(seen)), alpha)
    middle = (np.arange(pelt.layers) + 0.5) / pelt.layers
    over_s = np.polynomial.legendre.legvander(2 * middle - 1, 2)
    rows, missing = [], []
    for (share, _), tip, truth in zip(BENDS, tips_of(lean), light, strict=True):
        stored = np.empty((len(lights), pelt.layers))
        for k, s in enumerate(middle):
            ways = sheared(lights, tip, s)
            mean = pelt.mean(ways)
            own = None if mean is None else mean[:, k : k + 1]
            stored[:, k] = (alpha[k] * relight(texels[k : k + 1], basis, ways, own)[:, 0]).sum((1, 2), dtype=np.float64)
        wanted = np.einsum("nkrc,krc->nk", truth, alpha, dtype=np.float64)
        whole = wanted.sum(1)
        # A slab's mean light counts: texel by texel, patterns that differ anyway would make all of it too dark.
        scale = 1 / np.maximum(np.sqrt(share) * (whole + FAINT * whole.max()), 1e-9)[:, None]
        found = terms(lights, tip, lean)
        rows.append(np.einsum("nk,kp,nf->nkpf", scale * stored, over_s, found).reshape(-1, 24))
        missing.append((scale * (wanted - stored)).ravel())
    matrix, right = np.concatenate(rows), np.concatenate(missing)
    square = matrix.T @ matrix
    diagonal = np.diag(square)
    if not diagonal.max() > 0:
        return None
    solved = np.linalg.solve(square + np.diag(RIDGE * diagonal + 1e-9 * diagonal.max()), matrix.T @ right)
    return np.asarray(np.round(MONOMIALS.T @ solved.reshape(3, 8), 3))
