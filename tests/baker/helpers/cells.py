"""Builders shared by tests of cells."""

from __future__ import annotations

import numpy as np

from furbake.study.verify.cells import Cell, Frame

NEAR = Frame(np.zeros(3), 0.5, 10.0, 60, 50)


def cell(lamp: tuple[float, float, float]) -> Cell:
    """The eye is on +z, y is up."""
    towards = np.array(lamp) / np.linalg.norm(lamp)
    return Cell("front", "lamp", np.array([0.0, 0.0, 10.0]), towards)
