"""The finished tile of fur: what the planes and the glTF extension store, and nothing else."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

Bytes = NDArray[np.uint8]
Floats = NDArray[np.float64]
RGB = tuple[float, float, float]


@dataclass(frozen=True)
class Ramp:
    """Colour along a hair, linear Rec. 709: mix(root, mix(tip, tip2, hue), s^power)."""

    root: RGB = (0.06, 0.030, 0.016)
    tip: RGB = (0.60, 0.37, 0.20)
    tip2: RGB = (0.90, 0.76, 0.58)
    power: float = 1.2


@dataclass(frozen=True)
class Pelt:
    """A tile of K slabs of N × N texels, slab 0 at the skin, texel (row, column) = (v, u).

    codes : (K, N, N, C) coefficient bytes a', a = scale · (a' − bias)   (paper, eq. 3)
    alpha, tint : (K, N, N) bytes / 255
    colour : (K, N, N, 3) sRGB bytes, the texel's original colour, or None   (paper, eq. 4)
    scale, bias : (C,) the paper's λ and Ω
    kind, degree, matrix : the basis: "ptm", or "eigen" with (C, 27) weights of the smooth functions
    environment : (C, 9) spherical harmonics of the radiance → light moments
    drift : (K, 2) mean sideways displacement of the hairs at each slab's middle, tile widths
    height : of the fur, tile widths
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
    environment: Floats
    drift: Floats
    height: float
    ramp: Ramp

    @property
    def layers(self) -> int:
        return int(self.codes.shape[0])

    @property
    def size(self) -> int:
        return int(self.codes.shape[1])

    @property
    def coefficients(self) -> int:
        return int(self.codes.shape[3])
