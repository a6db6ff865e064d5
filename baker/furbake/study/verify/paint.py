"""Hairs of many colours for a tracer with one colour per shape: pieces of splines, grouped by colour."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import TextIO

import numpy as np
from numpy.typing import NDArray
from scipy.cluster.vq import kmeans2, vq

Floats = NDArray[np.float64]

COLOURS = 40
"""Shapes, each of which has a colour of its own."""

SAMPLES = 20_000
"""Pieces from whose colours these are found."""

GAMMA = 2.2
"""Exponent that makes distances between colours look alike."""


def write_painted(folder: Path, control: Floats, colours: NDArray[np.floating]) -> Iterator[tuple[Path, Floats]]:
    """Files of curves as Mitsuba reads them, and the linear colour, (3,), of all that is in each.

    control : (S, P + 2, 4) of cubic B-splines; colours : (S, P, 3) linear, at their points. The piece between two
    points has the mean of their colours.
    """
    between = (colours[:, :-1].astype(np.float64) + colours[:, 1:]) / 2
    seen = between.reshape(-1, 3) ** (1 / GAMMA)
    some = seen[np.random.default_rng(0).integers(len(seen), size=SAMPLES)]
    centres = np.unique(np.round(some, 4), axis=0)
    if len(centres) > COLOURS:
        start = centres[np.linspace(0, len(centres) - 1, COLOURS).astype(np.intp)]
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning)  # a shade that no piece is nearest to stays empty
            centres, _ = kmeans2(some, start, minit="matrix", iter=20)
    kind = vq(seen, centres)[0].reshape(between.shape[:2])
    for number in range(len(centres)):
        hair, piece = np.nonzero(kind == number)
        if len(hair) == 0:
            continue
        path = folder / f"hairs{number}.txt"
        with path.open("w", encoding="ascii") as file:
            for run in _runs(hair, piece):
                _write(file, control, run)
        yield path, between[kind == number].mean(0)


def _runs(hair: NDArray[np.intp], piece: NDArray[np.intp]) -> Iterator[tuple[NDArray[np.intp], NDArray[np.intp], int]]:
    """Pieces of the same hair one after the other: (hairs, first pieces, their number), by that number."""
    breaks = np.flatnonzero((np.diff(hair) != 0) | (np.diff(piece) != 1)) + 1
    first = np.concatenate([[0], breaks])
    length = np.diff(np.concatenate([first, [len(hair)]]))
    for count in np.unique(length):
        chosen = first[length == count]
        yield hair[chosen], piece[chosen], int(count)


def _write(file: TextIO, control: Floats, run: tuple[NDArray[np.intp], NDArray[np.intp], int]) -> None:
    hair, piece, count = run
    points = control[hair[:, None], piece[:, None] + np.arange(count + 3)]
    line = "\n".join(["%.7g %.7g %.7g %.6g"] * (count + 3)) + "\n"
    np.savetxt(file, points.reshape(len(points), -1), fmt=line)
