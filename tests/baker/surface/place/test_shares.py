from __future__ import annotations

import numpy as np
import pytest

from furbake.surface.place.shares import bounds, in_balls, soften
from furbake.surface.shapes import builtin


def test_shares_sum_to_one_and_masks_that_overlap_share() -> None:
    masks = [np.array([0.0, 1.0, 1.0, 0.25]), np.array([0.0, 0.0, 1.0, 0.25])]
    cut = bounds(masks).astype(int)
    assert (cut[0] == 0).all()
    assert (cut[-1] == 255).all()
    assert (
        pytest.approx(np.array([[255, 0, 0], [0, 255, 0], [0, 127.5, 127.5], [127.5, 63.75, 63.75]]), abs=1)
        == np.diff(cut, axis=0).T
    )


def test_a_step_becomes_as_wide_as_asked() -> None:
    plane = builtin("plane:60x60")
    across = plane.vertices[:, 0]
    soft = soften(plane, (across > 0).astype(float), 0.2)
    assert soft.min() == 0.0
    assert soft.max() == 1.0
    low, high = (float(np.interp(level, *(np.sort(soft), np.sort(across)))) for level in (0.1, 0.9))
    assert high - low == pytest.approx(0.2, rel=0.15)
    assert abs(soft[np.abs(across) < 0.009].mean() - 0.5) < 0.06
    order = np.argsort(across)
    assert (np.diff(soft[order]) > -1e-6).all()


def test_a_ball_is_soft_around_its_surface() -> None:
    plane = builtin("plane:4x200")
    far = np.linalg.norm(plane.vertices, axis=1)
    inside = in_balls(plane, [(0.0, 0.0, 0.0, 0.3)], 0.1)
    assert inside == pytest.approx(np.clip((0.35 - far) / 0.1, 0, 1))
