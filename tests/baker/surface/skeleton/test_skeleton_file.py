"""The file of `--rig`: what it says, and a sentence for each mistake."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from furbake.surface.mesh import MeshError
from furbake.surface.skeleton.read import read_skeleton

HIP, HEAD = {"name": "hip", "at": [0, 0, 0]}, {"name": "head", "parent": "hip", "at": [0, 1, 0]}
NOD = {"joint": "head", "path": "rotation", "times": [0, 1], "values": [[0, 0, 0], [30, 0, 0]]}


@pytest.fixture
def file(tmp_path: Path) -> Callable[[Any], Path]:
    def write(content: Any) -> Path:
        path = tmp_path / "rig.json"
        path.write_text(content if isinstance(content, str) else json.dumps(content))
        return path

    return write


def with_track(**change: Any) -> dict[str, Any]:
    return {"joints": [HIP, HEAD], "clips": [{"name": "nod", "tracks": [NOD | change]}]}


def test_joints_are_read_parents_first(file: Callable[[Any], Path]) -> None:
    more = {"to": [0, 2, 0], "forward": [1, 0, 0], "skin": False}
    found = read_skeleton(file({"joints": [HEAD | more, HIP]}))
    hip, head = found.joints
    assert (hip.name, hip.parent, hip.to, hip.skin) == ("hip", -1, None, True)
    assert (head.name, head.parent, head.skin) == ("head", 0, False)
    assert head.to is not None
    np.testing.assert_array_equal(head.to, [0, 2, 0])
    # z is forward, y up, x to its left.
    np.testing.assert_allclose(head.axes.apply(np.eye(3)), [[0, 0, -1], [0, 1, 0], [1, 0, 0]], atol=1e-12)
    assert found.clips == ()


def test_turns_are_degrees_or_quaternions(file: Callable[[Any], Path]) -> None:
    values = [[0, 90, 0], [0, 0, 2, 0], [90, 90, 0]]
    (clip,) = read_skeleton(file(with_track(times=[0, 1, 2], values=values))).clips
    turns = clip.tracks[0].values
    half = np.sqrt(0.5)
    np.testing.assert_allclose(np.abs(turns[0]), [0, half, 0, half], atol=1e-12)
    np.testing.assert_allclose(np.abs(turns[1]), [0, 0, 1, 0], atol=1e-12)
    # The nod of a head that has turned: about its own x, so +z goes down along the body's y.
    x, y, z, w = turns[2]
    forward = np.array([2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)])
    np.testing.assert_allclose(forward, [0, -1, 0], atol=1e-12)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("{", "not JSON (Expecting property name"),
        ([], 'no list of joints, expected {"joints": [...], "clips": [...]}'),
        ({"joints": {}}, "no list of joints, expected"),
        ({"joints": []}, "no joints, expected 1 to 256"),
        ({"joints": [HIP] * 257}, "257 joints, expected at most 256"),
        ({"joints": [HIP], "bones": []}, '"bones" is unknown, expected only joints, clips'),
        ({"joints": [3]}, "joints[0] is 3, expected an object"),
        ({"joints": [HIP | {"head": 1}]}, 'joints[0]: "head" is unknown, expected only name, parent, at, to'),
        ({"joints": [{"at": [0, 0, 0]}]}, "joints[0].name is null, expected text"),
        ({"joints": [HIP, HIP]}, 'joints[1].name is "hip", which joints[0] has, expected another'),
        ({"joints": [HIP, HEAD | {"parent": "tail"}]}, 'joints[1].parent is "tail", expected the name of a joint'),
        ({"joints": [HIP, HEAD | {"parent": 0}]}, "joints[1].parent is 0, expected the name of a joint"),
        ({"joints": [HIP | {"parent": "head"}, HEAD]}, "joints[0] is its own parent in the end, expected parents"),
        ({"joints": [HIP | {"parent": "hip"}]}, "joints[0] is its own parent in the end"),
        ({"joints": [{"name": "hip"}]}, "joints[0] has no at, expected three numbers"),
        ({"joints": [HIP | {"at": [0, 1]}]}, "joints[0].at is [0, 1], expected three numbers"),
        ({"joints": [HIP | {"at": [0, True, 1]}]}, "joints[0].at is [0, true, 1], expected three numbers"),
        ('{"joints": [{"name": "hip", "at": [NaN, 0, 0]}]}', "joints[0].at is [NaN, 0, 0], expected three numbers"),
        ('{"joints": [{"name": "hip", "at": [1e999, 0, 0]}]}', "joints[0].at is [Infinity, 0, 0], expected three"),
        ({"joints": [HIP | {"forward": [0, 0, 0]}]}, "joints[0].forward is [0, 0, 0], expected a direction"),
        ({"joints": [HIP | {"skin": 1}]}, "joints[0].skin is 1, expected true or false"),
        ({"joints": [HIP | {"skin": False}]}, "no joint moves the skin, expected one without skin: false"),
        ({"joints": [HIP], "clips": {}}, "clips is {}, expected a list"),
        ({"joints": [HIP], "clips": [{}] * 65}, "65 clips, expected at most 64"),
        ({"joints": [HIP], "clips": [{"name": "a", "tracks": []}]}, "clips[0] has no tracks, expected a list of at"),
        (with_track(joint="wing"), 'clips[0].tracks[0].joint is "wing", expected the name of a joint'),
        (with_track(path="turn"), 'clips[0].tracks[0].path is "turn", expected one of rotation, translation, scale'),
        (with_track(interpolation="EASE"), 'tracks[0].interpolation is "EASE", expected one of LINEAR, STEP, CUBIC'),
        (with_track(times=[]), "tracks[0].times is [], expected a list of 1 to 10000 seconds"),
        (with_track(times=[1, 1]), "tracks[0].times is [1, 1], expected rising seconds from 0"),
        (with_track(times=[-1, 1]), "tracks[0].times is [-1, 1], expected rising seconds from 0"),
        (with_track(times=[0, "1"]), 'tracks[0].times is [0, "1"], expected numbers'),
        (with_track(values=[[0, 0, 0]]), "tracks[0] has 1 values at 2 times, expected as many"),
        (with_track(values=[[0, 0, 0], [0, 0]]), "values[1] is [0, 0], expected three numbers or a quaternion of four"),
        (with_track(values=[[0, 0, 0], [0, 0, 0, 0]]), "values[1] is [0, 0, 0, 0], expected a quaternion that is not"),
        (with_track(path="scale", values=[[1, 1, 1], 2]), "values[1] is 2, expected three numbers"),
        (with_track(speed=2), 'tracks[0]: "speed" is unknown, expected only joint, path, times'),
        (
            {"joints": [HIP, HEAD], "clips": [{"name": "a", "tracks": [NOD]}, {"name": "a", "tracks": [NOD]}]},
            'clips[1].name is "a", which another clip has, expected another',
        ),
        (
            {"joints": [HIP, HEAD], "clips": [{"name": "a", "tracks": [NOD, NOD]}]},
            "clips[0].tracks[1] is the second rotation of head, expected one",
        ),
    ],
)
def test_each_mistake_has_its_sentence(file: Callable[[Any], Path], content: Any, message: str) -> None:
    path = file(content)
    with pytest.raises(MeshError) as error:
        read_skeleton(path)
    assert str(error.value).startswith(f"{path}: ")
    assert message in str(error.value)
    assert "\n" not in str(error.value)


def test_files_that_are_none(tmp_path: Path) -> None:
    with pytest.raises(MeshError, match=r"no such file or directory, expected .*joints"):
        read_skeleton(tmp_path / "none.json")
    (tmp_path / "deep.json").write_text("[" * 100_000)
    with pytest.raises(MeshError, match="not JSON"):
        read_skeleton(tmp_path / "deep.json")
