"""Everything that moves a model: nodes, joints, morph targets and clips (glTF 2.0, 3.7.2.2, 3.7.3, 3.11)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

BODY = -1
"""Node of a channel that weighs the body's morph targets."""


@dataclass(frozen=True)
class RigNode:
    """A node of the hierarchy, as it rests in the file.

    parent : index in `Rig.nodes`, always a smaller one; -1: a root
    translation : (3,), rotation : (4,) unit quaternion x, y, z, w, scale : (3,)
    matrix : (4, 4) in place of these three, of a node that no clip moves; None: they count
    """

    name: str
    parent: int
    translation: Floats
    rotation: Floats
    scale: Floats
    matrix: Floats | None = None


@dataclass(frozen=True)
class Channel:
    """A number of the rig over time.

    node : index in `Rig.nodes`, or BODY
    path : translation, rotation, scale, or weights (of BODY alone)
    times : (K,) seconds, rising
    values : (K, n), of a CUBICSPLINE (3K, n): in-tangent, value, out-tangent of each key; weights have n = targets
    interpolation : LINEAR, STEP or CUBICSPLINE
    """

    node: int
    path: str
    times: Floats
    values: Floats
    interpolation: str = "LINEAR"


@dataclass(frozen=True)
class Clip:
    """An animation."""

    name: str
    channels: tuple[Channel, ...]


@dataclass(frozen=True)
class Target:
    """A morph target.

    deltas : (N, 3) displacement of each of `Rig.vertices`, bind pose
    weight : at rest
    """

    name: str
    deltas: Floats
    weight: float = 0.0


@dataclass(frozen=True)
class Pose:
    """A pose of a rig.

    matrices : (J, 4, 4) of each joint, from the bind pose to this one, scene space
    weights : (T,) of the targets
    """

    matrices: Floats
    weights: Floats


@dataclass(frozen=True)
class Rig:
    """Everything that moves a model, with the original triangles that it moves.

    nodes : parents before children; joints and all nodes above them
    joints : index of each joint's node; () for a model of morph targets alone
    inverse_bind : (J, 4, 4) bind pose of the scene -> joint
    vertices : (N, 3) bind pose, scene space; posed : (N, 3) the same in the pose in which the fur is baked
    faces : (M, 3) int
    which, shares : (N, 4) int and float, joints of each vertex with their weights, which sum to 1
    pose : in which the fur is baked; None: the bind pose with all targets at 0, `posed` is `vertices`
    """

    nodes: tuple[RigNode, ...]
    joints: tuple[int, ...]
    inverse_bind: Floats
    vertices: Floats
    posed: Floats
    faces: Ints
    which: Ints
    shares: Floats
    targets: tuple[Target, ...] = ()
    clips: tuple[Clip, ...] = ()
    pose: Pose | None = None
