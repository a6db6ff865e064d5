"""What moves a body, as the writer takes it."""

from __future__ import annotations

from dataclasses import dataclass

from furbake.surface.rig.follow import Follow
from furbake.surface.rig.rig import Floats, Rig

@dataclass(frozen=True)
class Stance:
    """The pose in which fur was laid, where that is not the bind pose.

    matrices : (J, 4, 4) from the bind pose to this one, of each joint
    weights : (T,) of the morph targets
    """

    matrices: Floats
    weights: Floats


@dataclass(frozen=True)
class Motion:
    """What moves a body.

    rig : nodes, joints, targets and clips
    skin, ground : how the vertices follow it: of the skin, and of the surface below shells and fins
    stance : pose in which both surfaces are given; None: the bind pose
    """

    rig: Rig
    skin: Follow
    ground: Follow
    stance: Stance | None = None
