"""What moves a body, as the writer takes it."""

from __future__ import annotations

from dataclasses import dataclass

from furbake.surface.rig.follow import Follow
from furbake.surface.rig.rig import Rig


@dataclass(frozen=True)
class Motion:
    """What moves a body, and how the vertices follow: of the skin, and of the surface below shells and fins.

    Where the rig has a pose both surfaces are given in it, and stored in the bind pose.
    """

    rig: Rig
    skin: Follow
    ground: Follow
