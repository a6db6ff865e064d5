"""Sheets to look at: page | truth | difference, a row per cell."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from furbake.asset.planes import Bytes, write_png
from furbake.pelt.texels.quantise import srgb_bytes
from furbake.study.verify.cells import Cell, Floats
from furbake.study.verify.page import Shown
from furbake.study.verify.truth import Traced

GAP = 4
"""Pixels between pictures."""

ORANGE, BLUE, GREY = np.array([255.0, 60, 0]), np.array([0.0, 60, 255]), np.array([128.0, 128, 128])
"""Colours of the difference: page brighter, page darker, both equal."""

FULL = 0.5
"""Difference, as a share of white, that is shown in full colour."""


def write_sheets(
    picture: Path, shown: Shown, traced: Sequence[Traced], cells: Sequence[Cell], methods: Sequence[str]
) -> None:
    """A PNG of each method: the first in `picture`, the others beside it, named after their method."""
    for number, method in enumerate(methods):
        path = picture if number == 0 else picture.with_name(f"{picture.stem}-{method}{picture.suffix}")
        rows = [row(shown.light[cell.name, method], one.light) for cell, one in zip(cells, traced, strict=True)]
        framed = [np.pad(part, ((0, GAP), (0, 0), (0, 0))) for part in rows]
        write_png(path, np.concatenate(framed)[:-GAP], srgb=True)


def row(page: Floats, truth: Floats) -> Bytes:
    """(height, 3·width + 2·GAP, 3): both at one exposure, the truth's 99th percentile white, and their difference."""
    lit = truth[truth > 0]
    white = max(float(np.percentile(lit, 99)) if lit.size else 1.0, 1e-9)
    grey = [np.repeat(srgb_bytes(np.clip(part / white, 0, 1))[..., None], 3, -1) for part in (page, truth)]
    off = np.clip((page - truth) / (FULL * white), -1, 1)[..., None]
    colour = GREY + np.maximum(off, 0) * (ORANGE - GREY) + np.maximum(-off, 0) * (BLUE - GREY)
    gap = np.zeros((len(page), GAP, 3), np.uint8)
    return np.concatenate([grey[0], gap, grey[1], gap, np.rint(colour).astype(np.uint8)], axis=1)
