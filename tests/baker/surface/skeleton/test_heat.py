"""Weights by heat beside a known answer, a plain dense solve, and bodies with gaps."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray

from furbake.surface.mesh import Surface, clean
from furbake.surface.shapes import builtin
from furbake.surface.skeleton.bones import warmed
from furbake.surface.skeleton.heat import heat_weights
from furbake.surface.skeleton.skeleton import Joint, Skeleton

Floats = NDArray[np.float64]


def joint(name: str, parent: int, at: list[float] | Floats, to: list[float] | None = None) -> Joint:
    return Joint(name, parent, np.array(at, float), None if to is None else np.array(to, float))


def swept(path: Floats, radii: Floats, columns: int = 24) -> Surface:
    """A closed tube along (n, 3) points in the plane of x and y."""
    along = np.gradient(path, axis=0)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    side, up = np.stack([-along[:, 1], along[:, 0], 0 * along[:, 0]], axis=1), np.array([0.0, 0.0, 1.0])
    turn = 2 * np.pi * np.arange(columns) / columns
    ring = np.cos(turn)[:, None] * side[:, None] + np.sin(turn)[:, None] * up
    places = (path[:, None] + radii[:, None, None] * ring).reshape(-1, 3)
    r, c = (index.reshape(-1) for index in np.mgrid[: len(path) - 1, :columns])
    a, b = r * columns + c, r * columns + (c + 1) % columns
    first, last, around = len(places), len(places) + 1, np.arange(columns)
    end = (len(path) - 1) * columns
    faces = np.concatenate([
        np.stack([a, b, b + columns], axis=1), np.stack([a, b + columns, a + columns], axis=1),
        np.stack([np.full(columns, first), (around + 1) % columns, around], axis=1),
        np.stack([np.full(columns, last), end + around, end + (around + 1) % columns], axis=1),
    ])  # fmt: skip
    return clean("tube", np.vstack([places, path[[0, -1]]]), faces)


def straight(radius: float = 1.0, length: float = 14.0) -> Surface:
    x = np.linspace(-length / 2, length / 2, 141)
    return swept(np.stack([x, 0 * x, 0 * x], axis=1), np.full(141, radius), 48)


TWO_BONES = Skeleton((joint("one", -1, [-7, 0, 0], [0, 0, 0]), joint("two", 0, [0, 0, 0], [7, 0, 0])))


def test_a_straight_limb_has_the_known_answer() -> None:
    """On a tube of radius r around two bones −w″ + w / r² = p / r² has the answer 1 − e^(−|x| / r) / 2."""
    surface = straight()
    weights = heat_weights(surface, TWO_BONES)
    x = surface.vertices[:, 0]
    middle = (np.abs(x) < 4) & (np.hypot(*surface.vertices[:, 1:].T) > 0.9)
    right = np.where(x > 0, 1 - 0.5 * np.exp(-np.abs(x)), 0.5 * np.exp(-np.abs(x)))
    assert np.abs(weights[middle, 1] - right[middle]).max() < 0.012
    np.testing.assert_allclose(weights.sum(axis=1), 1.0, atol=1e-12)
    assert weights.min() >= 0.0


def test_weights_are_smooth() -> None:
    """Second differences along the tube stay below those of the answer, h² / (2 r²), and no step is left."""
    surface = straight()
    weights = heat_weights(surface, TWO_BONES)[:, 1]
    rim = np.hypot(*surface.vertices[:, 1:].T) > 0.9
    x, values = surface.vertices[rim, 0], weights[rim]
    rings = [values[np.abs(x - place) < 0.01] for place in np.linspace(-7, 7, 141)]
    assert max(np.ptp(ring) for ring in rings) < 1e-3
    mean = np.array([ring.mean() for ring in rings])
    assert np.abs(np.diff(mean, 2)).max() < 1.1 * 0.1**2 / 2
    assert (np.diff(mean) > 0).all()


def test_it_is_the_balance_of_the_dense_solve() -> None:
    """A ring with two points as bones, by angles, areas and numpy's own solver; its far side sees neither."""
    surface, ring = builtin("torus:12x24"), 0.7
    turn = np.radians([0, 60])
    at = ring * np.stack([np.cos(turn), 0 * turn, np.sin(turn)], axis=1)
    skeleton = Skeleton(tuple(joint(str(i), -1, place) for i, place in enumerate(at)))
    weights = heat_weights(surface, skeleton)
    vertices, faces, count = surface.vertices, surface.faces, len(surface.vertices)
    matrix, area = np.zeros((count, count)), np.zeros(count)
    for face in faces:
        for k in range(3):
            i, j, o = (int(face[(k + n) % 3]) for n in (1, 2, 0))
            one, two = vertices[i] - vertices[o], vertices[j] - vertices[o]
            angle = np.arccos(one @ two / np.linalg.norm(one) / np.linalg.norm(two))
            stiff = 0.5 * max(1 / np.tan(angle), 0.05)  # held positive, as no weight may fall below 0
            matrix[i, i] += stiff
            matrix[j, j] += stiff
            matrix[i, j] -= stiff
            matrix[j, i] -= stiff
            area[o] += np.linalg.norm(np.cross(one, two)) / 6
    shares, far = warmed(surface, skeleton)
    seen = shares.sum(axis=1) > 0
    # A straight way around the ring by more than acos(0.4 / 0.7) + acos(0.4) = 122° leads through its hole.
    along = np.degrees(np.arctan2(vertices[:, 2], vertices[:, 0]))
    assert not seen[(along > -175) & (along < -125)].any()
    assert seen[np.abs(along) < 30].all()
    np.testing.assert_allclose(
        far[seen], np.linalg.norm(vertices[seen] - at[shares[seen].argmax(axis=1)], axis=1), atol=1e-9
    )
    heat = np.where(seen, area / far**2, 0.0)
    right = np.linalg.solve(matrix + np.diag(heat), heat[:, None] * shares)
    np.testing.assert_allclose(weights, right, atol=1e-9)


def fork() -> tuple[Surface, Skeleton]:
    """A thick and a thin prong beside each other, a third of the thick one's radius apart, joined by a bow."""
    up, turn = np.linspace(0, 4, 60), np.linspace(0, np.pi, 30)[1:-1]
    gap = 0.9
    thick = np.stack([0 * up, 4 - up, 0 * up], axis=1)
    bow = np.stack([gap / 2 * (1 - np.cos(turn)), -gap / 2 * np.sin(turn), 0 * turn], axis=1)
    thin = np.stack([0 * up + gap, up, 0 * up], axis=1)
    path = np.concatenate([thick, bow, thin])
    radii = np.concatenate([np.full(60, 0.6), np.linspace(0.6, 0.1, 28), np.full(60, 0.1)])
    bones = (
        joint("base", -1, [0, 0, 0], [0, 1, 0]),
        joint("thick", 0, [0, 1.2, 0], [0, 4, 0]),
        joint("thin", 0, [gap, 0.6, 0], [gap, 4, 0]),
    )
    return swept(path, radii), Skeleton(bones)


def test_nothing_is_grabbed_across_a_gap() -> None:
    surface, skeleton = fork()
    weights = heat_weights(surface, skeleton)
    x, y, _ = surface.vertices.T
    beside = (y > 2.5) & (x > 0.5) & (x < 0.7)
    assert beside.sum() > 20
    # These are nearer to the thin prong's bone than to their own.
    assert (0.9 - x[beside]).max() < 0.45
    assert weights[beside, 2].max() < 2e-3
    assert weights[beside, 1].min() > 0.94
    assert weights[(y > 2.5) & (x > 0.75), 2].min() > 0.999


def test_four_joints_at_most_and_none_jumps() -> None:
    """Short bones in a row: cut off after the fourth, second differences would be .16 of a whole weight, here .06."""
    surface = straight()
    row = np.linspace(-7, 7, 29)
    bones = enumerate(pairwise(row))
    skeleton = Skeleton(tuple(joint(str(i), i - 1, [a, 0, 0], [b, 0, 0]) for i, (a, b) in bones))
    weights = heat_weights(surface, skeleton)
    assert (weights > 0).sum(axis=1).max() == 4
    np.testing.assert_allclose(weights.sum(axis=1), 1.0, atol=1e-12)
    rim = np.hypot(*surface.vertices[:, 1:].T) > 0.9
    order = np.argsort(surface.vertices[rim, 0], kind="stable")
    rings = weights[rim][order].reshape(141, -1, 28).mean(axis=1)[20:-20]
    assert np.abs(np.diff(rings, 2, axis=0)).max() < 0.08


def test_a_piece_that_sees_no_bone_follows_the_nearest() -> None:
    body, button = straight(), builtin("sphere")
    away = 0.2 * button.vertices / button.extent + [3.0, 1.3, 0.0]
    surface = clean(
        "both", np.vstack([body.vertices, away]), np.vstack([body.faces, button.faces + len(body.vertices)])
    )
    weights = heat_weights(surface, TWO_BONES)
    apart = surface.vertices[:, 1] > 1.1
    assert weights[apart, 1].min() > 0.999


@pytest.mark.parametrize("scale", [1e-4, 1e4])
def test_units_do_not_matter(scale: float) -> None:
    surface, skeleton = fork()
    large = clean("large", scale * surface.vertices, surface.faces)
    joints = (Joint(j.name, j.parent, scale * j.at, None if j.to is None else scale * j.to) for j in skeleton.joints)
    order, other = (np.lexsort(np.round(s.vertices / s.extent, 6).T) for s in (surface, large))
    np.testing.assert_allclose(
        heat_weights(large, Skeleton(tuple(joints)))[other], heat_weights(surface, skeleton)[order], atol=1e-3
    )
