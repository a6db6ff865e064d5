"""Skins of a glTF file: their joints, their bind pose, and the joints of each vertex (glTF 2.0, 3.7.3)."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from furbake.surface.read.gltf_data import BROKEN, GltfData, Record
from furbake.surface.read.moving.told import Told
from furbake.surface.rig.weights import strongest
from furbake.surface.soup import Floats, Ints, MeshError

FLATTEST = 1e-12
"""Determinant of a matrix, in its largest number to the third power, below which it cannot be inverted."""

HUGE = 1e12
"""Numbers beyond this, or their inverse, are taken for broken ones."""

NO_SKIN = "skin without joints left out", "skins without joints left out"
OUTSIDE = "joint outside of the scene stands still", "joints outside of the scene stand still"
BIND = (
    "inverse bind matrix that cannot be inverted replaced by that of the rest pose",
    "inverse bind matrices that cannot be inverted replaced by those of the rest pose",
)
NO_JOINT = "vertex with joints that its skin does not have", "vertices with joints that their skin does not have"
BAD_WEIGHT = (
    "vertex with weights below 0 or not finite, which are left out",
    "vertices with weights below 0 or not finite, which are left out",
)
WEIGHTLESS = "vertex without a weight follows its first joint", "vertices without a weight follow their first joint"
MANY = (
    "vertex with more than 4 joints keeps its 4 strongest",
    "vertices with more than 4 joints keep their 4 strongest",
)


@dataclass
class Skin:
    """A skin of the scene.

    joints : (J,) nodes of the file; -1: outside of the scene
    stand : (J, 4, 4) where its joints rest in the scene
    bind : (J, 4, 4) its inverse bind matrices; usable : (J,) which of them can be inverted
    weight : (J,) of all vertices that follow each joint
    """

    joints: Ints
    stand: Floats
    bind: Floats
    usable: NDArray[np.bool_]
    weight: Floats = field(default_factory=lambda: np.zeros(0))

    def __post_init__(self) -> None:
        """No vertex follows it yet."""
        self.weight = np.zeros(len(self.joints))


def read_skin(data: GltfData, index: Any, places: dict[int, Floats], told: Told) -> Skin | None:
    """A skin by its number in the file; None where it has no joints."""
    record: Record = {}
    try:
        record = data.item("skins", index)
        listed = record["joints"]
    except BROKEN:
        listed = None
    if not isinstance(listed, list) or not listed:
        told.add(NO_SKIN)
        return None
    data.numbers.take(32 * len(listed))
    joints = np.array([joint if type(joint) is int and joint in places else -1 for joint in listed], dtype=np.int64)
    told.add(OUTSIDE, int((joints < 0).sum()))
    stand = np.array([places[joint] if joint >= 0 else np.eye(4) for joint in joints.tolist()])
    bind = np.tile(np.eye(4), (len(joints), 1, 1))
    if "inverseBindMatrices" in record:
        found = _matrices(data, record["inverseBindMatrices"])[: len(joints)]
        bind[:] = 0.0
        bind[: len(found)] = found
        bind[:, 3] = 0.0, 0.0, 0.0, 1.0
    usable = regular(bind)
    told.add(BIND, int((~usable).sum()))
    return Skin(joints, stand, bind, usable)


def _matrices(data: GltfData, index: Any) -> Floats:
    try:
        found = data.accessor(index)
    except MeshError:
        raise
    except BROKEN:
        return np.zeros((0, 4, 4))
    return found.reshape(-1, 4, 4).transpose(0, 2, 1) if found.shape[1] == 16 else np.zeros((0, 4, 4))


def regular(matrices: Floats) -> NDArray[np.bool_]:
    """(n,) which of (n, 4, 4) matrices have numbers of a sensible size and can be inverted."""
    finite: NDArray[np.bool_] = np.asarray((np.abs(matrices) <= HUGE).all(axis=(1, 2)))
    turn = np.where(finite[:, None, None], matrices, 0.0)[:, :3, :3]
    size = np.abs(turn).max(axis=(1, 2), initial=0.0)
    with np.errstate(over="ignore", under="ignore", divide="ignore", invalid="ignore"):
        volume = np.asarray(np.abs(np.linalg.det(turn / np.where(size > 0.0, size, 1.0)[:, None, None])))
    return np.asarray(finite & (size >= 1.0 / HUGE) & (volume > FLATTEST))


def spans(parents: dict[int, int]) -> dict[int, tuple[int, int]]:
    """For each node its place in a walk through the scene, and the first place that is no longer below it.

    parents : node above each, in the order of such a walk
    """
    size = dict.fromkeys(parents, 1)
    for node, parent in reversed(parents.items()):
        if parent >= 0:
            size[parent] += size[node]
    return {node: (place, place + size[node]) for place, node in enumerate(parents)}


def bound(skin: Skin, spans: dict[int, tuple[int, int]]) -> Floats | None:
    """(4, 4) matrix that brings the skin's vertices to the scene in its bind pose; None where no joint has one.

    That of the heaviest joint without another above it that carries weight; if that has none, of the heaviest.

    spans : of the scene's nodes
    """
    moved = skin.stand @ np.where(skin.usable[:, None, None], skin.bind, 0.0)
    usable = skin.usable & regular(moved)
    if not usable.any():
        return None
    top, end = np.zeros(len(skin.joints), dtype=bool), -1
    heavy = [(spans[int(skin.joints[j])], j) for j in np.flatnonzero((skin.weight > 0.0) & (skin.joints >= 0)).tolist()]
    for (first, last), j in sorted(heavy):
        top[j] = first >= end
        end = max(end, last)
    choice = top & usable if (top & usable).any() else usable
    return np.asarray(moved[int(np.argmax(np.where(choice, skin.weight, -1.0)))])


def influences(skin: Skin, which: Floats, weights: Floats, told: Told) -> tuple[Ints, Floats]:
    """(V, 4) joints of a skin and shares that sum to 1, of (V, n) joints and weights as stored; their sum is noted."""
    count = len(skin.joints)
    known = (which >= 0.0) & (which < count)
    sane = (weights >= 0.0) & np.isfinite(weights)
    told.add(NO_JOINT, int((~known & sane & (weights > 0.0)).any(axis=1).sum()))
    told.add(BAD_WEIGHT, int((~sane).any(axis=1).sum()))
    joints = np.where(known, which, 0.0).astype(np.int64)
    shares = np.where(known & sane, weights, 0.0)
    lost = ~(shares > 0.0).any(axis=1)
    told.add(WEIGHTLESS, int(lost.sum()))
    shares[lost, 0] = 1.0
    kept, strong, number = strongest(joints, shares)
    told.add(MANY, int((number > strong.shape[1]).sum()))
    skin.weight += np.bincount(kept.reshape(-1), strong.reshape(-1), count)
    return kept, strong
