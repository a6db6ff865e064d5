"""A picture that answers to light, whatever file it came in: planes of bytes, and what each counts under a light."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from furbake.pelt.texels.basis import held, ptm

Array = NDArray[np.float64]
Bytes = NDArray[np.uint8]
Single = NDArray[np.float32]
Weights = Callable[[Array], Array]
"""Lights (n, 3) → (n, P + 1, 3): how much each plane adds to R, G and B; row 0 is there without any plane."""

STRIPE = 2**18
"""Pixels that are relit together."""

TERMS = 6
"""Coefficients of the polynomial: lu², lv², lu·lv, lu, lv, 1."""

LRGB, RGB = "lrgb", "rgb"
"""One polynomial of brightness beside a colour, or one for each channel."""


class RtiError(ValueError):
    """A file of this field that cannot be read or written; the message names it, what was got and what was expected."""


@dataclass(frozen=True)
class Relit:
    """H × W pixels, row 0 on top; a light's lu is to the right, lv up, lz at the eye.

    codes : (H, W, P) bytes; scale, bias : (P,), a plane's value is scale · (code − bias), of 255
    weigh : what the planes count under a light
    colour : (H, W, 3) bytes by which the light is multiplied; None: it has its colour itself
    kind : the format in words, such as "ptm lrgb"
    """

    codes: Bytes
    scale: Array
    bias: Array
    weigh: Weights
    colour: Bytes | None
    kind: str

    @property
    def height(self) -> int:
        return int(self.codes.shape[0])

    @property
    def width(self) -> int:
        return int(self.codes.shape[1])

    def lit(self, light: Array, codes: Bytes | None = None, colour: Bytes | None = None) -> Single:
        """Values of pixels under a light (3,), 0..1 in the coding of the photographs, (..., 3).

        codes, colour : of some of the pixels, (..., P) and (..., 3); all by default
        """
        if codes is None:
            codes, colour = self.codes, self.colour
        weights = self.weigh(held(np.asarray(light, np.float64)[None]))[0]
        matrix = self.scale[:, None] * weights[1:]
        offset = weights[0] - self.bias @ matrix
        found = codes.astype(np.float32) @ matrix.astype(np.float32) + offset.astype(np.float32)
        found /= np.float32(255)
        if colour is not None:
            found *= colour.astype(np.float32) / np.float32(255)
        return np.asarray(np.clip(found, 0, 1, out=found))

    def picture(self, light: Array) -> Bytes:
        """The whole picture under a light (3,), (H, W, 3) bytes, a stripe at a time."""
        pixels = np.empty((self.height, self.width, 3), np.uint8)
        rows = max(STRIPE // self.width, 1)
        for top in range(0, self.height, rows):
            part = slice(top, top + rows)
            own = None if self.colour is None else self.colour[part]
            pixels[part] = np.rint(self.lit(light, self.codes[part], own) * 255)
        return pixels


def lrgb(codes: Bytes, scale: Array, bias: Array, colour: Bytes) -> Relit:
    """A polynomial of brightness, (H, W, 6) codes, beside a colour (H, W, 3)."""
    return Relit(codes, scale, bias, lambda lights: alike(ptm(lights)), colour, f"ptm {LRGB}")


def rgb(codes: Bytes, scale: Array, bias: Array) -> Relit:
    """Three polynomials, (H, W, 18) codes: the six of R, then those of G and of B; scale, bias : (6,) of all three."""
    return Relit(codes, np.tile(scale, 3), np.tile(bias, 3), apart, None, f"ptm {RGB}")


def alike(functions: Array) -> Array:
    """Weights of planes that count the same in all channels, (n, P) → (n, P + 1, 3)."""
    return np.repeat(np.pad(functions, ((0, 0), (1, 0)))[..., None], 3, axis=2)


def apart(lights: Array) -> Array:
    """Weights of three polynomials, a channel each, (n, 19, 3)."""
    functions = ptm(lights)
    found = np.zeros((len(lights), 1 + 3 * TERMS, 3))
    for channel in range(3):
        found[:, 1 + channel * TERMS : 1 + (channel + 1) * TERMS, channel] = functions
    return found
