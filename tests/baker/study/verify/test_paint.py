from __future__ import annotations

from pathlib import Path

import numpy as np

from furbake.study.verify.paint import COLOURS, shaded, write_painted


def test_hairs_of_many_colours_are_pieces_of_a_few(tmp_path: Path) -> None:
    """Every piece is in one file, with its own control points, in one of the shades around its colour."""
    control = np.random.default_rng(2).normal(size=(5, 7, 4))
    colours = np.repeat(np.linspace([0.1, 0.05, 0.02], [0.8, 0.5, 0.3], 5)[None], 5, axis=0)
    pieces = 0
    for path, colour in write_painted(tmp_path, control, colours):
        assert 0 <= colour.min() <= colour.max() <= 0.81
        *curves, _ = path.read_text().strip().split("\n\n")  # the last one is a speck
        for curve in curves:
            points = np.array([[float(x) for x in line.split()] for line in curve.splitlines()])
            assert any(np.allclose(points, hair[k : k + len(points)], atol=1e-4) for hair in control for k in range(4))
            pieces += len(points) - 3
    assert pieces == 5 * 4


def test_shades_have_the_hairs_own_mean_at_every_height() -> None:
    """Mean of the shades beside that of the colours, of 3 000 hairs that grow paler and greyer, each its own way."""
    rng = np.random.default_rng(3)
    s, pale = np.linspace(0, 1, 8)[None, :, None], rng.uniform(0.2, 1.0, (3000, 1, 1))
    colours = pale * ((1 - s) * np.array([0.2, 0.1, 0.04]) + s * np.array([0.8, 0.7, 0.6]))
    shades, kind = shaded(colours)
    assert len(shades) <= COLOURS + 8
    for some in (pale[:, 0, 0] < 0.5, pale[:, 0, 0] >= 0.5):
        painted, own = shades[kind[some]].mean(0), colours[some].mean(0)
        np.testing.assert_allclose(painted, own, rtol=0.03)
        np.testing.assert_allclose(painted[:, 2] / painted[:, 0], own[:, 2] / own[:, 0], rtol=0.03)
