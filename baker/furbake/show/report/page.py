"""The page of a report: its sections in reading order, as HTML without script."""

from __future__ import annotations

from html import escape
from importlib.resources import files
from typing import Any

import numpy as np

from furbake.asset.stored import body_radius, skin_colour
from furbake.show.report import charts
from furbake.show.report.groom import groom_section
from furbake.show.report.measure import Measured, number
from furbake.show.report.pictures import SPAN, colour_scale, data_uri, error_colours, grey, lightness, row
from furbake.show.report.section import section
from furbake.show.report.svg import dial
from furbake.show.swatch import pictures, render

SWATCH = 216
"""Side of a swatch, pixels: one tile."""

THUMBNAIL, SMALL = 80, 32
"""Largest side of a texel picture in the large and in the small sheet, pixels."""

SPARSE = 0.06
"""Mean coverage below which a layer of tips is too empty to be shown in large."""

CHOSEN_LAYERS, MAX_LAYERS = 4, 24
"""Layers in the large sheet, and at most in the small one."""

COMPASS = ("right", "upper right", "top", "upper left", "left", "lower left", "bottom", "lower right")

CARDS = (
    ("psnr", "All layers", "The fit against samples under lights it never saw, averaged over every layer."),
    ("psnr_composite", "Seen from above", "The same for the whole pelt as the eye sees it, tips over roots."),
    ("psnr_worst_layer", "Worst layer", "The layer that suffers most; a low figure at the roots is rarely visible."),
    ("bound.psnr", "Best possible", "No method with as many numbers per texel can beat this; the gap is what is left."),
    ("psnr_quantised", "As stored", "The fit after rounding to bytes: it should equal the figure for all layers."),
    ("psnr_quantisation", "Bytes alone", "What rounding costs by itself; from 48 dB up nobody can see it."),
)  # fmt: skip
"""Figures of bake.json: key in `fit`, name, explanation."""


def page(measured: Measured, opening: str = "") -> str:
    """The whole document. opening : a further section before the others, HTML"""
    record, fur = measured.asset.record, measured.asset.fur
    name = escape(str(record["input"].get("name", "unnamed")))
    css = (files("furbake.show.report") / "style.css").read_text("utf-8")
    kind = "polynomial texture map" if measured.pelt.basis.kind == "ptm" else "eigen curves"
    facts = (
        f"preset {measured.options.preset}",
        f"{fur['layers']} layers of {fur['size']} × {fur['size']} texels",
        f"{kind}, {fur['coefficients']} numbers per texel",
        f"{sum(measured.files.values()) / 1e6:.2f} MB",
    )
    sections = (
        opening,
        groom_section(record),
        _swatches(measured),
        *([_states(measured)] if len(fur["pelts"]) > 1 else []),
        _figures(measured),
        _sheet(measured),
        _all_layers(measured),
        charts.curves(measured),
        charts.bound(measured),
        charts.where(measured),
        charts.quantisation(measured),
        _weight(measured),
        _knobs(measured),
    )
    doubts = "".join(f'<p class="doubt">{escape(doubt)}</p>' for doubt in measured.doubts)
    return (
        '<!doctype html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        '<meta name="color-scheme" content="light dark">\n<link rel="icon" href="data:,">\n'
        f"<title>Fur report: {name}</title>\n<style>\n{css}</style>\n</head>\n<body>\n"
        f'<header><p class="eyebrow">Fur report</p><h1>{name}</h1>'
        f'<p class="facts">{" · ".join(escape(fact) for fact in facts)}</p>{doubts}</header>\n<main>\n'
        + "\n".join(sections)
        + f"\n</main>\n<footer>Written by furbake {escape(measured.asset.record['furbake'])}. "
        "Everything is in this one file: it can be mailed, printed and archived.</footer>\n</body>\n</html>\n"
    )


def _lamp_names() -> list[str]:
    return [f"{75 - 60 * i / 7:.0f}° high, from the {side}" for i, side in enumerate(COMPASS)]


def _swatches(measured: Measured) -> str:
    skin = skin_colour(measured.asset)
    lights = [(float(u), float(v), float(z)) for u, v, z in measured.lights]
    images = pictures(measured.pelt, lights, tiles=1, size=SWATCH, skin=skin, beta=body_radius(measured.asset))
    cells = [
        f'<figure><img src="{data_uri(image)}" width="{SWATCH}" height="{SWATCH}" alt="Fur lit {name}">'
        f"<figcaption>{dial(light, f'Lamp {name}')}<span>{name}</span></figcaption></figure>"
        for light, image, name in zip(lights, images, _lamp_names(), strict=True)
    ]
    return section(
        "The fur under eight lights",
        "One tile, seen from straight above, drawn from the stored bytes as the page draws it. "
        "<b>Look for</b> single strands, a lit side that follows the lamp, and depths that stay dark.",
        f'<div class="swatches">{"".join(cells)}</div>',
    )


def _states(measured: Measured) -> str:
    fits = {state["name"]: state["fit"] for state in measured.asset.record.get("states", [])}
    cells = []
    for state in measured.asset.fur["pelts"]:
        name, psnr = state["name"], number(flat(fits.get(state["name"], {})).get("psnr"))
        image = render(measured.asset.folder, tiles=1, size=SWATCH, state=name)
        words = f"{escape(name)}{'' if psnr is None else f', {psnr:.1f} dB'}"
        cells.append(
            f'<figure><img src="{data_uri(image)}" width="{SWATCH}" height="{SWATCH}" alt="{escape(name)} fur">'
            f"<figcaption><span>{words}</span></figcaption></figure>"
        )
    return section(
        "Its states",
        "The same hairs in every state, under one lamp; all other figures here are those of the dry fur. "
        "<b>Look for</b> clumps that come to a point and darken as the fur gets wet, and mud that sits on the tips.",
        f'<div class="swatches">{"".join(cells)}</div>',
    )


def _figures(measured: Measured) -> str:
    fit = flat(measured.asset.record["fit"])
    cards = []
    for key, name, meaning in CARDS:
        value = number(fit.get(key))
        if value is not None:
            wrong = f"typical error {percent(10 ** (-value / 20))}"
            cards.append(
                f'<div class="card"><h3>{name}</h3><p class="value">{value:.1f}<small> dB</small></p>'
                f'<p class="wrong">{wrong}</p><p>{meaning}</p></div>'
            )
    known = ((key, number(value)) for key, value in fit.items())
    rows = "".join(f"<tr><td><code>{escape(key)}</code></td><td>{value:.2f}</td></tr>" for key, value in known if value)
    return section(
        "Figures",
        "<b>Read</b> decibels as distance from the truth: 20 dB is a typical error of 10 % of the brightest hairs, "
        "26 dB of 5 %, 40 dB of 1 %.",
        f'<div class="cards">{"".join(cards)}</div>',
        f'<details><summary>All figures as bake.json has them</summary><table class="numbers">{rows}</table></details>',
    )


def _sheet(measured: Measured) -> str:
    """Large pictures: the whole pelt and a few layers, sample over fit over error, a column per light."""
    judge, alpha = measured.judge, measured.alpha
    whole = [np.asarray(judge.composite(light), np.float64) for light in (measured.truth, measured.fitted)]
    blocks = [_block("The whole pelt", whole[0], whole[1], np.ones_like(alpha[0]))]
    dense = np.flatnonzero(alpha.mean((1, 2)) >= SPARSE)
    highest = int(dense[-1]) if len(dense) else len(alpha) - 1
    for k in chosen(highest + 1, CHOSEN_LAYERS):
        place = {0: ", at the skin", len(alpha) - 1: ", the tips"}.get(k, "")
        blocks.append(
            _block(f"Layer {k + 1} of {len(alpha)}{place}", measured.truth[:, k], measured.fitted[:, k], alpha[k])
        )
    dials = "".join(dial(light, name) for light, name in zip(measured.lights, _lamp_names(), strict=True))
    return section(
        "Sample, fit, error",
        "Each column is one of the eight lights above. <b>Compare</b> the upper picture (what light transport says) "
        "with the middle one (what the stored numbers say): shapes and gradients should be the same. "
        "The lower one is the difference: dark is right, and colour should be scattered like noise, not drawn in "
        "strands. Black stands where there is no hair.",
        '<div class="sheet">',
        f'<div class="lamps"><span></span><div class="eight">{dials}</div></div>{"".join(blocks)}</div>',
        _key(),
    )


def _block(title: str, truth: Any, fitted: Any, coverage: Any) -> str:
    truth, fitted = np.asarray(truth, np.float64), np.asarray(fitted, np.float64)
    dense = np.broadcast_to(coverage > 0.05, truth.shape)
    white = float(np.percentile(truth[dense] if dense.any() else truth, 99.5)) or 1.0
    fade = np.clip(coverage / 0.25, 0, 1)
    strips = (
        ("sample", grey(row(lightness(truth, coverage, white), THUMBNAIL))),
        ("fit", grey(row(lightness(fitted, coverage, white), THUMBNAIL))),
        ("error", error_colours(row((fitted - truth) / white * fade, THUMBNAIL))),
    )
    rows = "".join(
        f'<div class="line"><span>{name}</span><img class="strip" src="{data_uri(pixels)}" '
        f'width="{pixels.shape[1]}" height="{pixels.shape[0]}" alt="{title}, {name}, under eight lights"></div>'
        for name, pixels in strips
    )
    return f'<div class="block"><h3>{title}</h3>{rows}</div>'


def _all_layers(measured: Measured) -> str:
    """Every layer in small: three sheets beside each other, tips on top, a column per light."""
    alpha, white = measured.alpha, measured.judge.peak
    layers = chosen(len(alpha), min(len(alpha), MAX_LAYERS))
    sheets: dict[str, list[Any]] = {"Samples": [], "Fit": [], "Error": []}
    for k in layers:
        truth, fitted = np.asarray(measured.truth[:, k], np.float64), np.asarray(measured.fitted[:, k], np.float64)
        fade = np.clip(alpha[k] / 0.25, 0, 1)
        sheets["Samples"].append(grey(row(lightness(truth, alpha[k], white), SMALL)))
        sheets["Fit"].append(grey(row(lightness(fitted, alpha[k], white), SMALL)))
        sheets["Error"].append(error_colours(row((fitted - truth) / white * fade, SMALL)))
    figures = []
    for name, rows in sheets.items():
        pixels = np.concatenate(rows)
        alt = f"{name} of {len(layers)} layers, tips on top, under eight lights"
        figures.append(
            f'<figure><figcaption>{name}</figcaption><img src="{data_uri(pixels)}" '
            f'style="--row:{100 / len(layers):.4f}%" width="{pixels.shape[1]}" '
            f'height="{pixels.shape[0]}" alt="{alt}"></figure>'
        )
    every = "Every layer" if len(layers) == len(alpha) else f"{len(layers)} of {len(alpha)} layers"
    return section(
        "Contact sheet",
        f"{every}, tips on top and roots at the bottom, all at one exposure; the columns are the eight lights. "
        "<b>Look for</b> light that dies away towards the roots, and an error that stays dark all over.",
        f'<div class="contact">{"".join(figures)}</div>',
    )


def _weight(measured: Measured) -> str:
    pelt, total = measured.pelt, sum(measured.files.values())
    rows = "".join(
        f'<tr><td><code>{escape(name)}</code></td><td>{size:,}</td><td class="share">'
        f'<i style="width:{100 * size / max(measured.files.values()):.1f}%"></i></td></tr>'
        for name, size in sorted(measured.files.items(), key=lambda item: (-item[1], item[0]))
    )
    images = len(measured.asset.fur["pelts"][0]["planes"]) + (pelt.colour is not None)
    texels = pelt.layers * pelt.size**2
    return section(
        "Weight",
        f"<b>Watch</b> the planes: they grow with layers × size². On the graphics card they take "
        f"{4 * texels * images / 1e6:.2f} MB, {4 * images} bytes for each of {texels:,} texels; a light costs nothing.",
        f'<table class="numbers files"><tr><th>file</th><th>bytes</th><th></th></tr>{rows}'
        f"<tr><th>all</th><th>{total:,}</th><th></th></tr></table>",
    )


def _knobs(measured: Measured) -> str:
    record = measured.asset.record
    knobs = "".join(
        f"<div><dt>{escape(key)}</dt><dd>{escape(text(value))}</dd></div>"
        for key, value in flat(record["options"]).items()
    )
    libraries = record.get("libraries")
    parts = {"furbake": record["furbake"]} | (libraries if isinstance(libraries, dict) else {})
    versions = ", ".join(f"{key} {value}" for key, value in parts.items())
    return section(
        "How it was made",
        "Every knob as the bake recorded it: the same file, options and version give the same bytes.",
        f'<dl class="knobs">{knobs}</dl>',
        f'<p class="small">{escape(versions)}. Input SHA-256 <code>{escape(str(record["input"].get("sha256", "")))}'
        "</code></p>",
    )


def _key() -> str:
    stops = ", ".join(colour_scale())
    return (
        f'<p class="scale"><span>too dark by {percent(SPAN)}</span>'
        f'<i style="background:linear-gradient(90deg,{stops})"></i><span>too bright by {percent(SPAN)}</span></p>'
    )


def chosen(count: int, wanted: int) -> list[int]:
    """Evenly spread layers from the tips down to the skin."""
    return sorted({round(float(k)) for k in np.linspace(0, count - 1, wanted)}, reverse=True)


def flat(record: dict[str, Any], prefix: str = "") -> dict[str, Any]:
    """Nested objects as one, keys joined by dots."""
    found: dict[str, Any] = {}
    for key, value in record.items():
        found |= flat(value, f"{prefix}{key}.") if isinstance(value, dict) else {f"{prefix}{key}": value}
    return found


def text(value: Any) -> str:
    """A knob's value in words."""
    if value is None:
        return "as the preset has it"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, list):
        return ", ".join(text(item) for item in value)
    return f"{value:g}" if isinstance(value, float) else str(value)


def percent(share: float) -> str:
    """A share in per cent, two digits where they mean something."""
    return f"{100 * share:.0f} %" if share >= 0.02 else f"{100 * share:.2g} %"
