"""A flat bake beside a path tracer that renders its very strands: correlations, ratios, a picture.

The bake must be flat (`--flat`): black skin, no curve of the body, a light without size. All hairs reflect alike in
both, so tint is left out. Nothing is searched for: orientation is the format's, the unit of light is the same.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from numpy.typing import NDArray

from furbake.asset.planes import write_png
from furbake.asset.read import read_asset
from furbake.asset.stored import read_pelt
from furbake.options import BakeOptions, OptionError
from furbake.pelt.hairs.shown import shown_slabs
from furbake.pelt.hairs.strands import Strands, grow
from furbake.pelt.hairs.volume import Volume, fine_shape, pool, voxelise
from furbake.pelt.pelt import Pelt
from furbake.pelt.texels.fit import Judge
from furbake.pelt.texels.quantise import srgb_bytes
from furbake.study.verify.pathtrace import DEPTH, Tracer, VerifyError, load, tiles_around, write_tiles
from furbake.tile.lighting import under

Array = NDArray[np.float64]
Bytes = NDArray[np.uint8]
Progress = Callable[[str, float], None]

ELEVATIONS = (75, 60, 50, 40, 35, 30, 25, 20)
"""Degrees of the lights above the plane. Their azimuths follow each other by the golden angle, near enough."""

TURN = 0.382

SAMPLES = 512
"""Paths per pixel. Noise alone holds r of the darkest image of `paper` below 0.92 with 128, below 0.98 with 512."""

MAX_PIXELS = 64
"""Pixels per side of the compared images at most, for which the targets hold; finer pelts are averaged down to it."""

TARGETS = {
    ("samples", "r"): 0.86,
    ("samples", "r_worst"): 0.82,
    ("samples", "r_brightness"): 0.95,
    ("fit", "r"): 0.74,
    ("fit", "r_brightness"): 0.95,
}
"""Correlations that a bake should reach."""

OTHER_STRANDS = 0.01
"""Mean difference of α above which the stored strands are not those that the options grow. Rounding makes 0.001."""

GAP, MIN_SIDE = 4, 160
"""Pixels between the pictures, and their side at least."""


@dataclass(frozen=True)
class Views:
    """The tile from straight above under n lights, (n, P, P) each in the unit of L, and its coverage, (P, P)."""

    traced: Array
    samples: Array
    fit: Array
    covered: Array
    coverage: Array


def verify(
    folder: Path,
    *,
    picture: Path | None = None,
    spp: int = SAMPLES,
    depth: int = DEPTH,
    progress: Progress = lambda stage, fraction: None,
) -> dict[str, Any]:
    """Render the strands of a flat bake with Mitsuba 3 and compare; plain data.

    picture : optional PNG: a row per light, traced | samples | stored fit, all at one exposure
    spp : paths per pixel; depth : vertices of the longest path, 2 for direct light only
    progress : called with a stage ("strands", "light", "trace") and the fraction of it that is done

    Raises VerifyError where the bake is not flat or Mitsuba is missing, AssetError where the folder is no whole asset.
    """
    if spp < 1 or depth < 2:
        raise VerifyError(f"spp {spp}, depth {depth}: expected at least 1 and 2")
    asset = read_asset(folder)
    options = flat_options(asset.record, folder)
    pelt = read_pelt(asset)
    load()
    views = look(pelt, options, spp, depth, progress)
    if picture is not None:
        write_png(picture, side_by_side(views), srgb=True)
    return figures(views) | {"spp": spp, "depth": depth, "pixels": int(views.traced.shape[1])}


def flat_options(record: dict[str, Any], folder: Path) -> BakeOptions:
    """The options in bake.json. Raises VerifyError where they are missing, unreadable, or not of a flat bake."""
    if not isinstance(record.get("options"), dict):
        raise VerifyError(f"{folder}: no options in bake.json, expected a folder that furbake bake --flat wrote")
    try:
        options = BakeOptions.from_record(record["options"])
    except (OptionError, TypeError, ValueError, LookupError) as error:
        raise VerifyError(f"{folder}: options in bake.json not understood ({error}), bake it again") from error
    if not options.flat:
        raise VerifyError(f"{folder}: not a flat bake, bake it with --flat: curved bodies have no strands to compare")
    return options


def grown_again(pelt: Pelt, options: BakeOptions) -> tuple[Strands, Volume, Array]:
    """Strands of a bake, their oversampled volume and the coverage of its slabs.

    Raises VerifyError where the options do not grow the strands that are stored.
    """
    strands = grow(options.coat, pelt.height, options.seed)
    fine = voxelise(strands, pelt.height, *fine_shape(pelt.layers, pelt.size, pelt.height), options.coat.opacity)
    alpha = shown_slabs(fine, strands, pelt.layers, pelt.size).coverage
    if float(np.abs(alpha - pelt.alpha / 255).mean()) > OTHER_STRANDS:
        raise VerifyError("bake.json: its options do not grow this bake's strands, bake it again with this furbake")
    return strands, fine, alpha


def lights() -> Array:
    """The directions towards the lights of the comparison, (8, 3)."""
    return directions(np.radians(ELEVATIONS), 2 * np.pi * TURN * np.arange(len(ELEVATIONS)))


def directions(elevation: NDArray[np.floating], azimuth: NDArray[np.floating]) -> Array:
    """Unit vectors of elevations above the plane and azimuths from u, radians, (n,) each: (n, 3)."""
    level = np.cos(elevation)
    return np.asarray(np.stack([level * np.cos(azimuth), level * np.sin(azimuth), np.sin(elevation)], -1), np.float64)


def look(pelt: Pelt, options: BakeOptions, spp: int, depth: int, progress: Progress) -> Views:
    """The tile as the path tracer, the samples and the stored bytes show it."""
    progress("strands", 0.0)
    towards = lights()
    strands, fine, alpha = grown_again(pelt, options)
    light = under(towards, fine, options, lambda fraction: progress("light", fraction))
    stored = pelt.light(towards)
    pixels = min(pelt.size, MAX_PIXELS)
    with TemporaryDirectory(prefix="furbake-") as scratch:
        curves = Path(scratch) / "strands.txt"
        around = tiles_around(strands, float(towards[:, 2].min()))
        write_tiles(curves, strands, around)
        tracer = Tracer(curves, around, pixels, spp, options.coat.albedo)
        unit = unit_of(options)
        covered = tracer.covered()
        traced = []
        for number, direction in enumerate(towards):
            progress("trace", number / len(towards))
            traced.append(unit * tracer.lit(direction, depth, seed=number + 1))
    progress("trace", 1.0)
    return Views(
        traced=np.stack(traced),
        samples=pool(composite(light, alpha), pixels),
        fit=pool(composite(stored, pelt.alpha / 255), pixels),
        covered=covered,
        coverage=pool(1 - np.prod(1 - alpha, axis=0), pixels),
    )


def unit_of(options: BakeOptions) -> float:
    """L of a radiance under an irradiance of 1: 4π·radiance/(albedo·irradiance)."""
    return 4 * np.pi / options.coat.albedo


def composite(light: NDArray[np.floating], alpha: Array) -> Array:
    """Σ_k vis_k·α_k·L_k seen from above: (n, K, N, N) and (K, N, N) → (n, N, N)."""
    return np.asarray(Judge(np.asarray(light, np.float32), alpha, np.ones_like(alpha)).composite(light), np.float64)


def correlation(a: Array, b: Array) -> float:
    """Pearson's r; 0 where one of them is constant."""
    a, b = a.ravel() - a.mean(), b.ravel() - b.mean()
    scale = float(np.sqrt((a @ a) * (b @ b)))
    return float(a @ b) / scale if scale > 0 else 0.0


def figures(views: Views) -> dict[str, Any]:
    """Correlations and ratios: of `samples` and `fit` with the tracer, of the coverage, and per light.

    r, r_worst : correlation of the images, mean and least over the lights
    r_brightness : correlation of the images' means over the lights
    ratio : mean brightness over the tracer's, in absolute units
    """
    found: dict[str, Any] = {}
    for name, images in (("samples", views.samples), ("fit", views.fit)):
        each = [correlation(ours, traced) for ours, traced in zip(images, views.traced, strict=True)]
        bright, truth = images.mean((1, 2)), views.traced.mean((1, 2))
        found[name] = {
            "r": float(np.mean(each)),
            "r_worst": min(each),
            "r_brightness": correlation(bright, truth),
            "ratio": float(bright.mean() / truth.mean()),
            "per_light": [
                {"elevation": elevation, "r": r, "brightness": float(ours), "traced": float(theirs)}
                for elevation, r, ours, theirs in zip(ELEVATIONS, each, bright, truth, strict=True)
            ],
        }
    found["coverage"] = {
        "traced": float(views.covered.mean()),
        "pelt": float(views.coverage.mean()),
        "r": correlation(views.coverage, views.covered),
    }
    found["met"] = {
        f"{part}.{name}": {"got": found[part][name], "target": target, "met": found[part][name] >= target}
        for (part, name), target in TARGETS.items()
    }
    return found


def lines(found: dict[str, Any]) -> list[str]:
    """The figures as text for people, a line each."""
    text = [f"path traced: depth {found['depth']}, {found['spp']} paths per pixel, {found['pixels']} pixels a side"]
    for name in ("samples", "fit"):
        part = found[name]
        text.append(
            f"{name}: r {part['r']:.3f}, worst {part['r_worst']:.3f}, over the lights {part['r_brightness']:.3f}, "
            f"brightness {part['ratio']:.2f} of the tracer's"
        )
    cover = found["coverage"]
    text.append(f"coverage: {cover['pelt']:.3f}, traced {cover['traced']:.3f}, r {cover['r']:.3f}")
    missed = [f"{name} {got['got']:.3f} < {got['target']:g}" for name, got in found["met"].items() if not got["met"]]
    text.append("all targets met" if not missed else f"missed: {', '.join(missed)}")
    return text


def side_by_side(views: Views) -> Bytes:
    """sRGB bytes, (height, width, 3): a row per light, columns traced | samples | fit, the larger v on top.

    One exposure for the traced images, one for each of the others, so that their mean brightness is the same: one
    global scale over all lights.
    """
    white = max(float(np.percentile(views.traced, 99.5)), 1e-9)
    times = max(1, -(-MIN_SIDE // views.traced.shape[1]))
    columns = []
    for images in (views.traced, views.samples, views.fit):
        scale = float((views.traced * images).sum() / max(float((images * images).sum()), 1e-12)) / white
        columns.append(np.repeat(np.repeat(srgb_bytes(images[:, ::-1] * scale), times, 1), times, 2))
    grid = np.stack(columns, 1)
    framed = np.pad(grid, ((0, 0), (0, 0), (0, GAP), (0, GAP)))
    rows, across, high, wide = framed.shape
    sheet = framed.transpose(0, 2, 1, 3).reshape(rows * high, across * wide)[:-GAP, :-GAP]
    return np.repeat(sheet[..., None], 3, -1)
