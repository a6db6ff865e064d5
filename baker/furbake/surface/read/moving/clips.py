"""Clips of a glTF file: channels whose keys can be played (glTF 2.0, 3.11)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from furbake.surface.read.gltf_data import BROKEN, GltfData, Record
from furbake.surface.read.gltf_nodes import text
from furbake.surface.read.moving.told import Told
from furbake.surface.rig.rig import Channel
from furbake.surface.soup import Floats, Ints, MeshError

WIDTHS = {"translation": 3, "rotation": 4, "scale": 3, "weights": 1}

FARTHEST = 1e9
"""Seconds and values beyond this are taken for broken ones."""

LONG = 0.005
"""Rotations whose length is farther from 1 than this are made unit ones; integers are not nearer."""

SHORT = 1e-6
"""Rotations shorter than this turn nowhere."""

BROKEN_CHANNEL = "channel that cannot be read left out", "channels that cannot be read left out"
UNKNOWN = (
    "channel of another path than node transforms and weights left out",
    ("channels of other paths than node transforms and weights left out"),
)
NOTHING = "channel that moves nothing of the body left out", "channels that move nothing of the body left out"
TWICE = "channel left out that its clip has twice", "channels left out that their clips have twice"
KEYS = (
    "key of a clip that is not finite or does not follow the one before it left out",
    "keys of clips that are not finite or do not follow the one before them left out",
)


@dataclass(frozen=True)
class FileClip:
    """A clip as it is in the file: `Channel.node` is a node of the file, weights are those of its mesh."""

    name: str
    channels: tuple[Channel, ...]


class _Keys:
    """Numbers of accessors, each read once."""

    def __init__(self, data: GltfData) -> None:
        self.data = data
        self._found: dict[int, Floats] = {}

    def __getitem__(self, index: Any) -> Floats:
        if index not in self._found:
            self._found[index] = self.data.accessor(index)
        return self._found[index]


def read_clips(data: GltfData, targets: dict[int, int], nodes: set[int], told: Told) -> list[FileClip]:
    """All clips, with the channels that can be played.

    targets : number of morph targets of the nodes that have some; nodes : those of the scene
    """
    keys = _Keys(data)
    found = []
    for record in data.list_of("animations"):
        known = isinstance(record, dict)
        listed = record.get("channels", []) if known else []
        channels: dict[tuple[int, str], Channel] = {}
        for one in listed if isinstance(listed, list) else []:
            channel = _channel(record, one, keys, targets, nodes, told)
            if channel is None:
                continue
            if (channel.node, channel.path) in channels:
                told.add(TWICE)
            channels.setdefault((channel.node, channel.path), channel)
        name = record.get("name") if known else None
        found.append(FileClip(text(name), tuple(channels.values())))
    return found


def _channel(
    clip: Record, record: Any, keys: _Keys, targets: dict[int, int], nodes: set[int], told: Told
) -> Channel | None:
    try:
        path, node = record["target"].get("path"), record["target"].get("node")
        if path not in WIDTHS:
            told.add(UNKNOWN)
            return None
        if type(node) is not int or node not in nodes or (path == "weights" and node not in targets):
            told.add(NOTHING)
            return None
        width = targets[node] if path == "weights" else WIDTHS[path]
        sampler = clip["samplers"][_index(record["sampler"])]
        kind = sampler.get("interpolation", "LINEAR")
        times, values = keys[_index(sampler["input"])], keys[_index(sampler["output"])]
        rows = len(times) * (3 if kind == "CUBICSPLINE" else 1)
        wrong = kind not in ("LINEAR", "STEP", "CUBICSPLINE") or times.shape[1] != 1 or not rows
        if wrong or values.shape[1] != WIDTHS[path] or values.size != rows * width:
            raise ValueError("numbers of another shape")
        keys.data.numbers.take(times.size + values.size)
    except MeshError:
        raise
    except BROKEN:
        told.add(BROKEN_CHANNEL)
        return None
    channel = _cleaned(Channel(node, path, times[:, 0], values.reshape(rows, width), kind), told)
    if channel is None:
        told.add(BROKEN_CHANNEL)
    return channel


def _index(number: Any) -> int:
    """A place in a list; Python's negative ones are none. Raises ValueError."""
    if type(number) is not int or number < 0:
        raise ValueError(f"the number {number}")
    return number


def _cleaned(channel: Channel, told: Told) -> Channel | None:
    """The channel with the keys that are finite and follow each other; None where there is none."""
    times, kind = channel.times, channel.interpolation
    cubic = kind == "CUBICSPLINE"
    values = channel.values.reshape(len(times), 3 if cubic else 1, -1)
    own = values[:, 1] if cubic else values[:, 0]
    length = np.linalg.norm(own, axis=1) if channel.path == "rotation" else np.ones(len(times))
    good = (times >= 0.0) & (times <= FARTHEST) & (np.abs(own) <= FARTHEST).all(axis=1) & (length > SHORT)
    # A tangent that is not finite is flat: those outside of the first and last key are often left as they were.
    values = np.where(np.abs(values) <= FARTHEST, values, 0.0)
    good &= times >= np.maximum.accumulate(np.where(good, times, -1.0))
    times, values, length = times[good], values[good], length[good]
    times, rising = _rising(times, values)
    told.add(KEYS, len(good) - len(rising))
    if not len(times):
        return None
    values, length = values[rising], length[rising]
    if channel.path == "rotation" and not cubic:
        far = np.abs(length - 1.0) > LONG
        values[far] /= length[far, None, None]
    if cubic and len(times) < 2:
        values, kind = values[:, 1:2], "LINEAR"
    return Channel(channel.node, channel.path, times, values.reshape(-1, values.shape[2]), kind)


def _rising(times: Floats, values: Floats) -> tuple[Floats, Ints]:
    """Times that rise, and which of the keys they belong to, of (K,) that do not fall.

    Of keys at one time the first is kept and, a moment later, the last if it is another one: the value jumps.
    """
    if not len(times):
        return times, np.zeros(0, dtype=np.int64)
    first = np.flatnonzero(np.append(True, np.diff(times) > 0.0))
    last = np.append(first[1:], len(times)) - 1
    later = np.nextafter(times[last].astype(np.float32), np.float32(np.inf)).astype(np.float64)
    other = (values[last] != values[first]).any(axis=(1, 2))
    jumps = other & (later < np.append(times[first[1:]], np.inf))
    moved = times.copy()
    moved[last[jumps]] = later[jumps]
    kept = np.union1d(first, last[jumps])
    return moved[kept], kept
