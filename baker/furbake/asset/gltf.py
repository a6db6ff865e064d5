"""The only writer of glTF: skin, shells, fins and the extension `FUR_ptm_shells`, as `schema/README.md` fixes them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from furbake.asset.buffer import MESHOPT, Buffer, dump, nested, numbers
from furbake.asset.edges import edges_record
from furbake.asset.planes import write_planes
from furbake.asset.regions.parted import fin_bounds, parted
from furbake.asset.regions.record import Regions, regions_record, write_regions
from furbake.asset.rig.bind import bound
from furbake.asset.rig.motion import Motion
from furbake.asset.rig.nodes import morphs, rigged
from furbake.asset.rig.stand import Stand
from furbake.asset.roots.write import fin_roots, roots_record
from furbake.asset.skin import Looks, bare_colour, feature_nodes, fur_colour, skin_primitives
from furbake.asset.vertices import (
    Attributes,
    coarse_uv,
    fin_vertices,
    grid,
    shell_vertices,
    shifted_by_tiles,
    tiles_across,
)
from furbake.pelt.fin import fin_environment
from furbake.pelt.multiple import Multiple
from furbake.pelt.pelt import Pelt
from furbake.pelt.texels.basis import environment
from furbake.surface.charts import Charts
from furbake.surface.mesh import RGB, Surface
from furbake.surface.place.features import Feature, placed
from furbake.surface.place.fins import Fins
from furbake.surface.place.vertex_fur import VertexFur
from furbake.surface.roots.picture import Roots

Record = dict[str, Any]
Floats = NDArray[np.float64]

EXTENSION = "FUR_ptm_shells"
VERSION, VERSION_STATES, VERSION_CURVES, VERSION_MOTION, VERSION_EDGES = "1.0", "1.1", "2.0", "2.1", "2.2"
VERSION_LATEST = "2.3"
"""Format versions: one pelt, several states of it, mean curves, bodies that move, fins as edges; pictures of roots,
several furs on one body, fins as edges of bodies that move."""

QUANTIZATION = "KHR_mesh_quantization"

LAWS = {"bent": "bent", "eye": "eye", "fin_eye": "finEye"}
"""Numbers of the fur as a whole, where it has any: their names in a pelt and in the file."""

STATE = ("wetness", "dirt", "length", "shade", "gloss", "sharpness")
"""Numbers of a pelt's state."""


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
    looks = Looks(folder, [name for each in pelts for name in write_planes(folder, each, _prefix(each, pelt), cache)])
    planes, others = list(looks.images), write_regions(folder, model.regions, looks.images, cache)
    buffer = Buffer(compress)
    ground = model.ground or surface
    place = grid(surface.vertices, ground.vertices)
    body = Stand(surface, *place, motion, None if motion is None else motion.skin)
    below = Stand(ground, *place, motion, None if motion is None else motion.ground)
    own = bare_colour(surface, fur, model.bare)
    skin = skin_primitives(body, own, fur.colour if model.ground is None else None, buffer, looks)
    fur = fur_colour(surface, own, fur, model.tinted)

    whole = charts
    uv = shifted_by_tiles(charts) if model.roots is None else model.roots.uv
    tiles = tiles_across(uv, *([] if fins is None else [fins.uv]))
    stood = shell_vertices(ground, charts, fur, below.positions, uv, tiles) | below.joints(charts.source)
    if model.regions is not None:
        parts = parted(charts, model.regions.bounds)
        charts, stood = parts.charts, parts.copies(stood)
        model = replace(model, charts=charts)
    if compress:
        stood["TEXCOORD_0"] = coarse_uv(stood["TEXCOORD_0"], tiles, pelt.size)
    shells = buffer.primitive(stood, charts.faces)
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


def _fin_edges(model: FurModel, charts: Charts, stood: Attributes, buffer: Buffer) -> Record | None:
    """Fins as edges of the shells, of which readers make quads; None for those that are stored."""
    morphs = model.motion is not None and model.motion.rig.targets
    if model.fins is None or model.pelts[0].curves is None or morphs or model.regions is not None:
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


def extension(
    pelts: Sequence[Pelt],
    length: float,
    tiles: float,
    images: list[str],
    nodes: list[str],
    moves: bool = False,
    edges: Record | None = None,
    roots: Record | None = None,
) -> Record:
    """The JSON object of the extension, for nodes (skin, shells and perhaps fins) and images in the order of writing.

    pelts : the dry fur and further states of it, all with its basis, λ and Ω
    length : longest fur, model units; tiles : how many of them a texture coordinate of 1 stands for
    moves : whether the body has joints, clips or morph targets
    edges : of the fins, where they are no node; roots : the picture of the roots, where there is one
    """
    pelt = pelts[0]
    basis: Record = {"kind": pelt.basis.kind}
    if pelt.basis.kind == "eigen":
        if pelt.basis.matrix is None or pelt.basis.degree is None:
            raise ValueError("basis: got eigen without its matrix, expected a row of weights per coefficient")
        basis |= {"degree": pelt.basis.degree, "matrix": [numbers(row) for row in pelt.basis.matrix]}
    mud = next((each.state.mud for each in pelts if each.state.mud is not None), None)
    version = VERSION if len(pelts) == 1 else VERSION_STATES
    lit: Record = {"environment": [numbers(row) for row in environment(pelt.basis)]}
    if pelt.curves is not None:
        version = VERSION_EDGES if edges else VERSION_MOTION if moves else VERSION_CURVES
        version = VERSION_LATEST if roots or (edges and moves) else version
        lit = {"curves": {"even": nested(pelt.curves.even), "along": nested(pelt.curves.along)}}
    return {
        "version": version,
        **{name: i for i, name in enumerate(nodes)},
        **({} if edges is None else {"edges": edges}),
        **({} if roots is None else {"roots": roots}),
        "layers": pelt.layers,
        "size": pelt.size,
        "coefficients": pelt.coefficients,
        "length": numbers(np.array([length]))[0],
        "height": numbers(np.array([pelt.height]))[0],
        "tiles": tiles,
        "basis": basis,
        **lit,
        "drift": [numbers(row) for row in pelt.drift],
        **{name: [numbers(row) for row in law] for of, name in LAWS.items() if (law := getattr(pelt, of)) is not None},
        **{name: numbers(row) for name in ("surge", "short") if (row := getattr(pelt, name)) is not None},
        **{name: numbers(np.array([value]))[0] for name in ("spread", "open") if (value := getattr(pelt, name))},
        "ramp": {
            **{name: numbers(np.array(getattr(pelt.ramp, name))) for name in ("root", "tip", "tip2")},
            "power": float(pelt.ramp.power),
        },
        **({} if mud is None else {"mud": numbers(np.array(mud))}),
        "pelts": [_state(each, images, _prefix(each, pelt), len(pelts) > 1) for each in pelts],
    }


def _state(pelt: Pelt, images: list[str], prefix: str, several: bool) -> Record:
    """The JSON object of one state, whose images begin with `prefix`. A single one is dry and clean."""
    state: Record = {"name": pelt.state.name}
    if several:
        state |= {name: numbers(np.array([getattr(pelt.state, name)]))[0] for name in STATE}
    state |= {
        "planes": [i for i, uri in enumerate(images) if uri.startswith(f"{prefix}plane")],
        "scale": numbers(pelt.scale),
        "bias": numbers(pelt.bias),
    }
    if pelt.weights is not None:
        state["weights"] = [numbers(row) for row in pelt.weights]
    if pelt.multiple is not None:
        state["multiple"] = _multiple(pelt.multiple)
    for role in ("colour", "direction"):
        if f"{prefix}{role}.png" in images:
            state[role] = images.index(f"{prefix}{role}.png")
    if pelt.fin is not None:
        height, width = pelt.fin.alpha.shape
        state["fin"] = {
            "width": width,
            "height": height,
            "planes": [images.index(f"{prefix}fin{i}.png") for i in range(2)],
            "scale": numbers(pelt.fin.scale),
            "bias": numbers(pelt.fin.bias),
            "basis": {"kind": "ptm"},
        }
        if pelt.curves is None:
            state["fin"]["environment"] = [numbers(row) for row in fin_environment()]
        if f"{prefix}fin-colour.png" in images:
            state["fin"]["colour"] = images.index(f"{prefix}fin-colour.png")
    return state


def _multiple(multiple: Multiple) -> Record:
    """The JSON object of light that has met several hairs."""
    lists = {name: numbers(getattr(multiple, name)) for name in ("ratio", "seen", "tint")}
    rows = {"shares": multiple.shares} | ({} if multiple.colour is None else {"colour": multiple.colour})
    return {
        "albedo": numbers(np.array([multiple.albedo]))[0],
        **lists,
        **{name: [numbers(row) for row in values] for name, values in rows.items()},
    }


def _prefix(pelt: Pelt, dry: Pelt) -> str:
    """Prefix of the names of a pelt's images."""
    return "" if pelt is dry else f"{pelt.state.name}-"
