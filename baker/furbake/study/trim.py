"""Cut fur: how much of the light of strands that were cut and baked anew the texels of whole fur give at run time."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from furbake.options import BakeOptions
from furbake.pelt.hairs.volume import Volume
from furbake.pelt.light.paths import BODY_RADIUS
from furbake.pelt.means import Measured, mean_light, shared, tables
from furbake.pelt.pelt import Pelt
from furbake.pelt.texels.fit import Judge, decibels, fit, relight
from furbake.study.verify.tile import correlation
from furbake.tile.fitting import fit_pelt
from furbake.tile.lighting import Lighting, grown, light, parts, under

Array = NDArray[np.float64]
Single = NDArray[np.float32]

LENGTHS = (0.2, 0.4, 0.6, 0.8)
"""Shares of the fur that are left."""

HELD_OUT = 64
"""Held-out lights."""


@dataclass(frozen=True)
class Row:
    """One way to light fur of which `kept` of `layers` slabs are left, against the same strands cut and sampled.

    psnr, psnr_composite : dB, of the slabs and of the tile seen from above
    r : correlation of the tile seen from above, mean over the lights; level : its brightness over the truth's
    """

    preset: str
    kept: int
    layers: int
    way: str
    psnr: float
    psnr_composite: float
    r: float
    level: float


def cut(whole: Volume, share: float) -> Volume:
    """The lowest share of the slabs, which are those that strands clipped there are drawn into."""
    left = max(1, round(share * len(whole.sigma)))
    return Volume(
        sigma=whole.sigma[:left],
        breadth=whole.breadth[:left],
        radius=whole.radius[:left],
        tangent=whole.tangent[:left],
        tint=whole.tint[:left],
        hue=whole.hue[:left],
        drift=whole.drift[:left],
        height=whole.height * left / len(whole.sigma),
        off_axis=None if whole.off_axis is None else whole.off_axis[:left],
    )


def share_above(alpha: Array) -> Array:
    """Share of the visible fur, from straight above, that lies above the middle of each slab, (K, N, N) → (K,)."""
    clear = np.cumprod((1 - alpha)[::-1], axis=0)[::-1]
    over = np.concatenate([clear[1:], np.ones_like(clear[:1])])
    seen = (over * alpha).mean((1, 2))
    below = np.cumsum(seen)
    return np.asarray(1 - (below - seen / 2) / below[-1])


def stand_ins(alpha: Array, kept: int) -> Array:
    """Place in whole fur, slabs, with as much visible fur above it as each slab that is left has, (kept,).

    Light does not get far into fur: what comes back, comes back from where the eye looks. Short fur sends back as much
    of it as long fur, so its slabs take the light of those whose place before the eye they take.
    """
    whole, short = share_above(alpha), share_above(alpha[:kept])
    return np.asarray(np.interp(short, whole[::-1], np.arange(len(whole))[::-1]))


def reweighted(coefficients: Array, alpha: Array, kept: int) -> Array:
    """Coefficients of the slabs that are left as moments change them at run time: (K, N, N, C) → (kept, N, N, C).

    A texel's light changes by as much as its slab's mean does: a' = a + (x·a)·(mean' − mean), with x·a as near 1 over
    the slab's texels as a vector x can make it. On moments that is m' = m + x·((mean' − mean)·m).
    """
    weight = alpha[..., None]
    mean = (coefficients * weight).sum((1, 2)) / np.maximum(weight.sum((1, 2)), 1e-9)
    square = np.einsum("krc,krci,krcj->kij", alpha, coefficients, coefficients)
    square /= np.maximum(alpha.sum((1, 2)), 1e-9)[:, None, None]
    ridge = 1e-6 * np.trace(square, axis1=1, axis2=2)[:, None, None] + 1e-12
    pull = np.linalg.solve(square + ridge * np.eye(mean.shape[1]), mean[..., None])[..., 0]
    places = stand_ins(alpha, kept)
    wanted = np.stack([np.interp(places, np.arange(len(mean)), column) for column in mean.T], -1)
    one = np.einsum("krci,ki->krc", coefficients[:kept], pull[:kept])
    return np.asarray(coefficients[:kept] + one[..., None] * (wanted - mean[:kept])[:, None, None])


def stood_in(curves: Array, alpha: Array, kept: int) -> Array:
    """Mean curves of the slabs that are left: those of their stand-ins, (n, K) → (n, kept)."""
    places = stand_ins(alpha, kept)
    return np.stack([np.interp(places, np.arange(len(alpha)), row) for row in curves])


def trim(
    options: BakeOptions,
    lengths: tuple[float, ...] = LENGTHS,
    lights: int = 64,
    step: Callable[[float], None] = lambda fraction: None,
) -> Iterator[Row]:
    """Bake one fur whole, cut its strands at every length and sample them anew, and light what is left in every way."""
    _, fine, volume = grown(options)
    part = parts(step, len(lengths) + 1)
    options = replace(options, lights=lights)
    lighting = light(fine, options, next(part), held_out=HELD_OUT)
    pelt, _ = fit_pelt(volume, lighting, options)
    basis = pelt.basis
    coefficients = pelt.values
    alpha, layers = volume.coverage, options.layers
    unseen = lighting.lights[lighting.held_out]
    curves = pelt.mean(unseen)
    whole = relight(coefficients, basis, unseen, curves)
    for share in lengths:
        kept = max(1, round(share * layers))
        short = under(lighting.lights, cut(fine, kept / layers), replace(options, layers=kept), next(part))
        judge = Judge(short[lighting.held_out], alpha[:kept], volume.tint[:kept])
        above = Judge(whole, alpha, volume.tint).composite(whole)
        flat = whole[:, ((np.arange(kept) + 0.5) * layers / kept).astype(int)]
        kept_curves = None if curves is None else stood_in(curves, alpha, kept)
        ways = {
            "flattened": (flat, above),
            "cut": (whole[:, :kept], None),
            "cut, re-weighted": (relight(reweighted(coefficients, alpha, kept), basis, unseen, kept_curves), None),
            "baked anew": (_anew(short, alpha[:kept], lighting, pelt), None),
        }
        for way, (slabs, seen) in ways.items():
            yield _row(judge, slabs, judge.composite(slabs) if seen is None else seen, (options.preset, layers, way))


def _anew(samples: Single, alpha: Array, lighting: Lighting, pelt: Pelt) -> Single:
    """Light of the cut strands' own samples, fitted in the same basis, with mean curves of their own, if any."""
    fitted = ~lighting.held_out
    seen, unseen = lighting.lights[fitted], lighting.lights[~fitted]
    mean, there = None, None
    if pelt.curves is not None:
        own = Measured(BODY_RADIUS, seen, mean_light(samples[fitted], alpha))
        lean = pelt.curves.lean
        curves, (weights,) = shared([tables(own, (), lean)], [alpha.mean((1, 2))], lean)
        mean, there = curves.mean(seen, weights), curves.mean(unseen, weights)
    return relight(fit(samples[fitted], pelt.basis, seen, mean), pelt.basis, unseen, there)


def _row(judge: Judge, slabs: Single, seen: NDArray[np.floating], of: tuple[str, int, str]) -> Row:
    preset, layers, way = of
    errors, weights = judge.layer_errors(slabs)
    truth = judge.composite(judge.truth)
    each = [correlation(ours.astype(float), theirs.astype(float)) for ours, theirs in zip(seen, truth, strict=True)]
    return Row(
        preset=preset,
        kept=len(judge.alpha),
        layers=layers,
        way=way,
        psnr=decibels(float(errors.sum() / weights.sum())),
        psnr_composite=decibels(float((((seen - truth) / judge.peak) ** 2).mean())),
        r=float(np.mean(each)),
        level=float(seen.mean() / truth.mean()),
    )


def table(rows: list[Row]) -> str:
    """A Markdown table: for each way PSNR of the slabs and from above in dB, r and brightness from above."""
    ways = list(dict.fromkeys(row.way for row in rows))
    lines = [
        "| fur | slabs left | " + " | ".join(f"{way}: slabs, from above, r, level" for way in ways) + " |",
        "|---" * (2 + len(ways)) + "|",
    ]
    for preset, kept, layers in dict.fromkeys((row.preset, row.kept, row.layers) for row in rows):
        here = {row.way: row for row in rows if (row.preset, row.kept) == (preset, kept)}
        cells = (f"{r.psnr:.1f}, {r.psnr_composite:.1f}, {r.r:.2f}, {r.level:.2f}" for r in (here[way] for way in ways))
        lines.append(f"| {preset} | {kept} of {layers} | " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"
