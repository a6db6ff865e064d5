"""Everything that moves the scene of a glTF file, as one rig: joints, morph targets and clips."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from furbake.surface.read.gltf_data import GltfData
from furbake.surface.read.gltf_parts import Part
from furbake.surface.read.moving.clips import NOTHING, FileClip, read_clips
from furbake.surface.read.moving.joints import read_joints, rig_nodes
from furbake.surface.read.moving.morphs import Morphs, body_channel, read_morphs, targets
from furbake.surface.read.moving.told import Told
from furbake.surface.rig.pose import matrices, posed, rest
from furbake.surface.rig.rig import BODY, Channel, Clip, Pose, Rig
from furbake.surface.soup import Floats, Soup

PER_VERTEX = 8
"""Numbers of a vertex's joints and shares."""

APART = 0.01
"""Share of the largest side by which rest pose and bind pose may differ without a word."""

EMPTY_CLIP = "clip that moves nothing of the body left out", "clips that move nothing of the body left out"


@dataclass(frozen=True)
class Moving:
    """All that moves a scene, before its parts are placed.

    binds : (4, 4) of each part, from its own space to the bind pose of the scene
    rig : without its vertices; None where nothing moves
    """

    binds: list[Floats]
    rig: Rig | None
    notices: tuple[str, ...]

    def whole(self, soup: Soup | None) -> tuple[Rig | None, tuple[str, ...]]:
        """The rig of the scene's triangles in the bind pose, with all notices."""
        if self.rig is None or soup is None:
            return None, self.notices
        rig = replace(self.rig, vertices=soup.vertices, posed=soup.vertices, faces=soup.faces)
        return rig, (*self.notices, *_other_rest(rig))


def rigged(data: GltfData, places: dict[int, Floats], parents: dict[int, int], parts: Sequence[Part]) -> Moving:
    """All that moves the parts of a scene.

    places, parents : of every node of the scene; parents first in the second
    """
    told = Told()
    morphs = read_morphs(data, parts, told)
    clips = read_clips(data, morphs.width, set(places), told)
    moved = {channel.node for clip in clips for channel in clip.channels if channel.path != "weights"}
    joints = read_joints(data, places, parents, parts, moved, told)
    if not joints.nodes and not morphs.kept.any():
        _clips(data, clips, {}, morphs, told)
        return Moving(joints.binds, None, told.lines())
    data.numbers.take(PER_VERTEX * sum(len(part.soup.vertices) for part in parts))
    nodes, index = rig_nodes(data, parents, joints, moved, told)
    nothing = np.zeros((0, 3))
    rig = Rig(
        nodes=nodes,
        joints=tuple(index[node] for node in joints.nodes),
        inverse_bind=np.array(joints.inverse_bind).reshape(-1, 4, 4),
        vertices=nothing,
        posed=nothing,
        faces=nothing.astype(np.int64),
        which=np.concatenate(joints.which),
        shares=np.concatenate(joints.shares),
        targets=targets(data, morphs, parts, joints.binds),
        clips=_clips(data, clips, index, morphs, told),
    )
    return Moving(joints.binds, rig, told.lines())


def _clips(
    data: GltfData, clips: Sequence[FileClip], index: dict[int, int], morphs: Morphs, told: Told
) -> tuple[Clip, ...]:
    """The clips that move something of the rig."""
    found = []
    for clip in clips:
        weights = body_channel(data, morphs, [channel for channel in clip.channels if channel.path == "weights"])
        channels: list[Channel] = []
        for channel in clip.channels:
            if channel.path == "weights":
                if weights is not None and not any(one.node == BODY for one in channels):
                    channels.append(weights)
            elif channel.node in index:
                channels.append(replace(channel, node=index[channel.node]))
            else:
                told.add(NOTHING)
        if channels:
            found.append(Clip(clip.name, tuple(channels)))
        else:
            told.add(EMPTY_CLIP)
    return tuple(found)


def _other_rest(rig: Rig) -> tuple[str, ...]:
    """A notice where the file rests in another pose than the one that it is bound in."""
    resting = posed(rig, Pose(matrices(rig, rest(rig)), np.zeros(len(rig.targets))))
    apart = float(np.abs(resting - rig.vertices).max(initial=0.0))
    size = float(np.ptp(rig.vertices, axis=0).max())
    if not apart > APART * size:
        return ()
    return (f"fur is laid in the bind pose, {100 * apart / size:.0f} % of the size away from the rest pose",)
