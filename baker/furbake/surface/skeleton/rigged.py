"""A still surface with the skeleton of a file: its rig, as if the model had brought it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from furbake.surface.mesh import MeshError, Surface
from furbake.surface.repair.topology import angle_normals
from furbake.surface.rig.at import in_pose
from furbake.surface.rig.kept import shown
from furbake.surface.rig.rig import Channel, Clip, Floats, Rig, RigNode
from furbake.surface.rig.weights import strongest
from furbake.surface.skeleton.heat import heat_weights
from furbake.surface.skeleton.read import read_skeleton
from furbake.surface.skeleton.skeleton import Skeleton, Track

BESIDE = 0.1
"""How far beyond each side of the body's box a joint with skin may stand, share of the largest side."""

LOOPS = 1e-6
"""Difference of a track's first and last key below which its curve goes on from one to the other."""


def with_skeleton(model: str, surface: Surface, path: Path, pose: tuple[str, float] | None = None) -> Surface:
    """The surface with the skeleton in a file as its rig. Raises MeshError with one sentence.

    pose : a clip, by its name or number from 0, and seconds, in place of the pose in which joints stand
    """
    if surface.rig is not None:
        raise MeshError(f"{model}: has joints, clips or morph targets of its own, expected a still model for {path}")
    skeleton = read_skeleton(path)
    _check(skeleton, surface, path)
    rig, idle = _rig(skeleton, surface)
    told = tuple(f"{path}: joint {shown(name)} moves nothing, as no place of the skin sees its bone" for name in idle)
    surface = replace(surface, rig=rig, notices=(*surface.notices, *told))
    if pose is None:
        return surface
    rig = in_pose(str(path), rig, *pose)
    return replace(surface, vertices=rig.posed, normals=angle_normals(rig.posed, rig.faces), rig=rig)


def _check(skeleton: Skeleton, surface: Surface, path: Path) -> None:
    """Raises MeshError where a joint that moves the skin is nowhere near it."""
    margin = BESIDE * surface.extent
    low, high = surface.vertices.min(axis=0) - margin, surface.vertices.max(axis=0) + margin
    for joint in skeleton.joints:
        for key, point in (("at", joint.at), ("to", joint.to)):
            if joint.skin and point is not None and ((point < low) | (point > high)).any():
                box = " to ".join(f"({', '.join(f'{value:.4g}' for value in corner)})" for corner in (low, high))
                raise MeshError(
                    f"{path}: {key} of {shown(joint.name)} is outside of the body, expected a point in {box}"
                )


def _rig(skeleton: Skeleton, surface: Surface) -> tuple[Rig, list[str]]:
    """The rig, and the joints with skin that move nothing."""
    weights = heat_weights(surface, skeleton)
    which, shares, _ = strongest(np.tile(np.arange(weights.shape[1]), (len(weights), 1)), weights)
    moves = np.bincount(which.reshape(-1), shares.reshape(-1), len(skeleton.joints)) > 0.0
    nodes, inverse = [], []
    for joint in skeleton.joints:
        above = skeleton.joints[joint.parent] if joint.parent >= 0 else None
        turn = Rotation.identity() if above is None else above.axes.inv()
        nodes.append(
            RigNode(
                name=joint.name,
                parent=joint.parent,
                translation=turn.apply(joint.at - (np.zeros(3) if above is None else above.at)),
                rotation=(turn * joint.axes).as_quat(canonical=True),
                scale=np.ones(3),
            )
        )
        bind = np.eye(4)
        bind[:3, :3] = joint.axes.inv().as_matrix()
        bind[:3, 3] = -bind[:3, :3] @ joint.at
        inverse.append(bind)
    rig = Rig(
        nodes=tuple(nodes),
        joints=tuple(range(len(nodes))),
        inverse_bind=np.array(inverse),
        vertices=surface.vertices,
        posed=surface.vertices,
        faces=surface.faces,
        which=which,
        shares=shares,
        clips=tuple(Clip(clip.name, tuple(_channel(track, nodes) for track in clip.tracks)) for clip in skeleton.clips),
    )
    return rig, [joint.name for joint, used in zip(skeleton.joints, moves, strict=True) if joint.skin and not used]


def _channel(track: Track, nodes: list[RigNode]) -> Channel:
    """A track as a channel: its keys on top of how the node rests."""
    node, values = nodes[track.joint], track.values
    if track.path == "rotation":
        values = (Rotation.from_quat(node.rotation) * Rotation.from_quat(values)).as_quat()
        flips = np.where(np.einsum("ij,ij->i", values[1:], values[:-1]) < 0.0, -1.0, 1.0)
        values[1:] *= np.cumprod(flips)[:, None]
    elif track.path == "translation":
        values = node.translation + Rotation.from_quat(node.rotation).apply(values)
    if track.interpolation == "CUBICSPLINE":
        slope = _slopes(track.times, values)
        values = np.stack([slope, values, slope], axis=1).reshape(-1, values.shape[1])
    return Channel(track.joint, track.path, track.times, values, track.interpolation)


def _slopes(times: Floats, values: Floats) -> Floats:
    """(K, n) change per second at the keys of a curve without overshoot, which closes where its ends are equal."""
    if len(times) < 2:
        return np.zeros_like(values)
    from scipy.interpolate import PchipInterpolator  # noqa: PLC0415 — 0.1 s, for this alone

    if len(times) > 2 and np.abs(values[0] - values[-1]).max() <= LOOPS * max(np.abs(values).max(), 1e-300):
        span = times[-1] - times[0]
        times = np.concatenate([[times[-2] - span], times, [times[1] + span]])
        values = np.concatenate([values[-2:-1], values, values[1:2]])
        return np.asarray(PchipInterpolator(times, values).derivative()(times))[1:-1]
    return np.asarray(PchipInterpolator(times, values).derivative()(times))
