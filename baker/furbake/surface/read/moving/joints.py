"""All joints of a glTF file's scene as one list: those of its skins, and nodes that carry parts and move."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from scipy.spatial.transform import Rotation

from furbake.surface.read.gltf_data import GltfData, Record
from furbake.surface.read.gltf_nodes import text
from furbake.surface.read.gltf_parts import Part
from furbake.surface.read.moving.skins import HUGE, Skin, bound, influences, read_skin, regular, spans
from furbake.surface.read.moving.told import Told
from furbake.surface.rig.rig import RigNode
from furbake.surface.soup import Floats, Ints

MAX_JOINTS = 65_535
"""Joints of a model: their numbers are 16 bits."""

SAME = 1e-6
"""Numbers of inverse bind matrices, in the largest of them, nearer than this are one."""

WAYS = 8
"""Ways to be bound in which a joint is looked up."""

STILL = "still"
"""Name of nodes outside of the scene."""

TOO_MANY = (f"joint, more than {MAX_JOINTS}, left out", f"joints, more than {MAX_JOINTS}, left out: none moves the fur")
BAD_NODE = (
    "node with numbers that are not finite stands where its parent does",
    "nodes with numbers that are not finite stand where their parents do",
)


@dataclass
class Joints:
    """The joints of a scene, as they are found.

    nodes : of the file; -1 - n: the n-th of those made up, with a name and the node above it, -1: none
    inverse_bind : (4, 4) of each
    binds : (4, 4) of each part, from its own space to the bind pose of the scene
    which, shares : (V, 4) of each part
    """

    nodes: list[int] = field(default_factory=list)
    inverse_bind: list[Floats] = field(default_factory=list)
    made_up: list[tuple[str, int]] = field(default_factory=list)
    binds: list[Floats] = field(default_factory=list)
    which: list[Ints] = field(default_factory=list)
    shares: list[Floats] = field(default_factory=list)
    _known: dict[int, list[int]] = field(default_factory=dict)

    def joint(self, node: int, name: str, inverse_bind: Floats) -> int:
        """Number of a node's joint, -1: outside of the scene. A node that is bound in two ways gets a child."""
        known = self._known.setdefault(node, [])
        for joint in known[:WAYS]:
            if np.abs(self.inverse_bind[joint] - inverse_bind).max() <= SAME * np.abs(inverse_bind).max():
                return joint
        if node < 0 or known:
            self.made_up.append((name, node))
            node = -len(self.made_up)
        self.nodes.append(node)
        self.inverse_bind.append(inverse_bind)
        known.append(len(self.nodes) - 1)
        return known[-1]


def read_joints(
    data: GltfData,
    places: dict[int, Floats],
    parents: dict[int, int],
    parts: Sequence[Part],
    moved: set[int],
    told: Told,
) -> Joints:
    """All joints, the bind pose of each part and the joints of its vertices; no joints where nothing moves.

    moved : nodes that a clip moves
    """
    skins = {part.skin: None for part in parts if part.skin is not None}
    read = {index: read_skin(data, index, places, told) for index in skins}
    held: list[tuple[Ints, Floats] | None] = []
    for part in parts:
        skin, found = read.get(part.skin), part.influences()
        held.append(None if skin is None or found is None else influences(skin, *found, told))
    joints = Joints()
    tables, spaces = _of_skins(data, read, spans(parents), parts, held, places, joints)
    movers = moved | set(joints.nodes)
    for node, parent in parents.items():
        if parent in movers:
            movers.add(node)
    still: list[int] = []
    for i, (part, own) in enumerate(zip(parts, held, strict=True)):
        joints.binds.append(places[part.node] if own is None else spaces[part.skin])
        if own is not None:
            joints.which.append(tables[part.skin][own[0]])
            joints.shares.append(own[1])
            continue
        one = 0
        if part.node in movers and regular(places[part.node][None])[0]:
            one = joints.joint(
                part.node, name_of(data, part.node), np.asarray(np.linalg.inv(places[part.node]), dtype=np.float64)
            )
        else:
            still.append(i)
        joints.which.append(np.tile([one, 0, 0, 0], (len(part.soup.vertices), 1)))
        joints.shares.append(np.tile([1.0, 0.0, 0.0, 0.0], (len(part.soup.vertices), 1)))
    if still and joints.nodes:
        one = joints.joint(-1, STILL, np.eye(4))
        for i in still:
            joints.which[i] = np.tile([one, 0, 0, 0], (len(parts[i].soup.vertices), 1))
    for which, shares in zip(joints.which, joints.shares, strict=True):
        which[shares == 0.0] = 0
    if len(joints.nodes) > MAX_JOINTS:
        told.add(TOO_MANY, len(joints.nodes))
        return Joints(binds=joints.binds, which=[0 * which for which in joints.which], shares=joints.shares)
    return joints


def _of_skins(
    data: GltfData,
    skins: dict[object, Skin | None],
    where: dict[int, tuple[int, int]],
    parts: Sequence[Part],
    held: Sequence[tuple[Ints, Floats] | None],
    places: dict[int, Floats],
    joints: Joints,
) -> tuple[dict[object, Ints], dict[object, Floats]]:
    """For each skin the numbers of its joints in the list, and the matrix of its bind pose."""
    tables: dict[object, Ints] = {}
    spaces: dict[object, Floats] = {}
    for part, own in zip(parts, held, strict=True):
        skin = skins.get(part.skin)
        if own is None or skin is None or part.skin in tables:
            continue
        space = bound(skin, where)
        if space is None:
            space = places[part.node] if regular(places[part.node][None])[0] else np.eye(4)
        whole = regular(skin.stand)
        rest = np.linalg.inv(np.where(whole[:, None, None], skin.stand, np.eye(4)))
        inverse = np.where(skin.usable[:, None, None], skin.bind @ np.linalg.inv(space), rest)
        tables[part.skin] = np.array(
            [
                joints.joint(node, STILL if node < 0 else name_of(data, node), matrix)
                for node, matrix in zip(skin.joints.tolist(), inverse, strict=True)
            ],
            dtype=np.int64,
        )
        spaces[part.skin] = space
    return tables, spaces


def rig_nodes(
    data: GltfData, parents: dict[int, int], joints: Joints, moved: set[int], told: Told
) -> tuple[tuple[RigNode, ...], dict[int, int]]:
    """The joints' nodes and all above them, parents first, and the place in that list of each node of the file.

    Those made up are there by their negative numbers. moved : nodes that a clip moves
    """
    needed = {node for node in joints.nodes if node >= 0} | {node for _, node in joints.made_up if node >= 0}
    for node, parent in reversed(parents.items()):
        if node in needed and parent >= 0:
            needed.add(parent)
    found: list[RigNode] = []
    index: dict[int, int] = {}
    for node, parent in parents.items():
        if node in needed:
            index[node] = len(found)
            found.append(_rig_node(data.list_of("nodes")[node], index.get(parent, -1), node in moved, told))
    for i, (name, above) in enumerate(joints.made_up):
        index[-1 - i] = len(found)
        found.append(replace(_still(name), parent=index[above] if above >= 0 else -1))
    return tuple(found), index


def name_of(data: GltfData, node: int) -> str:
    """Name of a node, empty where it has none."""
    return text(data.list_of("nodes")[node].get("name"))


def _still(name: str) -> RigNode:
    return RigNode(name, -1, np.zeros(3), np.array([0.0, 0.0, 0.0, 1.0]), np.ones(3))


def _rig_node(record: Record, parent: int, moved: bool, told: Told) -> RigNode:
    node = replace(_still(text(record.get("name"))), parent=parent)
    if "matrix" in record:
        matrix = np.array(record["matrix"], dtype=np.float64).reshape(4, 4).T
        if not (np.abs(matrix) <= HUGE).all():
            told.add(BAD_NODE)
            return node
        return _apart(node, matrix) if moved else replace(node, matrix=matrix)
    translation = np.array(record.get("translation", (0, 0, 0)), dtype=np.float64).reshape(3)
    rotation = np.array(record.get("rotation", (0, 0, 0, 1)), dtype=np.float64).reshape(4)
    scale = np.array(record.get("scale", (1, 1, 1)), dtype=np.float64).reshape(3)
    if not all((np.abs(numbers) <= HUGE).all() for numbers in (translation, rotation, scale)):
        told.add(BAD_NODE)
        return node
    length = float(np.linalg.norm(rotation))
    turn = rotation / length if length > 0.0 else node.rotation
    return replace(node, translation=translation, rotation=turn, scale=scale)


def _apart(node: RigNode, matrix: Floats) -> RigNode:
    """The node with a matrix as translation, rotation and scale; shear is lost."""
    scale = np.linalg.norm(matrix[:3, :3], axis=0)
    if np.linalg.det(matrix[:3, :3]) < 0.0:
        scale[0] = -scale[0]
    turn = matrix[:3, :3] / np.where(scale != 0.0, scale, 1.0)
    rotation = Rotation.from_matrix(turn).as_quat() if regular(matrix[None])[0] else node.rotation
    return replace(node, translation=matrix[:3, 3].copy(), rotation=np.asarray(rotation), scale=scale)
