"""Divide chosen triangles at the middle of their longest edge, and with them what keeps the mesh without gaps."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from furbake.surface.repair.topology import half_edges
from furbake.surface.soup import Flags, Floats, Ints


@dataclass(frozen=True)
class Pieces:
    """Triangles, each within a face of the surface that is divided.

    vertices : (V, 3); faces : (F, 3)
    parent : (F,) face of the surface; shares : (F, 3, 3) barycentric coordinates of each corner there
    """

    vertices: Floats
    faces: Ints
    parent: Ints
    shares: Floats

    def carried(self, corners: Floats) -> Floats:
        """(F, 3, n) of numbers at the corners of the surface, (F₀, 3, n)."""
        return np.asarray(np.einsum("fij,fjn->fin", self.shares, corners[self.parent]))


def whole(vertices: Floats, faces: Ints) -> Pieces:
    """A surface that is not divided yet."""
    return Pieces(vertices, faces, np.arange(len(faces)), np.tile(np.eye(3), (len(faces), 1, 1)))


def bisect(pieces: Pieces, chosen: Flags) -> Pieces:
    """The `chosen` triangles halved, and their neighbours halved until no vertex lies on an edge (Rivara 1984).

    Every triangle is cut through its longest edge first, so that none becomes slimmer than half its least angle.
    """
    faces, count = pieces.faces, len(pieces.vertices)
    order, where, uses = half_edges(faces)
    half = np.empty(faces.size, np.int64)
    half[order] = np.repeat(np.arange(len(where)), uses)
    edge = half.reshape(-1, 3)
    ends = np.sort(np.stack([faces.reshape(-1), np.roll(faces, -1, axis=1).reshape(-1)], axis=1)[order[where]], axis=1)
    one, two = pieces.vertices[ends[:, 0]], pieces.vertices[ends[:, 1]]
    rank = np.argsort(np.argsort(np.linalg.norm(two - one, axis=1), kind="stable"))  # without ties
    first = np.argmax(rank[edge], axis=1)
    longest = edge[np.arange(len(edge)), first]
    cut = np.zeros(len(where), bool)
    cut[longest[chosen]] = True
    while (behind := cut[edge].any(axis=1) & ~cut[longest]).any():
        cut[longest[behind]] = True

    middle = np.full(len(where), -1)
    middle[cut] = count + np.arange(int(cut.sum()))
    turn = (first[:, None] + np.arange(3)) % 3
    faces, edge = np.take_along_axis(faces, turn, 1), np.take_along_axis(edge, turn, 1)
    shares = np.take_along_axis(pieces.shares, turn[:, :, None], 1)
    # Corners 0 to 2, then the middles of the sides after them.
    corners = np.concatenate([faces, middle[edge]], axis=1)
    shares = np.concatenate([shares, (shares + np.roll(shares, -1, axis=1)) / 2], axis=1)
    halved, after, before = cut[edge].T
    parts = [
        (~halved, (0, 1, 2)),
        (halved & ~before, (0, 3, 2)),
        (halved & before, (0, 3, 5)),
        (halved & before, (5, 3, 2)),
        (halved & ~after, (3, 1, 2)),
        (halved & after, (3, 1, 4)),
        (halved & after, (3, 4, 2)),
    ]
    return Pieces(
        vertices=np.concatenate([pieces.vertices, (one + two)[cut] / 2]),
        faces=np.concatenate([corners[which][:, three] for which, three in parts]),
        parent=np.concatenate([pieces.parent[which] for which, _ in parts]),
        shares=np.concatenate([shares[which][:, three] for which, three in parts]),
    )
