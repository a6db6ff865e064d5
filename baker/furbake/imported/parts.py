"""Parts of a body whose strands are plainly different, by the traits of the strands from place to place."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.cluster.vq import kmeans2

from furbake.imported.curves import Floats, Ints
from furbake.imported.fields import Fields
from furbake.surface.mesh import Surface
from furbake.surface.place.shares import soften

MOST = 4
"""Parts at most: each has numbers of its own in the shaders."""

STEPS = {"length": np.log(2.0), "lean": 0.35, "curl": 0.15, "width": np.log(2.0), "density": np.log(2.0)}
"""Traits, and the difference of each that is plainly seen; of the first and the last two their logarithms count."""

LEAST = 0.5
"""Root mean square of the differences, in such steps, below which all places are alike."""

CLEAR = 0.6
"""Index of spread below which parts are told apart: a steady change from place to place has 1 for any number."""

ISLAND = 0.06
"""Width below which a part inside of another one is none, share of the body's largest side."""

PLACES, TRIES = 6000, 8
"""Places that are looked at, and beginnings of each clustering."""


@dataclass(frozen=True)
class Parts:
    """Places by the part to which they belong.

    of : (V,) number of the part, 0: the largest; rms : differences of all places from their mean, steps
    left : mean squared difference from the mean of the own part, over that from the mean of all, for 1 to `MOST` parts
    """

    of: Ints
    rms: float
    left: tuple[float, ...]

    @property
    def count(self) -> int:
        """Number of parts."""
        return int(self.of.max()) + 1


def parts_of(surface: Surface, fields: Fields, asked: int | None, seed: int) -> Parts:
    """The parts of a groom by k-means of its traits; asked : how many, None: as many as plainly differ.

    Parts differ plainly where k²·W(k)/W(1) is below `CLEAR` (W. J. Krzanowski, Y. T. Lai 1988, for one dimension):
    W(k), the spread within k parts, is W(1)/k² where a trait changes steadily over the body.
    """
    if asked == 1:
        return Parts(np.zeros(len(fields.length), np.int64), 0.0, (1.0,))
    traits = _traits(fields)
    rng = np.random.default_rng([seed, 8])
    weight = fields.area * ~fields.bald
    seen = traits[rng.choice(len(traits), PLACES, p=weight / weight.sum())]
    centres = [_centres(seen, count, rng) for count in range(1, MOST + 1)]
    spread = [float(_apart(seen, each).min(axis=1).mean()) for each in centres]
    left = tuple(each / max(spread[0], 1e-30) for each in spread)
    rms = float(np.sqrt(spread[0]))
    count = asked or _plain(rms, left)
    nearest = _apart(traits, centres[count - 1]).argmin(axis=1)
    near = [soften(surface, (nearest == part).astype(np.float64), ISLAND * surface.extent) for part in range(count)]
    size = np.bincount(of := np.argmax(near, axis=0), weight, count)
    return Parts(np.argsort(np.argsort(-size, kind="stable"), kind="stable")[of], rms, left)


def _plain(rms: float, left: tuple[float, ...]) -> int:
    """Number of parts that differ plainly: the fewest of places that are alike, else those of the least index."""
    index = {count: count**2 * share for count, share in enumerate(left, 1)}
    clear = [count for count, value in index.items() if value < CLEAR]
    if rms < LEAST or not clear:
        return 1
    alike = (count for count in clear if rms * left[count - 1] ** 0.5 < LEAST)
    return next(alike, min(clear, key=index.__getitem__))


def _traits(fields: Fields) -> Floats:
    """(V, 5) traits of the strands around each vertex, in steps."""
    shown = fields.density > 0
    floor = {name: 1e-3 * float(np.median(getattr(fields, name)[shown])) for name in ("length", "width", "density")}
    columns = {"lean": fields.firm, "curl": np.minimum(fields.curl, 1.0)}
    columns |= {name: np.log(np.maximum(getattr(fields, name), low)) for name, low in floor.items()}
    return np.stack([columns[name] / step for name, step in STEPS.items()], axis=1)


def _centres(seen: Floats, count: int, rng: np.random.Generator) -> Floats:
    """(count, T) means of the parts that leave the least spread, of some tries."""
    tried = [kmeans2(seen, count, minit="++", seed=rng, missing="warn")[0] for _ in range(TRIES if count > 1 else 1)]
    return np.asarray(min(tried, key=lambda centres: float(_apart(seen, centres).min(axis=1).mean())))


def _apart(traits: Floats, centres: Floats) -> Floats:
    """(n, count) squared differences of places from the centres."""
    return np.asarray(((traits[:, None] - centres) ** 2).sum(axis=2))
