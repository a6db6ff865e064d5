"""The sections of a report that are plots."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from furbake.show.report.measure import SWEEP, Measured
from furbake.show.report.pictures import data_uri, discs
from furbake.show.report.section import figure, section
from furbake.show.report.svg import Axis, Series, axis, plot, sparkline

NAMES = ("lu²", "lv²", "lu·lv", "lu", "lv", "1")
"""Terms of eq. (2)."""

DISC = 72
"""Side of the picture of a light curve, pixels."""

MULTIPLIED = (
    "It is the bound of numbers alone. Here they are multiplied by their slab's mean light, which all texels of the "
    "slab share, and may do better. "
)

WORDS = {3: "three", 4: "four", 5: "five", 6: "six"}


def curves(measured: Measured) -> str:
    """Light curves of chosen texels, sample against fit."""
    across = "along the lean of the fur" if measured.leaning else "from the left to the right"
    swing = Axis(-90, 90, [(-90, "−90°"), (-45, "−45°"), (0, "above"), (45, "45°"), (90, "90°")], f"lamp, {across}")
    top = max(float(np.max([curve.truth, curve.stored])) for curve in measured.curves)
    brightness = axis([0.0, top], "light to the eye", low=0.0, count=4)
    plots = []
    for curve in sorted(measured.curves, key=lambda curve: curve.hard):
        place = f"layer {curve.layer + 1}, row {curve.row}, column {curve.column}"
        which = "a hard texel" if curve.hard else "a typical texel"
        series = (
            Series(measured.angles.tolist(), curve.truth.tolist(), "truth", "dots", "samples"),
            Series(measured.angles.tolist(), curve.stored.tolist(), "fit", "line", "fit"),
        )
        drawn = plot(f"Light of {which}, {place}", swing, brightness, series, height=215)
        plots.append(figure(drawn, f"<b>{which.removeprefix('a ').capitalize()}</b>, {place}"))
    words = WORDS[measured.pelt.coefficients]
    return section(
        "Light curves of single texels",
        f"A lamp swings over the fur from one horizon to the other ({2 * SWEEP:.0f}°), {across}. <b>Look for</b> the "
        f"line to run through the dots: {words} numbers follow the slow rise and fall, not the flicker of a strand's "
        "shadow. Typical texels are the median of their layer, hard ones are worse than 95 of 100.",
        f'<div class="plots">{"".join(plots)}</div>',
    )


def bound(measured: Measured) -> str:
    """Spectrum of the samples, and what each basis reaches of the best possible."""
    rivals, count = measured.rivals, measured.pelt.coefficients
    ranks = list(range(1, len(rivals.bound) + 1))
    numbers = Axis(0.5, len(ranks) + 0.5, [(r, str(r)) for r in ranks], "light curves, the strongest first")
    share = np.log10(np.maximum(rivals.spectrum, 1e-9))
    low = int(np.floor(share.min()))
    energy = Axis(low, 0, [(e, f"{100 * 10.0**e:g} %") for e in range(low, 1)], "share of the light")
    bars = Series(ranks, share.tolist(), "bound", "bars")
    spectrum = plot("Share of the light in each light curve", numbers, energy, (bars,))
    per_texel = Axis(0.5, len(ranks) + 0.5, numbers.ticks, "numbers per texel")
    eigen = list(rivals.eigen.items())
    reached = [*rivals.bound.tolist(), rivals.ptm, rivals.stored, *rivals.eigen.values()]
    decibels = axis(reached, "dB on unseen lights")
    against = plot(
        "Decibels over numbers per texel: bound, eigen, ptm and this bake",
        per_texel,
        decibels,
        (
            Series(ranks, rivals.bound.tolist(), "bound", "line", "best possible"),
            Series([r for r, _ in eigen], [value for _, value in eigen], "other", "dots", "eigen"),
            Series([6.0], [rivals.ptm], "truth", "dots", "ptm"),
            Series([float(count)], [rivals.stored], "fit", "ring", "this bake"),
        ),
    )
    off = rivals.stored - rivals.bound[count - 1] if count <= len(rivals.bound) else None
    near = "" if off is None else f": it is {abs(off):.2f} dB {'below' if off < 0 else 'above'}"
    alone = "" if measured.pelt.curves is None else MULTIPLIED
    kept = float(rivals.spectrum[:count].sum())
    return section(
        "How good could it be?",
        "Every texel's light is a mixture of a few light curves (the singular vectors of the sample matrix). "
        "The best any method can do with so many numbers per texel is known: the bound of Eckart and Young. "
        f"{alone}<b>Look for</b> the ring to lie near the line{near}.",
        '<div class="plots">',
        figure(spectrum, f"<b>Spectrum</b>: the first {count} curves hold {100 * kept:.1f} % of the light"),
        figure(against, "<b>Bound and bases</b>: the bound knows the unseen lights, a fit does not"),
        figure(_table(measured), "<b>In figures</b>: dB on unseen lights, before the numbers become bytes"),
        "</div>",
    )


def _table(measured: Measured) -> str:
    """The bases beside the bound, a row for each number of numbers."""
    rivals = measured.rivals
    rows = "".join(
        f"<tr><td>{count}</td><td>{_at(rivals.bound, count)}</td><td>{value:.2f}</td>"
        f"<td>{f'{rivals.ptm:.2f}' if count == max(rivals.eigen) else '–'}</td></tr>"
        for count, value in rivals.eigen.items()
    )
    head = "<tr><th>numbers</th><th>bound</th><th>eigen</th><th>ptm</th></tr>"
    return f'<table class="numbers bases">{head}{rows}</table>'


def _at(bound: NDArray[np.float64], count: int) -> str:
    return f"{bound[count - 1]:.2f}" if count <= len(bound) else "–"


def where(measured: Measured) -> str:
    """Error over the layers and over the height of the lamp."""
    count = len(measured.layers)
    s = [(k + 0.5) / count for k in range(count)]
    height = Axis(0, 1, [(0, "skin"), (0.5, "half-way"), (1, "tips")], "height in the fur")
    there = [float(value) for value, a in zip(measured.layers, measured.alpha, strict=True) if a.max() > 0.05]
    layers = plot(
        "Decibels of every layer",
        height,
        axis(there, "dB on unseen lights"),
        (Series(s, measured.layers.tolist(), "fit", "both"),),
    )
    coverage = plot(
        "Coverage of every layer",
        height,
        Axis(0, 100, [(v, f"{v} %") for v in (0, 25, 50, 75, 100)], "hidden by hair"),
        (Series(s, (100 * measured.alpha.mean((1, 2))).tolist(), "bound", "both"),),
    )
    elevation, decibels = measured.by_light.T.tolist()
    lamps = plot(
        "Decibels over the lamp's elevation",
        Axis(0, 90, [(v, f"{v}°") for v in (0, 15, 30, 45, 60, 75, 90)], "lamp above the horizon"),
        axis(decibels, "dB on unseen lights"),
        (Series(elevation, decibels, "fit", "dots"),),
    )
    return section(
        "Where the error is",
        "<b>Look for</b> an even curve: a dip at one height means that its hairs are too fine for the texels, "
        "dots that fall to the left mean that grazing light, with its long shadows, is the hard part.",
        '<div class="plots three">',
        figure(layers, "<b>By layer</b>: a valley marks where strands shade each other most"),
        figure(lamps, "<b>By lamp</b>: a dot for each light that the fit never saw"),
        figure(coverage, "<b>Coverage</b>: how much of the tile the hairs of a layer hide"),
        "</div>",
    )


def quantisation(measured: Measured) -> str:
    """How the 256 steps of every coefficient are used."""
    pelt, bytes_ = measured.pelt, measured.quantisation
    cells = []
    shapes = discs(pelt.basis, DISC)
    for i, (histogram, shape) in enumerate(zip(bytes_.histogram, shapes, strict=True)):
        factor = NAMES[i] if pelt.basis.kind == "ptm" else f"light curve {i + 1}"
        cells.append(
            f'<figure class="bytes">{sparkline(histogram.tolist(), f"Use of the bytes of a{i}")}'
            f'<figcaption><img class="disc" src="{data_uri(shape)}" width="{DISC}" height="{DISC}" '
            f'alt="{factor} over the hemisphere"><span><b>a{i}</b> × {factor}<br>'
            f"λ {pelt.scale[i]:.4g}, Ω {f'{pelt.bias[i]:.4g}'.replace('-', '−')}</span></figcaption></figure>"
        )
    return section(
        "Bytes",
        "Each number is stored in one byte, a = λ·(byte − Ω). <b>Look for</b> hills that fill their box: steep walls "
        f"at an end would mean clipped numbers ({100 * bytes_.saturated:.2f} % stand at an end), a thin needle wasted "
        f"steps. Rounding every number by itself gives {bytes_.plain:.1f} dB, as stored it is {bytes_.stored:.1f} dB: "
        "the errors of the numbers are made to cancel each other. The discs show what each number multiplies, for "
        "every place of the lamp seen from above: orange adds light, blue takes it away.",
        f'<div class="histograms">{"".join(cells)}</div>',
    )
