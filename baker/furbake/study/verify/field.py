"""A flat bake seen from all around: a field of its fur without end beside a path tracer, brightness alone.

What shells show of the stored texels, by the law of light and eye, is worked out here as the page does it; the truth is
Mitsuba's picture of the very strands.
"""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from numpy.typing import NDArray

from furbake.asset.read import read_asset
from furbake.asset.stored import read_pelt
from furbake.pelt.eye import factor, surge
from furbake.pelt.pelt import Pelt
from furbake.pelt.seen import ShownTexels
from furbake.study.verify.pathtrace import FIELD, Tracer, VerifyError, load, tiles_around, write_tiles
from furbake.study.verify.tile import Progress, directions, flat_options, grown_again, unit_of

Array = NDArray[np.float64]

EYES = ((90, 0), *((60, at) for at in (10, 130, 250)), *((40, at) for at in (40, 130, 220, 310)))
EYES += tuple((20, at) for at in (0, 90, 180, 270))
"""Elevation and azimuth of the eyes, degrees: upright, and around the zenith."""

LIGHTS = ((75, 30), (40, 100), (40, 250), (15, 20), (15, 190))
"""The same of the lights."""

PIXELS, SAMPLES = 64, 16
"""Pixels a side of what is seen, and paths for each: 65 536 for a brightness."""

MEAN, WORST = 0.15, 0.3
"""How far brightness may be off, on the mean and at worst, shares of the truth."""


def towards(places: tuple[tuple[int, int], ...]) -> Array:
    """Unit vectors of elevations and azimuths in degrees, (n, 3)."""
    return directions(*np.radians(np.array(places, np.float64)).T)


def verify_field(
    folder: Path, *, spp: int = SAMPLES, progress: Progress = lambda stage, fraction: None
) -> dict[str, Any]:
    """Render the strands of a flat bake from all eyes under all lights with Mitsuba 3 and compare; plain data.

    spp : paths per pixel; progress : called with a stage ("strands", "trace") and the fraction of it that is done

    Raises VerifyError where the bake is not flat or Mitsuba is missing, AssetError where the folder is no whole asset.
    """
    if spp < 1:
        raise VerifyError(f"spp {spp}: expected at least 1")
    asset = read_asset(folder)
    options = flat_options(asset.record, folder)
    pelt = read_pelt(asset)
    load()
    progress("strands", 0.0)
    strands, *_ = grown_again(pelt, options)
    eyes, lamps = towards(EYES), towards(LIGHTS)
    traced = np.empty((len(eyes), len(lamps)))
    with TemporaryDirectory(prefix="furbake-") as scratch:
        curves = Path(scratch) / "strands.txt"
        around = FIELD + tiles_around(strands, float(min(eyes[:, 2].min(), lamps[:, 2].min())))
        write_tiles(curves, strands, around)
        tracer = Tracer(curves, around, PIXELS, spp, options.coat.albedo)
        for number in range(traced.size):
            progress("trace", number / traced.size)
            i, j = divmod(number, len(lamps))
            traced[i, j] = unit_of(options) * tracer.field(eyes[i], lamps[j], pelt.height / 2, seed=number + 1)
    progress("trace", 1.0)
    return figures(shown(pelt, eyes, lamps), traced) | {"spp": spp}


def shown(pelt: Pelt, eyes: Array, lamps: Array) -> Array:
    """Mean L that shells of flat fur show to each eye (n, 3) under each lamp (m, 3), as the page draws it: (n, m)."""
    texels, all_lamps = ShownTexels(pelt, lamps, None), np.arange(len(lamps))
    middle, lean = (np.arange(pelt.layers) + 0.5) / pelt.layers, pelt.drift[-1]
    seen = []
    for eye in eyes:
        light, _ = texels.towards(eye, all_lamps)
        beside = np.broadcast_to(eye, lamps.shape)
        if pelt.eye is not None:
            light *= factor(lamps, beside, lean, middle, pelt.eye)
        whole = light.sum(-1) / eye[2]
        seen.append(whole if pelt.surge is None else whole * surge(lamps, beside, pelt.surge))
    return np.stack(seen)


def figures(page: Array, traced: Array) -> dict[str, Any]:
    """How far brightness is off, (eyes, lamps) both, as shares of the truth: mean, worst, and each pair's."""
    off = np.abs(page / traced - 1)
    return {
        "off": {"mean": float(off.mean()), "worst": float(off.max())},
        "met": bool(off.mean() <= MEAN and off.max() <= WORST),
        "eyes": [
            {"elevation": eye[0], "azimuth": eye[1], "page": ours.tolist(), "traced": theirs.tolist()}
            for eye, ours, theirs in zip(EYES, page, traced, strict=True)
        ],
        "lights": [{"elevation": elevation, "azimuth": azimuth} for elevation, azimuth in LIGHTS],
    }


def lines(found: dict[str, Any]) -> list[str]:
    """The figures as text for people, a line each: page over truth by eye and light."""
    heads = "  ".join(f"{light['elevation']:>2}° {light['azimuth']:>3}°" for light in found["lights"])
    text = [f"page over path traced, {found['spp']} paths per pixel; eyes down, lights across", f"{'':10}{heads}"]
    for eye in found["eyes"]:
        ratios = (ours / theirs for ours, theirs in zip(eye["page"], eye["traced"], strict=True))
        row = "  ".join(f"{ratio:>8.2f}" for ratio in ratios)
        text.append(f"{eye['elevation']:>2}° {eye['azimuth']:>3}°  {row}")
    off = found["off"]
    mean, worst = (f"{100 * off[name]:.1f} % ({100 * asked:.0f})" for name, asked in (("mean", MEAN), ("worst", WORST)))
    return [*text, f"off by {mean} on the mean, {worst} at worst; in brackets what is asked"]
