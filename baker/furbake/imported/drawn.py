"""The tile of a groom: its own strands, drawn by neighbourhoods, each brought into the frame of its root."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from furbake.imported.bind import Bound, Ground
from furbake.imported.curves import Floats, Ints
from furbake.imported.fields import Fields, Standing
from furbake.imported.laid import Laid
from furbake.pelt.hairs.strands import MAX_POINTS, POINTS, Strands
from furbake.pelt.hairs.tiling import nearest, scattered_points

PER_NEIGHBOURHOOD = 40
"""Strands of a neighbourhood that the tile shows, about."""

MOST_NEIGHBOURHOODS = 49

DRAWS, BEST = 48, 8
"""Tiles that are drawn, and how many are kept: those whose strands are most like the groom and stand most evenly."""

SEEDS = 6
"""Neighbourhoods that are tried at each place of a tile; the one that fills it with as many strands as belong there."""

CELLS = 6
"""Cells along a tile in which strands are counted: gaps would be seen again at every repetition."""

LIKE = 0.35
"""Difference of the logarithm of density and length up to which a place is typical."""

STRETCH = (0.5, 2.0)
"""Bounds of the factor by which a strand's own bends are brought to the length that is typical."""


BEYOND = 2.0
"""Square of the distance, over that of the tip, up to which the surface falls off."""

WIDER = (0.5, 2.0)
"""Bounds of the factor by which a place above a curved surface is wider than below."""


@dataclass(frozen=True)
class Source:
    """Strands as a tile takes them.

    direction : (V, 3) of the fur at the vertices of `stands.ground`; skin : what they are bound to
    tile : its width, model units; density : strands per area that it shows
    """

    bound: Bound
    stands: Standing
    fields: Fields
    laid: Laid
    direction: Floats
    skin: Ground
    tile: float
    density: float


def draw(source: Source, seed: int) -> list[tuple[Strands, Ints]]:
    """Tiles of strands, the best first: z up to the tile's height where the fur ends; which of the groom's each is."""
    rng = np.random.default_rng([seed, 4])
    traits = _traits(source)
    typical = _typical(source)
    tree = cKDTree(_feet(source, np.arange(source.bound.count)))
    found = list[tuple[float, Ints, Floats]]()
    for _ in range(DRAWS):
        which, roots = _neighbourhoods(source, typical, tree, rng)
        if len(which):
            off = max(distance(trait[which], trait) for trait in traits) + uneven(roots)
            found.append((off, which, roots))
    if not found:
        which = rng.choice(source.bound.count, max(1, round(source.density * source.tile**2)))
        found.append((1.0, which, scattered_points(len(which), rng)))
    found.sort(key=lambda one: one[0])
    return [(_in_tile(source, which, roots), which) for _, which, roots in found[:BEST]]


def uneven(roots: Floats) -> float:
    """Share of the tile by which cells have fewer strands than they should, 0..1. roots : (n, 2) tile widths, periodic

    By chance alone n strands leave about .4·CELLS/√n.
    """
    at = np.minimum((roots % 1.0 * CELLS).astype(np.int64), CELLS - 1)
    counted = np.bincount(at[:, 0] * CELLS + at[:, 1], minlength=CELLS**2) * CELLS**2 / len(roots)
    return float(np.maximum(1.0 - counted, 0.0).mean())


def distance(some: Floats, others: Floats) -> float:
    """Kolmogorov's: the largest difference of the shares of two samples below any value, 0..1."""
    places = np.sort(np.concatenate([some, others]))
    one, two = (np.searchsorted(np.sort(sample), places, "right") / len(sample) for sample in (some, others))
    return float(np.abs(one - two).max())


def frames(source: Source, which: Ints) -> tuple[Floats, Floats, Floats]:
    """Unit vectors at the roots of some strands: across the fur, along it, and the normal, (n, 3) each."""
    stands = source.stands
    face, shares = stands.face[which], stands.shares[which]
    normal = _unit(stands.ground.at(stands.ground.surface.normals, face, shares))
    along = stands.ground.at(source.direction, face, shares)
    along = _unit(along - normal * np.einsum("ij,ij->i", along, normal)[:, None])
    return np.cross(along, normal), along, normal


def _traits(source: Source) -> tuple[Floats, ...]:
    """Traits by which a tile's strands are held against the whole groom: height, reach and width, (S,) each."""
    bound, fields = source.bound, source.fields
    height = source.stands.at(np.maximum(fields.height, 1e-3 * fields.length))
    length = source.stands.at(fields.length)
    return bound.height / height, bound.length / length, bound.reach / length, bound.width


def _typical(source: Source) -> Ints:
    """Strands in whose neighbourhood density and length are about those of the tile; all where there are few."""
    density, length = (source.stands.at(values) for values in (source.fields.density, source.fields.length))
    usual = float(np.median(length))
    off = np.abs([np.log(np.maximum(density, 1e-12) / source.density), np.log(np.maximum(length, 1e-12) / usual)]).max(
        axis=0
    )
    found = np.flatnonzero(off < LIKE)
    return found if len(found) >= min(500, source.bound.count / 4) else np.arange(source.bound.count)


def _neighbourhoods(source: Source, typical: Ints, tree: cKDTree, rng: np.random.Generator) -> tuple[Ints, Floats]:
    """Strands and their roots in the tile, (n,) and (n, 2): around each of some sites those around some strand.

    tree : of the feet of all strands
    """
    whole = source.density * source.tile**2
    sites = scattered_points(int(np.clip(round(whole / PER_NEIGHBOURHOOD), 1, MOST_NEIGHBOURHOODS)), rng)
    far = 1.5 / np.sqrt(len(sites))
    expected = whole * _cells_of(sites)
    found, places = list[Ints](), list[Floats]()
    for i, site in enumerate(sites):
        best: tuple[float, Ints, Floats] | None = None
        seeds = rng.choice(typical, SEEDS)
        for seed, *axes in zip(seeds, *frames(source, seeds), strict=True):
            near, at = _around(source, seed, axes, tree, far)
            at = site + at
            own = (nearest(at, sites)[0] == i) & (np.abs(at - site).max(axis=1, initial=0.0) < 0.5)
            off = abs(int(own.sum()) - expected[i])
            if best is None or off < best[0]:
                best = off, near[own], at[own]
        if best is not None:
            found.append(best[1])
            places.append(best[2])
    return np.concatenate(found), np.concatenate(places)


def _around(source: Source, seed: int, axes: list[Floats], tree: cKDTree, far: float) -> tuple[Ints, Floats]:
    """Strands around one, (n,), and where their roots are from its own in a tile, (n, 2).

    axes : across the fur there, along it, and the normal, (3,) each; far : how far they may be, tile widths
    """
    across, along, normal = axes
    feet = np.asarray(tree.data)
    dense = source.stands.ground.at(
        source.fields.density, source.stands.face[seed : seed + 1], source.stands.shares[seed : seed + 1]
    )
    grown = float(np.sqrt(dense[0] / source.density)) / source.tile  # so that as many strands stand in a tile's area
    near = np.asarray(tree.query_ball_point(feet[seed], far / grown), np.int64)
    near = near[source.bound.normal[near] @ normal > 0.3]
    way = (feet[near] - feet[seed]) * grown
    return near, np.stack([way @ across, way @ along], axis=1)


def _cells_of(sites: Floats) -> Floats:
    """(n,) share of the periodic tile that is nearest to each site."""
    steps = (np.arange(64) + 0.5) / 64
    every = np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)
    return np.bincount(nearest(every, sites)[0], minlength=len(sites)) / len(every)


def _feet(source: Source, which: Ints) -> Floats:
    bound = source.bound
    return np.asarray(np.einsum("nc,nck->nk", bound.shares[which], source.skin.corners[bound.face[which]]))


def _in_tile(source: Source, which: Ints, roots: Floats) -> Strands:
    """Strands with their roots there: what the fur's own length and comb do not do is left to their points."""
    bound, laid, tile = source.bound, source.laid, source.tile
    at = np.clip(int(bound.curves.counts[which].max()), POINTS, MAX_POINTS)
    points, widths, _ = bound.curves.evened(which, int(at))
    aside, above = _seen_from_roots(source, which, points)
    stands = Standing(source.stands.ground, source.stands.face[which], source.stands.shares[which])
    reach, comb = stands.at(laid.reach), stands.at(laid.comb)
    own = np.maximum(stands.at(source.fields.length), 1e-12)
    rise = (reach * np.sqrt(1 - comb * comb))[:, None]
    s = np.clip(above / np.maximum(rise, 1e-12), 0.0, 1.0)
    s[:, 0] = 0.0
    # Bends are as large as on strands of the usual length; the lean is the same on all, also where a comb falls short.
    common = np.zeros_like(aside)
    common[..., 1] = laid.lean * laid.taller * s
    rest = aside - common
    rest[..., 1] -= (reach * comb)[:, None] * s * s + (laid.taller * stands.at(laid.short))[:, None] * s
    usual = float(np.median(source.stands.at(source.fields.length)))
    rest *= np.clip(usual / own, *STRETCH)[:, None, None]
    moved = (rest + common) / tile
    moved -= moved[:, :1]
    height = laid.longest / tile
    radius = bound.width[which, None] / 2 / tile * np.ones(points.shape[1]) if widths is None else widths / 2 / tile
    flat = np.ones(radius.shape)
    found = np.concatenate([roots[:, None] + moved, (height * s)[..., None]], axis=-1)
    return Strands(found, np.maximum(radius, 1e-6), flat, np.zeros_like(flat))


def _seen_from_roots(source: Source, which: Ints, points: Floats) -> tuple[Floats, Floats]:
    """How far points lie aside, across the fur and along it (n, P, 2), and above the surface (n, P); model units.

    The surface falls off from the plane of the root by the square of the distance, as much as it does below the tip.
    Feet of single points would jump from face to face.
    """
    way = points - _feet(source, which)[:, None]
    axes = frames(source, which)
    across, along, above = (np.einsum("npk,nk->np", way, axis) for axis in axes)
    far = across**2 + along**2
    falls = (source.bound.height[which] - above[:, -1]) / np.maximum(far[:, -1], 1e-30)
    above = np.maximum(above + falls[:, None] * np.minimum(far, BEYOND * far[:, -1:]), 0.0)
    # Above a round body a place is wider than below: by 1 + height / radius.
    wider = np.clip(1 + 2 * falls[:, None] * above, *WIDER)
    return np.stack([across, along], axis=-1) / wider[..., None], above


def _unit(vectors: Floats) -> Floats:
    return np.asarray(vectors / np.maximum(np.linalg.norm(vectors, axis=1, keepdims=True), 1e-30))
