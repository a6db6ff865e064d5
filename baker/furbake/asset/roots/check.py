"""Checks of the picture of the roots."""

from __future__ import annotations

from collections.abc import Iterator

from furbake.asset.read import Asset
from furbake.asset.roots.read import picture


def roots(asset: Asset) -> Iterator[str]:
    """The picture is there, shells have colours besides, and stored fins have places in it."""
    if "roots" not in asset.fur:
        return
    if tuple(int(part) for part in asset.fur["version"].split(".")) < (2, 3):
        yield f"roots: a picture in version {asset.fur['version']}, expected 2.3"
    picture(asset)
    for name, attribute in (("shells", "COLOR_0"), ("fins", "TEXCOORD_1")):
        if name in asset.fur and attribute not in asset.primitive(asset.fur[name])["attributes"]:
            yield f"{name}: no {attribute} beside a picture of the roots, expected one"
