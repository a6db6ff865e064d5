"""Eyes and noses: read or refused in a sentence, put on the surface, with fur cleared around them."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from furbake.surface.mesh import MeshError
from furbake.surface.place.features import Feature, ball, clearing, nearest, placed, read_features
from furbake.surface.shapes import builtin

EYE = {"name": "eye", "shape": "ellipsoid", "centre": [0, 0, 1], "radii": [0.1, 0.2, 0.1]}


@pytest.fixture
def file(tmp_path: Path) -> Callable[[Any], Path]:
    def write(content: Any) -> Path:
        path = tmp_path / "face.json"
        path.write_text(content if isinstance(content, str) else json.dumps(content))
        return path

    return write


def test_features_are_read(file: Callable[[Any], Path]) -> None:
    more = {"forward": [1, 0, 0], "on": True, "sink": 0.5, "clear": 3, "colour": [0, 0.5, 1], "roughness": 0.2}
    eye, nose = read_features(file({"features": [EYE | more, {"centre": [1, 2, 3], "radii": [1, 1, 1]}]}))
    assert eye == Feature("eye", (0, 0, 1), (0.1, 0.2, 0.1), (1, 0, 0), True, 0.5, 3, (0, 0.5, 1), 0.2)
    assert nose == Feature("feature", (1, 2, 3), (1, 1, 1))


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("{", "not JSON (Expecting property name"),
        ([], 'no list of features, expected {"features": [...]}'),
        ({"features": [3]}, "features[0] is 3, expected an object"),
        ({"features": [EYE, {"centre": [0, 0, 0]}]}, "features[1] has no radii, expected three numbers"),
        ({"features": [EYE | {"center": [0, 0, 0]}]}, "features[0].center is unknown, expected only name, shape, cent"),
        ({"features": [EYE | {"shape": "box"}]}, 'features[0].shape is "box", expected one of ellipsoid, half'),
        ({"features": [EYE | {"joint": 3}]}, "features[0].joint is 3, expected the name of a joint"),
        ({"features": [EYE | {"name": ""}]}, 'features[0].name is "", expected text'),
        ({"features": [EYE | {"on": 1}]}, "features[0].on is 1, expected true or false"),
        ({"features": [EYE | {"centre": [0, 1]}]}, "features[0].centre is [0, 1], expected three numbers"),
        ({"features": [EYE | {"radii": [1, 0, 1]}]}, "features[0].radii is [1, 0, 1], expected three numbers above 0"),
        ({"features": [EYE | {"colour": [0, 0, 2]}]}, "features[0].colour is [0, 0, 2], expected three numbers from 0"),
        ({"features": [EYE | {"forward": [0, 0, 0]}]}, "features[0].forward is [0, 0, 0], expected a direction"),
        ({"features": [EYE | {"roughness": 2}]}, "features[0].roughness is 2, expected a number from 0 to 1"),
        ({"features": [EYE | {"clear": 0.5}]}, "features[0].clear is 0.5, expected a number from 1 to 100"),
        ({"features": [EYE | {"sink": True}]}, "features[0].sink is true, expected a number from -1 to 1"),
        ('{"features": [{"centre": [NaN, 0, 0], "radii": [1, 1, 1]}]}', "features[0].centre is [NaN, 0, 0], expected"),
        ('{"features": [{"centre": [1e999, 0, 0], "radii": [1, 1, 1]}]}', "features[0].centre is [Infinity, 0, 0]"),
        (
            {"features": [EYE, EYE | {"radii": [1, 1, 1]}, EYE | {"name": "lid", "colour": [1, 1, 1]}]},
            "features[2] fills the place of features[0], expected another place",
        ),
        ({"features": [EYE] * 101}, "101 features, expected at most 100"),
    ],
)
def test_each_mistake_has_its_sentence(file: Callable[[Any], Path], content: Any, message: str) -> None:
    path = file(content)
    with pytest.raises(MeshError) as error:
        read_features(path)
    assert str(error.value).startswith(f"{path}: ")
    assert message in str(error.value)
    assert "\n" not in str(error.value)


def test_half_a_ball_is_open_behind() -> None:
    vertices, faces = ball(half=True)
    np.testing.assert_allclose(np.linalg.norm(vertices, axis=1), 1.0)
    assert abs(vertices[:, 2].min()) < 1e-9
    area = np.linalg.norm(np.cross(*(vertices[faces[:, i]] - vertices[faces[:, 0]] for i in (1, 2))), axis=1).sum() / 2
    assert area == pytest.approx(2 * np.pi, rel=0.03)


def test_files_that_are_none(tmp_path: Path) -> None:
    with pytest.raises(MeshError, match=r"no such file or directory, expected .*features"):
        read_features(tmp_path / "none.json")
    (tmp_path / "bytes.json").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(MeshError, match="not JSON"):
        read_features(tmp_path / "bytes.json")


def test_it_stands_on_the_surface() -> None:
    ball = builtin("sphere")
    (eye,) = placed(ball, (Feature("eye", (0.0, 0.0, 5.0), (0.1, 0.1, 0.2), on=True, sink=0.5),))
    np.testing.assert_allclose(eye.centre, [0, 0, 0.9], atol=1e-2)
    np.testing.assert_allclose(eye.forward, [0, 0, 1], atol=1e-2)
    assert placed(ball, (eye,)) == (eye,)


@given(st.integers(0, 2**32 - 1))
def test_the_nearest_point_is_the_nearest(seed: int) -> None:
    torus, chance = builtin("torus:12x24"), np.random.default_rng(seed)
    place = chance.normal(size=3)
    point, normal = nearest(torus, place)
    shares = chance.dirichlet([0.5] * 3, (20, len(torus.faces)))
    others = np.einsum("nfk,fki->nfi", shares, torus.vertices[torus.faces])
    best = np.linalg.norm(point - place)
    assert best <= np.linalg.norm(others - place, axis=2).min() + 1e-12
    assert np.linalg.norm(torus.vertices - point, axis=1).min() < 0.2
    assert abs(np.linalg.norm(normal) - 1) < 1e-12


@given(st.integers(0, 2**32 - 1))
def test_axes_are_a_turn(seed: int) -> None:
    forward = np.random.default_rng(seed).normal(size=3)
    eye = Feature("eye", (0, 0, 0), (1, 1, 1), tuple(forward))
    np.testing.assert_allclose(eye.axes @ eye.axes.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(eye.axes) > 0.99
    np.testing.assert_allclose(eye.axes[2], forward / np.linalg.norm(forward))
    assert eye.axes[1, 1] >= 0


def test_straight_up_has_axes_too() -> None:
    np.testing.assert_allclose(Feature("hat", (0, 0, 0), (1, 1, 1), (0, 2, 0)).axes[2], [0, 1, 0])


def test_fur_is_cleared_smoothly() -> None:
    surface = builtin("sphere")
    eye = Feature("eye", (0.0, 0.0, 1.0), (0.1, 0.2, 0.02))
    share = clearing(surface, (eye,))
    x, y, z = surface.vertices.T
    front = z > 0
    far = np.hypot(x / 0.1, y / 0.2)
    assert (share[front & (far < 0.95)] == 0).all()
    assert (share[~front | (far > 2.5)] == 1).all()
    assert ((share >= 0) & (share <= 1)).all()
    ring = front & (far > 1.1) & (far < 2.4)
    assert ((share[ring] > 0) & (share[ring] < 1)).all()
    assert (clearing(surface, ()) == 1).all()


def test_the_ball_is_round_and_faces_out() -> None:
    vertices, faces = ball()
    np.testing.assert_allclose(np.linalg.norm(vertices, axis=1), 1)
    a, b, c = (vertices[faces[:, i]] for i in range(3))
    assert (np.einsum("ij,ij->i", np.cross(b - a, c - a), a + b + c) > 0).all()
    assert len(faces) == 320


def test_the_bunnys_face_is_read() -> None:
    face = read_features(Path(__file__).parents[4] / "public" / "models" / "bunny.features.json")
    assert [feature.name for feature in face[:3]] == ["eye right", "eye left", "nose"]
    assert all(feature.on for feature in face[:3])
    # Dark rims peep out beside the eyes; a mouth under the nose.
    named = {feature.name: feature for feature in face}
    for side in ("right", "left"):
        rim, eye = named[f"rim {side}"], named[f"eye {side}"]
        assert 0.9 < min(rim.radii[:2]) / max(eye.radii[:2]) < 1.1
        assert max(rim.colour) < 0.02
    mouth = [feature for feature in face if feature.name.startswith("mouth")]
    assert len(mouth) == 3
    assert all(feature.on and feature.centre[1] < named["nose"].centre[1] for feature in mouth)
    # Whiskers are long and thin, and no hair gives way to them.
    whiskers = [feature for feature in face if feature.name.startswith("whisker")]
    assert len(whiskers) == 8
    assert all(max(hair.radii) > 40 * min(hair.radii) and hair.clear == 1 and not hair.on for hair in whiskers)
