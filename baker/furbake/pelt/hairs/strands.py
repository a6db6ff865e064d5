"""Procedural hairs over one periodic tile: guard hairs above a shorter undercoat.

Units are tile widths; the tile is the square [0, 1)² in u, v and the skin is at z = 0. Along a hair, s runs from 0 at
the root to 1 at the tip.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from furbake.pelt.hairs.tiling import nearest, relaxed, scattered_points, shuffle, spread_out, tile_noise

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Hairs:
    """One kind of hair. Lengths are fractions of the fur's height, radii and displacements tile widths."""

    count: int = 214
    """Hairs per tile."""
    length: tuple[float, float] = (0.8, 1.0)
    """Shortest and longest hair."""
    radius: tuple[float, float] = (0.0132, 0.0048)
    """Radius at the root and at the tip."""
    curl: float = 0.01
    """Radius of the helix that the tip describes."""
    turns: float = 1.3
    """Turns of that helix from root to tip."""
    stray: float = 0.05
    """Spread (standard deviation) of the tips' own lean."""
    clump: float = 0.5
    """Share of the way that tips are drawn to their clump's centre."""
    taper: float = 1.5
    """Exponent of the taper: 1 a cone, above 1 thick almost to the tip."""
    curl_shape: float = 1.0
    """Exponent of the helix's growth along the hair: 1 a cone, near 0 as wide at the root."""
    wave: float = 0.0
    """Amplitude of a plane wave at the tip."""
    waves: float = 2.0
    """Periods of that wave from root to tip."""
    lock: float = 0.0
    """Share of the phase of curl and wave that all hairs of a clump have in common: 1 makes locks."""
    frizz: float = 0.0
    """Spread (standard deviation) of each hair's own smooth wandering at the tip."""
    kinks: float = 4.0
    """Bends of that wandering from root to tip."""
    clump_shape: float = 1.3
    """Exponent of the pull along the hair: below 1 tufts from the root, above 1 tips alone."""
    tint: float = 0.78
    """Mean brightness."""
    fade: tuple[float, float] = (1.0, 1.0)
    """Factors of the brightness at the root and at the tip."""
    hue: tuple[float, float] = (0.0, 1.0)
    """Least and greatest share of the ramp's second tip colour, from hair to hair."""
    ticking: float = 0.0
    """How far tips turn to the ramp's second tip colour (the banded hairs of wild coats)."""
    ticked: float = 0.6
    """Where along the hair that begins."""


@dataclass(frozen=True)
class Coat:
    """A whole coat: what grows, how it leans together, how hairs differ in shade and hue."""

    guard: Hairs = Hairs()
    under: Hairs = Hairs(count=260, length=(0.4, 0.7), radius=(0.0108, 0.0036), curl=0.02, stray=0.08, clump=0.3)
    lean: tuple[float, float] = (0.0, 0.34)
    """Mean displacement of the longest tips along u and v, tile widths."""
    bend: float = 1.7
    """Exponent of the lean along the hair: 1 straight, above 1 curved."""
    clumps: int = 60
    """Clump centres per tile."""
    shade: float = 0.15
    """Spread of tint from hair to hair."""
    opacity: float = 6.0
    """Optical depth of 1/16 of the fur's height filled with hair."""
    albedo: float = 0.85
    """Share of the light that a hair scatters on: pale fur glows from within."""
    skin: float = 0.25
    """Share of the light that the skin below scatters back."""
    even: float = 1.0
    """How far hairs bend from where they crowd to where the skin would show."""
    tufts: float = 0.18
    """How much shorter than the others a whole clump's guard hairs may be."""
    patchiness: float = 0.0
    """Share of the hairs that move from thin places to thick ones."""
    patches: int = 4
    """Thick places along a side of the tile."""
    flow: float = 0.0
    """Spread (standard deviation) of the lean from place to place, tile widths."""


@dataclass(frozen=True)
class Strands:
    """Hairs as polylines, roots first.

    points : (S, P, 3) float, tile widths; u and v may leave [0, 1): the tile repeats
    radius : (S, P) float, tile widths
    tint : (S, P) float, 0..1, brightness
    hue : (S, P) float, 0..1, from the ramp's first tip colour to its second
    """

    points: Array
    radius: Array
    tint: Array
    hue: Array

    def some(self, hairs: NDArray[np.bool_]) -> Strands:
        """Some of the hairs, (S,)."""
        return Strands(self.points[hairs], self.radius[hairs], self.tint[hairs], self.hue[hairs])


POINTS = 25
"""Points per hair at least."""

POINTS_PER_TURN = 8

MAX_POINTS = 161

FLOW_WAVES = 2
"""Changes of the lean's direction along a side of the tile."""


def points_per_hair(coat: Coat) -> int:
    """As many as its tightest curl, wave or kink needs."""
    bends = max(max(kind.turns * (kind.curl > 0), kind.waves * (kind.wave > 0)) for kind in (coat.guard, coat.under))
    kinks = max(kind.kinks * (kind.frizz > 0) for kind in (coat.guard, coat.under))
    return min(MAX_POINTS, max(POINTS, 1 + int(np.ceil(POINTS_PER_TURN * max(bends, kinks / 2)))))


def plant(coat: Coat, rng: np.random.Generator) -> Array:
    """Roots of all hairs, guard hairs first, (S, 2): evenly, or thinned out between thick places."""
    roots = []
    for kind in (coat.guard, coat.under):
        if coat.patchiness == 0.0:
            roots.append(scattered_points(kind.count, rng))
            continue
        seeds = scattered_points(int(np.ceil(kind.count * (1 + coat.patchiness))), rng)
        rank = coat.patchiness * tile_noise(seeds, coat.patches, rng) + (1 - coat.patchiness) * rng.random(len(seeds))
        roots.append(seeds[np.argsort(-rank, kind="stable")[: kind.count]])
    return np.concatenate(roots)


# Long: every preset depends on the order of these draws of chance, which is seen best in one place.
def grow(coat: Coat, height: float, seed: int) -> Strands:
    """Grow the hairs of one tile.

    Every hair rises linearly to its own length, follows the common lean, strays, curls, waves and frizzes, and is drawn
    towards the nearest clump's centre across the tile's borders. The longest hair ends exactly at `height` (tile
    widths), so that the topmost slab is never empty.
    """
    rng = np.random.default_rng(seed)
    kinds = (coat.guard, coat.under)
    counts = [kind.count for kind in kinds]
    count = sum(counts)

    def each(name: str) -> Array:
        """A knob of each hair's own kind, (S,), or (S, 2) for a pair."""
        return np.repeat(np.array([getattr(kind, name) for kind in kinds], float), counts, axis=0)

    def between(name: str, share: Array) -> Array:
        """A pair of each hair's own kind, mixed: share (S,) or (S, P)."""
        low, high = each(name).T.reshape(2, count, *[1] * (share.ndim - 1))
        return np.asarray(low + (high - low) * share)

    def column(values: Array) -> Array:
        return values[:, None]

    root = plant(coat, rng)
    centre = relaxed(scattered_points(coat.clumps, rng), root)
    clump, to_clump = nearest(root, centre)

    # Hairs of one clump share a length, a lean and a shade: tufts, not noise.
    tuft_length = 1 - coat.tufts * shuffle(centre, rng)[clump]
    tuft_lean = rng.normal(0.0, 0.8, (coat.clumps, 2))[clump]
    tuft_shade = 1.5 * (shuffle(centre, rng) - 0.5)[clump]
    tuft_hue = shuffle(centre, rng)[clump]
    tuft_phase = rng.random(coat.clumps)[clump]

    length = between("length", rng.random(count))
    length *= np.where(np.arange(count) < coat.guard.count, tuft_length, 1.0)
    length *= height / length.max()

    tip = np.array(coat.lean) + column(each("stray")) * (tuft_lean + rng.normal(0.0, 1.0, (count, 2)))
    if coat.flow:
        tip += coat.flow * np.stack([tile_noise(root, FLOW_WAVES, rng) for _ in range(2)], -1)
    tip *= column(length / height)
    pull = to_clump * column(each("clump") * rng.uniform(0.6, 1.1, count))

    s = np.linspace(0.0, 1.0, points_per_hair(coat))
    alone = 1 - each("lock")
    # Hairs of a lock turn together, so they differ as little in size and pace as in phase.
    pace = 1 + alone * rng.uniform(-0.3, 0.3, count)
    phase = tuft_phase + alone * rng.uniform(-0.5, 0.5, count)
    curl = column(each("curl") * (0.8 + alone * rng.uniform(-0.4, 0.4, count))) * s ** column(each("curl_shape"))
    curl_angle = 2 * np.pi * (column(phase) + column(each("turns") * pace) * s)
    wave = column(each("wave") * (1 + alone * rng.uniform(-0.4, 0.4, count))) * s
    wave = wave * np.sin(2 * np.pi * (column(phase) + column(each("waves") * pace) * s))
    wave_angle = column(2 * np.pi * (tuft_hue + alone * rng.uniform(-0.5, 0.5, count)))

    sideways = tip[:, None] * s[:, None] ** coat.bend
    sideways += pull[:, None] * (s ** column(each("clump_shape")))[..., None]
    sideways += curl[..., None] * circle(curl_angle) + wave[..., None] * circle(wave_angle)
    if any(kind.frizz for kind in kinds):
        sideways += each("frizz")[:, None, None] * s[:, None] * wander(s, each("kinks"), rng)
    points = np.concatenate([root[:, None] + sideways, (length[:, None] * s)[..., None]], -1)

    thin = s ** column(each("taper"))
    radius = column(rng.uniform(0.8, 1.2, count)) * between("radius", thin)
    points = spread_out(points, radius, coat.even * s**coat.bend, 0.5 / np.sqrt(coat.clumps))
    tint = np.clip(each("tint") + coat.shade * (tuft_shade + rng.normal(0.0, 1.0, count)), 0.35 * each("tint"), 1.0)
    hue = between("hue", np.clip(0.6 * tuft_hue + 0.4 * rng.random(count), 0.0, 1.0))
    ticked = np.clip((s - column(each("ticked"))) / (1 - column(each("ticked"))), 0.0, 1.0)
    ticked = column(each("ticking")) * ticked * ticked * (3 - 2 * ticked)
    return Strands(
        points=points,
        radius=radius,
        tint=np.clip(column(tint) * between("fade", np.broadcast_to(s, radius.shape)), 0.0, 1.0),
        hue=column(hue) + (1 - column(hue)) * ticked,
    )


def circle(angle: Array) -> Array:
    """Points of the unit circle, (..., 2)."""
    return np.stack([np.cos(angle), np.sin(angle)], -1)


def wander(s: Array, kinks: Array, rng: np.random.Generator) -> Array:
    """Smooth noise along each hair, (S, P, 2), standard deviation about 1, `kinks` bends per hair."""
    noise = np.zeros((len(kinks), len(s), 2))
    for octave in (0.5, 1.0, 0.75):  # three sines whose periods have no common measure look like none
        pace = (octave * kinks)[:, None] * rng.uniform(0.35, 0.65, (len(kinks), 2))
        phase = rng.random((len(kinks), 2))
        noise += np.sin(2 * np.pi * (phase[:, None] + pace[:, None] * s[:, None]))
    return np.asarray(noise * np.sqrt(2 / 3))
