"""Figures of a picture beside the truth: correlation, structural similarity, brightness by bins of n·l, outline.

`lines` is them all as Markdown.
"""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter

from furbake.study.verify.cells import Floats

Mask = NDArray[np.bool_]

BINS = np.round(np.arange(-0.6, 1.05, 0.1), 1)
"""Edges of the bins of n·l."""

MIN_PIXELS = 25
"""Least pixels of a bin."""

WINDOW = 1.5
"""Standard deviation of the window of SSIM, pixels."""

COARSE = 4
"""Pixels per side that one pixel of the smaller size stands for."""


def figures(page: Floats, truth: Floats, over: Mask, cosine: Floats, white: float) -> dict[str, Any]:
    """Figures of one picture, all arrays (height, width).

    over : pixels that count; cosine : n·l of the skin, NaN where there is none
    white : how bright the brightest is, for SSIM
    """
    small_page, small_truth, small_over = _quarter(page), _quarter(truth), _quarter(over) > 0.5
    return {
        "r": correlation(page[over], truth[over]),
        "ssim": similarity(page, truth, over, white),
        "r_quarter": correlation(small_page[small_over], small_truth[small_over]),
        "ssim_quarter": similarity(small_page, small_truth, small_over, white),
        "brightness": float(page[over].sum() / max(float(truth[over].sum()), 1e-12)),
        "bins": bins(page, truth, over, cosine),
    }


def bins(page: Floats, truth: Floats, over: Mask, cosine: Floats) -> list[dict[str, float]]:
    """Mean brightness of both by n·l, of the bins that have pixels."""
    found = []
    for low, high in pairwise(BINS):
        inside = over & (cosine >= low) & (cosine < high if high < 1 else cosine <= high)
        if inside.sum() >= MIN_PIXELS:
            means = {"page": float(page[inside].mean()), "truth": float(truth[inside].mean())}
            found.append({"from": float(low), "pixels": int(inside.sum()), **means})
    return found


def overlap(a: Floats, b: Floats) -> float:
    """Intersection over union of the pixels that two coverages more than half hide."""
    one, two = a > 0.5, b > 0.5
    return float((one & two).sum() / max(int((one | two).sum()), 1))


def correlation(a: Floats, b: Floats) -> float:
    """Pearson's r; 0 where one of them is constant."""
    a, b = a - a.mean(), b - b.mean()
    scale = float(np.sqrt((a @ a) * (b @ b)))
    return float(a @ b) / scale if scale > 0 else 0.0


def contrast(page: Floats, halves: tuple[Floats, Floats], over: Mask) -> float:
    """Contrast finer than a Gaussian window, standard deviation over its mean, page over truth.

    page : (height, width); halves : two independent estimates of the truth, whose noise falls out of their covariance
    """
    fine = [part - gaussian_filter(part, WINDOW, truncate=3.5) for part in (page, *halves)]
    ours, one, two = (part[over] - part[over].mean() for part in fine)
    mean = float((halves[0] + halves[1])[over].mean()) / 2
    truth = float(np.sqrt(max(float((one * two).mean()), 1e-12))) / max(mean, 1e-12)
    return float(ours.std()) / max(float(page[over].mean()), 1e-12) / truth


def similarity(a: Floats, b: Floats, over: Mask, white: float) -> float:
    """Mean structural similarity (Wang, Bovik, Sheikh and Simoncelli 2004) of two pictures whose range is `white`."""
    blurred = [gaussian_filter(part, WINDOW, truncate=3.5) for part in (a, b, a * a, b * b, a * b)]
    mean_a, mean_b = blurred[:2]
    var_a, var_b = blurred[2] - mean_a**2, blurred[3] - mean_b**2
    both = blurred[4] - mean_a * mean_b
    c1, c2 = (0.01 * white) ** 2, (0.03 * white) ** 2
    each = (2 * mean_a * mean_b + c1) * (2 * both + c2) / ((mean_a**2 + mean_b**2 + c1) * (var_a + var_b + c2))
    return float(each[over].mean())


def _quarter(picture: NDArray[Any]) -> Floats:
    """Means of blocks; what is left over at the right and below is cut off."""
    height, width = (side // COARSE for side in picture.shape)
    cut = np.asarray(picture, np.float64)[: height * COARSE, : width * COARSE]
    return np.asarray(cut.reshape(height, COARSE, width, COARSE).mean(axis=(1, 3)))


def heading(found: dict[str, Any]) -> str:
    """Model, hairs, size and paths of a comparison, in words."""
    width, height = found["size"]
    return f"{found['model']}: {found['hairs']} hairs, {width} x {height} pixels, {found['spp']} paths a pixel"


def lines(found: dict[str, Any]) -> list[str]:
    """All figures, a line each: every cell by every method, then a table of brightness by n·l for each cell."""
    text = [
        f"{heading(found)}; brightness is page over truth",
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
