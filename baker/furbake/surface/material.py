"""Materials of the skin under the fur, as glTF has them, and the pieces that they cover."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from furbake.surface.repair.seams import unique_rows
from furbake.surface.soup import Floats, Ints, Soup

REPEAT, CLAMP, MIRROR = 10497, 33071, 33648
"""glTF's wrapping of a texture beyond 0..1."""


@dataclass(frozen=True)
class Picture:
    """An image file as it came with the model: its bytes and its media type, image/png, image/jpeg or image/webp."""

    data: bytes
    kind: str


@dataclass(frozen=True)
class Material:
    """The part of a glTF material that shows on skin.

    factor : linear base colour and alpha
    picture : image of the base colour, sRGB, if there is one
    wrap : how it repeats along u and v
    alpha : OPAQUE, MASK or BLEND, and the cutoff of MASK
    """

    name: str = ""
    factor: tuple[float, float, float, float] = (1.0, 1.0, 1.0, 1.0)
    metallic: float = 0.0
    roughness: float = 1.0
    double_sided: bool = False
    alpha: str = "OPAQUE"
    cutoff: float = 0.5
    picture: Picture | None = None
    wrap: tuple[int, int] = (REPEAT, REPEAT)


@dataclass(frozen=True)
class Skin:
    """The piece of a surface that one material covers, ready to be a glTF primitive.

    source : (M,) int, vertex of the surface that each vertex here copies (place and normal come from there)
    faces : (F', 3) int, into the copies, wound as the surface's
    uv : (M, 2) float, TEXCOORD_0 of the picture; None where the material has no picture or the file no coordinates
    colour : (M, 4) float, linear COLOR_0; None where the model has no vertex colours
    """

    material: Material
    source: Ints
    faces: Ints
    uv: Floats | None = None
    colour: Floats | None = None


def dress(soup: Soup, materials: tuple[Material, ...]) -> tuple[Skin, ...]:
    """The skin of a repaired soup, one piece per material that is in use."""
    pieces = []
    for i, mine in soup.pieces():
        material = materials[i]
        textured = mine.uv is not None and material.picture is not None and bool(np.isfinite(mine.uv).any())
        uv = np.nan_to_num(mine.uv.reshape(-1, 2), posinf=0.0, neginf=0.0) if textured and mine.uv is not None else None
        painted = mine.paint is not None and bool((mine.paint != 1.0).any())
        colour = mine.paint.reshape(-1, 4) if painted and mine.paint is not None else None
        corners = mine.faces.reshape(-1)
        columns = [corners, *([] if uv is None else uv.T), *([] if colour is None else colour.T)]
        first, index = unique_rows(*columns)
        pieces.append(
            Skin(
                material=material,
                source=corners[first],
                faces=index.reshape(-1, 3),
                uv=None if uv is None else uv[first],
                colour=None if colour is None else colour[first],
            )
        )
    return tuple(pieces)
