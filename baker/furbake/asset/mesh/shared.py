"""A skin without vertices and faces of its own: it has those of the shells, of whose faces the first are its own."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from furbake.asset.mesh.buffer import Buffer, Record
from furbake.asset.mesh.edges import turned
from furbake.asset.mesh.vertices import shares
from furbake.surface.charts import Charts

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

COMMON = ("POSITION", "NORMAL", "JOINTS_0", "WEIGHTS_0")
"""Attributes that are the same in skin and shells."""


def skin_first(charts: Charts, faces: Ints) -> Charts | None:
    """The charts with one copy of each face of the skin before all others; None where the skin has further faces.

    faces : (F, 3) of the skin, into the vertices of which the charts' are copies
    """
    copies, first = np.unique(turned(charts.source[charts.faces]), axis=0, return_index=True)
    own = np.unique(turned(faces), axis=0)
    if len(own) != len(faces) or not np.array_equal(copies, own):
        return None
    order = np.argsort(~np.isin(np.arange(len(charts.faces)), first), kind="stable")
    return replace(charts, faces=charts.faces[order])


def shared_primitive(shells: Record, source: Ints, faces: int, colours: Floats | None, buffer: Buffer) -> Record:
    """A primitive of the skin with the shells' vertices and the first of their faces.

    shells : their primitive; source : (M,) vertices of the skin that theirs are copies of
    faces : number of the skin's; colours : (V, 3) linear, of its vertices; None: it has none
    """
    attributes = {name: shells["attributes"][name] for name in COMMON if name in shells["attributes"]}
    if colours is not None:
        attributes["COLOR_0"] = buffer.attribute(shares(colours[source]))
    return {"attributes": attributes, "indices": buffer.first(shells["indices"], 3 * faces)}
