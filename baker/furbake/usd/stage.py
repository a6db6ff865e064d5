"""Meshes and curves of a stage of USD, in a process of its own: its libraries end a process on some broken files."""

from __future__ import annotations

import importlib
import re
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from furbake.apart import Apart, CrashError

Array = NDArray[Any]

ENDINGS = (".usd", ".usda", ".usdc", ".usdz")
"""Ends of the names of stages."""

INSTALL = "pip install 'furbake[groom]'"
"""Command that installs `usd-core`."""


class UsdError(ValueError):
    """A stage that cannot be read; one sentence that begins with its name."""


@dataclass(frozen=True)
class UsdCurves:
    """`UsdGeomBasisCurves` in the stage's axes and units.

    points : (N, 3) control points; counts : (S,) of each curve
    kind, basis, wrap : tokens of USD
    widths, colours : (n,) and (n, 3) values, and how USD interpolates them; None: none
    """

    path: str
    points: Array
    counts: Array
    kind: str
    basis: str
    wrap: str
    widths: tuple[Array, str] | None = None
    colours: tuple[Array, str] | None = None


@dataclass(frozen=True)
class UsdMesh:
    """`UsdGeomMesh` in the stage's axes and units.

    points : (V, 3); counts : (F,) corners of each polygon; corners : (C,) vertices
    uv : (C, 2), v up; None: none; colour : linear; reversed_ : whether faces are wound left-handedly
    """

    path: str
    points: Array
    counts: Array
    corners: Array
    uv: Array | None = None
    colour: tuple[float, float, float] | None = None
    reversed_: bool = False


@dataclass(frozen=True)
class Stage:
    """All of a stage that can be used.

    up : axis, "Y" or "Z"; metres : per unit, None where the file does not say
    others : types of what else has a shape, as often as it occurs
    hidden, hidden_meshes : numbers of curves and meshes that are invisible, guides or proxies and left out, as others
        are none of these
    missing : names of layers that it asks for and that are not there
    """

    up: str
    metres: float | None
    curves: list[UsdCurves] = field(default_factory=list)
    meshes: list[UsdMesh] = field(default_factory=list)
    others: dict[str, int] = field(default_factory=dict)
    hidden: int = 0
    hidden_meshes: int = 0
    missing: tuple[str, ...] = ()

    def placed(self, points: Array) -> Array:
        """(n, 3) points of the stage in metres, where it says how long its unit is, y up."""
        found = np.asarray(points, np.float64) * (self.metres or 1.0)
        return found if self.up == "Y" else found[:, [0, 2, 1]] * np.array([1.0, 1.0, -1.0])


def installed() -> str | None:
    """None where `usd-core` is there, else why not."""
    try:
        importlib.import_module("pxr")
    except ImportError as error:
        return str(error)
    return None


def read_stage(path: Path, kept: Apart | None = None) -> Stage:
    """Meshes and curves of a stage. Raises UsdError where it is broken, or where `usd-core` is missing.

    kept : process that reads, which may read others after it; None: one for this stage alone
    """
    missing = installed()
    if missing is not None:
        raise UsdError(f"{path}: usd-core is missing ({missing}), expected the optional extra: {INSTALL}")
    process = kept or Apart()
    try:
        found: Stage = process.call(stage_of, str(path.absolute()))
    except CrashError as error:
        raise UsdError(f"{path}: cannot be read as USD ({error}), expected a valid file") from None
    except UsdError as error:
        raise UsdError(f"{path}: {error}") from None
    except Exception as error:  # noqa: BLE001 — readers raise anything on a broken file
        first = " ".join(str(error).split()).split("' Error in '")[0]  # of a list, each with its place in the library
        reason = first.rpartition(" : ")[2].strip("' ")[:160] or type(error).__name__
        raise UsdError(f"{path}: cannot be read as USD ({reason}), expected a valid file") from None
    finally:
        if kept is None:
            process.end()
    return found


ROOM, TIMES = 2 << 30, 64
"""Bytes that reading may take, beside this many times the file's: a broken one asks for more than any machine has."""


def stage_of(path: str) -> Stage:
    """The stage of a file, at its first time. To be called in a process of its own, whose memory it bounds."""
    with suppress(ImportError, OSError, ValueError):  # where a system knows no bounds
        resource: Any = importlib.import_module("resource")
        most = resource.getrlimit(resource.RLIMIT_AS)[1]
        resource.setrlimit(resource.RLIMIT_AS, (ROOM + TIMES * Path(path).stat().st_size, most))
    usd, geometry = (importlib.import_module(f"pxr.{name}") for name in ("Usd", "UsdGeom"))
    stage = usd.Stage.Open(path)
    if stage is None:
        raise UsdError("cannot be read as USD, expected a valid file")
    time = usd.TimeCode.EarliestTime()
    places = geometry.XformCache(time)
    metres = geometry.GetStageMetersPerUnit(stage) if geometry.StageHasAuthoredMetersPerUnit(stage) else None
    found = Stage("Z" if geometry.GetStageUpAxis(stage) == geometry.Tokens.z else "Y", metres)
    curves, meshes = list[UsdCurves](), list[UsdMesh]()  # that are not seen
    prims = iter(stage.Traverse(usd.TraverseInstanceProxies()))
    for prim in prims:
        if prim.IsA(geometry.BasisCurves):
            read = _curves(geometry, prim, time, places)
            (found.curves if _seen(geometry, prim, time) else curves).append(read)
        elif prim.IsA(geometry.Mesh):
            body = _mesh(geometry, prim, time, places)
            (found.meshes if _seen(geometry, prim, time) else meshes).append(body)
        elif prim.IsA(geometry.Gprim) or prim.IsA(geometry.PointInstancer):
            kind = str(prim.GetTypeName())
            found.others[kind] = found.others.get(kind, 0) + 1
            # Its prototypes stand nowhere.
            if prim.IsA(geometry.PointInstancer):
                prims.PruneChildren()
    return replace(
        found,
        curves=found.curves or curves,
        meshes=found.meshes or meshes,
        hidden=len(curves) if found.curves else 0,
        hidden_meshes=len(meshes) if found.meshes else 0,
        missing=_missing(stage),
    )


def _seen(geometry: Any, prim: Any, time: Any) -> bool:
    """True for what a picture shows: no guide, no stand-in, nothing invisible."""
    imageable = geometry.Imageable(prim)
    purpose, tokens = imageable.ComputePurpose(), geometry.Tokens
    return purpose not in (tokens.guide, tokens.proxy) and imageable.ComputeVisibility(time) != tokens.invisible


def _missing(stage: Any) -> tuple[str, ...]:
    """Names of layers that the stage asks for and that cannot be opened."""
    errors = stage.GetCompositionErrors() if hasattr(stage, "GetCompositionErrors") else []
    return tuple(dict.fromkeys(name for error in errors for name in re.findall("@([^@]+)@", str(error))[:1]))


def _curves(geometry: Any, prim: Any, time: Any, places: Any) -> UsdCurves:
    curves = geometry.BasisCurves(prim)
    matrix = np.array(places.GetLocalToWorldTransform(prim), np.float64)
    points = _points(curves, time, matrix)
    widths = _primvar(geometry, prim, "widths", time)
    if widths is None and curves.GetWidthsAttr().Get(time):
        widths = np.asarray(curves.GetWidthsAttr().Get(time)), str(curves.GetWidthsInterpolation())
    scale = abs(float(np.linalg.det(matrix[:3, :3]))) ** (1 / 3)
    return UsdCurves(
        path=str(prim.GetPath()),
        points=points,
        counts=_array(curves.GetCurveVertexCountsAttr().Get(time), np.int64, 1),
        kind=str(curves.GetTypeAttr().Get(time) or "cubic"),
        basis=str(curves.GetBasisAttr().Get(time) or "bezier"),
        wrap=str(curves.GetWrapAttr().Get(time) or "nonperiodic"),
        widths=None if widths is None else (_array(widths[0], np.float32, 1) * scale, widths[1]),
        colours=_primvar(geometry, prim, "displayColor", time),
    )


def _mesh(geometry: Any, prim: Any, time: Any, places: Any) -> UsdMesh:
    mesh = geometry.Mesh(prim)
    matrix = np.array(places.GetLocalToWorldTransform(prim), np.float64)
    points = _points(mesh, time, matrix)
    corners = _array(mesh.GetFaceVertexIndicesAttr().Get(time), np.int64, 1)
    colours = _primvar(geometry, prim, "displayColor", time)
    red, green, blue = (1.0, 1.0, 1.0) if colours is None else map(float, colours[0].mean(axis=0))
    return UsdMesh(
        path=str(prim.GetPath()),
        points=points,
        counts=_array(mesh.GetFaceVertexCountsAttr().Get(time), np.int64, 1),
        corners=corners,
        uv=_corner_uv(_primvar(geometry, prim, "st", time) or _primvar(geometry, prim, "UVMap", time), corners),
        colour=None if colours is None else (red, green, blue),
        reversed_=(str(mesh.GetOrientationAttr().Get(time)) == "leftHanded") != (np.linalg.det(matrix[:3, :3]) < 0),
    )


def _corner_uv(found: tuple[Array, str] | None, corners: Array) -> Array | None:
    """Texture coordinates of the corners, where the mesh has some of a kind that fits."""
    if found is None or found[0].ndim != 2 or found[0].shape[1] != 2:
        return None
    values, kind = found
    if kind == "faceVarying":
        return values if len(values) == len(corners) else None
    inside = len(corners) > 0 and kind in ("vertex", "varying") and corners.min() >= 0 and corners.max() < len(values)
    return values[corners] if inside else None


def _points(shape: Any, time: Any, matrix: Array) -> Array:
    points = _array(shape.GetPointsAttr().Get(time), np.float64, 3)
    return points @ matrix[:3, :3] + matrix[3, :3]


def _primvar(geometry: Any, prim: Any, name: str, time: Any) -> tuple[Array, str] | None:
    """Values of a primvar, one for each place, and how USD interpolates them."""
    primvar = geometry.PrimvarsAPI(prim).FindPrimvarWithInheritance(name)
    values = primvar.ComputeFlattened(time) if primvar and primvar.HasValue() else None
    if values is None or not len(values):
        return None
    return np.asarray(values, np.float32), str(primvar.GetInterpolation())


def _array(values: Any, kind: Any, width: int) -> Array:
    """A list of USD as an array, (n,) or (n, width); empty where there is none."""
    found = np.zeros((0, width), kind) if values is None else np.asarray(values, kind)
    return found.reshape(-1, width) if width > 1 else found.reshape(-1)
