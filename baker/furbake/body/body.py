"""A model read, the direction of its fur, and the fur's attributes from place to place."""

from __future__ import annotations

import time
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from furbake.body.dressing import Part, dressing, groom_parts
from furbake.body.groomed import Groomed, groomed
from furbake.body.painted import painted
from furbake.body.size import Size, questions, sized
from furbake.body.strokes import strokes_on
from furbake.options import BakeOptions
from furbake.options.pose import clip_at
from furbake.pelt.hairs.strands import Strands
from furbake.surface.charts import Charts, laid
from furbake.surface.divide import divide
from furbake.surface.lay.field import comb_field
from furbake.surface.lay.lapped import lap
from furbake.surface.lay.lapped_figures import lapped_figures
from furbake.surface.lay.own import own_charts
from furbake.surface.mesh import MAX_FACES, MeshError, Surface, load_mesh, simplify
from furbake.surface.place.features import Feature, clearing, read_features
from furbake.surface.place.hollows import out_of_hollows
from furbake.surface.place.occlusion import openness
from furbake.surface.place.paint import brought, uncover
from furbake.surface.place.thickness import length_by_thickness
from furbake.surface.place.variation import noise, underside
from furbake.surface.place.vertex_fur import VertexFur
from furbake.surface.rig.kept import listed, shown
from furbake.surface.shapes import builtin, is_builtin
from furbake.surface.skeleton.rigged import with_skeleton

Floats = NDArray[np.float64]

SHELL_FACES, MANY_FACES = 15_000, 20_000
"""Faces of the copy that carries shells and fins, and of the models that get one.

Every shell draws them all; models that are hardly larger would gain little.
"""

TURN = 0.7
"""Distance within which the normals of the ground turn at a sharp edge, lengths of the fur: less is a crest."""


@dataclass(frozen=True)
class Body:
    """A model with its fur laid.

    skin : the surface as it is shown
    ground : the surface under shells and fins: the skin, or a simpler copy of it without its bare parts
    charts, fur : of the ground
    direction : (V, 3) unit tangents of the ground along which the fur is laid
    tile, length : width of a tile and longest fur, model units
    features : eyes, a nose and the like
    regions : the coat and the parts with a fur of their own; () where all of it is one
    bounds : (R + 2, V) of the ground, as of `surface.place.shares.bounds`; None without regions
    groom : of an artist, which it wears
    notices : how long the fur is where that was not given, and units that look wrong, one sentence each
    """

    skin: Surface
    ground: Surface
    charts: Charts
    fur: VertexFur
    direction: Floats
    tile: float
    length: float
    features: tuple[Feature, ...] = ()
    regions: tuple[Part, ...] = ()
    bounds: NDArray[np.uint8] | None = None
    notices: tuple[str, ...] = ()
    groom: Groomed | None = None

    @property
    def strands(self) -> Strands | None:
        """Strands of the coat's tile that no options grow; None: they are grown."""
        return None if self.groom is None else self.groom.furs[0].strands

    def dressed(self, options: BakeOptions) -> BakeOptions:
        """The options with what a groom has in place of the preset's."""
        return options if self.groom is None else self.groom.dressed(options)


def load_surface(model: str, max_faces: int | None = None, pose: tuple[str, float] | None = None) -> Surface:
    """A built-in shape by its name, else the mesh in a file, in the pose of a clip at a time. Raises MeshError."""
    if is_builtin(model):
        if pose is not None:
            raise MeshError(f"{model}: has no clips, expected a file with the clip {shown(pose[0])} of the pose")
        return builtin(model)
    return load_mesh(Path(model), MAX_FACES if max_faces is None else max_faces, pose)


def grounded(skin: Surface) -> Surface:
    """The surface under shells and fins: the skin, or a simpler copy of a large one."""
    return simplify(skin, SHELL_FACES) if len(skin.faces) > MANY_FACES else skin


def prepare(model: str, options: BakeOptions) -> Body:
    """Read `model` and lay its fur. Raises MeshError or OptionError, each with one sentence."""
    skin = _skin(model, options)
    ground = grounded(skin)
    if options.groom is not None:
        return wearing(model, options, skin, ground)
    skin, ground, size = _divided(model, skin, ground, options)
    maps = painted_maps(ground, options)
    lengths, longest = _lengths(ground, size, options, maps), size.length
    furs = dressing(ground, skin, options, size)
    if furs is not None:
        sizes = zip(furs.sizes, furs.parts, strict=True)
        own = [each.length * _lengths(ground, each, part.options, maps) for each, part in sizes]
        longest = max(each.length for each in furs.sizes)
        lengths = furs.blended(own) / longest
    if "mask" in maps and (maps["mask"] < 0.5 / 255).any():
        ground, kept = uncover(ground, maps["mask"], model)
        lengths = lengths[kept]
        furs = None if furs is None else replace(furs, bounds=furs.bounds[:, kept])
    features = () if options.features is None else _features(Path(options.features), skin)
    if features:
        lengths = lengths * clearing(ground, features)
    strokes = strokes_on(skin, Path(options.comb)) if options.comb is not None else ()
    attribute = ground.attributes.get("direction", ground.attributes.get("comb"))
    if attribute is not None and attribute.shape[1] != 3:
        attribute = None
    field = comb_field(ground, options.guide, strokes, attribute)
    direction = field.direction
    if options.uv == "lapped":
        charts = lap(ground, direction, size.tile, options.seed)
    else:
        charts = own_charts(ground, size.tile, model)
        direction = laid(charts, ground.normals)
    tip, comb = _tip(ground, options), options.sweep * field.strength[:, None] * direction
    if furs is not None:
        tip = furs.blended([_tip(ground, part.options) for part in furs.parts])
        comb = furs.blended([part.options.sweep * field.strength[:, None] * direction for part in furs.parts])
    return Body(
        skin=skin,
        ground=ground,
        charts=charts,
        fur=VertexFur(
            lengths=np.asarray(lengths),
            occlusion=openness(ground),
            tip=tip,
            comb=out_of_hollows(ground, longest * np.asarray(lengths), comb),
            colour=ground.colours,
        ),
        direction=direction,
        tile=size.tile,
        length=longest,
        features=features,
        regions=() if furs is None else furs.parts,
        bounds=None if furs is None else furs.bounds,
        notices=(
            *questions(size.tile, size.length, skin.extent, options),
            *size.notices,
            *(() if furs is None else furs.notices),
        ),
    )


def _skin(model: str, options: BakeOptions) -> Surface:
    """The model in its pose, with the skeleton that the options bring. Raises MeshError or OptionError."""
    pose = None if options.pose is None else clip_at(options.pose)
    if options.rig is None:
        return load_surface(model, options.max_faces, pose)
    return with_skeleton(model, load_surface(model, options.max_faces), Path(options.rig), pose)


def _divided(model: str, skin: Surface, ground: Surface, options: BakeOptions) -> tuple[Surface, Surface, Size]:
    """Skin and ground with normals that turn within a hair's length along sharp edges, and the size of their fur."""
    size = sized(ground, skin.extent, options)
    divided = divide(ground, TURN * size.length * size.shares, MANY_FACES)
    if divided is ground:
        return skin, ground, size
    size = sized(divided, skin.extent, options)
    told = f"{model}: {len(ground.faces)} faces divided into {len(divided.faces)} along sharp edges"
    size = replace(size, notices=(told, *size.notices))
    return divided if skin is ground else skin, divided, size


def wearing(model: str, options: BakeOptions, skin: Surface, ground: Surface) -> Body:
    """A model in an artist's groom; maps, a mask and features shorten its strands. Raises MeshError or GroomError."""
    groom = groomed(options, skin, ground)
    maps = painted_maps(ground, options)
    mask = np.where(groom.bald, 0.0, maps.get("mask", 1.0))
    direction, comb, density, colour = groom.direction, groom.comb, groom.density, groom.colour
    cut, tile = groom.bounds, groom.furs[0].tile
    parts = groom_parts(groom, options, ground) if len(groom.furs) > 1 else ()
    lengths = groom.lengths * maps.get("length", 1.0) * mask
    if (mask < 0.5 / 255).any():
        ground, kept = uncover(ground, mask, model)
        lengths, direction, comb, density = lengths[kept], direction[kept], comb[kept], density[kept]
        cut = cut[:, kept]
        colour = None if colour is None else colour[kept]
    features = () if options.features is None else _features(Path(options.features), skin)
    if features:
        lengths = lengths * clearing(ground, features)
    charts = lap(ground, direction, tile, options.seed)
    charts = replace(charts, weights=charts.weights * density[charts.source])
    fur = VertexFur(
        lengths=lengths,
        occlusion=openness(ground),
        tip=_tip(ground, options),
        comb=comb,
        colour=ground.colours,
        own=colour,
    )
    return Body(
        skin=skin,
        ground=ground,
        charts=charts,
        fur=fur,
        direction=direction,
        tile=tile,
        length=groom.length,
        features=features,
        regions=parts,
        bounds=cut if parts else None,
        notices=groom.notices,
        groom=groom,
    )


def painted_maps(ground: Surface, options: BakeOptions) -> dict[str, Floats]:
    """(V,) 0..1 numbers for the fur, by name: those that the file brings, and those that the options name."""
    maps = brought(ground)
    if options.length_map is not None:
        maps["length"] = painted(ground, options.length_map)
    if options.mask is not None:
        maps["mask"] = painted(ground, options.mask)
    return maps


def _lengths(ground: Surface, size: Size, options: BakeOptions, maps: dict[str, Floats]) -> Floats:
    """(V,) 0..1, share of the longest hair of one fur at each vertex."""
    lengths = size.shares
    if options.length_by_thickness:
        lengths = lengths * length_by_thickness(ground)
    if options.length_noise:
        lengths = lengths * (1 - options.length_noise * noise(ground, options.seed))
    for name in ("length", "mask"):
        lengths = lengths * maps.get(name, 1.0)
    return lengths


def _tip(ground: Surface, options: BakeOptions) -> Floats:
    """(V,) 0..1, from the first tip colour to the second."""
    return np.asarray(
        np.maximum(options.tip_noise * noise(ground, options.seed + 1), options.belly * underside(ground))
    )


def _features(path: Path, skin: Surface) -> tuple[Feature, ...]:
    """The features in a file; the joints that they hang on are the skin's. Raises MeshError."""
    features = read_features(path)
    joints = [] if skin.rig is None else [skin.rig.nodes[joint].name for joint in skin.rig.joints]
    for i, feature in enumerate(features):
        if feature.joint is not None and feature.joint not in joints:
            some = f"one of {listed(joints)}" if joints else "none, as nothing moves the model"
            raise MeshError(f"{path}: features[{i}].joint is {shown(feature.joint)}, expected {some}")
    return features


def patch_figures(model: str, faces: int | None = None, tile_share: float = BakeOptions.tile_share) -> dict[str, float]:
    """Figures of lapped patches on a model, simplified to `faces` if given: `lapped_figures` and seconds."""
    surface = load_surface(model)
    surface = surface if faces is None else simplify(surface, faces)
    start = time.perf_counter()
    direction = comb_field(surface).direction
    tile = tile_share * surface.extent
    charts = lap(surface, direction, tile)
    took = time.perf_counter() - start
    return {"faces": len(surface.faces), **lapped_figures(surface, charts, direction, tile), "seconds": took}
