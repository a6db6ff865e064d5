"""Light on bent fur: stored texels under the shader's law for bent hairs, beside fresh samples of those.

The law, and how its numbers are found, are those of `pelt/bent.py` and of bent.glsl. The fresh samples follow bent
hairs: a slab's texels lie where the shader draws that slab. The fur keeps its density; the eye and the horizon stay the
skin's.

Mean ratio over all presets at 32 texels, both tips, four directions: light as if unbent 1.51, a frame that turns with
the hairs 1.98, the sheared direction alone 1.62, the law 1.21 with general numbers and 1.09 with baked ones, of which
1.04 with tips at 0.3 H and 1.13 at 0.5 H. What is left is most where hairs are bent against their lean and in dense
upright coats; no factor would leave less than 1.2 in `sheep` and `teddy`. Under an even sky: 10 % off as if unbent,
12 % turned, 9 % with general numbers and 7 % with baked ones.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from furbake.options import BakeOptions
from furbake.options.knobs import within
from furbake.pelt.bent import bent, bent_light, factor, fit_bends, general, sheared, tips_of, unbent_light
from furbake.pelt.light.paths import BODY_RADIUS
from furbake.pelt.pelt import Pelt
from furbake.pelt.texels.basis import held
from furbake.tile.fitting import fit_pelt
from furbake.tile.lighting import grown, light, under

Array = NDArray[np.float64]
Single = NDArray[np.float32]
Law = Callable[[Array, Array, Array, float], tuple[Array, Array]]
"""Lights (n, 3), displacement of the tip (2,) and lean (2,), shares of the length, and s → directions and factors."""

TIPS, AZIMUTHS = (0.3, 0.5), 4
"""How far tips are displaced, shares of the height, and in how many directions, the first along the fur's lean."""


def unbent(lights: Array, _tip: Array, _lean: Array, _s: float) -> tuple[Array, Array]:
    """Light as on fur that does not bend."""
    return lights, np.ones(len(lights))


def turned(lights: Array, tip: Array, _lean: Array, s: float) -> tuple[Array, Array]:
    """The frame of light turns with the hair: the smallest rotation that takes the normal onto its tangent at s."""
    normal = np.array([0.0, 0.0, 1.0])
    along = np.array([*(2 * s * tip), np.sqrt(1 - tip @ tip)])
    along /= np.linalg.norm(along)
    both = along + normal
    frame = np.eye(3) - np.outer(both, both) / both[2] + 2 * np.outer(along, normal)
    return horizon(lights @ frame, s)


def shear(lights: Array, tip: Array, _lean: Array, s: float) -> tuple[Array, Array]:
    """The law's directions without its factors."""
    return sheared(lights, tip, s), np.ones(len(lights))


def baked(numbers: Array) -> Law:
    """The shader's law with these numbers, for lights above the horizon."""
    return lambda lights, tip, lean, s: (sheared(lights, tip, s), factor(lights, tip, lean, s, numbers))


def law(lights: Array, tip: Array, lean: Array, s: float) -> tuple[Array, Array]:
    """The shader's law where no numbers were baked."""
    return baked(general(lean))(lights, tip, lean, s)


LAWS: dict[str, Law] = {"as unbent": unbent, "frame turned": turned, "sheared": shear, "law": law}
"""Laws by name; the last is the shader's where no numbers were baked."""

BAKED = "baked numbers"
"""The law with those of `fit_bends`, for each fur."""


@dataclass(frozen=True)
class Row:
    """Errors of each law."""

    preset: str
    tip: float
    azimuth: float
    """Degrees from the direction in which the fur leans."""
    ratios: dict[str, float]
    """RMS error of the layers' light under one lamp over that of the unbent fit."""
    sky: dict[str, float]
    """RMS error of the layers' light under all lamps at once, share of its mean."""


def bend(
    options: BakeOptions,
    tips: Sequence[float] = TIPS,
    azimuths: int = AZIMUTHS,
    step: Callable[[float], None] = lambda fraction: None,
) -> Iterator[Row]:
    """Bend one preset's fur every way and hold the laws against it, under lights that no fit has seen."""
    strands, fine, volume = grown(options)
    lighting = light(fine, options)
    pelt, _ = fit_pelt(volume, lighting, options)
    lights, weights = lighting.lights[lighting.held_out], volume.coverage
    height = options.own_height
    lean = volume.drift[-1] / height
    hairs = strands, options.coat, height, options.layers, options.size
    numbers = None
    if not options.flat:
        numbers = fit_bends(pelt, [bent_light(*hairs, tip) for tip in tips_of(lean)], unbent_light(*hairs))
    laws = LAWS | {BAKED: law if numbers is None else baked(numbers)}

    def fresh(tip: Array) -> Single:
        volume = bent(strands, height, tip, options.coat.opacity, options.layers, options.size)
        return under(lights, volume, options)

    still = np.zeros(2)
    base = rms(relit(pelt, lights, still, lean, unbent) - fresh(still), weights)
    ways = [(tip, 360 * i / azimuths) for tip in tips for i in range(azimuths)]
    for i, (tip, azimuth) in enumerate(ways):
        step((i + 1) / (len(ways) + 1))
        angle = np.arctan2(lean[1], lean[0]) + np.radians(azimuth)
        way = tip * np.array([np.cos(angle), np.sin(angle)])
        truth = fresh(way)
        even = float((truth.mean(0) * weights).sum() / weights.sum())
        off = {name: relit(pelt, lights, way, lean, law) - truth for name, law in laws.items()}
        ratios = {name: rms(error, weights) / base for name, error in off.items()}
        sky = {name: rms(error.mean(0, keepdims=True), weights) / even for name, error in off.items()}
        yield Row(options.preset, tip, azimuth, ratios, sky)


def check(tips: Sequence[float], azimuths: int) -> None:
    """Raise OptionError for a value out of range."""
    for tip in tips:
        within("tips", tip, 0, 0.8)
    within("azimuths", azimuths, 1, 64)


def relit(pelt: Pelt, lights: Array, tip: Array, lean: Array, law: Law, beta: float = BODY_RADIUS) -> Single:
    """L of the stored texels by a law, clamped at 0 as the shader does, (n, K, N, N).

    Slabs with mean curves know how far below the horizon a light is; all else of it is that of the light held there.
    """
    below = lights[:, 2:] < 0
    layers = []
    for k, texels in enumerate(pelt.values):
        ways, factor = law(lights if pelt.curves is None else held(lights), tip, lean, (k + 0.5) / pelt.layers)
        mean = pelt.mean(np.where(below, lights, ways), beta)
        if mean is not None:
            factor = factor * mean[:, k]
        phi = (pelt.basis(ways) * factor[:, None]).astype(np.float32)
        layers.append(np.maximum(np.tensordot(phi, texels.astype(np.float32), (1, 2)), 0))
    return np.stack(layers, 1)


def horizon(lights: Array, s: float) -> tuple[Array, Array]:
    """Lights below the horizon are held on it and fade out over the dip that a point at height s sees."""
    dip = np.sqrt(1 - (BODY_RADIUS / (BODY_RADIUS + s)) ** 2)
    below = lights[:, 2:] < 0
    held = np.where(below, lights * [1, 1, 0], lights)
    fade = np.sqrt(np.clip(1 + lights[:, 2] / max(dip, 1e-4), 0, 1))
    return held / np.maximum(np.linalg.norm(held, axis=1, keepdims=True), 1e-4), np.where(below[:, 0], fade, 1.0)


def rms(error: Single, weights: Array) -> float:
    """Root mean square over lights (n, K, N, N), weighted by coverage (K, N, N)."""
    return float(np.sqrt(((error**2).mean(0) * weights).sum() / weights.sum()))


def markdown(rows: Sequence[Row]) -> str:
    """A table: a line for each bend, then means over the directions of each fur and of all, the worst, and the sky."""
    names = [*LAWS, BAKED]
    lines = ["| fur | tip | from the lean | " + " | ".join(names) + " |", "|---|---|---|" + "---|" * len(names)]

    def line(fur: str, tip: str, way: str, cells: Sequence[str]) -> None:
        lines.append(f"| {fur} | {tip} | {way} | " + " | ".join(cells) + " |")

    def ratios(of: Sequence[Row]) -> Array:
        return np.array([[row.ratios[name] for name in names] for row in of])

    def mean(of: Sequence[Row]) -> list[str]:
        return [f"{ratio:.2f}" for ratio in ratios(of).mean(0)]

    for row in rows:
        line(row.preset, f"{row.tip:g} H", f"{row.azimuth:g}°", mean([row]))
    for fur in dict.fromkeys(row.preset for row in rows):
        line(f"**{fur}**", "all", "mean", mean([row for row in rows if row.preset == fur]))
    for tip in dict.fromkeys(row.tip for row in rows):
        line("**all**", f"{tip:g} H", "mean", mean([row for row in rows if row.tip == tip]))
    line("**all**", "all", "mean", mean(rows))
    line("**all**", "all", "worst", [f"{ratio:.2f}" for ratio in ratios(rows).max(0)])
    sky = np.array([[row.sky[name] for name in names] for row in rows]).mean(0)
    line("**all, under an even sky**", "all", "mean", [f"{share:.1%}" for share in sky])
    return "\n".join(lines) + "\n"
