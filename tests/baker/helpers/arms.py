"""Characters made by hand, as surfaces with their rigs."""

from __future__ import annotations

from typing import Any

import numpy as np

from furbake.surface.mesh import Surface, clean
from furbake.surface.rig.rig import BODY, Channel, Clip, Rig, RigNode, Target
from furbake.surface.shapes import builtin


def turned(axis: tuple[float, float, float], degrees: float) -> np.ndarray[Any, Any]:
    """Unit quaternion x, y, z, w."""
    half = np.radians(degrees) / 2
    return np.array([*np.sin(half) * np.array(axis), np.cos(half)])


def tube(rows: int = 24, columns: int = 16) -> Surface:
    """A closed tube along x from 0 to 4, half a unit thick."""
    x = np.repeat(np.linspace(0, 4, rows), columns)
    turn = np.tile(np.arange(columns) / columns * 2 * np.pi, rows)
    side = np.stack([x, 0.5 * np.cos(turn), 0.5 * np.sin(turn)], axis=1)
    r, c = (index.reshape(-1) for index in np.mgrid[: rows - 1, :columns])
    a, b = r * columns + c, r * columns + (c + 1) % columns
    around = np.arange(columns)
    low, high = len(side), len(side) + 1
    last = (rows - 1) * columns
    faces = np.concatenate([
        np.stack([a, b, b + columns], axis=1), np.stack([a, b + columns, a + columns], axis=1),
        np.stack([np.full(columns, low), (around + 1) % columns, around], axis=1),
        np.stack([np.full(columns, high), last + around, last + (around + 1) % columns], axis=1),
    ])  # fmt: skip
    return clean("tube", np.vstack([side, [[-0.3, 0, 0], [4.3, 0, 0]]]), faces)


def node(name: str, parent: int, place: Any = (0, 0, 0), turn: Any = (0, 0, 0, 1), size: Any = 1.0) -> RigNode:
    scale = np.broadcast_to(np.asarray(size, np.float64), (3,)).copy()
    return RigNode(name, parent, np.array(place, np.float64), np.array(turn, np.float64), scale)


def arm(joints: int = 3, targets: bool = True) -> tuple[Surface, Rig]:
    """A tube whose joints take over from each other, below a node that is moved, turned and half as large.

    Two targets: a bump at one end, and a twist of all of it. Clips: bend (LINEAR and STEP), sway (CUBICSPLINE), shapes.
    """
    surface = tube()
    step = 4 / joints
    stand = node("stand", -1, (0.0, 1.0, 0.0), turned((0, 0, 1), 90), 0.5)
    # The stand turned by 90° about z: along x of the scene is along -y of the stand.
    nodes = [stand, node("joint 0", 0, (-2.0, 0.0, 0.0), turned((0, 0, 1), -90), 2.0)]
    nodes += [node(f"joint {i}", i, (step, 0, 0)) for i in range(1, joints)]
    vertices = surface.vertices
    starts = step * np.arange(joints)
    inverse = np.tile(np.eye(4), (joints, 1, 1))
    inverse[:, 0, 3] = -starts
    along = np.clip(vertices[:, 0] / step, 0, joints - 1 - 1e-9) if joints > 1 else np.zeros(len(vertices))
    first = np.floor(along).astype(np.int64)
    zero = np.zeros_like(first)
    which = np.stack([first, np.minimum(first + 1, joints - 1), zero, zero], axis=1)
    shares = np.stack([1 - along + first, along - first, 0.0 * along, 0.0 * along], axis=1)
    return surface, Rig(
        nodes=tuple(nodes),
        joints=tuple(range(1, joints + 1)),
        inverse_bind=inverse,
        vertices=vertices,
        posed=vertices,
        faces=surface.faces,
        which=which,
        shares=shares,
        targets=shapes(vertices) if targets else (),
        clips=clips(joints, targets),
    )


def shapes(vertices: Any) -> tuple[Target, ...]:
    bump = np.maximum(vertices[:, 0] - 3.4, 0.0)[:, None] * np.array([0.0, 0.8, 0.3])
    angle = 0.5 * vertices[:, 0] / 4
    _, y, z = vertices.T
    twist = np.stack(
        [0 * y, (np.cos(angle) - 1) * y - np.sin(angle) * z, np.sin(angle) * y + (np.cos(angle) - 1) * z], 1
    )
    return Target("bump", bump), Target("twist", twist, 0.25)


def clips(joints: int, targets: bool) -> tuple[Clip, ...]:
    keys = np.array([0.0, 0.5, 1.25])
    turns = np.array([turned((0, 0, 1), angle) for angle in (0, 50, -20)])
    last = joints  # node of the last joint
    bend = [
        Channel(last, "rotation", keys, turns),
        Channel(1, "translation", keys, np.array([[-2.0, 0, 0], [-2.0, 0.5, 0], [-2.1, 0, 0.2]]), "STEP"),
        Channel(last, "scale", keys[:2], np.array([[1.0, 1, 1], [1.2, 0.9, 1]])),
    ]
    cubic = np.zeros((9, 4))
    cubic[1::3] = turns
    cubic[0::3, 2], cubic[2::3, 2] = 0.4, -0.3
    found = [Clip("bend", tuple(bend)), Clip("sway", (Channel(1, "rotation", keys, cubic, "CUBICSPLINE"),))]
    if targets:
        found.append(Clip("shapes", (Channel(BODY, "weights", keys, np.array([[0.0, 0], [1, 0.5], [0.2, 1]])),)))
    return tuple(found)


def ring() -> tuple[Surface, Rig]:
    """A coarse torus of two joints below a node: a root, and one that has its half with x > 0.

    Two targets: a bulge on the other half, and a twist of all. One clip, `walk`: LINEAR, STEP and CUBICSPLINE.
    """
    surface = builtin("torus:12x8")
    vertices = surface.vertices
    share = np.clip(vertices[:, 0] / np.ptp(vertices[:, 0]) * 2 + 0.5, 0, 1)
    zero = np.zeros(len(vertices), dtype=np.int64)
    inverse = np.stack([np.eye(4), np.eye(4)])
    inverse[1, :3, 3] = (-0.2, 0, 0)
    bulge = np.maximum(-vertices[:, 0], 0.0)[:, None] * np.array([0.0, 0.5, 0.2])
    x, y, z = vertices.T
    twist = np.stack([0 * x, -0.4 * x * z, 0.4 * x * y], axis=1)
    keys = np.array([0.0, 0.5, 1.0])
    spline = np.zeros((9, 3))
    spline[1::3, 0], spline[2::3, 1], spline[0::3, 2] = (0.2, 0.3, 0.1), 0.4, -0.3
    walk = Clip("walk", (
        Channel(1, "rotation", keys, np.array([turned((0, 0.6, 0.8), angle) for angle in (0, 20, -10)])),
        Channel(2, "rotation", keys, np.array([turned((0, 0, 1), angle) for angle in (0, 60, -30)])),
        Channel(2, "translation", keys, spline, "CUBICSPLINE"),
        Channel(2, "scale", keys, np.array([[1.0, 1, 1], [1.25, 1.25, 1.25], [0.8, 0.8, 0.8]]), "STEP"),
        Channel(BODY, "weights", keys, np.array([[0.0, 0], [1, 0.5], [0.25, 1]])),
    ))  # fmt: skip
    nodes = (node("stand", -1, (0, 1, 0), turned((0, 0, 1), 90), 0.5),
             node("root", 0, (-2, 0, 0), turned((0, 0, 1), -90), 2.0), node("half", 1, (0.2, 0, 0)))  # fmt: skip
    return surface, Rig(
        nodes=nodes,
        joints=(1, 2),
        inverse_bind=inverse,
        vertices=vertices,
        posed=vertices,
        faces=surface.faces,
        which=np.stack([zero, zero + 1, zero, zero], axis=1),
        shares=np.stack([1 - share, share, 0 * share, 0 * share], axis=1),
        targets=(Target("bulge", bulge), Target("twist", twist)),
        clips=(walk,),
    )
