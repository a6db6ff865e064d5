"""States half-way between two that are baked: mixed bytes beside a true bake, seen from above."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from furbake.options import BakeOptions
from furbake.pelt.hairs.states import DIRTY, WETNESS, PeltState, in_state, moistened
from furbake.pelt.hairs.strands import grow
from furbake.pelt.pelt import Pelt
from furbake.pelt.texels.fit import Judge
from furbake.study.verify.tile import correlation
from furbake.tile.fitting import fit_pelts
from furbake.tile.lighting import Lighting, Sampled, parts, sampled

Array = NDArray[np.float64]
Single = NDArray[np.float32]

LUMA = np.array([0.2126, 0.7152, 0.0722])

HALF_DIRTY = PeltState(name="half dirty", dirt=0.5, mud=DIRTY.mud)


@dataclass(frozen=True)
class Row:
    """Correlations of what is shown at a state, or half-way between two, over all texels and held-out lights.

    shown : name of the state, or of the two; kind : "state", "half-way" or "dirt"
    bake : with a bake of that very state by itself, relit from its bytes; samples : with the light as it was sampled
    """

    preset: str
    kind: str
    shown: str
    bake: float
    samples: float


@dataclass(frozen=True)
class Texels:
    """Texels of a tile: L (n, K, N, N), α and brightness of the hairs or the mud (K, N, N)."""

    light: Single
    alpha: Array
    tint: Array

    def above(self) -> Array:
        """The tile from straight above, (n, N, N)."""
        return np.asarray(Judge(self.light, self.alpha, self.tint).composite(self.light), np.float64)


def compare_states(options: BakeOptions, step: Callable[[float], None] = lambda fraction: None) -> Iterator[Row]:
    """Bake the states of a preset's fur and mixtures half-way between them, and compare."""
    height = options.own_height
    strands = grow(options.coat, height, options.seed)
    wettest = list(WETNESS.items())
    between = [(first + second) / 2 for (_, first), (_, second) in pairwise(wettest)]
    stored = [*(moistened(name, wetness) for name, wetness in wettest), DIRTY]
    others = [*(moistened(f"{wetness:g}", wetness) for wetness in between), HALF_DIRTY]
    share = parts(step, len(stored) + len(others))

    def look(state: PeltState) -> Sampled:
        fur = in_state(state, options.coat, strands, height, options.seed)
        return sampled(fur, fur.voxels(options.layers, options.size), options, next(share))

    states, truths = ([look(state) for state in some] for some in (stored, others))
    pelts = [pelt for pelt, _ in fit_pelts(states, options)]
    dry = pelts[0]

    def row(kind: str, shown: str, mixed: Texels, truth: Sampled) -> Row:
        ((own, _),) = fit_pelts([truth], options)
        seen, lighting = mixed.above(), truth.lighting
        baked = texels(own, dry, lighting).above()
        real = Texels(lighting.samples[lighting.held_out], truth.volume.coverage, brightness(own, dry)).above()
        return Row(options.preset, kind, shown, correlation(seen, baked), correlation(seen, real))

    for pelt, truth in zip(pelts[:-1], states, strict=False):
        yield row("state", pelt.state.name, texels(pelt, dry, truth.lighting), truth)
    for (first, second), truth in zip(pairwise(pelts[:-1]), truths, strict=False):
        names = f"{first.state.name}, {second.state.name}"
        yield row("half-way", names, mean(first, second, truth.lighting), truth)
    for dirt, truth in ((1.0, states[-1]), (0.5, truths[-1])):
        yield row("dirt", f"dirt {dirt:g}", soiled(dry, pelts[-1], dirt, truth.lighting), truth)


def texels(pelt: Pelt, dry: Pelt, lighting: Lighting) -> Texels:
    """Texels of one pelt under the held-out lights; a dirty one has the hairs of the dry one."""
    return Texels(lit(pelt, lighting), pelt.alpha / 255, brightness(pelt, dry))


def lit(pelt: Pelt, lighting: Lighting) -> Single:
    """L under the held-out lights."""
    return pelt.light(lighting.lights[lighting.held_out])


def mean(first: Pelt, second: Pelt, lighting: Lighting) -> Texels:
    """Half-way between two states, as the page mixes them: coefficients, α, tint and weights, then light."""
    codes, alpha, tint = (
        (one.astype(np.float64) + other) / 2
        for one, other in ((first.codes, second.codes), (first.alpha, second.alpha), (first.tint, second.tint))
    )
    weights = None if first.weights is None or second.weights is None else (first.weights + second.weights) / 2
    return Texels(lit(mixed(first, codes, weights), lighting), alpha / 255, tint / 255)


def mixed(pelt: Pelt, codes: Array, weights: Array | None) -> Pelt:
    """A pelt with codes that lie between bytes."""
    return replace(pelt, codes=cast(Any, codes), weights=weights)


def soiled(dry: Pelt, dirty: Pelt, dirt: float, lighting: Lighting) -> Texels:
    """Dry fur at a share of the dirty pelt's dirt, as `schema/README.md` has it, without the page's film of mud.

    Each crumb is thinned. Which of them a true bake has cannot be told from the bytes: to keep whole those that are a
    larger share of their texel, however soft the edge, is farther from it (bunny r .82 against .86, fox .82 and .84).
    """
    mud = dirt * dirty.tint / 255 * dirty.alpha / 255
    alpha = 1 - (1 - dry.alpha / 255) * (1 - mud)
    share = np.minimum(mud / np.maximum(alpha, 1e-9), 1)
    codes = dry.codes + dirt * (dirty.codes.astype(float) - dry.codes)
    return Texels(lit(mixed(dry, codes, dry.weights), lighting), alpha, mixed_brightness(dry, share))


def brightness(pelt: Pelt, dry: Pelt) -> Array:
    """Brightness of the hairs, and of the mud on them, over that of the ramp, (K, N, N)."""
    return mixed_brightness(dry, pelt.tint / 255) if pelt.state.dirt else pelt.tint / 255


def mixed_brightness(dry: Pelt, share: Array) -> Array:
    """Brightness of dry hairs where mud is a share of what covers a texel."""
    hairs = np.maximum(dry.ramp.colour(np.ones(dry.alpha.shape), np.full(dry.alpha.shape, 0.5)) @ LUMA, 1e-3)
    mud = float(np.array(DIRTY.mud) @ LUMA)
    return np.asarray((1 - share) * dry.tint / 255 + share * mud / hairs)


def markdown(rows: list[Row]) -> str:
    """A table of the worst of each kind per preset: with a bake, with the samples."""
    lines = [
        "| fur | at a state: bake, samples | half-way: bake, samples | worst half-way | all dirt | half the dirt |",
        "|---|---|---|---|---|---|",
    ]
    for preset in dict.fromkeys(row.preset for row in rows):
        state, half, dirt = (
            [row for row in rows if (row.preset, row.kind) == (preset, kind)] for kind in ("state", "half-way", "dirt")
        )
        worst = min(half, key=lambda row: row.bake)
        cells = [
            preset,
            *(f"{min(row.bake for row in some):.3f}, {min(row.samples for row in some):.3f}" for some in (state, half)),
            worst.shown,
            *(f"{row.bake:.3f}" for row in dirt),
        ]
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"
