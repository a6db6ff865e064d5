"""Grooms as files: a NumPy archive, or curves in USD."""

from __future__ import annotations

import importlib
from pathlib import Path
from typing import Any

import numpy as np

from furbake.asset.store import atomic_file
from furbake.groom.strands import Groom
from furbake.imported.curves import GroomError
from furbake.usd.stage import INSTALL, installed

ENDINGS = (".npz", ".usdc", ".usda", ".usd")


def write_groom(path: Path, groom: Groom) -> None:
    """Write a groom, whole or not at all. Raises GroomError for another ending, or where usd-core is missing.

    A `.npz` holds what `Groom` does, under the same names: points (S, P, 3) and radius (S, P) in model units, tint
    (S, P), colour (S, P, 3) linear, hair (S,) and face (S,). A `.usdc` (or `.usda`, `.usd`) holds BasisCurves `/fur`,
    a Catmull-Rom spline through the points of each hair, with widths, displayColor and the tint as `primvars:tint`; y
    is up.
    """
    ending = path.suffix.lower()
    if ending not in ENDINGS:
        raise GroomError(f"out: got {path.name}, expected a name that ends in {', '.join(ENDINGS)}")
    if ending == ".npz":
        with atomic_file(path) as file:
            np.savez_compressed(file, **vars(groom))
        return
    _write_usd(path, groom)


def _write_usd(path: Path, groom: Groom) -> None:
    usd, geometry, values = (_module(name) for name in ("Usd", "UsdGeom", "Vt"))
    count, length = groom.radius.shape
    scratch = path.with_name(f".{path.stem}.part{path.suffix}")
    try:
        stage = usd.Stage.CreateNew(str(scratch))
        geometry.SetStageUpAxis(stage, geometry.Tokens.y)
        geometry.SetStageMetersPerUnit(stage, 1.0)  # as glTF's units
        curves = geometry.BasisCurves.Define(stage, "/fur")
        stage.SetDefaultPrim(curves.GetPrim())
        curves.CreateTypeAttr(geometry.Tokens.cubic)
        curves.CreateBasisAttr(geometry.Tokens.catmullRom)
        curves.CreateWrapAttr(geometry.Tokens.pinned)
        curves.CreateCurveVertexCountsAttr(values.IntArray.FromNumpy(np.full(count, length, np.int32)))
        points = groom.points.reshape(-1, 3)
        curves.CreatePointsAttr(values.Vec3fArray.FromNumpy(np.ascontiguousarray(points)))
        box = np.stack([points.min(axis=0), points.max(axis=0)])
        curves.CreateExtentAttr(values.Vec3fArray.FromNumpy(np.ascontiguousarray(box)))
        curves.CreateWidthsAttr(values.FloatArray.FromNumpy(2 * groom.radius.reshape(-1)))
        curves.SetWidthsInterpolation(geometry.Tokens.vertex)
        shades = geometry.PrimvarsAPI(curves.GetPrim())
        colour = curves.CreateDisplayColorPrimvar(geometry.Tokens.vertex)
        colour.Set(values.Vec3fArray.FromNumpy(np.ascontiguousarray(groom.colour.reshape(-1, 3))))
        types = _module("Sdf").ValueTypeNames
        tint = shades.CreatePrimvar("tint", types.FloatArray, geometry.Tokens.vertex)
        tint.Set(values.FloatArray.FromNumpy(groom.tint.reshape(-1)))
        stage.GetRootLayer().Save()
        scratch.replace(path)
    finally:
        scratch.unlink(missing_ok=True)


def _module(name: str) -> Any:
    if (missing := installed()) is not None:
        raise GroomError(f"usd-core: {missing}, expected the optional extra: {INSTALL}")
    return importlib.import_module(f"pxr.{name}")
