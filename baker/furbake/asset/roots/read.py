"""The picture of the roots of a baked folder, read back."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from furbake.asset.read import Asset, AssetError, inside
from furbake.surface.colours import LINEAR, Bytes, decode, sample_picture
from furbake.surface.files import read_regular
from furbake.surface.limits import Budget
from furbake.surface.material import CLAMP, Picture

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class StoredRoots:
    """Colours of the skin at the roots: (height, width, 3) sRGB bytes, and (2,) coordinates of the picture per tile."""

    pixels: Bytes
    scale: Floats

    def colours(self, uv: Floats) -> Floats:
        """(n, 3) linear colours at (n, 2) places of the shells, tiles."""
        return sample_picture(self.pixels, uv * self.scale, (CLAMP, CLAMP), LINEAR)


def read_roots(asset: Asset) -> StoredRoots | None:
    """The picture of a folder; None where hairs have the colours of the vertices. Raises AssetError."""
    if "roots" not in asset.fur:
        return None
    return StoredRoots(picture(asset), np.array(asset.fur["roots"]["scale"], np.float64))


def picture(asset: Asset) -> Bytes:
    """(height, width, 3) sRGB bytes of the picture. Raises AssetError where there is none."""
    uri = "roots"
    try:
        texture = asset.document["textures"][asset.fur["roots"]["texture"]]
        uri = asset.document["images"][texture["source"]]["uri"]
        data = read_regular(inside(asset.folder, uri), Budget(uri, "bytes"))
    except (LookupError, TypeError) as error:
        raise AssetError(f"roots: no texture ({type(error).__name__}: {error}), expected one with a picture") from error
    except OSError as error:
        raise AssetError(f"{uri}: {(error.strerror or 'cannot be read').lower()}, expected a picture") from error
    pixels = decode(Picture(data, ""))
    if pixels is None:
        raise AssetError(f"{uri}: cannot be read as a picture, expected PNG or JPEG of the roots")
    return pixels[..., :3]
