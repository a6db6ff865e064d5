from __future__ import annotations

from dataclasses import replace

import numpy as np
import trimesh

from furbake.surface.lay.guide import AXES, frames, nose
from furbake.surface.mesh import Surface, clean
from furbake.surface.shapes import builtin


def test_sides_are_right_handed_and_laid_as_asked() -> None:
    surface = builtin("sphere")
    for guide in ("nose-tail", "down"):
        u, v = frames(surface, guide)
        np.testing.assert_allclose(np.cross(u, v), AXES, atol=1e-12)
    _, v = frames(surface, "nose-tail")
    np.testing.assert_allclose(v[2:4], [[0, 0, -1]] * 2, atol=1e-12)  # above, below: to the tail
    np.testing.assert_allclose(v[4:6], [[0, -1, 0]] * 2, atol=1e-12)  # front, back: down
    assert (v[:2, 2] < -0.9).all()  # flanks: to the tail ...
    assert (v[:2, 1] < -0.2).all()  # ... and a little down
    _, v = frames(surface, "down")
    np.testing.assert_allclose(v[[0, 1, 4, 5]], [[0, -1, 0]] * 4, atol=1e-12)


def animal(length: float, head: float) -> Surface:
    """A long low box with a raised end at `head` (the sign of x)."""
    body = trimesh.creation.box((length, 0.4, 0.4))
    top = trimesh.creation.box((0.3, 0.5, 0.3))
    top.apply_translation([head * (0.5 * length - 0.15), 0.5, 0])
    both = trimesh.util.concatenate([body, top])
    return clean("animal", np.asarray(both.vertices), np.asarray(both.faces))


def test_nose() -> None:
    assert nose(builtin("sphere")).tolist() == [0, 0, 1]
    assert nose(animal(2.0, 1.0)).tolist() == [1, 0, 0]
    assert nose(animal(2.0, -1.0)).tolist() == [-1, 0, 0]
    turned = animal(2.0, 1.0)
    turned = replace(turned, vertices=turned.vertices[:, [2, 1, 0]])
    assert nose(turned).tolist() == [0, 0, 1]
