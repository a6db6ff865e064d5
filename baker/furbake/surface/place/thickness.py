"""Length of the fur by thickness of the body: short on ears and feet, full on the trunk."""

from __future__ import annotations

import numpy as np

from furbake.surface.mesh import Floats, Surface
from furbake.surface.place.rays import nearest_hits
from furbake.surface.repair.topology import smoother

try:
    from embreex.mesh_construction import TriangleMesh
    from embreex.rtcore_scene import EmbreeScene
except ImportError:  # no wheel for this platform: the slow way gives the same distances
    EmbreeScene = None

SHORTEST = 0.3
"""Length where the body is thinnest, share of the full length."""

GAIN = 2.0
"""Full length from a thickness of 1/GAIN half extents."""

RAYS = 5
"""Into the body per vertex: one straight, the others about CONE (radians) off."""

CONE = 0.35

ROUNDS = 4
"""Rounds of smoothing over the mesh."""


def length_by_thickness(surface: Surface) -> Floats:
    """(V,) float, share of the full length, SHORTEST..1, from the distance through the body at each vertex.

    The result doesn't depend on the model's unit. A ray that leaves an open surface counts as thick.
    """
    scale = 0.5 * surface.extent
    inward = cone(-surface.normals, RAYS, CONE)
    start = np.broadcast_to((surface.vertices - 2e-3 * scale * surface.normals)[:, None], inward.shape)
    far = distances(surface, start.reshape(-1, 3), inward.reshape(-1, 3)).reshape(-1, RAYS)
    thick = np.minimum(GAIN * np.median(far, axis=1) / scale, 2.0)
    average = smoother(len(surface.vertices), surface.faces)
    for _ in range(ROUNDS):
        thick = average @ thick
    return np.clip(thick, SHORTEST, 1.0)


def cone(axes: Floats, count: int, angle: float) -> Floats:
    """(n, count, 3) unit directions: each axis itself, then count - 1 evenly around it, `angle` (radians) off."""
    helper = np.where(np.abs(axes[:, :1]) < 0.7, [[1.0, 0.0, 0.0]], [[0.0, 1.0, 0.0]])
    one = np.cross(axes, helper)
    one /= np.linalg.norm(one, axis=1, keepdims=True)
    two = np.cross(axes, one)
    turn = 2.0 * np.pi * np.arange(count - 1) / max(count - 1, 1)
    around = np.cos(turn)[:, None] * one[:, None] + np.sin(turn)[:, None] * two[:, None]
    tilted = np.cos(angle) * axes[:, None] + np.sin(angle) * around
    return np.concatenate([axes[:, None], tilted], axis=1)


def distances(surface: Surface, origins: Floats, directions: Floats) -> Floats:
    """(n,) distance along each ray to the surface, model units, infinite where it hits nothing."""
    # Embree counts in 32-bit floats: bring every model to the same size and place.
    centre, scale = surface.vertices.mean(axis=0), surface.extent
    vertices = (surface.vertices - centre) / scale
    starts = (origins - centre) / scale
    if EmbreeScene is None:
        return scale * nearest_hits(vertices[surface.faces], starts, directions)
    scene = EmbreeScene()
    TriangleMesh(scene, vertices.astype(np.float32), surface.faces.astype(np.int32))
    found = scene.run(starts.astype(np.float32), directions.astype(np.float32), query="DISTANCE")
    far = np.asarray(found, dtype=np.float64)
    return scale * np.where(far < 1e3, far, np.inf)
