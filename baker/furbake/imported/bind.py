"""Strands bound to a body: the place of each root on the surface, and how the strand lies there."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from furbake.imported.curves import Curves, Floats, GroomError, Ints
from furbake.surface.mesh import Surface
from furbake.surface.repair.near import candidates, closest, nearest, sampled

FLOATING = 0.02
"""Distance of a root from the surface beyond which a strand floats, share of the body's largest side."""

AT_ONCE = 100_000
"""Places that are looked up at a time."""

PROBE = 2000
"""Strands by which it is told whether a groom is of this body at all."""

UNITS = {0.01: "100 times too large", 100.0: "100 times too small", 0.001: "1000 times too large",
         1000.0: "1000 times too small", 0.0254: "in inches", 39.37: "in metres, the body in inches"}  # fmt: skip
"""Units of another program: factors by which a groom would fit, and what is wrong with it then."""

TURNED = {
    "z up": np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]]),
    "y up": np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]]),
}
"""Axes of another program, and how they are turned to fit."""

THIN = 0.15
"""Width of strands that bring none, shares of the distance between them."""


@dataclass(frozen=True)
class Ground:
    """A surface whose nearest points are asked for.

    corners : (F, 3, 3) of its faces
    """

    surface: Surface
    corners: Floats

    def feet(self, places: Floats) -> tuple[Ints, Floats, Floats]:
        """(n,) face, (n, 3) shares of its corners and (n,) distance of the nearest point to each place."""
        tree = sampled(self.corners)
        parts = []
        for start in range(0, len(places), AT_ONCE):
            some = places[start : start + AT_ONCE]
            face = nearest(self.corners, candidates(tree, some), some)
            parts.append((face, *closest(self.corners[face], some)))
        faces, shares, apart = (np.concatenate(part) for part in zip(*parts, strict=True))
        return faces, shares, apart

    def at(self, values: Floats, face: Ints, shares: Floats) -> Floats:
        """Values of the vertices (V, ...) at places on faces, (n, ...)."""
        return np.asarray(np.einsum("nc,nc...->n...", shares, values[self.surface.faces[face]]))


def ground_of(surface: Surface) -> Ground:
    """A surface to be asked."""
    return Ground(surface, surface.vertices[surface.faces])


@dataclass(frozen=True)
class Bound:
    """S strands on a surface, in its units.

    face, shares : (S,), (S, 3) where their roots are; normal : (S, 3) unit, there
    way : (S, 3) unit, tangent, from root to tip; firm : (S,) 0..1, share of the chord along the surface
    length : (S,) along the strand; height : (S,) of the tip above the surface; reach : (S,) of the tip along it
    width : (S,) mean of the strand; root, tip : (S, 3) linear colours, or None
    """

    curves: Curves
    face: Ints
    shares: Floats
    normal: Floats
    way: Floats
    firm: Floats
    length: Floats
    height: Floats
    reach: Floats
    width: Floats
    root: Floats | None
    tip: Floats | None
    notices: tuple[str, ...] = ()

    @property
    def count(self) -> int:
        """Number of strands."""
        return len(self.face)

    def some(self, which: NDArray[np.bool_]) -> Bound:
        """Some of the strands, (S,)."""
        parts = ("face", "shares", "normal", "way", "firm", "length", "height", "reach", "width")
        return replace(
            self,
            curves=self.curves.some(which),
            root=None if self.root is None else self.root[which],
            tip=None if self.tip is None else self.tip[which],
            **{name: getattr(self, name)[which] for name in parts},
        )


def bind(name: str, curves: Curves, surface: Surface) -> Bound:
    """Strands on a surface, those left out whose root is far from it.

    Raises GroomError where it is the groom of another body, or in other units.
    """
    ground = ground_of(surface)
    limit = FLOATING * surface.extent
    roots = curves.points[curves.starts].astype(np.float64)
    probe = roots[:: max(1, len(roots) // PROBE)]
    if _floating(ground, probe, limit) > 0.5:
        raise GroomError(f"{name}: {_far(ground, probe, limit)}")
    face, shares, apart = ground.feet(roots)
    kept = apart <= limit
    told = f"{name}: {int(kept.sum())} strands, roots {_length(np.median(apart[kept]))} from the body on the median, "
    notices = [told + f"{_length(apart[kept].max())} at most"]
    if not kept.all():
        notices.append(
            f"{name}: {int((~kept).sum())} strands float more than {_length(limit)} off the body and are left out"
        )
        curves, face, shares = curves.some(kept), face[kept], shares[kept]
    normal = _unit(ground.at(surface.normals, face, shares))
    chord = (curves.points[curves.ends] - curves.points[curves.starts]).astype(np.float64)
    along = chord - normal * np.einsum("ij,ij->i", chord, normal)[:, None]
    height = heights(ground, normal, curves.points[curves.ends].astype(np.float64), chord)
    straight, flat = np.linalg.norm(chord, axis=1), np.linalg.norm(along, axis=1)
    if curves.widths is None:
        spacing = np.sqrt(_area(surface) / curves.count)
        width = np.full(curves.count, THIN * spacing)
        notices.append(f"{name}: no widths, {_length(THIN * spacing)} taken")
    else:
        width = curves.mean(curves.widths)
    colours = curves.colours
    return Bound(
        curves=curves, face=face, shares=shares, normal=normal,
        way=_unit(along), firm=flat / np.maximum(straight, 1e-30), length=curves.lengths(),
        height=height, reach=np.sqrt(np.maximum(straight**2 - height**2, 0.0)), width=width,
        root=None if colours is None else colours[curves.starts].astype(np.float64),
        tip=None if colours is None else colours[curves.ends].astype(np.float64),
        notices=(*curves.notices, *notices),
    )  # fmt: skip


def heights(ground: Ground, normal: Floats, places: Floats, chord: Floats) -> Floats:
    """(n,) height of places above the surface; above the plane of the root where another part of it is nearer.

    normal : (n, 3) at the root; chord : (n, 3) from the root to the place
    """
    face, shares, apart = ground.feet(places)
    there = ground.at(ground.surface.normals, face, shares)
    foot = np.einsum("nc,nck->nk", shares, ground.corners[face])
    side = np.einsum("ij,ij->i", places - foot, there)
    plane = np.einsum("ij,ij->i", chord, normal)
    other = np.einsum("ij,ij->i", there, normal) <= 0.0
    return np.asarray(np.maximum(np.where(other, plane, np.sign(side) * apart), 0.0))


def _floating(ground: Ground, roots: Floats, limit: float) -> float:
    """Share of the roots that are far from the surface."""
    return float((ground.feet(roots)[2] > limit).mean())


def _far(ground: Ground, roots: Floats, limit: float) -> str:
    """Sentence about a groom whose roots are far from the body."""
    extent = ground.surface.extent
    for turn, matrix in {"": np.eye(3), **TURNED}.items():
        for factor, what in {1.0: "", **UNITS}.items():
            if _floating(ground, factor * roots @ matrix.T, limit) < 0.1:
                wrong = " and ".join(part for part in (what, turn and f"{turn} in its own program") if part)
                return f"is {wrong}, expected the body's own units and axes: export both alike"
    apart = float(np.median(ground.feet(roots)[2]))
    return f"roots are {apart / extent:.2g} body lengths from the body on the median, expected a groom of this body"


def _area(surface: Surface) -> float:
    corners = surface.vertices[surface.faces]
    doubled = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    return float(doubled.sum()) / 2


def _length(value: float | np.floating) -> str:
    return f"{float(value):.2g}"


def _unit(vectors: Floats) -> NDArray[np.float64]:
    return np.asarray(vectors / np.maximum(np.linalg.norm(vectors, axis=1, keepdims=True), 1e-30), np.float64)
