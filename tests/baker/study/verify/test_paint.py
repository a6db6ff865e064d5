from __future__ import annotations

from pathlib import Path

import numpy as np

from furbake.study.verify.paint import write_painted


def test_hairs_of_many_colours_are_pieces_of_a_few(tmp_path: Path) -> None:
    """Every piece is in one file, with its own control points, and as good as of its own colour."""
    control = np.random.default_rng(2).normal(size=(5, 7, 4))
    colours = np.repeat(np.linspace([0.1, 0.05, 0.02], [0.8, 0.5, 0.3], 5)[None], 5, axis=0)
    pieces = 0
    for path, colour in write_painted(tmp_path, control, colours):
        near = np.abs((colours[0, :-1] + colours[0, 1:]) / 2 - colour).max(1)
        assert near.min() < 0.02
        for curve in path.read_text().strip().split("\n\n"):
            points = np.array([[float(x) for x in line.split()] for line in curve.splitlines()])
            assert any(np.allclose(points, hair[k : k + len(points)], atol=1e-4) for hair in control for k in range(4))
            pieces += len(points) - 3
    assert pieces == 5 * 4
