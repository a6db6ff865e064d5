"""The pipeline: from a mesh and options to a folder, one call per stage, in reading order."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Iterator, Sequence
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
from furbake.pelt.basis import Basis
from furbake.pelt.bent import fit_bends
from furbake.pelt.fill import fill, fill_directions
from furbake.pelt.fit import Judge, fit, relight
from furbake.pelt.pelt import Pelt, State
from furbake.pelt.quantise import byte_range, dequantise, quantise, signed_bytes, srgb_bytes, unit_bytes
from furbake.pelt.states import Fur, chosen, in_state
from furbake.pelt.strands import Strands, grow
from furbake.pelt.transport import LOWEST, LOWEST_FLAT, hemisphere, sample
from furbake.pelt.volume import Volume, coarsen, fine_shape, voxelise
from furbake.sides import fit_sides
from furbake.surface.fins import build_fins

STAGES = ("mesh", "strands", "volume", "light", "fit", "fins", "write")

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


@dataclass(frozen=True)
class Sampled:
    """A state of the fur: the stored slabs, and the light in them."""

    state: State
    volume: Volume
    lighting: Lighting


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
            furs = [
                in_state(state, options.coat, strands, height, options.seed)
                for state in chosen(options.states, options.dirt)
            ]
        with clock.stage("volume"):
            fine = furs[0].voxels(options.layers, options.size)

        def voxels(fur: Fur) -> Volume:
            """Of the states but the dry one the fine volumes are made anew: all of them at once take much memory."""
            return fine if fur is furs[0] else fur.voxels(options.layers, options.size)

        with clock.stage("light") as step:
            share = zip(furs, parts(step, len(furs)), strict=True)
            lit = [sampled(fur, voxels(fur), options, part) for fur, part in share]
        with clock.stage("fit") as step:
            pelts, figures = map(list, zip(*fit_pelts(lit, options), strict=True))
            if not options.flat:
                pelts[0] = replace(pelts[0], bent=fit_bends(pelts[0], strands, options.coat, step))
        with clock.stage("fins"):
            fins = None
            if options.fins:
                lean = float(pelts[0].drift[-1, 1])
                fins = build_fins(body.ground, body.direction, body.tile, lean, options.seed, body.length)
            if fins is not None and len(fins.faces):
                sides = fit_sides(((fur, voxels(fur)) for fur in furs), options)
                pelts = [replace(pelt, fin=fin) for pelt, (fin, _) in zip(pelts, sides, strict=True)]
                figures = [found | {"fin": fin} for found, (_, fin) in zip(figures, sides, strict=True)]
            else:  # a body that is all creases
                fins = None
        with clock.stage("write"):
            record = {
                "furbake": version("furbake"),
                "libraries": library_versions(),
                "options": options.as_record(),
                "input": describe_input(model, body.skin),
                "key": bake_key(model, options),
                "fit": figures[0],
            }
            if len(pelts) > 1:
                record["states"] = [
                    {"name": pelt.state.name, "wetness": pelt.state.wetness, "dirt": pelt.state.dirt, "fit": found}
                    for pelt, found in zip(pelts, figures, strict=True)
                ]
            base = None if body.ground is body.skin else body.ground
            record["asset"] = write_gltf(
                folder,
                body.skin,
                body.charts,
                body.fur,
                pelts[0],
                body.length,
                fins,
                base,
                body.features,
                tuple(pelts[1:]),
            )
            (folder / "bake.json").write_text(json.dumps(record, indent=1) + "\n", "utf-8")
            if archive is not None:
                write_samples(archive, lit[0], strands)
    return BakeResult(out, record, clock.seconds, body.skin.notices)


def grown(options: BakeOptions) -> tuple[Strands, Volume, Volume]:
    """Dry fur on no body: its strands, the oversampled volume and the slabs that are stored of it."""
    height = options.own_height
    strands = grow(options.coat, height, options.seed)
    fine = voxelise(strands, height, *fine_shape(options.layers, options.size, height), options.coat.opacity)
    return strands, fine, coarsen(fine, options.layers, options.size)


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


def parts(step: Callable[[float], None], count: int) -> Iterator[Callable[[float], None]]:
    """Progress of `count` equal parts of a stage."""

    def part(number: int) -> Callable[[float], None]:
        return lambda fraction: step((number + fraction) / count)

    return map(part, range(count))


def sampled(
    fur: Fur, fine: Volume, options: BakeOptions, step: Callable[[float], None] = lambda fraction: None
) -> Sampled:
    """A state of the fur as stored slabs, and the light in it; fine : its oversampled volume."""
    lighting = light(fine, replace(options, coat=fur.coat), step)
    return Sampled(fur.state, coarsen(fine, options.layers, options.size), lighting)


def fit_pelt(volume: Volume, lighting: Lighting, options: BakeOptions) -> tuple[Pelt, dict[str, Any]]:
    """Coefficients, bytes and the figures that `bake.json` reports, of dry fur alone."""
    return fit_pelts([Sampled(State(), volume, lighting)], options)[0]


def fit_pelts(states: Sequence[Sampled], options: BakeOptions) -> list[tuple[Pelt, dict[str, Any]]]:
    """As `fit_pelt`, of several states of the same fur under the same lights, with one basis, one λ and one Ω."""
    held_out, lights = states[0].lighting.held_out, states[0].lighting.lights
    seen, unseen = lights[~held_out], lights[held_out]
    samples = [state.lighting.samples[~held_out] for state in states]
    alphas = np.concatenate([state.volume.coverage for state in states])
    joined = samples[0] if len(states) == 1 else np.concatenate(samples, axis=1)
    basis = choose_basis(joined, alphas, seen, options)
    coefficients = [fit(part, basis, seen) for part in samples]
    filled = [fill(part, state.volume.coverage) for part, state in zip(coefficients, states, strict=True)]
    scale, bias = byte_range(np.concatenate(filled), alphas)
    phi = basis(seen)
    found = []
    for state, fitted, stored in zip(states, coefficients, filled, strict=True):
        volume, alpha = state.volume, state.volume.coverage
        dirty = state.state.dirt > 0
        codes = quantise(stored, scale, bias, phi.T @ phi / len(phi))
        colour = options.ramp.colour(volume.tint, volume.hue) if options.colour_plane and not dirty else None
        pelt = Pelt(
            codes=codes,
            alpha=unit_bytes(alpha),
            tint=unit_bytes(fill(volume.tint[..., None], alpha)[..., 0]),
            colour=None if colour is None else srgb_bytes(fill(colour, alpha)),
            scale=scale,
            bias=bias,
            kind=basis.kind,
            degree=basis.degree,
            matrix=basis.matrix,
            drift=volume.drift,
            height=volume.height,
            ramp=options.ramp,
            direction=signed_bytes(fill_directions(volume.tangent, alpha)) if options.directions else None,
            state=state.state,
        )
        judge = Judge(state.lighting.samples[held_out], alpha, np.ones_like(alpha) if dirty else volume.tint)
        curves, bytes_ = relight(fitted, basis, unseen), relight(dequantise(codes, scale, bias), basis, unseen)
        quantised = judge.figures(bytes_)
        figures = judge.figures(curves) | {
            "psnr_quantised": quantised["psnr"],
            "psnr_quantised_composite": quantised["psnr_composite"],
            "psnr_quantisation": judge.between(bytes_, relight(stored, basis, unseen)),
            "bound": judge.bound(basis.coefficients),
        }
        found.append((pelt, figures))
    return found


def choose_basis(samples: Single, alpha: Floats, lights: Floats, options: BakeOptions) -> Basis:
    """The paper's polynomial, or the light curves that suit this fur best."""
    if options.basis == "ptm":
        return bases.PTM
    return bases.eigen(samples.reshape(len(samples), -1), alpha.ravel(), lights, options.coefficients)


def write_samples(archive: BinaryIO, dry: Sampled, strands: Strands) -> None:
    """The physics of the dry fur for others to check, as a NumPy archive."""
    volume, lighting = dry.volume, dry.lighting
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
