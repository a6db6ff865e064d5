"""Stages as Houdini and Maya write them, by USD's own library; and broken ones, never a traceback."""

from __future__ import annotations

import os
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.interpolate import BSpline

from furbake.apart import Apart
from furbake.imported.curves import GroomError
from furbake.imported.read.reading import of_stage, read_curves
from furbake.surface.mesh import MeshError, load_mesh
from furbake.usd.stage import UsdError, read_stage
from helpers.grooms import strands

pytest.importorskip("pxr", reason="usd-core reads USD")
Gf, Sdf, Usd, UsdGeom, Vt = (import_module(f"pxr.{name}") for name in ("Gf", "Sdf", "Usd", "UsdGeom", "Vt"))

POINTS = strands(20)

INPUTS = 10_000 if os.environ.get("FURBAKE_TEST_ALL") else 300
"""Broken stages in every run."""


def curves(stage: Any, path: str, points: np.ndarray, basis: str = "bspline", wrap: str = "pinned") -> Any:
    """Cubic curves (S, P, 3) on a stage."""
    made = UsdGeom.BasisCurves.Define(stage, path)
    made.CreateTypeAttr("cubic")
    made.CreateBasisAttr(basis)
    made.CreateWrapAttr(wrap)
    made.CreateCurveVertexCountsAttr([points.shape[1]] * len(points))
    made.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(points.reshape(-1, 3).astype(np.float32)))
    return made


def houdini(path: Path, *, instanceable: bool) -> np.ndarray:
    """A SOP's export in centimetres, z up, beside guides; the strands' control points, y up, metres."""
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageUpAxis(stage, "Z")
    UsdGeom.SetStageMetersPerUnit(stage, 0.01)
    x, y, z = np.moveaxis(100 * POINTS, -1, 0)
    world = UsdGeom.Xform.Define(stage, "/world").GetPrim()
    stage.SetDefaultPrim(world)
    root = "/fur" if instanceable else "/world"
    if instanceable:
        stage.CreateClassPrim("/fur")
        world.GetReferences().AddInternalReference("/fur")
        world.SetInstanceable(True)
    made = curves(stage, f"{root}/curves_0", np.stack([x, -z, y], axis=-1))
    count, each = POINTS.shape[:2]
    made.CreateWidthsAttr(np.tile(np.linspace(0.4, 0.0, each), count).tolist())
    made.SetWidthsInterpolation("varying" if instanceable else "vertex")
    api = UsdGeom.PrimvarsAPI(made)
    api.CreatePrimvar("id", Sdf.ValueTypeNames.IntArray, "uniform").Set(Vt.IntArray(range(count)))
    shade = api.CreatePrimvar("displayColor", Sdf.ValueTypeNames.Color3fArray, "uniform")
    shade.Set(Vt.Vec3fArray([(0.5, 0.25, 0.125)] * count))
    guides = curves(stage, f"{root}/guides", np.stack([x, -z, y], axis=-1)[::5])
    guides.CreatePurposeAttr("guide")
    stage.Save()
    return POINTS


def xgen(path: Path) -> np.ndarray:
    """Maya's export of many descriptions, each moved, in centimetres; the control points in metres."""
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageUpAxis(stage, "Y")
    UsdGeom.SetStageMetersPerUnit(stage, 0.01)
    for number, part in enumerate(np.split(POINTS, 5)):
        UsdGeom.Xform.Define(stage, f"/groom/description{number}")
        offset = np.array([3.0 * number, 1.0, -2.0])
        doubled = np.concatenate([part[:, :1], part[:, :1], part, part[:, -1:], part[:, -1:]], axis=1)  # to both ends
        made = curves(stage, f"/groom/description{number}/spline", (100 * doubled - offset) / 2, wrap="nonperiodic")
        made.AddTranslateOp().Set(Gf.Vec3d(*offset.tolist()))
        made.AddScaleOp().Set(Gf.Vec3f(2, 2, 2))
        made.CreateWidthsAttr([0.1])
        made.SetWidthsInterpolation("constant")
    curves(stage, "/groom/empty", np.zeros((0, 4, 3)))
    stage.Save()
    return POINTS


@pytest.mark.parametrize("ending", [".usdc", ".usda"])
@pytest.mark.parametrize("instanceable", [False, True])
def test_an_export_of_houdini_gives_its_strands(tmp_path: Path, ending: str, instanceable: bool) -> None:
    path = tmp_path / f"a{ending}"
    points = houdini(path, instanceable=instanceable)
    found = read_curves(path)
    assert found.count == len(points)
    assert "1 groups of curves are guides" in " ".join(found.notices)
    assert np.allclose(found.points[found.starts], points[:, 0], atol=1e-5)
    assert np.allclose(found.points[found.ends], points[:, -1], atol=1e-5)
    assert found.widths is not None
    assert np.allclose(found.widths[found.starts], 0.004)
    assert np.allclose(found.widths[found.ends], 0, atol=1e-7)
    assert found.colours is not None
    assert np.allclose(found.colours, (0.5, 0.25, 0.125))


def test_an_export_of_maya_gives_its_strands(tmp_path: Path) -> None:
    points = xgen(tmp_path / "a.usdc")
    found = read_curves(tmp_path / "a.usdc")
    assert found.count == len(points)
    assert found.widths is not None
    assert np.allclose(found.widths, 0.002)
    per = int(found.counts[0])
    drawn = found.points.reshape(len(points), per, 3)
    doubled = np.concatenate([points[:, :1]] * 2 + [points] + [points[:, -1:]] * 2, axis=1)
    spline = BSpline(np.arange(doubled.shape[1] + 4), doubled, 3, axis=1)
    t = np.linspace(3, doubled.shape[1], per)
    assert np.allclose(drawn, spline(np.minimum(t, doubled.shape[1] - 1e-9)), atol=1e-5)


def whole(folder: Path) -> list[tuple[str, bytes]]:
    """Sound stages of all kinds, by ending."""
    found = []
    for ending in (".usda", ".usdc"):
        for number, write in enumerate((lambda at: houdini(at, instanceable=True), xgen)):
            path = folder / f"sound{number}{ending}"
            write(path)
            found.append((ending, path.read_bytes()))
    return found


def broken(rng: np.random.Generator, sound: list[tuple[str, bytes]]) -> tuple[str, bytes]:
    """A stage with some bytes or words changed, cut off or repeated."""
    ending, data = sound[rng.integers(len(sound))]
    text = bytearray(data)
    for _ in range(int(rng.integers(1, 8))):
        at = int(rng.integers(len(text)))
        kind = int(rng.integers(6))
        if kind == 0:
            text[at] = int(rng.integers(256))
        elif kind == 1:
            text[at : at + 8] = bytes(rng.integers(0, 256, 8).tolist())
        elif kind == 2:
            text[at : at + 4] = [b"\xff\xff\xff\xff", b"\0\0\0\0", b"nan ", b"1e39", b"-1, "][rng.integers(5)]
        elif kind == 3:
            del text[at : at + int(rng.integers(1, 40))]
        elif kind == 4:
            text[at:at] = text[at : at + int(rng.integers(1, 40))]
        elif rng.random() < 0.1:
            del text[at:]
        text = text or bytearray(b"#")
    return ending, bytes(text)


def refusal(path: Path, process: Apart) -> str | None:
    """Sentence with which a stage is refused, if it is."""
    try:
        of_stage(str(path), read_stage(path, process))
    except (GroomError, UsdError) as error:
        return str(error)
    return None


@pytest.fixture
def reader() -> Iterator[list[Apart]]:
    """A process that reads one stage after the other; a new one stands in for one that ended."""
    each = [Apart()]
    yield each
    each[0].end()


def test_broken_stages_get_one_sentence(tmp_path: Path, reader: list[Apart]) -> None:
    rng = np.random.default_rng(0)
    sound = whole(tmp_path)
    refused = 0
    for number in range(INPUTS):
        ending, data = broken(rng, sound)
        path = tmp_path / f"{number}{ending}"
        path.write_bytes(data)
        if reader[0].process.poll() is not None:
            reader[0].end()
            reader[0] = Apart()
        said = refusal(path, reader[0])
        refused += said is not None
        assert "\n" not in (said or ""), number
        assert said is None or said.startswith(str(path)), number
        path.unlink()
    assert INPUTS / 5 < refused < INPUTS


def test_a_broken_stage_is_no_body_either(tmp_path: Path) -> None:
    sound = whole(tmp_path)
    path = tmp_path / f"a{sound[-1][0]}"
    path.write_bytes(sound[-1][1][:400])
    with pytest.raises(MeshError, match="cannot be read as USD"):
        load_mesh(path)
