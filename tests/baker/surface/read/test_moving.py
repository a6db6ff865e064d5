"""Characters of glTF files as a rig: what it poses is what the file says, by plain sums."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import DracoPy
import numpy as np
import pytest

from furbake.surface.mesh import load_mesh
from furbake.surface.rig.at import pose_at
from furbake.surface.rig.pose import posed
from furbake.surface.rig.rig import BODY, Rig
from helpers.characters import Character, bent_tube, humps, plate, standing, tube, tube_weights, turn

NOWS = (0.0, 0.3, 0.5, 0.77, 1.0, 1.4, 2.5)


def rig_of(made: Character, folder: Path) -> Rig:
    rig = load_mesh(made.write(folder)).rig
    assert rig is not None
    return rig


def told(made: Character, folder: Path) -> str:
    path = made.write(folder)
    return "\n".join(line.removeprefix(f"{path}: ") for line in load_mesh(path).notices)


def assert_stands(rig: Rig, made: Character, tolerance: float = 1e-6) -> None:
    """The rig in every clip stands as the file does."""
    size = np.ptp(rig.vertices, axis=0).max()
    for index, clip in enumerate(rig.clips):
        for now in NOWS:
            np.testing.assert_allclose(
                posed(rig, pose_at(rig, clip, now)), standing(made, index, now), atol=tolerance * size
            )


def turns(*degrees: float) -> list[Any]:
    return [turn([1, 0.2, 0], angle).tolist() for angle in degrees]


def walking(made: Character, first: int = 2) -> None:
    """Clips of all interpolations for three joints in a chain."""
    keys = [0.0, 0.5, 1.25]
    made.clip(
        "lines",
        (first, "rotation", keys, turns(0, 200, -40), "LINEAR"),
        (first + 1, "translation", keys, [[0, 1, 0], [0, 1.5, 0.2], [0.3, 1, 0]], "LINEAR"),
        (first + 2, "scale", [0.25, 1.0], [[1, 1, 1], [0.5, 2, 1]], "LINEAR"),
        (0, "translation", [0.0, 1.0], [[0, 0, 0], [3, 0, 0]], "LINEAR"),
    )
    made.clip(
        "steps",
        (first, "rotation", keys, turns(0, 60, -40), "STEP"),
        (first + 1, "translation", [0.5], [[0, 1.5, 0.2]], "STEP"),
    )
    chance = np.random.default_rng(1)
    splines = chance.normal(size=(3, 3, 4)) * [[[0.5]], [[1.0]], [[0.5]]]
    splines[:, 1] /= np.linalg.norm(splines[:, 1], axis=1, keepdims=True)
    made.clip(
        "splines",
        (first, "rotation", keys, splines.reshape(9, 4), "CUBICSPLINE"),
        (first + 1, "translation", keys, chance.normal(size=(9, 3)), "CUBICSPLINE"),
    )


@pytest.mark.parametrize(
    ("positions", "weights", "joints"),
    [("float32", "float32", "uint8!"), ("int16", "uint8", "uint16!"), ("int16!", "uint16", "uint8!")],
)
def test_a_bent_tube_moves_as_the_file_says(tmp_path: Path, positions: str, weights: str, joints: str) -> None:
    made = bent_tube(positions, weights, joints)
    walking(made)
    rig = rig_of(made, tmp_path)
    assert [clip.name for clip in rig.clips] == ["lines", "steps", "splines"]
    assert [rig.nodes[node].name for node in rig.joints] == ["one", "two", "three"]
    assert [node.name for node in rig.nodes] == ["scene", "root", "one", "two", "three"]
    assert all(node.parent < i for i, node in enumerate(rig.nodes))
    np.testing.assert_allclose(rig.vertices, standing(made), atol=1e-6 * np.ptp(rig.vertices, axis=0).max())
    np.testing.assert_array_equal(rig.posed, rig.vertices)
    np.testing.assert_allclose(rig.shares.sum(axis=1), 1.0)
    assert_stands(rig, made)
    assert "3 joints and 3 clips (lines, steps, splines) are kept" in told(made, tmp_path)


def test_rotations_as_normalised_integers(tmp_path: Path) -> None:
    made = bent_tube()
    for kind in ("int8", "int16"):
        made.clip(kind, (2, "rotation", [0.0, 1.0], turns(10, 130), "LINEAR"), kind=kind)
    rig = rig_of(made, tmp_path)
    assert_stands(rig, made)
    np.testing.assert_allclose(np.linalg.norm(rig.clips[0].channels[0].values, axis=1), 1.0, atol=0.006)


def test_eight_joints_become_the_four_strongest(tmp_path: Path) -> None:
    made, (vertices, faces) = Character(), tube()
    mesh = made.mesh(vertices, faces)
    joints = [made.node(translation=[i, 0, 0]) for i in range(8)]
    weights = np.tile([0.05, 0.3, 0.1, 0.02, 0.25, 0.2, 0.03, 0.05], (len(vertices), 1))
    weights[0] = 0.5, 0.5, 0, 0, 0, 0, 0, 0
    which = np.tile(np.arange(8), (len(vertices), 1))
    for i in range(2):
        made.primitive(mesh)["attributes"] |= {
            f"JOINTS_{i}": made.add(which[:, 4 * i : 4 * i + 4], "uint8!"),
            f"WEIGHTS_{i}": made.add(weights[:, 4 * i : 4 * i + 4]),
        }
    made.node(mesh=mesh, skin=made.skin(joints, np.tile(np.eye(4), (8, 1, 1))))
    rig = rig_of(made, tmp_path)
    np.testing.assert_array_equal(rig.which[1:], np.tile([1, 4, 5, 2], (len(vertices) - 1, 1)))
    np.testing.assert_allclose(rig.shares[1], np.array([0.3, 0.25, 0.2, 0.1]) / 0.85, rtol=1e-6)
    np.testing.assert_array_equal(rig.which[0], [0, 1, 0, 0])
    number = len(vertices) - 1
    assert f"{number} vertices with more than 4 joints keep their 4 strongest" in told(made, tmp_path)


@pytest.mark.parametrize("sparse", [False, True])
def test_a_plate_morphs_as_the_file_says(tmp_path: Path, sparse: bool) -> None:
    made = Character()
    node = plate(made, *humps(1, 3), sparse=sparse, rotation=turn([0, 0, 1], 30).tolist(), scale=[1, 2, 1])
    made.json["meshes"][0] |= {"extras": {"targetNames": ["up", "down"]}, "weights": [0.0, 0.5, 0.0]}
    chance = np.random.default_rng(2)
    made.clip("wave", (node, "weights", [0.0, 0.5, 1.0], chance.random((3, 3)), "LINEAR"))
    made.clip("jump", (node, "weights", [0.0, 0.5, 1.0], chance.random((3, 3)), "STEP"))
    made.clip("swell", (node, "weights", [0.0, 0.5, 1.0], chance.normal(size=(9, 3)), "CUBICSPLINE"))
    rig = rig_of(made, tmp_path)
    assert (rig.joints, rig.nodes) == ((), ())
    assert [(target.name, target.weight) for target in rig.targets] == [("up", 0.0), ("down", 0.5), ("2", 0.0)]
    assert_stands(rig, made)
    channel = rig.clips[2].channels[0]
    assert (channel.node, channel.path, channel.values.shape) == (BODY, "weights", (9, 3))
    assert "3 clips (wave, jump, swell) and 3 morph targets are kept" in told(made, tmp_path)


KEYS = ([0.0, 0.5, 1.0], [0.0, 0.25, 1.5])
MIXED = [
    (("LINEAR", "LINEAR"), (0, 0), "LINEAR", 3, 1e-6),
    (("LINEAR", "LINEAR"), (0, 1), "LINEAR", 5, 1e-6),
    (("STEP", "STEP"), (0, 1), "STEP", 5, 1e-6),
    (("CUBICSPLINE", "CUBICSPLINE"), (0, 0), "CUBICSPLINE", 3, 1e-6),
    (("CUBICSPLINE", "LINEAR"), (0, 1), "LINEAR", 34, 0.02),
    (("STEP", "LINEAR"), (0, 1), "LINEAR", 7, 1e-6),
]


@pytest.mark.parametrize(("kinds", "keys", "kind", "number", "tolerance"), MIXED)
def test_several_morphing_nodes_are_weighed_by_one_channel(
    tmp_path: Path, kinds: tuple[str, str], keys: tuple[int, int], kind: str, number: int, tolerance: float
) -> None:
    made, chance = Character(), np.random.default_rng(3)
    nodes = [plate(made, *humps(i, 2 + i), translation=[3 * i, 0, 0], weights=[0.1] * (2 + i)) for i in range(3)]
    channels = []
    for i in range(2):
        times = KEYS[keys[i]]
        values = chance.random((len(times) * (3 if kinds[i] == "CUBICSPLINE" else 1), 2 + i))
        channels.append((nodes[i], "weights", times, values, kinds[i]))
    made.clip("all", *channels)
    rig = rig_of(made, tmp_path)
    assert len(rig.targets) == 9
    (channel,) = rig.clips[0].channels
    assert (channel.interpolation, len(channel.times)) == (kind, number)
    assert (np.diff(channel.times) > 0).all()
    assert (np.diff(channel.times.astype(np.float32)) > 0).all()
    assert_stands(rig, made, tolerance)
    assert not rig.targets[0].deltas[25:].any()
    assert not rig.targets[8].deltas[:50].any()


def test_bodies_that_move_by_their_nodes_get_a_joint_each(tmp_path: Path) -> None:
    made, (vertices, faces) = Character(), tube(5, 6)
    mesh = [made.mesh(vertices, faces) for _ in range(4)]
    base = made.node(mesh=mesh[0], name="base", translation=[5, 0, 0])
    arm = made.node(above=base, name="arm", translation=[0, 3, 0], rotation=turn([0, 0, 1], 20).tolist())
    made.node(above=arm, name="hand", mesh=mesh[1], matrix=np.diag([-1.0, 1, 1, 1]).reshape(-1).tolist())
    spun = np.eye(4)
    spun[:3, 3] = 1, 2, 3
    wheel = made.node(name="wheel", mesh=mesh[2], matrix=spun.T.reshape(-1).tolist())
    made.node(name="stone", mesh=mesh[3], translation=[-5, 0, 0])
    made.clip("wave", (arm, "rotation", [0.0, 1.0], turns(20, 90), "LINEAR"))
    made.clip("roll", (wheel, "rotation", [0.0, 1.0], turns(0, 170), "LINEAR"))
    made.json["nodes"][wheel] |= {"translation": [1, 2, 3]}  # of the oracle, which knows no matrix that moves
    matrix = made.json["nodes"][wheel].pop("matrix")
    wanted = [standing(made, clip, now) for clip in range(2) for now in NOWS]
    made.json["nodes"][wheel] = {"name": "wheel", "mesh": mesh[2], "matrix": matrix}
    rig = rig_of(made, tmp_path)
    assert sorted(rig.nodes[node].name for node in rig.joints) == ["hand", "still", "wheel"]
    assert next(node for node in rig.nodes if node.name == "hand").matrix is not None
    found = [posed(rig, pose_at(rig, clip, now)) for clip in rig.clips for now in NOWS]
    np.testing.assert_allclose(found, wanted, atol=1e-5)
    still = list(rig.joints).index([node.name for node in rig.nodes].index("still"))
    np.testing.assert_array_equal(np.unique(rig.which[:, 0], return_counts=True)[1][still], 2 * len(vertices))


def test_a_part_below_a_joint_follows_it(tmp_path: Path) -> None:
    made, (vertices, faces) = bent_tube(), tube(5, 6)
    made.node(above=4, name="hat", mesh=made.mesh(0.1 * vertices, faces), translation=[0, 1, 0])
    walking(made)
    rig = rig_of(made, tmp_path)
    assert [rig.nodes[node].name for node in rig.joints] == ["one", "two", "three", "hat"]
    assert_stands(rig, made)


def test_two_skins_share_their_joints(tmp_path: Path) -> None:
    """The second one in another space: the same joints in another order, bound in the same pose."""
    made, (vertices, faces) = bent_tube(), tube()
    shift = np.eye(4)
    shift[:3, 3] = -1, 0, 0
    mesh = made.mesh(vertices + np.array([1.0, 0, 0]), faces)
    which, share = tube_weights(vertices)
    made.primitive(mesh)["attributes"] |= {"JOINTS_0": made.add(2 - which, "uint8!"), "WEIGHTS_0": made.add(share)}
    inverse = made.numbers[made.json["skins"][0]["inverseBindMatrices"]].reshape(-1, 4, 4).transpose(0, 2, 1)
    made.node(above=0, mesh=mesh, skin=made.skin([4, 3, 2], inverse[::-1] @ shift))
    walking(made)
    rig = rig_of(made, tmp_path)
    assert len(rig.joints) == 3
    assert_stands(rig, made)


def test_another_rest_pose_leaves_the_bind_pose_unblended(tmp_path: Path) -> None:
    made = bent_tube()
    made.json["nodes"][3] |= {"rotation": turn([1, 0, 0], 80).tolist()}
    walking(made)
    rig = rig_of(made, tmp_path)
    straight = bent_tube()
    np.testing.assert_allclose(rig.vertices, standing(straight), atol=1e-5)
    assert_stands(rig, made)
    assert "fur is laid in the bind pose, " in told(made, tmp_path)
    assert "% of the size away from the rest pose" in told(made, tmp_path)


def test_a_joint_that_is_bound_in_two_ways_is_two_nodes(tmp_path: Path) -> None:
    made, (vertices, faces) = bent_tube(), tube()
    mesh = made.mesh(vertices, faces)
    which, share = tube_weights(vertices)
    made.primitive(mesh)["attributes"] |= {"JOINTS_0": made.add(which, "uint8!"), "WEIGHTS_0": made.add(share)}
    inverse = made.numbers[made.json["skins"][0]["inverseBindMatrices"]].reshape(-1, 4, 4).transpose(0, 2, 1).copy()
    inverse[2, 1, 3] -= 0.5
    made.node(above=0, mesh=mesh, skin=made.skin([2, 3, 4], inverse))
    walking(made)
    rig = rig_of(made, tmp_path)
    assert len(set(rig.joints)) == len(rig.joints) == 4
    assert [rig.nodes[node].name for node in rig.joints] == ["one", "two", "three", "three"]
    assert_stands(rig, made)


def test_squeezed_parts_follow_their_joints(tmp_path: Path) -> None:
    made = bent_tube()
    attributes = made.primitive(0)["attributes"]
    vertices, which, share = (made.numbers[attributes[name]] for name in ("POSITION", "JOINTS_0", "WEIGHTS_0"))
    faces = made.numbers[made.primitive(0)["indices"]].reshape(-1, 3).astype(np.uint32)
    whole = np.rint(255 * share).astype(np.uint8)
    stream = DracoPy.encode(
        vertices.astype(np.float32), faces, preserve_order=True, quantization_bits=16,
        generic_attributes={1: which.astype(np.uint8), 2: whole},
    )  # fmt: skip
    named = {"POSITION": 3, "JOINTS_0": 1, "WEIGHTS_0": 2}
    made.primitive(0)["extensions"] = {
        "KHR_draco_mesh_compression": {"bufferView": made.view(stream), "attributes": named}
    }
    made.numbers[attributes["WEIGHTS_0"]] = whole / 255.0
    walking(made)
    rig = rig_of(made, tmp_path)
    assert_stands(rig, made, 1e-4)


def test_a_still_scene_has_no_rig(tmp_path: Path) -> None:
    made, (vertices, faces) = Character(), tube()
    made.node(mesh=made.mesh(vertices, faces), translation=[1, 2, 3])
    made.node(name="camera")
    assert load_mesh(made.write(tmp_path)).rig is None
    assert told(made, tmp_path) == ""
    made.clip("pan", (1, "translation", [0.0, 1.0], [[0, 0, 0], [1, 0, 0]], "LINEAR"))
    assert load_mesh(made.write(tmp_path)).rig is None
    assert told(made, tmp_path) == (
        "1 channel that moves nothing of the body left out\n1 clip that moves nothing of the body left out"
    )
