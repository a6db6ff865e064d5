"""Triangles of a file with the data of their corners, before and during repair.

Data is kept per corner, so that faces can be dropped, turned and joined at other vertices without losing any of it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Flags = NDArray[np.bool_]


class MeshError(ValueError):
    """A mesh that cannot carry fur; the message starts with its name and says what was got and expected."""


@dataclass(frozen=True)
class Soup:
    """Triangles that need not fit together.

    vertices : (V, 3) float, model units
    faces : (F, 3) int
    part : (F,) int, index of each face's material
    uv : (F, 3, 2) float, the model's own texture coordinates, v growing down the image as in glTF; NaN where a part
        has none, None where no part has any
    paint : (F, 3, 4) float, linear vertex colour, white where a part has none, None where no part has any
    attributes : further numbers of the corners by name, (F, 3, n) float, NaN where a part has none
    """

    vertices: Floats
    faces: Ints
    part: Ints
    uv: Floats | None = None
    paint: Floats | None = None
    attributes: dict[str, Floats] = field(default_factory=dict)

    def take(self, index: Ints | Flags) -> Soup:
        """Only these faces."""
        return replace(
            self,
            faces=self.faces[index],
            part=self.part[index],
            uv=None if self.uv is None else self.uv[index],
            paint=None if self.paint is None else self.paint[index],
            attributes={name: values[index] for name, values in self.attributes.items()},
        )

    def pieces(self) -> Iterator[tuple[int, Soup]]:
        """The faces of each part that is in use, by rising number; in linear time, however many parts there are."""
        order = np.argsort(self.part, kind="stable")
        parts, starts = np.unique(self.part[order], return_index=True)
        for part, rows in zip(parts.tolist(), np.split(order, starts[1:]), strict=True):
            yield part, self.take(rows)

    def turn(self, which: Flags) -> Soup:
        """These faces wound the other way: corners 2, 1, 0."""

        def turned(values: Floats) -> Floats:
            return np.where(which.reshape(-1, 1, 1), values[:, ::-1], values)

        return replace(
            self,
            faces=np.where(which[:, None], self.faces[:, ::-1], self.faces),
            uv=None if self.uv is None else turned(self.uv),
            paint=None if self.paint is None else turned(self.paint),
            attributes={name: turned(values) for name, values in self.attributes.items()},
        )

    def compact(self) -> Soup:
        """Without vertices that no face uses."""
        used, index = np.unique(self.faces, return_inverse=True)
        return replace(self, vertices=self.vertices[used], faces=index.reshape(-1, 3))


def plain(vertices: Floats, faces: Ints) -> Soup:
    """Soup of bare triangles."""
    return Soup(vertices, faces, np.zeros(len(faces), dtype=np.int64))


def join(soups: list[Soup]) -> Soup:
    """One soup of several (at least one)."""
    starts = np.cumsum([0] + [len(soup.vertices) for soup in soups])
    names = sorted({name for soup in soups for name in soup.attributes})
    widths = {name: min(s.attributes[name].shape[2] for s in soups if name in s.attributes) for name in names}
    return Soup(
        vertices=np.concatenate([soup.vertices for soup in soups]),
        faces=np.concatenate([soup.faces + start for soup, start in zip(soups, starts, strict=False)]),
        part=np.concatenate([soup.part for soup in soups]),
        uv=_joined([soup.uv for soup in soups], soups, 2, np.nan),
        paint=_joined([soup.paint for soup in soups], soups, 4, 1.0),
        attributes={
            name: values
            for name, width in widths.items()
            if (values := _joined([s.attributes.get(name) for s in soups], soups, width, np.nan)) is not None
        },
    )


def _joined(arrays: list[Floats | None], soups: list[Soup], width: int, missing: float) -> Floats | None:
    if all(values is None for values in arrays):
        return None
    return np.concatenate(
        [
            np.full((len(soup.faces), 3, width), missing) if values is None else values[..., :width]
            for values, soup in zip(arrays, soups, strict=True)
        ]
    )
