"""Light that fur sends to an eye beside it: the nap of velvet, in numbers that are found for each fur.

Texels hold the light that is seen from straight above. From aside other hairs are seen, and other sides of them: most
is seen of where the light comes from, least against it. For light from l (held on the horizon) and an eye at v, in the
tile's frame, texels at height s count times

    G(l, v, s) = max(1 + Σ_f c_f(s)·f(l, v), 0.1),   each c_f a parabola over s,

over the terms f of `terms`, all 0 for an eye straight above. They are at most quadratic in l: even + gradient·l +
l·form·l, as the factor of bent hairs in `bent`, on which it is multiplied. Beside the light itself the eye sees no
shadows (Hapke's opposition surge): light of a lamp counts times
1 + (A + B·q)/(1 + |l − v|²/w²) besides, q = 1 − v_z², and between hairs that lean `along_lean` (`lean`).

`fit_eye` finds these numbers by what eyes see (`seen`): slab by slab, and slabs over slabs, what shells show of the
pelt as it is stored is brought to what the hairs of the fine volume send there. The two factors are fitted together:
what the texels' few numbers lose of the light beside the eye is found again in the surge.
"""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from furbake.cores import cores
from furbake.pelt.bent import MIN_FACTOR, MONOMIALS
from furbake.pelt.curves import lean_direction
from furbake.pelt.hairs.strands import Coat, Strands
from furbake.pelt.hairs.volume import fine_shape, voxelise
from furbake.pelt.light.beam import EVEN_SIZE
from furbake.pelt.light.fibre import ABOVE
from furbake.pelt.light.paths import BODY_RADIUS
from furbake.pelt.light.transport import LOWEST_FLAT, hemisphere
from furbake.pelt.pelt import Pelt
from furbake.pelt.seen import DARK, LitHairs, ShownTexels
from furbake.pelt.texels.basis import held

Array = NDArray[np.float64]

TERMS = 16

SIZE = 32
"""Texels a side for which numbers are found: larger tiles of the same hairs have much the same."""

EYE_HEIGHTS, LIGHT_HEIGHTS = (0.85, 0.5, 0.12), (0.9, 0.6, 0.3, 0.05, -0.1, -0.25)
"""v·n and l·n of the rings of eyes and lights that the fit sees beside those straight above."""

NEAR_HEIGHTS, NEAR_ANGLES = (0.95, 0.6, 0.25), (0, 5, 12, 20)
"""v·n of the eyes beside which lights are put for the surge, and how far from them, degrees."""

NEAR_SPOKES, NEAR_TURN = 3, 0.7
"""Eyes in each of these rings, and its turn."""

NEAR_WEIGHT = 0.5
"""Weight of these pairs."""

ROUNDS = 6
"""Turns of the two factors' fits; after four nothing changes but the last digit."""

WIDTHS = np.geomspace(0.02, 0.4, 40)
"""Candidate widths of the surge."""

SPOKES = 5
"""Directions in each ring."""

LIGHT_HEIGHTS_FLAT = (0.9, 0.6, 0.3, 0.15)
"""`LIGHT_HEIGHTS` of flat fur, which has no end: light along it reaches nothing."""

FAINT = 0.05
"""Share of the greatest brightness that is added to the scale of relative errors."""

EACH_SLAB = 0.6
"""Weight of a slab's own error beside that of the sum of them."""

RIDGE = 3e-4
"""Regularisation, share of the diagonal: terms that do much the same stay small."""


def terms(lights: Array, eyes: Array, lean: Array) -> Array:
    """[q, a, q·b, p·b, q·z, q·b², p, a², p·a·b, q·p, q·b·z, q·a·b, a·z, p·z, q·z², q·p·b] of pairs of unit vectors
    (..., 3), (..., 16).

    a = l_h·v_h of the level parts, b = l·m and p = v·m along the lean m, z = l_z, q = |v_h|². What is below the
    horizon is held on it.
    """
    m = lean_direction(lean)
    light, eye = np.broadcast_arrays(*(held(way.reshape(-1, 3)).reshape(way.shape) for way in (lights, eyes)))
    a, z = (light[..., :2] * eye[..., :2]).sum(-1), light[..., 2]
    b, p, q = light[..., :2] @ m, eye[..., :2] @ m, 1 - eye[..., 2] ** 2
    first = (q, a, q * b, p * b, q * z, q * b * b, p, a * a, p * a * b, q * p, q * b * z, q * a * b)
    return np.stack([*first, a * z, p * z, q * z * z, q * p * b], -1)


def factor(lights: Array, eyes: Array, lean: Array, s: Array, numbers: Array) -> Array:
    """G of pairs of directions (n, 3) at heights s (K,), numbers as of `fit_eye`: (n, K)."""
    over_s = np.stack([np.ones_like(s), s, s * s], -1) @ numbers
    return np.maximum(1 + terms(lights, eyes, lean) @ over_s.T, MIN_FACTOR)


def surge(lights: Array, eyes: Array, numbers: Array) -> Array:
    """Light of a lamp beside the eye, n pairs of unit vectors, (n,), over one aside; numbers : A, B, w."""
    strength = numbers[0] + numbers[1] * (1 - held(eyes)[:, 2] ** 2)
    return np.asarray(1 + strength / (1 + ((lights - eyes) ** 2).sum(-1) / numbers[2] ** 2))


def rings(heights: tuple[float, ...], spokes: int, turn: float = 0.4) -> Array:
    """Straight up, then unit vectors at these heights, each ring turned by a share of a spoke: (n, 3)."""
    ways = [ABOVE[None]]
    for number, z in enumerate(heights):
        azimuth = 2 * np.pi * (np.arange(spokes) + turn * number) / spokes
        level = np.sqrt(1 - z * z)
        ways.append(np.stack([level * np.cos(azimuth), level * np.sin(azimuth), np.full(spokes, z)], -1))
    return np.concatenate(ways)


GAUGE_LIGHTS, GAUGE_EYES = hemisphere(6, lowest=LOWEST_FLAT), rings((0.7, 0.3), 2)[1:]
"""Lights and eyes by which voxels of two sizes are compared."""

MAX_LEVEL = 2.0
"""Most that a slab's light may change by it, and least, 1 over this: next to nothing is seen of some."""


@dataclass(frozen=True)
class EyeLaw:
    """Numbers of the law: weights (3, 16) of its terms for s⁰, s¹, s², and of the surge, A, B and w."""

    weights: Array
    surge: Array


@dataclass(frozen=True)
class SeenHairs:
    """Hairs as eyes see them, of which the law's numbers are found.

    lights, eyes : (n, 3) and (m, 3); met : of each eye, which of the lights it sees
    once, several : (m) of each eye: (those, K) that the slabs send it of light that met one hair, and several
    seen : (m) of each eye: (K,) what it sees of their hairs
    gauge : as of `gauge`, of these voxels
    lean : (2,) of the tips, shares of the height
    """

    lights: Array
    eyes: Array
    met: list[NDArray[np.intp]]
    once: list[Array]
    several: list[Array]
    seen: list[Array]
    gauge: Array
    lean: Array

    def light(self, finer: Array) -> list[Array]:
        """(m) of each eye: (those, K) that the slabs send it, at the level of finer voxels; finer : as of `gauge`."""
        once, several = np.clip(finer / np.maximum(self.gauge, DARK), 1 / MAX_LEVEL, MAX_LEVEL)
        return [one * once + more * several for one, more in zip(self.once, self.several, strict=True)]


def gauge(strands: Strands, coat: Coat, height: float, layers: int, size: int, flat: bool = False) -> Array:
    """Light of the slabs that met one hair and several, per hair that is seen, (2, K): the mean over `GAUGE_EYES` and
    `GAUGE_LIGHTS` in the voxels in which samples are scattered. Parameters as of `seen_hairs`.

    In 32 texels light that met several hairs is 1.1 to 1.2 times as much, and that met one .9 to 1.
    """
    few = min(size, 2 * EVEN_SIZE)
    fine = voxelise(strands, height, *fine_shape(layers, few, height), coat.opacity)
    return _gauged(LitHairs(fine, layers, few, GAUGE_LIGHTS, coat, None if flat else BODY_RADIUS, coarse=False), 0)


def _gauged(lit: LitHairs, first: int) -> Array:
    """`gauge` of hairs whose lights from this one on are `GAUGE_LIGHTS`."""
    some = np.arange(first, first + len(GAUGE_LIGHTS))
    once, several, seen = (np.stack(each) for each in zip(*(lit.towards(eye, some) for eye in GAUGE_EYES), strict=True))
    return np.asarray(np.stack([once, several]).sum((1, 2)) / np.maximum(seen.sum(0), 1e-30))


def seen_hairs(strands: Strands, coat: Coat, height: float, layers: int, size: int, flat: bool = False) -> SeenHairs:
    """Hairs as `fit_eye` has them seen; layers, size : of the pelt; flat : as of `sample`."""
    far, near = rings(EYE_HEIGHTS, SPOKES), rings(NEAR_HEIGHTS, NEAR_SPOKES, NEAR_TURN)
    around = rings(LIGHT_HEIGHTS_FLAT if flat else LIGHT_HEIGHTS, SPOKES)
    eyes, lights = np.concatenate([far, near]), np.concatenate([around, *(beside(eye) for eye in near)])
    # Each of the first eyes sees all lights around, each of the others those beside it.
    met = [np.arange(len(around))] * len(far)
    met += list(np.arange(len(around), len(lights)).reshape(len(near), -1))
    return towards(eyes, met, lights, strands, coat, height, layers, size, flat)


def towards(
    eyes: Array, met: list[NDArray[np.intp]], lights: Array,
    strands: Strands, coat: Coat, height: float, layers: int, size: int, flat: bool = False,
) -> SeenHairs:  # fmt: skip
    """Hairs as these eyes see them, in a tile of at most `SIZE` texels a side.

    eyes, met, lights : as of `SeenHairs`; the others as of `seen_hairs`
    """
    few = min(size, SIZE)
    fine = voxelise(strands, height, *fine_shape(layers, few, height), coat.opacity)
    lit = LitHairs(fine, layers, few, np.concatenate([lights, GAUGE_LIGHTS]), coat, None if flat else BODY_RADIUS)
    once, several, seen = (list(each) for each in zip(*map(lit.towards, eyes, met), strict=True))
    return SeenHairs(lights, eyes, met, once, several, seen, _gauged(lit, len(lights)), fine.drift[-1] / fine.height)


def fit_eye(pelt: Pelt, hairs: SeenHairs, finer: Array, *, flat: bool = False) -> EyeLaw | None:
    """The law's numbers for this dry fur, as its texels are stored; None where nothing of it is seen.

    hairs, finer : its own, as of `seen_hairs` and `gauge`; flat : as of `sample`
    """
    shown = ShownTexels(pelt, hairs.lights, None if flat else BODY_RADIUS)
    with ThreadPoolExecutor(cores()) as workers:
        texels, seen_texels = zip(*workers.map(shown.towards, hairs.eyes, hairs.met), strict=True)
    # Fur is opaque either way: the light of what an eye sees of it is compared, not how much it sees.
    level = np.array(seen_texels) / np.maximum(np.sum(hairs.seen, 1), DARK)
    count, far = [len(some) for some in hairs.met], len(rings(EYE_HEIGHTS, SPOKES))
    pairs = Pairs(
        hairs.lights[np.concatenate(hairs.met)],
        np.repeat(hairs.eyes, count, 0),
        np.concatenate(hairs.light(finer)) * np.repeat(level, count)[:, None],
        np.concatenate(texels),
        np.repeat([1.0] * far + [NEAR_WEIGHT] * (len(count) - far), count),
    )
    return None if not pairs.hairs.max() > 0 else fit_pairs(pairs.counted(), hairs.lean)


@dataclass(frozen=True)
class Pairs:
    """Pairs of lights and eyes, (n, 3) each, and what is seen: of the hairs and of texels without the law, (n, K).

    weight : (n,) of the pairs
    """

    lights: Array
    eyes: Array
    hairs: Array
    texels: Array
    weight: Array

    def counted(self) -> Pairs:
        """The same with weights for relative errors."""
        whole = self.hairs.sum(-1)
        return replace(self, weight=self.weight / (whole + FAINT * whole.max()))


def fit_pairs(pairs: Pairs, lean: Array) -> EyeLaw:
    """The law that brings texels to hairs: its two factors in turns, each by least squares beside the other."""
    found, whole = terms(pairs.lights, pairs.eyes, lean), pairs.hairs.sum(-1)
    middle = (np.arange(pairs.hairs.shape[1]) + 0.5) / pairs.hairs.shape[1]
    weights, peak = np.zeros((3, TERMS)), np.array([0.0, 0.0, WIDTHS[0]])
    for _ in range(ROUNDS):
        beside_eye = surge(pairs.lights, pairs.eyes, peak)[:, None]
        weights = solve(pairs.hairs, pairs.texels * beside_eye, found, pairs.weight)
        shown = (pairs.texels * factor(pairs.lights, pairs.eyes, lean, middle, weights)).sum(-1)
        peak = fit_surge(pairs.lights, pairs.eyes, shown, whole, pairs.weight)
    return EyeLaw(np.round(weights, 3), np.round(peak, 3))


def beside(eye: Array) -> Array:
    """Unit vectors `NEAR_ANGLES` above an eye, (n, 3)."""
    level = np.hypot(*eye[:2])
    up = np.array([*(-eye[:2] / level * eye[2]), level]) if level > 0 else np.array([1.0, 0.0, 0.0])
    angles = np.radians(NEAR_ANGLES)[:, None]
    return np.asarray(np.cos(angles) * eye + np.sin(angles) * up)


def fit_surge(lights: Array, eyes: Array, shown: Array, wanted: Array, weight: Array) -> Array:
    """A, B and w that bring what is shown without a surge to what is wanted, all (n,), by least squares."""
    best = np.inf, np.zeros(3)
    for width in WIDTHS:
        peaks = (surge(lights, eyes, np.array([*strength, width])) - 1 for strength in ((1.0, 0.0), (0.0, 1.0)))
        rows = np.column_stack([shown * peak * weight for peak in peaks])
        right = (wanted - shown) * weight
        solved, *_ = np.linalg.lstsq(rows, right, rcond=None)
        off = float(((rows @ solved - right) ** 2).sum())
        if off < best[0]:
            best = off, np.array([*solved, width])
    return best[1]


def solve(hairs: Array, texels: Array, found: Array, weight: Array) -> Array:
    """Numbers that bring what texels show to what hairs show, both (n, K), by terms (n, 16); weight : (n,)."""
    middle = (np.arange(hairs.shape[-1]) + 0.5) / hairs.shape[-1]
    over_s = np.polynomial.legendre.legvander(2 * middle - 1, 2)
    off = (hairs - texels) * weight[:, None]
    each = np.einsum("nf,nk,kp->nkpf", found, texels * weight[:, None], over_s, optimize=True)
    rows = np.concatenate([each.sum(1).reshape(-1, 3 * TERMS), EACH_SLAB * each.reshape(-1, 3 * TERMS)])
    right = np.concatenate([off.sum(-1), EACH_SLAB * off.ravel()])
    matrix = rows.T @ rows
    diagonal = np.diag(matrix)
    solved = np.linalg.solve(matrix + np.diag(RIDGE * diagonal + 1e-9 * diagonal.max()), rows.T @ right)
    return np.asarray(MONOMIALS.T @ solved.reshape(3, TERMS))
