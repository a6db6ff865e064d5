"""Written characters move as plain sums over their rig do."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from furbake.surface.mesh import simplify
from furbake.surface.rig.rig import Rig, Target
from helpers.arms import arm, shapes
from helpers.gltf import lapped
from helpers.khronos import errors
from helpers.moving import Moving

SKIN, SHELLS, FINS = 0, 1, 2
BYTE_WEIGHTS = 1.5 / 255
"""Displacement that weights in bytes may cause, model units."""


def worlds(rig: Rig, moved: dict[int, dict[str, Any]]) -> list[Any]:
    """Matrix of every node of a rig in the scene, some of its numbers replaced."""
    found: list[Any] = []
    for i, node in enumerate(rig.nodes):
        record = {"translation": node.translation, "rotation": node.rotation, "scale": node.scale}
        own = Moving.own(record, moved.get(i))
        found.append(own if node.parent < 0 else found[node.parent] @ own)
    return found


def expected(rig: Rig, moved: dict[int, dict[str, Any]], weights: Any) -> Any:
    """(N, 3) places of the rig's own vertices, by its own shares."""
    places = rig.vertices + sum(w * t.deltas for w, t in zip(weights, rig.targets, strict=True))
    nodes = worlds(rig, moved)
    total = np.zeros_like(places)
    for k in range(4):
        matrices = np.array([nodes[rig.joints[j]] @ rig.inverse_bind[j] for j in rig.which[:, k]])
        total += rig.shares[:, k, None] * (np.einsum("vij,vj->vi", matrices[:, :3, :3], places) + matrices[:, :3, 3])
    return total


def attributes(found: Moving, node: int) -> dict[str, Any]:
    part = found.document["meshes"][node]["primitives"][0]
    return {name: found.raw(index) for name, index in part["attributes"].items()}


POSES: list[tuple[dict[int, dict[str, Any]], tuple[float, float]]] = [
    ({}, (0.0, 0.0)),
    ({}, (1.0, 0.5)),
    ({3: {"rotation": (0, 0, 0.5, np.sqrt(0.75))}}, (0.0, 1.0)),
    ({1: {"rotation": (0, 0.6, 0, 0.8)}, 2: {"rotation": (0.28, 0, 0, 0.96), "scale": (1, 1.2, 1)}}, (0.4, -0.3)),
]


@pytest.mark.parametrize(("moved", "weights"), POSES)
def test_every_part_moves_as_the_rig_says(character: Callable[..., Moving], moved: Any, weights: Any) -> None:
    surface, rig = arm()
    found = character(surface, rig)
    start = len(found.document["nodes"]) - len(rig.nodes)
    pose: dict[int, dict[str, Any]] = {start + i: numbers for i, numbers in moved.items()} | {0: {"weights": weights}}
    body = found.posed(SKIN, pose=pose)["POSITION"]
    assert np.abs(body - expected(rig, moved, weights)).max() < 1e-4 * surface.extent + BYTE_WEIGHTS
    for node in (SHELLS, FINS):
        still = found.posed(node, pose={0: {"weights": (0.0, 0.0)}}, skin=0)["POSITION"]
        away = np.linalg.norm(still[:, None] - rig.vertices[None], axis=2)
        assert away.min(axis=1).max() < 1e-4
        part = found.posed(node, pose=pose, skin=0)["POSITION"]
        assert np.abs(part - body[away.argmin(axis=1)]).max() < 1e-6 * surface.extent


def test_weights_of_whole_bytes_move_exactly(character: Callable[..., Moving]) -> None:
    surface, rig = arm(targets=False)
    whole = np.round(rig.shares * 5) / 5  # 51 of 255
    rig = replace(rig, shares=whole)
    found, moved = character(surface, rig), POSES[3][0]
    start = len(found.document["nodes"]) - len(rig.nodes)
    body = found.posed(SKIN, pose={start + i: numbers for i, numbers in moved.items()})["POSITION"]
    assert np.abs(body - expected(rig, moved, ())).max() < 2e-5 * surface.extent


def test_copies_of_a_vertex_agree_to_the_byte(character: Callable[..., Moving]) -> None:
    found = character(*arm())
    seen: dict[tuple[Any, ...], tuple[Any, ...]] = {}
    for node in (SKIN, SHELLS, FINS):
        part = found.document["meshes"][node]["primitives"][0]
        values = attributes(found, node)
        moved = [found.raw(target[name]) for target in part["targets"] for name in ("POSITION", "NORMAL")]
        follow = np.column_stack([values["JOINTS_0"], values["WEIGHTS_0"], *moved]).tolist()
        for place, normal, row in zip(values["POSITION"].tolist(), values["NORMAL"].tolist(), follow, strict=True):
            assert seen.setdefault((*place, *normal), tuple(row)) == tuple(row)
    assert len(seen) == 386


def test_a_vertex_takes_40_bytes(character: Callable[..., Moving]) -> None:
    found = character(*arm())
    for node in (SHELLS, FINS):
        part = found.document["meshes"][node]["primitives"][0]
        accessors = [found.document["accessors"][index] for index in part["attributes"].values()]
        assert sum(found.document["bufferViews"][each["bufferView"]]["byteStride"] for each in accessors) <= 40
        joints, weights = (found.document["accessors"][part["attributes"][name]] for name in ("JOINTS_0", "WEIGHTS_0"))
        assert (joints["componentType"], joints.get("normalized")) == (5121, None)
        assert (weights["componentType"], weights["normalized"]) == (5121, True)
        assert set(found.raw(part["attributes"]["WEIGHTS_0"]).sum(axis=1, dtype=int)) == {255}


def test_joints_of_a_vertex_rise_and_those_without_weight_follow(character: Callable[..., Moving]) -> None:
    values = attributes(character(*arm()), SHELLS)
    joints, weighs = values["JOINTS_0"].astype(int), values["WEIGHTS_0"] > 0
    both = weighs[:, 1:] & weighs[:, :-1]
    assert both.any()
    assert (np.diff(joints, axis=1)[both] > 0).all()
    assert not (weighs[:, 1:] & ~weighs[:, :-1]).any()


def test_many_joints_take_16_bits(character: Callable[..., Moving], tmp_path: Path) -> None:
    surface, rig = arm(joints=300, targets=False)
    found = character(surface, rig)
    values = attributes(found, SHELLS)["JOINTS_0"]
    assert values.dtype == np.uint16
    assert values.max() > 255
    assert errors(tmp_path) == []


def test_targets_turn_normals_and_tangents(character: Callable[..., Moving]) -> None:
    """A target that turns the whole body turns all frames alike."""
    surface, rig = arm(targets=False)
    angle = np.radians(25)
    turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
    rig = replace(rig, targets=(Target("turn", surface.vertices @ turn.T - surface.vertices),), clips=())
    found = character(surface, rig)
    for node in (SKIN, SHELLS, FINS):
        still, turned = (found.posed(node, pose={0: {"weights": (weight,)}}, skin=0) for weight in (0.0, 1.0))
        assert set(still) == {"POSITION", "NORMAL"} | ({"TANGENT"} if node else set())
        np.testing.assert_allclose(turned["POSITION"], still["POSITION"] @ turn.T, atol=2e-4)
        for name in set(still) - {"POSITION"}:
            np.testing.assert_allclose(turned[name], still[name] @ turn.T, atol=0.02)


def test_targets_are_small(character: Callable[..., Moving]) -> None:
    surface, rig = arm()
    found = character(surface, rig)
    shells = found.document["meshes"][SHELLS]["primitives"][0]
    bump, twist = ({name: found.document["accessors"][i] for name, i in each.items()} for each in shells["targets"])
    assert all("bufferView" not in each and "sparse" in each for each in bump.values())
    assert "sparse" not in twist["POSITION"]
    kinds = {name: (each["componentType"], each["normalized"]) for name, each in twist.items()}
    assert kinds == {"POSITION": (5122, True), "NORMAL": (5120, True), "TANGENT": (5120, True)}


def test_far_displacements_are_floats(character: Callable[..., Moving], tmp_path: Path) -> None:
    surface, rig = arm(targets=False)
    away = np.zeros_like(surface.vertices)
    away[surface.vertices[:, 0] > 4.0] = (9.0, 0, 0)
    found = character(surface, replace(rig, targets=(Target("far", away), Target("none", 0 * away)), clips=()))
    target, none = found.document["meshes"][SKIN]["primitives"][0]["targets"]
    assert found.document["accessors"][target["POSITION"]]["componentType"] == 5126
    assert not found.raw(none["POSITION"]).any()
    moved = found.posed(SKIN, pose={0: {"weights": (1.0, 1.0)}})["POSITION"]
    np.testing.assert_allclose(moved, surface.vertices + away, atol=2e-4)
    assert errors(tmp_path) == []


def test_targets_alone_need_no_skin(character: Callable[..., Moving], tmp_path: Path) -> None:
    surface, rig = arm()
    alone = Rig((), (), np.zeros((0, 4, 4)), rig.vertices, rig.posed, rig.faces, rig.which * 0,
                np.tile([1.0, 0, 0, 0], (len(rig.vertices), 1)), rig.targets, rig.clips[2:])  # fmt: skip
    found = character(surface, alone)
    assert "skins" not in found.document
    assert all("skin" not in node for node in found.document["nodes"])
    assert "JOINTS_0" not in attributes(found, SHELLS)
    assert errors(tmp_path) == []
    assert [mesh["weights"] for mesh in found.document["meshes"]] == [[0.0, 0.25]] * 3
    assert [mesh["extras"]["targetNames"] for mesh in found.document["meshes"]] == [["bump", "twist"]] * 3
    bump, twist = shapes(surface.vertices)
    moved = found.posed(SKIN, pose=found.clip(0, 0.5))["POSITION"]
    np.testing.assert_allclose(moved, surface.vertices + bump.deltas + 0.5 * twist.deltas, atol=2e-4)


def test_a_simpler_ground_stays_on_the_skin(character: Callable[..., Moving]) -> None:
    surface, rig = arm()
    ground = simplify(surface, 300)
    assert len(ground.vertices) < 200
    found = character(surface, rig, ground=ground, charts=lapped(ground))
    start = len(found.document["nodes"]) - len(rig.nodes)
    pose: dict[int, dict[str, Any]] = {start + 3: {"rotation": (0, 0, 0.3, np.sqrt(0.91))}, 0: {"weights": (0.5, 1.0)}}
    body = found.posed(SKIN, pose=pose)["POSITION"]
    shells = found.posed(SHELLS, pose=pose, skin=0)["POSITION"]
    corners = body[surface.faces]
    points = np.vstack([body, corners.mean(axis=1), *(corners[:, [i, i - 1]].mean(axis=1) for i in range(3))])
    assert np.linalg.norm(shells[:, None] - points[None], axis=2).min(axis=1).max() < 0.1


@pytest.mark.parametrize("targets", [True, False])
def test_the_khronos_validator_finds_no_error(character: Callable[..., Moving], tmp_path: Path, targets: bool) -> None:
    character(*arm(targets=targets))
    assert errors(tmp_path) == []
