"""Light that the golden assets must give, in plain loops from the formulas of the format."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from furbake.pelt.curves import Curves
from furbake.pelt.pelt import FinPelt, Pelt

LAYERS, SIZE = 4, 8


BODY_RADIUS = 4.0


TEXEL = 16 / 49  # a tip that moves so far moves the top layer by a texel


BENDS = [[TEXEL, 0.0], [0.0, TEXEL], [-TEXEL, TEXEL], [2 * TEXEL, 0.0]]


BENT_LIGHT = [0.48, 0.6, 0.64]


BODIES = [1.0, 4.0, 7.0, 16.0]


BENT_LIGHTS = [BENT_LIGHT, [0.66, 0.72, -0.2144761059]]


FILM = 0.6
"""Mud on the hairs between its crumbs, as the shader has it."""


def phi(kind: str, matrix: np.ndarray | None, light: np.ndarray) -> np.ndarray:
    """The basis functions of one light above the horizon."""
    u, v, w = light
    if kind == "ptm":
        return np.array([u * u, v * v, u * v, u, v, 1.0])
    terms = [u**i * v**j * w**k for k in range(2) for i in range(5 - k) for j in range(5 - k - i)]
    return matrix @ np.array([*terms, w**0.5, w**0.25])


def expected(pelt: Pelt, lights: np.ndarray) -> np.ndarray:
    """L, (n, K, N, N), with the fade of the light below the horizon."""
    coefficients = pelt.scale * (pelt.codes.astype(float) - pelt.bias)
    out = np.zeros((len(lights), LAYERS, SIZE, SIZE))
    for n, light in enumerate(lights):
        for k in range(LAYERS):
            fade, seen = 1.0, light
            if light[2] < 0:
                s = (k + 0.5) / LAYERS
                dip = np.sqrt(1 - (BODY_RADIUS / (BODY_RADIUS + s)) ** 2)
                fade = np.sqrt(max(0.0, 1 + light[2] / dip))
                seen = np.array([*(light[:2] / np.hypot(*light[:2])), 0.0])
            out[n, k] = np.maximum(coefficients[k] @ phi(pelt.basis.kind, pelt.basis.matrix, seen) * fade, 0)
    return out


def expected_bent(pelt: Pelt) -> np.ndarray:
    """L of the top layer, (bends, N, N), by the law of `furbake bend`."""
    texels = (pelt.scale * (pelt.codes.astype(float) - pelt.bias))[-1]
    s = (LAYERS - 0.5) / LAYERS
    lean_u, lean_v = pelt.drift[-1] / pelt.height
    u, v, up = BENT_LIGHT
    out = []
    for x, y in BENDS:
        square, along = x * x + y * y, u * x + v * y
        rise = np.sqrt(1 - square)
        way = np.array([u - (1 + s) / rise * up * x, v - (1 + s) / rise * up * y, up / rise])
        factor = 1 - 0.5 * (x * lean_u + y * lean_v) + s * (square * (2.7 * up - 1.5) - 1.8 * along * up)
        light = texels @ phi(pelt.basis.kind, pelt.basis.matrix, way / np.sqrt(way @ way))
        out.append(np.maximum(light * max(factor, 0.1), 0))
    return np.array(out)


def curve_values(curves: Curves, light: np.ndarray, along: float, beta: float) -> np.ndarray:
    """b_q of one light at its own height, (Q,); along : l_h·m of the direction at which the polynomial is taken."""
    z = light[2]
    x = 6 + 10 * np.sqrt(z) if z >= 0 else 6 * max(1 + z * (beta + 1) / np.sqrt(2 * beta + 1), 0.0)
    knot = min(int(x), 15)
    body = 0 if beta < 4 else 1
    near, far = 1 / (4**body + 1), 1 / (4 ** (body + 1) + 1)
    place = body + (near - 1 / (min(max(beta, 1), 16) + 1)) / (near - far)
    out = []
    for even, lean in zip(curves.even, curves.along, strict=True):
        value = 0.0
        for r, share in ((body, 1 - (place - body)), (body + 1, place - body)):
            low, high = even[r] + along * lean[r], 1 - (x - knot)
            value += share * (high * low[knot] + (1 - high) * low[knot + 1])
        out.append(value)
    return np.array(out)


def on_horizon(light: np.ndarray) -> np.ndarray:
    """The light, held on the horizon where it is below."""
    return np.array(light) if light[2] >= 0 else np.array([*(light[:2] / np.hypot(*light[:2])), 0.0])


def expected_curves(pelt: Pelt, lights: np.ndarray) -> np.ndarray:
    """L, (bodies, n, K, N, N), by the law of version 2.0."""
    coefficients = pelt.scale * (pelt.codes.astype(float) - pelt.bias)
    m = pelt.drift[-1] / np.hypot(*pelt.drift[-1])
    out = np.zeros((len(BODIES), len(lights), LAYERS, SIZE, SIZE))
    for b, beta in enumerate(BODIES):
        for n, light in enumerate(lights):
            seen = on_horizon(light)
            curve = curve_values(pelt.curves, light, seen[:2] @ m, beta)
            for k in range(LAYERS):
                mean = pelt.weights[k] @ curve
                out[b, n, k] = np.maximum(mean * (coefficients[k] @ phi(pelt.basis.kind, pelt.basis.matrix, seen)), 0)
    return out


def expected_curves_bent(pelt: Pelt) -> np.ndarray:
    """L of the top layer, (bodies, lights, bends, N, N)."""
    texels = (pelt.scale * (pelt.codes.astype(float) - pelt.bias))[-1]
    s = (LAYERS - 0.5) / LAYERS
    lean = pelt.drift[-1] / pelt.height
    m = lean / np.hypot(*lean)
    out = np.zeros((len(BODIES), len(BENT_LIGHTS), len(BENDS), SIZE, SIZE))
    for b, beta in enumerate(BODIES):
        for n, light in enumerate(BENT_LIGHTS):
            u, v, up = on_horizon(np.array(light))
            for i, (x, y) in enumerate(BENDS):
                square, along = x * x + y * y, u * x + v * y
                rise = np.sqrt(1 - square)
                way = np.array([u - (1 + s) / rise * up * x, v - (1 + s) / rise * up * y, up / rise])
                way /= np.sqrt(way @ way)
                factor = 1 - 0.5 * (x * lean[0] + y * lean[1]) + s * (square * (2.7 * up - 1.5) - 1.8 * along * up)
                height = way if light[2] >= 0 else np.array(light)
                mean = pelt.weights[-1] @ curve_values(pelt.curves, height, way[:2] @ m, beta)
                value = texels @ phi(pelt.basis.kind, pelt.basis.matrix, way)
                out[b, n, i] = np.maximum(value * mean * max(factor, 0.1), 0)
    return out


def expected_curves_fin(pelt: Pelt, lights: np.ndarray) -> np.ndarray:
    """L, (bodies, n, H, W), of lights (l·t, l·w, l·n); rows between two slabs' middles have mixed weights."""
    fin = pelt.fin
    coefficients = fin.scale * (fin.codes.astype(float) - fin.bias)
    rows = len(coefficients)
    lean = pelt.drift[-1][1] / np.hypot(*pelt.drift[-1])
    out = np.zeros((len(BODIES), len(lights), *fin.alpha.shape))
    for b, beta in enumerate(BODIES):
        for i, light in enumerate(lights):
            t, _, n = on_horizon(light)
            curve = curve_values(pelt.curves, light, lean * t, beta)
            for row in range(rows):
                place = min(max((row + 0.5) / rows * LAYERS - 0.5, 0.0), LAYERS - 1.0)
                low = min(int(place), LAYERS - 2)
                weights = (1 - (place - low)) * pelt.weights[low] + (place - low) * pelt.weights[low + 1]
                value = coefficients[row] @ np.array([t * t, n * n, t * n, t, n, 1.0])
                out[b, i, row] = np.maximum(weights @ curve * value, 0)
    return out


def expected_environment(pelt: Pelt, rings: int = 512, spokes: int = 256) -> dict[str, list]:
    """∫ Y·φ·b over the sphere, of shells and fins, by sums over equal steps of height and azimuth."""
    m = pelt.drift[-1] / np.hypot(*pelt.drift[-1])
    azimuth = (np.arange(spokes) + 0.5) * 2 * np.pi / spokes
    found: dict[str, list] = {"bodies": BODIES, "shells": [], "fins": []}
    for beta in BODIES:
        low = -np.sqrt(2 * beta + 1) / (beta + 1)
        shells, fins = np.zeros((3, 6, 9)), np.zeros((3, 6, 9))
        edges = np.concatenate([np.linspace(low, 0, rings // 4 + 1), (np.arange(1, rings + 1) / rings) ** 2])
        for z, step in zip((edges[1:] + edges[:-1]) / 2, np.diff(edges), strict=True):
            across = np.sqrt(1 - z * z)
            x, y = across * np.cos(azimuth), across * np.sin(azimuth)
            u, v = (x, y) if z >= 0 else (x / across, y / across)
            up, one = max(z, 0.0), np.ones(spokes)
            # Curves are linear in l·m: their values there and back give both parts.
            fore, back = (curve_values(pelt.curves, np.array([0, 0, z]), a, beta) for a in (1.0, -1.0))
            even, lean = (fore + back) / 2, (fore - back) / 2
            area = step * 2 * np.pi / spokes
            parts = (
                (shells, (u * u, v * v, u * v, u, v, one), u * m[0] + v * m[1], (x, y, z * one)),
                (fins, (v * v, up * up * one, v * up, v, up * one, one), v * m[1], (y, z * one, x)),
            )
            for total, terms, along, frame in parts:
                curve = even[:, None] + lean[:, None] * along
                np.add(total, area * np.einsum("qa,ca,ja->qcj", curve, np.array(terms), nine(*frame)), out=total)
        found["shells"].append(np.round(shells, 5).tolist())
        found["fins"].append(np.round(fins, 5).tolist())
    return found


def nine(x: np.ndarray, y: np.ndarray, z: np.ndarray) -> np.ndarray:
    """The real harmonics to order 2 as the format has them, (9, n)."""
    c = np.sqrt(1 / np.pi)
    return np.array([
        c / 2 + 0 * x, c * np.sqrt(3) / 2 * y, c * np.sqrt(3) / 2 * z, c * np.sqrt(3) / 2 * x,
        c * np.sqrt(15) / 2 * x * y, c * np.sqrt(15) / 2 * y * z, c * np.sqrt(5) / 4 * (3 * z * z - 1),
        c * np.sqrt(15) / 2 * x * z, c * np.sqrt(15) / 4 * (x * x - y * y),
    ])  # fmt: skip


def expected_fin(fin: FinPelt, lights: np.ndarray) -> np.ndarray:
    """L, (n, H, W): the same law with n for N; below the skin l·n is 0 and (l·t, l·w) a unit vector."""
    coefficients = fin.scale * (fin.codes.astype(float) - fin.bias)
    rows = len(coefficients)
    out = np.zeros((len(lights), *fin.alpha.shape))
    for i, (t, w, n) in enumerate(lights):
        for row in range(rows):
            fade, lu, lv = 1.0, t, n
            if n < 0:
                dip = np.sqrt(1 - (BODY_RADIUS / (BODY_RADIUS + (row + 0.5) / rows)) ** 2)
                fade, lu, lv = np.sqrt(max(0.0, 1 + n / dip)), t / np.hypot(t, w), 0.0
            value = coefficients[row] @ np.array([lu * lu, lv * lv, lu * lv, lu, lv, 1.0])
            out[i, row] = np.maximum(value * fade, 0)
    return out


def expected_weather(pelts: list[Pelt], wetness: float, dirt: float, lights: np.ndarray) -> np.ndarray:
    """Red radiance · 4π, (n, K, N, N), of states in the order of `STATES` after the dry one; all fully covered."""
    *clean, dirty = pelts
    steps = [pelt.state.wetness for pelt in clean]
    after = next((i for i, step in enumerate(steps) if step >= wetness), len(steps) - 1)
    drier, wetter = clean[max(after - 1, 0)], clean[after]
    apart = wetter.state.wetness - drier.state.wetness
    part = (wetness - drier.state.wetness) / apart if apart else 0.0
    codes = (1 - part) * drier.codes.astype(float) + part * wetter.codes.astype(float)
    shade = (1 - part) * drier.state.shade + part * wetter.state.shade
    share = dirty.tint / 255
    lit = (dirt * ((1 - wetness) + wetness * share))[..., None]
    mixed = replace(clean[0], codes=(1 - lit) * codes + lit * dirty.codes)
    mud = np.maximum(dirt * share, FILM * dirt)
    return expected(mixed, lights) * (shade * ((1 - mud) + mud * dirty.state.mud[0]))
