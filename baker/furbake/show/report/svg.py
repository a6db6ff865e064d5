"""Small plots as inline SVG: lines, dots, bars. Their colours are classes that the page's style sheet fills."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from typing import Literal

WIDTH, HEIGHT = 340.0, 240.0
LEFT, RIGHT, TOP, BOTTOM = 44.0, 8.0, 26.0, 42.0
LEGEND = 20.0
"""Height of the line of names below the label of the upward axis."""

LEGEND_CHARACTER = 6.6
"""Mean width of a letter in the legend, plot units."""


@dataclass(frozen=True)
class Series:
    """Points of one colour. tone : truth, fit, bound, other or quiet"""

    x: Sequence[float]
    y: Sequence[float]
    tone: str
    kind: Literal["line", "dots", "both", "bars", "ring"] = "line"
    label: str = ""


@dataclass(frozen=True)
class Axis:
    """A range, its ticks (value, text) and its label."""

    low: float
    high: float
    ticks: Sequence[tuple[float, str]]
    label: str


def axis(values: Sequence[float], label: str, *, low: float | None = None, count: int = 5) -> Axis:
    """A range with round ticks that holds all values; `low` fixes its start."""
    finite = [value for value in values if math.isfinite(value)] or [0.0]
    start, end = min(finite) if low is None else low, max(finite)
    step = round_step((end - start) / count or 1.0)
    first, last = math.floor(start / step + 1e-9), math.ceil(end / step - 1e-9)
    last = max(last, first + 1)
    ticks = [(i * step, f"{i * step:g}") for i in range(first, last + 1)]
    return Axis(first * step, last * step, ticks, label)


def round_step(step: float) -> float:
    """The next larger of 1, 2, 5 times a power of ten."""
    power = 10.0 ** math.floor(math.log10(step))
    return next(factor * power for factor in (1, 2, 5, 10) if factor * power >= step * (1 - 1e-9))


def plot(title: str, x: Axis, y: Axis, series: Sequence[Series], *, height: float = HEIGHT) -> str:
    """An inline SVG as wide as its place, with `title` for screen readers."""
    named = [one for one in series if one.label]
    top = TOP + (LEGEND if named else 0)

    def px(value: float) -> float:
        return LEFT + (value - x.low) / (x.high - x.low) * (WIDTH - LEFT - RIGHT)

    def py(value: float) -> float:
        inside = min(max(value, y.low), y.high)
        return height - BOTTOM - (inside - y.low) / (y.high - y.low) * (height - BOTTOM - top)

    parts = [f'<svg viewBox="0 0 {WIDTH:g} {height:g}" role="img" aria-label="{escape(title)}">']
    for value, text in y.ticks:
        parts.append(f'<path class="grid" d="M{LEFT:g} {py(value):.1f}H{WIDTH - RIGHT:g}"/>')
        parts.append(f'<text class="tick end" x="{LEFT - 6:g}" y="{py(value) + 4:.1f}">{escape(text)}</text>')
    for value, text in x.ticks:
        parts.append(f'<path class="notch" d="M{px(value):.1f} {height - BOTTOM:g}v4"/>')
        parts.append(
            f'<text class="tick middle" x="{px(value):.1f}" y="{height - BOTTOM + 17:g}">{escape(text)}</text>'
        )
    parts.append(f'<path class="base" d="M{LEFT:g} {height - BOTTOM:g}H{WIDTH - RIGHT:g}"/>')
    middle = (LEFT + WIDTH - RIGHT) / 2
    parts.append(f'<text class="name middle" x="{middle:g}" y="{height - 6:g}">{escape(x.label)}</text>')
    parts.append(f'<text class="name" x="0" y="12">{escape(y.label)}</text>')
    bar = 0.7 * (WIDTH - LEFT - RIGHT) / max((len(one.x) for one in series), default=1)
    for one in series:
        points = [(px(a), py(b)) for a, b in zip(one.x, one.y, strict=True) if math.isfinite(a) and math.isfinite(b)]
        parts.extend(_marks(one, points, bar, height - BOTTOM))
    parts.extend(_legend(named))
    return "".join([*parts, "</svg>"])


def _marks(one: Series, points: Sequence[tuple[float, float]], bar: float, floor: float) -> list[str]:
    marks = []
    if one.kind == "bars":
        shape = "".join(f"M{a - bar / 2:.1f} {floor:g}V{b:.1f}h{bar:.1f}V{floor:g}z" for a, b in points)
        marks.append(f'<path class="bar {one.tone}" d="{shape}"/>')
    if one.kind in ("line", "both") and points:
        marks.append(f'<path class="line {one.tone}" d="M{" ".join(f"{a:.1f} {b:.1f}" for a, b in points)}"/>')
    if one.kind in ("dots", "both"):
        marks.extend(f'<circle class="dot {one.tone}" cx="{a:.1f}" cy="{b:.1f}" r="3"/>' for a, b in points)
    if one.kind == "ring":
        marks.extend(f'<circle class="ring {one.tone}" cx="{a:.1f}" cy="{b:.1f}" r="7"/>' for a, b in points)
    return marks


def _legend(series: Sequence[Series]) -> list[str]:
    """Names in the order of the series, each after its mark."""
    parts = []
    left = LEFT
    for one in series:
        if one.kind in ("line", "both"):
            parts.append(f'<path class="line {one.tone}" d="M{left:.1f} 26h14"/>')
        elif one.kind == "bars":
            parts.append(f'<rect class="bar {one.tone}" x="{left + 2:.1f}" y="21" width="10" height="10"/>')
        else:
            shape = "ring" if one.kind == "ring" else "dot"
            parts.append(f'<circle class="{shape} {one.tone}" cx="{left + 8:.1f}" cy="26" r="4"/>')
        parts.append(f'<text class="key" x="{left + 18:.1f}" y="30">{escape(one.label)}</text>')
        left += 18 + LEGEND_CHARACTER * len(one.label) + 8
    return parts


def sparkline(values: Sequence[float], title: str, *, width: float = 256, height: float = 48) -> str:
    """A filled outline without axes, one unit wide per value."""
    top = max(values, default=0) or 1.0
    step = width / len(values)
    steps = "".join(f"V{height - value / top * (height - 2):.1f}h{step:g}" for value in values)
    return (
        f'<svg viewBox="0 0 {width:g} {height:g}" preserveAspectRatio="none" role="img" aria-label="{escape(title)}">'
        f'<path class="bar fit" d="M0 {height:g}{steps}V{height:g}z"/></svg>'
    )


def dial(light: Sequence[float], title: str) -> str:
    """Direction of a light, seen from above: the rim is the horizon, the middle straight overhead."""
    x, y = 12 + 9.5 * light[0], 12 - 9.5 * light[1]
    return (
        f'<svg class="dial" viewBox="0 0 24 24" role="img" aria-label="{escape(title)}">'
        f'<circle class="rim" cx="12" cy="12" r="11"/><path class="ray" d="M12 12L{x:.1f} {y:.1f}"/>'
        f'<circle class="lamp" cx="{x:.1f}" cy="{y:.1f}" r="3"/></svg>'
    )
