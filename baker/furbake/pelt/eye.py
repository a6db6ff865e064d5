"""Light that fur sends to an eye beside it: the nap of velvet, in numbers that are found for each fur.

Texels hold the light that is seen from straight above. From aside other hairs are seen, and other sides of them: most
is seen of where the light comes from, least against it. For light from l (held on the horizon) and an eye at v, in the
tile's frame, texels at height s count times

    G(l, v, s) = max(1 + Σ_f c_f(s)·f(l, v), 0.1),   each c_f a parabola over s,

over the terms f of `terms`, all 0 for an eye straight above. They are at most quadratic in l: even + gradient·l +
l·form·l, as the factor of bent hairs in `bent`, on which it is multiplied. Beside the light itself the eye sees no
shadows (Hapke's opposition surge): light of a lamp counts times
1 + (A + B·q)/(1 + |l − v|²/w²) besides, q = 1 − v_z².

`fit_eye` finds these numbers in the fur's own fine volume: slab by slab, and slabs over slabs as the eye sees them,
what the page's texels show is brought to what the hairs send there. A ray from a hair to the eye and one to the light
meet the same neighbours at first: `shared_depth` is what they share of their optical depths.
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
from furbake.pelt.hairs.volume import SOLID_SLAB, Volume, coarsen, doubled, fine_shape, pool, voxelise
from furbake.pelt.light.depth import Depth, passing
from furbake.pelt.light.fibre import ABOVE, THINNEST, Cylinders
from furbake.pelt.light.paths import BODY_RADIUS, thinned
from furbake.pelt.light.scatter import Slabs, Unscattered, between_hairs, sent
from furbake.pelt.light.transport import Beam
from furbake.pelt.texels.basis import held

Array = NDArray[np.float64]
Single = NDArray[np.float32]

TERMS = 12

SIZE = 32
"""Texels a side for which numbers are found: larger tiles of the same hairs have much the same."""

EYE_HEIGHTS, LIGHT_HEIGHTS = (0.85, 0.5, 0.12), (0.9, 0.6, 0.3, 0.05, -0.25)
"""v·n and l·n of the rings of eyes and lights that the fit sees beside those straight above."""

SURGE_EYES, SURGE_ANGLES = (0.95, 0.6, 0.25), (0, 4, 9, 20)
"""v·n of the eyes beside which lights are put for the surge, and how far from them, degrees."""

WIDTHS = np.geomspace(0.02, 0.4, 40)
"""Candidate widths of the surge."""

SPOKES = 5
"""Directions in each ring."""

LIGHT_HEIGHTS_FLAT = (0.9, 0.6, 0.3, 0.15)
"""`LIGHT_HEIGHTS` of flat fur, which has no end: light along it reaches nothing."""

DARK = 1e-6
"""Least T that is distinguished from 0."""

FAINT = 0.03
"""Share of the greatest brightness that is added to the scale of relative errors."""

EACH_SLAB = 0.3
"""Weight of a slab's own error beside that of the sum of them."""

RIDGE = 1e-4
"""Regularisation, share of the diagonal: terms that do much the same stay small."""


def terms(lights: Array, eyes: Array, lean: Array) -> Array:
    """[q, a, q·b, p·b, q·z, q·b², p, a², p·a·b, a·z, q·b·z, q·a·b] of pairs of unit vectors (..., 3), (..., 12).

    a = l_h·v_h of the level parts, b = l·m and p = v·m along the lean m, z = l_z, q = |v_h|². What is below the
    horizon is held on it.
    """
    m = lean_direction(lean)
    light, eye = np.broadcast_arrays(*(held(way.reshape(-1, 3)).reshape(way.shape) for way in (lights, eyes)))
    a, z = (light[..., :2] * eye[..., :2]).sum(-1), light[..., 2]
    b, p, q = light[..., :2] @ m, eye[..., :2] @ m, 1 - eye[..., 2] ** 2
    each = (q, a, q * b, p * b, q * z, q * b * b, p, a * a, p * a * b, a * z, q * b * z, q * a * b)
    return np.stack(each, -1)


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


def seen_from(
    fine: Volume, layers: int, size: int, lights: Array, eyes: Array, coat: Coat, beta: float | None = BODY_RADIUS
) -> tuple[Array, Array]:
    """Light of each slab towards eyes, per area of skin: from the hairs, and from stored texels.

    fine : the oversampled volume of which `layers` slabs of `size` × `size` texels are stored
    lights, eyes : (n, 3), (m, 3); beta : as of `Beam`

    Returns two (n, m, K), in the unit of L. Texels hold what is seen from above; both are composited along the way to
    the eye, which is that of light to there.
    """
    beam, page = Beam(fine, layers, size, beta), coarsen(fine, layers, size)
    if beta is not None:  # shells are not thinned as hairs are that diverge
        middle = (np.arange(layers) + 0.5) / layers
        page = replace(page, sigma=page.sigma / thinned(middle, beta)[:, None, None])
    stored = beam.slabs()
    sigma, tangent = even(stored.sigma), even(stored.tangent)
    tangent /= np.linalg.norm(tangent, axis=-1, keepdims=True)
    slabs = Slabs(sigma, stored.thick, tangent)
    filled = np.float32(fine.height * SOLID_SLAB / coat.opacity) * fine.sigma.mean((1, 2)).astype(np.float32)
    along = [beam.along(light) for light in lights]
    with ThreadPoolExecutor(cores()) as workers:
        passed, floor = (np.stack(each) for each in zip(*workers.map(beam.reach, lights), strict=True))
        caught, reaching = (even(np.stack(each)) for each in zip(*map(beam.caught, passed, along), strict=True))
        skin = 0.0 if beta is None else coat.skin
        floor = pool(floor, sigma.shape[-1])
        arriving = between_hairs(slabs, Unscattered(lights, caught, reaching, floor), albedo=coat.albedo, skin=skin)

        def onwards(eye: Array) -> Single:
            """M towards an eye, (n, K, N/2, N/2)."""
            return doubled(np.moveaxis(np.maximum(sent(arriving, tangent, eye), 0), 1, 0))

        depths = [-np.log(np.maximum(each, DARK)) for each in passed]
        single = np.stack(list(workers.map(beam.to_eye, passed, lights, along)))
        texels = doubled(onwards(ABOVE)) + single

        def of_eye(eye: Array) -> tuple[Array, Array]:
            clear = beam.reach(eye)[0]
            depth = -np.log(np.maximum(clear, DARK))
            hairs = Cylinders(beam.along(eye))
            see = clear * beam.breadth * np.maximum(hairs.sin_view, THINNEST) * np.float32(beam.slab)
            once = []
            for light, own, others in zip(lights, along, depths, strict=True):
                sin_light, turn = hairs.around(own, float(light @ eye))
                shared = shared_depth(np.maximum(np.minimum(depth, others), 0), turn, filled)
                shared -= others
                np.exp(shared, out=shared)
                shared *= hairs.scattered(sin_light, turn)
                shared *= see
                once.append(_sums(shared, layers))
            blocks = pool(see.reshape(layers, -1, *see.shape[1:]).sum(1), size // 2)
            more = (blocks * onwards(eye)).mean((-1, -2))
            return np.stack(once) + more, (visible(page, eye, beta) * texels).mean((-1, -2))

        each = list(workers.map(of_eye, eyes))
    hairs_show, texels_show = (np.stack(part, 1).astype(np.float64) for part in zip(*each, strict=True))
    return hairs_show, texels_show


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
    return np.asarray(held_depth * (1 - held_depth / (4 * most)), np.float32)


def visible(stored: Volume, eye: Array, beta: float | None) -> Single:
    """Visible share of each texel of the stored slabs as a page shows them, (K, N, N)."""
    sigma = stored.sigma.astype(np.float32)
    depth = Depth(sigma, stored.slab, beta)
    return np.asarray(sigma * stored.slab * depth.through(eye)[0] * passing(depth.own(eye)))


def _sums(voxels: Single, layers: int) -> Array:
    """Sum over the fine slabs of each stored one of their means, (K,)."""
    return np.asarray(voxels.mean((-1, -2), dtype=np.float64).reshape(layers, -1).sum(1))


@dataclass(frozen=True)
class EyeLaw:
    """Numbers of the law: weights (3, 12) of its terms for s⁰, s¹, s², and of the surge, A, B and w."""

    weights: Array
    surge: Array


def fit_eye(
    strands: Strands, height: float, layers: int, size: int, coat: Coat, *, flat: bool = False
) -> EyeLaw | None:
    """The law's numbers for this fur; None where it is black.

    height : of the fur, tile widths; layers, size : slabs and texels a side of its pelt; flat : as of `sample`
    """
    size = min(size, SIZE)
    fine = voxelise(strands, height, *fine_shape(layers, size, height), coat.opacity)
    beta, lean = None if flat else BODY_RADIUS, fine.drift[-1] / fine.height
    lights, eyes = rings(LIGHT_HEIGHTS_FLAT if flat else LIGHT_HEIGHTS, SPOKES), rings(EYE_HEIGHTS, SPOKES)
    hairs, texels = seen_from(fine, layers, size, lights, eyes, coat, beta)
    weights = solve(hairs, texels, terms(lights[:, None], eyes[None], lean))
    if weights is None:
        return None
    eyes = rings(SURGE_EYES, 1)[1:]
    lights = np.concatenate([beside(eye) for eye in eyes])
    hairs, texels = seen_from(fine, layers, size, lights, eyes, coat, beta)
    middle = (np.arange(layers) + 0.5) / layers
    own = np.arange(len(lights)), np.repeat(np.arange(len(eyes)), len(SURGE_ANGLES))
    law = factor(lights, eyes[own[1]], lean, middle, weights)
    missing = hairs[own].sum(-1) / np.maximum((texels[own] * law).sum(-1), 1e-12)
    return EyeLaw(weights, fit_surge(lights, eyes[own[1]], own[1], missing))


def beside(eye: Array) -> Array:
    """Unit vectors `SURGE_ANGLES` above an eye, (n, 3)."""
    level = np.hypot(*eye[:2])
    up = np.array([*(-eye[:2] / level * eye[2]), level])
    angles = np.radians(SURGE_ANGLES)[:, None]
    return np.asarray(np.cos(angles) * eye + np.sin(angles) * up)


def fit_surge(lights: Array, eyes: Array, number: NDArray[np.intp], missing: Array) -> Array:
    """A, B and w by least squares of what is missing, (n,), but for one factor for each eye; number : of the eye."""
    even = np.eye(number.max() + 1)[number]
    best = np.inf, np.zeros(3)
    for width in WIDTHS:
        peaks = (surge(lights, eyes, np.array([*strength, width])) - 1 for strength in ((1.0, 0.0), (0.0, 1.0)))
        rows = np.column_stack([even, *peaks])
        solved, *_ = np.linalg.lstsq(rows, missing, rcond=None)
        off = float(((rows @ solved - missing) ** 2).sum())
        if off < best[0]:
            best = off, np.array([*solved[-2:] / max(solved[:-2].mean(), 1e-9), width])
    return np.round(best[1], 3)


def solve(hairs: Array, texels: Array, found: Array) -> Array | None:
    """Numbers that bring what texels show to what hairs show, both (n, m, K), by terms (n, m, 12)."""
    whole = hairs.sum(-1)
    if not whole.max() > 0:
        return None
    weight = 1 / (whole + FAINT * whole.max())
    middle = (np.arange(hairs.shape[-1]) + 0.5) / hairs.shape[-1]
    over_s = np.polynomial.legendre.legvander(2 * middle - 1, 2)
    off = (hairs - texels) * weight[..., None]
    each = np.einsum("nmf,nmk,kp->nmkpf", found, texels * weight[..., None], over_s, optimize=True)
    rows = np.concatenate([each.sum(2).reshape(-1, 3 * TERMS), EACH_SLAB * each.reshape(-1, 3 * TERMS)])
    right = np.concatenate([off.sum(-1).ravel(), EACH_SLAB * off.ravel()])
    matrix = rows.T @ rows
    diagonal = np.diag(matrix)
    solved = np.linalg.solve(matrix + np.diag(RIDGE * diagonal + 1e-9 * diagonal.max()), rows.T @ right)
    return np.asarray(np.round(MONOMIALS.T @ solved.reshape(3, TERMS), 3))
