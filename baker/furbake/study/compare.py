"""Presets and bases side by side: how well few numbers relight each fur, all from the same samples."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any

from furbake.options import BakeOptions
from furbake.tile.fitting import fit_pelt
from furbake.tile.lighting import grown, light

BASES = (("ptm", 6), ("eigen", 6), ("eigen", 5), ("eigen", 4), ("eigen", 3))

VARIANTS: tuple[tuple[str, dict[str, Any]], ...] = tuple(
    (
        f"{basis}, {count} numbers{', curves' if curves == 'slab' else ''}",
        {"basis": basis, "coefficients": count, "curves": curves},
    )
    for basis, count in BASES
    for curves in ("none", "slab")
)
"""Each basis as in the paper, and with the slabs' mean curves."""

HELD_OUT = 256
"""Held-out lights. The bound sees them: with 32 it is 0.55 dB better than with 256, by their noise alone."""


@dataclass(frozen=True)
class Row:
    """Figures of one basis for one fur, as in `bake.json`."""

    preset: str
    variant: str
    fit: dict[str, Any]


def compare(
    options: BakeOptions, lights: int = 192, step: Callable[[float], None] = lambda fraction: None
) -> Iterator[Row]:
    """Sample one fur under `lights` directions and `HELD_OUT` others, then fit it in every basis."""
    _, fine, volume = grown(options)
    lighting = light(fine, replace(options, lights=lights, curves="slab"), step, held_out=HELD_OUT)
    for name, basis in VARIANTS:
        _, figures = fit_pelt(volume, lighting, replace(options, **basis))
        yield Row(options.preset, name, figures)


def markdown(rows: list[Row]) -> str:
    """A table, dB over held-out lights: layers, worst layer and composite, as stored, and what is possible at best.

    The last is that of numbers that no mean curve multiplies.
    """
    lines = [
        "| fur | basis | layers | worst layer | from above | stored | best possible | from above |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for row in rows:
        fit, bound = row.fit, row.fit["bound"]
        figures = (
            fit["psnr"], fit["psnr_worst_layer"], fit["psnr_composite"], fit["psnr_quantised"],
            bound["psnr"], bound["psnr_composite"],
        )  # fmt: skip
        lines.append(f"| {row.preset} | {row.variant} | " + " | ".join(f"{figure:.2f}" for figure in figures) + " |")
    return "\n".join(lines) + "\n"
