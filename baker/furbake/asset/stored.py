"""The pelt of a baked folder, read back byte for byte from what `write_gltf` stored."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from furbake.asset.extension import STATE
from furbake.asset.planes import PlaneError, Planes, Texels, unpack, unpack_fin
from furbake.asset.read import Asset, AssetError
from furbake.pelt.curves import KNOTS, RADII, Curves, lean_direction
from furbake.pelt.eye import TERMS
from furbake.pelt.hairs.ramp import Ramp
from furbake.pelt.hairs.states import PeltState
from furbake.pelt.light.paths import BODY_RADIUS
from furbake.pelt.multiple import Multiple
from furbake.pelt.pelt import FinPelt, Pelt
from furbake.pelt.texels.basis import PTM, Basis, smooth_terms
from furbake.surface.read.accessors import TYPES

Floats = NDArray[np.float64]
RGB = tuple[float, float, float]


def read_pelt(asset: Asset, state: int = 0) -> Pelt:
    """The pelt of one state (0: dry), with the stored bytes, λ, Ω and basis.

    Raises AssetError where the folder holds no whole pelt.
    """
    try:
        return _pelt(asset.fur, asset, state)
    except AssetError:
        raise
    except PlaneError as error:
        raise AssetError(str(error)) from error
    except (LookupError, TypeError, AttributeError, ValueError) as error:
        detail = f"{type(error).__name__}: {error}"
        raise AssetError(f"{asset.folder}: malformed pelt ({detail}), see furbake validate") from error


def body_radius(asset: Asset) -> float:
    """β of a ball as large as the model: half the longest side of its skin's box over the length of its fur."""
    try:
        node = asset.document["nodes"][asset.fur["skin"]]
        box = asset.document["accessors"][asset.primitive(asset.fur["skin"])["attributes"]["POSITION"]]
        sides = (np.array(box["max"], np.float64) - box["min"]) * node.get("scale", (1.0, 1.0, 1.0))
        full = np.iinfo(np.dtype(TYPES[box["componentType"]])).max if box.get("normalized") else 1.0
        return float(max(sides)) / full / 2.0 / float(asset.fur["length"])
    except (LookupError, TypeError, ValueError, ZeroDivisionError):
        return BODY_RADIUS


def skin_colour(asset: Asset) -> RGB:
    """Linear colour of the skin, by which the fur's own colours are multiplied; white where it has none.

    Where the shells bring colours of the skin, that is their mean.
    """
    try:
        attributes = asset.primitive(asset.fur["shells"])["attributes"]
        if "COLOR_0" in attributes:
            colours = asset.accessor(attributes["COLOR_0"])[:, :3]
            full = np.iinfo(colours.dtype).max if colours.dtype.kind == "u" else 1.0
            return _rgb(colours.mean(axis=0, dtype=np.float64) / full)
        material = asset.document["materials"][asset.primitive(asset.fur["skin"])["material"]]
        return _rgb(material["pbrMetallicRoughness"]["baseColorFactor"][:3])
    except (LookupError, TypeError, ValueError):  # as AssetError is
        return 1.0, 1.0, 1.0


def _pelt(fur: dict[str, Any], asset: Asset, index: int) -> Pelt:
    stored, layers, size, count = fur["pelts"][index], fur["layers"], fur["size"], fur["coefficients"]
    images = _images(stored, asset)
    for image in (*images.coefficients, images.colour, images.direction):
        if image is not None and image.shape[:2] != (layers * size, size):
            got = " x ".join(str(side) for side in image.shape[1::-1])
            raise AssetError(f"{asset.folder}: a plane is {got}, expected {size} x {layers * size}")
    texels = unpack(images, count)
    ramp, state = fur["ramp"], _state(stored, fur)
    drift, curves = _array(fur["drift"], layers, 2), None
    if "curves" in fur:
        many = len(fur["curves"]["even"]), len(RADII), KNOTS
        even, along = (_array(fur["curves"][name], *many) for name in ("even", "along"))
        curves = Curves(even, along, lean_direction(drift[-1]))
    return Pelt(
        **_of_texels(texels, stored),
        basis=_basis(fur["basis"], count),
        drift=drift,
        height=float(fur["height"]) * state.length,
        ramp=Ramp(_rgb(ramp["root"]), _rgb(ramp["tip"]), _rgb(ramp["tip2"]), float(ramp["power"])),
        fin=_fin(stored["fin"], asset) if "fin" in stored else None,
        direction=texels.direction,
        bent=_array(fur["bent"], 3, 8) if "bent" in fur else None,
        eye=_law(fur, "eye"),
        fin_eye=_law(fur, "finEye"),
        surge=_array(fur["surge"], 3) if "surge" in fur else None,
        short=_array(fur["short"], 3) if "short" in fur else None,
        spread=float(fur["spread"]) if "spread" in fur else None,
        open=float(fur.get("open", 0)),
        curves=curves,
        weights=None if curves is None else _array(stored["weights"], layers, curves.count),
        multiple=_multiple(stored["multiple"], layers) if "multiple" in stored else None,
        state=state,
    )


def _basis(stored: dict[str, Any], count: int) -> Basis:
    """The basis of `count` coefficients per texel."""
    if stored["kind"] == "ptm":
        return PTM
    if stored["kind"] != "eigen":
        raise AssetError(f"model.gltf: basis {stored['kind']!r}, expected ptm or eigen")
    degree = int(stored["degree"])
    return Basis("eigen", degree, _array(stored["matrix"], count, smooth_terms(degree)))


def _multiple(stored: dict[str, Any], layers: int) -> Multiple:
    """Light that has met several hairs."""
    return Multiple(
        albedo=float(stored["albedo"]),
        shares=_array(stored["shares"], layers, 3),
        ratio=_array(stored["ratio"], layers),
        seen=_array(stored["seen"], layers),
        tint=_array(stored["tint"], layers),
        colour=_array(stored["colour"], layers, 3) if "colour" in stored else None,
    )


def _state(stored: dict[str, Any], fur: dict[str, Any]) -> PeltState:
    """State of a pelt; a missing number is that of dry and clean fur."""
    values: dict[str, Any] = {name: float(stored[name]) for name in STATE if name in stored}
    mud = _rgb(fur["mud"]) if values.get("dirt") else None
    return PeltState(name=stored["name"], mud=mud, **values)


def _fin(stored: dict[str, Any], asset: Asset) -> FinPelt:
    images = _images(stored, asset)
    texels = unpack_fin(images)
    if texels.alpha.shape != (stored["height"], stored["width"]):
        got = " x ".join(str(side) for side in texels.alpha.shape[::-1])
        raise AssetError(f"{asset.folder}: a fin is {got}, expected {stored['width']} x {stored['height']}")
    return FinPelt(**_of_texels(texels, stored))


def _of_texels(texels: Texels, stored: dict[str, Any]) -> dict[str, Any]:
    """Fields that a pelt and a fin have alike."""
    count = texels.codes.shape[-1]
    named = {name: getattr(texels, name) for name in ("codes", "alpha", "tint", "colour")}
    return named | {name: _array(stored[name], count) for name in ("scale", "bias")}


def _images(stored: dict[str, Any], asset: Asset) -> Planes:
    """The planes of a state, or of its fin."""
    colour, direction = (asset.image(stored[role]) if role in stored else None for role in ("colour", "direction"))
    return Planes(tuple(asset.image(index) for index in stored["planes"]), colour, direction)


def _law(fur: dict[str, Any], name: str) -> Floats | None:
    """Weights (3, 16) of a law of light and eye, where the fur has it; the last terms may be missing."""
    if name not in fur:
        return None
    rows = _array(fur[name], 3, len(fur[name][0]))
    return np.pad(rows, [(0, 0), (0, TERMS - rows.shape[1])])


def _array(values: Any, *shape: int) -> Floats:
    array = np.array(values, np.float64)
    if array.shape != shape:
        raise ValueError(f"got numbers of shape {array.shape}, expected {shape}")
    if not np.isfinite(array).all():
        raise ValueError("got NaN or infinity, expected numbers")
    return array


def _rgb(values: Any) -> RGB:
    red, green, blue = (float(value) for value in values)
    return red, green, blue
