"""The pose of a clip at a time."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from furbake.surface.rig.clip import sample
from furbake.surface.rig.kept import listed, shown
from furbake.surface.rig.pose import local, matrices, posed, rest
from furbake.surface.rig.rig import BODY, Clip, Pose, Rig
from furbake.surface.soup import MeshError

DIGITS = 10
"""Digits of a clip's number, fewer than this."""

ROUNDED = 1e-5
"""How far beyond the end of a clip a time may be, share of it: as far as its figure in a message is rounded."""


def in_pose(model: str, rig: Rig | None, clip: str, seconds: float) -> Rig:
    """The rig in the pose of a clip, by its name or number from 0, at a time.

    Raises MeshError, beginning with the model's name, where it has no such clip, or one that ends before.
    """
    if rig is None or not rig.clips:
        raise MeshError(f"{model}: has no clips, expected the clip {shown(clip)} of the pose")
    found = _clip(model, rig, clip)
    end = max((float(channel.times[-1]) for channel in found.channels), default=0.0)
    if seconds > end * (1.0 + ROUNDED):
        raise MeshError(f"{model}: {seconds:g} s of the clip {shown(clip)}, expected 0 to {end:g}")
    with np.errstate(all="ignore"):
        pose = pose_at(rig, found, seconds)
        return replace(rig, pose=pose, posed=posed(rig, pose))


def pose_at(rig: Rig, clip: Clip, seconds: float) -> Pose:
    """The pose of a clip at a time; what it does not move stands as it rests."""
    own = rest(rig)
    weights = np.array([target.weight for target in rig.targets], dtype=np.float64)
    moved: dict[int, dict[str, np.ndarray[tuple[int, ...], np.dtype[np.float64]]]] = {}
    for channel in clip.channels:
        value = sample(channel, np.array([seconds]))[0]
        if channel.node == BODY:
            weights = value
        else:
            moved.setdefault(channel.node, {})[channel.path] = value
    for index, values in moved.items():
        node = rig.nodes[index]
        whole = {"translation": node.translation, "rotation": node.rotation, "scale": node.scale, **values}
        own[index] = local(whole["translation"], whole["rotation"], whole["scale"])
    return Pose(matrices(rig, own), weights)


def _clip(model: str, rig: Rig, name: str) -> Clip:
    """A clip by its name, else by its number from 0."""
    named = [clip for clip in rig.clips if clip.name == name]
    if named:
        return named[0]
    if name.isascii() and name.isdigit() and len(name) < DIGITS and int(name) < len(rig.clips):
        return rig.clips[int(name)]
    names = listed([clip.name or str(i) for i, clip in enumerate(rig.clips)])
    raise MeshError(f"{model}: has no clip {shown(name)}, expected one of {names}")
