"""Folders of relight and OpenLIME: `info.json` and pictures of three planes each, `plane_0.jpg` and so on."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from furbake.asset.planes import write_jpeg, write_png
from furbake.rti import bases
from furbake.rti.ptm import GREATEST, read_bytes
from furbake.rti.relit import LRGB, RGB, TERMS, Array, Bytes, Relit, RtiError, Weights, alike
from furbake.surface.colours import decode
from furbake.surface.limits import Budget
from furbake.surface.material import Picture
from furbake.surface.soup import MeshError

INFO = "info.json"

ORDER = (5, 3, 4, 0, 2, 1)
"""PTM's coefficients in relight's order."""

FIXED: dict[str, tuple[Callable[[Array], Array], int]] = {
    "ptm": (bases.polynomial, TERMS),
    "hsh": (bases.hemispherical, 9),
    "sh": (bases.spherical, 9),
}
"""Bases that are the same for every file, and their functions at the most."""

MEASURED = ("rbf", "bilinear")
"""Bases that each file brings."""

MOST_PLANES, MOST_FUNCTIONS = 99, 10_000

FULL = 255.0


def read_relight(path: Path) -> Relit:
    """The picture that an `info.json`, or the folder that holds it, describes. Raises RtiError."""
    path = path / INFO if path.is_dir() else path
    try:
        info = json.loads(read_bytes(path))
    except (ValueError, RecursionError) as error:
        raise RtiError(f"{path}: not JSON ({str(error).splitlines()[0][:80]}), expected relight's {INFO}") from error
    try:
        return _relit(info, path)
    except RtiError:
        raise
    except KeyError as error:
        raise RtiError(f"{path}: no {error.args[0]}, expected relight's {INFO}") from error
    except ValueError as error:
        text = " ".join(str(error).split())[:160]
        expected = "" if "expected" in text else f", expected relight's {INFO}"
        raise RtiError(f"{path}: {text}{expected}") from error
    except (LookupError, TypeError, AttributeError, OverflowError) as error:
        detail = " ".join(str(error).split())[:80]
        raise RtiError(f"{path}: malformed ({detail}), expected relight's {INFO}") from error


def _relit(info: dict[str, Any], path: Path) -> Relit:
    kind, space = str(info["type"]), str(info["colorspace"])
    planes = sum(info["yccplanes"]) if space == "mycc" else info["nplanes"]
    if type(planes) is not int or not 3 <= planes <= MOST_PLANES:
        raise RtiError(f"{path}: got {planes!r} planes, expected 3 to {MOST_PLANES}")
    material = info["materials"][0]
    scale, bias = (_numbers(material[name], planes, name) for name in ("scale", "bias"))
    weigh = _weights(info, kind, space, planes, path)
    codes = _planes(path, planes, str(info.get("format", "jpg")))
    colour = None
    if space == LRGB:
        codes, colour, scale, bias = codes[..., 3:], codes[..., :3], scale[3:], bias[3:]
    return Relit(codes, scale, FULL * bias, weigh, colour, f"{kind} {space}"[:40])


def _weights(info: dict[str, Any], kind: str, space: str, planes: int, path: Path) -> Weights:
    if kind in FIXED and space in (LRGB, RGB):
        functions, most = FIXED[kind]
        count = planes - 3 if space == LRGB else planes / 3
        if 1 <= count <= most and count == int(count):
            number = int(count)
            if space == LRGB:
                return lambda lights: alike(functions(lights)[:, :number])
            return lambda lights: _interleaved(functions(lights)[:, :number])
    if kind in MEASURED and space in ("mrgb", "mycc"):
        return _measured(info, kind, space, planes)
    known = f"{', '.join(FIXED)} with lrgb or rgb, {' or '.join(MEASURED)} with mrgb or mycc"
    raise RtiError(f"{path}: got {kind[:20]} with {space[:20]} and {planes} planes, expected {known}")


def _interleaved(functions: Array) -> Array:
    """Weights of planes R, G, B of the first function, then of the next, (n, C) → (n, 3·C + 1, 3)."""
    spread = np.einsum("nc,kl->nckl", functions, np.eye(3)).reshape(len(functions), -1, 3)
    return np.pad(spread, ((0, 0), (1, 0), (0, 0)))


def _measured(info: dict[str, Any], kind: str, space: str, planes: int) -> Weights:
    """Weights that are interpolated between the file's own, of each lamp or lattice point."""
    if kind == "rbf":
        lamps = _numbers(info["lights"]).reshape(-1, 3)
        count, sigma = len(lamps), float(info["sigma"])
        if not (count and 1e-6 < sigma < 1e6):
            raise ValueError("no lights, or a sigma out of range")

        def shares(lights: Array) -> Array:
            return bases.radial(lights, lamps, sigma)
    else:
        resolution = int(info["resolution"])
        count = resolution * resolution
        if not 2 <= resolution <= math.isqrt(MOST_FUNCTIONS):
            raise ValueError(f"resolution {resolution}")

        def shares(lights: Array) -> Array:
            return bases.bilinear(lights, resolution)

    table = _numbers(info["basis"], (planes + 1) * count * 3).reshape(planes + 1, count, 3)
    ranges = _numbers(info["materials"][0]["range"], planes)
    if (np.abs(ranges) < 1 / GREATEST).any():
        raise ValueError("a range of 0")
    table = np.concatenate([table[:1], (table[1:] - 127) / ranges[:, None, None]])
    if space == "mrgb":
        return lambda lights: np.einsum("nm,pmk->npk", shares(lights), table)
    chroma = [int(number) for number in info["yccplanes"]]
    return lambda lights: _from_ycc(np.einsum("nm,pmk->npk", shares(lights), table), chroma)


def _from_ycc(weights: Array, planes: list[int]) -> Array:
    """Weights for R, G, B of those for brightness and two differences of colour.

    As long as all three have planes these take turns, three in a picture; the others are of brightness alone.
    """
    found = np.zeros_like(weights)
    found[:, 0] = weights[:, 0]
    for plane in range(weights.shape[1] - 1):
        channel = plane % 3 if plane // 3 < planes[1] else 0
        found[:, plane + 1, channel] = weights[:, plane + 1, channel]
    y, orange, green = found[..., 0], found[..., 1], found[..., 2]
    blue = y - green / 2 - orange / 2
    return np.stack([blue + orange, y + green / 2, blue], -1)


def _planes(path: Path, planes: int, suffix: str) -> Bytes:
    """(H, W, planes) bytes of the pictures beside `info.json`."""
    budget, codes = Budget(str(path), "bytes"), np.empty((0, 0, planes), np.uint8)
    for number in range(math.ceil(planes / 3)):
        place = path.with_name(f"plane_{number}.{'png' if suffix == 'png' else 'jpg'}")
        pixels = decode(Picture(read_bytes(place), ""))
        if pixels is None:
            raise RtiError(f"{place}: cannot be read, expected a picture of three planes")
        if number == 0:
            try:
                budget.take(pixels.shape[0] * pixels.shape[1] * planes)
            except MeshError as error:
                raise RtiError(str(error)) from error
            codes = np.empty((*pixels.shape[:2], planes), np.uint8)
        if pixels.shape[:2] != codes.shape[:2]:
            size = f"{pixels.shape[1]} x {pixels.shape[0]}"
            raise RtiError(f"{place}: {size} pixels, expected {codes.shape[1]} x {codes.shape[0]} as plane_0 has")
        part = slice(3 * number, min(3 * number + 3, planes))
        codes[..., part] = pixels[..., : part.stop - part.start]
    return codes


def _numbers(values: Any, count: int | None = None, name: str = "a list") -> Array:
    array = np.array(values, np.float64)
    if array.ndim != 1 or (count is not None and len(array) != count) or len(array) > 100 * MOST_FUNCTIONS:
        raise ValueError(f"{name} of {array.size} numbers, expected {count or f'{100 * MOST_FUNCTIONS} at most'}")
    if not (np.abs(array) < GREATEST).all():
        raise ValueError(f"{name} with a number that is not below {GREATEST:g}")
    return array


def write_relight(folder: Path, relit: Relit, suffix: str = "jpg", quality: int = 95) -> list[str]:
    """Write a `relit.lrgb` or `relit.rgb` into a folder as relight has it; the names of the files.

    suffix : jpg, as relight writes, with its losses, or png
    """
    groups = [relit.codes[..., i : i + TERMS][..., ORDER] for i in range(0, relit.codes.shape[-1], TERMS)]
    if relit.colour is None:
        planes = np.stack(groups, -1).reshape(relit.height, relit.width, -1)
        scale, bias = (np.repeat(values[list(ORDER)], 3) for values in (relit.scale[:TERMS], relit.bias[:TERMS] / FULL))
    else:
        planes = np.concatenate([relit.colour, groups[0]], -1)
        scale = np.concatenate([np.ones(3), relit.scale[list(ORDER)]])
        bias = np.concatenate([np.zeros(3), relit.bias[list(ORDER)] / FULL])
    names = []
    for number in range(planes.shape[-1] // 3):
        names.append(f"plane_{number}.{suffix}")
        pixels = planes[..., 3 * number : 3 * number + 3]
        if suffix == "png":
            write_png(folder / names[-1], pixels)
        else:
            write_jpeg(folder / names[-1], pixels, quality)
    info = {
        "width": relit.width,
        "height": relit.height,
        "format": suffix,
        "type": "ptm",
        "colorspace": RGB if relit.colour is None else LRGB,
        "nplanes": planes.shape[-1],
        "quality": quality,
        "materials": [{"scale": [*map(float, scale)], "bias": [*map(float, bias)]}],
    }
    (folder / INFO).write_text(json.dumps(info, indent=1) + "\n", "utf-8")
    return [INFO, *names]
