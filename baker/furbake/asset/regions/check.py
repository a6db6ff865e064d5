"""Checks of several furs on one body: every place has its hairs from one of them."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from furbake.asset.extension import EXTENSION
from furbake.asset.read import Asset
from furbake.asset.regions.alone import alone
from furbake.asset.regions.parted import REGION
from furbake.asset.validate_pelts import curves, multiple, pelts, states

SAME = ("name", "wetness", "dirt")
"""Members of a state that all furs have the same."""


def regions(asset: Asset) -> Iterator[str]:
    """Bounds that rise and meet, furs whose planes can be stacked."""
    fur = asset.fur
    if "regions" not in fur:
        for name in ("shells", "fins"):
            if name in fur and REGION in asset.primitive(fur[name])["attributes"]:
                yield f"{name}: {REGION} without regions, expected both or none"
        return
    if fur["basis"]["kind"] != "ptm":
        yield f"{EXTENSION}: basis {fur['basis']['kind']} beside regions, expected ptm"
    for i, region in enumerate(fur["regions"]["furs"], 1):
        one = alone(asset, i)
        for check in (pelts, curves, multiple, states):
            yield from (f"{region['name']}: {problem}" for problem in check(one))
        yield from _stackable(fur, one.fur, region["name"])
    for name in ("shells", "fins"):
        if name in fur:
            yield from _bounds(asset, name, len(fur["regions"]["furs"]))


def _stackable(coat: dict[str, object], fur: dict[str, object], name: str) -> Iterator[str]:
    """A fur with the states and planes of the coat."""
    for key in ("eye", "finEye", "bent"):
        if (key in coat) != (key in fur):
            yield f"{name}: {'no ' if key in coat else 'an '}{key}, expected it in all furs or none"
    own, wanted = (
        [
            [pelt.get(key, 0) for key in SAME]
            + ["colour" in pelt, "fin" in pelt and (pelt["fin"]["width"], pelt["fin"]["height"])]
            for pelt in each["pelts"]  # type: ignore[attr-defined]
        ]
        for each in (fur, coat)
    )
    if own != wanted:
        yield f"{name}: pelts {own}, expected {wanted} as of the coat"


def _bounds(asset: Asset, name: str, furs: int) -> Iterator[str]:
    primitive = asset.primitive(asset.fur[name])
    attributes = primitive["attributes"]
    if REGION not in attributes:
        yield f"{name}: no {REGION}, expected it where there are regions"
        return
    region = asset.accessor(attributes[REGION])
    if region.dtype != np.uint8 or region.shape[1:] != (3,):
        yield f"{name}: {REGION} is {region.dtype} with {region.shape[1:]} components, expected 3 bytes"
        return
    if int(region[:, 2].max()) > furs:
        yield f"{name}: {REGION} names fur {region[:, 2].max()}, expected 0 to {furs}"
    if (region[:, 0] > region[:, 1]).any():
        yield f"{name}: {REGION} has bounds that fall, expected rising ones"
    if name == "shells" and len(wrong := unequal(asset)):
        yield f"shells: shares of the furs sum to {wrong[0] / 255:.3f} at {len(wrong)} corners, expected 1"


def unequal(asset: Asset) -> NDArray[np.int64]:
    """Sums of the furs' shares, in 255ths, at those corners of the shells' faces where they are not 255."""
    sums = share_sums(asset)
    return np.asarray(sums[sums != 255])


def share_sums(asset: Asset) -> NDArray[np.int64]:
    """(F, 3) sum of the shares of all furs at the corners of each face, as stored; a face of a patch counts once.

    Copies of a face are equal in the places and texture coordinates of their corners.
    """
    primitive = asset.primitive(asset.fur["shells"])
    attributes = primitive["attributes"]
    places = np.column_stack([asset.accessor(attributes[key]) for key in ("POSITION", "TEXCOORD_0")])
    region = asset.accessor(attributes[REGION]).astype(np.int64)
    _, place = np.unique(places, axis=0, return_inverse=True)
    corners = asset.accessor(primitive["indices"]).reshape(-1, 3).astype(np.int64)
    order = np.argsort(place.reshape(-1)[corners], axis=1)
    corners = np.take_along_axis(corners, order, axis=1)
    share = (region[:, 1] - region[:, 0])[corners]
    _, index = np.unique(place.reshape(-1)[corners], axis=0, return_inverse=True)
    return np.stack([np.bincount(index.reshape(-1), share[:, i]).astype(np.int64) for i in range(3)], axis=1)
