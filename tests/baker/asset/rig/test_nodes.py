"""Nodes of a rig stand where they stood, and what hangs on joints stays in place."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from furbake.surface.place.features import Feature
from furbake.surface.rig.rig import Pose
from helpers.arms import arm, node, turned
from helpers.khronos import errors
from helpers.moving import Moving

EYE = Feature("eye", (3.9, 0.6, 0.2), (0.1, 0.2, 0.3), forward=(0.3, 1.0, 0.2))


def by_name(found: Moving, name: str) -> int:
    return next(i for i, each in enumerate(found.document["nodes"]) if each["name"] == name)


def test_nodes_keep_names_places_and_order(character: Callable[..., Moving]) -> None:
    surface, rig = arm()
    found = character(surface, rig)
    nodes = found.document["nodes"]
    assert [each["name"] for each in nodes] == ["skin", "shells", "fins", "stand", "joint 0", "joint 1", "joint 2"]
    assert found.document["scenes"] == [{"nodes": [0, 3]}]
    assert [each.get("skin") for each in nodes] == [0, 0, 0, None, None, None, None]
    assert found.document["skins"][0]["joints"] == [4, 5, 6]
    worlds = found.worlds()
    for joint, inverse in zip((4, 5, 6), rig.inverse_bind, strict=True):
        np.testing.assert_allclose(worlds[joint] @ inverse, np.eye(4), atol=1e-7)


def test_roots_of_joints_get_one_above_them(character: Callable[..., Moving], tmp_path: Path) -> None:
    surface, rig = arm(targets=False)
    nodes = (*rig.nodes[:3], node("lone", -1, (8 / 3, 0, 0)))
    found = character(surface, replace(rig, nodes=nodes, clips=()))
    assert found.document["nodes"][-1] == {"name": "rig", "children": [3, 6]}
    assert found.document["scenes"] == [{"nodes": [0, 7]}]
    assert errors(tmp_path) == []


def test_matrices_are_kept(character: Callable[..., Moving], tmp_path: Path) -> None:
    surface, rig = arm(targets=False)
    stand = Moving.own({"translation": (0, 1, 0), "rotation": turned((0, 0, 1), 90), "scale": (0.5, 0.5, 0.5)})
    nodes = (replace(rig.nodes[0], matrix=stand), *rig.nodes[1:])
    found = character(surface, replace(rig, nodes=nodes))
    assert set(found.document["nodes"][3]) == {"name", "matrix", "children"}
    np.testing.assert_allclose(found.worlds()[4] @ rig.inverse_bind[0], np.eye(4), atol=1e-7)
    assert errors(tmp_path) == []


def feature_matrix(feature: Feature) -> Any:
    found = np.eye(4)
    found[:3, :3] = feature.axes.T * np.array(feature.radii)
    found[:3, 3] = feature.centre
    return found


def test_features_hang_on_the_joint_below_them(character: Callable[..., Moving], tmp_path: Path) -> None:
    surface, rig = arm()
    nose = replace(EYE, name="nose", centre=(0.1, 0.5, 0.0))
    found = character(surface, rig, features=(EYE, nose))
    eye, last = by_name(found, "eye"), by_name(found, "joint 2")
    assert found.document["nodes"][last]["children"] == [eye]
    assert by_name(found, "nose") in found.document["nodes"][by_name(found, "joint 0")]["children"]
    worlds = found.worlds()
    np.testing.assert_allclose(worlds[eye], feature_matrix(EYE), atol=1e-6)
    np.testing.assert_allclose(worlds[by_name(found, "nose")], feature_matrix(nose), atol=1e-6)
    pose = {last: {"rotation": turned((0, 0, 1), 40)}}
    moved = found.worlds(pose)[last] @ rig.inverse_bind[2]
    np.testing.assert_allclose(found.worlds(pose)[eye], moved @ feature_matrix(EYE), atol=1e-6)
    assert errors(tmp_path) == []


def test_features_of_a_posed_body_stand_in_the_pose(character: Callable[..., Moving]) -> None:
    surface, rig = arm(targets=False)
    turn = Moving.own({"rotation": turned((1, 0, 0), 70), "translation": (0, 0.4, 0)})
    posed = surface.vertices @ turn[:3, :3].T + turn[:3, 3]
    laid = replace(surface, vertices=posed, normals=surface.normals @ turn[:3, :3].T)
    rig = replace(rig, posed=posed, pose=Pose(np.tile(turn, (3, 1, 1)), np.zeros(0)))
    found = character(laid, rig, features=(EYE,))
    eye = found.worlds()[by_name(found, "eye")]
    np.testing.assert_allclose(turn @ eye, feature_matrix(EYE), atol=1e-6)


def test_features_of_a_body_without_joints_stay(character: Callable[..., Moving]) -> None:
    surface, rig = arm()
    alone = replace(rig, nodes=(), joints=(), inverse_bind=np.zeros((0, 4, 4)), which=0 * rig.which, clips=())
    found = character(surface, alone, features=(EYE,))
    assert found.document["scenes"] == [{"nodes": [0, 3]}]
    np.testing.assert_allclose(found.worlds()[3], feature_matrix(EYE), atol=1e-6)
