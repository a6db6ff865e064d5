"""Several furs on one body: where each of its regions is, and how long the fur is where they meet."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from furbake.body.groomed import Groomed
from furbake.body.painted import painted
from furbake.body.size import Size, questions, sized
from furbake.options import BakeOptions, OptionError
from furbake.options.regions import COAT, Region, read_regions
from furbake.pelt.hairs.strands import Strands
from furbake.surface.mesh import Floats, MeshError, Surface
from furbake.surface.place.shares import STEPS, bounds, in_balls, on_material, soften, vertex_areas

Bytes = NDArray[np.uint8]

MAINLY = STEPS // 2
"""Share from which a place counts as a region's own."""


@dataclass(frozen=True)
class Part:
    """A region with its fur.

    options : of its fur; tile, length : width of its tile and its longest hair, model units
    covers : share of the surface
    strands : of its tile, where no options grow them; record : further figures for `bake.json`
    """

    name: str
    options: BakeOptions
    tile: float
    length: float
    covers: float
    strands: Strands | None = None
    record: Mapping[str, Any] = field(default_factory=dict)

    @property
    def height(self) -> float:
        """Longest hair in widths of its own tile."""
        return self.length / self.tile


@dataclass(frozen=True)
class Dressing:
    """Furs of a surface, the coat first.

    parts : the coat and its regions
    bounds : (R + 2, V) as of `surface.place.shares.bounds`
    sizes : of each; notices : one sentence each
    """

    parts: tuple[Part, ...]
    bounds: Bytes
    sizes: tuple[Size, ...]
    notices: tuple[str, ...]

    @property
    def shares(self) -> Floats:
        """(R + 1, V) share of each fur, 1 in sum."""
        return np.diff(self.bounds.astype(np.float64), axis=0) / STEPS

    def blended(self, values: list[Floats]) -> Floats:
        """(V, ...) means of one array for each fur by their shares."""
        return np.asarray(sum((share.T * value.T).T for share, value in zip(self.shares, values, strict=True)))


def dressing(ground: Surface, skin: Surface, options: BakeOptions, coat: Size) -> Dressing | None:
    """The furs of a surface; None where all of it is the coat. Raises OptionError or MeshError of one sentence.

    ground : the surface under the fur; skin : that of the model, with its materials; coat : size of the coat
    """
    if options.region_file is None:
        return None
    regions = read_regions(options.region_file, options)
    cut = bounds([_mask(region, ground, skin, coat.tile) for region in regions])
    sizes = [coat] + [sized(ground, skin.extent, region.options) for region in regions]
    shares = np.diff(cut.astype(np.int64), axis=0)
    names = [COAT] + [region.name for region in regions]
    for name, share in zip(names, shares, strict=True):
        if not share.any():
            raise OptionError(
                f"regions: {name} is nowhere on the body, expected some of it for each region and the coat"
            )
    own = [options] + [region.options for region in regions]
    for i, region in enumerate(regions, 1):
        if region.options.length is not None:
            sizes[i] = _whole(sizes[i], shares[i])
    areas = vertex_areas(ground)
    parts = tuple(
        Part(name, of, size.tile, size.length, float(areas @ share / areas.sum()) / STEPS)
        for name, of, size, share in zip(names, own, sizes, shares, strict=True)
    )
    doubts = [
        f"{part.name}: {doubt}"
        for part in parts[1:]
        for doubt in questions(part.tile, part.length, skin.extent, part.options)
    ]
    told = ", ".join(f"{part.name} {100 * part.covers:.3g} % ({part.length:.3g} long)" for part in parts)
    return Dressing(parts, cut, tuple(sizes), (f"regions: {told}", *doubts))


def groom_parts(groom: Groomed, options: BakeOptions, ground: Surface) -> tuple[Part, ...]:
    """The furs of a groom as the coat and its regions."""
    areas = vertex_areas(ground)
    covers = np.diff(groom.bounds.astype(np.float64), axis=0) @ areas / areas.sum() / STEPS
    furs = zip(groom.names, groom.furs, map(float, covers), strict=True)
    return tuple(
        Part(name, groom.dressed(options, i), fur.tile, fur.laid.longest, share, fur.strands, {"groom": fur.record})
        for i, (name, fur, share) in enumerate(furs)
    )


def _mask(region: Region, ground: Surface, skin: Surface, tile: float) -> Floats:
    """(V,) 0..1: where a region is, with its soft border."""
    border = region.border if region.border is not None else tile / 3
    if region.near:
        return in_balls(ground, region.near, border)
    if region.material is not None:
        return soften(ground, on_material(ground, skin, region.material, region.name), border)
    try:
        return soften(ground, painted(ground, region.mask or ""), border)
    except MeshError as error:
        raise MeshError(f"regions: {region.name}.mask: {error}") from None


def _whole(size: Size, share: Bytes) -> Size:
    """Lengths of which the longest inside of a region is the whole one."""
    inside = share > MAINLY if (share > MAINLY).any() else share > 0
    longest = float(size.shares[inside].max())
    return Size(size.tile, size.length, np.minimum(size.shares / max(longest, 1e-6), 1.0), size.notices)
