"""Mean curves of one fur: measured by light transport, fitted by tables, few of which serve all slabs.

At β = 4 and above the horizon the samples of the fit tell the mean light of a slab. For other bodies, and below the
horizon, it is measured on the same fur in coarser voxels, which is a little more transparent or opaque: each slab is
scaled to agree where both are known. (A tile of 32 texels has deep slabs .7 to 1.7 times as bright as one of 64; once
scaled they are alike within 2 to 7 % half-way up.)
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from furbake.pelt.curves import HORIZON, KNOTS, RADII, Curves, abscissa, elevation, hats
from furbake.pelt.hairs.strands import Coat
from furbake.pelt.hairs.volume import Volume, coarsen, fine_shape
from furbake.pelt.light.paths import BODY_RADIUS
from furbake.pelt.light.transport import Setting, sample_apart
from furbake.pelt.texels.basis import held

Array = NDArray[np.float64]

SIZE = 32
"""Texels a side of the tile that is measured for all bodies."""

LIGHTS = 32
"""Directions for each of them."""

COUNT = 4
"""Curves, as many as a texel holds: the fourth gains .03 dB above the horizon, and a fifth of the light below it."""

DARK_LIGHTS, DARKEST = 14, 2.0
"""Directions below the horizon among `LIGHTS`; the abscissa from which on they lie: lower ones light nearly nothing."""

SMOOTH, FEW = 0.02, 0.1
"""Weight of a table's second differences beside the lights; weight of coarse lights where finer ones are known."""

FAINT, RELATIVE = 0.02, 0.75
"""Share of the largest light that is added to each where it scales errors; how far they are relative, 1 is wholly.

Without it light below the horizon, a hundredth of that above it, is up to thrice too bright (β = 16); wholly relative
errors take a seventh of it away where it changes with the azimuth.
"""

MIN_SEEN = 0.01
"""Share of what is seen with which a slab counts at least where curves for all of them are chosen."""

BELOW, ROUNDS = 30.0, 4
"""Weight of light below 0 where a slab's weights are chosen, and rounds of the search for it."""

LESS = 0.5
"""Share of the hairs' and the skin's albedo with which light is measured once more, to see how its orders shrink."""

SPARSE = 4
"""One in this many lights above the horizon is measured with `LESS` of the albedo."""

DIGITS = 4
"""Significant digits of tables and weights."""


@dataclass(frozen=True)
class Measured:
    """Mean light of the slabs: lights (n, 3), values (n, K), on a body of radius β.

    albedo : of the hairs
    multiple : (n, K) of the light that has met several hairs
    grown : (K,) how many times as much that is as with `LESS` of the albedo
    """

    beta: float
    lights: Array
    values: Array
    albedo: float = 0.0
    multiple: Array | None = None
    grown: Array | None = None


def mean_light(samples: NDArray[np.floating], alpha: Array) -> Array:
    """α-weighted means over each slab, (n, K, N, N) and (K, N, N) → (n, K)."""
    total = np.einsum("nkrc,krc->nk", samples, alpha.astype(samples.dtype), optimize=True)
    return np.asarray(total / np.maximum(alpha.sum((1, 2)), 1e-9), np.float64)


def directions(beta: float) -> Array:
    """Lights over the abscissa of the tables from `DARKEST` to the zenith, (LIGHTS, 3); denser below the horizon."""
    below = DARKEST + _middles(DARK_LIGHTS) * (HORIZON - DARKEST)
    above = HORIZON + _middles(LIGHTS - DARK_LIGHTS) * (KNOTS - 1 - HORIZON)
    return _spiral(np.concatenate([below, above]), beta)


def _middles(count: int) -> Array:
    """Middles of `count` equal parts of 0..1."""
    return (np.arange(count) + 0.5) / count


def _spiral(x: Array, beta: float) -> Array:
    """Lights at these places of the tables' abscissa, their azimuths by the golden angle, (n, 3)."""
    z = elevation(x, beta)
    angle = np.pi * (3 - np.sqrt(5)) * np.arange(len(x))
    across = np.sqrt(1 - z * z)
    return np.stack([across * np.cos(angle), across * np.sin(angle), z], -1)


def coarser(fine: Volume, layers: int, size: int) -> Volume:
    """The oversampled volume as `measure` sees it, of at most `SIZE` texels a side; coverage is kept exactly."""
    slabs, width = fine_shape(layers, min(size, SIZE), fine.height)
    if fine.sigma.shape[2] <= width:
        return fine
    return coarsen(fine, slabs if len(fine.sigma) % slabs == 0 else len(fine.sigma), width)


def measure(
    fine: Volume, layers: int, size: int, coat: Coat, step: Callable[[float], None] = lambda fraction: None
) -> tuple[Measured, ...]:
    """Mean light of the slabs on a body of each of `RADII`; fine : the oversampled volume of a tile of `size`."""
    wide, size = coarser(fine, layers, size), min(size, SIZE)
    alpha = coarsen(wide, layers, size).coverage
    found = []
    for i, beta in enumerate(RADII):
        lights = directions(beta)
        some = np.flatnonzero(lights[:, 2] > 0)[::SPARSE]
        darker = (LESS, some) if beta == BODY_RADIUS else None
        setting = Setting(coat.albedo, coat.skin, beta=beta)
        single, multiple, less = sample_apart(wide, layers, size, lights, setting, darker=darker)
        more, grown = mean_light(multiple, alpha), None
        if less is not None:
            grown = more[some].sum(0) / np.maximum(mean_light(less, alpha).sum(0), 1e-12)
        found.append(Measured(beta, lights, mean_light(single, alpha) + more, coat.albedo, more, grown))
        step((i + 1) / len(RADII))
    return tuple(found)


def tables(own: Measured, bodies: Sequence[Measured], lean: Array) -> Array:
    """Tables of one state's slabs: even and along, for each of `RADII`, (K, 2, 3, 17).

    own : the samples of the fit, above the horizon; bodies : of `measure`, or none: then nothing below the horizon is
    lit, and all bodies are alike
    """
    if not bodies:
        fitted = _solved(_design(own.lights, own.beta, lean), own.values, np.ones(len(own.lights)), HORIZON)
        return np.repeat(_lit(fitted, own.beta)[:, :, None], len(RADII), axis=2)
    found = []
    at_home = next(body for body in bodies if body.beta == own.beta)
    design = _design(at_home.lights, at_home.beta, lean)
    design_own = _design(own.lights, own.beta, lean)
    rough = _solved(design, at_home.values, np.ones(len(design)), 0)
    predicted = design_own @ rough.reshape(len(rough), -1).T
    scale = (predicted * own.values).sum(0) / np.maximum((predicted**2).sum(0), 1e-12)
    for body in bodies:
        if body is at_home:
            counts = np.where(body.lights[:, 2] > own.lights[:, 2].min(), FEW, 1.0)
            rows, values = np.concatenate([design, design_own]), np.concatenate([body.values * scale, own.values])
            found.append(_solved(rows, values, np.concatenate([counts, np.ones(len(own.lights))]), 0))
        else:
            rows = _design(body.lights, body.beta, lean)
            found.append(_solved(rows, body.values * scale, np.ones(len(rows)), 0))
    return np.stack([_lit(some, beta) for some, beta in zip(found, RADII, strict=True)], 2)


def _lit(found: Array, beta: float) -> Array:
    """Tables (K, 2, 17) that are nowhere below 0, whatever the azimuth of the light."""
    z = np.maximum(elevation(np.arange(KNOTS, dtype=float), beta), 0)
    even, reach = np.maximum(found[:, 0], 0), np.maximum(np.sqrt(1 - z * z), 1e-6)
    return np.stack([even, np.clip(found[:, 1], -even / reach, even / reach)], 1)


def _design(lights: Array, beta: float, lean: Array) -> Array:
    """Weights of a table's knots under lights, (n, 34): even, then along."""
    knots = hats(abscissa(lights[:, 2], beta))
    return np.concatenate([knots, knots * (held(lights)[:, :2] @ lean)[:, None]], 1)


def _solved(rows: Array, values: Array, counts: Array, dark: int) -> Array:
    """Smooth tables by least squares: rows (n, 34), values (n, K), counts (n,) → (K, 2, 17), 0 up to knot `dark`.

    Errors are those over `_scale`. A table may have an edge at the horizon.
    """
    bent = np.delete(np.diff(np.eye(KNOTS), 2, axis=0), HORIZON - 1, axis=0)
    free = np.tile(np.arange(KNOTS) > dark, 2)
    knots = rows[:, :KNOTS]
    at_knots = knots.T @ values / np.maximum(knots.sum(0), 1e-9)[:, None]
    weight = np.sqrt(counts)[:, None] / _scale(values)
    smooth = SMOOTH * np.sqrt(counts.sum()) / _scale(at_knots)
    found = np.zeros((values.shape[1], 2 * KNOTS))
    for slab, (of_lights, of_knots) in enumerate(zip(weight.T, smooth.T, strict=True)):
        bends = np.kron(np.eye(2), bent * np.delete(of_knots[1:-1], HORIZON - 1)[:, None])
        matrix = np.concatenate([rows * of_lights[:, None], bends])[:, free]
        right = np.concatenate([values[:, slab] * of_lights, np.zeros(len(bends))])
        found[slab, free] = np.linalg.lstsq(matrix, right, rcond=None)[0]
    return found.reshape(-1, 2, KNOTS)


def _scale(values: Array) -> Array:
    """Scale of the errors of values (n, K), each over the largest of its column."""
    largest = np.maximum(values.max(0), 1e-12)
    return np.asarray((np.maximum(values, 0) / largest + FAINT) ** RELATIVE)


def shared(
    each: Sequence[Array], cover: Sequence[Array], lean: Array, count: int = COUNT
) -> tuple[Curves, list[Array]]:
    """The few curves that lose least of the tables (K, 2, 3, 17) of all states, and each state's weights, (K, Q).

    cover : (K,) of each state: mean coverages; slabs count by what is seen of them from above, errors as in `_scale`,
        but wholly relative
    """
    joined = np.concatenate(each)
    rows = np.concatenate([_spread_out(r, lean) for r in range(len(RADII))])
    values = rows @ joined.reshape(len(joined), -1).T
    weights = np.sqrt(np.maximum(np.concatenate([seen_shares(some) for some in cover]), MIN_SEEN))
    mean = values @ (weights**2 / (weights**2).sum())
    scale = (np.maximum(mean, 0) + FAINT * mean.max())[:, None]
    _, strength, found = np.linalg.svd(values * weights / scale, full_matrices=False)
    count = min(count, max(int((strength > 1e-9 * max(strength[0], 1e-9)).sum()), 1))
    mixed = np.einsum("qk,ktrx->qtrx", found[:count] * weights, joined)
    mixed *= np.where(mixed[:, 0].sum((1, 2)) < 0, -1, 1)[:, None, None, None]
    mixed = rounded(mixed / np.maximum(np.abs(mixed).max((1, 2, 3), keepdims=True), 1e-12))
    curves = Curves(np.ascontiguousarray(mixed[:, 0]), np.ascontiguousarray(mixed[:, 1]), lean)
    solved = _weights(rows @ mixed.reshape(count, -1).T / scale, values / scale)
    return curves, [rounded(part) for part in np.split(solved, np.cumsum([len(part) for part in each])[:-1])]


def seen_shares(cover: Array) -> Array:
    """Share of each slab in what is seen from above, (K,), where hairs of different slabs lie anyhow."""
    return np.asarray(cover * np.append(np.cumprod(1 - cover[:0:-1])[::-1], 1.0))


def _weights(curves: Array, values: Array) -> Array:
    """Each slab's weights, (K, Q): least squares of values (n, K) in curves (n, Q), light below 0 counting more."""
    weights, counts = np.zeros((values.shape[1], curves.shape[1])), np.ones_like(values)
    small = 1e-9 * np.eye(curves.shape[1]) * len(curves)
    for _ in range(ROUNDS):
        counts = np.where(curves @ weights.T < 0, BELOW, counts)
        matrix = np.einsum("nk,nq,np->kqp", counts, curves, curves, optimize=True) + small
        weights = np.linalg.solve(matrix, ((counts * values).T @ curves)[..., None])[..., 0]
    return weights


def _spread_out(body: int, lean: Array) -> Array:
    """Values of tables (2, 3, 17) on one of the bodies over its lights, (n, 102)."""
    lights = _spiral(_middles(4 * LIGHTS) * (KNOTS - 1), RADII[body])
    design = _design(lights, RADII[body], lean).reshape(-1, 2, 1, KNOTS)
    return np.asarray(design * np.eye(len(RADII))[body][:, None]).reshape(len(design), -1)


def rounded(values: Array) -> Array:
    """Values rounded to `DIGITS` significant digits."""
    return np.array([float(f"{value:.{DIGITS}g}") + 0.0 for value in values.ravel()]).reshape(values.shape)
