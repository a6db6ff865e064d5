"""Fur that was laid in a pose is stored in the bind pose, and is as it was laid when it is posed again."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from furbake.surface.place.vertex_fur import VertexFur, tangential
from furbake.surface.repair.topology import angle_normals
from furbake.surface.rig.rig import Pose, Rig
from helpers.arms import arm, turned
from helpers.gltf import lapped
from helpers.moving import Moving


def posed(rig: Rig) -> tuple[Rig, Any]:
    """The rig in a pose with its places, by plain sums: the last joint bent, the second target at 0.6."""
    bend = Moving.own({"translation": (8 / 3, 0, 0), "rotation": turned((0, 0.6, 0.8), 65)})
    matrices = np.tile(np.eye(4), (3, 1, 1))
    matrices[2] = bend @ rig.inverse_bind[2]
    weights = np.array([0.0, 0.6])
    places = rig.vertices + 0.6 * rig.targets[1].deltas
    total = np.zeros_like(places)
    for k in range(4):
        moved = matrices[rig.which[:, k]]
        total += rig.shares[:, k, None] * (np.einsum("vij,vj->vi", moved[:, :3, :3], places) + moved[:, :3, 3])
    return replace(rig, posed=total, pose=Pose(matrices, weights)), total


def test_posed_again_the_fur_is_as_it_was_laid(character: Callable[..., Moving]) -> None:
    surface, rig = arm()
    rig, places = posed(replace(rig, clips=()))
    laid = replace(surface, vertices=places, normals=angle_normals(places, surface.faces))
    charts = lapped(laid)
    comb = 0.5 * tangential(np.tile([1.0, 0.2, 0.1], (len(places), 1)), laid.normals)
    fur = replace(VertexFur.even(len(places)), comb=comb)
    found = character(laid, rig, charts=charts, fur=fur)
    start = len(found.document["nodes"]) - len(rig.nodes)
    rest = found.posed(0, pose={0: {"weights": (0, 0)}})["POSITION"]
    assert np.abs(rest - rig.vertices).max() < 2.0 / 255 + 1e-3  # weights are bytes
    pose: dict[int, dict[str, Any]] = {start + 3: {"rotation": turned((0, 0.6, 0.8), 65)}, 0: {"weights": (0, 0.6)}}
    skin, shells = found.posed(0, pose=pose), found.posed(1, pose=pose, skin=0)
    np.testing.assert_allclose(skin["POSITION"], laid.vertices, atol=3e-4)
    np.testing.assert_allclose(shells["POSITION"], laid.vertices[charts.source], atol=3e-4)
    # Joints lead normals as vectors: where a blend presses the body flat they are a little off those of the faces.
    off = np.einsum("ij,ij->i", skin["NORMAL"], laid.normals)
    assert np.degrees(np.arccos(np.clip(off, -1, 1))).mean() < 4
    off = np.einsum("ij,ij->i", shells["TANGENT"], charts.tangents[:, :3])
    assert np.degrees(np.arccos(np.clip(off, -1, 1))).mean() < 4


def test_the_comb_keeps_its_length(character: Callable[..., Moving]) -> None:
    surface, rig = arm()
    rig, places = posed(replace(rig, clips=()))
    laid = replace(surface, vertices=places, normals=angle_normals(places, surface.faces))
    charts = lapped(laid)
    comb = 0.5 * tangential(np.tile([1.0, 0.2, 0.1], (len(places), 1)), laid.normals)
    found = character(laid, rig, charts=charts, fur=replace(VertexFur.even(len(places)), comb=comb))
    stored = found.values(found.document["meshes"][1]["primitives"][0]["attributes"]["_COMB"])
    right = np.linalg.norm(comb, axis=1)[charts.source]
    np.testing.assert_allclose(np.linalg.norm(stored, axis=1), right, atol=0.01)
