"""The model's own texture coordinates as charts, for `--uv own`.

They are laid for pictures, not for fur: each island is brought to the size of the tile, mirrored parts are turned over,
and faces without coordinates are projected. Hair leans down the model's picture.
"""

from __future__ import annotations

import numpy as np

from furbake.surface.charts import Charts
from furbake.surface.lay.guide import AXES, frames
from furbake.surface.mesh import MeshError, Surface
from furbake.surface.repair.seams import SAME, islands, unique_rows
from furbake.surface.repair.topology import face_vectors, unit
from furbake.surface.soup import Flags, Floats, Ints, Soup

SQUEEZED = 1e-3
"""Smaller over larger stretch of a face below which its coordinates say nothing."""


def own_charts(surface: Surface, tile: float, name: str) -> Charts:
    """Charts of the model's own texture coordinates, tiles about `tile` model units wide over each island.

    The natural ones of a built-in shape. Raises MeshError, starting with `name`, where the model has none.
    """
    if surface.natural is not None:
        return surface.natural.charts(tile)
    if surface.uv is None:
        raise MeshError(f"{name}: the model has no texture coordinates, expected some for its own (or lapped ones)")
    uv, kind = _upright(surface, surface.uv)
    soup = Soup(surface.vertices, surface.faces, kind, uv)
    island = islands(soup)
    uv = uv * _tiles(soup, island)[island][:, None, None] / tile
    # By whole tiles, so that the numbers stay small.
    low = np.full((island.max() + 1, 2), np.inf)
    np.minimum.at(low, island, uv.min(axis=1))
    uv = uv - np.floor(low)[island][:, None]

    flat = uv.reshape(-1, 2)
    corners = surface.faces.reshape(-1)
    rounded = np.rint(flat / max(SAME, 1e-9 * float(np.abs(flat).max(initial=0.0))))
    first, index = unique_rows(corners, np.repeat(island, 3), *rounded.T)
    source, faces = corners[first], index.reshape(-1, 3)
    return Charts(
        source=source,
        faces=faces,
        tangents=_tangents(surface, uv, source, faces),
        uv=flat[first],
        weights=np.ones(len(source)),
        group=np.arange(len(source)),
    )


def _upright(surface: Surface, uv: Floats) -> tuple[Floats, Ints]:
    """(F, 3, 2) coordinates that no face mirrors, and (F,) the change: 0 none, 1 u turned, 2 to 7 projected.

    Projection is in model units onto the side of a box that the face looks to.
    """
    bent = ~_fit_for_use(surface, uv)
    mirrored = ~bent & (_areas(np.nan_to_num(uv)) < 0.0)
    turned = np.where(mirrored[:, None, None], uv * (-1.0, 1.0), uv)
    side = np.argmax(unit(face_vectors(surface.vertices, surface.faces)) @ AXES.T, axis=1)
    along_u, along_v = frames(surface, "down")
    corners = surface.vertices[surface.faces]
    laid = np.stack([np.einsum("fki,fi->fk", corners, axis[side]) for axis in (along_u, along_v)], axis=2)
    kind = np.where(bent, 2 + side, mirrored.astype(np.int64))
    return np.where(bent[:, None, None], laid, turned), kind


def _fit_for_use(surface: Surface, uv: Floats) -> Flags:
    """(F,) which faces have coordinates that span an area."""
    finite: Flags = np.asarray(np.isfinite(uv).all(axis=(1, 2)))
    safe = np.where(finite[:, None, None], uv, 0.0)
    one, two = safe[:, 1] - safe[:, 0], safe[:, 2] - safe[:, 0]
    longest = np.maximum((one**2).sum(axis=1), (two**2).sum(axis=1))
    corners = surface.vertices[surface.faces]
    sides = np.maximum(*(((corners[:, i] - corners[:, 0]) ** 2).sum(axis=1) for i in (1, 2)))
    shape = np.linalg.norm(face_vectors(surface.vertices, surface.faces), axis=1) / np.maximum(sides, 1e-300)
    return np.asarray(finite & (np.abs(_areas(safe)) > SQUEEZED * np.minimum(shape, 1.0) * longest))


def _areas(uv: Floats) -> Floats:
    """(F,) signed areas, doubled, positive where u, v turn as seen from outside."""
    one, two = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
    return np.asarray(one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0])


def _tiles(soup: Soup, island: Ints) -> Floats:
    """(islands,) model units per unit of each island's coordinates."""
    surface_area = np.bincount(island, np.linalg.norm(face_vectors(soup.vertices, soup.faces), axis=1))
    picture_area = np.bincount(island, np.abs(_areas(soup.uv if soup.uv is not None else np.zeros((0, 3, 2)))))
    return np.asarray(np.sqrt(surface_area / np.maximum(picture_area, 1e-300)))


def _tangents(surface: Surface, uv: Floats, source: Ints, faces: Ints) -> Floats:
    """(M, 4) right-handed frames whose B runs along growing v, in the tangent plane of each copy."""
    corners = surface.vertices[surface.faces]
    one, two = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    first, second = uv[:, 1, 0] - uv[:, 0, 0], uv[:, 2, 0] - uv[:, 0, 0]
    # ∂P/∂v times the (positive) area in the picture, so that large faces count more.
    down = first[:, None] * two - second[:, None] * one
    total = np.stack([np.bincount(faces.reshape(-1), np.repeat(down[:, i], 3), len(source)) for i in range(3)], axis=1)
    normals = surface.normals[source]
    flat = total - normals * np.einsum("ij,ij->i", total, normals)[:, None]
    lost = np.linalg.norm(flat, axis=1) <= 1e-9 * np.linalg.norm(total, axis=1) + 1e-300
    helper = np.where(np.abs(normals[:, 1:2]) < 0.9, [[0.0, -1.0, 0.0]], [[0.0, 0.0, -1.0]])
    other = helper - normals * np.einsum("ij,ij->i", helper, normals)[:, None]
    along_v = unit(np.where(lost[:, None], other, flat))
    return np.column_stack([unit(np.cross(along_v, normals)), np.ones(len(source))])
