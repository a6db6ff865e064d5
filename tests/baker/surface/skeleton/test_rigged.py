"""A still model with the skeleton of a file, from the surface to the baked folder."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from furbake.asset.validate import validate
from furbake.surface.mesh import MeshError, load_mesh
from furbake.surface.rig.clip import sample
from furbake.surface.rig.pose import rest, world
from furbake.surface.shapes import builtin
from furbake.surface.skeleton.rigged import with_skeleton
from helpers.characters import bent_tube
from helpers.command import TINY
from helpers.khronos import errors
from helpers.moving import Moving

SWAY = {"joint": "top", "path": "rotation", "times": [0, 1, 2], "values": [[0, 0, 0], [0, 0, 30], [0, 0, 0]]}
BALL = {
    "joints": [
        {"name": "low", "at": [0, -0.9, 0], "to": [0, 0, 0], "forward": [1, 0, 1]},
        {"name": "top", "parent": "low", "at": [0, 0.1, 0], "to": [0, 0.9, 0], "forward": [1, 0, 0]},
    ],
    "clips": [{"name": "sway", "tracks": [SWAY]}],
}


def rig_file(content: Any, path: Path) -> Path:
    path.write_text(json.dumps(content))
    return path


def test_joints_rest_where_the_file_has_them(tmp_path: Path) -> None:
    rig = with_skeleton("ball", builtin("sphere"), rig_file(BALL, tmp_path / "rig.json")).rig
    assert rig is not None
    stand = world(rig, rest(rig))
    np.testing.assert_allclose(stand[:, :3, 3], [[0, -0.9, 0], [0, 0.1, 0]], atol=1e-12)
    np.testing.assert_allclose(stand[1, :3, 2], [1, 0, 0], atol=1e-12)
    np.testing.assert_allclose(stand @ rig.inverse_bind, np.tile(np.eye(4), (2, 1, 1)), atol=1e-12)


@pytest.mark.parametrize("kind", ["LINEAR", "STEP", "CUBICSPLINE"])
def test_keys_lie_on_top_of_how_a_joint_rests(tmp_path: Path, kind: str) -> None:
    lift = {"joint": "top", "path": "translation", "times": [0, 2], "values": [[0, 0, 0], [0, 0, 0.5]]}
    tracks = [SWAY | {"interpolation": kind}, lift | {"interpolation": kind}]
    content = BALL | {"clips": [{"name": "sway", "tracks": tracks}]}
    rig = with_skeleton("ball", builtin("sphere"), rig_file(content, tmp_path / "rig.json")).rig
    assert rig is not None
    turn, place = rig.clips[0].channels
    node = rig.nodes[1]
    np.testing.assert_allclose(sample(turn, np.array([0.0, 2.0])), [node.rotation] * 2, atol=1e-12)
    # Along its own z, which is +x of the model.
    moved = sample(place, np.array([2.0]))[0] - node.translation
    np.testing.assert_allclose(world(rig, rest(rig))[0, :3, :3] @ moved, [0.5, 0, 0], atol=1e-12)


def test_a_curve_closes_and_does_not_overshoot(tmp_path: Path) -> None:
    grow = {"joint": "top", "path": "scale", "times": [0, 1, 1.5, 3], "values": [[1] * 3, [2] * 3, [2] * 3, [1] * 3]}
    content = BALL | {"clips": [{"name": "grow", "tracks": [grow | {"interpolation": "CUBICSPLINE"}]}]}
    rig = with_skeleton("ball", builtin("sphere"), rig_file(content, tmp_path / "rig.json")).rig
    assert rig is not None
    channel = rig.clips[0].channels[0]
    times = np.linspace(0, 3, 3001)
    curve = sample(channel, times)[:, 0]
    assert curve.min() > 1 - 1e-9
    assert curve.max() < 2 + 1e-9
    speed = np.gradient(curve, times)
    assert abs(speed[1] - speed[-2]) < 1e-2
    assert np.abs(np.diff(speed)).max() < 0.02


def test_a_model_that_moves_is_refused(tmp_path: Path) -> None:
    path = bent_tube().write(tmp_path)
    with pytest.raises(MeshError, match=r"has joints, clips or morph targets of its own, expected a still model for"):
        with_skeleton(str(path), load_mesh(path), rig_file(BALL, tmp_path / "rig.json"))


@pytest.mark.parametrize("key", ["at", "to"])
def test_a_joint_far_away_is_refused(tmp_path: Path, key: str) -> None:
    joints = [BALL["joints"][0], BALL["joints"][1] | {key: [0, 90, 0]}]
    path = rig_file({"joints": joints}, tmp_path / "rig.json")
    with pytest.raises(MeshError) as error:
        with_skeleton("ball", builtin("sphere"), path)
    assert str(error.value).startswith(
        f"{path}: {key} of top is outside of the body, expected a point in (-1.2, -1.2, -1.2)"
    )
    near = {"joints": [BALL["joints"][0], BALL["joints"][1] | {key: [0.1, 1.19, 1.19]}]}
    assert with_skeleton("ball", builtin("sphere"), rig_file(near, path)).rig is not None
    still = {"joints": [*BALL["joints"], {"name": "lamp", "at": [0, 90, 0], "skin": False}]}
    assert with_skeleton("ball", builtin("sphere"), rig_file(still, path)).rig is not None


def test_a_joint_that_moves_nothing_is_told(tmp_path: Path) -> None:
    joints = [*BALL["joints"], {"name": "ghost", "at": [1.05, 0, 0]}]
    path = rig_file({"joints": joints}, tmp_path / "rig.json")
    told = with_skeleton("ball", builtin("sphere"), path).notices
    assert told == (f"{path}: joint ghost moves nothing, as no place of the skin sees its bone",)


def test_a_bake_moves_by_its_file(run: Callable[..., Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    rig_file(BALL, Path("rig.json"))
    lid = {"name": "lid", "shape": "half", "centre": [0.9, 0, 0], "radii": [0.1, 0.1, 0.1], "joint": "top"}
    Path("face.json").write_text(json.dumps({"features": [lid]}))
    bake = ("bake", "sphere", "-o", "out", *TINY, "--rig", "rig.json", "--no-meshopt", "--if-stale")
    assert run(*bake, "--features", "face.json").status == 0
    assert validate(Path("out")) == []
    assert errors(tmp_path / "out") == []
    asset = Moving(Path("out/model.gltf"))
    document = asset.document
    assert document["extensions"]["FUR_ptm_shells"]["version"] == "2.1"
    names = [node["name"] for node in document["nodes"]]
    top = document["nodes"][names.index("top")]
    assert names.index("lid") in top["children"]
    still, moved = ({**asset.clip(0, seconds)} for seconds in (0.0, 1.0))
    one, two = (asset.posed(0, pose=pose)["POSITION"] for pose in (still, moved))
    high, low = one[:, 1] > 0.8, one[:, 1] < -0.8
    assert np.linalg.norm(two[low] - one[low], axis=1).max() < 0.12
    assert np.linalg.norm(two[high] - one[high], axis=1).min() > 0.3
    assert document["extensions"]["FUR_ptm_shells"]["fins"] == 2
    # The same again is fresh; another file of joints is not.
    assert "up to date" in run(*bake, "--features", "face.json").out
    rig_file(BALL | {"clips": []}, Path("rig.json"))
    packed = [word for word in bake if word != "--no-meshopt"]
    assert "up to date" not in run(*packed, "--features", "face.json").out
    document = json.loads(Path("out/model.gltf").read_text())
    assert "animations" not in document
    # Fins of a body with joints are edges, too.
    fur = document["extensions"]["FUR_ptm_shells"]
    assert (fur["version"], "fins" in fur, "edges" in fur) == ("2.3", False, True)
    assert validate(Path("out")) == []


def test_fur_is_laid_in_a_pose_of_its_clips(
    run: Callable[..., Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    rig_file(BALL, Path("rig.json"))
    bake = ("bake", "sphere", "-o", "out", *TINY, "--rig", "rig.json", "--no-meshopt")
    assert run(*bake, "--pose", "sway@1").status == 0
    assert validate(Path("out")) == []
    asset = Moving(Path("out/model.gltf"))
    radius = np.linalg.norm(asset.posed(0)["POSITION"], axis=1)
    np.testing.assert_allclose(radius, 1.0, atol=0.01)
    done = run(*bake, "--pose", "run@1", "--force")
    assert done.err == "furbake: error: rig.json: has no clip run, expected one of sway\n"


def test_a_feature_hangs_on_a_joint_that_there_is(
    run: Callable[..., Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    rig_file(BALL, Path("rig.json"))
    Path("face.json").write_text(json.dumps({"features": [{"centre": [1, 0, 0], "radii": [1, 1, 1], "joint": "jaw"}]}))
    bake = ("bake", "sphere", "-o", "out", *TINY, "--features", "face.json")
    assert run(*bake, "--rig", "rig.json").err.endswith(
        "face.json: features[0].joint is jaw, expected one of low, top\n"
    )
    assert "features[0].joint is jaw, expected none, as nothing moves the model" in run(*bake).err
