"""A pelt from above for the viewers of museums: a picture that is relit, fitted anew from the pelt under many lamps.

A pelt's own polynomials are of its slabs, in its own basis and times their mean curves; what an eye above sees of all
slabs together is another polynomial.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from furbake.asset.read import Asset, read_asset
from furbake.asset.stored import read_pelt, skin_colour
from furbake.daylight import PAGE, Scene, tone_mapped
from furbake.options import OptionError
from furbake.pelt.light.transport import hemisphere
from furbake.pelt.pelt import Pelt
from furbake.pelt.texels.fit import decibels
from furbake.pelt.texels.quantise import srgb_bytes
from furbake.rti.fit import fit_images
from furbake.rti.relit import LRGB, Relit
from furbake.show.swatch import SHELLS_PER_SLAB, from_srgb, radiance

Array = NDArray[np.float64]

COMPOSITE = "composite"

LIGHTS, UNSEEN = 64, 24
"""Lamps of the fit, and others by which it is judged."""

TOGETHER = 2**22
"""Pixels of all lamps that are drawn together."""

PEAK = 99.9
"""Percentile of the brightness that becomes 255 where values are linear."""

MOST = 2048


@dataclass(frozen=True)
class Exported:
    """relit : the picture; psnr : decibels on lamps that the fit has not seen; white : linear value of byte 255."""

    relit: Relit
    psnr: float
    white: float


def exported(
    folder: Path,
    *,
    kind: str = LRGB,
    state: str | None = None,
    layer: str = COMPOSITE,
    linear: bool = False,
    tiles: int = 2,
    size: int = 512,
    step: Callable[[float], None] = lambda fraction: None,
) -> Exported:
    """The pelt of a baked folder, seen from straight above, as a picture that is relit.

    kind : lrgb or rgb; state : name of one of its states, the first by default
    layer : number of a slab, 0 at the skin, which is shown alone before black, or `COMPOSITE`
    linear : bytes proportional to light; else as the page shows them, tone mapped and sRGB
    tiles, size : repeats of the tile along a side, and pixels; a slab alone has its own texels, once

    Raises AssetError, or OptionError for an argument out of range.
    """
    for name, value, low, high in (("tiles", tiles, 1, 16), ("pixels", size, 16, MOST)):
        if not low <= value <= high:
            raise OptionError(f"{name}: got {value}, expected {low} to {high}")
    asset = read_asset(folder)
    draw = _drawer(asset, state, layer, -(-size // tiles))
    lights = np.concatenate([hemisphere(LIGHTS), hemisphere(UNSEEN, turn=1.0)])
    white = float(np.percentile(np.concatenate([*draw(lights[: LIGHTS // 4])]), PEAK)) if linear else 1.0
    white = max(white, 1e-6)

    def coded(some: Array) -> Iterator[NDArray[np.float32]]:
        for i, image in enumerate(draw(some)):
            seen = np.clip(image / white, 0, 1) * 255 if linear else srgb_bytes(tone_mapped(image))
            yield seen[::-1].astype(np.float32)
            step((i + 1) / len(lights))

    relit = fit_images(coded(lights[:LIGHTS]), lights[:LIGHTS], kind)
    errors = [
        float(((relit.lit(light) - image / 255) ** 2).mean(dtype=np.float64))
        for light, image in zip(lights[LIGHTS:], coded(lights[LIGHTS:]), strict=True)
    ]
    if layer == COMPOSITE:
        relit = _repeated(relit, tiles, size)
    return Exported(relit, decibels(float(np.mean(errors))), white)


def _drawer(asset: Asset, state: str | None, layer: str, pixels: int) -> Callable[[Array], Iterator[Array]]:
    """Linear pictures (N, N, 3) of one tile under lights, row 0 at v = 0."""
    names = [pelt["name"] for pelt in asset.fur["pelts"]]
    if state is not None and state not in names:
        raise OptionError(f"state: got {state!r}, expected one of {', '.join(names)}")
    pelt = read_pelt(asset, 0 if state is None else names.index(state))
    hairs = read_pelt(asset) if pelt.state.mud else None
    skin = skin_colour(asset)
    if layer != COMPOSITE:
        if not layer.isdecimal() or int(layer) >= pelt.layers:
            raise OptionError(f"layer: got {layer!r}, expected {COMPOSITE} or 0 to {pelt.layers - 1}")
        slab = _slab(hairs or pelt, int(layer), np.array(skin))
        return lambda lights: _alone(pelt, slab, int(layer), lights)
    many = max(TOGETHER // pixels**2, 1)

    def draw(lights: Array) -> Iterator[Array]:
        for first in range(0, len(lights), many):
            yield from radiance(pelt, lights[first : first + many], pixels, SHELLS_PER_SLAB, PAGE, skin, hairs)

    return draw


def _slab(hairs: Pelt, k: int, skin: Array) -> Array:
    """Colour of a slab's texels times their coverage, (N, N, 3) linear."""
    if hairs.colour is None:
        root, tip = np.array(hairs.ramp.root), np.array(hairs.ramp.tip)
        height = ((k + 0.5) / hairs.layers) ** hairs.ramp.power
        colour = hairs.tint[k, ..., None] / 255.0 * (root + (tip - root) * height)
    else:
        colour = from_srgb(hairs.colour[k])
    return np.asarray(colour * skin * hairs.state.shade * (hairs.alpha[k, ..., None] / 255.0))


def _alone(pelt: Pelt, slab: Array, k: int, lights: Array, scene: Scene = PAGE) -> Iterator[Array]:
    """A slab alone before black, in the light of the lamp."""
    for light in lights:
        yield slab * pelt.light(light[None])[0, k][..., None] * np.array(scene.lamp) / (4 * np.pi)


def _repeated(relit: Relit, tiles: int, size: int) -> Relit:
    """The tile repeated to a picture of `size` × `size`; its lower left corner is that of a tile."""

    def spread(values: NDArray[np.uint8]) -> NDArray[np.uint8]:
        return np.ascontiguousarray(np.tile(values[::-1], (tiles, tiles, 1))[:size, :size][::-1])

    colour = None if relit.colour is None else spread(relit.colour)
    return Relit(spread(relit.codes), relit.scale, relit.bias, relit.weigh, colour, relit.kind)
