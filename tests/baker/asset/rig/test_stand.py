"""Written characters move as plain sums over their rig do."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from furbake.asset.gltf import FurModel, write_gltf
from furbake.asset.rig.motion import Motion
from furbake.pelt.pelt import Pelt
from furbake.surface.mesh import Surface
from furbake.surface.place.fins import build_fins
from furbake.surface.place.vertex_fur import VertexFur
from furbake.surface.rig.follow import follow
from furbake.surface.rig.rig import Rig
from helpers.characters import arm
from helpers.gltf import lapped
from helpers.khronos import errors
from helpers.moving import Moving

SHELLS, FINS = 1, 2


@pytest.fixture
def character(tmp_path: Path, make_pelt: Callable[..., Pelt]) -> Callable[..., Moving]:
    """Write a character as a body with fur: character(surface, rig, ground=..., ...)."""

    def build(surface: Surface, rig: Rig, **rest: Any) -> Moving:
        ground = rest.get("ground", surface)
        charts = lapped(ground)
        follows = [follow(rig, each.vertices, each.normals) for each in (surface, ground)]
        fins = build_fins(ground, np.cross(ground.normals, [1.0, 0.3, 0.2]), 0.3)
        fur = VertexFur.even(len(ground.vertices))
        model = FurModel(surface, charts, fur, (make_pelt(),), 0.12, fins, **rest, motion=Motion(rig, *follows))
        write_gltf(tmp_path, model)
        return Moving(tmp_path / "model.gltf")

    return build


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
    right = expected(rig, moved, weights)
    body = found.posed(0, pose=pose)["POSITION"]
    assert np.abs(body - right).max() < 1e-4 * surface.extent + 0.5 / 255 * 2  # weights are bytes
    for node, part in ((SHELLS, found.posed(SHELLS, pose=pose, skin=0)), (FINS, found.posed(FINS, pose=pose, skin=0))):
        still = found.posed(node, pose={0: {"weights": (0.0, 0.0)}}, skin=0)["POSITION"]
        away = np.linalg.norm(still[:, None] - rig.vertices[None], axis=2)
        assert away.min(axis=1).max() < 1e-4
        assert np.abs(part["POSITION"] - body[away.argmin(axis=1)]).max() < 2e-5 * surface.extent


@pytest.mark.parametrize("targets", [True, False])
def test_the_khronos_validator_finds_no_error(character: Callable[..., Moving], tmp_path: Path, targets: bool) -> None:
    character(*arm(targets=targets))
    assert errors(tmp_path) == []
