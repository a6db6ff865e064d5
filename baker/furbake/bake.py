"""The pipeline: from a mesh and options to a folder, one call per stage, in reading order."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass, field, replace
from importlib.metadata import version
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from furbake.asset.gltf import write_gltf
from furbake.asset.store import atomic_file, atomic_folder
from furbake.body import prepare
from furbake.identity import bake_key, describe_input, library_versions
from furbake.options import BakeOptions
from furbake.pelt import basis as bases
from furbake.pelt.basis import Basis, environment
from furbake.pelt.fill import fill, fill_directions
from furbake.pelt.fin import FIN_FRAME, fit_fin, side_view
from furbake.pelt.fit import Judge, fit, relight
from furbake.pelt.pelt import FinPelt, Pelt
from furbake.pelt.quantise import byte_range, dequantise, quantise, signed_bytes, srgb_bytes, unit_bytes
from furbake.pelt.strands import Strands, grow
from furbake.pelt.transport import LOWEST, LOWEST_FLAT, hemisphere, sample
from furbake.pelt.volume import Volume, coarsen, fine_shape, voxelise
from furbake.surface.fins import build_fins

STAGES = ("mesh", "strands", "volume", "light", "fit", "fins", "write")

FIN_LIGHTS, FIN_HELD_OUT = 64, 16
"""Lights of a fin's fit, and others that it does not see: enough for six numbers."""


Progress = Callable[[str, float], None]
Floats = NDArray[np.float64]
Single = NDArray[np.float32]


@dataclass(frozen=True)
class BakeResult:
    """Where the asset is, what `bake.json` says, and what is not stored: seconds of every stage, what was repaired."""

    folder: Path
    record: dict[str, Any]
    seconds: dict[str, float]
    notices: tuple[str, ...] = ()


@dataclass
class _Clock:
    """Tells the caller which stage has begun, and times it."""

    progress: Progress
    seconds: dict[str, float] = field(default_factory=dict)

    @contextmanager
    def stage(self, name: str) -> Iterator[Callable[[float], None]]:
        start = time.perf_counter()
        self.progress(name, 0.0)
        yield lambda fraction: self.progress(name, fraction)
        self.seconds[name] = time.perf_counter() - start
        self.progress(name, 1.0)


@dataclass(frozen=True)
class Lighting:
    """Directions, which of them the fit does not see, and L under each of them.

    lights : (n, 3), held_out : (n,) bool, samples : (n, K, N, N) float32
    """

    lights: Floats
    held_out: NDArray[np.bool_]
    samples: Single


def bake(
    model: str,
    out: Path,
    options: BakeOptions | None = None,
    *,
    force: bool = False,
    samples: Path | None = None,
    progress: Progress = lambda stage, fraction: None,
) -> BakeResult:
    """Bake `model` (a file or the name of a built-in shape) into the folder `out`, whole or not at all.

    samples : optional file for the physics itself, for others to check
    progress : called with a stage of `STAGES` and the fraction of it that is done

    Raises OptionError, MeshError or StoreError, each with one sentence.
    """
    options = options or BakeOptions()
    options.check()
    clock = _Clock(progress)
    with atomic_folder(out, force) as folder, atomic_file(samples) if samples else nullcontext() as archive:
        with clock.stage("mesh"):
            body = prepare(model, options)
        height = body.length / body.tile
        with clock.stage("strands"):
            strands = grow(options.coat, height, options.seed)
        with clock.stage("volume"):
            fine = voxelise(strands, height, *fine_shape(options.layers, options.size, height), options.coat.opacity)
            volume = coarsen(fine, options.layers, options.size)
        with clock.stage("light") as step:
            lighting = light(fine, options, step)
        with clock.stage("fit"):
            pelt, figures = fit_pelt(volume, lighting, options)
        with clock.stage("fins"):
            fins = None
            if options.fins:
                lean = float(volume.drift[-1, 1])
                fins = build_fins(body.ground, body.direction, body.tile, lean, options.seed, body.length)
            if fins is not None and len(fins.faces):
                fin, figures["fin"] = fit_side(strands, fine, options)
                pelt = replace(pelt, fin=fin)
            else:  # a body that is all creases
                fins = None
        with clock.stage("write"):
            record = {
                "furbake": version("furbake"),
                "libraries": library_versions(),
                "options": options.as_record(),
                "input": describe_input(model, body.skin),
                "key": bake_key(model, options),
                "fit": figures,
            }
            base = None if body.ground is body.skin else body.ground
            record["asset"] = write_gltf(
                folder, body.skin, body.charts, body.fur, pelt, body.length, fins, base, body.features
            )
            (folder / "bake.json").write_text(json.dumps(record, indent=1) + "\n", "utf-8")
            if archive is not None:
                write_samples(archive, volume, lighting, strands)
    return BakeResult(out, record, clock.seconds, body.skin.notices)


def light(
    fine: Volume,
    options: BakeOptions,
    step: Callable[[float], None] = lambda fraction: None,
    held_out: int | None = None,
) -> Lighting:
    """Sample the oversampled volume under the lights of the fit and others between them, by default half as many."""
    lowest = LOWEST_FLAT if options.flat else LOWEST
    fitted = hemisphere(options.lights, lowest=lowest)
    others = hemisphere(held_out or max(8, options.lights // 2), turn=1.0, lowest=lowest)
    lights = np.concatenate([fitted, others])
    apart = np.arange(len(lights)) >= len(fitted)
    return Lighting(lights, apart, under(lights, fine, options, step))


def under(
    lights: Floats, fine: Volume, options: BakeOptions, step: Callable[[float], None] = lambda fraction: None
) -> Single:
    """L of the stored texels under `lights` (n, 3), (n, K, N, N), as these options have it sampled."""
    coat, layers, size = options.coat, options.layers, options.size
    return sample(fine, layers, size, lights, albedo=coat.albedo, skin=coat.skin, flat=options.flat, progress=step)


def fit_pelt(volume: Volume, lighting: Lighting, options: BakeOptions) -> tuple[Pelt, dict[str, Any]]:
    """Coefficients, bytes and the figures that `bake.json` reports."""
    alpha = volume.coverage
    seen, unseen = lighting.lights[~lighting.held_out], lighting.lights[lighting.held_out]
    samples = lighting.samples[~lighting.held_out]
    basis = choose_basis(samples, alpha, seen, options)
    coefficients = fit(samples, basis, seen)
    filled = fill(coefficients, alpha)
    scale, bias = byte_range(filled, alpha)
    phi = basis(seen)
    codes = quantise(filled, scale, bias, phi.T @ phi / len(phi))
    coverage, tint = unit_bytes(alpha), unit_bytes(fill(volume.tint[..., None], alpha)[..., 0])
    pelt = Pelt(
        codes=codes,
        alpha=coverage,
        tint=tint,
        colour=srgb_bytes(fill(options.ramp.colour(volume.tint, volume.hue), alpha)) if options.colour_plane else None,
        scale=scale,
        bias=bias,
        kind=basis.kind,
        degree=basis.degree,
        matrix=basis.matrix,
        environment=environment(basis),
        drift=volume.drift,
        height=volume.height,
        ramp=options.ramp,
        direction=signed_bytes(fill_directions(volume.tangent, alpha)) if options.directions else None,
    )
    judge = Judge(lighting.samples[lighting.held_out], alpha, volume.tint)
    fitted, stored = relight(coefficients, basis, unseen), relight(dequantise(codes, scale, bias), basis, unseen)
    quantised = judge.figures(stored)
    figures = judge.figures(fitted) | {
        "psnr_quantised": quantised["psnr"],
        "psnr_quantised_composite": quantised["psnr_composite"],
        "psnr_quantisation": judge.between(stored, relight(filled, basis, unseen)),
        "bound": judge.bound(basis.coefficients),
    }
    return pelt, figures


def choose_basis(samples: Single, alpha: Floats, lights: Floats, options: BakeOptions) -> Basis:
    """The paper's polynomial, or the light curves that suit this fur best."""
    if options.basis == "ptm":
        return bases.PTM
    return bases.eigen(samples.reshape(len(samples), -1), alpha.ravel(), lights, options.coefficients)


def fit_side(strands: Strands, fine: Volume, options: BakeOptions) -> tuple[FinPelt, dict[str, float]]:
    """The fins' texture, and how good it is: `psnr` and `r2` over lights that its fit did not see."""
    fitted = hemisphere(min(options.lights, FIN_LIGHTS))
    unseen = hemisphere(FIN_HELD_OUT, turn=1.0)
    lights = np.concatenate([fitted, unseen])
    view = side_view(strands, fine, options.layers, options.size, lights, options.coat, flat=options.flat)
    colour = options.ramp.colour(view.tint, view.hue) if options.colour_plane else None
    fin = fit_fin(replace(view, light=view.light[: len(fitted)]), fitted, colour)
    judge = Judge(view.light[len(fitted) :, :, None].astype(np.float32), view.alpha[:, None], view.tint[:, None])
    stored = relight(dequantise(fin.codes, fin.scale, fin.bias), bases.PTM, unseen[:, FIN_FRAME])
    figures = judge.figures(stored[:, :, None])
    return fin, {name: figures[name] for name in ("psnr", "r2")}


def write_samples(archive: BinaryIO, volume: Volume, lighting: Lighting, strands: Strands) -> None:
    """The physics for others to check, as a NumPy archive."""
    np.savez_compressed(
        archive,
        sigma=volume.sigma,
        tangent=volume.tangent,
        tint=volume.tint,
        height=volume.height,
        lights=lighting.lights,
        held_out=lighting.held_out,
        L=lighting.samples,
        strands=strands.points,
        radius=strands.radius,
    )
