"""Automatic length: fur that leaves a body its shape, from the thickness at every vertex."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from furbake.surface.mesh import Floats, Surface
from furbake.surface.place.thickness import cone, distances
from furbake.surface.repair.topology import smoother, unit

USUAL = 0.25
"""Length over the body's thickness: a leg with fur on both sides is wider by half."""

MOST = 0.38
"""Length over the thickness that smoothing does not exceed: 0.4 with some room."""

BYTES = 255
"""Steps in which shares are stored; they are rounded down."""

TRUNK = 0.85
"""Share of the skin that is thinner than the part whose fur is the longest."""

ROUNDS = 3
"""Rounds of smoothing over the mesh."""

RAYS, CONE = 5, np.pi / 4
"""Into the body below a face: one straight, the others CONE (radians) off. Half of them: the end of a limb is thin."""

NEIGHBOURS, ASIDE = 3, 0.01
"""The same straight below a place: one alone may slip through between two triangles."""

INSIDE = 2e-5
"""Start of a ray below the skin, extents. A body thinner than twice that is taken as a sheet."""


@dataclass(frozen=True)
class Fitted:
    """Model units; infinite where no body is behind the skin.

    longest : fur of the trunk
    lengths, most : (V,) float, usual length at each vertex, and the bound that it keeps
    """

    longest: float
    lengths: Floats
    most: Floats

    def shares(self, length: float, usual: float) -> Floats:
        """(V,) float, 0..1: share of `length` at each vertex, where `usual` is the length that fits the trunk.

        A `length` above it makes the fur longer everywhere, in proportion; at most `usual` stays within the bound.
        """
        fitting = np.minimum(self.lengths, usual)
        if length > usual:
            return np.asarray(np.minimum(fitting / usual, 1.0))
        shares = np.minimum(np.minimum(fitting, self.most) / length, 1.0)
        return np.asarray(np.floor(BYTES * shares + 1e-6) / BYTES)


def fitted(surface: Surface) -> Fitted:
    """Lengths that leave a body its shape. The unit doesn't matter; a sheet, open behind, bounds no length."""
    corners = surface.vertices[surface.faces]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = np.linalg.norm(across, axis=1)
    middles, outward = corners.mean(axis=1), unit(across)
    around = np.median(_far(surface, middles, outward, RAYS, CONE), axis=1)
    at_faces = np.minimum(through(surface, middles, outward), around)
    thick = through(surface, surface.vertices, surface.normals)
    np.minimum.at(thick, surface.faces.reshape(-1), np.repeat(at_faces, 3))
    smooth = np.minimum(thick, surface.extent)
    average = smoother(len(thick), surface.faces)
    for _ in range(ROUNDS):
        smooth = average @ smooth
    order = np.argsort(at_faces)
    reached = np.searchsorted(np.cumsum(areas[order]), TRUNK * areas.sum())
    longest = USUAL * float(at_faces[order][min(reached, len(order) - 1)])
    return Fitted(longest, USUAL * smooth, MOST * thick)


def through(surface: Surface, places: Floats, outward: Floats) -> Floats:
    """(n,) thickness straight below each place; infinite where no body is there."""
    return np.asarray(_far(surface, places, outward, NEIGHBOURS, ASIDE).min(axis=1))


def _far(surface: Surface, places: Floats, outward: Floats, rays: int, angle: float) -> Floats:
    """(n, rays) distances through the body along a cone into it."""
    start = INSIDE * surface.extent
    inward = cone(-outward, rays, angle)
    starts = np.broadcast_to((places - start * outward)[:, None], inward.shape)
    far = distances(surface, starts.reshape(-1, 3), inward.reshape(-1, 3)).reshape(-1, rays)
    return np.where(np.isfinite(far) & (far > start), far, np.inf)
