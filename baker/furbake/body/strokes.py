"""Strokes of a comb from a file, and a sentence for each mistake in it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from furbake.surface.files import read_records
from furbake.surface.lay.field import WIDEST, Stroke
from furbake.surface.mesh import MeshError, Surface

MAX_STROKES = 1000
"""Strokes of a file: each is compared with all vertices."""

WHOLE = 'expected {"strokes": [{"points": [[x, y, z], ...], "strength": 0..1}, ...]}'


def read_strokes(path: Path) -> tuple[Stroke, ...]:
    """Strokes of a comb: `{"strokes": [{"points": [[x, y, z], ...], "strength": 1}, ...]}`, model units.

    Raises MeshError that says what is wrong.
    """
    records = read_records(path, "strokes", WHOLE)["strokes"]
    if not 1 <= len(records) <= MAX_STROKES:
        raise MeshError(f"{path}: {len(records)} strokes, expected 1 to {MAX_STROKES}")
    return tuple(_stroke(record, f"{path}: stroke {number}") for number, record in enumerate(records, 1))


def _stroke(record: Any, where: str) -> Stroke:
    """One stroke. Raises MeshError, which begins with where it stands."""
    try:
        points, strength = np.array(record["points"], np.float64), float(record.get("strength", 1.0))
    except (ValueError, TypeError, LookupError, AttributeError, OverflowError) as error:
        raise MeshError(f"{where} is not a line of points with a strength, {WHOLE}") from error
    if points.ndim != 2 or points.shape[1] != 3 or len(points) < 2 or not np.isfinite(points).all():
        raise MeshError(f"{where} is not a line of points, {WHOLE}")
    if not (points != points[:1]).any():
        raise MeshError(f"{where} has no length, expected two or more different points")
    if not 0 <= strength <= 1:
        raise MeshError(f"{where} has the strength {strength:g}, expected 0 to 1")
    return Stroke(points, strength)


def strokes_on(surface: Surface, path: Path) -> tuple[Stroke, ...]:
    """Strokes of a file, none of which is too far from the surface to comb it. Raises MeshError."""
    strokes = read_strokes(path)
    low, high = surface.vertices.min(axis=0), surface.vertices.max(axis=0)
    for number, stroke in enumerate(strokes, 1):
        gap = np.maximum(np.maximum(low - stroke.points.max(axis=0), stroke.points.min(axis=0) - high), 0.0)
        if np.linalg.norm(gap) > WIDEST * surface.extent:
            box = " to ".join(f"({', '.join(f'{value:.4g}' for value in corner)})" for corner in (low, high))
            raise MeshError(f"{path}: stroke {number} is far from the body, expected points on it, in {box}")
    return strokes
