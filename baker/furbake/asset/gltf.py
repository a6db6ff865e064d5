"""The only writer of glTF: skin, shells, fins and the extension `FUR_ptm_shells`, as `schema/README.md` fixes them."""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from furbake.asset.buffer import Buffer, numbers
from furbake.asset.planes import pack, pack_fin, write_png
from furbake.asset.skin import Looks, bare_colour, feature_nodes, fur_colour, skin_primitives
from furbake.asset.vertices import (
    fin_vertices,
    grid,
    quantise_positions,
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

Record = dict[str, Any]
Floats = NDArray[np.float64]

EXTENSION = "FUR_ptm_shells"
VERSION, VERSION_STATES, VERSION_CURVES = "1.0", "1.1", "2.0"
"""Format versions: one pelt, several states of it, mean curves."""

QUANTIZATION = "KHR_mesh_quantization"

LAWS = ("bent", "eye")
"""Numbers of the fur as a whole, where it has any."""

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


def write_gltf(folder: Path, model: FurModel) -> Record:
    """Write model.gltf, model.bin and all images into `folder`; counts and file sizes for the record."""
    surface, charts, fins, fur, pelts = model.skin, model.charts, model.fins, model.fur, model.pelts
    pelt = pelts[0]
    looks = Looks(folder, [name for each in pelts for name in _write_planes(folder, each, _prefix(each, pelt))])
    planes = list(looks.images)
    buffer = Buffer()
    ground = model.ground or surface
    offset, scale = grid(surface.vertices, ground.vertices)
    positions = quantise_positions(ground.vertices, offset, scale)
    colours = fur.colour if model.ground is None else None
    own = bare_colour(surface, fur, model.bare)
    skin = skin_primitives(surface, own, quantise_positions(surface.vertices, offset, scale), colours, buffer, looks)
    fur = fur_colour(surface, own, fur)

    uv = shifted_by_tiles(charts)
    tiles = tiles_across(uv, *([] if fins is None else [fins.uv]))
    shells = buffer.primitive(shell_vertices(ground, charts, fur, positions, uv, tiles), charts.faces)
    meshes: list[Record] = [{"name": "skin", "primitives": skin}, {"name": "shells", "primitives": [shells]}]
    if fins is not None:
        edges = buffer.primitive(fin_vertices(ground, fins, fur, positions, tiles), fins.faces)
        meshes.append({"name": "fins", "primitives": [edges]})
    names = [mesh["name"] for mesh in meshes]
    place = {"translation": numbers(offset), "scale": numbers(np.full(3, scale))}
    nodes = [{"name": name, "mesh": i, **place} for i, name in enumerate(names)]
    nodes += feature_nodes(placed(surface, model.features), buffer, looks, meshes)
    document = {
        "asset": {"version": "2.0", "generator": f"furbake {version('furbake')}"},
        "extensionsUsed": [EXTENSION, QUANTIZATION],
        "extensionsRequired": [QUANTIZATION],
        "scene": 0,
        "scenes": [{"nodes": [0, *range(len(names), len(nodes))]}],
        "nodes": nodes,
        "meshes": meshes,
        **looks.records,
        "accessors": buffer.accessors,
        "bufferViews": buffer.views,
        "buffers": [{"uri": "model.bin", "byteLength": len(buffer.data)}],
        "extensions": {EXTENSION: extension(pelts, model.length, tiles, planes, names)},
    }
    (folder / "model.bin").write_bytes(bytes(buffer.data))
    (folder / "model.gltf").write_text(dump(document), "utf-8", newline="\n")
    counts = {
        "skin": {"vertices": len(surface.vertices), "faces": len(surface.faces)},
        "shells": {"vertices": len(charts.source), "faces": len(charts.faces)},
    }
    if fins is not None:
        counts["fins"] = {"vertices": len(fins.source), "faces": len(fins.faces)}
    files = ("model.gltf", "model.bin", *looks.images)
    return counts | {"bytes": {name: (folder / name).stat().st_size for name in files}}


def extension(pelts: Sequence[Pelt], length: float, tiles: float, images: list[str], nodes: list[str]) -> Record:
    """The JSON object of the extension, for nodes (skin, shells and perhaps fins) and images in the order of writing.

    pelts : the dry fur and further states of it, all with its basis, λ and Ω
    length : longest fur, model units; tiles : how many of them a texture coordinate of 1 stands for
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
        version = VERSION_CURVES
        lit = {"curves": {"even": _tables(pelt.curves.even), "along": _tables(pelt.curves.along)}}
    return {
        "version": version,
        **{name: i for i, name in enumerate(nodes)},
        "layers": pelt.layers,
        "size": pelt.size,
        "coefficients": pelt.coefficients,
        "length": numbers(np.array([length]))[0],
        "height": numbers(np.array([pelt.height]))[0],
        "tiles": tiles,
        "basis": basis,
        **lit,
        "drift": [numbers(row) for row in pelt.drift],
        **{name: [numbers(row) for row in law] for name in LAWS if (law := getattr(pelt, name)) is not None},
        **({} if pelt.surge is None else {"surge": numbers(pelt.surge)}),
        "ramp": {
            "root": numbers(np.array(pelt.ramp.root)),
            "tip": numbers(np.array(pelt.ramp.tip)),
            "tip2": numbers(np.array(pelt.ramp.tip2)),
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


def _tables(tables: Floats) -> list[Any]:
    """(Q, 3, 17) as lists."""
    return [[numbers(row) for row in table] for table in tables]


def _prefix(pelt: Pelt, dry: Pelt) -> str:
    """Prefix of the names of a pelt's images."""
    return "" if pelt is dry else f"{pelt.state.name}-"


def dump(document: Any) -> str:
    """JSON with one line per object member and flat lists in one line."""
    text = json.dumps(document, indent=1, ensure_ascii=False, allow_nan=False)
    return re.sub(r"\[\s*([^\[\]{}]*?)\s*\]", lambda match: f"[{' '.join(match[1].split())}]", text) + "\n"


def _write_planes(folder: Path, pelt: Pelt, prefix: str = "") -> list[str]:
    """Write the images of a pelt, whose names begin with `prefix`; their names in the order of `images`."""
    written: list[str] = []
    for part, planes in (("", pack(pelt)), ("fin-", None if pelt.fin is None else pack_fin(pelt.fin))):
        if planes is None:
            continue
        stem = "fin" if part else "plane"
        images = {f"{prefix}{stem}{i}.png": pixels for i, pixels in enumerate(planes.coefficients)}
        for name, pixels in images.items():
            write_png(folder / name, pixels)
        written += images
        if planes.colour is not None:
            written.append(f"{prefix}{part}colour.png")
            write_png(folder / written[-1], planes.colour, srgb=True)
        if planes.direction is not None:
            written.append(f"{prefix}{part}direction.png")
            write_png(folder / written[-1], planes.direction)
    return written
