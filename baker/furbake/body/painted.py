"""Numbers over a surface: from a picture, or from its own vertices."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from furbake.asset.planes import PlaneError, read_png
from furbake.options.bake_options import OF_VERTICES
from furbake.surface.mesh import MeshError, Surface
from furbake.surface.place.paint import vertex_map, vertex_numbers

Floats = NDArray[np.float64]


def painted(surface: Surface, where: str) -> Floats:
    """(V,) 0..1 of a picture over the surface, or of its own vertices: `vertex:red`, `vertex:` + attribute.

    Raises MeshError where there is none.
    """
    if where.startswith(OF_VERTICES):
        return vertex_numbers(surface, where.removeprefix(OF_VERTICES), where)
    try:
        return vertex_map(surface, read_png(Path(where)), where)
    except PlaneError as error:
        raise MeshError(str(error)) from error
