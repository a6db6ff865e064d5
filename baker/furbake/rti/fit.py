"""Photographs to numbers per pixel: the polynomial as PTMfitter has it, and how good fits are on lamps they never saw.

PTMfitter's LRGB was found by its output, to the byte: brightness by the Rec. 709 weights below, each pixel's divided by
its brightest and fitted by least squares; beside it the pixel's mean colour at that brightness.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import chain
from typing import Any

import numpy as np
from numpy.typing import NDArray

from furbake.pelt.texels.basis import DEGREE, PTM, Basis, Functions, smooth_terms
from furbake.pelt.texels.eigen import eigen
from furbake.pelt.texels.fit import decibels
from furbake.rti import relit
from furbake.rti.photographs import Photographs
from furbake.rti.ptm import byte_header, fitted_bytes
from furbake.rti.relit import LRGB, RGB, TERMS, Array, Bytes, Relit, Single

LUMINANCE = np.array([0.2125, 0.7154, 0.0721])
"""Brightness of R, G and B."""

FULL = 255.0

TINY = np.float32(1e-6)
"""Least brightness by which is divided."""

BAND = 2**22
"""Pixels whose sums are in memory together; a larger set is read once for each band."""

JUDGED = 2**15
"""Pixels of each photograph by which fits are judged, and the range of their bytes is found."""

ALONE, MANY = 24, 120
"""Photographs up to which each is left out alone; up to which `FOLDS` parts are, and of more `FEW`, one at a time."""

FOLDS, FEW = 12, 4

CURVED = 150
"""Lamps by which light curves are found at the most."""

EIGEN = (3, 4, 5, 6)

ENOUGH = 2 / 3
"""Smooth functions for each lamp at the most."""

Step = Callable[[float], None]
Real = NDArray[np.floating[Any]]


def fit_photographs(photographs: Photographs, kind: str = LRGB, step: Step = lambda fraction: None) -> Relit:
    """The polynomial of all pixels, with one colour a pixel (lrgb) or for each channel (rgb)."""
    fitted = _fit_lrgb if kind == LRGB else _fit_rgb
    inverse = np.linalg.pinv(PTM(photographs.lights))
    scale, bias = _header(photographs, inverse, kind)
    height, width = photographs.height, photographs.width
    codes = np.empty((height, width, TERMS if kind == LRGB else 3 * TERMS), np.uint8)
    colour = np.empty((height, width, 3), np.uint8) if kind == LRGB else None
    rows = max(BAND // width, 1)
    for top in range(0, height, rows):
        band = slice(top, min(top + rows, height))
        stripes = (
            pixels[band].astype(np.float32) for pixels in _counted(photographs, step, top / height, rows / height)
        )
        values, own = fitted(stripes, inverse)
        for i in range(codes.shape[-1]):  # one at a time: a band is large
            codes[band, :, i] = fitted_bytes(values[..., i], scale[i % TERMS], bias[i % TERMS])
        if colour is not None:
            colour[band] = np.clip(own, 0, FULL)
    step(1.0)
    if colour is None:
        return relit.rgb(codes, scale, bias)
    return relit.lrgb(codes, scale, bias, colour)


def fit_images(images: Iterator[Single], lights: Array, kind: str = LRGB) -> Relit:
    """The same of pictures that are made, (H, W, 3) of 0 to 255 under lights (n, 3)."""
    values, colour = (_fit_lrgb if kind == LRGB else _fit_rgb)(images, np.linalg.pinv(PTM(lights)))
    each = values.reshape(-1, TERMS).astype(np.float64)
    scale, bias = byte_header(each.min(0), each.max(0))
    codes = fitted_bytes(values.reshape(*values.shape[:2], -1, TERMS), scale, bias).reshape(values.shape)
    if kind == RGB:
        return relit.rgb(codes, scale, bias)
    return relit.lrgb(codes, scale, bias, np.clip(np.rint(colour), 0, FULL).astype(np.uint8))


def _counted(photographs: Photographs, step: Step, start: float, share: float) -> Iterator[Bytes]:
    count = len(photographs.paths)
    for i, pixels in enumerate(photographs):
        yield pixels
        step(min(start + share * (i + 1) / count, 1.0))


def _fit_lrgb(stripes: Iterator[Single], inverse: Real) -> tuple[Single, Single]:
    """Coefficients (..., 6) of brightness over its brightest, of 255, and colour (..., 3) of photographs (..., 3)."""
    weights = LUMINANCE.astype(np.float32)
    first = next(stripes)
    sums, colour = np.zeros((*first.shape[:-1], TERMS), np.float32), np.zeros_like(first)
    brightest = np.zeros_like(first[..., 0])
    for pixels, row in zip(chain([first], stripes), inverse.T.astype(np.float32), strict=True):
        light = pixels @ weights
        for i, share in enumerate(row):  # a product with all of them at once would take six times the memory
            sums[..., i] += light * share
        colour += pixels
        np.maximum(brightest, light, out=brightest)
    sums *= (FULL / np.maximum(brightest, TINY))[..., None]
    colour *= (brightest / np.maximum(colour @ weights, TINY))[..., None]
    return sums, colour


def _fit_rgb(stripes: Iterator[Single], inverse: Real) -> tuple[Single, Single]:
    """Coefficients of R, then of G and B, (..., 18), of photographs (..., 3); no colour beside them."""
    first = next(stripes)
    sums = np.zeros((*first.shape, TERMS), np.float32)
    for pixels, row in zip(chain([first], stripes), inverse.T.astype(np.float32), strict=True):
        for i, share in enumerate(row):
            sums[..., i] += pixels * share
    return sums.reshape(*first.shape[:-1], 3 * TERMS), np.zeros(3, np.float32)


def _header(photographs: Photographs, inverse: Real, kind: str) -> tuple[Array, Array]:
    """λ and Ω, (6,), from some of the pixels: of all in small photographs."""
    stripes = (pixels.astype(np.float32) for pixels in photographs.sampled(JUDGED))
    values, _ = (_fit_lrgb if kind == LRGB else _fit_rgb)(stripes, inverse)
    each = values.reshape(-1, TERMS)
    return byte_header(each.min(0).astype(np.float64), each.max(0).astype(np.float64))


Predict = Callable[[Single, Array, Array, Basis], Single]
"""Photographs under new lamps, from photographs, their lamps, and the light curves that suit them."""


@dataclass(frozen=True)
class Fit:
    """A way to fit: its name, numbers per pixel, and lamps that it needs."""

    name: str
    numbers: int
    lamps: int
    predict: Predict


@dataclass(frozen=True)
class Figure:
    """A fit of a set of photographs: its name, numbers per pixel, and decibels over lamps.

    left_out : True where the fit has not seen the lamps by which it is judged
    """

    name: str
    numbers: int
    psnr: float
    left_out: bool


def held_out(photographs: Photographs) -> list[Figure]:
    """Fits judged on lamps that were left out, one after the other: peak signal-to-noise of the photographs' bytes."""
    samples = photographs.sampled(JUDGED).astype(np.float32)
    lights, folds = photographs.lights, _folds(len(photographs.lights))
    least = len(lights) - max(map(len, folds))
    errors = {fit: 0.0 for fit in FITS if least >= fit.lamps}
    for out in folds:
        kept = np.delete(np.arange(len(lights)), out)
        curves = _curves(samples[kept], lights[kept])
        for fit in errors:
            guess = fit.predict(samples[kept], lights[kept], lights[out], curves)
            np.clip(guess, 0, FULL, out=guess)
            errors[fit] += float(((guess - samples[out]) ** 2).mean(dtype=np.float64)) * len(out)
    return [
        Figure(fit.name, fit.numbers, decibels(error / len(lights) / FULL**2), left_out=True)
        for fit, error in errors.items()
    ]


def beside(photographs: Photographs, others: dict[str, Relit]) -> list[Figure]:
    """Fits that others have made of all of these photographs, which they have therefore seen. Sizes must agree."""
    errors = dict.fromkeys(others, 0.0)
    for pixels, light in zip(photographs, photographs.lights, strict=True):
        for name, other in others.items():
            difference = other.picture(light).astype(np.float32) - pixels
            errors[name] += float((difference**2).mean(dtype=np.float64))
    count = len(photographs.paths) * FULL**2
    return [
        Figure(f"{name} ({other.kind})", _numbers(other), decibels(errors[name] / count), left_out=False)
        for name, other in others.items()
    ]


def _numbers(other: Relit) -> int:
    return int(other.codes.shape[-1]) + (0 if other.colour is None else 3)


def _folds(count: int) -> list[list[int]]:
    """Photographs that are left out together."""
    if count <= ALONE:
        return [[i] for i in range(count)]
    folds = FOLDS if count <= MANY else FEW
    return [list(range(first, count, folds)) for first in range(folds)]


def smoothness(lamps: int) -> int:
    """Degree of the smooth functions that so many lamps tell: few lamps bear few functions."""
    return next((degree for degree in range(DEGREE, 2, -1) if smooth_terms(degree) <= ENOUGH * lamps), 2)


def _curves(seen: Single, lights: Array) -> Basis:
    """The light curves that suit photographs (n, pixels, 3) best, the strongest first: the first few suit best, too."""
    some = slice(None, None, -(-len(lights) // CURVED))
    flat, lights = seen[some].reshape(-1, seen[0].size), lights[some]
    count = min(max(EIGEN), len(lights))
    return eigen(flat, np.ones(flat.shape[1], np.float32), lights, count, smoothness(len(lights)))


def _mixed(seen: Single, basis: Functions, lights: Array, new: Array) -> Single:
    """Photographs (m, pixels, 3) under new lights (m, 3), from those that are seen (n, pixels, 3)."""
    shares = (basis(new) @ np.linalg.pinv(basis(lights))).astype(np.float32)
    return np.asarray((shares @ seen.reshape(len(seen), -1)).reshape(-1, *seen.shape[1:]))


def _by_rgb(seen: Single, lights: Array, new: Array, _: Basis) -> Single:
    return _mixed(seen, PTM, lights, new)


def _by_lrgb(seen: Single, lights: Array, new: Array, _: Basis) -> Single:
    values, colour = _fit_lrgb(iter(seen), np.linalg.pinv(PTM(lights)))
    light = PTM(new).astype(np.float32) @ values.T
    return np.asarray(np.maximum(light, 0)[..., None] * colour / np.float32(FULL))


def _by_curves(count: int) -> Predict:
    def predict(seen: Single, lights: Array, new: Array, curves: Basis) -> Single:
        some = Basis("eigen", curves.degree, None if curves.matrix is None else curves.matrix[:count])
        return _mixed(seen, some, lights, new)

    return predict


FITS = (
    Fit("ptm rgb", 3 * TERMS, TERMS, _by_rgb),
    Fit("ptm lrgb", TERMS + 3, TERMS, _by_lrgb),
    *(Fit(f"eigen {count}", 3 * count, count, _by_curves(count)) for count in EIGEN),
)
