from __future__ import annotations

import numpy as np
import pytest

from furbake.study.verify.colour import compared


def test_mean_colours_are_compared_by_hue_saturation_and_luminance() -> None:
    found = compared(np.array([0.4, 0.2, 0.1]), np.array([0.2, 0.1, 0.05]))
    assert found["hue_off"] == pytest.approx(0)
    assert found["saturation_off"] == pytest.approx(0)
    assert found["luminance_off"] == pytest.approx(1)
    assert compared(np.array([1.0, 0.0, 0.1]), np.array([1.0, 0.1, 0.0]))["hue_off"] == pytest.approx(-12)
