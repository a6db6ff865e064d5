"""The fins of a fur in all its states: looked at from the side, fitted, and judged."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from furbake.options import BakeOptions
from furbake.pelt.fin import SideView, fit_fins, polynomial, row_means, side_view
from furbake.pelt.hairs.states import Fur
from furbake.pelt.hairs.volume import Volume
from furbake.pelt.light.transport import hemisphere
from furbake.pelt.pelt import FinPelt, Pelt
from furbake.pelt.texels.fit import Judge, relight
from furbake.pelt.texels.quantise import step_of

Floats = NDArray[np.float64]

FIN_LIGHTS, FIN_HELD_OUT = 64, 16
"""Lights of a fin's fit, and others that it does not see: enough for six numbers."""


def fit_sides(
    furs: Iterable[tuple[Fur, Volume]], pelts: Sequence[Pelt], options: BakeOptions
) -> list[tuple[FinPelt, dict[str, float]]]:
    """The fins' textures of all states, and how good they are: `psnr` and `r2` over lights that no fit saw.

    pelts : of the same states, whose mean curves the fins share
    """
    fitted = hemisphere(min(options.lights, FIN_LIGHTS))
    unseen = hemisphere(FIN_HELD_OUT, turn=1.0)
    lights = np.concatenate([fitted, unseen])
    views, colours, height = list[SideView](), list[Floats | None](), 0.0
    for fur, fine in furs:
        height = height or fur.height
        view = side_view(
            fur.strands, fine, options.layers, options.size, lights, fur.coat,
            flat=options.flat, height=height, mud=fur.mud,
        )  # fmt: skip
        views.append(view)
        coloured = options.colour_plane and fur.mud is None
        colours.append(options.ramp.colour(view.tint, view.hue) if coloured else None)
    count = len(fitted)
    rows = len(views[0].alpha)
    means = [row_means(pelt, rows, fitted) for pelt in pelts]
    seen = [replace(view, light=view.light[:count]) for view in views]
    fins = fit_fins(seen, fitted, colours, means, step_of(options.bits))
    found = []
    for view, fin, pelt in zip(views, fins, pelts, strict=True):
        judge = Judge(view.light[count:, :, None].astype(np.float32), view.alpha[:, None], view.tint[:, None])
        stored = relight(fin.values, polynomial, unseen, row_means(pelt, rows, unseen))
        figures = judge.figures(stored[:, :, None])
        found.append((fin, {name: figures[name] for name in ("psnr", "r2")}))
    return found
