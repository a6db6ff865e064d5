"""Undo folds of flat polygons: readers cut a polygon into a fan, which lies over itself where the polygon is hollow."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from furbake.surface.repair.slivers import first_claim
from furbake.surface.repair.topology import face_vectors, half_edges, unit
from furbake.surface.soup import Floats, Ints, Soup

FOLDED = -0.999
"""Cosine between two faces that lie on each other."""

LESS = 0.999
"""Area after over area before a flip, at most."""

ROUNDS = 16
"""Each one unfolds what does not touch; a fan of many corners takes several."""


def flip_folds(soup: Soup) -> tuple[Soup, int]:
    """Oriented faces with edges flipped where two lie on each other and would lie beside each other, and how many.

    The result may have faces without area.
    """
    undone = 0
    for _ in range(ROUNDS):
        soup, flipped = _round(soup)
        undone += flipped
        if not flipped:
            break
    return soup, undone


def _round(soup: Soup) -> tuple[Soup, int]:
    vertices, faces = soup.vertices, soup.faces
    vectors = face_vectors(vertices, faces)
    normals, areas = unit(vectors), np.linalg.norm(vectors, axis=1)
    order, where, uses = half_edges(faces)
    one, other = order[where[uses == 2]], order[where[uses == 2] + 1]
    lying = np.einsum("ij,ij->i", normals[one // 3], normals[other // 3]) < FOLDED
    one, other = one[lying], other[lying]
    if not len(one):
        return soup, 0
    a, i, b, j = one // 3, one % 3, other // 3, other % 3
    p, q, apex = (faces[a, (i + k) % 3] for k in range(3))
    beyond = faces[b, (j + 2) % 3]
    first, second = np.stack([apex, p, beyond], axis=1), np.stack([beyond, q, apex], axis=1)
    before = areas[a] + areas[b]
    up = np.where((areas[a] > areas[b])[:, None], normals[a], normals[b])
    laid = np.stack([np.einsum("ij,ij->i", face_vectors(vertices, half), up) for half in (first, second)], axis=1)
    fine = (laid > -1e-9 * before[:, None]).all(axis=1) & (laid.sum(axis=1) < LESS * before) & (apex != beyond)
    fine &= faces[b, j] == q  # they run against each other along the edge, as neighbours do
    free = np.zeros_like(fine)
    free[fine] = first_claim(np.stack([a, b], axis=1)[fine], len(faces))
    a, i, b, j, first, second = (values[free] for values in (a, i, b, j, first, second))
    return _flipped(soup, (a, i), (b, j), first, second), int(free.sum())


def _flipped(soup: Soup, mine: tuple[Ints, Ints], theirs: tuple[Ints, Ints], first: Ints, second: Ints) -> Soup:
    """Both faces across their other diagonal; the corners keep what hangs on them."""
    (a, i), (b, j) = mine, theirs

    def moved(values: Floats) -> Floats:
        p, q, apex = (values[a, (i + k) % 3] for k in range(3))
        beyond = values[b, (j + 2) % 3]
        result = values.copy()
        result[a], result[b] = np.stack([apex, p, beyond], axis=1), np.stack([beyond, q, apex], axis=1)
        return result

    faces = soup.faces.copy()
    faces[a], faces[b] = first, second
    return replace(
        soup,
        faces=faces,
        uv=None if soup.uv is None else moved(soup.uv),
        paint=None if soup.paint is None else moved(soup.paint),
        attributes={name: moved(values) for name, values in soup.attributes.items()},
    )
