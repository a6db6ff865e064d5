"""Joints as points and clips as keys, as a file of `--rig` gives them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from furbake.surface.rig.rig import Floats
from furbake.surface.soup import Ints

UP = np.array([0.0, 1.0, 0.0])


@dataclass(frozen=True)
class Joint:
    """A joint.

    parent : index of a joint before it in the skeleton; -1: a root
    at : (3,) model units
    to : (3,) other end of its bone; None: it has a bone to each of its children that move the skin
    forward : (3,) direction of its own z axis, of any length but 0; y is as upright as it can be. Default: +z
    skin : whether it moves the skin; else only what hangs on it
    """

    name: str
    parent: int
    at: Floats
    to: Floats | None = None
    forward: Floats | None = None
    skin: bool = True

    @property
    def axes(self) -> Rotation:
        """Turn from the model's axes to its own."""
        if self.forward is None:
            return Rotation.identity()
        z = self.forward / np.linalg.norm(self.forward)
        x = np.cross(UP, z)
        x = x / np.linalg.norm(x) if np.linalg.norm(x) > 1e-6 else np.array([1.0, 0.0, 0.0])
        return Rotation.from_matrix(np.stack([x, np.cross(z, x), z], axis=1))


@dataclass(frozen=True)
class Track:
    """Keys of a joint, seen from how it rests, in its own axes.

    path : rotation, translation or scale
    times : (K,) seconds, rising
    values : (K, 4) unit quaternions x, y, z, w, or (K, 3) model units or factors
    interpolation : LINEAR, STEP or CUBICSPLINE
    """

    joint: int
    path: str
    times: Floats
    values: Floats
    interpolation: str


@dataclass(frozen=True)
class Motion:
    """A clip by name."""

    name: str
    tracks: tuple[Track, ...]


@dataclass(frozen=True)
class Skeleton:
    """Joints, parents before children, and clips."""

    joints: tuple[Joint, ...]
    clips: tuple[Motion, ...] = ()

    def bones(self) -> tuple[Ints, Floats]:
        """(B,) joints, and (B, 2, 3) ends of the bones that each has; the bone of a leaf may be a point."""
        found = [(i, joint.at, end) for i, joint in enumerate(self.joints) if joint.skin for end in self._ends(i)]
        ends = np.array([[start, end] for _, start, end in found], dtype=np.float64).reshape(-1, 2, 3)
        return np.array([i for i, _, _ in found], dtype=np.int64), ends

    def _ends(self, index: int) -> Iterator[Floats]:
        joint = self.joints[index]
        children = [child.at for child in self.joints if child.parent == index and child.skin]
        yield from [joint.to] if joint.to is not None else children or [joint.at]
