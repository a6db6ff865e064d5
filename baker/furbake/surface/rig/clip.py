"""Values of a channel at any time (glTF 2.0, appendix C)."""

from __future__ import annotations

import numpy as np

from furbake.surface.rig.rig import Channel, Floats, Ints

PARALLEL = 1.0 - 1e-9
"""Cosine between two rotations above which they are mixed in a straight line."""


def sample(channel: Channel, seconds: Floats) -> Floats:
    """(n, width) values at (n,) times; before the first key and after the last one theirs. Rotations have length 1."""
    times, values = channel.times, channel.values
    cubic = channel.interpolation == "CUBICSPLINE"
    keys = values.reshape(len(times), 3, -1)[:, 1] if cubic else values
    now = np.clip(seconds, times[0], times[-1])
    before = np.clip(np.searchsorted(times, now, side="right") - 1, 0, max(len(times) - 2, 0))
    after = np.minimum(before + 1, len(times) - 1)
    length = times[after] - times[before]
    share = ((now - times[before]) / np.where(length > 0.0, length, 1.0))[:, None]
    if channel.interpolation == "STEP":
        found = np.where(share < 1.0, keys[before], keys[after])
    elif cubic:
        found = _spline(values.reshape(len(times), 3, -1), before, after, share, length[:, None])
    elif channel.path == "rotation":
        found = _slerp(_unit(keys[before]), _unit(keys[after]), share)
    else:
        found = (1.0 - share) * keys[before] + share * keys[after]
    return _unit(found) if channel.path == "rotation" else found


def _spline(values: Floats, before: Ints, after: Ints, share: Floats, length: Floats) -> Floats:
    t, tt, ttt = share, share**2, share**3
    start, leaving = values[before, 1], length * values[before, 2]
    end, arriving = values[after, 1], length * values[after, 0]
    first = (2 * ttt - 3 * tt + 1) * start + (ttt - 2 * tt + t) * leaving
    return np.asarray(first + (3 * tt - 2 * ttt) * end + (ttt - tt) * arriving)


def _slerp(one: Floats, other: Floats, share: Floats) -> Floats:
    cosine = np.einsum("ij,ij->i", one, other)[:, None]
    other, cosine = np.where(cosine < 0.0, -other, other), np.abs(cosine)
    angle = np.arccos(np.minimum(cosine, 1.0))
    sine = np.where(cosine < PARALLEL, np.sin(angle), 1.0)
    first = np.where(cosine < PARALLEL, np.sin((1.0 - share) * angle) / sine, 1.0 - share)
    second = np.where(cosine < PARALLEL, np.sin(share * angle) / sine, share)
    return first * one + second * other


def _unit(turns: Floats) -> Floats:
    length = np.linalg.norm(turns, axis=1, keepdims=True)
    return np.where(length > 0.0, turns / np.where(length > 0.0, length, 1.0), np.array([0.0, 0.0, 0.0, 1.0]))
