"""Writes the tiger cub: its mesh, the picture of its skin, the length of its fur and where its mane is.

    baker/.venv/bin/python baker/models/tiger/make.py public/models/tiger.glb
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import trimesh
from numpy.typing import NDArray
from paint import colours, length, mane
from PIL import Image
from shape import cub, surface

from furbake.surface.mesh import simplify, clean
from furbake.surface.roots.raster import drawn

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

FACES = 7000
SIDE = 1024
"""Texels of the picture."""

GUTTER = 3
"""Texels between islands."""

FINER = 3
"""Points along each side of a texel."""


def islands(vertices: Floats, faces: Ints) -> Ints:
    """(F,) number of the island of each face: neighbours that look along the same axis."""
    normals = np.cross(*(vertices[faces[:, i]] - vertices[faces[:, 0]] for i in (1, 2)))
    axis = np.argmax(np.abs(normals) * (1.0, 0.8, 1.0), axis=1)
    looks = 2 * axis + (np.take_along_axis(normals, axis[:, None], 1)[:, 0] > 0)
    pairs = trimesh.Trimesh(vertices, faces, process=False).face_adjacency
    same = pairs[looks[pairs[:, 0]] == looks[pairs[:, 1]]]
    return np.asarray(trimesh.graph.connected_component_labels(same, node_count=len(faces)), dtype=np.int64)


def unfolded(vertices: Floats, faces: Ints, island: Ints) -> Floats:
    """(F, 3, 2) texture coordinates, v down: every island as it is seen along its axis, in rows by height."""
    normals = np.cross(*(vertices[faces[:, i]] - vertices[faces[:, 0]] for i in (1, 2)))
    flat = np.zeros((len(faces), 3, 2))
    for one in range(int(island.max()) + 1):
        mine = island == one
        axis = int(np.argmax(np.abs(normals[mine].sum(axis=0)) * (1.0, 0.8, 1.0)))
        rest = [[2, 1], [0, 2], [0, 1]][axis]
        flat[mine] = vertices[faces[mine]][..., rest] * (1.0, -1.0)
    low = np.array([flat[island == one].reshape(-1, 2).min(axis=0) for one in range(int(island.max()) + 1)])
    size = np.array([np.ptp(flat[island == one].reshape(-1, 2), axis=0) for one in range(int(island.max()) + 1)])
    for scale in np.arange(600.0, 50.0, -5.0):
        place, fits = rows(size * scale + 2 * GUTTER)
        if fits:
            return np.asarray(((flat - low[island][:, None]) * scale + GUTTER + place[island][:, None]) / SIDE)
    raise ValueError("the islands do not fit")


def rows(size: Floats) -> tuple[Floats, bool]:
    """Places of boxes in rows, the highest first, and whether all of them fit."""
    place, x, y, high = np.zeros_like(size), 0.0, 0.0, 0.0
    for one in np.argsort(-size[:, 1], kind="stable"):
        if x + size[one, 0] > SIDE:
            x, y, high = 0.0, y + high, 0.0
        place[one] = x, y
        x, high = x + size[one, 0], max(high, size[one, 1])
    return place, bool(y + high <= SIDE and size[:, 0].max() <= SIDE)


def picture(vertices: Floats, faces: Ints, uv: Floats) -> Image.Image:
    """The skin's colours; what is between islands has those of the nearest."""
    from scipy.ndimage import distance_transform_edt

    total, number = np.zeros((SIDE * FINER, SIDE * FINER, 3)), np.zeros((SIDE * FINER, SIDE * FINER), dtype=bool)
    for face, row, column, shares in drawn(uv * SIDE * FINER, number.shape):
        total[row, column] = colours(np.einsum("nc,nck->nk", shares, vertices[faces[face]]))
        number[row, column] = True
    _, (row, column) = distance_transform_edt(~number, return_indices=True)
    fine = total[row, column].reshape(SIDE, FINER, SIDE, FINER, 3)
    return Image.fromarray(np.rint(fine.mean(axis=(1, 3))).astype(np.uint8))


def main(out: Path) -> None:
    vertices, faces = surface(cub(), (-0.85, -0.06, -0.95), (0.95, 1.95, 0.75))
    whole = clean("tiger", vertices, faces, max_faces=10**6)
    mesh = trimesh.Trimesh(whole.vertices, whole.faces, process=False)
    trimesh.smoothing.filter_taubin(mesh, iterations=10)
    body = simplify(clean("tiger", mesh.vertices, mesh.faces, max_faces=10**6), FACES)
    vertices, faces = body.vertices, body.faces
    uv = unfolded(vertices, faces, islands(vertices, faces))
    corners = np.column_stack([np.repeat(vertices[faces.reshape(-1)], 1, axis=0), uv.reshape(-1, 2)]).round(9)
    rows_, first, index = np.unique(corners, axis=0, return_index=True, return_inverse=True)
    source = faces.reshape(-1)[first]
    points, coordinates = vertices[source], uv.reshape(-1, 2)[first]
    skin = trimesh.visual.material.PBRMaterial(
        name="skin", baseColorTexture=picture(vertices, faces, uv), metallicFactor=0.0, roughnessFactor=0.9
    )
    visual = trimesh.visual.TextureVisuals(uv=coordinates * (1, -1) + (0, 1), material=skin)
    whole_mesh = trimesh.Trimesh(points, index.reshape(-1, 3), process=False, visual=visual)
    whole_mesh.vertex_attributes["_LENGTH"] = length(points).astype(np.float32)[:, None]
    whole_mesh.vertex_attributes["_MANE"] = mane(points).astype(np.float32)[:, None]
    out.write_bytes(whole_mesh.export(file_type="glb"))
    print(out, len(points), "vertices", len(faces), "faces", out.stat().st_size, "bytes")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
