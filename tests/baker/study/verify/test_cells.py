from __future__ import annotations

import numpy as np
import pytest

from furbake.study.verify.cells import FIELD_OF_VIEW, PLANS, cells, frame


def test_lamps_are_where_the_eye_sees_them() -> None:
    body = PLANS["body"]
    seen = frame(np.array([[-1.0, -1, -1], [1, 1, 1]]), 0.1, body, 120)
    assert (seen.width, seen.height) == (120, 100)
    wanted = cells(body, seen)
    assert [one.name for one in wanted] == [
        f"{view}-{lamp}" for view in ("front", "back") for lamp in ("frontleft", "side", "behind")
    ]
    for one in wanted:
        back = (one.eye - seen.centre) / seen.distance
        right = np.cross([0, 1, 0], back)
        assert np.linalg.norm(one.to_lamp) == pytest.approx(1)
        if one.lamp == "frontleft":
            assert one.to_lamp @ back > 0 > one.to_lamp @ right
        if one.lamp == "behind":
            assert one.to_lamp @ back < 0
    eye, beside, side = cells(PLANS["round"], seen)
    np.testing.assert_allclose(eye.to_lamp, eye.eye / 1 / np.linalg.norm(eye.eye), atol=1e-9)
    assert side.to_lamp @ eye.to_lamp == pytest.approx(0, abs=1e-9)
    assert 0.6 < beside.to_lamp @ eye.to_lamp < 0.8


def test_all_of_the_fur_is_in_the_picture() -> None:
    chance = np.random.default_rng(0)
    vertices = chance.normal(0, 1, (200, 3)) * [2, 1, 0.5]
    seen = frame(vertices, 0.2, PLANS["body"], 240)
    for one in cells(PLANS["body"], seen):
        back = (one.eye - seen.centre) / seen.distance
        right = np.cross([0, 1, 0], back)
        right /= np.linalg.norm(right)
        at = vertices - one.eye
        depth = -at @ back
        slope = np.tan(np.radians(FIELD_OF_VIEW) / 2)
        assert ((np.abs(at @ right) + 0.2) / depth).max() < slope * 1.2
        assert ((np.abs(at @ np.cross(back, right)) + 0.2) / depth).max() < slope


def test_close_up_the_eye_is_nearer_to_the_same_centre() -> None:
    corners = np.array([[-1.0, -1, -1], [1, 1, 1]])
    far, near = (frame(corners, 0.1, PLANS["body"], 120, share) for share in (1.0, 0.35))
    assert near.distance == pytest.approx(0.35 * far.distance)
    np.testing.assert_array_equal(near.centre, far.centre)
