"""A swatch: the pelt on a plane, seen from straight above under any light, to judge a bake at a glance.

The picture is what the page's shader makes of the same bytes (`web/fur/shaders`), without its α cut. Columns grow
along u, the picture's upper edge is the larger v: a light from +v comes from the top.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from furbake.asset.planes import write_png
from furbake.asset.read import read_asset
from furbake.asset.stored import body_radius, read_pelt, skin_colour
from furbake.daylight import PAGE, RGB, Scene, tone_mapped
from furbake.options import OptionError
from furbake.pelt.curves import RADII
from furbake.pelt.eye import surge
from furbake.pelt.lean import along_lean
from furbake.pelt.light.paths import BODY_RADIUS
from furbake.pelt.pelt import Pelt
from furbake.pelt.texels.basis import environment
from furbake.pelt.texels.quantise import srgb_bytes

Array = NDArray[np.float64]
Bytes = NDArray[np.uint8]
Direction = tuple[float, float, float]

FROM_THE_SIDE: Direction = (-0.62, 0.48, 0.62)
"""A light that shows the strands: from the front fur looks flat."""

SHELLS_PER_SLAB = 3
"""Shells drawn per slab, as by the page: they are sheared along the hairs, which then run on unbroken."""

UP = np.array([0.0, 0.0, 1.0])

SKIN = 0.35
"""Colour of the bare skin over that of the roots."""

HARMONIC_0, HARMONIC_1 = math.sqrt(1 / (4 * math.pi)), math.sqrt(3 / (4 * math.pi))


def render(
    folder: Path,
    light: Direction = FROM_THE_SIDE,
    *,
    tiles: int = 3,
    size: int = 512,
    shells_per_slab: int = SHELLS_PER_SLAB,
    scene: Scene = PAGE,
    state: str | None = None,
) -> Bytes:
    """The pelt of a baked folder, (size, size, 3) sRGB bytes.

    light : towards the lamp in the tile's frame (u, v, normal), of any length
    tiles : repeats of the tile along a side, 1 to 16
    size : of the picture, pixels, 16 to 4096
    state : name of one of its states, the first by default

    Raises AssetError, or OptionError for an argument out of range.
    """
    asset = read_asset(folder)
    names = [pelt["name"] for pelt in asset.fur["pelts"]]
    if state is not None and state not in names:
        raise OptionError(f"state: got {state!r}, expected one of {', '.join(names)}")
    pelt = read_pelt(asset, 0 if state is None else names.index(state))
    return picture(
        pelt,
        light,
        hairs=read_pelt(asset) if pelt.state.mud else None,
        tiles=tiles,
        size=size,
        shells_per_slab=shells_per_slab,
        scene=scene,
        skin=skin_colour(asset),
        beta=body_radius(asset),
    )


def save(
    folder: Path,
    out: Path,
    light: Direction = FROM_THE_SIDE,
    *,
    tiles: int = 3,
    size: int = 512,
    scene: Scene = PAGE,
    state: str | None = None,
) -> Bytes:
    """Write `render` as a PNG; its pixels. Raises AssetError, OptionError or PlaneError."""
    pixels = render(folder, light, tiles=tiles, size=size, scene=scene, state=state)
    write_png(out, pixels, srgb=True)
    return pixels


def picture(
    pelt: Pelt,
    light: Direction = FROM_THE_SIDE,
    *,
    tiles: int = 3,
    size: int = 512,
    shells_per_slab: int = SHELLS_PER_SLAB,
    scene: Scene = PAGE,
    skin: RGB = (1.0, 1.0, 1.0),
    hairs: Pelt | None = None,
    beta: float = BODY_RADIUS,
) -> Bytes:
    """A pelt that need not be in a folder; otherwise as `render`.

    skin : linear, multiplies the fur's colours; hairs : of a dirty pelt, the clean one that has its hairs' colours
    beta : radius, in lengths of the fur, of the body that the fur is lit on; the picture is flat all the same
    """
    look = {"tiles": tiles, "size": size, "shells_per_slab": shells_per_slab}
    (image,) = pictures(pelt, [light], **look, scene=scene, skin=skin, hairs=hairs, beta=beta)
    return image


def pictures(
    pelt: Pelt,
    lights: Sequence[Direction],
    *,
    tiles: int = 3,
    size: int = 512,
    shells_per_slab: int = SHELLS_PER_SLAB,
    scene: Scene = PAGE,
    skin: RGB = (1.0, 1.0, 1.0),
    hairs: Pelt | None = None,
    beta: float = BODY_RADIUS,
) -> list[Bytes]:
    """As `picture`, under several lights, which costs little more than one."""
    _within("tiles", tiles, 1, 16)
    _within("size", size, 16, 4096)
    _within("shells_per_slab", shells_per_slab, 1, 8)
    directions = np.stack([light_direction(light) for light in lights])
    found = []
    for tile in radiance(pelt, directions, -(-size // tiles), shells_per_slab, scene, skin, hairs, beta):
        whole = np.tile(srgb_bytes(tone_mapped(tile)), (tiles, tiles, 1))
        found.append(np.ascontiguousarray(whole[:size, :size][::-1]))
    return found


def radiance(
    pelt: Pelt,
    lights: Array,
    pixels: int,
    shells_per_slab: int = SHELLS_PER_SLAB,
    scene: Scene = PAGE,
    skin: RGB = (1.0, 1.0, 1.0),
    hairs: Pelt | None = None,
    beta: float = BODY_RADIUS,
) -> Array:
    """One tile seen from straight above under each of n lights, row 0 at v = 0: (n, pixels, pixels, 3) linear.

    Shells over the skin, from the innermost out: radiance = colour · L·E/(4π), lamp and sky clamped apart.
    beta : as of `picture`
    """
    coefficients = pelt.values
    hairs = hairs or pelt
    colours = None if hairs.colour is None else from_srgb(hairs.colour)
    mud = None if pelt.state.mud is None else np.array(pelt.state.mud)
    beta = float(np.clip(beta, RADII[0], RADII[-1]))
    sky_moments = sky_of(pelt, beta) @ sky_harmonics(scene)
    count = pelt.layers * shells_per_slab
    heights = (np.arange(count) + 0.5) / count
    shear = drift_at(heights, pelt.drift) - np.repeat(pelt.drift, shells_per_slab, axis=0)
    base, lamp = pelt.state.shade * np.array(skin), np.array(scene.lamp)
    root, tip = np.array(pelt.ramp.root), np.array(pelt.ramp.tip)

    mean = pelt.mean(lights, beta)
    above = np.broadcast_to(UP, lights.shape)
    lean, towards_eye = pelt.drift[-1] / pelt.height, np.ones(len(lights))
    if pelt.surge is not None:
        towards_eye = surge(lights, above, np.asarray(pelt.surge)) * along_lean(lights, above, lean, beta)
    tinge = np.ones((len(lights) + 1, pelt.layers, 3))
    if pelt.multiple is not None and pelt.curves is not None and pelt.weights is not None:
        tinge = pelt.multiple.tinges(pelt.curves, pelt.weights, hairs.ramp, base, lights, lean, beta)

    def lit(at: Array, k: int, s: float) -> Iterator[Array]:
        """Light of all pixels of slab k under each lamp."""
        sky = tinge[-1, k] * np.maximum(at @ sky_moments[k], 0)
        for n, light in enumerate(lights):
            seen, fade = above_horizon(light, s)
            share = towards_eye[n] * (fade if mean is None else mean[n, k])
            curve = np.maximum(at @ (share * pelt.basis(seen[None])[0]), 0)
            yield (curve[..., None] * (tinge[n, k] * lamp) + sky) / (4 * np.pi)

    bare = resample(coefficients[0], pixels, (0.0, 0.0))
    images: Array = np.stack([SKIN * base * root * light for light in lit(bare, 0, 0.0)])
    for i, s in enumerate(heights):
        k = i // shells_per_slab
        pigments = hairs.tint[k, ..., None] / 255.0 if colours is None else colours[k]
        cover, share = (part[k, ..., None] / 255.0 for part in (pelt.alpha, pelt.tint))
        at = resample(np.concatenate([coefficients[k], cover, share, pigments], -1), pixels, (shear[i, 0], shear[i, 1]))
        a, alpha, share, pigment = np.split(at, np.cumsum([pelt.coefficients, 1, 1]), axis=-1)
        colour = base * pigment * (1.0 if colours is not None else root + (tip - root) * s**pelt.ramp.power)
        if mud is not None:
            colour = colour + share * (mud - colour)
        opacity = 1 - (1 - np.minimum(alpha, 0.996)) ** (1 / shells_per_slab)
        for n, light in enumerate(lit(a, k, float(s))):
            images[n] += opacity * (colour * light - images[n])
    return images


def sky_of(pelt: Pelt, beta: float = BODY_RADIUS) -> Array:
    """Harmonics of the radiance → light moments of each slab on a body of radius β, (K, C, 9)."""
    if pelt.curves is None or pelt.weights is None:
        return np.broadcast_to(environment(pelt.basis), (pelt.layers, pelt.coefficients, 9))
    return np.tensordot(pelt.weights, pelt.curves.environment(pelt.basis, beta), 1)


def light_direction(light: Sequence[float]) -> Array:
    """A direction of length 1. Raises OptionError for one without a direction."""
    vector = np.array(light, np.float64)
    length = float(np.linalg.norm(vector)) if vector.shape == (3,) else 0.0
    if not (math.isfinite(length) and length > 0):
        given = ",".join(f"{value:g}" for value in light)
        raise OptionError(f"light: got {given}, expected three numbers x,y,z that are not all 0")
    return vector / length


def above_horizon(light: Array, s: float) -> tuple[Array, float]:
    """(direction, fade) of a light for fur at height s, 0..1: below the horizon (lu, lv) stays on the unit circle.

    The fade runs over the dip of the horizon that a point at height s on a round body sees (as in moments.glsl).
    """
    if light[2] >= 0:
        return light, 1.0
    dip = math.sqrt(1 - (BODY_RADIUS / (BODY_RADIUS + s)) ** 2)
    fade = math.sqrt(max(0.0, 1 + light[2] / dip)) if dip > 0 else 0.0
    return np.array([*(light[:2] / max(np.hypot(*light[:2]), 1e-4)), 0.0]), fade


def drift_at(s: Array, drift: Array) -> Array:
    """Mean displacement of the hairs at heights `s` (n,), (n, 2): 0 at the root, linear between slab middles."""
    middles = (np.arange(len(drift)) + 0.5) / len(drift)
    knots, values = np.append(0.0, middles), np.vstack([np.zeros(2), drift])
    after = np.clip(np.searchsorted(knots, s, side="right"), 1, len(drift))
    t = ((s - knots[after - 1]) / (knots[after] - knots[after - 1]))[:, None]
    return np.asarray(values[after - 1] + t * (values[after] - values[after - 1]))


def sky_harmonics(scene: Scene) -> Array:
    """Radiance of a sky over the plane in spherical harmonics of order 2, (9, 3): constant and gradient upwards."""
    sky, ground = np.array(scene.sky), np.array(scene.ground)
    harmonics = np.zeros((9, 3))
    harmonics[0] = (sky + ground) / (2 * math.pi * HARMONIC_0)
    harmonics[2] = 0.75 * (sky - ground) / (math.pi * HARMONIC_1)
    return harmonics


def resample(texels: Array, pixels: int, shear: tuple[float, float]) -> Array:
    """(N, N, C) periodic texels at uv − shear (tile widths), (pixels, pixels, C).

    Bilinear; averaged where pixels are larger than texels.
    """
    for axis, offset in ((0, shear[1]), (1, shear[0])):
        index, weight = _taps(texels.shape[axis], pixels, offset)
        shape = (-1, *[1] * (texels.ndim - 1 - axis))
        parts = [texels.take(i, axis) * w.reshape(shape) for i, w in zip(index, weight, strict=True)]
        texels = np.sum(parts, axis=0)
    return texels


def _taps(texels: int, pixels: int, offset: float) -> tuple[NDArray[np.int64], Array]:
    """Texels and their weights, (taps, pixels) each, of a periodic tent as wide as a texel or as a pixel."""
    wide = max(1.0, texels / pixels)
    at = ((np.arange(pixels) + 0.5) / pixels - offset) * texels - 0.5
    index = np.floor(at - wide).astype(np.int64) + 1 + np.arange(math.ceil(2 * wide))[:, None]
    weight = np.maximum(1 - np.abs(index - at) / wide, 0)
    return index % texels, weight / weight.sum(0)


def from_srgb(codes: Bytes) -> Array:
    """sRGB bytes → linear 0..1."""
    value = codes / 255.0
    return np.asarray(np.where(value <= 0.04045, value / 12.92, ((value + 0.055) / 1.055) ** 2.4))


def _within(name: str, value: int, low: int, high: int) -> None:
    if not low <= value <= high:
        raise OptionError(f"{name}: got {value}, expected {low} to {high}")
