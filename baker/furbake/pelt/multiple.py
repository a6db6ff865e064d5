"""Colour of light that has met many hairs: what share of a slab's light it is, and how it follows their colour.

Light that met n hairs has their colour to the power n, while the samples' hairs are of one grey ϖ. M, the light that
was scattered more than once, is nearly a geometric series whose orders shrink by ρ·c: hairs of colour c get

    g(c) = (c/ϖ)·(1 − ρϖ)/(1 − ρc)

times the M that was sampled; T·D is as it was. So a slab's light is its samples' times 1 + x·(g − 1), x = M/(T·D + M).
With the colours of the own slab alone, transport in hairs of the presets' ramps, seen from above, is met within 4 %
on the mean of all lights.

x goes by the height of the light and by its azimuth: it is more of light from the side to which hairs lean, which
meets their ends and goes on to others, and more of what an eye opposite the light sees of hairs that lean (`leaning`).

Shorter hairs, share f of the pelt's length, lie flatter: of steep light they catch more themselves and let less on to
others. x counts 1 + (1 − f²)·(0.2 − 0.5·√lz) times there.

An eye aside gets G·S times the light, G and S the two factors of `eye`. Most of what they change is light that met one
hair: of the light towards that eye x/(G^1.5·S) has met several (`towards`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from furbake.pelt.curves import Curves, lean_direction, sphere
from furbake.pelt.hairs.volume import Volume, seen_from_above
from furbake.pelt.light.paths import BODY_RADIUS
from furbake.pelt.means import LESS, Measured, rounded
from furbake.pelt.texels.basis import held

if TYPE_CHECKING:
    from furbake.pelt.hairs.ramp import Ramp

Array = NDArray[np.float64]

MAX_RATIO = 1.0
"""Greatest ρ: beyond it hairs of colour 1 would send back more light than they get."""

MAX_COLOUR = 0.98
"""Greatest colour of hairs in `gain`."""

STEEP = 0.15
"""Share of x that the samples have too much of under light straight above, next to none of it under low light; the less
of it the more hairs lean (`too_much`).

Beside the lamp, seen from straight above, path-traced balls in `teddy`, `sheep`, `wolf` and `fox`, which lean by .25,
.1, .55 and .96, have .82, .82, .94 and .99 of the x of the samples.
"""

NAP_POWER = 1.5
"""Exponent of G in `towards`.

Of light towards 10 eyes under 4 lights, beside what path-traced balls in five furs have of light that met several hairs
there, the error of fur whose g is .12 is .13 (RMS of the logarithm, by what is seen) with 1.9; it is .24 with 1, .15
with 1.6. Beside what the page itself shows of balls (`OPPOSITE`) 1.4 is the best number.
"""

PRESSED = (0.2, 0.5)
"""Numbers of `Multiple.share` for shorter hairs.

By light transport x of hairs of .4 of the length is, under a light at .94, .77 (`teddy`), .79 (`wolf`), .82 (`fox`) and
.88 (`sheep`) of that of whole ones, and .97 to 1.19 of it at .08; the numbers make it .76 and 1.05.
"""


LEANING = (0.66, 0.33)
"""Numbers of `leaning` for light towards the lean.

Of a path-traced bunny in `wolf`, `fox`, `teddy` and `sheep`, which lean by .54, .93, .25 and .09, x is off by .120,
.105, .045 and .041 without them (RMS over places that are lit alike), .076, .083, .039 and .040 with them.
Seen by eyes all around, hairs of the fine volume have .42, .41, .17 and .09 in place of their .33, .33, .17 and .06.
"""

OPPOSITE = (1.1, 0.35, 0.03)
"""Numbers of `leaning` for eyes: the more of it the nearer they are to opposite the light, and a little for all.

The first: of light past hairs that lean to eyes opposite .85 to .95 has met several, as hairs of the fine volume and
path-traced bunnies have it; in `wolf` and `fox` x is off by .15 and .14 without it, .07 and .08 with it.

The others, with `NAP_POWER` 1.5: in the light that a page shows of balls x is off by .056, .049, .043 and .032 in
`wolf`, `fox`, `teddy` and `sheep` (RMS over places that are lit and seen alike), .078, .055, .051 and .033 without.
"""


def leaning(lights: Array, lean: Array, eyes: Array | None = None) -> Array:
    """Factor of x, (n,), exp(k·(b + 1.1·o) + 0.35·o + 0.03) with k = min(0.66·|lean|, 0.33), b = l·m along the lean m
    of length 1 and o = max(−l·v, 0); exp(k·b) for eyes all around.

    lights : (n, 3) unit; lean : (2,) of the tips, shares of the height; eyes : (n, 3) unit, None for eyes all around
    """
    power = min(LEANING[0] * float(np.hypot(*lean)), LEANING[1])
    more = power * (held(lights)[:, :2] @ lean_direction(lean))
    if eyes is not None:
        more += (power * OPPOSITE[0] + OPPOSITE[1]) * np.maximum(-(lights * eyes).sum(-1), 0) + OPPOSITE[2]
    return np.asarray(np.exp(more))


@dataclass(frozen=True)
class Multiple:
    """Light that has met several hairs in the slabs of one state.

    albedo : ϖ of the hairs that were sampled
    shares : (K, 3) numbers of x, see `share`
    ratio : (K,) ρ
    seen : (K,) share of each slab in what is seen of the fur from above, in even light
    tint : (K,) mean of the texels' tint; colour : (K, 3) mean colour of the hairs, linear, None without a colour plane
    """

    albedo: float
    shares: Array
    ratio: Array
    seen: Array
    tint: Array
    colour: Array | None = None

    def share(
        self, lights: Array, beta: float = BODY_RADIUS, length: float = 1.0,
        lean: Array | None = None, eyes: Array | None = None,
    ) -> Array:  # fmt: skip
        """x, (n, 3) unit directions → (n, K) in 0..1.

        length : f of the hairs, over the pelt's; lean, eyes : as of `leaning`, no lean for the mean of all azimuths
        """
        pressed = 1 + (1 - length**2) * (PRESSED[0] - PRESSED[1] * np.sqrt(np.maximum(lights[:, 2:], 0)))
        counts = pressed if lean is None else pressed * leaning(lights, lean, eyes)[:, None]
        return np.clip(terms(lights, beta) @ self.shares.T * counts, 0, 1)

    def towards(
        self, lights: Array, eyes: Array, lean: Array, nap: Array, surge: Array, beta: float = BODY_RADIUS
    ) -> Array:
        """x of the light for eyes aside, n pairs, (n, K).

        lean : as of `leaning`; nap, surge : (n, K) and (n,) of `eye.factor` and `eye.surge`
        """
        return np.clip(self.share(lights, beta, lean=lean, eyes=eyes) * nap**-NAP_POWER / surge[:, None], 0, 1)

    def gain(self, colour: Array) -> Array:
        """g, for hairs of colours (..., K) or (..., 1)."""
        held_colour = np.clip(colour, 0, MAX_COLOUR)
        return np.asarray(held_colour / self.albedo * (1 - self.ratio * self.albedo) / (1 - self.ratio * held_colour))

    def tinges(
        self, curves: Curves, weights: Array, ramp: Ramp, base: Array, lights: Array, lean: Array,
        beta: float = BODY_RADIUS,
    ) -> Array:  # fmt: skip
        """Factors of the light of n lamps, and last of an even sky, for the hairs' colour, (n + 1, K, 3).

        ramp : of the hairs, where they have no colours of their own; base : (3,) factor of all these colours
        lean : as of `leaning`
        """
        colour = ramp.colour(self.tint, np.zeros(len(self.tint))) if self.colour is None else self.colour
        shares = np.concatenate([self.share(lights, beta, lean=lean), sky_share(self, curves, weights, beta)[None]])
        return np.asarray(1 + shares[..., None] * (self.gain((base * colour).T).T - 1))


def sky_share(multiple: Multiple, curves: Curves, weights: Array, beta: float = BODY_RADIUS) -> Array:
    """x under an even sky, (K,): the mean of all lights, each by what it gives."""
    directions, area = sphere(beta)
    light = np.maximum(curves.mean(directions, weights, beta), 0) * area[:, None]
    return np.asarray((light * multiple.share(directions, beta)).sum(0) / np.maximum(light.sum(0), 1e-12))


def terms(lights: Array, beta: float) -> Array:
    """Terms of x, (n, 3): 1, √lz (0 below the horizon), 3·(β − 1)/(2·β + 1): 0, 1 and 1.36 for β of 1, 4 and 16.

    Hairs diverge by their length over the radius: on large bodies x hardly changes any more. Samples under light at .95
    have x of .32, .40 and .43 there (`wolf`), .26, .33 and .36 (`teddy`).
    """
    steep = np.sqrt(np.maximum(lights[:, 2], 0))
    return np.stack([np.ones(len(lights)), steep, np.full(len(lights), 3 * (beta - 1) / (2 * beta + 1))], -1)


def multiple_of(
    bodies: Sequence[Measured], curves: Curves, weights: Array, volume: Volume, colour: Array | None
) -> Multiple | None:
    """Multiple scattering in the slabs (K) of a state with these weights (K, Q) of the curves.

    bodies : of `measure`, None without any; volume : the stored slabs
    colour : (K, N, N, 3) of the hairs in its texels, linear
    """
    if not bodies:
        return None
    cover = np.maximum(volume.coverage, 1e-6)
    total = cover.sum((1, 2))
    tint = (cover * volume.tint).sum((1, 2)) / total
    directions, area = sphere(BODY_RADIUS)
    light = np.maximum(weights @ (area @ curves(directions)), 0)
    seen = seen_from_above(volume.coverage, 1)[0].mean((1, 2)) * light * tint
    return Multiple(
        albedo=bodies[0].albedo,
        shares=rounded(shares_of(bodies, volume.drift[-1] / volume.height)),
        ratio=rounded(shrinking(bodies)),
        seen=rounded(seen / max(seen.sum(), 1e-12)),
        tint=rounded(tint),
        colour=None if colour is None else rounded((cover[..., None] * colour).sum((1, 2)) / total[:, None]),
    )


def too_much(height: Array, lean: Array) -> Array:
    """Share of x that the samples have too much of: 0.15·lz·(1 − (2·|lean|)²), 0 for hairs that lean by more than ½.

    height : lz, any shape; lean : as of `leaning`
    """
    return np.asarray(STEEP * max(1 - 4 * float(lean @ lean), 0) * np.maximum(height, 0))


def shares_of(bodies: Sequence[Measured], lean: Array) -> Array:
    """Numbers of x, (K, 3), by least squares: lights count by how bright they leave a slab. lean : as of `leaning`"""
    lights = np.concatenate([body.lights for body in bodies])
    rows = np.concatenate([terms(body.lights, body.beta) for body in bodies]) * leaning(lights, lean)[:, None]
    light = np.maximum(np.concatenate([body.values for body in bodies]), 1e-9)
    multiple = np.concatenate([body.values if body.multiple is None else body.multiple for body in bodies])
    multiple = multiple * (1 - too_much(lights[:, 2:], lean))
    # In a slab that no light reaches all of it has met other hairs.
    small = 1e-9 * np.eye(3)
    matrix = np.einsum("nk,ni,nj->kij", light, rows, rows) + small
    return np.asarray(np.linalg.solve(matrix, ((multiple.T @ rows) + small[0])[..., None])[..., 0])


def shrinking(bodies: Sequence[Measured]) -> Array:
    """ρ of the slabs, (K,): M of the whole albedo over that of `LESS` of it is (1 − ρϖ·LESS)/(LESS·(1 − ρϖ))."""
    for body in bodies:
        if body.grown is not None:
            grown = body.grown * LESS
            return np.asarray(np.clip((grown - 1) / (body.albedo * (grown - LESS)), 0, MAX_RATIO))
    raise ValueError("bodies: got none with darker hairs, expected one")
