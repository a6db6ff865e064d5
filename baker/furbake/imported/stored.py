"""The tile's own strands in a baked folder, where they are an artist's and no options grow them again."""

from __future__ import annotations

from pathlib import Path
from zipfile import BadZipFile

import numpy as np

from furbake.asset.read import Asset, AssetError, inside
from furbake.pelt.hairs.strands import Coat, Strands, grow

PARTS = ("points", "radius", "tint", "hue")


def write_strands(folder: Path, strands: Strands, fur: int = 0) -> dict[str, int]:
    """Write the strands of the tile of a fur, 0: the coat, into a folder; bytes of the file by its name."""
    name = _name(fur)
    out = folder / name
    np.savez_compressed(out, **{name: getattr(strands, name).astype(np.float32) for name in PARTS})
    return {name: out.stat().st_size}


def tile_strands(asset: Asset, coat: Coat, height: float, seed: int, fur: int = 0) -> Strands:
    """The strands of a baked tile: those in the folder, else grown anew. Raises AssetError where they are broken.

    coat, height, seed : of the fur, 0: the coat
    """
    name = _name(fur)
    if not asset.record.get("options", {}).get("groom"):
        return grow(coat, height, seed)
    try:
        with np.load(inside(asset.folder, name), allow_pickle=False) as archive:
            parts = [archive[part].astype(np.float64) for part in PARTS]
    except (OSError, ValueError, LookupError, EOFError, BadZipFile) as error:
        raise AssetError(f"{asset.folder}: {name} cannot be read ({error}), bake the groom again") from None
    shape = parts[1].shape
    whole = parts[0].shape == (*shape, 3) and len(shape) == 2 and all(part.shape == shape for part in parts[1:])
    if not whole or not all(np.isfinite(part).all() for part in parts):
        raise AssetError(f"{asset.folder}: {name} holds no strands, bake the groom again")
    return Strands(*parts)


def _name(fur: int) -> str:
    return f"strands-{fur}.npz" if fur else "strands.npz"
