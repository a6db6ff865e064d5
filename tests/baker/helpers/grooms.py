"""Grooms written byte by byte, and a body that they stand on."""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np

PER_STRAND = 5


def strands(count: int = 400, length: float = 0.2, seed: int = 0) -> np.ndarray:
    """(S, P, 3) hairs on a ball of radius 1, all laid towards −y, a little out of the surface."""
    rng = np.random.default_rng(seed)
    z = 1 - (2 * np.arange(count) + 1) / count
    angle = np.pi * (1 + 5**0.5) * np.arange(count) + rng.uniform(-0.05, 0.05, count)
    root = np.stack([np.sqrt(1 - z * z) * np.cos(angle), z, np.sqrt(1 - z * z) * np.sin(angle)], axis=1)
    down = np.array([0.0, -1.0, 0.0]) + root * root[:, 1:2]
    down /= np.maximum(np.linalg.norm(down, axis=1, keepdims=True), 1e-9)
    way = 0.6 * root + 0.8 * down
    return root[:, None] + length * np.linspace(0, 1, PER_STRAND)[:, None] * way[:, None]


def hair(hairs: np.ndarray, arrays: int = 2, **changed: object) -> bytes:
    """A `.hair` of strands (S, P, 3); changed : fields of its header."""
    count, each = hairs.shape[:2]
    header = {
        "magic": b"HAIR", "strands": count, "points": count * each, "arrays": arrays, "segments": each - 1,
        "thickness": 0.01, "transparency": 0.0, "red": 0.5, "green": 0.25, "blue": 0.125,
    } | changed  # fmt: skip
    return struct.pack("<4s4I5f", *header.values()) + bytes(88) + hairs.astype("<f4").tobytes()


def tfx(points: np.ndarray, **changed: object) -> bytes:
    """A `.tfx` of strands (S, P, 3), with a thickness of each; changed : fields of its header."""
    count, each = points.shape[:2]
    places = np.concatenate([points, np.ones((count, each, 1))], axis=-1).astype("<f4").tobytes()
    header = {
        "version": 4.0, "strands": count, "each": each, "places": 160, "uv": 0, "uvs": 0,
        "thickness": 160 + len(places), "colours": 0,
    } | changed  # fmt: skip
    return struct.pack("<f7I", *header.values()) + bytes(128) + places + np.full(count, 0.01, "<f4").tobytes()


def usda(path: Path, points: np.ndarray, head: str = "", body: str = "", **said: str) -> Path:
    """A stage of curves as text; said : attributes in place of the usual ones."""
    count, each = points.shape[:2]
    rows = ", ".join("({:.9g}, {:.9g}, {:.9g})".format(*row) for row in points.reshape(-1, 3))
    attributes = {
        "uniform token type": '"linear"',
        "uniform token wrap": '"nonperiodic"',
        "int[] curveVertexCounts": f"[{', '.join([str(each)] * count)}]",
        "point3f[] points": f"[{rows}]",
    } | said
    told = "\n".join(f"    {name} = {value}" for name, value in attributes.items() if value)
    path.write_text(f'#usda 1.0\n({head})\n{body}\ndef BasisCurves "fur"\n{{\n{told}\n}}\n', "utf-8")
    return path
