"""Hairs of many colours for a tracer with one colour per shape: pieces of splines, grouped by colour."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.cluster.vq import kmeans2
from scipy.spatial import Delaunay

from furbake.study.verify.pathtrace import write_curves

Floats = NDArray[np.float64]

COLOURS = 40
"""Shapes, each of which has a colour of its own, and eight more around all colours."""

SAMPLES = 20_000
"""Pieces from whose colours these are found."""

MARGIN = 0.01
"""How far the outermost shades lie beyond all colours."""

GAMMA = 2.2
"""Exponent that makes distances between colours look alike."""


def write_painted(folder: Path, control: Floats, colours: NDArray[np.floating]) -> Iterator[tuple[Path, Floats]]:
    """Files of curves as Mitsuba reads them, and the linear colour, (3,), of all that is in each.

    control : (S, P + 2, 4) of cubic B-splines; colours : (S, P, 3) linear, at their points. The piece between two
    points has the mean of their colours, as of `shaded`.
    """
    between = (colours[:, :-1].astype(np.float64) + colours[:, 1:]) / 2
    shades, kind = shaded(between)
    for number, shade in enumerate(shades):
        hair, piece = np.nonzero(kind == number)
        if len(hair) == 0:
            continue
        path = folder / f"hairs{number}.txt"
        write_curves(path, _runs(control, hair, piece))
        yield path, shade


def shaded(between: Floats) -> tuple[Floats, NDArray[np.intp]]:
    """Shades (n, 3) and one of them for each piece, (S, P − 1), by chance: their mean is the colours', (S, P − 1, 3).

    Each piece has one of the four shades around its colour, as often as its place between them says. The nearest shade
    would bring an error that goes with the height: the saturation of a wolf's light would be 8 % too great by 40 of
    them.
    """
    flat = between.reshape(-1, 3)
    rng = np.random.default_rng(0)
    some = flat[rng.integers(len(flat), size=SAMPLES)] ** (1 / GAMMA)
    centres = np.unique(np.round(some, 4), axis=0)
    if len(centres) > COLOURS:
        start = centres[np.linspace(0, len(centres) - 1, COLOURS).astype(np.intp)]
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning)  # a shade that no piece is nearest to stays empty
            centres, _ = kmeans2(some, start, minit="matrix", iter=20)
    low, high = np.maximum(flat.min(0) - MARGIN, 0.0), np.minimum(flat.max(0) + MARGIN, 1.0)
    corners = np.where(np.indices((2, 2, 2)).reshape(3, -1).T == 1, high, low)
    shades = np.unique(np.concatenate([np.clip(centres**GAMMA, low, high), corners]), axis=0)
    mesh = Delaunay(shades)
    around = np.maximum(mesh.find_simplex(flat, tol=1e-9), 0)
    turn = mesh.transform[around]
    three = np.clip(np.einsum("nij,nj->ni", turn[:, :3], flat - turn[:, 3]), 0.0, 1.0)
    # One number for all of a hair: its pieces change their shade seldom.
    chance = np.repeat(rng.random(len(between)), between.shape[1])
    corner = (chance[:, None] >= np.cumsum(three, axis=1)).sum(1)
    return shades, mesh.simplices[around, corner].astype(np.intp).reshape(between.shape[:2])


def _runs(control: Floats, hair: NDArray[np.intp], piece: NDArray[np.intp]) -> Iterator[Floats]:
    """Control points of pieces that follow each other on a hair, joined, by the number of pieces."""
    breaks = np.flatnonzero((np.diff(hair) != 0) | (np.diff(piece) != 1)) + 1
    first = np.concatenate([[0], breaks])
    length = np.diff(np.concatenate([first, [len(hair)]]))
    for count in np.unique(length):
        chosen = first[length == count]
        yield control[hair[chosen, None], piece[chosen, None] + np.arange(count + 3)]
