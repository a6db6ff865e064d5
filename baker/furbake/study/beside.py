"""Two bakes of one body beside each other: pictures of the page, and lengths, leans and widths of their strands."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from furbake.asset.read import Asset, read_asset
from furbake.groom.ground import read_skin
from furbake.groom.strands import groom, recorded
from furbake.imported.bind import Bound, bind
from furbake.imported.curves import checked
from furbake.imported.drawn import distance
from furbake.study.grooms import baked_skin
from furbake.study.verify.body import Options, planned
from furbake.study.verify.figures import correlation
from furbake.study.verify.page import Shown, show
from furbake.study.verify.pathtrace import VerifyError
from furbake.study.verify.sheet import write_sheets
from furbake.study.verify.truth import Traced

METHOD = "ptm"

ALIKE = 1e-3
"""Distance of vertices up to which two bodies are one, share of its largest side."""

STAGES = ("strands", "page")


def beside(
    folder: Path,
    other: Path,
    options: Options | None = None,
    *,
    picture: Path | None = None,
    progress: Callable[[str, float], None] = lambda stage, fraction: None,
) -> dict[str, Any]:
    """Figures of one bake beside another one of the same body; plain data.

    picture : optional PNG: a row per cell, one | other | difference

    r and brightness, one over the other, are of all pixels that either covers, white hairs under one lamp; `apart` are
    Kolmogorov's distances of the strands. Raises VerifyError, AssetError or PageError.
    """
    options = options or Options()
    options.check()
    both = [read_asset(folder), read_asset(other)]
    skins = [read_skin(asset)[0] for asset in both]
    extent = float(np.ptp(skins[0], axis=0).max())
    if skins[0].shape != skins[1].shape or np.abs(skins[0] - skins[1]).max() > ALIKE * extent:
        raise VerifyError(f"beside: {other} has another body than {folder}, expected two bakes of one body")
    traits = []
    for number, asset in enumerate(both, 1):
        traits.append(_bound(asset))
        progress("strands", number / 2)
    plan, seen, cells = planned(both[0], skins[0], options)
    shown = []
    for number, asset in enumerate(both):
        coat = recorded(asset).coat

        def step(fraction: float, done: int = number) -> None:
            progress("page", (done + fraction) / 2)

        shown.append(show(asset, coat.albedo, coat.skin, seen, cells, (METHOD,), step))
    if picture is not None:
        second = [shown[1].light[cell.name, METHOD] for cell in cells]
        covers = [shown[1].cover[cell.name, METHOD] for cell in cells]
        as_truth = [Traced(light, cover, (light, light)) for light, cover in zip(second, covers, strict=True)]
        write_sheets(picture, shown[0], as_truth, cells, (METHOD,))
    each = [_cell(cell.name, cell.view, *shown) for cell in cells]
    one, two = traits
    return {
        "bakes": [str(folder), str(other)],
        "hairs": [one.count, two.count],
        "plan": plan,
        "size": [seen.width, seen.height],
        "apart": {
            "length": distance(one.length, two.length),
            "lean": distance(one.firm, two.firm),
            "width": distance(one.width, two.width),
        },
        "cells": each,
        "r": float(np.mean([cell["r"] for cell in each])),
    }


def lines(found: dict[str, Any]) -> list[str]:
    """The figures as Markdown."""
    one, two = found["bakes"]
    width, height = found["size"]
    return [
        f"{one}: {found['hairs'][0]} hairs, beside {two}: {found['hairs'][1]}; {width} x {height} pixels",
        "",
        "| trait | Kolmogorov's distance |",
        "|---|---|",
        *(f"| {name} | {apart:.3f} |" for name, apart in found["apart"].items()),
        "",
        "| cell | r | brightness |",
        "|---|---|---|",
        *(f"| {cell['name']} | {cell['r']:.3f} | {cell['brightness']:.2f} |" for cell in found["cells"]),
        f"| mean | {found['r']:.3f} | |",
    ]


def _bound(asset: Asset) -> Bound:
    """The strands of a bake on its body."""
    made = groom(asset.folder)
    count, points = made.radius.shape
    curves = checked(str(asset.folder), made.points.reshape(-1, 3), np.full(count, points), 2 * made.radius.reshape(-1))
    return bind(str(asset.folder), curves, baked_skin(asset))


def _cell(name: str, view: str, one: Shown, two: Shown) -> dict[str, Any]:
    lights, covers = ([getattr(shown, part)[name, METHOD] for shown in (one, two)] for part in ("light", "cover"))
    over = ~one.feature[view] & ((covers[0] > 0.5) | (covers[1] > 0.5))
    a, b = (light[over] for light in lights)
    return {"name": name, "r": correlation(a, b), "brightness": float(a.sum() / max(float(b.sum()), 1e-12))}
