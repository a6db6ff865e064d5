"""Data of the lesson, for the page's figures on sampling, fit, bytes and numbers per texel.

A folder for the web, from the very samples that a bake fits:

- `lesson.json`: options, lights, λ and Ω, both bases, and how good they are under lights that no fit has seen
- `plane0.png`, `plane1.png`: the stored bytes of a few layers, packed as in any asset, the lowest on top
- `samplesKK.png`: L of layer KK as measured, 16 bits: a row per light of `lights`, a column per texel whose stored α is
  not 0, in reading order; L = value · `scale` of that layer
- `strands.bin`: float32, little-endian: (strands, points, 4) of u, v, z and radius in tile widths, roots first; then
  (strands,) tint
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from furbake.asset.planes import pack, write_png
from furbake.asset.read import AssetError, read_json
from furbake.asset.store import atomic_folder
from furbake.identity import library_versions
from furbake.options import BakeOptions, OptionError
from furbake.pelt.hairs.shown import shown_slabs
from furbake.pelt.hairs.strands import Strands, grow
from furbake.pelt.hairs.volume import Volume, fine_shape, voxelise
from furbake.pelt.pelt import Pelt
from furbake.pelt.texels.basis import PTM, PTM_TERMS, ptm
from furbake.pelt.texels.eigen import eigen
from furbake.pelt.texels.fill import SOLID, fill
from furbake.pelt.texels.fit import Judge, decibels, fit, relight
from furbake.pelt.texels.quantise import byte_range, dequantise, gram, quantise
from furbake.tile.fitting import fit_pelt
from furbake.tile.lighting import Lighting, light, under

NAME = "lesson.json"

STAGES = ("strands", "volume", "light", "arc", "judge", "write")

LAYOUT = 1
"""Version of the folder's layout: another number makes old folders stale."""

SHOWN = (0.2, 0.45, 0.7, 0.85)
"""Heights of the layers whose samples are kept."""

STEPS = 2047
"""Steps of the kept samples from 0 to their greatest: 0.02 % of it at the most, half as many bytes as 65 535."""

ARC, ARC_LIGHTS = 80.0, 17
"""Degrees from upright between which lights go over the tile along v, the way that most fur leans."""

TERMS = (5, 4, 1, 0, 3, 2)
"""The polynomial's terms by use: no n of the six relight the preset `paper` better than the first n."""

NUMBERS, RANKS, BITS = range(3, PTM_TERMS + 1), range(1, 9), range(2, 11)

POINTS = 13
"""Points per hair at the most."""

DECIMALS = 4

Floats = NDArray[np.float64]
Single = NDArray[np.float32]
Progress = Callable[[str, float], None]


@dataclass(frozen=True)
class _Case:
    """A pelt with what it was made from. samples : (n, K, N, N) of the fit's lights; seen, unseen : lights (n, 3)."""

    volume: Volume
    lighting: Lighting
    pelt: Pelt
    judge: Judge
    samples: Single
    seen: Floats
    unseen: Floats


# Long: a line for each key of lesson.json, in the order in which they are stored.
def write(
    out: Path,
    options: BakeOptions,
    *,
    force: bool = False,
    progress: Progress = lambda stage, fraction: None,
) -> dict[str, Any]:
    """Write the lesson's folder, whole or not at all; what `lesson.json` says.

    progress : called with a stage of `STAGES` and the fraction of it that is done

    Its polynomials are the paper's, without mean curves. The same options and version give the same bytes. Raises
    OptionError or StoreError, each with one sentence.
    """
    options = replace(options, curves="none", bits=8)
    options.check()
    if options.basis != "ptm":
        raise OptionError(f"basis: got {options.basis}, expected ptm: the lesson puts others beside it")
    with atomic_folder(out, force) as folder:
        height = options.own_height
        progress("strands", 0.0)
        strands = grow(options.coat, height, options.seed)
        progress("strands", 1.0)
        fine = voxelise(strands, height, *fine_shape(options.layers, options.size, height), options.coat.opacity)
        volume = shown_slabs(fine, strands, options.layers, options.size)
        progress("volume", 1.0)
        lighting = light(fine, options, lambda fraction: progress("light", fraction))
        angles, arc = arc_lights()
        crossing = under(arc, fine, options, lambda fraction: progress("arc", fraction))
        progress("judge", 0.0)
        pelt, figures = fit_pelt(volume, lighting, options)
        case = _case(volume, lighting, pelt)
        record: dict[str, Any] = {
            "furbake": version("furbake"),
            "libraries": library_versions(),
            "key": lesson_key(options),
            "options": options.as_record(),
            "height": height,
            "lights": _rounded(np.concatenate([lighting.lights, arc]), 7),
            "fitted": len(case.seen),
            "held_out": len(case.unseen),
            "angles": angles.tolist(),
            "singular_values": np.linalg.svd(ptm(case.seen), compute_uv=False).tolist(),
            "terms": list(TERMS),
            "eigen": _eigen(case),
            "scale": pelt.scale.tolist(),
            "bias": pelt.bias.tolist(),
            "peak": case.judge.peak,
            "fit": figures,
        } | _figures(case, lambda fraction: progress("judge", fraction))
        progress("write", 0.0)
        shown = sorted({min(int(share * options.layers), options.layers - 1) for share in SHOWN})
        kept = np.concatenate([lighting.samples, crossing])[:, shown]
        record["samples"] = [
            _write_samples(folder, layer, kept[:, i], pelt.alpha[layer] > 0) for i, layer in enumerate(shown)
        ]
        record["planes"] = _write_planes(folder, pelt, shown)
        record["strands"] = _write_strands(folder, strands)
        record["bytes"] = {path.name: path.stat().st_size for path in sorted(folder.iterdir())}
        (folder / NAME).write_text(json.dumps(record) + "\n", "utf-8")
        progress("write", 1.0)
    return record


def fresh(out: Path, options: BakeOptions) -> dict[str, Any] | None:
    """The record of a whole lesson of the same options and versions in `out`, if there is one."""
    try:
        record = read_json(out / NAME)
        same = (record["libraries"], record["key"]) == (library_versions(), lesson_key(options))
        return record if same and all((out / name).stat().st_size == n for name, n in record["bytes"].items()) else None
    except (AssetError, OSError, LookupError, TypeError, AttributeError):
        return None


def lesson_key(options: BakeOptions) -> str:
    """SHA-256 of everything that decides the folder."""
    record = replace(options, curves="none", bits=8).as_record()
    parts = {"furbake": version("furbake"), "options": record, "layout": LAYOUT}
    return hashlib.sha256(json.dumps(parts, sort_keys=True).encode()).hexdigest()


def arc_lights() -> tuple[Floats, Floats]:
    """Degrees from upright, (n,), and lights over the tile along v, (n, 3)."""
    angles = np.linspace(-ARC, ARC, ARC_LIGHTS)
    sine, cosine = np.sin(np.radians(angles)), np.cos(np.radians(angles))
    return angles, np.stack([np.zeros_like(sine), sine, cosine], 1)


def _case(volume: Volume, lighting: Lighting, pelt: Pelt) -> _Case:
    apart = lighting.held_out
    judge = Judge(lighting.samples[apart], volume.coverage, volume.tint)
    samples, seen, unseen = lighting.samples[~apart], lighting.lights[~apart], lighting.lights[apart]
    return _Case(volume, lighting, pelt, judge, samples, seen, unseen)


def _eigen(case: _Case) -> dict[str, Any]:
    """Six light curves found for this fur; its first n are the best n."""
    flat = case.samples.reshape(len(case.samples), -1)
    found = eigen(flat, case.volume.coverage.ravel(), case.seen, PTM_TERMS)
    return {"degree": found.degree, "matrix": np.asarray(found.matrix).tolist()}


def _figures(case: _Case, step: Callable[[float], None]) -> dict[str, Any]:
    """Decibels by layer, by numbers per texel of either basis and at best, and by bits per number."""
    done, all_of_it = 0, 2 * len(NUMBERS) + len(RANKS) + len(BITS)

    def counted(row: dict[str, Any]) -> dict[str, Any]:
        nonlocal done
        done += 1
        step(done / all_of_it)
        return row

    coefficients = fit(case.samples, PTM, case.seen)
    stored = case.pelt.values
    exact = fill(coefficients, case.volume.coverage)
    return {
        "layers": {
            "psnr": _layers(case.judge, relight(coefficients, PTM, case.unseen)),
            "psnr_quantised": _layers(case.judge, relight(stored, PTM, case.unseen)),
        },
        "ptm": [counted(_polynomial(case, count)) for count in NUMBERS],
        "eigen_figures": [counted(_curves(case, count)) for count in NUMBERS],
        "bound": [counted(_row("numbers", rank, case.judge.bound(rank))) for rank in RANKS],
        "bits": [counted(_coarse(case, exact, bits)) for bits in BITS],
    }


def _polynomial(case: _Case, count: int) -> dict[str, Any]:
    """The polynomial's first `count` terms."""
    terms = list(TERMS[:count])
    return _judged(case, "numbers", count, ptm(case.seen)[:, terms], ptm(case.unseen)[:, terms])


def _curves(case: _Case, count: int) -> dict[str, Any]:
    """The first `count` curves found for this fur."""
    basis = eigen(case.samples.reshape(len(case.samples), -1), case.volume.coverage.ravel(), case.seen, count)
    return _judged(case, "numbers", count, basis(case.seen), basis(case.unseen))


def _judged(case: _Case, name: str, value: int, seen: Floats, unseen: Floats) -> dict[str, Any]:
    """Least squares in any functions of the light: seen (n, C), unseen (m, C)."""
    samples = case.samples.reshape(len(case.samples), -1)
    curves = unseen.astype(np.float32) @ (np.linalg.pinv(seen).astype(np.float32) @ samples)
    relit = np.maximum(curves, 0).reshape(case.judge.truth.shape)
    return _row(name, value, case.judge.figures(relit)) | {"layers": _layers(case.judge, relit)}


def _coarse(case: _Case, exact: Floats, bits: int) -> dict[str, Any]:
    """Numbers of `bits` bits, rounded as the bytes are: against the samples, and against the numbers unrounded.

    layers : the latter of each layer over the texels that are covered by `SOLID`, which no neighbour has filled
    """
    phi, alpha, top = ptm(case.seen), case.volume.coverage, 2**bits - 1
    scale, bias = byte_range(exact, alpha, top)
    codes = quantise(exact, scale, bias, gram(phi), top)
    unrounded, relit = (relight(some, PTM, case.unseen) for some in (exact, dequantise(codes, scale, bias)))
    solid = Judge(unrounded, alpha * (alpha >= SOLID), case.volume.tint)
    errors, weights = solid.layer_errors(relit)
    errors *= (solid.peak / case.judge.peak) ** 2
    return _row("bits", bits, case.judge.figures(relit)) | {
        "noise": round(case.judge.between(relit, unrounded), DECIMALS),
        "layers": _decibels(errors, weights),
    }


def _row(name: str, value: int, figures: dict[str, Any]) -> dict[str, Any]:
    return {name: value} | {key: round(figures[key], DECIMALS) for key in ("psnr", "psnr_composite")}


def _layers(judge: Judge, relit: Single) -> list[float | None]:
    return _decibels(*judge.layer_errors(relit))


def _decibels(errors: Iterable[float], weights: Iterable[float]) -> list[float | None]:
    """Decibels of every layer; None for one without hair."""
    return [round(decibels(e / w), DECIMALS) if w > 0 else None for e, w in zip(errors, weights, strict=True)]


def _rounded(values: Floats, decimals: int) -> Any:
    return np.round(values, decimals).tolist()


def _write_samples(folder: Path, layer: int, samples: Single, covered: NDArray[np.bool_]) -> dict[str, Any]:
    """One layer's picture: samples (n, N, N), covered (N, N)."""
    kept = np.maximum(samples[:, covered], 0)
    scale = float(max(kept.max(initial=0.0), 1e-6)) / STEPS
    name = f"samples{layer:02}.png"
    pixels = np.round(kept / scale).astype(np.uint16)
    if pixels.shape[1] == 0:  # a layer without hair: no picture is that narrow
        pixels = np.zeros((len(samples), 1), np.uint16)
    write_png(folder / name, pixels[..., None])
    return {"layer": layer, "file": name, "texels": int(covered.sum()), "scale": scale}


def _write_planes(folder: Path, pelt: Pelt, layers: list[int]) -> list[str]:
    """The stored bytes of some layers."""
    some = replace(
        pelt, codes=pelt.codes[layers], alpha=pelt.alpha[layers], tint=pelt.tint[layers], colour=None, direction=None
    )
    planes = {f"plane{i}.png": plane for i, plane in enumerate(pack(some).coefficients)}
    for name, plane in planes.items():
        write_png(folder / name, plane)
    return list(planes)


def _write_strands(folder: Path, strands: Strands) -> dict[str, Any]:
    """All hairs, with fewer points."""
    count, most = strands.radius.shape
    kept = np.unique(np.round(np.linspace(0, most - 1, min(POINTS, most))).astype(int))
    curves = np.concatenate([strands.points[:, kept], strands.radius[:, kept, None]], -1).astype("<f4")
    name = "strands.bin"
    (folder / name).write_bytes(curves.tobytes() + strands.tint[:, 0].astype("<f4").tobytes())
    return {"file": name, "strands": count, "points": len(kept)}
