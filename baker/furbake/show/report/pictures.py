"""Pictures of a report, each as a PNG inside a data URI."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from numpy.typing import NDArray

from furbake.asset.planes import write_png
from furbake.pelt.texels.basis import Basis
from furbake.pelt.texels.quantise import srgb_bytes
from furbake.show.swatch import resample

Array = NDArray[np.float64]
Bytes = NDArray[np.uint8]

DENSE = 0.25
"""Coverage from which a texel is shown at full brightness; thinner fur fades to black."""

SPAN = 0.4
"""Error, as a share of the brightest hairs, at which the colours of the error end."""

LEVELS = 64
"""Steps of grey, and of the error's colours on either side: more cost bytes and show nothing."""

NONE, DARKER, BRIGHTER = (0.055, 0.055, 0.06), (0.25, 0.65, 1.0), (1.0, 0.5, 0.12)
"""Colours, sRGB, of no error, of fit too dark and of fit too bright."""


def data_uri(pixels: Bytes) -> str:
    """(height, width, channels) sRGB bytes as a PNG in a data URI."""
    with TemporaryDirectory(prefix="furbake-") as folder:
        path = Path(folder) / "picture.png"
        write_png(path, pixels, srgb=True)
        return f"data:image/png;base64,{base64.b64encode(path.read_bytes()).decode('ascii')}"


def row(images: Array, side: int) -> Array:
    """(n, N, N) periodic tiles side by side with v upwards, (side, n·side); averaged down, never enlarged."""
    side = min(side, images.shape[1])
    small = resample(np.moveaxis(images, 0, -1), side, (0.0, 0.0))
    return np.concatenate(list(np.moveaxis(small[::-1], -1, 0)), axis=1)


def lightness(light: Array, coverage: Array, white: float) -> Array:
    """Light of texels, (..., N, N), as linear brightness 0..1: `white` is the brightest, thin fur fades out."""
    return np.asarray(np.clip(light / white, 0, 1) * np.clip(coverage / DENSE, 0, 1))


def grey(linear: Array) -> Bytes:
    """(height, width) linear 0..1 → (height, width, 1) sRGB bytes in `LEVELS` steps."""
    step = 255 / (LEVELS - 1)
    return np.round(np.round(srgb_bytes(linear) / step) * step).astype(np.uint8)[..., None]


def error_colours(error: Array) -> Bytes:
    """(height, width) signed error, share of the brightest → (height, width, 3) sRGB bytes, by `colour_scale`."""
    scale = np.round(np.clip(error / SPAN, -1, 1) * LEVELS) / LEVELS
    return np.round(255 * _colour(scale)).astype(np.uint8)


def discs(basis: Basis, side: int) -> list[Bytes]:
    """The functions of a basis over the hemisphere as seen from above, (side, side, 3) sRGB bytes each.

    The rim is the horizon; each function is shown on a scale of its own, in the colours of the error.
    """
    axis = (np.arange(side) + 0.5) / side * 2 - 1
    u, v = np.meshgrid(axis, -axis)
    across = np.maximum(np.hypot(u, v), 1e-9)
    shrink = np.minimum(1, 1 / across)
    u, v = u * shrink, v * shrink
    lights = np.stack([u, v, np.sqrt(np.maximum(1 - u * u - v * v, 0))], -1)
    values = np.moveaxis(basis(lights.reshape(-1, 3)).reshape(side, side, -1), -1, 0)
    return [error_colours(SPAN * value / max(float(np.abs(value).max()), 1e-9)) for value in values]


def colour_scale(steps: int = 9) -> Sequence[str]:
    """The colours of the error from too dark to too bright, as CSS."""
    colours = np.round(255 * _colour(np.linspace(-1, 1, steps))).astype(int)
    return [f"rgb({red},{green},{blue})" for red, green, blue in colours]


def _colour(scale: Array) -> Array:
    """(...) -1..1 → (..., 3)."""
    size = np.abs(scale)[..., None] ** 0.8
    end = np.where((scale < 0)[..., None], DARKER, BRIGHTER)
    return np.asarray(np.array(NONE) * (1 - size) + end * size)
