"""Morph targets: displacements of places, normals and tangents as glTF stores them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np
from numpy.typing import NDArray

from furbake.asset.mesh.buffer import Buffer
from furbake.surface.charts import Charts
from furbake.surface.mesh import Surface
from furbake.surface.place.fins import Fins
from furbake.surface.repair.topology import angle_normals, unit
from furbake.surface.rig.rig import Floats, Ints

Record = dict[str, int]

BYTE, SHORT = 127, 32767


def targets(
    buffer: Buffer, places: Iterable[Floats], normals: Iterable[Floats], tangents: Iterable[Floats | None]
) -> list[Record]:
    """A primitive's targets, from (M, 3) displacements by each of them at 1.

    places : in units of their grid; tangents : None where the primitive has none
    """
    found = []
    for place, normal, tangent in zip(places, normals, tangents, strict=True):
        target = {
            "POSITION": buffer.displacements(quantised(place, SHORT), bounds=True),
            "NORMAL": buffer.displacements(quantised(normal, BYTE)),
        }
        if tangent is not None:
            target["TANGENT"] = buffer.displacements(quantised(tangent, BYTE))
        found.append(target)
    return found


def displaced_normals(surface: Surface, deltas: Floats) -> Floats:
    """(T, V, 3) normals of the surface with each target at 1, minus those without."""
    still = angle_normals(surface.vertices, surface.faces)
    turned = [angle_normals(surface.vertices + delta, surface.faces) - still for delta in deltas]
    return np.array(turned).reshape(deltas.shape)


def charts_tangents(surface: Surface, charts: Charts, deltas: Floats) -> Iterator[Floats]:
    """T times (M, 3) displacements of the tangents of charts: they turn as the gradient of u does."""
    across, beside = _frame(surface.vertices, surface.faces, charts)
    x, y = (np.einsum("ij,ij->i", charts.tangents[:, :3], axis)[:, None] for axis in (across, beside))
    size = np.maximum(np.hypot(x, y), 1e-300)
    x, y = x / size, y / size
    still = x * across + y * beside
    for delta in deltas:
        across, beside = _frame(surface.vertices + delta, surface.faces, charts)
        yield x * across + y * beside - still


def fins_tangents(surface: Surface, fins: Fins, deltas: Floats) -> Iterator[Floats]:
    """T times (4E, 3) displacements of the tangents of fins: of their edges."""
    still = _edges(fins, surface.vertices)
    for delta in deltas:
        yield _edges(fins, surface.vertices + delta) - still


def quantised(values: Floats, most: int) -> NDArray[np.int8] | NDArray[np.int16] | NDArray[np.float32]:
    """Displacements as normalised integers up to `most`; as floats where any is longer than 1."""
    if not np.abs(values).max(initial=0.0) <= 1.0:
        return values.astype(np.float32)
    codes = np.rint(values * most)
    return codes.astype(np.int8) if most == BYTE else codes.astype(np.int16)


def _frame(vertices: Floats, faces: Ints, charts: Charts) -> tuple[Floats, Floats]:
    """(M, 3) unit tangents along growing u and, right-handed, beside it at the copies of charts on these faces."""
    normals = angle_normals(vertices, faces)[charts.source]
    corners, uv = vertices[charts.source[charts.faces]], charts.uv[charts.faces]
    one, two = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    rise = uv[:, 1:, 1] - uv[:, :1, 1]
    # ∂P/∂u times the (positive) area in the tile, so that large faces count more.
    along = rise[:, 1:] * one - rise[:, :1] * two
    index, count = charts.faces.reshape(-1), len(charts.source)
    total = np.stack([np.bincount(index, np.repeat(axis, 3), count) for axis in along.T], axis=1)
    along = unit(total - normals * np.einsum("ij,ij->i", total, normals)[:, None])
    return along, np.cross(normals, along)


def _edges(fins: Fins, vertices: Floats) -> Floats:
    """(4E, 3) unit directions of the edges, first end to second."""
    ends = vertices[fins.source.reshape(-1, 4)[:, :2]]
    return np.repeat(unit(ends[:, 1] - ends[:, 0]), 4, axis=0)
