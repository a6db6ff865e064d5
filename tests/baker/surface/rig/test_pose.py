"""Poses of a rig by the plain sums of `helpers.characters`, and vertices brought back from them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from furbake.surface.mesh import MeshError, Surface, load_mesh
from furbake.surface.repair.topology import angle_normals
from furbake.surface.rig.at import pose_at
from furbake.surface.rig.clip import sample
from furbake.surface.rig.follow import follow
from furbake.surface.rig.pose import blend, posed, unposed
from furbake.surface.rig.rig import Channel, Pose, Rig
from helpers.characters import Character, bent_tube, standing, turn, value_at

KINDS = ("LINEAR", "STEP", "CUBICSPLINE")


def walker() -> Character:
    made = bent_tube()
    count = len(made.numbers[0])
    chance = np.random.default_rng(1)
    made.primitive(0)["targets"] = [{"POSITION": made.add(0.05 * chance.normal(size=(count, 3)))} for _ in range(2)]
    made.json["meshes"][0]["weights"] = [0.3, 0.0]
    bends = [turn([0.3, 0, 1], angle).tolist() for angle in (0, 70)]
    made.clip(
        "Walk",
        (3, "rotation", [0, 1], bends, "LINEAR"),
        (4, "rotation", [0, 1], bends, "LINEAR"),
        (0, "translation", [0, 1], [[0, 0, 0], [9, 0, 0]], "LINEAR"),
        (5, "weights", [0.2, 1], [[0, 0], [0.5, 1]], "LINEAR"),
    )
    made.clip("7@9", (3, "rotation", [0, 1], bends[::-1], "LINEAR"))
    made.clip(None, (4, "rotation", [0, 1], bends, "LINEAR"))
    return made


def in_pose(made: Character, folder: Path, clip: str, seconds: float) -> tuple[Surface, Rig]:
    surface = load_mesh(made.write(folder), pose=(clip, seconds))
    assert surface.rig is not None
    return surface, surface.rig


@pytest.mark.parametrize(
    ("clip", "number", "now"), [("Walk", 0, 0.6), ("Walk", 0, 0.0), ("7@9", 1, 0.9), ("2", 2, 0.25), ("0", 0, 1.0)]
)
def test_fur_is_laid_in_the_pose(tmp_path: Path, clip: str, number: int, now: float) -> None:
    made = walker()
    surface, rig = in_pose(made, tmp_path, clip, now)
    wanted = standing(made, number, now)
    np.testing.assert_allclose(rig.posed, wanted, atol=1e-5)
    np.testing.assert_allclose(rig.vertices, standing(bent_tube()), atol=1e-5)
    order = np.lexsort(np.round(surface.vertices, 4).T)
    np.testing.assert_allclose(surface.vertices[order], wanted[np.lexsort(np.round(wanted, 4).T)], atol=1e-4)


def test_a_time_beyond_the_clip_is_refused(tmp_path: Path) -> None:
    with pytest.raises(MeshError, match=r": 99 s of the clip Walk, expected 0 to 1$"):
        in_pose(walker(), tmp_path, "Walk", 99.0)
    in_pose(walker(), tmp_path, "Walk", 1.000001)


def test_without_a_pose_it_is_the_bind_pose(tmp_path: Path) -> None:
    rig = load_mesh(walker().write(tmp_path)).rig
    assert rig is not None
    assert rig.pose is None
    np.testing.assert_allclose(rig.posed, standing(bent_tube()), atol=1e-5)
    np.testing.assert_array_equal(blend(rig, rig.which, rig.shares), np.tile(np.eye(4), (len(rig.which), 1, 1)))
    vertices, _ = unposed(rig, follow(rig, rig.posed, rig.posed), rig.posed, rig.posed)
    np.testing.assert_array_equal(vertices, rig.posed)


def test_posed_vertices_are_brought_back(tmp_path: Path) -> None:
    """New vertices between the old ones: brought back and posed again by plain sums they are where they were."""
    surface, rig = in_pose(walker(), tmp_path, "Walk", 0.8)
    assert rig.pose is not None
    chance = np.random.default_rng(2)
    faces = surface.faces[chance.integers(0, len(surface.faces), 300)]
    share = chance.dirichlet((1, 1, 1), 300)
    places = np.einsum("nk,nkd->nd", share, surface.vertices[faces])
    normals = np.einsum("nk,nkd->nd", share, surface.normals[faces])
    follows = follow(rig, places, normals)
    vertices, _ = unposed(rig, follows, places, normals)
    again = np.zeros_like(places)
    for v in range(len(places)):
        place = vertices[v] + sum(w * follows.deltas[t, v] for t, w in enumerate(rig.pose.weights))
        for j in range(4):
            matrix = rig.pose.matrices[follows.joints[v, j]]
            again[v] += follows.weights[v, j] / 255 * (matrix[:3, :3] @ place + matrix[:3, 3])
    np.testing.assert_allclose(again, places, atol=1e-9 * surface.extent)


def test_normals_are_brought_back(tmp_path: Path) -> None:
    made = bent_tube()
    made.clip("turn", (1, "rotation", [0, 1], [turn([1, 2, 3], angle).tolist() for angle in (0, 100)], "LINEAR"))
    surface, rig = in_pose(made, tmp_path, "turn", 1.0)
    follows = follow(rig, surface.vertices, surface.normals)
    places, normals = unposed(rig, follows, surface.vertices, surface.normals)
    np.testing.assert_allclose(normals, angle_normals(places, surface.faces), atol=1e-6)
    np.testing.assert_allclose(np.sort(places[:, 1]), np.sort(rig.vertices[:, 1]), atol=1e-6)


def test_a_pose_that_presses_a_part_flat(tmp_path: Path) -> None:
    made = bent_tube()
    made.clip("hide", (4, "scale", [0, 1], [[1, 1, 1], [0, 0, 0]], "LINEAR"))
    surface, rig = in_pose(made, tmp_path, "hide", 1.0)
    vertices, normals = unposed(rig, follow(rig, surface.vertices, surface.normals), surface.vertices, surface.normals)
    assert np.isfinite(vertices).all()
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1.0)


@pytest.mark.parametrize(
    ("clip", "sentence"),
    [
        ("Trot", "has no clip Trot, expected one of Walk, 7@9, 2"),
        ("3", "has no clip 3, expected one of Walk, 7@9, 2"),
        ("9" * 5000, "has no clip " + "9" * 40 + ", expected one of Walk, 7@9, 2"),
        ("a\nb", "has no clip a b, expected one of Walk, 7@9, 2"),
    ],
)
def test_clips_that_there_are_not(tmp_path: Path, clip: str, sentence: str) -> None:
    path = walker().write(tmp_path)
    with pytest.raises(MeshError) as error:
        load_mesh(path, pose=(clip, 0.0))
    assert str(error.value) == f"{path}: {sentence}"


def test_models_without_clips(tmp_path: Path) -> None:
    path = bent_tube().write(tmp_path)
    with pytest.raises(MeshError, match=r": has no clips, expected the clip Walk of the pose$"):
        load_mesh(path, pose=("Walk", 0.0))


def test_what_a_clip_leaves_rests(tmp_path: Path) -> None:
    rig = load_mesh(walker().write(tmp_path)).rig
    assert rig is not None
    np.testing.assert_allclose(pose_at(rig, rig.clips[1], 0.5).weights, [0.3, 0.0], rtol=1e-6)
    still = posed(rig, Pose(np.tile(np.eye(4), (3, 1, 1)), np.zeros(2)))
    np.testing.assert_allclose(still, rig.vertices)


numbers = st.floats(-10, 10, width=32)


@given(st.data(), st.sampled_from(KINDS), st.sampled_from(("rotation", "translation", "weights")))
def test_channels_as_the_appendix_has_them(data: st.DataObject, kind: str, path: str) -> None:
    steps = data.draw(st.lists(st.floats(0.0625, 5), min_size=1, max_size=5))
    times = np.cumsum(steps)
    width = {"rotation": 4, "translation": 3, "weights": 2}[path]
    rows = len(times) * (3 if kind == "CUBICSPLINE" else 1)
    values = np.array(data.draw(st.lists(numbers, min_size=rows * width, max_size=rows * width))).reshape(rows, width)
    if path == "rotation":
        values[:, 3] += np.where(np.abs(values).max(axis=1) < 0.5, 1.0, 0.0)
        if kind != "CUBICSPLINE":
            values /= np.linalg.norm(values, axis=1, keepdims=True)
            # Opposite rotations have no shortest way between them.
            assume((np.abs(np.einsum("ij,ij->i", values[1:], values[:-1])) > 1e-6).all())
    nows = np.array(data.draw(st.lists(st.floats(0, 26), min_size=1, max_size=5)) + times.tolist())
    found = sample(Channel(0, path, times, values, kind), nows)
    for now, value in zip(nows, found, strict=True):
        wanted = value_at(times, values, kind, path, float(now))
        if path == "rotation":
            length = np.linalg.norm(wanted)
            if length < 1e-3:  # a spline through nothing
                continue
            np.testing.assert_allclose(min(abs(value @ wanted / length), 1.0), 1.0, atol=1e-6)
        else:
            np.testing.assert_allclose(value, wanted, atol=1e-6)
