"""The shells' mesh of a baked folder, with neighbours of its faces, for strands to stand on."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from furbake.asset.read import Asset, AssetError
from furbake.asset.roots.read import StoredRoots, read_roots

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True)
class Ground:
    """Shells of a fur, M vertices, every face repeated in each patch that covers it.

    vertices : (M, 3) model units
    normals, tangents, bitangents : (M, 3) unit; u grows along the second, v along the third
    uv : (M, 2) tiles
    faces : (F, 3)
    weight : (M,) 0..1, share of each copy where patches overlap
    reach : (M,) length of the fur, model units
    comb : (M, 3) displacement of the tip in the tangent plane, share of the hair's own length
    tip : (M,) 0..1, share of the second tip colour
    colour : (M, 3) linear colour of the skin
    beside : (F, 3) face across the edge opposite each corner, −1 at the end of a patch
    shift : (F, 3, 2) what a place's uv in the neighbour differs by, tiles: 0 but where a patch closes on itself
    roots : colours of the skin at the roots of hairs, in place of `colour`, where the folder has a picture of them
    surface : (F,) number of the face of the body that a face is a copy of
    tile : width of a tile, model units
    """

    vertices: Floats
    normals: Floats
    tangents: Floats
    bitangents: Floats
    uv: Floats
    faces: Ints
    weight: Floats
    reach: Floats
    comb: Floats
    tip: Floats
    colour: Floats
    beside: Ints
    shift: Floats
    surface: Ints
    tile: float
    roots: StoredRoots | None = None


def read_ground(asset: Asset, base: tuple[float, float, float]) -> Ground:
    """The shells' mesh of a baked folder; base : linear colour of the skin where the shells bring none.

    Raises AssetError where the mesh is broken.
    """
    try:
        return _ground(asset, base)
    except AssetError:
        raise
    except (LookupError, TypeError, AttributeError, ValueError) as error:
        detail = f"{type(error).__name__}: {error}"
        raise AssetError(f"{asset.folder}: malformed shells ({detail}), see furbake validate") from error


def read_skin(asset: Asset) -> tuple[Floats, Ints]:
    """Vertices (V, 3), model units, and faces (F, 3) of the opaque body, of copies of a vertex one.

    Raises AssetError where it is broken.
    """
    try:
        node = asset.fur["skin"]
        vertices, faces, count = [], [], 0
        for primitive in asset.primitives(node):
            places = _placed(asset, node, primitive["attributes"]["POSITION"])
            faces.append(np.asarray(asset.accessor(primitive["indices"]), np.int64).reshape(-1, 3) + count)
            vertices.append(places)
            count += len(places)
        places, point = np.unique(np.concatenate(vertices), axis=0, return_inverse=True)
        return places, np.asarray(point.reshape(-1)[np.concatenate(faces)], np.int64)
    except AssetError:
        raise
    except (LookupError, TypeError, AttributeError, ValueError) as error:
        detail = f"{type(error).__name__}: {error}"
        raise AssetError(f"{asset.folder}: malformed skin ({detail}), see furbake validate") from error


def number(asset: Asset, index: int) -> Floats:
    """An accessor as numbers, normalised integers as glTF means them."""
    values = asset.accessor(index)
    if asset.document["accessors"][index].get("normalized"):
        return np.asarray(np.maximum(values / float(np.iinfo(values.dtype).max), -1.0))
    return np.asarray(values, np.float64)


def normalised(vectors: Floats) -> Floats:
    """Vectors of length 1; what has none stays 0."""
    return np.asarray(vectors / np.maximum(np.linalg.norm(vectors, axis=-1, keepdims=True), 1e-12))


def _placed(asset: Asset, node: int, position: int) -> Floats:
    """(n, 3) an accessor of positions where the node puts them."""
    place = asset.document["nodes"][node]
    scale, offset = (
        np.array(place.get(name, [one] * 3), np.float64) for name, one in (("scale", 1), ("translation", 0))
    )
    return np.asarray(_turned(asset, node, number(asset, position) * scale) + offset)


def _turned(asset: Asset, node: int, vectors: Floats) -> Floats:
    turn = asset.document["nodes"][node].get("rotation")
    return vectors if turn is None else np.asarray(Rotation.from_quat(turn).apply(vectors))


def _ground(asset: Asset, base: tuple[float, float, float]) -> Ground:
    fur = asset.fur
    node, primitive = fur["shells"], asset.primitive(fur["shells"])
    index = primitive["attributes"]
    length, tiles = float(fur["length"]), float(fur.get("tiles", 1.0))
    vertices = _placed(asset, node, index["POSITION"])
    count = len(vertices)

    def attribute(name: str, missing: tuple[float, ...]) -> Floats:
        if name not in index:
            return np.tile(np.array(missing), (count, 1))
        return number(asset, index[name])[:, : len(missing)]

    normals = normalised(number(asset, index["NORMAL"])[:, :3])
    tangent = number(asset, index["TANGENT"])
    along = normalised(tangent[:, :3] - normals * np.einsum("ij,ij->i", tangent[:, :3], normals)[:, None])
    across = tangent[:, 3:] * np.cross(normals, along)
    comb, traits = attribute("_COMB", (0.0, 0.0)), attribute("_FUR", (1.0, 1.0, 1.0, 0.0))
    faces = np.asarray(asset.accessor(primitive["indices"]), np.int64).reshape(-1, 3)
    uv = tiles * number(asset, index["TEXCOORD_0"])[:, :2]
    beside, shift = neighbours(asset.accessor(index["POSITION"])[:, :3], uv, faces)
    return Ground(
        vertices=vertices,
        normals=_turned(asset, node, normals),
        tangents=_turned(asset, node, along),
        bitangents=_turned(asset, node, across),
        uv=uv,
        faces=faces,
        weight=traits[:, 0],
        reach=length * traits[:, 1],
        comb=_turned(asset, node, comb[:, :1] * along + comb[:, 1:] * across),
        tip=traits[:, 3],
        colour=attribute("COLOR_0", base),
        beside=beside,
        shift=shift,
        surface=_same(np.sort(_same(asset.accessor(index["POSITION"])[:, :3])[faces], axis=1)),
        tile=length / float(fur["height"]),
        roots=read_roots(asset),
    )


def neighbours(places: NDArray[Any], uv: Floats, faces: Ints) -> tuple[Ints, Floats]:
    """`beside` and `shift` of `Ground`.

    places : (M, 3) positions, equal to the bit in all copies of a vertex

    Two faces lie side by side where the ends of an edge have the same place and, but for whole tiles, the same uv: in
    one patch, or across the seam where it closes on itself.
    """
    within = np.rint((uv - np.floor(uv)) * 4096.0).astype(np.int64) % 4096
    corner = _same(np.column_stack([_same(places), within]))
    ends = np.stack([faces[:, [1, 2, 0]], faces[:, [2, 0, 1]]], axis=-1).reshape(-1, 2)  # the edge opposite i
    one, two = corner[ends].T
    low, high = np.minimum(one, two), np.maximum(one, two)
    order = np.lexsort((high, low))
    same = (np.diff(low[order]) == 0) & (np.diff(high[order]) == 0)
    first = np.flatnonzero(same)
    # More than two faces at an edge: a seam of several sheets, which nothing walks across.
    alone = np.ones(len(first), bool)
    alone[1:] &= np.diff(first) > 1
    alone[:-1] &= np.diff(first) > 1
    a, b = order[first[alone]], order[first[alone] + 1]
    beside, shift = np.full(len(order), -1), np.zeros((len(order), 2))
    beside[a], beside[b] = b // 3, a // 3
    flipped = one[a] != one[b]
    there = uv[np.where(flipped, ends[b, 1], ends[b, 0])] - uv[ends[a, 0]]
    shift[a], shift[b] = there, -there
    return beside.reshape(-1, 3), shift.reshape(-1, 3, 2)


def _same(rows: NDArray[Any]) -> Ints:
    """(n,) a number per row, equal where rows are."""
    return np.asarray(np.unique(rows, axis=0, return_inverse=True)[1].reshape(-1), np.int64)
