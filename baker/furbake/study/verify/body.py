"""A furry body on the page beside the truth: its very strands, path-traced.

Both show linear light of one distant lamp, hairs of one grey on diffuse skin, nothing around. No scale is fitted.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from furbake.asset.read import Asset, read_asset
from furbake.groom.ground import Ints, read_skin
from furbake.groom.strands import Groom, groom, recorded
from furbake.pelt.hairs.strands import Coat
from furbake.study.cycles import trace as cycles
from furbake.study.grooms import artist_strands
from furbake.study.verify.apart import trace
from furbake.study.verify.ceiling import sampled_ceiling
from furbake.study.verify.cells import PLANS, Cell, Floats, Frame, cells, frame
from furbake.study.verify.figures import contrast, correlation, figures, overlap
from furbake.study.verify.page import SAMPLES, Shown, show
from furbake.study.verify.pathtrace import VerifyError, load
from furbake.study.verify.sheet import write_sheets
from furbake.study.verify.truth import Scene, Traced

Progress = Callable[[str, float], None]

METHODS = ("ptm", "ptm-bare", "lengyel", "shadow-layers", "unlit")
"""Ways to light the fur: its own with shadow map, without it, and its rivals."""

SIZE, SPP = 360, 256
"""Pixels across, and paths per pixel."""

NEAREST = 0.25
"""Least share of the distance, as on the page."""

STAGES = ("strands", "trace", "page")

ROUND = ("sphere", "torus")
"""Built-in shapes that have cells of their own."""


@dataclass(frozen=True)
class Options:
    """Options of the comparison.

    plan : of `PLANS`, None: by the model; methods : some of `METHODS`; size : pixels across; spp : paths per pixel
    distance : of the eyes, share of the one at which all of the fur is seen; close up texels are larger than pixels
    ceiling : whether the samples' own composite is drawn, too, as the last method: what shells show without any fit
    look : strength of highlights and of light from behind on the page, which the truth has not
    truth : file that keeps what was traced, for the next time the same strands are seen
    groom : file of the strands of a baked groom, where its record's is no longer there
    fast : by LLVM, where its library is found
    cycles : Python with Blender in it, whose path tracer then stands in for Mitsuba
    """

    plan: str | None = None
    methods: tuple[str, ...] = METHODS
    size: int = SIZE
    spp: int = SPP
    distance: float = 1.0
    ceiling: bool = False
    look: tuple[float, float] = (0.0, 0.0)
    truth: Path | None = None
    groom: Path | None = None
    fast: bool = True
    cycles: str | None = None

    def check(self) -> None:
        """Raise VerifyError for the first value that is out of range."""
        if self.plan is not None and self.plan not in PLANS:
            raise VerifyError(f"plan: got {self.plan!r}, expected {' or '.join(PLANS)}")
        if unknown := [name for name in self.methods if name not in METHODS]:
            raise VerifyError(f"methods: got {unknown[0]!r}, expected some of {', '.join(METHODS)}")
        if not 32 <= self.size <= 2048:
            raise VerifyError(f"size: got {self.size}, expected 32 to 2048")
        if not NEAREST <= self.distance <= 4:
            raise VerifyError(f"distance: got {self.distance:g}, expected {NEAREST:g} to 4")
        if not all(0 <= strength <= 100 for strength in self.look):
            raise VerifyError(f"look: got {self.look[0]:g},{self.look[1]:g}, expected 0 to 100 each")
        if self.spp < 2:
            raise VerifyError(f"spp: got {self.spp}, expected at least 2")


def verify_body(
    folder: Path,
    options: Options | None = None,
    *,
    picture: Path | None = None,
    progress: Progress = lambda stage, fraction: None,
) -> dict[str, Any]:
    """Trace the strands of a baked fur on its body and compare with the page's pictures; plain data.

    picture : optional PNG: a row per cell, page | truth | difference; of each further method FILE-METHOD.png
    progress : called with a stage of `STAGES` and the fraction of it that is done

    Raises VerifyError where Mitsuba is missing or crashes, PageError where Node or a browser is, AssetError where the
    folder is no whole asset.
    """
    options = options or Options()
    case = prepared(folder, options, progress)
    coat, seen, wanted = case.coat, case.seen, case.cells
    scene = Scene(case.strands, case.vertices, case.faces, coat.albedo, coat.skin)
    traced = traced_pictures(scene, seen, wanted, options, lambda fraction: progress("trace", fraction))
    ceiling = sampled_ceiling(case.asset, wanted) if options.ceiling else None
    shown = show(
        case.asset,
        coat.albedo,
        coat.skin,
        seen,
        wanted,
        options.methods,
        lambda fraction: progress("page", fraction),
        ceiling,
        look=options.look,
    )
    methods = (*options.methods, SAMPLES) if options.ceiling else options.methods
    if picture is not None:
        write_sheets(picture, shown, traced, wanted, methods)
    return {
        **case.record(options),
        "distance": options.distance,
        "cells": [_cell(cell, shown, one, methods) for cell, one in zip(wanted, traced, strict=True)],
    }


@dataclass(frozen=True)
class Case:
    """A baked body, its strands, and the pictures of it that are compared.

    vertices, faces : of the skin; plan : name of one of `PLANS`
    """

    asset: Asset
    coat: Coat
    vertices: Floats
    faces: Ints
    plan: str
    seen: Frame
    cells: list[Cell]
    strands: Groom

    def record(self, options: Options) -> dict[str, Any]:
        """Plain data on what is compared."""
        return {
            "model": str(self.asset.record.get("input", {}).get("name")),
            "hairs": len(self.strands.points),
            "plan": self.plan,
            "size": [self.seen.width, self.seen.height],
            "spp": options.spp,
        }


def prepared(folder: Path, options: Options, progress: Progress, *, coloured: bool = False) -> Case:
    """Check the options, load Mitsuba, read a baked folder and grow its strands."""
    options.check()
    if options.cycles is None:
        load(options.fast, coloured)
    asset = read_asset(folder)
    coat = recorded(asset).coat
    vertices, faces = read_skin(asset)
    name, seen, wanted = planned(asset, vertices, options)
    if options.groom is not None or asset.record.get("options", {}).get("groom") is not None:
        strands = artist_strands(asset, recorded(asset), options.groom)
    else:
        strands = groom(folder, lambda stage, done: progress("strands", done * (0.5 if stage == "roots" else 1)))
    return Case(asset, coat, vertices, faces, name, seen, wanted, strands)


def planned(asset: Asset, vertices: Floats, options: Options) -> tuple[str, Frame, list[Cell]]:
    """Name of the plan by which the body is seen, its frame and its cells."""
    model = str(asset.record.get("input", {}).get("name")).split(":")[0]
    name = options.plan or ("round" if model in ROUND else "body")
    seen = frame(vertices, float(asset.fur["length"]), PLANS[name], options.size, options.distance)
    return name, seen, cells(PLANS[name], seen)


def _cell(cell: Cell, shown: Shown, traced: Traced, methods: Sequence[str]) -> dict[str, Any]:
    """Figures of a cell by every method; over the pixels that either picture covers, without eyes and the like."""
    cosine = shown.normal[cell.view] @ cell.to_lamp
    free = ~shown.feature[cell.view]
    white = max(float(np.percentile(traced.light[traced.cover > 0.5], 99)), 1e-9)
    halves = correlation(*(half[free & (traced.cover > 0.5)] for half in traced.halves))
    found: dict[str, Any] = {"name": cell.name, "view": cell.view, "lamp": cell.lamp, "methods": {}}
    # Spearman and Brown: all paths against as many others.
    found["r_noise"] = 2 * halves / (1 + halves)
    for method in methods:
        light, cover = shown.light[cell.name, method], shown.cover[cell.name, method]
        over = free & ((cover > 0.5) | (traced.cover > 0.5))
        found["outline"] = overlap(cover * free, traced.cover * free)
        found["methods"][method] = figures(light, traced.light, over, cosine, white) | {
            "contrast": contrast(light, traced.halves, over)
        }
    return found


def traced_pictures(
    scene: Scene, seen: Frame, wanted: list[Cell], options: Options, step: Callable[[float], None]
) -> list[Traced]:
    """Pictures of the tracer, or of the file that an earlier run of the same wrote."""
    key = _key(scene, seen, wanted, options.spp) + ("" if options.cycles is None else " cycles")
    if options.truth is not None and options.truth.exists():
        with np.load(options.truth, allow_pickle=False) as kept:
            if str(kept["key"]) == key:
                step(1.0)
                return [_whole(*parts) for parts in kept["pictures"].astype(float)]
    if options.cycles is not None:
        traced = cycles.trace(scene, seen, wanted, options.spp, step, python=options.cycles)
    else:
        traced = trace(scene, seen, wanted, options.spp, step, fast=options.fast)
    if options.truth is not None:
        pictures = np.stack([np.broadcast_arrays(*_parts(one)) for one in traced]).astype(np.float32)
        with options.truth.open("wb") as file:
            np.savez_compressed(file, key=key, pictures=pictures)
    return traced


def _parts(one: Traced) -> list[Floats]:
    cover = one.cover if one.light.ndim == one.cover.ndim else one.cover[..., None]
    return [one.light, cover, *one.halves]


def _whole(light: Floats, cover: Floats, one: Floats, two: Floats) -> Traced:
    """The reverse of `_parts`."""
    return Traced(light, cover if cover.ndim == 2 else cover[..., 0], (one, two))


def _key(scene: Scene, seen: Frame, wanted: list[Cell], spp: int) -> str:
    """SHA-256 of all that decides the traced pictures."""
    parts: list[Any] = [scene.vertices, seen.centre, *(part for cell in wanted for part in (cell.eye, cell.to_lamp))]
    found = hashlib.sha256(json.dumps([seen.width, seen.height, spp, scene.albedo, scene.skin]).encode())
    if scene.colours is not None:
        parts += [scene.colours, np.array(scene.ground)]
    for part in (scene.groom.points, scene.groom.radius, *parts):
        found.update(np.ascontiguousarray(part).tobytes())
    return found.hexdigest()
