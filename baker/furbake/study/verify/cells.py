"""Eyes and lamps of the comparison: the same for the tracer and the page."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

FIELD_OF_VIEW = 20.0
"""Degrees, from the picture's lower to its upper edge."""

MARGIN = 1.04
"""Room around the fur in the picture."""


@dataclass(frozen=True)
class Cell:
    """An eye and a lamp.

    view, lamp : their names; eye : where it is, model units; to_lamp : unit vector towards the lamp, model axes
    """

    view: str
    lamp: str
    eye: Floats
    to_lamp: Floats

    @property
    def name(self) -> str:
        return f"{self.view}-{self.lamp}"


@dataclass(frozen=True)
class Plan:
    """Eyes and lamps of a body.

    eyes : azimuth from +z towards +x and elevation of each, degrees
    lamps : towards each, seen from the eye: right, up, at the eye
    """

    eyes: dict[str, tuple[float, float]]
    lamps: dict[str, tuple[float, float, float]]


PLANS = {
    "body": Plan(
        {"front": (-20.0, 10.0), "back": (160.0, 10.0)},
        {"frontleft": (-0.55, 0.55, 0.63), "side": (1.0, 0.3, 0.05), "behind": (0.35, 0.5, -0.8)},
    ),
    "round": Plan(
        {"front": (20.0, 25.0)},
        {"eye": (0.0, 0.0, 1.0), "beside": (0.7, 0.12, 0.7), "side": (1.0, 0.0, 0.0)},
    ),
}
"""The six cells of any body; and the lamp at the eye, at 45° and at 90° for shapes that are alike from all sides."""


@dataclass(frozen=True)
class Frame:
    """Framing of the pictures.

    centre : (3,) all eyes look at it; radius : of the skin around it, model units
    distance : of the eyes from it; width, height : pixels; field : from the lower to the upper edge, degrees
    """

    centre: Floats
    radius: float
    distance: float
    width: int
    height: int
    field: float = FIELD_OF_VIEW


def axes(azimuth: float, elevation: float) -> Floats:
    """(3, 3) rows right, up and towards the eye; degrees."""
    a, e = np.radians([azimuth, elevation])
    back = np.array([np.sin(a) * np.cos(e), np.sin(e), np.cos(a) * np.cos(e)])
    right = np.array([np.cos(a), 0.0, -np.sin(a)])
    return np.stack([right, np.cross(back, right), back])


def frame(vertices: Floats, length: float, plan: Plan, size: int, nearness: float = 1.0) -> Frame:
    """The nearest distance at which all of the fur is in every picture, which is `size` wide and 5/6 of it high.

    vertices : (V, 3) of the skin; length : of the longest fur, model units; nearness : share of that distance
    """
    height = round(size * 5 / 6)
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    centre = (low + high) / 2
    slope = np.tan(np.radians(FIELD_OF_VIEW) / 2)
    distance = 0.0
    for azimuth, elevation in plan.eyes.values():
        right, up, back = (axes(azimuth, elevation) @ (vertices - centre).T)[:]
        wide = (np.abs(right) + length) / (slope * size / height)
        tall = (np.abs(up) + length) / slope
        distance = max(distance, float((back + MARGIN * np.maximum(wide, tall)).max()))
    radius = float(np.linalg.norm(vertices - centre, axis=1).max())
    return Frame(centre, radius, nearness * distance, size, height)


def cells(plan: Plan, seen: Frame) -> list[Cell]:
    """All lamps for the first eye, then all for the next."""
    found = []
    for view, (azimuth, elevation) in plan.eyes.items():
        turn = axes(azimuth, elevation)
        for lamp, direction in plan.lamps.items():
            towards = np.array(direction) @ turn
            eye = seen.centre + seen.distance * turn[2]
            found.append(Cell(view, lamp, eye, towards / np.linalg.norm(towards)))
    return found
