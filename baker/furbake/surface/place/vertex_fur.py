"""Fur from place to place: attributes on the vertices of a surface."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

FARTHEST = 0.8
"""Longest comb: beyond it the shells of a hair lie on top of each other."""


@dataclass(frozen=True)
class VertexFur:
    """Fur at each of the V vertices of a surface.

    lengths : (V,) 0..1, share of the longest fur
    occlusion : (V,) 0..1, openness to the environment: 1 sees all of it
    tip : (V,) 0..1, from the ramp's first tip colour to its second
    comb : (V, 3) displacement of the tips, share of the hair's own length; what points along the normal is left out,
        what is longer than `FARTHEST` is shortened to it
    colour : (V, 3) linear 0..1, a factor of the skin's base colour, or None
    own : (V, 3) linear 0..1, a factor of the hairs' colours that takes the place of the skin's, or None
    """

    lengths: Floats
    occlusion: Floats
    tip: Floats
    comb: Floats
    colour: Floats | None = None
    own: Floats | None = None

    @classmethod
    def even(cls, vertices: int) -> VertexFur:
        """Full length, open, of the first tip colour, uncombed."""
        return cls(np.ones(vertices), np.ones(vertices), np.zeros(vertices), np.zeros((vertices, 3)))


def tangential(comb: Floats, normals: Floats) -> Floats:
    """(n, 3) comb without its part along the unit normals, at most `FARTHEST` long."""
    flat = comb - normals * np.einsum("ij,ij->i", comb, normals)[:, None]
    length = np.linalg.norm(flat, axis=1, keepdims=True)
    return np.asarray(flat * np.minimum(1.0, FARTHEST / np.maximum(length, 1e-12)))
