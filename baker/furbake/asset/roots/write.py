"""The picture of the hairs' roots as a texture of glTF, and the places in it of stored fins."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from furbake.asset.mesh.buffer import numbers
from furbake.asset.mesh.edges import shell_edges
from furbake.asset.mesh.vertices import Attributes, deep_shares
from furbake.asset.skin import Looks
from furbake.surface.charts import Charts
from furbake.surface.material import CLAMP
from furbake.surface.place.fins import Fins
from furbake.surface.roots.picture import Roots


def roots_record(roots: Roots | None, looks: Looks) -> dict[str, Any] | None:
    """The extension's object of the picture, which becomes a texture of the document; None where there is none."""
    if roots is None:
        return None
    return {"texture": looks.texture(roots.picture, (CLAMP, CLAMP), "roots"), "scale": numbers(roots.scale)}


def fin_roots(charts: Charts, fins: Fins, roots: Roots | None) -> Attributes:
    """TEXCOORD_1 of the fins: where in the picture both ends of their edges are, in one patch; none without one."""
    if roots is None:
        return {}
    places = roots.uv * roots.scale
    count = int(max(charts.source.max(), fins.source.max())) + 1
    ends, _ = shell_edges(charts.faces, charts.source[:, None])
    edges, first = np.unique(_keys(charts.source[ends], count), return_index=True)
    root = fins.source.reshape(-1, 4)[:, :2]
    found = ends[first[np.searchsorted(edges, _keys(root, count))]]
    two = np.where((charts.source[found[:, :1]] != root[:, :1]), found[:, ::-1], found)
    return {"TEXCOORD_1": deep_shares(np.clip(places[np.tile(two, 2)].reshape(-1, 2), 0.0, 1.0))}


def _keys(ends: NDArray[np.int64], count: int) -> NDArray[np.int64]:
    """(E,) a number per edge of two vertices out of `count`, whichever comes first."""
    return np.asarray(np.sort(ends, axis=1) @ np.array([count, 1]), dtype=np.int64)
