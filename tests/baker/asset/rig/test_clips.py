"""Clips are stored as they are given."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from furbake.surface.rig.rig import Clip
from helpers.arms import arm
from helpers.moving import Moving


def test_clips_hold_the_given_keys(character: Callable[..., Moving]) -> None:
    surface, rig = arm()
    found = character(surface, rig)
    start = len(found.document["nodes"]) - len(rig.nodes)
    animations = found.document["animations"]
    assert [each["name"] for each in animations] == ["bend", "sway", "shapes"]
    for clip, stored in zip(rig.clips, animations, strict=True):
        for channel, record in zip(clip.channels, stored["channels"], strict=True):
            sampler = stored["samplers"][record["sampler"]]
            assert record["target"]["path"] == channel.path
            assert record["target"]["node"] == (0 if channel.path == "weights" else start + channel.node)
            assert sampler["interpolation"] == channel.interpolation
            times, values = found.document["accessors"][sampler["input"]], found.values(sampler["output"])
            assert (times["min"], times["max"]) == ([channel.times[0]], [channel.times[-1]])
            np.testing.assert_allclose(found.values(sampler["input"])[:, 0], channel.times, rtol=1e-7)
            np.testing.assert_allclose(values.reshape(channel.values.shape), channel.values, rtol=1e-6, atol=1e-7)


def test_equal_keys_are_stored_once(character: Callable[..., Moving]) -> None:
    surface, rig = arm()
    bend = rig.clips[0]
    one, two = (character(surface, replace(rig, clips=clips)).document for clips in ((bend,), (bend, bend)))
    assert len(one["accessors"]) == len(two["accessors"])


def test_a_clip_without_channels_is_left_out(character: Callable[..., Moving]) -> None:
    surface, rig = arm()
    found = character(surface, replace(rig, clips=(Clip("none", ()), rig.clips[0])))
    assert [each["name"] for each in found.document["animations"]] == ["bend"]
    assert "animations" not in character(surface, replace(rig, clips=())).document


@pytest.mark.parametrize("seconds", [0.0, 0.3, 0.8, 1.25])
def test_the_skin_follows_its_clip(character: Callable[..., Moving], seconds: float) -> None:
    surface, rig = arm(joints=1, targets=False)
    found = character(surface, rig)
    pose = found.clip(0, seconds)
    world = found.worlds(pose)[found.document["skins"][0]["joints"][0]]
    moved = surface.vertices @ world[:3, :3].T + world[:3, 3]
    np.testing.assert_allclose(found.posed(0, pose=pose)["POSITION"], moved, atol=2e-4)
