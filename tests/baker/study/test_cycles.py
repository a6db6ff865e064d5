"""Cycles beside Mitsuba, and a Python without Blender in one sentence."""

from __future__ import annotations

import sys
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest

import furbake
from furbake.groom.strands import Groom
from furbake.study.cycles.trace import trace
from furbake.study.verify.cells import Cell, Frame
from furbake.study.verify.pathtrace import VerifyError
from furbake.study.verify.truth import Scene
from furbake.study.verify.truth import trace as mitsuba_trace

BLENDER = Path(furbake.__file__).parents[1] / ".bpy" / "bin" / "python"


def meadow() -> tuple[Scene, Frame, list[Cell]]:
    """Hairs on a square, seen from above at the side."""
    rng = np.random.default_rng(0)
    count, points = 300, 6
    root = np.column_stack([rng.uniform(-1, 1, count), np.zeros(count), rng.uniform(-1, 1, count)])
    way = np.column_stack([rng.normal(0, 0.3, count), np.ones(count), rng.normal(0, 0.3, count)])
    radius = np.full((count, points), 0.02, np.float32)
    hairs = Groom(
        points=(root[:, None] + 0.3 * np.linspace(0, 1, points)[:, None] * way[:, None]).astype(np.float32),
        radius=radius, tint=radius, colour=np.ones((count, points, 3), np.float32),
        hair=np.arange(count), face=np.zeros(count, np.int64),
    )  # fmt: skip
    corners = np.array([[-1.0, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]])
    lamps = np.array([[0.0, 1, 0], [0.7, 0.5, 0.5]])
    cells = [Cell("one", str(i), np.array([1.0, 4, 3]), way / np.linalg.norm(way)) for i, way in enumerate(lamps)]
    scene = Scene(hairs, corners, np.array([[0, 2, 1], [0, 3, 2]]), 0.85, 0.5)
    return scene, Frame(np.zeros(3), 1.5, 5.0, 96, 80), cells


@pytest.mark.parametrize(("python", "message"), [("/nowhere/python", "no such file"), (sys.executable, "bpy")])
def test_a_python_without_blender_gets_one_sentence(python: str, message: str) -> None:
    if python == sys.executable and find_spec("bpy"):
        pytest.skip("Blender is in this Python")
    with pytest.raises(VerifyError, match=rf"cycles: .*{message}.*pip install bpy") as error:
        trace(*meadow(), 2, python=python)
    assert "\n" not in str(error.value)


@pytest.mark.skipif(not BLENDER.exists(), reason="no Blender: npm run blender -- --bpy")
def test_both_tracers_see_the_same_hairs() -> None:
    pytest.importorskip("mitsuba")
    ours = trace(*meadow(), 32, python=str(BLENDER))
    theirs = mitsuba_trace(*meadow(), 32)
    for one, other in zip(ours, theirs, strict=True):
        seen = other.cover > 0.5
        assert ((one.cover > 0.5) & seen).sum() > 0.98 * ((one.cover > 0.5) | seen).sum()
        assert one.light[seen].mean() == pytest.approx(other.light[seen].mean(), rel=0.08)
        assert np.corrcoef(one.light[seen], other.light[seen])[0, 1] > 0.8
