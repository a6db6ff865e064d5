"""Eyes, noses, buttons: ordinary meshes beside the fur, placed by a small JSON file, and the fur around them cleared.

{"features": [{"name": "eye left", "shape": "ellipsoid", "centre": [0.5, 1.2, 0.6], "radii": [0.06, 0.07, 0.05],
               "forward": [1, 0, 0.4], "on": true, "sink": 0.3, "colour": [0.02, 0.01, 0.01], "roughness": 0.1}]}
"""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from furbake.surface.files import read_records
from furbake.surface.mesh import RGB, Floats, Ints, MeshError, Surface
from furbake.surface.repair.topology import unit

Triple = tuple[float, float, float]

KEYS = ("name", "shape", "centre", "radii", "forward", "on", "sink", "clear", "colour", "roughness", "joint")
"""Keys of a feature in the file."""

SHAPES = ("ellipsoid", "half")
"""A whole ellipsoid, or the half of it that looks forward."""

UP: Triple = (0.0, 1.0, 0.0)

CLEAR = 2.5
"""Radii from a feature's centre at which fur has its full length again."""

SUBDIVISIONS = 2
"""Subdivisions of a feature's icosahedron: 20·4² = 320 triangles."""

MAX_FEATURES = 100
"""Features of one file."""


@dataclass(frozen=True)
class Feature:
    """An opaque ellipsoid, or the front half of one.

    centre : model units
    radii : model units, to its right, up and forward; right and up as seen with the y axis upright
    forward : where it looks, of any length; None: along +z, or along the surface's normal where it stands on it
    on : whether `centre` is only near the surface: it is moved to the nearest point of it, and `sink` times the third
        radius below
    clear : radii from the centre at which fur around has its full length again, at least 1
    colour : linear
    joint : name of the joint that it hangs on; None: the one that moves the surface most where it stands
    half : only the half that looks forward, such as a lid
    """

    name: str
    centre: Triple
    radii: Triple
    forward: Triple | None = None
    on: bool = False
    sink: float = 0.0
    clear: float = CLEAR
    colour: RGB = (0.02, 0.015, 0.01)
    roughness: float = 0.1
    joint: str | None = None
    half: bool = False

    @property
    def axes(self) -> Floats:
        """(3, 3) rows right, up and forward."""
        forward = unit(np.array([self.forward or (0.0, 0.0, 1.0)]))[0]
        upright = np.cross(UP, forward)
        right = unit(upright[None])[0] if np.linalg.norm(upright) > 1e-6 else np.array([1.0, 0.0, 0.0])
        return np.stack([right, np.cross(forward, right), forward])

    @property
    def turn(self) -> Floats:
        """(4,) unit quaternion x, y, z, w that turns +x, +y and +z to right, up and forward."""
        return np.asarray(Rotation.from_matrix(self.axes.T).as_quat(canonical=True))


def read_features(path: Path) -> tuple[Feature, ...]:
    """The features in a JSON file. Raises MeshError with one sentence that begins with its name."""
    records = read_records(path, "features", 'expected {"features": [...]}')["features"]
    if len(records) > MAX_FEATURES:
        raise MeshError(f"{path}: {len(records)} features, expected at most {MAX_FEATURES}")
    features = tuple(_feature(record, f"{path}: features[{i}]") for i, record in enumerate(records))
    _refuse_doubles(features, path)
    return features


def _refuse_doubles(features: tuple[Feature, ...], path: Path) -> None:
    """Refuse features that fill the same place: the renderer could not tell which is in front."""
    first: dict[Feature, int] = {}
    for i, feature in enumerate(features):
        shape = replace(feature, name="", colour=Feature.colour, roughness=Feature.roughness, clear=CLEAR)
        before = first.setdefault(shape, i)
        if before != i:
            raise MeshError(f"{path}: features[{i}] fills the place of features[{before}], expected another place")


def placed(surface: Surface, features: tuple[Feature, ...]) -> tuple[Feature, ...]:
    """The features where they are in the model: those that stand on the surface have been put there."""
    return tuple(_stood(surface, feature) if feature.on else feature for feature in features)


def clearing(surface: Surface, features: tuple[Feature, ...]) -> Floats:
    """(V,) 0..1 share of its length that fur keeps around the features: none where they are, all `clear` radii away."""
    share = np.ones(len(surface.vertices))
    for feature in placed(surface, features):
        # Depth is left out: the surface curves away from the feature.
        radii = np.array([*feature.radii[:2], max(feature.radii)])
        far = np.linalg.norm((surface.vertices - feature.centre) @ feature.axes.T / radii, axis=1)
        step = np.clip((far - 1.0) / max(feature.clear - 1.0, 1e-9), 0.0, 1.0)
        share *= step * step * (3.0 - 2.0 * step)
    return share


def ball(half: bool = False) -> tuple[Floats, Ints]:
    """Vertices (V, 3) and faces (F, 3) of a ball of radius 1, which every feature is a stretched copy of.

    half : only what has z >= 0, open behind
    """
    import trimesh  # noqa: PLC0415 — 0.1 s, for this alone

    shape = trimesh.creation.icosphere(subdivisions=SUBDIVISIONS)
    vertices, faces = unit(np.asarray(shape.vertices, dtype=np.float64)), np.asarray(shape.faces, dtype=np.int64)
    if not half:
        return vertices, faces
    # Seen along one of the icosahedron's corners, edges lie on the equator.
    turn, _ = Rotation.align_vectors([[0.0, 0.0, 1.0]], vertices[:1])
    vertices = turn.apply(vertices)
    used, index = np.unique(faces[vertices[faces, 2].mean(axis=1) > 0.0], return_inverse=True)
    return vertices[used], index.reshape(-1, 3)


def nearest(surface: Surface, place: Floats) -> tuple[Floats, Floats]:
    """The point (3,) of the surface that is nearest to a place, and the unit normal (3,) there."""
    corners = surface.vertices[surface.faces]
    shares = _on_triangles(corners, place)
    points = np.einsum("fk,fki->fi", shares, corners)
    best = int(np.argmin(np.linalg.norm(points - place, axis=1)))
    normal = shares[best] @ surface.normals[surface.faces[best]]
    return points[best], unit(normal[None])[0]


def _on_triangles(corners: Floats, place: Floats) -> Floats:
    """(F, 3) barycentric coordinates of the point of each triangle that is nearest to the place."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    found, least = np.zeros((len(corners), 3)), np.full(len(corners), np.inf)
    for i in range(3):
        start, end = corners[:, i], corners[:, (i + 1) % 3]
        way = end - start
        along = np.einsum("fi,fi->f", place - start, way) / np.maximum(np.einsum("fi,fi->f", way, way), 1e-300)
        along = np.clip(along, 0.0, 1.0)
        far = np.linalg.norm(start + along[:, None] * way - place, axis=1)
        better = far < least
        least = np.where(better, far, least)
        edge = np.zeros((len(corners), 3))
        edge[:, i], edge[:, (i + 1) % 3] = 1.0 - along, along
        found = np.where(better[:, None], edge, found)
    normal = np.cross(b - a, c - a)
    area = np.maximum(np.einsum("fi,fi->f", normal, normal), 1e-300)
    inner = np.stack(
        [np.einsum("fi,fi->f", normal, np.cross(q - p, place - p)) / area for p, q in ((b, c), (c, a), (a, b))], axis=1
    )
    inside = (inner >= 0.0).all(axis=1) & (inner.sum(axis=1) > 0.5)
    return np.where(inside[:, None], inner, found)


def _stood(surface: Surface, feature: Feature) -> Feature:
    point, normal = nearest(surface, np.array(feature.centre))
    x, y, z = (float(value) for value in point - feature.sink * feature.radii[2] * normal)
    forward = feature.forward or (float(normal[0]), float(normal[1]), float(normal[2]))
    return replace(feature, centre=(x, y, z), forward=forward, on=False)


def _feature(record: Any, where: str) -> Feature:
    if not isinstance(record, dict):
        raise MeshError(f"{where} is {_shown(record)}, expected an object")
    strange = [key for key in record if key not in KEYS]
    if strange:
        raise MeshError(f"{where}.{strange[0]} is unknown, expected only {', '.join(KEYS)}")
    missing = [key for key in ("centre", "radii") if key not in record]
    if missing:
        raise MeshError(f"{where} has no {missing[0]}, expected three numbers")
    shape = record.get("shape", SHAPES[0])
    if shape not in SHAPES:
        raise MeshError(f"{where}.shape is {_shown(shape)}, expected one of {', '.join(SHAPES)}")
    name, on, joint = record.get("name", "feature"), record.get("on", False), record.get("joint")
    if not isinstance(name, str) or not name:
        raise MeshError(f"{where}.name is {_shown(name)}, expected text")
    if not isinstance(on, bool):
        raise MeshError(f"{where}.on is {_shown(on)}, expected true or false")
    if joint is not None and not isinstance(joint, str):
        raise MeshError(f"{where}.joint is {_shown(joint)}, expected the name of a joint")
    radii = _triple(record["radii"], f"{where}.radii", "three numbers above 0")
    if min(radii) <= 0.0:
        raise MeshError(f"{where}.radii is {_shown(record['radii'])}, expected three numbers above 0")
    colour = _triple(record.get("colour", Feature.colour), f"{where}.colour", "three numbers from 0 to 1")
    if min(colour) < 0.0 or max(colour) > 1.0:
        raise MeshError(f"{where}.colour is {_shown(record['colour'])}, expected three numbers from 0 to 1")
    forward = None
    if "forward" in record:
        forward = _triple(record["forward"], f"{where}.forward", "a direction of three numbers")
        if not any(forward):
            raise MeshError(f"{where}.forward is {_shown(record['forward'])}, expected a direction of three numbers")
    return Feature(
        name=name,
        centre=_triple(record["centre"], f"{where}.centre", "three numbers"),
        radii=radii,
        forward=forward,
        on=on,
        sink=_number(record.get("sink", 0.0), f"{where}.sink", -1.0, 1.0),
        clear=_number(record.get("clear", CLEAR), f"{where}.clear", 1.0, 100.0),
        colour=colour,
        roughness=_number(record.get("roughness", Feature.roughness), f"{where}.roughness", 0.0, 1.0),
        joint=joint,
        half=shape == "half",
    )


def _triple(values: Any, where: str, expected: str) -> Triple:
    if not (isinstance(values, list | tuple) and len(values) == 3 and all(_is_number(value) for value in values)):
        raise MeshError(f"{where} is {_shown(values)}, expected {expected}")
    x, y, z = (float(value) for value in values)
    return x, y, z


def _number(value: Any, where: str, low: float, high: float) -> float:
    if not _is_number(value) or not low <= value <= high:
        raise MeshError(f"{where} is {_shown(value)}, expected a number from {low:g} to {high:g}")
    return float(value)


def _is_number(value: Any) -> bool:
    """True for a number that a 32-bit float holds."""
    return isinstance(value, int | float) and not isinstance(value, bool) and abs(value) < 1e30


def _shown(value: Any) -> str:
    """A value in a message: JSON, but not all of a long one."""
    text = json.dumps(value)
    return text if len(text) <= 40 else f"{text[:37]}..."
