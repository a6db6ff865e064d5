"""Figures of a body beside the truth, as Markdown for people."""

from __future__ import annotations

from typing import Any


def lines(found: dict[str, Any]) -> list[str]:
    """All figures, a line each: every cell by every method, then a table of brightness by n·l for each cell."""
    width, height = found["size"]
    what = f"{found['model']}: {found['hairs']} hairs, {width} x {height} pixels, {found['spp']} paths a pixel"
    text = [
        f"{what}; brightness is page over truth",
        "",
        "| cell | method | r | r, quarter | SSIM | SSIM, quarter | brightness | fine contrast |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for cell in found["cells"]:
        for method, part in cell["methods"].items():
            text.append(
                f"| {cell['name']} | {method} | {part['r']:.3f} | {part['r_quarter']:.3f} | {part['ssim']:.3f} "
                f"| {part['ssim_quarter']:.3f} | {part['brightness']:.2f} | {part['contrast']:.2f} |"
            )
    for cell in found["cells"]:
        text += ["", *_bins(cell)]
    outlines = ", ".join(f"{cell['name']} {cell['outline']:.3f}" for cell in found["cells"])
    noise = ", ".join(f"{cell['name']} {cell['r_noise']:.3f}" for cell in found["cells"])
    return [*text, "", f"outline, intersection over union: {outlines}", f"truth against truth, r: {noise}"]


def _bins(cell: dict[str, Any]) -> list[str]:
    """Brightness by n·l in the unit of L. Methods may count a few pixels more or fewer at the outline."""
    methods = {name: {row["from"]: row for row in part["bins"]} for name, part in cell["methods"].items()}
    first = next(iter(methods.values()))
    text = [
        f"{cell['name']}, brightness in the unit of L",
        "",
        f"| n·l from | pixels | truth | {' | '.join(methods)} |",
        "|---" * (3 + len(methods)) + "|",
    ]
    for edge, row in first.items():
        each = [f"{bins[edge]['page']:.3f}" if edge in bins else "" for bins in methods.values()]
        text.append(f"| {edge:.1f} | {row['pixels']} | {row['truth']:.3f} | {' | '.join(each)} |")
    return text
