"""The only writer of glTF: skin, shells, fins and the extension `FUR_ptm_shells`, as `schema/README.md` fixes them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from furbake.asset.extension import EXTENSION, VERSION_LATEST, extension, state_prefix
from furbake.asset.mesh.buffer import MESHOPT, Buffer, dump, numbers
from furbake.asset.mesh.edges import edges_record
from furbake.asset.mesh.shared import skin_first
from furbake.asset.mesh.vertices import (
    Attributes,
    coarse,
    fin_vertices,
    grid,
    shell_vertices,
    shifted_by_tiles,
    tiles_across,
)
from furbake.asset.planes import write_planes
from furbake.asset.regions.parted import fin_bounds, parted
from furbake.asset.regions.record import Regions, regions_record, write_regions
from furbake.asset.rig.bind import bound
from furbake.asset.rig.motion import Motion
from furbake.asset.rig.nodes import morphs, rigged
from furbake.asset.rig.stand import Stand
from furbake.asset.roots.write import fin_roots, roots_record
from furbake.asset.skin import Looks, bare_colour, feature_nodes, fur_colour, skin_primitives
from furbake.pelt.pelt import Pelt
from furbake.surface.charts import Charts
from furbake.surface.mesh import RGB, Surface
from furbake.surface.place.features import Feature, placed
from furbake.surface.place.fins import Fins
from furbake.surface.place.vertex_fur import VertexFur
from furbake.surface.roots.picture import Roots

Record = dict[str, Any]
Floats = NDArray[np.float64]

QUANTIZATION = "KHR_mesh_quantization"


@dataclass(frozen=True)
class FurModel:
    """A body with its fur, as it is stored.

    skin : the surface as it is shown
    charts, fur : of the ground
    pelts : the dry fur, then further states of it
    length : longest fur, model units
    fins : on the ground, or None
    ground : surface that charts, fur and fins stand on where it is not the skin itself but a simpler copy
    features : further opaque meshes of the scene; where they stand on the skin they are put there
    bare : linear colour of a skin that brings no colour at all; None: white
    motion : what moves skin and ground; None: nothing. Where its rig has a pose all of the above is in it
    tinted : whether the fur takes the colour of the skin below it; else it has its own alone
    roots : the skin's colours where hairs have their roots; None: those of the vertices
    regions : furs of parts of the ground beside `pelts`; None: `pelts` is that of all of it
    thinned : whether hairs are fewer in places, where the weights of its charts sum to less than 1
    """

    skin: Surface
    charts: Charts
    fur: VertexFur
    pelts: tuple[Pelt, ...]
    length: float
    fins: Fins | None = None
    ground: Surface | None = None
    features: tuple[Feature, ...] = ()
    bare: RGB | None = None
    motion: Motion | None = None
    tinted: bool = True
    roots: Roots | None = None
    regions: Regions | None = None
    thinned: bool = False


# Long: one document, put together in the order of its parts.
def write_gltf(folder: Path, model: FurModel, compress: bool = False, cache: Path | None = None) -> Record:
    """Write model.gltf, model.bin and all images into `folder`; counts and file sizes for the record.

    compress : meshes by `EXT_meshopt_compression`, and the fins of a body without morph targets as edges of the shells
    cache : optional folder of images of pelts that were encoded before
    """
    features = placed(model.skin, model.features)
    laid, model = model.skin, bound(model)
    surface, charts, fins, fur, pelts, motion = (
        model.skin, model.charts, model.fins, model.fur, model.pelts, model.motion
    )  # fmt: skip
    pelt = pelts[0]
    looks = Looks(
        folder, [name for each in pelts for name in write_planes(folder, each, state_prefix(each, pelt), cache)]
    )
    planes, others = list(looks.images), write_regions(folder, model.regions, looks.images, cache)
    buffer = Buffer(compress)
    ground = model.ground or surface
    place = grid(surface.vertices, ground.vertices)
    body = Stand(surface, *place, motion, None if motion is None else motion.skin)
    below = Stand(ground, *place, motion, None if motion is None else motion.ground)
    own = bare_colour(surface, fur, model.bare)
    colours = fur.colour if model.ground is None else None
    fur = fur_colour(surface, own, fur, model.tinted)

    whole = charts
    uv = shifted_by_tiles(charts) if model.roots is None else model.roots.uv
    tiles = tiles_across(uv, *([] if fins is None else [fins.uv]))
    stood = shell_vertices(ground, charts, fur, below.positions, uv, tiles) | below.joints(charts.source)
    model, stood = _parted(model, stood)
    if compress:
        stood = coarse(stood, tiles, pelt.size)
    shared = _skin_first(model) if compress else None
    charts = shared or model.charts
    shells = buffer.primitive(stood, charts.faces)
    skin = skin_primitives(body, own, colours, buffer, looks, None if shared is None else (shells, shared.source))
    meshes: list[Record] = [
        {"name": "skin", "primitives": skin},
        {"name": "shells", "primitives": [shells | below.shell_targets(buffer, charts)]},
    ]
    edges = _fin_edges(model, charts, stood, buffer) if compress else None
    if fins is not None and edges is None:
        stood = fin_vertices(ground, fins, fur, below.positions, tiles) | below.joints(fins.source)
        stood |= fin_roots(whole, fins, model.roots)
        stood |= {} if model.regions is None else fin_bounds(model.regions.quads)
        quads = buffer.primitive(stood, fins.faces)
        meshes.append({"name": "fins", "primitives": [quads | below.fin_targets(buffer, fins)]})
    names, meshes = [mesh["name"] for mesh in meshes], [mesh | morphs(motion) for mesh in meshes]
    undone = {"translation": numbers(place[0]), "scale": numbers(np.full(3, place[1]))}
    nodes = [{"name": name, "mesh": i, **undone} for i, name in enumerate(names)]
    nodes += feature_nodes(features, buffer, looks, meshes)
    roots, moving = rigged(nodes, features, motion, laid, place, buffer)
    needed = [QUANTIZATION, *([MESHOPT] if buffer.unpacked else [])]
    moves = motion is not None
    fur_record = extension(pelts, model.length, tiles, planes, names, moves, edges, roots_record(model.roots, looks))
    fur_record |= {"thinned": True} if model.thinned else {}
    if model.regions is not None:
        furs = [extension(each.pelts, model.length, tiles, named, names, moves) for each, named in others]
        fur_record |= {"version": VERSION_LATEST, "regions": regions_record(model.regions, furs)}
    document = {
        "asset": {"version": "2.0", "generator": f"furbake {version('furbake')}"},
        "extensionsUsed": [EXTENSION, *needed],
        "extensionsRequired": needed,
        "scene": 0,
        "scenes": [{"nodes": [0, *roots]}],
        "nodes": nodes,
        "meshes": meshes,
        **moving,
        **looks.records,
        **buffer.records("model.bin"),
        "extensions": {EXTENSION: fur_record},
    }
    (folder / "model.bin").write_bytes(bytes(buffer.data))
    (folder / "model.gltf").write_text(dump(document), "utf-8", newline="\n")
    files = ("model.gltf", "model.bin", *looks.images)
    return _counts(model) | {"bytes": {name: (folder / name).stat().st_size for name in files}}


def _parted(model: FurModel, stood: Attributes) -> tuple[FurModel, Attributes]:
    """A model and its shells' vertices; where it has several furs, with copies of the vertices for each."""
    if model.regions is None:
        return model, stood
    parts = parted(model.charts, model.regions.bounds)
    return replace(model, charts=parts.charts), parts.copies(stood)


def _has_targets(model: FurModel) -> bool:
    """True where morph targets move a body."""
    return model.motion is not None and bool(model.motion.rig.targets)


def _skin_first(model: FurModel) -> Charts | None:
    """Charts that begin with the faces of the skin, which needs none of its own then; None where it has some."""
    alone = model.ground is not None or model.skin.skin or _has_targets(model)
    return None if alone else skin_first(model.charts, model.skin.faces)


def _fin_edges(model: FurModel, charts: Charts, stood: Attributes, buffer: Buffer) -> Record | None:
    """Fins as edges of the shells, of which readers make quads; None for those that are stored."""
    if model.fins is None or model.pelts[0].curves is None or _has_targets(model) or model.regions is not None:
        return None
    return edges_record(charts, stood["POSITION"], model.fins, buffer)


def _counts(model: FurModel) -> Record:
    """Vertices and faces of what was written, and what moves it."""
    counts = {
        "skin": {"vertices": len(model.skin.vertices), "faces": len(model.skin.faces)},
        "shells": {"vertices": len(model.charts.source), "faces": len(model.charts.faces)},
    }
    if model.fins is not None:
        counts["fins"] = {"vertices": len(model.fins.source), "faces": len(model.fins.faces)}
    if model.motion is not None:
        rig = model.motion.rig
        counts["rig"] = {"joints": len(rig.joints), "clips": len(rig.clips), "targets": len(rig.targets)}
    return counts
