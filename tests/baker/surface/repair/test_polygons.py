from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from furbake.surface.mesh import load_mesh
from furbake.surface.repair.topology import face_vectors
from helpers.soups import assert_sound, volume


def test_polygons(write_obj: Callable[..., Path], tmp_path: Path) -> None:
    path = tmp_path / "prism.obj"
    ring = [(np.cos(t), y, -np.sin(t)) for y in (0, 1) for t in 2 * np.pi * np.arange(6) / 6]
    lines = [f"v {x} {y} {z}" for x, y, z in ring] + ["f 7 8 9 10 11 12", "f 6 5 4 3 2 1"]
    lines += [f"f {i + 1} {(i + 1) % 6 + 1} {(i + 1) % 6 + 7} {i + 7}" for i in range(6)]
    path.write_text("\n".join(lines))
    surface = load_mesh(path)
    assert_sound(surface)
    assert len(surface.faces) == 20
    assert volume(surface) == pytest.approx(1.5 * np.sqrt(3))
    assert surface.notices == ()


@pytest.mark.parametrize("start", range(8))
def test_hollow_polygons(tmp_path: Path, start: int) -> None:
    """A letter U as the lid and the floor of a box, whatever corner its polygon begins at."""
    ring = [(0, 0), (3, 0), (3, 3), (2.1, 3), (2, 1), (1, 1), (0.9, 3), (0, 3)]
    lines = [f"v {x} {y} {-z}" for y in (0, 1) for x, z in ring]
    turned = [(start + i) % 8 for i in range(8)]
    lines += ["f " + " ".join(str(i + 9) for i in turned), "f " + " ".join(str(i + 1) for i in turned[::-1])]
    lines += [f"f {i + 1} {(i + 1) % 8 + 1} {(i + 1) % 8 + 9} {i + 9}" for i in range(8)]
    path = tmp_path / "u.obj"
    path.write_text("\n".join(lines))
    surface = load_mesh(path)
    assert_sound(surface)
    area = 9 - 0.5 * (1.2 + 1) * 2
    assert volume(surface) == pytest.approx(area)
    upward = face_vectors(surface.vertices, surface.faces)[:, 1] / 2
    assert upward[upward > 1e-9].sum() == pytest.approx(area), "nothing lies on anything else"


@pytest.mark.parametrize("start", range(4))
def test_hollow_quads(tmp_path: Path, start: int) -> None:
    ring = [(0, 0), (2, 0), (0.3, 0.3), (0, 2)]
    lines = [f"v {x} 0 {-z}" for x, z in ring] + ["f " + " ".join(str((start + i) % 4 + 1) for i in range(4))]
    path = tmp_path / "dart.obj"
    path.write_text("\n".join(lines))
    surface = load_mesh(path)
    assert face_vectors(surface.vertices, surface.faces)[:, 1] / 2 == pytest.approx(np.array([0.3, 0.3]))
    folds = (f"{path}: 1 fold of hollow polygons undone",)
    assert surface.notices[-1:] == (() if start in (0, 2) else folds)
