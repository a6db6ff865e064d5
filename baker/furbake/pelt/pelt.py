"""The finished tile of fur: what the planes and the glTF extension store, and nothing else."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from furbake.pelt.basis import Basis
from furbake.pelt.curves import Curves
from furbake.pelt.multiple import Multiple
from furbake.pelt.paths import BODY_RADIUS

Bytes = NDArray[np.uint8]
Floats = NDArray[np.float64]
RGB = tuple[float, float, float]


@dataclass(frozen=True)
class Ramp:
    """Colour along a hair, linear Rec. 709: mix(root, mix(tip, tip2, hue), s^power)."""

    root: RGB = (0.104, 0.053, 0.028)
    tip: RGB = (0.795, 0.556, 0.327)
    tip2: RGB = (0.99, 0.92, 0.78)
    power: float = 1.2

    def colour(self, tint: Floats, hue: Floats) -> Floats:
        """The paper's (Rn, Gn, Bn): colour of every texel's hairs in plain light, linear, (K, ...) → (K, ..., 3).

        tint, hue : (K, ...) from the skin to the tips
        """
        root, tip, tip2 = (np.array(part) for part in (self.root, self.tip, self.tip2))
        s = ((np.arange(len(tint)) + 0.5) / len(tint)).reshape(-1, *[1] * tint.ndim)
        end = (1 - hue[..., None]) * tip + hue[..., None] * tip2
        return np.asarray((root + (end - root) * s**self.power) * tint[..., None])


@dataclass(frozen=True)
class State:
    """How wet and how dirty a pelt is, 0..1 each, and what that does to its hairs.

    length : of the fur over that of the dry one
    shade : factor of the hairs' colour; gloss, sharpness : of the strength and the exponent of their highlights
    mud : linear colour of what a dirty pelt's `tint` is the share of, None where it is clean
    """

    name: str = "dry"
    wetness: float = 0.0
    dirt: float = 0.0
    length: float = 1.0
    shade: float = 1.0
    gloss: float = 1.0
    sharpness: float = 1.0
    mud: RGB | None = None


@dataclass(frozen=True)
class FinPelt:
    """The same fur cut from the side, W × H texels, row 0 at the roots, column 0 at u = 0; periodic along u.

    codes : (H, W, 6) bytes of the paper's polynomial in (l·t, l·n), t along the fin, n out of the skin
    alpha, tint : (H, W) bytes / 255
    colour : (H, W, 3) sRGB bytes, the texel's original colour, or None
    scale, bias : (6,) λ and Ω
    """

    codes: Bytes
    alpha: Bytes
    tint: Bytes
    colour: Bytes | None
    scale: Floats
    bias: Floats


@dataclass(frozen=True)
class Pelt:
    """A tile of K slabs of N × N texels, slab 0 at the skin, texel (row, column) = (v, u).

    codes : (K, N, N, C) coefficient bytes a', a = scale · (a' − bias)   (paper, eq. 3)
    alpha, tint : (K, N, N) bytes / 255
    colour : (K, N, N, 3) sRGB bytes, the texel's original colour, or None   (paper, eq. 4)
    scale, bias : (C,) the paper's λ and Ω
    kind, degree, matrix : the basis: "ptm", or "eigen" with (C, T) weights of the smooth functions
    drift : (K, 2) mean sideways displacement of the hairs at each slab's middle, tile widths
    height : of the fur, tile widths
    fin : its side view, or None
    bent : (3, 8) numbers of the law of bent hairs, or None
    eye, surge : (3, 12) and (3,) numbers of the law of light and eye, or None
    direction : (K, N, N, 3) bytes of the hairs' mean tangent, or None
    curves, weights : the slabs' mean curves, of all states, and the (K, Q) weights of this one; None: the texels'
        polynomials are all of their light
    multiple : what of the slabs' light has met several hairs, None where that is not told
    state : dry unless the fur has others; in a dirty one `tint` is the mud's share of the coverage, here and in the fin
    """

    codes: Bytes
    alpha: Bytes
    tint: Bytes
    colour: Bytes | None
    scale: Floats
    bias: Floats
    kind: Literal["ptm", "eigen"]
    degree: int | None
    matrix: Floats | None
    drift: Floats
    height: float
    ramp: Ramp
    fin: FinPelt | None = None
    direction: Bytes | None = None
    bent: Floats | None = None
    eye: Floats | None = None
    surge: Floats | None = None
    curves: Curves | None = None
    weights: Floats | None = None
    multiple: Multiple | None = None
    state: State = State()

    @property
    def basis(self) -> Basis:
        return Basis(self.kind, self.degree, self.matrix)

    def mean(self, lights: Floats, beta: float = BODY_RADIUS) -> Floats | None:
        """Mean curves of the slabs under lights (n, 3) on a body of radius β, (n, K); None where there are none."""
        if self.curves is None or self.weights is None:
            return None
        return self.curves.mean(lights, self.weights, beta)

    @property
    def layers(self) -> int:
        return int(self.codes.shape[0])

    @property
    def size(self) -> int:
        return int(self.codes.shape[1])

    @property
    def coefficients(self) -> int:
        return int(self.codes.shape[3])
