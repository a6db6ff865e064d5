"""A body in an artist's groom: its strands read, bound, made fields over the ground, and a tile."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from furbake.imported.bind import Bound, bind, ground_of
from furbake.imported.colours import Colours, colours_of
from furbake.imported.curves import GroomError
from furbake.imported.drawn import Source, draw
from furbake.imported.fields import Fields, Standing, areas, direction_of, fields_of, standing
from furbake.imported.follow import filled, followers
from furbake.imported.laid import Laid, laid
from furbake.imported.parts import CLEAR, LEAST, Parts, parts_of
from furbake.imported.read.reading import read_curves
from furbake.imported.traits import compared, likest
from furbake.options import BakeOptions
from furbake.options.knobs import KNOBS
from furbake.options.regions import COAT
from furbake.pelt.hairs.ramp import Ramp
from furbake.pelt.hairs.strands import Coat, Strands
from furbake.surface.mesh import Surface
from furbake.surface.place.shares import STEPS, bounds, soften

Floats = NDArray[np.float64]

HAIRS = 300
"""Hairs of a tile, about, where its width is not given: of more each is thinner than a texel."""

WIDTHS = (0.03, 0.2)
"""Least and greatest width of such a tile, shares of the body's largest side."""

DENSE = 0.9
"""Share of the body that is no denser than the tile."""

BORDER = 0.02
"""Width of the border between regions, share of the body's largest side."""

PER_CLUMP = 16
"""Hairs of a clump of wet fur."""


@dataclass(frozen=True)
class Fur:
    """Strands of one tile, and how they stand on the V vertices of the ground.

    part : (V,) where the tile is that of most hairs; tile : model units; density : strands per area that it shows
    coat : what the options have in place of the preset's; record : figures for `bake.json`
    """

    part: NDArray[np.bool_]
    laid: Laid
    tile: float
    density: float
    strands: Strands
    coat: Coat
    record: dict[str, Any]


@dataclass(frozen=True)
class Groomed:
    """Fur of a groom on the V vertices of a ground.

    direction : (V, 3) unit tangents; lengths : (V,) 0..1, shares of `length`; comb : (V, 3), share of the own length
    density : (V,) 0..1, share of the tile's hairs; bald : (V,) where none grow; colour : (V, 3) 0..1, or None
    length : model units; furs : the coat and its regions; bounds : as of `surface.place.shares.bounds`
    ramp : what the options have in place of the preset's
    record : figures for `bake.json`; notices : one sentence each
    """

    direction: Floats
    lengths: Floats
    comb: Floats
    density: Floats
    bald: NDArray[np.bool_]
    colour: Floats | None
    length: float
    furs: tuple[Fur, ...]
    bounds: NDArray[np.uint8]
    ramp: Ramp
    record: dict[str, Any]
    notices: tuple[str, ...]

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the furs."""
        return COAT, *(f"region{i}" for i in range(1, len(self.furs)))

    def dressed(self, options: BakeOptions, fur: int = 0) -> BakeOptions:
        """The options of one of the furs: with what the groom has in place of the preset's."""
        return replace(options, coat=self.furs[fur].coat, ramp=self.ramp)


@dataclass(frozen=True)
class Combed:
    """A groom on a ground: its strands, their followers among them, and the fields.

    follow : followers of each guide; direction : (V, 3) unit tangents; notices : one sentence each
    """

    bound: Bound
    stands: Standing
    fields: Fields
    direction: Floats
    follow: int
    notices: tuple[str, ...]


def groomed(options: BakeOptions, skin: Surface, ground: Surface) -> Groomed:
    """The groom that the options name, on a body and the copy of it that carries the fur. Raises GroomError."""
    combed = combed_by(str(options.groom), options, skin, ground)
    fields = combed.fields
    parts = parts_of(ground, fields, options.groom_regions, options.seed)
    colours = colours_of(combed.bound, combed.stands, fields)
    furs = tuple(_fur(options, combed, skin, parts.of == part, colours) for part in range(parts.count))
    border = BORDER * skin.extent
    masks = [soften(ground, (parts.of == part).astype(np.float64), border) for part in range(1, parts.count)]
    cut = bounds(np.reshape(masks, (-1, len(ground.vertices))))
    shares = np.diff(cut.astype(np.float64), axis=0) / STEPS
    lengths, comb, density = (
        np.asarray(sum(share * each for share, each in zip(shares, some, strict=True)))
        for some in (
            [fur.laid.reach for fur in furs],
            [fur.laid.comb for fur in furs],
            [np.clip(fields.density / fur.density, 0.0, 1.0) for fur in furs],
        )
    )
    length = max(fur.laid.longest for fur in furs)
    told = () if options.groom_regions == 1 else (_chosen(parts, options, furs, shares, fields),)
    return Groomed(
        direction=combed.direction,
        lengths=np.clip(lengths / length, 0.0, 1.0),
        comb=comb[:, None] * combed.direction,
        density=density,
        bald=fields.bald,
        colour=None if colours is None else colours.places,
        length=length,
        furs=furs,
        bounds=cut,
        ramp=options.ramp if colours is None else colours.ramp,
        record=_record(combed) | furs[0].record,
        notices=(*combed.notices, *told, *(_told(combed, fur) for fur in furs)),
    )


def _fur(options: BakeOptions, combed: Combed, skin: Surface, part: NDArray[np.bool_], colours: Colours | None) -> Fur:
    """The tile of a part of the vertices, of the strands there, and how it stands."""
    ground, fields = combed.stands.ground, combed.fields
    here = part[ground.surface.faces[combed.stands.face, combed.stands.shares.argmax(axis=1)]]
    bound, stands = combed.bound.some(here), combed.stands.some(here)
    tall = bound.height / np.maximum(stands.at(fields.height), 1e-3 * stands.at(fields.length))
    fur = laid(ground.surface, fields, combed.direction, tall, part)
    density = _quantile(fields.density, fields.area * (part & ~fields.bald), DENSE)
    tile = options.tile or _width(skin, density, fur.longest)
    source = Source(bound, stands, fields, fur, combed.direction, ground_of(skin), tile, density)
    strands, which = likest(source, draw(source, options.seed), options.seed)
    strands = _shaded(strands, None if colours is None else colours.tint[here][which], options)
    coat = _coat(options.coat, strands, fur.longest / tile, fur.lean / tile)
    figures = {"drawn": len(which), "density": density, "taller": fur.taller, "lean": fur.lean, "missed": fur.missed}
    return Fur(part, fur, tile, density, strands, coat, figures | {"traits": compared(source, strands, options.seed)})


def combed_by(name: str, options: BakeOptions, skin: Surface, ground: Surface) -> Combed:
    """A groom's strands on a body, filled in between where they are guides alone. Raises GroomError."""
    bound = bind(name, read_curves(Path(name)), skin)
    notices = list(bound.notices)
    area = float(areas(skin).sum())
    follow = followers(bound, area, options.follow)
    if follow:
        some = (
            "asked for" if options.follow is not None else "alone they hardly cover the skin (--follow 0: as they are)"
        )
        notices.append(f"{name}: {follow} hairs grown beside each of {bound.count} guides, {some}")
        try:
            bound = bind(name, filled(bound, follow, options.seed), skin)
        except GroomError:
            raise GroomError(
                f"{name}: {bound.count} guides are so far apart that hairs between them leave the body, expected more"
                " of them (or --follow 0: as they are)"
            ) from None
    stands = standing(ground_of(ground), bound, ground_of(skin))
    fields = fields_of(stands, bound)
    direction = direction_of(ground, fields, options.guide)
    return Combed(bound, stands, fields, direction, follow, tuple(notices))


def _width(skin: Surface, density: float, length: float) -> float:
    """Width of a tile of about as many hairs as are usual."""
    least, most = WIDTHS[0] * skin.extent, WIDTHS[1] * skin.extent
    knob = KNOBS["height"]
    return float(np.clip(np.clip(np.sqrt(HAIRS / density), least, most), length / knob.high, length / knob.low))


def _quantile(values: Floats, weights: Floats, share: float) -> float:
    """The value that this share of the weights is below."""
    order = np.argsort(values)
    total = np.cumsum(weights[order])
    return float(values[order][min(np.searchsorted(total, share * total[-1]), len(values) - 1)])


def _shaded(strands: Strands, tint: Floats | None, options: BakeOptions) -> Strands:
    """The strands in their own brightness (n,), or in the preset's where the groom has no colours."""
    if tint is not None:
        return replace(strands, tint=tint[:, None] * np.ones(strands.radius.shape))
    coat, rng = options.coat, np.random.default_rng([options.seed, 5])
    spread = coat.guard.tint + coat.shade * rng.normal(0.0, 1.0, (len(strands.points), 1))
    tint = np.clip(spread, 0.35 * coat.guard.tint, 1.0) * np.ones(strands.radius.shape)
    return replace(strands, tint=tint, hue=rng.random((len(tint), 1)) * np.ones(tint.shape))


def _coat(coat: Coat, strands: Strands, height: float, lean: float) -> Coat:
    """The preset's coat with the hairs' number and lean, and an opacity by which shells hide as much as the hairs.

    A hair of radius r that fills the share f of a volume takes 2f / (πr) of the light that crosses it.
    """
    count, radius = len(strands.points), float(strands.radius.mean())
    knob = KNOBS["coat.opacity"]
    opacity = float(np.clip(height / 16 * 2 / (np.pi * radius), knob.low, knob.high))
    high = KNOBS["coat.lean"].high
    return replace(
        coat,
        guard=replace(coat.guard, count=count),
        under=replace(coat.under, count=0),
        lean=(0.0, float(np.clip(lean, -high, high))),
        clumps=max(1, count // PER_CLUMP),
        opacity=opacity,
    )


def _record(combed: Combed) -> dict[str, Any]:
    return {"strands": combed.bound.count // (1 + combed.follow), "follow": combed.follow}


def _chosen(parts: Parts, options: BakeOptions, furs: Sequence[Fur], shares: Floats, fields: Fields) -> str:
    """Sentence on the regions of a groom, and on how much they differ."""
    why = f"places differ by {parts.rms:.2g} steps"
    if parts.rms >= LEAST:
        left = ", ".join(f"{100 * share:.0f} % in {count}" for count, share in enumerate(parts.left[1:], 2))
        why += f", of whose square one tile leaves all, {left}"
    if options.groom_regions is None:
        why += f"; a region more is taken where less than {CLEAR:g} / n² is left in n"
    covers = shares @ (fields.area * ~fields.bald)
    each = ", ".join(f"{share:.0f} %" for share in 100 * covers / covers.sum())
    return f"groom: {len(furs)} region{'s' if len(furs) > 1 else ''} ({each} of the fur): {why}"


def _told(combed: Combed, fur: Fur) -> str:
    low, high = (float(np.quantile(combed.bound.length, share)) for share in (0.05, 0.95))
    return (
        f"groom: strands {low:.2g} to {high:.2g} long, {fur.record['drawn']} of them in a tile {fur.tile:.2g} wide, "
        f"tips {100 * fur.laid.missed:.0f} % of a length off"
    )
