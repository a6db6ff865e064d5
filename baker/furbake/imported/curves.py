"""Strands of a groom as lines of points."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

Single = NDArray[np.float32]
Ints = NDArray[np.int64]
Floats = NDArray[np.float64]

INSIDE = 0.999
"""Share of the way from a strand's number to the next one's at which its tip lies, where all are one line."""


class GroomError(ValueError):
    """A groom that cannot be read, bound or written; one sentence that says why, and what would help."""


@dataclass(frozen=True)
class Curves:
    """Strands, roots first, one behind the other.

    points : (N, 3); counts : (S,) points of each strand, 2 at least
    widths : (N,) or None; colours : (N, 3) linear or None
    notices : what was left out, one sentence each
    """

    points: Single
    counts: Ints
    widths: Single | None = None
    colours: Single | None = None
    notices: tuple[str, ...] = ()

    @property
    def count(self) -> int:
        """Number of strands."""
        return len(self.counts)

    @property
    def starts(self) -> Ints:
        """(S,) index of each strand's root."""
        return np.asarray(np.cumsum(self.counts) - self.counts)

    @property
    def ends(self) -> Ints:
        """(S,) index of each strand's tip."""
        return np.asarray(np.cumsum(self.counts) - 1)

    @property
    def of(self) -> Ints:
        """(N,) strand of each point."""
        return np.repeat(np.arange(self.count), self.counts)

    def lengths(self) -> Floats:
        """(S,) length of each strand along its points."""
        steps = np.linalg.norm(np.diff(self.points.astype(np.float64), axis=0), axis=1)
        of = self.of
        return np.asarray(np.bincount(of[1:], np.where(of[1:] == of[:-1], steps, 0.0), self.count), np.float64)

    def mean(self, values: Single) -> Floats:
        """(S,) mean along each strand of values (N,) at its points."""
        steps = np.linalg.norm(np.diff(self.points.astype(np.float64), axis=0), axis=1)
        of = self.of
        steps = np.where(of[1:] == of[:-1], np.maximum(steps, 1e-30), 0.0)
        between = (values[1:] + values[:-1]) / 2
        return np.asarray(np.bincount(of[1:], steps * between, self.count) / np.bincount(of[1:], steps, self.count))

    def some(self, which: NDArray[np.bool_]) -> Curves:
        """Some of the strands, (S,)."""
        points = np.repeat(which, self.counts)
        return replace(
            self,
            points=self.points[points],
            counts=self.counts[which],
            widths=None if self.widths is None else self.widths[points],
            colours=None if self.colours is None else self.colours[points],
        )

    def evened(self, which: Ints, points: int) -> tuple[Floats, Floats | None, Floats | None]:
        """Places, widths and colours of some strands at `points` evenly spaced places, (n, points, ...)."""
        steps = np.r_[0.0, np.linalg.norm(np.diff(self.points.astype(np.float64), axis=0), axis=1)]
        steps[self.starts] = 0.0
        along = np.cumsum(steps)
        along -= np.repeat(along[self.starts], self.counts)
        whole = np.repeat(np.maximum(along[self.ends], 1e-30), self.counts)
        line = self.of + INSIDE * along / whole
        wanted = which[:, None] + INSIDE * np.linspace(0.0, 1.0, points)

        def at(values: Single) -> Floats:
            flat = values.reshape(len(values), -1)
            found = [np.interp(wanted, line, column) for column in flat.T]
            return np.stack(found, -1) if values.ndim > 1 else found[0]

        widths = None if self.widths is None else at(self.widths)
        return at(self.points), widths, None if self.colours is None else at(self.colours)


def nearest_others(tree: cKDTree, places: Floats, count: int) -> Ints:
    """(n, count) the nearest other points of a tree at each of some of its own (n, d); fewer where it has no more."""
    most = min(count + 1, tree.n)
    found = np.asarray(tree.query(places, k=most)[1], np.int64)
    return found.reshape(len(places), most)[:, 1:]


def checked(
    name: str, points: NDArray[Any], counts: NDArray[Any],
    widths: NDArray[Any] | None = None, colours: NDArray[Any] | None = None,
) -> Curves:  # fmt: skip
    """Curves of arrays that a file holds, without strands that are none. Raises GroomError where none is left."""
    if not len(counts):
        raise GroomError(f"{name}: no curves, expected strands of two points or more")
    many: Ints = np.asarray(counts, np.int64)
    if (many < 0).any() or int(many.sum()) != len(points):
        raise GroomError(f"{name}: {len(points)} points for strands that count {int(many.sum())}, expected as many")
    with np.errstate(over="ignore"):
        found = Curves(
            np.ascontiguousarray(points, np.float32),
            many,
            None if widths is None else np.ascontiguousarray(widths, np.float32),
            None if colours is None else np.clip(np.nan_to_num(np.asarray(colours, np.float32)), 0.0, None),
        )
    short = many < 2
    if short.all():
        raise GroomError(f"{name}: {len(counts)} curves of one point, expected strands of two points or more")
    notices = []
    if short.any():
        notices.append(f"{name}: {int(short.sum())} curves of less than two points left out")
        found = found.some(~short)
    fine = np.isfinite(found.points).all(axis=1)
    if found.widths is not None:
        fine &= np.isfinite(found.widths)
    broken = np.bincount(found.of, ~fine, found.count) > 0
    if broken.all():
        raise GroomError(f"{name}: every curve has a point that is NaN or infinite, expected numbers")
    if broken.any():
        notices.append(f"{name}: {int(broken.sum())} curves with NaN or infinity left out")
        found = found.some(~broken)
    flat = found.lengths() == 0.0
    if flat.all():
        raise GroomError(f"{name}: every curve has all its points at one place, expected strands that are long")
    if flat.any():
        notices.append(f"{name}: {int(flat.sum())} curves without a length left out")
        found = found.some(~flat)
    widths_ = None if found.widths is None else np.maximum(found.widths, 0.0)
    if widths_ is not None and not widths_.any():
        notices.append(f"{name}: all widths are 0 or less, taken as none")
        widths_ = None
    return replace(found, widths=widths_, notices=tuple(notices))
