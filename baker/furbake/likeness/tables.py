"""Figures of a body beside the truth, as Markdown for people."""

from __future__ import annotations

from typing import Any


def lines(found: dict[str, Any]) -> list[str]:
    """All figures, a line each: every cell by every method, then brightness by bins of n·l of the first method."""
    width, height = found["size"]
    what = f"{found['model']}: {found['hairs']} hairs, {width} x {height} pixels, {found['spp']} paths a pixel"
    text = [
        f"{what}; brightness is page over truth",
        "",
        "| cell | method | r | r, quarter | SSIM | SSIM, quarter | brightness |",
        "|---|---|---|---|---|---|---|",
    ]
    for cell in found["cells"]:
        for method, part in cell["methods"].items():
            text.append(
                f"| {cell['name']} | {method} | {part['r']:.3f} | {part['r_quarter']:.3f} | {part['ssim']:.3f} "
                f"| {part['ssim_quarter']:.3f} | {part['brightness']:.2f} |"
            )
    first = next(iter(found["cells"][0]["methods"]))
    edges = sorted({row["from"] for cell in found["cells"] for row in cell["methods"][first]["bins"]})
    text += ["", f"Brightness of {first} by n·l, page / truth, in the unit of L", ""]
    text += [
        f"| n·l from | {' | '.join(cell['name'] for cell in found['cells'])} |",
        "|---" * (1 + len(found["cells"])) + "|",
    ]
    for edge in edges:
        row = [_bin(cell["methods"][first]["bins"], edge) for cell in found["cells"]]
        text.append(f"| {edge:.1f} | {' | '.join(row)} |")
    outlines = ", ".join(f"{cell['name']} {cell['outline']:.3f}" for cell in found["cells"])
    noise = ", ".join(f"{cell['name']} {cell['r_noise']:.3f}" for cell in found["cells"])
    return [*text, "", f"outline, intersection over union: {outlines}", f"truth against truth, r: {noise}"]


def _bin(bins: list[dict[str, float]], edge: float) -> str:
    return next((f"{row['page']:.3f} / {row['truth']:.3f}" for row in bins if row["from"] == edge), "")
