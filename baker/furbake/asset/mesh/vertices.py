"""Vertices as glTF stores them: at most 32 bytes each, in normalised integers, of equal bits where they coincide.

Where the body has joints a vertex takes 40 bytes at most, and 4 more where there are more than 256 joints.

| bytes | shells | fins |
|---|---|---|
| 8 | POSITION | POSITION |
| 4 | NORMAL | NORMAL |
| 4 | TANGENT | TANGENT |
| 4 | TEXCOORD_0 | TEXCOORD_0 |
| 4 | COLOR_0, where the model has colours | COLOR_0 |
| 4 | _FUR: weight, length, occlusion, tip | _FUR: where the fur is laid, length, occlusion, tip |
| 4 | _COMB: along T and B | _EDGE: angles of the two faces, comb along and across |
| 4 | JOINTS_0, where the body has joints; 8 of more than 256 | JOINTS_0 |
| 4 | WEIGHTS_0, where the body has joints | WEIGHTS_0 |
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from furbake.surface.charts import Charts
from furbake.surface.mesh import Surface
from furbake.surface.place.fins import Fins
from furbake.surface.place.vertex_fur import VertexFur, tangential
from furbake.surface.roots.layout import patches_of

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bytes = NDArray[np.uint8]
Shorts = NDArray[np.uint16]
Attributes = dict[str, NDArray[Any]]

SHORT = 65535
TEXEL_SHARES = 8
"""Steps of a rounded texture coordinate in a texel, at least: half of one is lost."""

FUR_STEP = 4
"""Distance of rounded lengths, occlusions and tips: 6 bits of a byte, as the texels' numbers have."""

FULL_FUR = (255, 255, 255, 0)
"""Default of _FUR: the whole weight and length, open, of the first tip colour."""


def shell_vertices(
    surface: Surface, charts: Charts, fur: VertexFur, positions: Shorts, uv: Floats, tiles: float
) -> Attributes:
    """Attributes of the shells' M vertices by glTF's names; the fur's colours are the whole of the skin's below it.

    positions : (V, 3) of the surface, as `quantise_positions` makes them
    uv : (M, 2) from 0 to `tiles`
    """
    source = charts.source
    weights = quantise_weights(charts.weights, charts.group)
    comb = tangential(fur.comb, surface.normals)[source]
    tangent = charts.tangents[:, :3]
    bitangent = charts.tangents[:, 3:] * np.cross(surface.normals[source], tangent)
    return {
        "POSITION": positions[source],
        "NORMAL": signed(surface.normals)[source],
        "TANGENT": signed(charts.tangents),
        "TEXCOORD_0": quantise_uv(uv, tiles),
        **_colour(fur, source),
        **_fur(weights, fur, source),
        **omit_default("_COMB", signed(_components(comb, tangent, bitangent)), 0),
    }


def fin_vertices(surface: Surface, fins: Fins, fur: VertexFur, positions: Shorts, tiles: float) -> Attributes:
    """Attributes of the fins' four vertices per edge by glTF's names; parameters as of `shell_vertices`."""
    source = fins.source
    normals = surface.normals[source]
    across = np.cross(fins.tangents, normals)
    across /= np.maximum(np.linalg.norm(across, axis=1, keepdims=True), 1e-12)
    along = np.cross(normals, across)
    comb = tangential(fur.comb, surface.normals)[source]
    return {
        "POSITION": positions[source],
        "NORMAL": signed(normals),
        "TANGENT": signed(np.column_stack([fins.tangents, np.ones(len(source))])),
        "TEXCOORD_0": quantise_uv(fins.uv, tiles),
        **_colour(fur, source),
        **_fur(shares(fins.laid / (2 * np.pi) % 1), fur, source),
        "_EDGE": signed(np.column_stack([fins.angles / np.pi, _components(comb, along, across)])),
    }


def quantise_positions(vertices: Floats, offset: Floats, scale: float) -> Shorts:
    """(V, 3) 16-bit positions; offset + scale · code / 65535 brings them back, within scale / 131070 per axis."""
    return np.rint((vertices - offset) * (SHORT / scale)).astype(np.uint16)


def grid(*parts: Floats) -> tuple[Floats, float]:
    """The (3,) offset and the scale in which `quantise_positions` takes all parts, each (V, 3).

    One scale for all axes, so that normals need no correction.
    """
    low = np.min([part.min(axis=0) for part in parts], axis=0)
    high = np.max([part.max(axis=0) for part in parts], axis=0)
    return low, float((high - low).max())


def shifted_by_tiles(charts: Charts) -> Floats:
    """(M, 2) texture coordinates with each patch moved by whole tiles to where they are positive and small."""
    patches, patch = patches_of(charts)
    low = np.full((patches, 2), np.inf)
    np.minimum.at(low, patch, charts.uv)
    return np.asarray(np.maximum(charts.uv - np.floor(low + 1e-9)[patch], 0.0))


def tiles_across(*parts: Floats) -> float:
    """The least whole number of tiles that holds all texture coordinates, each part (n, 2) and ≥ 0."""
    return float(max(1.0, np.ceil(max(float(part.max(initial=0.0)) for part in parts) - 1e-6)))


def quantise_uv(uv: Floats, tiles: float) -> Shorts:
    """(n, 2) texture coordinates 0..tiles as 16-bit shares of `tiles`."""
    return np.rint(np.clip(uv / tiles, 0.0, 1.0) * SHORT).astype(np.uint16)


def coarse_uv(codes: Shorts, tiles: float, size: int) -> Shorts:
    """(n, 2) texture coordinates of `quantise_uv`, rounded so that fewer of their bits differ, yet a 16th of a texel at
    most is lost on tiles of `size` texels.
    """
    step = 2 ** max(0, int(np.floor(np.log2(SHORT / (tiles * size * TEXEL_SHARES)))))
    return np.asarray(np.minimum((codes.astype(np.int64) + step // 2) // step * step, SHORT), dtype=np.uint16)


def coarse(stood: Attributes, tiles: float, size: int) -> Attributes:
    """Attributes of shells with fewer bits that differ: texture coordinates as of `coarse_uv`, all of `_FUR` but the
    weight in steps of `FUR_STEP`.
    """
    rounded = {"TEXCOORD_0": coarse_uv(stood["TEXCOORD_0"], tiles, size)}
    if "_FUR" in stood:
        own = stood["_FUR"].astype(np.int64)
        own[:, 1:] = np.minimum(np.rint(own[:, 1:] / FUR_STEP) * FUR_STEP, 255)
        rounded["_FUR"] = own.astype(np.uint8)
    return stood | rounded


def quantise_weights(weights: Floats, group: Ints) -> Bytes:
    """(M,) weights as bytes that sum to exactly 255 in each group (largest remainders), as the weights sum to 1.

    Where fur is thinner, and they sum to less, so do their bytes.
    """
    exact = 255.0 * np.clip(weights, 0.0, 1.0)
    floor = np.floor(exact + 1e-9)
    _, index = np.unique(group, return_inverse=True)
    whole = np.rint(np.bincount(index, exact))
    missing = np.rint(whole - np.bincount(index, floor)).astype(np.int64)
    order = np.lexsort((np.arange(len(index)), floor - exact, index))
    start = np.searchsorted(index[order], np.arange(len(missing)))
    rank = np.empty(len(index), dtype=np.int64)
    rank[order] = np.arange(len(index)) - start[index[order]]
    return np.asarray(floor + (rank < missing[index]), dtype=np.uint8)


def signed(vectors: Floats) -> NDArray[np.int8]:
    """Components -1..1 as normalised signed bytes."""
    return np.clip(np.rint(127.0 * vectors), -127, 127).astype(np.int8)


def shares(values: Floats) -> Bytes:
    """Values 0..1 as normalised bytes."""
    return np.clip(np.rint(255.0 * values), 0, 255).astype(np.uint8)


def deep_shares(values: Floats) -> Shorts:
    """Values 0..1 as normalised 16-bit numbers, for colours that are all there is to see."""
    return np.clip(np.rint(SHORT * values), 0, SHORT).astype(np.uint16)


def _fur(first: Bytes, fur: VertexFur, source: Ints) -> Attributes:
    """`_FUR`; first : (M,) weights of shells, angles of fins."""
    place = np.column_stack([shares(values) for values in (fur.lengths, fur.occlusion, fur.tip)])
    return omit_default("_FUR", np.column_stack([first, place[source]]), FULL_FUR)


def _colour(fur: VertexFur, source: Ints) -> Attributes:
    return {} if fur.colour is None else {"COLOR_0": shares(fur.colour)[source]}


def _components(vectors: Floats, one: Floats, two: Floats) -> Floats:
    """(n, 2) components of (n, 3) vectors along two unit vectors."""
    return np.column_stack([np.einsum("ij,ij->i", vectors, axis) for axis in (one, two)])


def omit_default(name: str, values: NDArray[Any], missing: Any) -> Attributes:
    """The attribute, left out where all its values are the default."""
    return {name: values} if (values != np.array(missing)).any() else {}
