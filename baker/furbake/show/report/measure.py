"""Figures of a report: the pelt sampled again from the options in bake.json, beside the stored bytes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from furbake.asset.inspect import summary
from furbake.asset.read import Asset, AssetError, read_asset
from furbake.asset.stored import read_pelt
from furbake.imported.stored import tile_strands
from furbake.options import BakeOptions, OptionError
from furbake.pelt.hairs.shown import shown_slabs
from furbake.pelt.hairs.volume import Volume, fine_shape, voxelise
from furbake.pelt.pelt import Pelt
from furbake.pelt.texels.fill import fill
from furbake.pelt.texels.fit import VISIBLE, Judge, decibels, fit, relight
from furbake.pelt.texels.quantise import unit_bytes
from furbake.tile.fitting import choose_basis
from furbake.tile.lighting import Lighting, light, under

Array = NDArray[np.float64]
Single = NDArray[np.float32]
Progress = Callable[[str, float], None]

STAGES = ("strands", "volume", "light", "lamps", "judge", "model", "write")

HIGHEST, LOWEST, SHOWN = 75.0, 15.0, 8
"""Elevations, degrees, between which the lights of the pictures go once around, and their number."""

SWEEP, SWEEP_STEPS = 84.0, 25
"""The light of the curves goes from −`SWEEP` to `SWEEP` degrees from upright."""

RANKS = 12
CURVE_LAYERS = (0.9, 0.55, 0.2)
"""Heights of the texels whose curves are shown."""


@dataclass(frozen=True)
class Curve:
    """Light of one texel, (SWEEP_STEPS,) each, as sampled and as stored. hard: fitted worse than most of its layer."""

    layer: int
    row: int
    column: int
    hard: bool
    truth: Array
    stored: Array


@dataclass(frozen=True)
class Rivals:
    """Decibels on unseen lights: the bound for 1, 2 ... numbers per texel, and what each basis reaches.

    spectrum : share of the samples' energy in each light curve, falling
    """

    spectrum: Array
    bound: Array
    eigen: dict[int, float]
    ptm: float
    stored: float


@dataclass(frozen=True)
class Quantisation:
    """histogram : (C, 256) visible texels per byte, saturated : share at either end.

    plain : dB of rounding every number by itself, stored : of the bytes in the folder
    """

    histogram: Array
    saturated: float
    plain: float
    stored: float


@dataclass(frozen=True)
class Measured:
    """Everything a page needs.

    lights : (8, 3); truth, fitted : (8, K, N, N) samples and the light of the stored bytes
    layers : (K,) dB of each layer on unseen lights; by_light : (n, 2) elevation in degrees and dB of unseen lights
    """

    asset: Asset
    pelt: Pelt
    options: BakeOptions
    files: dict[str, int]
    alpha: Array
    judge: Judge
    lights: Array
    truth: Single
    fitted: Single
    angles: Array
    leaning: bool
    curves: tuple[Curve, ...]
    layers: Array
    by_light: Array
    rivals: Rivals
    quantisation: Quantisation
    doubts: tuple[str, ...]


def measure(folder: Path, progress: Progress = lambda stage, fraction: None) -> Measured:
    """Read a baked folder and sample its pelt again.

    Raises AssetError where it is no whole bake, or its record cannot be understood.
    """
    asset = read_asset(folder)
    pelt = read_pelt(asset)
    options = recorded_options(asset, pelt)
    files = dict(summary(asset)["files"]) | {"bake.json": (folder / "bake.json").stat().st_size}
    progress("strands", 0.0)
    strands = tile_strands(asset, options.coat, pelt.height, options.seed)
    progress("strands", 1.0)
    progress("volume", 0.0)
    fine = voxelise(strands, pelt.height, *fine_shape(options.layers, options.size, pelt.height), options.coat.opacity)
    volume = shown_slabs(fine, strands, options.layers, options.size)
    progress("volume", 1.0)
    lighting = light(fine, replace(options, curves="none"), lambda fraction: progress("light", fraction))
    angles, sweep, leaning = sweep_lights(pelt)
    shown = spiral_lights()
    extra = under(np.concatenate([shown, sweep]), fine, options, lambda fraction: progress("lamps", fraction))
    progress("judge", 0.0)
    unseen = lighting.lights[lighting.held_out]
    judge = Judge(lighting.samples[lighting.held_out], volume.coverage, volume.tint)
    relit = pelt.light(unseen)
    errors, weights = judge.layer_errors(relit)
    progress("judge", 0.3)
    rivals = compare(judge, pelt, lighting, options, judge.figures(relit)["psnr"])
    progress("judge", 0.8)
    measured = Measured(
        asset=asset,
        pelt=pelt,
        options=options,
        files=files,
        alpha=volume.coverage,
        judge=judge,
        lights=shown,
        truth=extra[:SHOWN],
        fitted=pelt.light(shown),
        angles=angles,
        leaning=leaning,
        curves=choose_curves(extra[SHOWN:], pelt.light(sweep), volume.coverage),
        layers=np.array([decibels(e / max(w, 1e-9)) for e, w in zip(errors, weights, strict=True)]),
        by_light=np.stack([np.degrees(np.arcsin(unseen[:, 2])), light_decibels(judge, relit)], 1),
        rivals=rivals,
        quantisation=quantisation(pelt, judge, lighting),
        doubts=tuple(doubts(asset, pelt, volume, rivals.stored)),
    )
    progress("judge", 1.0)
    return measured


def recorded_options(asset: Asset, pelt: Pelt) -> BakeOptions:
    """The options that bake.json records. Raises AssetError where they are missing or are not those of the pelt."""
    record = asset.record
    for key, kind in (("furbake", str), ("options", dict), ("input", dict), ("fit", dict)):
        if not isinstance(record.get(key), kind):
            what = f"no {key}" if record else "missing or empty"
            raise AssetError(f"bake.json: {what}, expected the record of a bake")
    if (photographed := record["options"].get("swatch")) is not None:
        raise AssetError(f"bake.json: fur that was photographed ({photographed}), expected grown hairs")
    try:
        options = BakeOptions.from_record(record["options"])
        options.check()
    except (OptionError, TypeError, ValueError, LookupError, AttributeError) as error:
        raise AssetError(f"bake.json: options that this furbake cannot read ({error}), expected its own") from error
    for name, got in (("layers", pelt.layers), ("size", pelt.size), ("coefficients", pelt.coefficients)):
        if getattr(options, name) != got:
            raise AssetError(f"bake.json: {name} {getattr(options, name)}, expected {got} as in model.gltf")
    return options


def spiral_lights() -> Array:
    """Lights once around the tile while they sink, (8, 3)."""
    elevation = np.radians(np.linspace(HIGHEST, LOWEST, SHOWN))
    azimuth = 2 * np.pi * np.arange(SHOWN) / SHOWN
    return np.stack([np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth), np.sin(elevation)], 1)


def sweep_lights(pelt: Pelt) -> tuple[Array, Array, bool]:
    """Degrees from upright, the lights (n, 3) over the tile along the fur's lean, and whether it leans at all."""
    across = pelt.drift[-1]
    leaning = bool(np.hypot(*across) > 0.02)
    across = across / np.hypot(*across) if leaning else np.array([1.0, 0.0])
    angles = np.linspace(-SWEEP, SWEEP, SWEEP_STEPS)
    sine, cosine = np.sin(np.radians(angles)), np.cos(np.radians(angles))
    return angles, np.stack([sine * across[0], sine * across[1], cosine], 1), leaning


def choose_curves(truth: Single, stored: Single, alpha: Array) -> tuple[Curve, ...]:
    """At each of `CURVE_LAYERS` the texel of the median error and one that 95 of 100 are better than."""
    curves = []
    for height in CURVE_LAYERS:
        layer = min(int(height * len(alpha)), len(alpha) - 1)
        dense = alpha[layer].ravel() >= min(0.3, float(alpha[layer].max()))
        error = ((truth[:, layer] - stored[:, layer]) ** 2).mean(0).ravel()
        texels = np.flatnonzero(dense)
        order = texels[np.argsort(error[texels], kind="stable")]
        for share in (0.5, 0.95):
            row, column = divmod(int(order[int(share * (len(order) - 1))]), alpha.shape[2])
            lit = (np.asarray(light[:, layer, row, column], np.float64) for light in (truth, stored))
            curves.append(Curve(layer, row, column, share > 0.5, *lit))
    return tuple(curves)


def light_decibels(judge: Judge, relit: Single) -> Array:
    """α-weighted dB of each light by itself, (n,)."""
    square = ((relit - judge.truth) / judge.peak) ** 2
    errors = np.einsum("nkrc,krc->n", square, judge.alpha) / judge.alpha.sum()
    return np.array([decibels(float(error)) for error in errors])


def compare(judge: Judge, pelt: Pelt, lighting: Lighting, options: BakeOptions, stored: float) -> Rivals:
    """Both bases before quantisation, with the pelt's mean curves, if any, and the bound for numbers without them."""
    weighted = (judge.truth * np.sqrt(judge.alpha).astype(np.float32)).reshape(len(judge.truth), -1)
    energy = np.maximum(np.linalg.eigvalsh((weighted @ weighted.T).astype(np.float64))[::-1], 0)
    lost = energy.sum() - np.cumsum(energy)
    scale = len(judge.truth) * judge.peak**2 * judge.alpha.sum()
    ranks = min(RANKS, len(energy) - 1)
    seen, unseen = lighting.lights[~lighting.held_out], lighting.lights[lighting.held_out]
    samples, mean = lighting.samples[~lighting.held_out], pelt.mean(seen)

    def reach(variant: BakeOptions) -> float:
        basis = choose_basis(samples, judge.alpha, seen, variant, mean)
        return judge.figures(relight(fit(samples, basis, seen, mean), basis, unseen, pelt.mean(unseen)))["psnr"]

    return Rivals(
        spectrum=energy[:ranks] / energy.sum(),
        bound=np.array([decibels(float(part / scale)) for part in lost[:ranks]]),
        eigen={count: reach(replace(options, basis="eigen", coefficients=count)) for count in range(3, 7)},
        ptm=reach(replace(options, basis="ptm", coefficients=6)),
        stored=stored,
    )


def quantisation(pelt: Pelt, judge: Judge, lighting: Lighting) -> Quantisation:
    """How the bytes are used, and what they cost beside rounding each number by itself."""
    seen, unseen = lighting.lights[~lighting.held_out], lighting.lights[lighting.held_out]
    basis, there = pelt.basis, pelt.mean(unseen)
    exact = fill(fit(lighting.samples[~lighting.held_out], basis, seen, pelt.mean(seen)), judge.alpha)
    rounded = np.clip(np.round(exact / pelt.scale + pelt.bias), 0, 255).astype(np.uint8)
    codes = pelt.codes[judge.alpha > VISIBLE]
    wanted = relight(exact, basis, unseen, there)
    plain, stored = (
        judge.between(relight(some.values, basis, unseen, there), wanted)
        for some in (replace(pelt, codes=rounded), pelt)
    )
    return Quantisation(
        histogram=np.stack([np.bincount(codes[:, i], minlength=256) for i in range(pelt.coefficients)]).astype(float),
        saturated=float(((codes == 0) | (codes == 255)).mean()) if codes.size else 0.0,
        plain=plain,
        stored=stored,
    )


def doubts(asset: Asset, pelt: Pelt, volume: Volume, psnr: float) -> list[str]:
    """Sentences on contradictions: another version, other strands, other figures."""
    found = []
    made, now = asset.record["furbake"], version("furbake")
    if made != now:
        found.append(
            f"This folder was baked by furbake {made}; its samples are shown here as furbake {now} takes them."
        )
    if np.abs(unit_bytes(volume.coverage).astype(int) - pelt.alpha).mean() > 0.5:
        found.append("The strands that the recorded options grow today are not those in the planes: bake it again.")
    recorded = number(asset.record["fit"].get("psnr_quantised"))
    if recorded is not None and abs(recorded - psnr) > 0.05:
        found.append(
            f"bake.json says {recorded:.2f} dB for the stored bytes, sampled again it is {psnr:.2f} dB: bake it again."
        )
    return found


def number(value: Any) -> float | None:
    """A figure of the record, if it is one."""
    return float(value) if isinstance(value, (int, float)) and not isinstance(value, bool) else None
