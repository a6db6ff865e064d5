"""Morph targets of all nodes as one list, and the channels that weigh them as one (glTF 2.0, 3.7.2.2)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from furbake.surface.read.gltf_data import GltfData, Record
from furbake.surface.read.gltf_nodes import text
from furbake.surface.read.gltf_parts import FARTHEST, Part
from furbake.surface.read.moving.told import Told
from furbake.surface.rig.clip import sample
from furbake.surface.rig.rig import BODY, Channel, Target
from furbake.surface.soup import Floats

BETWEEN = 16
"""Pieces between two keys of a CUBICSPLINE that is mixed with other channels."""

BROKEN_TARGET = (
    "morph target of another length or with numbers that are not finite left out",
    "morph targets of another length or with numbers that are not finite left out",
)


@dataclass(frozen=True)
class Morphs:
    """Targets of the scene, those of one node after those of the other.

    width : number of targets of each node in the file; kept : (T,) which of all of them are kept
    names, weights : (T,) of all
    """

    width: dict[int, int]
    kept: NDArray[np.bool_]
    names: tuple[str, ...]
    weights: Floats


def read_morphs(data: GltfData, parts: Sequence[Part], told: Told) -> Morphs:
    """Names and weights of all targets, and which of them are sound."""
    width: dict[int, int] = {}
    of_node: dict[int, list[Part]] = {}
    for part in parts:
        width[part.node] = max(width.get(part.node, 0), len(part.morphs))
        of_node.setdefault(part.node, []).append(part)
    width = {node: number for node, number in width.items() if number}
    names: list[str] = []
    weights: list[float] = []
    kept: list[bool] = []
    for node, number in width.items():
        record = data.list_of("nodes")[node]
        mesh = data.item("meshes", record["mesh"])
        names += _names(mesh, number)
        weights += _weights(record.get("weights", mesh.get("weights")), number)
        for i in range(number):
            shapes = [part.morphs[i] for part in of_node[node] if i < len(part.morphs)]
            broken = any(shape.broken for shape in shapes)
            told.add(BROKEN_TARGET, int(broken))
            kept.append(not broken or any(shape.deltas is not None for shape in shapes))
    return Morphs(width, np.array(kept, dtype=bool), tuple(names), np.array(weights, dtype=np.float64))


def _names(mesh: Record, number: int) -> list[str]:
    extras = mesh.get("extras")
    listed = extras.get("targetNames") if isinstance(extras, dict) else None
    listed = listed if isinstance(listed, list) else []
    return [text(listed[i], str(i)) if i < len(listed) else str(i) for i in range(number)]


def _weights(listed: Any, number: int) -> list[float]:
    listed = listed if isinstance(listed, list) else []
    found = [float(value) if isinstance(value, int | float) else 0.0 for value in listed[:number]]
    found = [value if abs(value) <= FARTHEST else 0.0 for value in found]
    return found + [0.0] * (number - len(found))


def targets(data: GltfData, morphs: Morphs, parts: Sequence[Part], matrices: Sequence[Floats]) -> tuple[Target, ...]:
    """The targets that are kept, over the vertices of all parts.

    matrices : (4, 4) of each part, from its own space to the bind pose
    """
    count = sum(len(part.soup.vertices) for part in parts)
    data.numbers.take(len(morphs.kept) * count * 3)
    deltas = np.zeros((len(morphs.kept), count, 3))
    first = dict(zip(morphs.width, np.cumsum([0, *morphs.width.values()]).tolist(), strict=False))
    start = 0
    for part, matrix in zip(parts, matrices, strict=True):
        rows = slice(start, start + len(part.soup.vertices))
        for i, morph in enumerate(part.morphs):
            if morph.deltas is not None:
                deltas[first[part.node] + i, rows] = morph.deltas @ matrix[:3, :3].T
        start = rows.stop
    named = zip(morphs.names, deltas, morphs.weights.tolist(), morphs.kept.tolist(), strict=True)
    return tuple(Target(name, delta, weight) for name, delta, weight, kept in named if kept)


def body_channel(data: GltfData, morphs: Morphs, channels: Sequence[Channel]) -> Channel | None:
    """One channel of all kept targets for the weights channels of a clip; None where there is none."""
    if not channels or not morphs.kept.any():
        return None
    times, kinds = channels[0].times, {channel.interpolation for channel in channels}
    alike = len(kinds) == 1 and all(np.array_equal(channel.times, times) for channel in channels)
    kind = channels[0].interpolation
    if not alike:
        kind = "STEP" if kinds == {"STEP"} else "LINEAR"
        times = np.unique(np.concatenate([_times(channel, kind) for channel in channels]))
    cubic = kind == "CUBICSPLINE"
    data.numbers.take(len(times) * (3 if cubic else 1) * len(morphs.weights))
    values = np.zeros((len(times), 3 if cubic else 1, len(morphs.weights)))
    values[:, 1 if cubic else 0] = morphs.weights
    first = dict(zip(morphs.width, np.cumsum([0, *morphs.width.values()]).tolist(), strict=False))
    for channel in channels:
        columns = slice(first[channel.node], first[channel.node] + morphs.width[channel.node])
        own = channel.values if alike else sample(channel, times)
        values[:, :, columns] = own.reshape(len(times), values.shape[1], -1)
    return replace(
        channels[0], node=BODY, times=times, values=values[:, :, morphs.kept].reshape(-1, int(morphs.kept.sum())),
        interpolation=kind,
    )  # fmt: skip


def _times(channel: Channel, kind: str) -> Floats:
    """Times at which a channel is sampled so that straight lines, or steps, between them show it."""
    times = channel.times
    if kind == "STEP" or channel.interpolation == "LINEAR" or len(times) < 2:
        return times
    if channel.interpolation == "STEP":
        just_before = np.nextafter(times[1:].astype(np.float32), np.float32(0.0)).astype(np.float64)
        return np.concatenate([times, just_before])
    share = np.arange(BETWEEN) / BETWEEN
    return np.append((times[:-1, None] + share * np.diff(times)[:, None]).reshape(-1), times[-1])
