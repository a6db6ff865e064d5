"""Nodes of a rig and its skin in glTF, and the meshes that hang on a joint."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from furbake.asset.mesh.buffer import Buffer, numbers
from furbake.asset.rig.clips import animations
from furbake.asset.rig.motion import Motion
from furbake.surface.mesh import Surface
from furbake.surface.place.features import Feature, nearest
from furbake.surface.rig.rig import Floats, Rig, RigNode

Record = dict[str, Any]
Grid = tuple[Floats, float]

THIN = 1e-9
"""Determinant of a joint's matrix, as a share of its size cubed, below which nothing can hang on it."""


def rigged(
    nodes: list[Record],
    features: tuple[Feature, ...],
    motion: Motion | None,
    surface: Surface,
    grid: Grid,
    buffer: Buffer,
) -> tuple[list[int], Record]:
    """Everything of a rig that is no vertex: its nodes are appended, and skin and clips are stored.

    nodes : of the document: skin, shells and fins, then those of the features, which are moved below joints
    surface : the skin in the pose in which features stand on it; grid : offset and scale of stored positions

    Roots of the scene beside the skin, and members of the document.
    """
    start, own = len(nodes), len(nodes) - len(features)
    loose = list(range(own, start))
    if motion is None:
        return loose, {}
    children = hung(nodes, features, motion, surface)
    added, roots = rig_nodes(motion.rig, start)
    for node, below in children.items():
        added[node].setdefault("children", []).extend(below)
    nodes += added
    members: Record = {}
    if motion.rig.joints:
        for record in nodes[:own]:
            record["skin"] = 0
        members["skins"] = [skin(motion.rig, start, *grid, buffer)]
    if clips := animations(motion.rig.clips, start, 0, buffer):
        members["animations"] = clips
    hanging = {index for below in children.values() for index in below}
    return [*(index for index in loose if index not in hanging), *roots], members


def morphs(motion: Motion | None) -> Record:
    """Members of a mesh that has the rig's morph targets: their weights at rest and their names."""
    targets = () if motion is None else motion.rig.targets
    if not targets:
        return {}
    names = [target.name.encode("utf-8", "replace").decode() for target in targets]
    return {"weights": numbers(np.array([target.weight for target in targets])), "extras": {"targetNames": names}}


def rig_nodes(rig: Rig, start: int) -> tuple[list[Record], list[int]]:
    """The rig's nodes, numbered from `start` in its order, and those of them that are roots of the scene.

    Joints of one skin need a node above all of them: where the rig has several roots it is added as the last.
    """
    nodes = [_node(node) for node in rig.nodes]
    roots = []
    for index, node in enumerate(rig.nodes):
        if node.parent < 0:
            roots.append(start + index)
        else:
            nodes[node.parent].setdefault("children", []).append(start + index)
    if len({_root(rig, joint) for joint in rig.joints}) > 1:
        nodes.append({"name": "rig", "children": roots})
        roots = [start + len(rig.nodes)]
    return nodes, roots


def skin(rig: Rig, start: int, offset: Floats, scale: float, buffer: Buffer) -> Record:
    """The glTF skin of a rig whose nodes are numbered from `start`.

    offset, scale : what undoes the quantisation of positions. Readers ignore the node's own transform of a mesh that
    has a skin, so the matrices undo it
    """
    undone = np.diag([scale, scale, scale, 1.0])
    undone[:3, 3] = offset
    matrices = rig.inverse_bind @ undone
    columns = np.swapaxes(matrices, 1, 2).reshape(-1, 16)
    columns[:, 3::4] = (0.0, 0.0, 0.0, 1.0)
    return {
        "name": "rig",
        "inverseBindMatrices": buffer.floats(columns, "MAT4"),
        "joints": [start + node for node in rig.joints],
    }


def hung(nodes: list[Record], features: tuple[Feature, ...], motion: Motion, surface: Surface) -> dict[int, list[int]]:
    """Nodes of features, moved to below the joints that they name or that move the surface most where they stand.

    nodes : of the document; those of the features are the last of them, and change
    surface : the skin in the pose in which it is given

    The children that each node of the rig gets.
    """
    found: dict[int, list[int]] = {}
    rig, start = motion.rig, len(nodes) - len(features)
    for index, feature in enumerate(features, start):
        if not rig.joints:
            break
        joint = _named(rig, feature.joint)
        if joint is None:
            joint = strongest(motion, surface, np.array(feature.centre))
        to_joint = rig.inverse_bind[joint]
        if rig.pose is not None:
            to_joint = to_joint @ _inverse(rig.pose.matrices[joint])
        size = np.linalg.norm(to_joint[:3, :3])
        if abs(np.linalg.det(to_joint[:3, :3])) <= THIN * size**3:
            continue
        nodes[index] |= _below(to_joint, feature)
        found.setdefault(rig.joints[joint], []).append(index)
    return found


def _named(rig: Rig, name: str | None) -> int | None:
    """The first joint of a name; None where there is none."""
    return next((i for i, node in enumerate(rig.joints) if name is not None and rig.nodes[node].name == name), None)


def strongest(motion: Motion, surface: Surface, place: Floats) -> int:
    """The joint that moves the surface most at its vertex nearest to the nearest point of it."""
    point, _ = nearest(surface, place)
    vertex = int(np.argmin(np.linalg.norm(surface.vertices - point, axis=1)))
    follow = motion.skin
    return int(follow.joints[vertex, np.argmax(follow.weights[vertex])])


def _below(to_joint: Floats, feature: Feature) -> Record:
    """Place of a feature in the axes of a joint: exact where these are turned and evenly scaled."""
    linear = to_joint[:3, :3] @ Rotation.from_quat(feature.turn).as_matrix()
    u, _, v = np.linalg.svd(linear)
    turn = u @ v
    turn = turn if np.linalg.det(turn) > 0.0 else -turn  # a ball is its own mirror image
    radii = np.linalg.norm(linear, axis=0) * np.array(feature.radii)
    centre = to_joint[:3, :3] @ np.array(feature.centre) + to_joint[:3, 3]
    return {
        "translation": numbers(centre),
        "rotation": numbers(Rotation.from_matrix(turn).as_quat(canonical=True)),
        "scale": numbers(radii),
    }


def _inverse(matrix: Floats) -> Floats:
    """The inverse, or that of none where there is none."""
    try:
        return np.asarray(np.linalg.inv(matrix))
    except np.linalg.LinAlgError:
        return np.eye(4)


def _root(rig: Rig, joint: int) -> int:
    while rig.nodes[joint].parent >= 0:
        joint = rig.nodes[joint].parent
    return joint


def _node(node: RigNode) -> Record:
    """A node without its children; what is as it would be where missing is left out."""
    record: Record = {"name": node.name.encode("utf-8", "replace").decode()}
    if node.matrix is not None:
        matrix = numbers(np.asarray(node.matrix).T)
        return record if matrix == numbers(np.eye(4)) else record | {"matrix": matrix}
    parts = (("translation", node.translation, np.zeros(3)), ("rotation", node.rotation, np.eye(4)[3]),
             ("scale", node.scale, np.ones(3)))  # fmt: skip
    return record | {name: numbers(values) for name, values, default in parts if (values != default).any()}
