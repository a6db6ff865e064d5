"""The picture of a fur's roots: the skin's own colours, laid out by the shells' texture coordinates."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np
from scipy.ndimage import distance_transform_edt

from furbake.cores import cores
from furbake.surface.charts import Charts
from furbake.surface.colours import Bytes, smaller, srgb_bytes
from furbake.surface.material import Picture
from furbake.surface.mesh import Surface
from furbake.surface.roots.beyond import unfolded
from furbake.surface.roots.layout import Layout, laid_out
from furbake.surface.roots.look import BaseColours, Points, nearest_on_skin, on_skin
from furbake.surface.roots.raster import drawn
from furbake.surface.soup import Flags, Floats, Ints

LONGEST = 1024
"""Texels of the picture's longer side, at most."""

WITHIN = 2
"""Points along each side of a texel whose colours are averaged."""


@dataclass(frozen=True)
class Roots:
    """Colours of a skin where the hairs have their roots.

    picture : PNG or JPEG, sRGB
    uv : (M, 2) texture coordinates of the shells, tiles, no two patches over each other
    scale : (2,) coordinates of the picture per tile
    """

    picture: Picture
    uv: Floats
    scale: Floats


def picture_of_roots(skin: Surface, ground: Surface, charts: Charts, drift: Floats, finest: int) -> Roots:
    """Roots of a ground that is the skin or a simpler copy of it.

    drift : (2,) displacement of the tips from their roots, tiles; finest : texels per tile that are of use
    """
    layout = laid_out(charts, drift)
    far = np.maximum(layout.uv, layout.uv - drift).max(axis=0)
    density = min(float(finest), (LONGEST - 1) / float(far.max()))
    width, height = (int(np.ceil(side * density - 1e-6)) + 1 for side in far)
    pixels = _drawn(skin, ground, charts, layout, (height, width), density)
    return Roots(smaller(pixels), layout.uv, density / np.array([width, height]))


def _drawn(
    skin: Surface, ground: Surface, charts: Charts, layout: Layout, shape: tuple[int, int], density: float
) -> Bytes:
    """(height, width, 3) sRGB bytes; density : texels per tile."""
    around = unfolded(ground.vertices, ground.faces, charts, layout)
    corners = np.concatenate([charts.source[charts.faces], around.corners])
    triangles = np.concatenate([layout.uv[charts.faces], around.triangles]) * density
    patch = np.concatenate([layout.patch[charts.faces[:, 0]], around.patch])
    face, row, column, shares = _nearest(triangles, patch, layout, shape, density)
    same = on_skin(skin, corners) if ground is skin else None
    colours_of, steps = BaseColours(skin), (np.arange(WITHIN) + 0.5) / WITHIN - 0.5
    shown = np.unique(face)

    def seen(aside: tuple[float, float]) -> Floats:
        """Colours beside the middle, but never beyond the face: there may be another part of the model's picture."""
        change = np.zeros((len(triangles), 3))
        change[shown] = _change(triangles[shown], aside)
        held = np.clip(shares + change[face], 0.0, 1.0)
        held /= held.sum(axis=1, keepdims=True)
        if same is None:
            points = nearest_on_skin(skin, np.einsum("nc,nck->nk", held, ground.vertices[corners[face]]))
        else:
            points = Points(same[0][face], np.take_along_axis(held, same[1][face], axis=1))
        return colours_of.at(points)

    with ThreadPoolExecutor(cores()) as workers:
        total = sum(workers.map(seen, [(x, y) for x in steps for y in steps]))
    colours = np.zeros((*shape, 3))
    colours[row, column] = total / WITHIN**2
    known = np.zeros(shape, dtype=bool)
    known[row, column] = True
    return srgb_bytes(_filled(colours, known, density))


def _nearest(
    triangles: Floats, patch: Ints, layout: Layout, shape: tuple[int, int], density: float
) -> tuple[Ints, Ints, Ints, Floats]:
    """Face, row, column and shares of the corners of every texel: of the first of its patch's triangles (n, 3, 2)."""
    parts = list(drawn(triangles, shape))
    face, row, column, shares = (np.concatenate(found) for found in zip(*parts, strict=True))
    at = np.column_stack([column + 0.5, row + 0.5]) / density
    mine = np.flatnonzero(layout.owner_at(at) == patch[face])
    _, first = np.unique((row * shape[1] + column)[mine], return_index=True)
    kept = mine[first]
    return face[kept], row[kept], column[kept], shares[kept]


def _change(corners: Floats, aside: tuple[float, float]) -> Floats:
    """(n, 3) how the shares of the corners of (n, 3, 2) triangles change on the way `aside`."""
    one, two = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    area = one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]
    second = (aside[0] * two[:, 1] - aside[1] * two[:, 0]) / area
    third = (one[:, 0] * aside[1] - one[:, 1] * aside[0]) / area
    return np.stack([-second - third, second, third], axis=1)


def _filled(colours: Floats, known: Flags, density: float) -> Floats:
    """The picture with the nearest known colour around its patches, and the mean of all far off."""
    far, (row, column) = distance_transform_edt(~known, return_indices=True)
    mean = colours[known].mean(axis=0)
    return np.asarray(np.where((far < density)[..., None], colours[row, column], mean))
