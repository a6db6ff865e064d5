"""Clips as glTF's animations."""

from __future__ import annotations

from typing import Any

import numpy as np

from furbake.asset.mesh.buffer import Buffer
from furbake.surface.rig.rig import BODY, Channel, Clip, Floats

Record = dict[str, Any]

KINDS = {"translation": "VEC3", "rotation": "VEC4", "scale": "VEC3", "weights": "SCALAR"}
"""Type of an accessor's elements by the path of its channel."""


def animations(clips: tuple[Clip, ...], start: int, body: int, buffer: Buffer) -> list[Record]:
    """An animation per clip that has channels; accessors of equal numbers are shared.

    start : number of the rig's first node; body : node whose mesh has the morph targets
    """
    stored: dict[tuple[str, bytes], int] = {}

    def accessor(values: Floats, kind: str, bounds: bool = False) -> int:
        key = kind, np.asarray(values, dtype="<f4").tobytes()
        if key not in stored:
            stored[key] = buffer.floats(values, kind, bounds)
        return stored[key]

    def sampler(channel: Channel) -> Record:
        rows = channel.values.reshape(-1, 1) if channel.path == "weights" else channel.values
        return {
            "input": accessor(channel.times.reshape(-1, 1), "SCALAR", bounds=True),
            "interpolation": channel.interpolation,
            "output": accessor(rows, KINDS[channel.path]),
        }

    def target(channel: Channel) -> Record:
        return {"node": body if channel.node == BODY else start + channel.node, "path": channel.path}

    return [
        {
            "name": clip.name.encode("utf-8", "replace").decode(),
            "channels": [{"sampler": i, "target": target(channel)} for i, channel in enumerate(clip.channels)],
            "samplers": [sampler(channel) for channel in clip.channels],
        }
        for clip in clips
        if clip.channels
    ]
