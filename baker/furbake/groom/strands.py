"""The strands of a tile on the body: each point above its own place in the patch."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from furbake.asset.read import Asset, AssetError, read_asset
from furbake.asset.regions.alone import alone, furs
from furbake.asset.stored import read_pelt, skin_colour
from furbake.groom.ground import Floats, Ground, Ints, read_ground
from furbake.groom.roots import Roots, barycentric, place_roots
from furbake.groom.several import own_ground, own_roots
from furbake.groom.walk import walk
from furbake.imported.stored import tile_strands
from furbake.options import BakeOptions, OptionError
from furbake.pelt.hairs.ramp import Ramp
from furbake.pelt.hairs.strands import Strands

Single = NDArray[np.float32]
Progress = Callable[[str, float], None]

STAGES = ("roots", "strands")

BARE = 0.5 / 255.0
"""Share of the longest fur below which no hair stands: less than a byte tells."""


@dataclass(frozen=True)
class Groom:
    """Hairs on a body, roots first, model units.

    points : (S, P, 3); radius : (S, P)
    tint : (S, P) brightness, 0..1; colour : (S, P, 3) linear, the tint and the skin's colour in it
    hair : (S,) which strand of the tile each is
    face : (S,) face of the shells' mesh at the root
    """

    points: Single
    radius: Single
    tint: Single
    colour: Single
    hair: Ints
    face: Ints


def groom(folder: Path, progress: Progress = lambda stage, fraction: None) -> Groom:
    """The strands of a baked fur on its body, from the folder alone.

    progress : called with a stage of `STAGES` and the fraction of it that is done

    Raises AssetError where the folder is no whole asset, or bake.json has no usable options.
    """
    asset = read_asset(folder)
    if "regions" in asset.fur:
        return _several(asset, progress)
    options = recorded(asset)
    progress("roots", 0.0)
    height = float(asset.fur["height"])
    strands = tile_strands(asset, options.coat, height, options.seed)
    ground = read_ground(asset, skin_colour(asset))
    ramp = read_pelt(asset).ramp
    kinds = (np.arange(len(strands.points)) >= options.coat.guard.count).astype(np.int64)
    return on_body(ground, strands, kinds, height, options.seed, ramp, options.colour_plane, progress)


def _several(asset: Asset, progress: Progress) -> Groom:
    """The strands of all furs of a body; `hair` counts on from fur to fur."""
    grooms, first, count = [], 0, len(furs(asset))
    for fur in range(count):
        options, one = recorded(asset, fur), alone(asset, fur)
        height = float(one.fur["height"])
        strands = tile_strands(asset, options.coat, height, options.seed, fur)
        ground = own_ground(asset, skin_colour(asset), fur)
        kinds = (np.arange(len(strands.points)) >= options.coat.guard.count).astype(np.int64)
        chosen = partial(own_roots, asset, ground, fur=fur)
        told = partial(_told, progress, fur / count, 1.0 / count)
        ramp, hues = read_pelt(one).ramp, options.colour_plane
        own = on_body(ground, strands, kinds, height, options.seed, ramp, hues, told, chosen)
        grooms.append(replace(own, hair=own.hair + first))
        first += len(strands.points)
    return Groom(**{name: np.concatenate([getattr(own, name) for own in grooms]) for name in vars(grooms[0])})


def _told(progress: Progress, start: float, share: float, stage: str, fraction: float) -> None:
    """Progress of one of several furs."""
    if stage == STAGES[-1]:
        progress(stage, start + share * fraction)


def recorded(asset: Asset, fur: int = 0) -> BakeOptions:
    """The options in bake.json of one of the furs, 0: the coat. Raises AssetError where they cannot be read."""
    regions = asset.record.get("regions", [])
    record = regions[fur - 1] if 0 < fur <= len(regions) else asset.record
    if not isinstance(record.get("options"), dict) or fur > len(regions):
        raise AssetError(f"{asset.folder}: no options in bake.json, expected a folder that furbake bake wrote")
    if (photographed := record["options"].get("swatch")) is not None:
        raise AssetError(f"{asset.folder}: fur that was photographed ({photographed}), expected grown hairs")
    try:
        return BakeOptions.from_record(record["options"])
    except (OptionError, TypeError, ValueError, LookupError) as error:
        raise AssetError(f"{asset.folder}: options in bake.json not understood ({error}), bake it again") from error


def on_body(
    ground: Ground,
    strands: Strands,
    kinds: Ints,
    height: float,
    seed: int,
    ramp: Ramp,
    hues: bool = False,
    progress: Progress = lambda stage, fraction: None,
    choose: Callable[[Roots], Roots] = lambda roots: roots,
) -> Groom:
    """A tile's strands on a body.

    kinds : (S,) kinds of hair, which are thinned apart; height : of the longest, tile widths
    hues : whether hairs differ in hue by themselves, besides what the body says
    choose : which of the roots have a hair
    """
    roots = choose(place_roots(ground, strands.points[:, 0, :2], kinds, seed))
    long = np.einsum("ij,ij->i", barycentric(ground, roots.face, roots.uv), ground.reach[ground.faces[roots.face]])
    stands = long > BARE * ground.reach.max(initial=0.0)
    hair, face, uv = roots.hair[stands], roots.face[stands], roots.uv[stands]
    progress("roots", 1.0)

    count, length = len(hair), strands.points.shape[1]
    points = np.empty((count, length, 3), np.float32)
    colour = np.empty((count, length, 3), np.float32)
    skin = None if ground.roots is None else ground.roots.colours(uv)
    here = face
    aside = np.zeros((count, 2))
    for p in range(length):
        moved = strands.points[hair, p, :2] - strands.points[hair, 0, :2]
        here, uv = walk(ground, here, uv + moved - aside)
        aside = moved
        shares = barycentric(ground, here, uv)
        s = strands.points[hair, p, 2] / height
        points[:, p] = displaced(ground, here, shares, s)
        colour[:, p] = _coloured(ground, here, shares, s, ramp, strands.hue[hair, p] if hues else None, skin)
        progress("strands", (p + 1) / length)
    tint = strands.tint[hair].astype(np.float32)
    return Groom(
        points=points,
        radius=(ground.tile * strands.radius[hair]).astype(np.float32),
        tint=tint,
        colour=colour * tint[..., None],
        hair=hair,
        face=face,
    )


def displaced(ground: Ground, face: Ints, shares: Floats, s: Floats) -> Floats:
    """(n, 3) points at shares s (n,) of the fur's length above places in faces, as shells have them.

    p = P + n·H·s·√(1 − |c|²) + H·c·s² at each corner, and between the corners what is between: a shell is flat there.
    Beyond the end of a patch the skin goes on in the face's plane, and fur is as long and combed as at its edge.
    """
    corners = ground.faces[face]
    held = np.clip(shares, 0.0, 1.0)
    held /= held.sum(axis=1, keepdims=True)
    comb, reach = ground.comb[corners], ground.reach[corners][..., None]
    rise = np.sqrt(np.maximum(1.0 - np.einsum("nck,nck->nc", comb, comb), 0.0))[..., None]
    along = s[:, None, None]
    above = reach * along * (rise * ground.normals[corners] + along * comb)
    return np.asarray(np.einsum("nc,nck->nk", shares, ground.vertices[corners]) + np.einsum("nc,nck->nk", held, above))


def _coloured(
    ground: Ground, face: Ints, shares: Floats, s: Floats, ramp: Ramp, hue: Floats | None, skin: Floats | None
) -> Floats:
    """(n, 3) linear colour of hairs but for their tint: the skin's × the ramp's, as the format has it.

    skin : (n, 3) linear, at their roots; None: that of the vertices
    """
    corners = ground.faces[face]
    held = np.clip(shares, 0.0, 1.0)
    held /= held.sum(axis=1, keepdims=True)
    second = np.einsum("nc,nc->n", held, ground.tip[corners])
    if hue is not None:  # a texel's own colour, from which the body leads on to the second tip
        second = second + (1.0 - second) * hue
    root, tip, tip2 = (np.array(part) for part in (ramp.root, ramp.tip, ramp.tip2))
    end = tip + second[:, None] * (tip2 - tip)
    rise = np.clip(s, 0.0, 1.0)[:, None] ** ramp.power
    if skin is None:
        skin = np.einsum("nc,nck->nk", held, ground.colour[corners])
    return np.asarray(skin * (root + (end - root) * rise))
