"""An artist's groom beside what a bake makes of it: strands that its fields have not seen, and the strands as truth."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from furbake.asset.read import Asset, read_asset
from furbake.body.body import grounded
from furbake.body.groomed import combed_by
from furbake.groom.ground import read_skin
from furbake.groom.strands import Groom, recorded
from furbake.imported.bind import Bound, bind, ground_of
from furbake.imported.curves import Floats, GroomError
from furbake.imported.fields import Standing, areas, direction_of, fields_of, standing
from furbake.imported.read.reading import read_curves
from furbake.options import BakeOptions
from furbake.surface.mesh import Surface, clean

HELD = 5
"""Every one of so many strands along the body is held out."""

DISC = 0.025
"""Radius of the discs in which strands are counted, share of the body's largest side: 5 cm on a body of two metres."""

ENOUGH = 12
"""Held-out strands of a disc at least, on the mean: on sparse grooms discs are larger."""

DISCS, SAMPLES = 1500, 400_000
"""Discs at most, and points of the surface by which the density in them is summed."""

UPRIGHT = 0.1
"""Share of a strand's chord along the surface below which it has no direction there."""

POINTS = 25
"""Points at most of a strand that is traced."""

STAGES = ("read", "fields", "discs")


@dataclass(frozen=True)
class HeldOut:
    """Fields of four fifths of a groom beside the other fifth.

    strands, held, discs : how many; angle, angle_95 : degrees between field and strand, mean and 95th percentile
    length : mean difference over the mean length; density : mean over the discs of the difference over the count
    upright : share of the held-out strands that have no direction along the surface
    """

    strands: int
    held: int
    discs: int
    angle: float
    angle_95: float
    length: float
    density: float
    upright: float


def held_out(
    folder: Path, file: Path | None = None, progress: Callable[[str, float], None] = lambda stage, fraction: None
) -> HeldOut:
    """Make the fields of a baked groom anew from four fifths of its strands and compare them with the rest.

    file : of the groom, where the record's is no longer there. Raises AssetError or GroomError.
    """
    progress("read", 0.0)
    asset = read_asset(folder)
    options, name = recorded(asset), groom_file(asset, file)
    surface = baked_skin(asset)
    bound = bind(str(name), read_curves(name), surface)
    progress("read", 1.0)
    held = _every(bound, ground_of(surface).corners)
    ground = grounded(surface)
    seen, unseen = bound.some(~held), bound.some(held)
    stands = standing(ground_of(ground), seen, ground_of(surface))
    fields = fields_of(stands, seen)
    direction = direction_of(ground, fields, options.guide)
    there = standing(ground_of(ground), unseen, ground_of(surface))
    progress("fields", 1.0)
    along = there.at(direction)
    along /= np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-12)
    lies = unseen.firm > UPRIGHT
    angle = np.degrees(np.arccos(np.clip(np.einsum("ij,ij->i", along, unseen.way)[lies], -1, 1)))
    off = np.abs(there.at(fields.length) - unseen.length)
    counted, expected = _counted(there, fields.density * unseen.count / seen.count)
    progress("discs", 1.0)
    return HeldOut(
        strands=bound.count,
        held=unseen.count,
        discs=len(counted),
        angle=float(angle.mean()),
        angle_95=float(np.quantile(angle, 0.95)),
        length=float(off.mean() / unseen.length.mean()),
        density=float((np.abs(expected - counted) / counted).mean()),
        upright=float(1 - lies.mean()),
    )


def groom_file(asset: Asset, file: Path | None) -> Path:
    """The file of a baked folder's groom: the given one, else that of its record. Raises GroomError."""
    name = asset.record.get("options", {}).get("groom")
    if file is not None:
        return file
    if not isinstance(name, str):
        raise GroomError(f"{asset.folder}: was baked without a groom, expected one made with furbake bake --groom FILE")
    if not Path(name).is_file():
        raise GroomError(f"{name}: no such file, from where {asset.folder} was baked, expected --groom FILE")
    return Path(name)


def artist_strands(asset: Asset, options: BakeOptions, file: Path | None = None) -> Groom:
    """The strands of a baked groom as the artist left them, followers among them, on the baked body."""
    surface = baked_skin(asset)
    combed = combed_by(str(groom_file(asset, file)), options, surface, surface)
    curves = combed.bound.curves
    points, widths, _ = curves.evened(np.arange(curves.count), int(min(curves.counts.max(), POINTS)))
    width = combed.bound.width[:, None] * np.ones(points.shape[1]) if widths is None else widths
    flat = np.ones((*width.shape, 3), np.float32)
    return Groom(
        points=points.astype(np.float32),
        radius=(width / 2).astype(np.float32),
        tint=flat[..., 0],
        colour=flat,
        hair=np.arange(curves.count),
        face=np.zeros(curves.count, np.int64),
    )


def lines(figures: HeldOut) -> list[str]:
    """The figures as Markdown."""
    return [
        f"{figures.held} of {figures.strands} strands held out, fields made of the others",
        "",
        "| field | mean difference |",
        "|---|---|",
        f"| direction | {figures.angle:.1f}° (95 %: {figures.angle_95:.0f}°; {figures.upright:.0%} stand upright) |",
        f"| length | {figures.length:.1%} |",
        f"| density, {figures.discs} discs of {DISC:.1%} of the body's largest side | {figures.density:.1%} |",
    ]


def baked_skin(asset: Asset) -> Surface:
    """The body of a baked folder. Raises AssetError where it is broken."""
    vertices, faces = read_skin(asset)
    return clean(str(asset.folder), vertices, faces, max_faces=len(faces))


def _every(bound: Bound, corners: Floats) -> np.ndarray[tuple[int, ...], np.dtype[np.bool_]]:
    """(S,) every fifth strand along a path that goes from each to one nearby, so that all places lose as much."""
    feet = np.einsum("nc,nck->nk", bound.shares, corners[bound.face])
    cell = ((feet - feet.min(axis=0)) / max(float(np.ptp(feet, axis=0).max()), 1e-12) * 1023).astype(np.int64)
    code = np.zeros(len(cell), np.int64)
    for bit in range(10):
        for axis in range(3):
            code |= ((cell[:, axis] >> bit) & 1) << (3 * bit + axis)
    held = np.zeros(len(code), bool)
    held[np.argsort(code, kind="stable")[HELD // 2 :: HELD]] = True
    return held


def _counted(stands: Standing, density: Floats) -> tuple[Floats, Floats]:
    """Strands in discs around some of them, and how many a density (V,) expects there."""
    surface = stands.ground.surface
    rng = np.random.default_rng(0)
    corners = stands.ground.corners
    doubled = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    face = np.sort(rng.choice(len(doubled), SAMPLES, p=doubled / doubled.sum()))
    shares = np.sort(rng.random((SAMPLES, 2)), axis=1)
    shares = np.column_stack([shares[:, 0], shares[:, 1] - shares[:, 0], 1 - shares[:, 1]])
    places, normals = (stands.ground.at(part, face, shares) for part in (surface.vertices, surface.normals))
    each = np.einsum("nc,nc->n", shares, density[surface.faces[face]]) * areas(surface).sum() / SAMPLES
    feet, ways = stands.at(surface.vertices), stands.at(surface.normals)
    radius = max(DISC * surface.extent, float(np.sqrt(ENOUGH * areas(surface).sum() / (np.pi * len(feet)))))
    chosen = rng.permutation(len(feet))[:DISCS]
    strands, points = cKDTree(feet), cKDTree(places)
    counted, expected = np.zeros(len(chosen)), np.zeros(len(chosen))
    for i, one in enumerate(chosen):
        near = strands.query_ball_point(feet[one], radius)
        around = points.query_ball_point(feet[one], radius)
        counted[i] = (ways[near] @ ways[one] > 0).sum()
        expected[i] = each[around][normals[around] @ ways[one] > 0].sum()
    return counted, expected
