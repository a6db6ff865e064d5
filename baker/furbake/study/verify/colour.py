"""Colours of a furry body on the page beside the truth: its strands in their own colours, path-traced."""

from __future__ import annotations

import colorsys
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from furbake.asset.planes import write_png
from furbake.asset.stored import read_pelt, skin_colour
from furbake.pelt.texels.quantise import srgb_bytes
from furbake.study.verify.body import Options, Progress, prepared, traced_pictures
from furbake.study.verify.cells import Cell, Floats
from furbake.study.verify.figures import heading
from furbake.study.verify.page import Shown, show
from furbake.study.verify.truth import Scene, Traced

SHADE = 0.35
"""Colour of the skin below fur over that of the roots, as on the page."""

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])

GAP = 6


def verify_colour(
    folder: Path,
    options: Options | None = None,
    *,
    picture: Path | None = None,
    progress: Progress = lambda stage, fraction: None,
) -> dict[str, Any]:
    """Trace the strands of a baked folder in their own colours and compare the mean colours; plain data.

    picture : optional PNG: a row per cell, page | truth. Only the first of `options.methods` counts, and no ceiling.

    Raises VerifyError where Mitsuba, Node or a browser is missing, AssetError where the folder is no whole asset.
    """
    options = options or Options()
    case = prepared(folder, options, progress, coloured=True)
    asset, coat, seen, wanted = case.asset, case.coat, case.seen, case.cells
    ramp = read_pelt(asset).ramp
    colours = np.asarray(case.strands.colour, np.float64)
    if "COLOR_0" not in asset.primitive(asset.fur["shells"])["attributes"]:  # the page shows a white skin
        colours = colours / np.maximum(np.array(skin_colour(asset), np.float32), 1e-6)
    red, green, blue = (SHADE * part for part in ramp.root)
    ground = red, green, blue
    scene = Scene(case.strands, case.vertices, case.faces, coat.albedo, coat.skin, np.clip(colours, 0, 1), ground)
    traced = traced_pictures(scene, seen, wanted, options, lambda fraction: progress("trace", fraction))
    methods = options.methods[:1]
    shown = show(
        asset, coat.albedo, coat.skin, seen, wanted, methods,
        lambda fraction: progress("page", fraction), coloured=True,
    )  # fmt: skip
    if picture is not None:
        write_colours(picture, shown, traced, wanted, methods[0])
    return {
        **case.record(options),
        "method": methods[0],
        "cells": [_cell(cell, shown, one, methods[0]) for cell, one in zip(wanted, traced, strict=True)],
    }


def _cell(cell: Cell, shown: Shown, traced: Traced, method: str) -> dict[str, Any]:
    light, cover = shown.light[cell.name, method], shown.cover[cell.name, method]
    over = ~shown.feature[cell.view] & ((cover > 0.5) | (traced.cover > 0.5))
    return {"name": cell.name, **compared(light[over].mean(0), traced.light[over].mean(0))}


def compared(page: NDArray[Any], truth: NDArray[Any]) -> dict[str, Any]:
    """Two mean colours, linear: hue in degrees, saturation and luminance of both, and how far they are apart.

    hue_off : degrees; saturation_off, luminance_off : page over truth, less 1
    """
    found: dict[str, Any] = {}
    for name, colour in (("page", page), ("truth", truth)):
        hue, saturation, _ = colorsys.rgb_to_hsv(*(float(part) for part in colour))
        found[name] = {"hue": 360 * hue, "saturation": saturation, "luminance": float(colour @ LUMINANCE)}
    one, two = found["page"], found["truth"]
    found["hue_off"] = (one["hue"] - two["hue"] + 180) % 360 - 180
    for key in ("saturation", "luminance"):
        found[f"{key}_off"] = one[key] / max(two[key], 1e-9) - 1
    return found


def write_colours(path: Path, shown: Shown, traced: list[Traced], cells: list[Cell], method: str) -> None:
    """A row per cell: page and truth at one exposure, the 99th percentile of the truth's luminance white."""
    rows: list[Floats] = []
    for cell, truth in zip(cells, traced, strict=True):
        white = max(float(np.percentile(truth.light[truth.cover > 0.5] @ LUMINANCE, 99)), 1e-9)
        gap = np.zeros((len(truth.light), GAP, 3))
        rows.append(np.concatenate([shown.light[cell.name, method] / white, gap, truth.light / white], axis=1))
    write_png(path, srgb_bytes(np.clip(np.concatenate(rows), 0, 1)))


def colour_lines(found: dict[str, Any]) -> list[str]:
    """All figures as Markdown, a line per cell."""
    text = [
        f"{heading(found)}; mean colours by {found['method']}, page over truth",
        "",
        "| cell | hue: page, truth | apart | saturation: page, truth | apart | luminance: page, truth | apart |",
        "|---|---|---|---|---|---|---|",
    ]
    for cell in found["cells"]:
        page, truth = cell["page"], cell["truth"]
        text.append(
            f"| {cell['name']} | {page['hue']:.1f}°, {truth['hue']:.1f}° | {cell['hue_off']:+.1f}° "
            f"| {page['saturation']:.3f}, {truth['saturation']:.3f} | {cell['saturation_off']:+.1%} "
            f"| {page['luminance']:.4f}, {truth['luminance']:.4f} | {cell['luminance_off']:+.1%} |"
        )
    return text
