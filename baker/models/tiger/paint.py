"""The tiger cub's colours, and how long its fur is, at any point of its skin."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from shape import TAIL

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

ORANGE, DEEP, WHITE, BLACK, PINK = (
    np.array(colour, dtype=np.float64)
    for colour in ((250, 168, 78), (240, 138, 48), (255, 252, 244), (30, 23, 21), (236, 178, 158))
)
"""sRGB."""

HEAD = np.array([0.0, 1.36, 0.12])


def colours(points: Floats) -> Floats:
    """(n, 3) sRGB 0..255 at (n, 3) points."""
    y = points[:, 1]
    rise = np.clip((y - 0.1) / 1.5, 0.0, 1.0)[:, None]
    found = DEEP + (ORANGE - DEEP) * rise
    for where, colour in ((white(points), WHITE), (black(points), BLACK), (inner_ear(points), PINK)):
        found = np.where(where[:, None], colour, found)
    return found


def white(points: Floats) -> Flags:
    """Belly, throat, muzzle, cheeks, spots over the eyes, the insides of the legs, toes."""
    x, y, z = points.T
    side, ripple = np.abs(x), 0.02 * wave(points, 9.0)
    belly = (z > 0.10 + 0.9 * side**1.5 + ripple) & (side < 0.20 + ripple) & (y > 0.3) & (y < 1.05)
    throat = (z > 0.14 + ripple) & (y > 0.95) & (y < 1.17 + ripple) & (side < 0.30)
    muzzle = (z > 0.36) & (y < 1.27 - 0.3 * side + ripple)
    cheek = (y < 1.22 + 0.25 * (side - 0.2) + ripple) & (y > 1.0) & (z > 0.02) & (side > 0.1)
    brow = ((side - 0.155) / 0.062) ** 2 + ((y - 1.515) / 0.05) ** 2 < 1.0
    brow &= z > 0.2
    toes = (y < 0.10 + ripple) & (z > 0.36) & (side < 0.6)
    legs = (y < 0.7) & (y > 0.1) & (side < 0.155 + ripple) & (z > 0.05)
    return np.asarray((belly | throat | muzzle | cheek | brow | toes | legs) & ~on_tail(points))


def black(points: Floats) -> Flags:
    """All stripes, the backs of the ears, the end of the tail."""
    z = points[:, 2]
    back = ears(points) & (z < 0.07) & ~spot(points)
    return np.asarray(torso(points) | limbs(points) | face(points) | rings(points) | back)


def torso(points: Floats) -> Flags:
    """Stripes round the back, that end in points before the belly."""
    x, y, z = points.T
    behind = np.arctan2(np.abs(x), 0.05 - z)  # 0 on the back, π in front
    at = y + 0.10 * np.cos(behind * 2.0) - 0.12 * behind + 0.022 * wave(points, 6.0)
    period = 0.145
    number = np.floor(at / period)
    reach = 2.05 + 0.45 * np.sin(7.3 * number + 3.0 * (x > 0))
    width = 0.30 * np.clip((reach - behind) / reach, 0.0, 1.0) ** 0.6
    stripe = np.abs(at / period - number - 0.5) < width
    return np.asarray(stripe & (y > 0.12) & (y < 1.13) & (z < 0.16) & ~on_tail(points))


def limbs(points: Floats) -> Flags:
    """Bars on the outsides of forelegs and thighs."""
    x, y, z = points.T
    side = np.abs(x)
    fore = (z > 0.12) & (side < 0.36) & (side > 0.19) & (y > 0.16) & (y < 0.78)
    at = y / 0.125 + 0.5 * (side - 0.2) / 0.1 + 0.15 * wave(points, 8.0)
    bar = np.abs(at - np.floor(at) - 0.5) < 0.22 * np.clip((side - 0.17) / 0.10, 0.0, 1.0)
    foot = (side > 0.36) & (z > 0.10) & (y > 0.06) & (y < 0.2)
    across = z / 0.13 + 0.1 * wave(points, 8.0)
    bars = np.abs(across - np.floor(across) - 0.5) < 0.18
    return np.asarray(((fore & bar) | (foot & bars & (y > 0.11))) & ~on_tail(points))


def face(points: Floats) -> Flags:
    """Arches on the brow, bars on the crown and on the cheeks, lines round the eyes."""
    x, y, z = points.T
    side = np.abs(x)
    head = (y > 1.05) & ~ears(points)
    way = points - HEAD
    over = np.degrees(np.arctan2(way[:, 1], way[:, 2]))  # 0 in front, 90 on the crown, 180 behind
    at = (over - 38.0 + 0.9 * np.maximum(side, 0.0) * 60.0 + 3.0 * wave(points, 9.0)) / 17.0
    number = np.floor(at)
    long = 0.20 + 0.06 * np.cos(2.1 * number)
    crown = (
        (np.abs(at - number - 0.5) < 0.26 * np.clip(1.0 - side / long, 0.0, 1.0) ** 0.5) & (over > 38) & (over < 235)
    )
    middle = (side < 0.016) & (over > 30) & (over < 62)
    turn = np.degrees(np.arctan2(side, way[:, 2]))  # 0 in front, 90 at the side
    rows = (y - 1.10 + 0.10 * np.cos(np.radians(turn)) + 0.012 * wave(points, 9.0)) / 0.095
    begin = 52.0 + 10.0 * np.sin(2.4 * np.floor(rows))
    wedge = 0.30 * np.clip((turn - begin) / 40.0, 0.0, 1.0) ** 0.7
    cheeks = (
        (np.abs(rows - np.floor(rows) - 0.5) < wedge * np.clip((185 - turn) / 40, 0, 1))
        & (turn < 185)
        & (y < 1.56)
        & (side > 0.2)
    )
    eye = np.hypot((side - 0.155) / 1.15, y - 1.385)
    lined = (eye > 0.05) & (eye < 0.082) & (z > 0.2)
    tear = (np.abs(side - 0.105 - 0.25 * (1.36 - y)) < 0.014) & (y < 1.37) & (y > 1.27) & (z > 0.3)
    return np.asarray(head & (crown | middle | cheeks | lined | tear))


def rings(points: Floats) -> Flags:
    """Rings of the tail, and its black end."""
    along, apart = down_the_tail(points)
    whole = along / 0.185 + 0.06 * wave(points, 7.0)
    ring = (whole - np.floor(whole) < 0.42) & (along > 0.12)
    return np.asarray((apart < 0.16) & on_tail(points) & (ring | (along > 1.62)))


def ears(points: Floats) -> Flags:
    """Both ears, from where they leave the head."""
    x, y, _ = points.T
    return np.asarray((np.hypot(np.abs(x) - 0.335, y - 1.69) < 0.19) & (y > 1.60 + 0.6 * (0.31 - np.abs(x))))


def inner_ear(points: Floats) -> Flags:
    """Hollows of the ears."""
    x, y, z = points.T
    return np.asarray(ears(points) & (z > 0.055) & (np.hypot(np.abs(x) - 0.33, y - 1.672) < 0.10))


def spot(points: Floats) -> Flags:
    """The white spot on the back of an ear."""
    x, y, _ = points.T
    return np.asarray(np.hypot(np.abs(x) - 0.335, y - 1.70) < 0.055)


def on_tail(points: Floats) -> Flags:
    """The tail, as far as it is free of the body."""
    _, apart = down_the_tail(points)
    x, y, z = points.T
    free = (z < -0.56) | (np.abs(x) > 0.50) & (y < 0.3)
    return np.asarray((apart < 0.15) & free)


def down_the_tail(points: Floats) -> tuple[Floats, Floats]:
    """How far along the tail the nearest point of its line is, and how far away."""
    far, along, gone = np.full(len(points), np.inf), np.zeros(len(points)), 0.0
    for one, two in pairwise(TAIL):
        way = np.subtract(two, one)
        length = float(np.linalg.norm(way))
        share = np.clip((points - one) @ way / length**2, 0.0, 1.0)
        apart = np.linalg.norm(points - one - share[:, None] * way, axis=1)
        along = np.where(apart < far, gone + share * length, along)
        far = np.minimum(far, apart)
        gone += length
    return along, far


def wave(points: Floats, rate: float) -> Floats:
    """A smooth pattern within −1..1, without repeats on the cub."""
    x, y, z = points.T * rate
    return np.asarray(
        (np.sin(x + 1.3 * np.sin(y)) + np.sin(1.1 * y + 1.7 * np.sin(z)) + np.sin(0.9 * z + np.sin(x))) / 3
    )


def mane(points: Floats) -> Floats:
    """(n,) 0..1: the ruff of cheeks and neck, and the chest below it."""
    x, y, z = points.T
    side = np.abs(x)
    cheek = np.exp(-(((side - 0.38) / 0.15) ** 2 + ((y - 1.17) / 0.15) ** 2 + ((z - 0.08) / 0.2) ** 2))
    chest = np.exp(-((side / 0.20) ** 2 + ((y - 0.97) / 0.14) ** 2 + ((z - 0.30) / 0.14) ** 2))
    return np.asarray(np.clip(1.5 * np.maximum(cheek, chest), 0.0, 1.0))


def length(points: Floats) -> Floats:
    """(n,) of the fur over what the thickness of the body allows: short on the face, shortest between the eyes.

    What is as long there as elsewhere hides the far eye from all who stand aside.
    """
    x, y, z = points.T
    face = np.clip((z - 0.24) / 0.2, 0.0, 1.0) * np.clip((y - 1.06) / 0.12, 0.0, 1.0)
    bridge = np.exp(-((x / 0.12) ** 2 + ((y - 1.36) / 0.13) ** 2)) * (z > 0.3)
    return np.asarray(np.clip(1.0 - 0.6 * face - 0.3 * bridge, 0.1, 1.0))
