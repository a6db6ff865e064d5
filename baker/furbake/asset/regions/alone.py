"""One fur of a body with several, as if all of the body wore it."""

from __future__ import annotations

from dataclasses import replace

from furbake.asset.extension import EXTENSION
from furbake.asset.read import Asset

COAT = "coat"


def furs(asset: Asset) -> tuple[str, ...]:
    """Names of the furs of a body, the coat first; the coat alone without regions."""
    return COAT, *(region["name"] for region in asset.fur.get("regions", {"furs": []})["furs"])


def alone(asset: Asset, number: int) -> Asset:
    """The asset with the numbers and planes of one of its furs; 0: the coat. Vertices are those of all of them."""
    if number == 0 and "regions" not in asset.fur:
        return asset
    coat = {key: value for key, value in asset.fur.items() if key != "regions"}
    if number:
        own = asset.fur["regions"]["furs"][number - 1]
        for key in ("bent", "eye", "finEye", "surge", "short", "spread", "open"):
            coat.pop(key, None)
        coat |= {key: value for key, value in own.items() if key not in ("name", "tile")}
    document = asset.document | {"extensions": asset.document["extensions"] | {EXTENSION: coat}}
    return replace(asset, document=document)
