"""The JSON object of the extension `FUR_ptm_shells`, as `schema/README.md` fixes it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from furbake.asset.mesh.buffer import nested, numbers
from furbake.pelt.fin import fin_environment
from furbake.pelt.multiple import Multiple
from furbake.pelt.pelt import Pelt
from furbake.pelt.texels.basis import environment

Record = dict[str, Any]

EXTENSION = "FUR_ptm_shells"
VERSION, VERSION_STATES, VERSION_CURVES, VERSION_MOTION, VERSION_EDGES = "1.0", "1.1", "2.0", "2.1", "2.2"
VERSION_LATEST = "2.3"
"""Format versions: one pelt, several states of it, mean curves, bodies that move, fins as edges; pictures of roots,
several furs on one body, fins as edges of bodies that move."""

LAWS = {"bent": "bent", "eye": "eye", "fin_eye": "finEye"}
"""Numbers of the fur as a whole, where it has any: their names in a pelt and in the file."""

STATE = ("wetness", "dirt", "length", "shade", "gloss", "sharpness")
"""Numbers of a pelt's state."""


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
        "pelts": [_state(each, images, state_prefix(each, pelt), len(pelts) > 1) for each in pelts],
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


def state_prefix(pelt: Pelt, dry: Pelt) -> str:
    """Prefix of the names of a pelt's images."""
    return "" if pelt is dry else f"{pelt.state.name}-"
