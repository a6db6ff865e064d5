"""Writes the rabbit: the bunny of @pmndrs/assets (CC0), its ears thinned to leaves and divided finer, its face, ears
and paws marked for shorter fur.

baker/.venv/bin/python baker/models/bunny/make.py bunny.glb baker/models/bunny/bunny.glb
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import trimesh
from numpy.typing import NDArray

from furbake.surface.mesh import load_mesh

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Mask = NDArray[np.bool_]

THICKNESS = 0.6
"""Thickness of an ear over that of the mesh."""

REACH = 0.3
"""Distance from the axis of an ear within which its vertices lie."""

NARROW = 0.3
"""Share of its width that an ear loses towards its end."""

SMOOTH = 6
"""Rounds of smoothing."""


@dataclass(frozen=True)
class Ear:
    """An ear: axis from `root` to `tip`, model units; `thin` points out of its inner side."""

    root: tuple[float, float, float]
    tip: tuple[float, float, float]
    thin: tuple[float, float, float]

    @property
    def axes(self) -> Floats:
        """(3, 3) rows along, across and thin."""
        along = np.subtract(self.tip, self.root)
        along /= np.linalg.norm(along)
        thin = np.array(self.thin) - along * np.dot(self.thin, along)
        thin /= np.linalg.norm(thin)
        return np.stack([along, np.cross(thin, along), thin])

    def place(self, vertices: Floats) -> Floats:
        """(V, 3) coordinates along (model units from the root), across and thin."""
        return np.asarray((vertices - self.root) @ self.axes.T)

    def holds(self, vertices: Floats, start: float) -> Mask:
        """(V,) whether a vertex is of the ear, `start` or more from its root."""
        t, u, w = self.place(vertices).T
        return np.asarray((t > start) & (np.hypot(u, w) < REACH))


EARS = (
    Ear((-0.41, 0.52, 0.1), (0.04, 0.87, -0.23), (0.48, 0.2, 0.85)),
    Ear((-0.63, 0.52, -0.06), (-0.6, 0.84, -0.64), (0.87, 0.42, 0.28)),
)


@dataclass(frozen=True)
class Short:
    """A ball with shorter fur: `share` of the length within half of `radius`, all beyond `radius`, model units."""

    centre: tuple[float, float, float]
    radius: float
    share: float


SHORT = (
    Short((-0.854, 0.412, 0.385), 0.34, 0.3),
    Short((-0.541, 0.436, 0.513), 0.34, 0.3),
    Short((-0.702, 0.25, 0.668), 0.5, 0.5),
)
"""Fur around both eyes and the nose."""

EAR_SHARE = 0.7
"""Length of the fur on ears."""

PAW_SHARE = 0.25
"""Length of the fur on paws."""


def step(x: Floats, low: float, high: float) -> Floats:
    """0 below low, 1 above high, smooth between."""
    s = np.clip((x - low) / (high - low), 0.0, 1.0)
    return np.asarray(s * s * (3.0 - 2.0 * s))


def divided(vertices: Floats, faces: Ints, normals: Floats, chosen: Mask) -> tuple[Floats, Ints]:
    """The mesh with all edges of the chosen faces halved, neighbours split to fit; new points lie on the round surface
    that the normals tell (Phong tessellation, Boubekeur and Alexa 2008)."""
    edges = np.sort(faces[:, [[0, 1], [1, 2], [2, 0]]], axis=2)
    halved = np.unique(edges[chosen].reshape(-1, 2), axis=0)
    number = {(int(a), int(b)): len(vertices) + k for k, (a, b) in enumerate(halved)}
    ends, up = vertices[halved], normals[halved]
    middle = ends.mean(axis=1)
    pulled = middle[:, None] - np.einsum("eki,eki->ek", middle[:, None] - ends, up)[..., None] * up
    points = np.vstack([vertices, 0.25 * middle + 0.75 * pulled.mean(axis=1)])
    found: list[tuple[int, ...]] = []
    for face, sides in zip(faces.tolist(), edges.tolist(), strict=True):
        cuts = [number.get((a, b)) for a, b in sides]
        found += _pieces(face, cuts)
    return points, np.array(found, dtype=np.int64)


def _pieces(face: list[int], cuts: list[int | None]) -> list[tuple[int, ...]]:
    """Triangles of a face whose sides 01, 12 and 20 have new points or none."""
    count = sum(cut is not None for cut in cuts)
    if count == 0:
        return [tuple(face)]
    turn = next(k for k in range(3) if cuts[k] is not None and (count != 2 or cuts[k - 1] is None))
    a, b, c = (face[(turn + k) % 3] for k in range(3))
    ab, bc, ca = (cuts[(turn + k) % 3] for k in range(3))
    if count == 1:
        return [(a, ab, c), (ab, b, c)]  # type: ignore[list-item]
    if count == 2:
        return [(a, ab, c), (ab, b, bc), (ab, bc, c)]  # type: ignore[list-item]
    return [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]  # type: ignore[list-item]


def midline(t: Floats, u: Floats) -> Floats:
    """(V,) middle between the edges of an ear at each t, a parabola through those of its slices."""
    edges = np.linspace(t.min(), t.max(), 13)
    slices = [(t >= low) & (t <= high) for low, high in zip(edges, edges[2:], strict=False)]
    at = [(t[one].mean(), (u[one].min() + u[one].max()) / 2.0) for one in slices if one.sum() > 3]
    return np.asarray(np.polyval(np.polyfit(*np.array(at).T, 2), t))


def leaf(vertices: Floats, faces: Ints, ear: Ear) -> Floats:
    """Vertices with one ear thinned about its middle, and its end narrowed."""
    mesh = trimesh.Trimesh(vertices, faces, process=False)
    mine = np.flatnonzero(ear.holds(vertices, 0.0))
    along, across, thin = ear.axes
    side = np.sign(mesh.vertex_normals[mine] @ thin)
    points = vertices[mine]
    # The opposite side of the ear, seen from just inside.
    starts, ways = points - 1e-4 * mesh.vertex_normals[mine], -side[:, None] * thin
    hits, rays, _ = mesh.ray.intersects_location(starts, ways, multiple_hits=False)
    through = np.zeros(len(mine))
    through[rays] = np.linalg.norm(hits - points[rays], axis=1)
    through[through > REACH] = 0.0
    t, u, w = ear.place(points).T
    end = t.max()
    share = step(t, 0.02, 0.3)
    w = w - side * share * (1.0 - THICKNESS) * through / 2.0
    middle = midline(t, u)
    u = middle + (u - middle) * (1.0 - NARROW * step(t, 0.35 * end, end))
    moved = vertices.copy()
    moved[mine] = ear.root + t[:, None] * along + u[:, None] * across + w[:, None] * thin
    return moved


def smoothed(vertices: Floats, faces: Ints, chosen: Mask) -> Floats:
    """Vertices with the chosen ones smoothed without shrinking (Taubin 1995)."""
    mesh = trimesh.Trimesh(vertices, faces, process=False)
    trimesh.smoothing.filter_taubin(mesh, iterations=SMOOTH)
    return np.where(chosen[:, None], mesh.vertices, vertices)


def fur_length(vertices: Floats) -> Floats:
    """(V,) 0..1, length of the fur over the longest: short on face, ears and paws, which long fur would hide."""
    share = np.ones(len(vertices))
    for one in SHORT:
        far = np.linalg.norm(vertices - one.centre, axis=1) / one.radius
        share = np.minimum(share, one.share + (1.0 - one.share) * step(far, 0.5, 1.0))
    for ear in EARS:
        t = ear.place(vertices)[:, 0]
        on = np.where(ear.holds(vertices, 0.0), step(t, 0.0, 0.25), 0.0)
        share = np.minimum(share, 1.0 - (1.0 - EAR_SHARE) * on)
    x, y, z = vertices.T
    paw = step(-y, 0.42, 0.6) * np.maximum(step(z, 0.15, 0.35), step(-x, 0.3, 0.5) * step(z, -0.35, -0.15))
    return np.asarray(np.minimum(share, 1.0 - (1.0 - PAW_SHARE) * paw))


def rabbit(source: Path) -> tuple[Floats, Ints]:
    """Vertices (V, 3) and faces (F, 3) of the rabbit."""
    body = load_mesh(source)
    vertices, faces = np.asarray(body.vertices), np.asarray(body.faces)
    for ear in EARS:
        normals = np.asarray(trimesh.Trimesh(vertices, faces, process=False).vertex_normals)
        vertices, faces = divided(vertices, faces, normals, ear.holds(vertices, 0.1)[faces].all(axis=1))
    for ear in EARS:
        vertices = leaf(vertices, faces, ear)
        vertices = smoothed(vertices, faces, ear.holds(vertices, 0.08))
    return vertices, faces


def main(source: Path, out: Path) -> None:
    """Write the model into a file."""
    vertices, faces = rabbit(source)
    # Without a material: bare skin has the colour of the roots.
    attributes = {"_FUR_LENGTH": fur_length(vertices).astype(np.float32)[:, None]}
    mesh = trimesh.Trimesh(vertices, faces, vertex_attributes=attributes, process=False)
    out.write_bytes(mesh.export(file_type="glb"))
    print(out, len(vertices), "vertices", len(faces), "faces", out.stat().st_size, "bytes", mesh.is_watertight)


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
