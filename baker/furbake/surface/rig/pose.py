"""Poses of a rig: matrices of its joints, its vertices moved by them, and vertices brought back."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from furbake.surface.repair.topology import unit
from furbake.surface.rig.follow import Follow
from furbake.surface.rig.rig import Floats, Pose, Rig
from furbake.surface.rig.weights import ROWS

FLATTEST = 1e-9
"""Determinant of a blended matrix, in its largest number to the third power, below which nothing is brought back."""


def world(rig: Rig, own: Floats) -> Floats:
    """(n, 4, 4) matrix of every node in the scene, from (n, 4, 4) that of each in its parent."""
    found = np.array(own, dtype=np.float64)
    for i, node in enumerate(rig.nodes):
        if node.parent >= 0:
            found[i] = found[node.parent] @ found[i]
    return found


def local(translation: Floats, rotation: Floats, scale: Floats) -> Floats:
    """(4, 4) matrix of a node; a rotation of any length but 0 counts as the unit one."""
    x, y, z, w = np.asarray(rotation) / max(float(np.linalg.norm(rotation)), 1e-300)
    matrix = np.eye(4)
    matrix[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    matrix[:3, :3] *= scale
    matrix[:3, 3] = translation
    return matrix


def rest(rig: Rig) -> Floats:
    """(n, 4, 4) matrix of every node in its parent, as it rests."""
    return np.array(
        [
            local(node.translation, node.rotation, node.scale) if node.matrix is None else node.matrix
            for node in rig.nodes
        ]
    ).reshape(-1, 4, 4)


def matrices(rig: Rig, own: Floats) -> Floats:
    """(J, 4, 4) matrix of every joint from the bind pose, where the nodes stand in their parents as `own` says."""
    return np.asarray(world(rig, own)[list(rig.joints)] @ rig.inverse_bind)


def blend(rig: Rig, joints: NDArray[np.integer], weights: NDArray[np.generic]) -> Floats:
    """(V, 4, 4) matrix that takes a vertex of the bind pose to the pose in which the fur is baked.

    joints, weights : (V, n), weights of any scale, as bytes for example
    """
    if rig.pose is None or not rig.joints:
        return np.tile(np.eye(4), (len(joints), 1, 1))
    return mixed(rig.pose.matrices, joints, weights)


def mixed(moved: Floats, joints: NDArray[np.integer], weights: NDArray[np.generic]) -> Floats:
    """(V, 4, 4) mean of the joints' matrices (J, 4, 4) by weight."""
    shares = np.asarray(weights, dtype=np.float64)
    shares = shares / np.maximum(shares.sum(axis=1, keepdims=True), 1e-300)
    total = np.zeros((len(joints), 4, 4))
    for i in range(joints.shape[1]):
        total += shares[:, i, None, None] * moved[joints[:, i]]
    return total


def posed(rig: Rig, pose: Pose) -> Floats:
    """(N, 3) vertices of the rig in a pose: moved by its targets, then by its joints."""
    places = rig.vertices.copy()
    for target, weight in zip(rig.targets, pose.weights.tolist(), strict=True):
        if weight:
            places += weight * target.deltas
    if not rig.joints:
        return places
    for start in range(0, len(places), ROWS):
        rows = slice(start, start + ROWS)
        blended = mixed(pose.matrices, rig.which[rows], rig.shares[rows])
        places[rows] = np.einsum("vab,vb->va", blended[:, :3, :3], places[rows]) + blended[:, :3, 3]
    return places


def unposed(rig: Rig, follows: Follow, vertices: Floats, normals: Floats) -> tuple[Floats, Floats]:
    """(V, 3) places and unit normals in the bind pose of vertices in the pose in which the fur is baked.

    follows : `follow(rig, vertices, normals)`. Posed again by its very bytes, the places are the vertices.
    Vertices that the pose presses flat keep their places.
    """
    if rig.pose is None:
        return vertices, normals
    blended = blend(rig, follows.joints, follows.weights)
    turn = blended[:, :3, :3]
    size = np.abs(turn).max(axis=(1, 2))
    flat = np.abs(np.linalg.det(turn)) <= FLATTEST * np.maximum(size, 1e-100) ** 3
    blended = np.where(flat[:, None, None], np.eye(4), blended)
    back = np.linalg.inv(blended)
    places = np.einsum("vab,vb->va", back[:, :3, :3], vertices) + back[:, :3, 3]
    places -= np.einsum("t,tvd->vd", rig.pose.weights, follows.deltas)
    return places, unit(np.einsum("vba,vb->va", blended[:, :3, :3], normals))
