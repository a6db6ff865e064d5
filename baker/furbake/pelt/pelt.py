"""The finished tile of fur: what the planes and the glTF extension store, and nothing else."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from furbake.pelt.curves import Curves
from furbake.pelt.hairs.ramp import Ramp
from furbake.pelt.hairs.states import DRY, PeltState
from furbake.pelt.light.paths import BODY_RADIUS
from furbake.pelt.multiple import Multiple
from furbake.pelt.texels.basis import Basis
from furbake.pelt.texels.fit import relight
from furbake.pelt.texels.quantise import dequantise

Bytes = NDArray[np.uint8]
Floats = NDArray[np.float64]
Single = NDArray[np.float32]


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

    @property
    def values(self) -> Floats:
        """Coefficients of the texels, (H, W, 6)."""
        return dequantise(self.codes, self.scale, self.bias)


@dataclass(frozen=True)
class Pelt:
    """A tile of K slabs of N × N texels, slab 0 at the skin, texel (row, column) = (v, u).

    codes : (K, N, N, C) coefficient bytes a', a = scale · (a' − bias)   (paper, eq. 3)
    alpha, tint : (K, N, N) bytes / 255
    colour : (K, N, N, 3) sRGB bytes, the texel's original colour, or None   (paper, eq. 4)
    scale, bias : (C,) the paper's λ and Ω
    basis : functions of the light that the coefficients multiply
    drift : (K, 2) mean sideways displacement of the hairs at each slab's middle, tile widths
    height : of the fur, tile widths
    spread : of the hairs' slopes, as of `spread_of`, or None: combed hairs hide as much as others
    open : share of the skin that is seen from straight above, 0 where that is next to nothing
    fin : its side view, or None
    bent : (3, 8) numbers of the law of bent hairs, or None
    eye, surge : (3, 16) and (3,) numbers of the law of light and eye, or None
    fin_eye : (3, 16) numbers of the same law for fins, or None
    short : (3,) numbers of the law of shorter hairs, or None: they are as bright
    direction : (K, N, N, 3) bytes of the hairs' mean tangent, or None
    curves, weights : the slabs' mean curves, of all states, and the (K, Q) weights of this one; None: the texels'
        polynomials alone
    multiple : share and colour of light that has met several hairs, or None
    state : dry unless the fur has others; in a dirty one `tint` is the mud's share of the coverage, here and in the fin
    """

    codes: Bytes
    alpha: Bytes
    tint: Bytes
    colour: Bytes | None
    scale: Floats
    bias: Floats
    basis: Basis
    drift: Floats
    height: float
    ramp: Ramp
    fin: FinPelt | None = None
    direction: Bytes | None = None
    bent: Floats | None = None
    eye: Floats | None = None
    surge: Floats | None = None
    fin_eye: Floats | None = None
    short: Floats | None = None
    spread: float | None = None
    open: float = 0.0
    curves: Curves | None = None
    weights: Floats | None = None
    multiple: Multiple | None = None
    state: PeltState = DRY

    @property
    def values(self) -> Floats:
        """Coefficients a of the texels, (K, N, N, C)."""
        return dequantise(self.codes, self.scale, self.bias)

    def mean(self, lights: Floats, beta: float = BODY_RADIUS) -> Floats | None:
        """Mean curves of the slabs under lights (n, 3) on a body of radius β, (n, K); None where there are none."""
        if self.curves is None or self.weights is None:
            return None
        return self.curves.mean(lights, self.weights, beta)

    def light(self, lights: Floats, beta: float = BODY_RADIUS, contrast: float = 1.0) -> Single:
        """L of the stored texels on a body of radius β, (n, K, N, N). Without mean curves lights have lz ≥ 0.

        contrast : how many times as much as stored they differ from their slab's mean curve, where they have one
        """
        values, mean, constant = self.values, self.mean(lights, beta), self.basis.constant
        if mean is not None and constant is not None and contrast != 1:
            values = contrast * values
            values[..., constant] += 1 - contrast
        return relight(values, self.basis, lights, mean)

    @property
    def layers(self) -> int:
        return int(self.codes.shape[0])

    @property
    def size(self) -> int:
        return int(self.codes.shape[1])

    @property
    def coefficients(self) -> int:
        return int(self.codes.shape[3])
