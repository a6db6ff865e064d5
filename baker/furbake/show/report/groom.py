"""The section of a report that shows an artist's groom and the tile made of it side by side."""

from __future__ import annotations

from html import escape
from typing import Any

from furbake.imported.traits import NAMES
from furbake.show.report.section import figure, section
from furbake.show.report.svg import Axis, Series, axis, plot

FAR = 0.1
"""Kolmogorov's distance from which on two histograms are said to differ."""


def groom_section(record: dict[str, Any]) -> str:
    """The section as HTML; nothing where the fur is no artist's. record : of `bake.json`"""
    groom = record.get("groom")
    traits = groom.get("traits") if isinstance(groom, dict) else None
    if not isinstance(groom, dict) or not isinstance(traits, dict):
        return ""
    beside = f", {groom['follow']} hairs beside each" if groom.get("follow") else ""
    parts = [("coat", groom)] + [(fur["name"], fur["groom"]) for fur in record.get("regions", [])]
    each = [f"<h3>{escape(name)}</h3>{_histograms(part['traits'])}" for name, part in parts]
    drawn = ", ".join(f"{part['drawn']:,} of those of the {name} fill its tile" for name, part in parts)
    one = f"{groom['drawn']:,} of them fill the tile"
    return section(
        "The groom and its tile",
        f"{groom['strands']:,} strands of the artist{beside}; {one if len(parts) == 1 else drawn}. "
        "Bars are the groom, the line is the fur on the body. <b>Look for</b> lines that leave the bars.",
        _histograms(traits) if len(parts) == 1 else "".join(each),
    )


def _histograms(traits: dict[str, Any]) -> str:
    """A histogram of each trait."""
    drawn = [
        figure(_histogram(name, traits[name]), f"<b>{escape(name)}</b>: {escape(text)}{_apart(traits[name])}")
        for name, text in NAMES.items()
        if name in traits
    ]
    return f'<div class="histograms">{"".join(drawn)}</div>'


def _histogram(name: str, trait: dict[str, Any]) -> str:
    """Shares of the strands in each bin: of the groom as bars, of the tile as a line."""
    count = len(trait["groom"])
    step = (trait["high"] - trait["low"]) / count
    middles = [trait["low"] + (i + 0.5) * step for i in range(count)]
    across = axis([trait["low"], trait["high"]], name, low=trait["low"], count=3)
    across = Axis(trait["low"], trait["high"], [tick for tick in across.ticks if tick[0] <= trait["high"]], name)
    up = axis([100 * share for share in (*trait["groom"], *trait["tile"])], "% of the strands", low=0.0)
    bars = Series(middles, [100 * share for share in trait["groom"]], "truth", "bars", "groom")
    line = Series(middles, [100 * share for share in trait["tile"]], "fit", "line", "tile")
    return plot(f"{name}: groom and tile", across, up, [bars, line])


def _apart(trait: dict[str, Any]) -> str:
    apart = float(trait["apart"])
    return f". They are {apart:.2f} apart (Kolmogorov)" + (
        ", <b>more than strands that are alike</b>" if apart > FAR else ""
    )
