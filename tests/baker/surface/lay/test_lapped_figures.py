from __future__ import annotations

from dataclasses import replace

import pytest

from furbake.surface.lay.field import comb_field
from furbake.surface.lay.lapped import lap
from furbake.surface.lay.lapped_figures import lapped_figures
from furbake.surface.shapes import builtin


def test_figures_find_what_is_wrong() -> None:
    surface = builtin("sphere")
    direction = comb_field(surface).direction
    charts = lap(surface, direction, 0.2)
    bald = charts.weights.copy()
    bald[charts.source == 7] = 0.0
    got = lapped_figures(surface, replace(charts, weights=bald), direction, 0.2)
    assert 0.99 < got["coverage"] < 1.0
    assert got["sum_error_vertices"] == pytest.approx(1.0)
    turned = lapped_figures(surface, replace(charts, uv=charts.uv[:, ::-1] * [-1, 1]), direction, 0.2)
    assert turned["angle_mean"] == pytest.approx(90.0, abs=8)
    wide = lapped_figures(surface, replace(charts, uv=charts.uv * [2, 1]), direction, 0.2)
    assert wide["stretch_mean"] == pytest.approx(2.0, abs=0.15)
    flipped = lapped_figures(surface, replace(charts, uv=charts.uv * [-1, 1]), direction, 0.2)
    assert flipped["mirrored"] == len(charts.faces)
