"""New vertices follow the original surface: oracles are plain sums, and the nearest point by brute force."""

from __future__ import annotations

import time
from typing import Any

import numpy as np
import pytest

from furbake.surface.rig.follow import follow
from furbake.surface.rig.rig import Rig, RigNode, Target
from furbake.surface.rig.weights import as_bytes, strongest

NODE = RigNode("", -1, np.zeros(3), np.array([0.0, 0, 0, 1]), np.ones(3))


def grid(rows: int, columns: int) -> np.ndarray[Any, Any]:
    """Faces of a grid that is closed across its columns."""
    r, c = (index.reshape(-1) for index in np.mgrid[: rows - 1, :columns])
    a, b = r * columns + c, r * columns + (c + 1) % columns
    return np.concatenate([np.stack([a, b, b + columns], 1), np.stack([a, b + columns, a + columns], 1)])


def rig_of(vertices: Any, faces: Any, which: Any, shares: Any, targets: tuple[Target, ...] = ()) -> Rig:
    joints = int(np.max(which)) + 1
    inverse = np.tile(np.eye(4), (joints, 1, 1))
    return Rig((NODE,) * joints, tuple(range(joints)), inverse, vertices, vertices, faces, which, shares, targets)


def tube(rows: int = 24, columns: int = 16, joints: int = 6) -> Rig:
    """A tube along x, 4 long, whose joints take over from each other, with two random targets."""
    x, turn = np.repeat(np.linspace(0, 4, rows), columns), np.tile(np.arange(columns) / columns * 2 * np.pi, rows)
    vertices = np.stack([x, 0.5 * np.cos(turn), 0.5 * np.sin(turn)], axis=1)
    along = x / 4 * (joints - 1.001)
    first = np.floor(along).astype(np.int64)
    which = np.stack([first, first + 1, np.zeros_like(first), np.zeros_like(first)], axis=1)
    shares = np.stack([1 - along + first, along - first, np.zeros(len(x)), np.zeros(len(x))], axis=1)
    chance = np.random.default_rng(1)
    targets = tuple(Target(f"t{i}", chance.normal(size=vertices.shape)) for i in range(2))
    return rig_of(vertices, grid(rows, columns), which, shares, targets)


def dense(which: Any, shares: Any, joints: int) -> np.ndarray[Any, Any]:
    total = np.zeros((len(which), joints))
    for i in range(which.shape[1]):
        total[np.arange(len(which)), which[:, i]] += shares[:, i]
    return total


def outward(places: Any) -> np.ndarray[Any, Any]:
    away = places * (0.0, 1.0, 1.0)
    return away / np.linalg.norm(away, axis=1, keepdims=True)


def nearest_by_force(rig: Rig, place: Any) -> tuple[float, int, Any]:
    """Distance, face and shares by sampling every face finely and refining: slow, and simple."""
    best: tuple[float, int, Any] = (np.inf, 0, None)
    a, b = (value.reshape(-1) for value in np.mgrid[0:41, 0:41] / 40)
    inside = a + b <= 1.0 + 1e-9
    shares = np.stack([1 - a - b, a, b], axis=1)[inside]
    for index, face in enumerate(rig.faces):
        far = np.linalg.norm(shares @ rig.posed[face] - place, axis=1)
        if far.min() < best[0]:
            best = (float(far.min()), index, shares[far.argmin()])
    return best


def test_originals_keep_their_weights_and_targets() -> None:
    rig = tube()
    order = np.random.default_rng(2).permutation(len(rig.vertices))
    found = follow(rig, rig.posed[order], outward(rig.posed[order]))
    expected = dense(rig.which, rig.shares, 6)[order]
    got = dense(found.joints.astype(int), found.weights / 255.0, 6)
    assert found.weights.dtype == np.uint8
    assert found.joints.dtype == np.uint16
    assert np.abs(got - expected).max() < 1 / 255
    assert set(found.weights.sum(axis=1, dtype=int)) == {255}
    assert not found.joints[found.weights == 0].any()
    for i, target in enumerate(rig.targets):
        np.testing.assert_array_equal(found.deltas[i], target.deltas[order])


def test_between_originals_by_the_nearest_point() -> None:
    rig, chance = tube(rows=8, columns=10), np.random.default_rng(3)
    faces = chance.integers(0, len(rig.faces), 40)
    share = chance.dirichlet((1, 1, 1), 40)
    flat = np.cross(*(rig.posed[rig.faces[faces, i]] - rig.posed[rig.faces[faces, 0]] for i in (1, 2)))
    flat /= np.linalg.norm(flat, axis=1, keepdims=True)
    places = np.einsum("nk,nkd->nd", share, rig.posed[rig.faces[faces]]) + 0.02 * flat
    found = follow(rig, places, flat)
    for i, place in enumerate(places):
        _, face, by_force = nearest_by_force(rig, place)
        corners = rig.faces[face]
        weights = by_force @ dense(rig.which[corners], rig.shares[corners], 6)
        got = dense(found.joints[i : i + 1].astype(int), found.weights[i : i + 1] / 255.0, 6)[0]
        assert np.abs(got - weights).max() < 0.06  # steps of the brute force
        np.testing.assert_allclose(found.deltas[:, i], [by_force @ t.deltas[corners] for t in rig.targets], atol=0.2)
    exact = np.einsum("nk,nkd->nd", share, rig.targets[0].deltas[rig.faces[faces]])
    np.testing.assert_allclose(found.deltas[0], exact, atol=1e-9)


def test_long_faces_beside_short_ones_are_found() -> None:
    """A long face's samples are far apart: those of a dense patch beside it are all nearer."""
    fine = np.stack([*(v.reshape(-1) for v in np.mgrid[0:21, 0:21] / 400.0), np.full(441, -0.01)], axis=1)
    r, c = (v.reshape(-1) for v in np.mgrid[0:20, 0:20])
    a = r * 21 + c
    patch = np.concatenate([np.stack([a, a + 21, a + 22], 1), np.stack([a, a + 22, a + 1], 1)])
    long = np.array([[-10.0, -1, 0], [10, -1, 0], [0, 9, 0]])
    vertices, faces = np.concatenate([fine, long]), np.concatenate([patch, [[441, 442, 443]]])
    which = np.zeros((444, 4), dtype=np.int64)
    which[441:, 0] = 1
    rig = rig_of(vertices, faces, which, np.tile([1.0, 0, 0, 0], (444, 1)))
    found = follow(rig, np.array([[0.025, 0.025, 0.001]]), np.array([[0.0, 0, 1]]))
    assert found.joints[0, 0] == 1


@pytest.mark.parametrize("wound", [1, -1])
def test_a_vertex_of_the_front_does_not_follow_the_back(wound: int) -> None:
    """Two sheets 0.002 apart; vertices of the front have sunk to the back by a simplification."""
    side = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    vertices = np.concatenate([side + np.array([0.0, 0, 0.002]), side])
    faces = np.array([[0, 1, 2], [0, 2, 3], [4, 6, 5], [4, 7, 6]])[:, ::wound]
    which = np.repeat([[0, 0, 0, 0], [1, 0, 0, 0]], 4, axis=0)
    rig = rig_of(vertices, faces, which, np.tile([1.0, 0, 0, 0], (8, 1)))
    places = np.array([[0.3, 0.4, 0.0005], [0.3, 0.4, 0.0015], [0.9, 0.1, 0.004], [0.2, 0.9, -0.001]])
    up = np.array([0.0, 0, 1])
    places = np.concatenate([np.repeat(places, 2, axis=0), vertices])
    found = follow(rig, places, np.concatenate([np.tile([up, -up], (4, 1)), np.repeat([up, -up], 4, axis=0)]))
    np.testing.assert_array_equal(found.joints[:, 0], [0, 1] * 4 + [0] * 4 + [1] * 4)


def test_copies_with_other_joints_are_told_apart_by_their_normals() -> None:
    """Two plates that meet at a right angle share places, not joints."""
    floor = np.array([[0.0, 0, 0], [1, 0, 0], [1, 0, -1], [0, 0, -1]])
    wall = np.array([[0.0, 0, 0], [0, 0, -1], [0, 1, -1], [0, 1, 0]])
    faces = np.array([[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]])
    which = np.repeat([[0, 0, 0, 0], [1, 0, 0, 0]], 4, axis=0)
    rig = rig_of(np.concatenate([floor, wall]), faces, which, np.tile([1.0, 0, 0, 0], (8, 1)))
    found = follow(rig, np.zeros((2, 3)), np.array([[0.1, 1, 0], [1, 0.1, 0]]) / np.hypot(1, 0.1))
    np.testing.assert_array_equal(found.joints[:, 0], [0, 1])


def test_targets_alone_need_no_joint() -> None:
    made = tube()
    rig = Rig((), (), np.zeros((0, 4, 4)), made.vertices, made.posed, made.faces, made.which * 0,
              np.tile([1.0, 0, 0, 0], (len(made.which), 1)), made.targets)  # fmt: skip
    found = follow(rig, rig.posed, outward(rig.posed))
    assert not found.joints.any()
    np.testing.assert_array_equal(found.weights[0], [255, 0, 0, 0])


def test_strongest_joins_doubles_and_keeps_four() -> None:
    which = np.array([[7, 3, 7, 1, 2, 9], [5, 5, 5, 5, 5, 5]])
    shares = np.array([[0.2, 0.1, 0.25, 0.15, 0.05, 0.25], [1.0, 0, 0, 0, 0, 0]])
    joints, kept, number = strongest(which, shares)
    np.testing.assert_array_equal(joints, [[7, 9, 1, 3], [5, 0, 0, 0]])
    np.testing.assert_allclose(kept, [np.array([0.45, 0.25, 0.15, 0.1]) / 0.95, [1, 0, 0, 0]])
    np.testing.assert_array_equal(number, [5, 1])


def test_bytes_are_within_one_of_the_share_and_sum_to_255() -> None:
    shares = np.random.default_rng(4).dirichlet(np.full(4, 0.3), 5000)
    _, weights = as_bytes(np.tile(np.arange(4), (5000, 1)), shares)
    assert set(weights.sum(axis=1, dtype=int)) == {255}
    assert np.abs(weights - 255 * shares).max() < 1.0


def test_twenty_thousand_vertices_on_forty_thousand_faces_within_two_seconds() -> None:
    rig = tube(rows=200, columns=100, joints=60)
    chance = np.random.default_rng(5)
    faces = chance.integers(0, len(rig.faces), 20_000)
    places = np.einsum("nk,nkd->nd", chance.dirichlet((1, 1, 1), 20_000), rig.posed[rig.faces[faces]])
    start = time.process_time()
    follow(rig, places, outward(places))
    assert time.process_time() - start < 6.0  # 2 s on a free core
