"""Fewer faces, the same shape and everything painted on it: for models that are too large, and under their fur.

Edges are collapsed by the quadric error of Garland and Heckbert 1997, as fast-simplification does it.
"""

from __future__ import annotations

import fast_simplification
import numpy as np

from furbake.surface.repair.transfer import carry
from furbake.surface.soup import Soup

TRIES = (3.0, 5.0, 8.0, 14.0)
"""Growing eagerness of the collapse (the library's own choice, 7, folds faces over): more only where less stalls."""


def decimate(soup: Soup, faces: int) -> Soup:
    """The soup with about `faces` faces, or more where it is too ragged; its numbers are carried over.

    Every number of a new corner is read off the old surface at its place, on the side of a texture seam that the
    middle of its face lies on.
    """
    low, extent = soup.vertices.min(axis=0), float(np.ptp(soup.vertices, axis=0).max())
    shape, now = (soup.vertices - low) / extent, soup.faces
    for eagerness in TRIES:
        if len(now) <= faces:
            break
        points, corners = fast_simplification.simplify(
            shape, now.astype(np.int32), target_count=int(faces), agg=eagerness
        )[:2]
        shape, now = np.asarray(points, dtype=np.float64), np.asarray(corners, dtype=np.int64).reshape(-1, 3)
    return carry(soup, shape * extent + low, now)
