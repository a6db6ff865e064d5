from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from furbake import BakeOptions, bake, validate
from furbake.asset.planes import Planes, read_png, unpack
from furbake.asset.read import read_asset
from furbake.asset.stored import read_pelt
from furbake.bake import STAGES
from furbake.pelt.basis import Basis
from furbake.pelt.fill import SOLID
from furbake.pelt.fit import Judge, relight
from furbake.pelt.quantise import dequantise, from_signed_bytes

SMALL = replace(BakeOptions(), layers=6, size=32, lights=32)


def test_stages_come_in_order_each_to_its_end(tmp_path: Path) -> None:
    seen: list[tuple[str, float]] = []
    result = bake("plane", tmp_path / "out", SMALL, progress=lambda stage, done: seen.append((stage, done)))
    assert [stage for stage, done in seen if done == 0] == list(STAGES)
    assert [stage for stage, done in seen if done == 1][::-1][0] == "write"
    assert set(result.seconds) == set(STAGES)
    assert result.folder == tmp_path / "out"


@pytest.mark.parametrize(("basis", "coefficients"), [("ptm", 6), ("eigen", 6), ("eigen", 4), ("eigen", 3)])
def test_stored_planes_give_back_the_samples_as_well_as_the_record_says(
    tmp_path: Path, basis: str, coefficients: int
) -> None:
    options = replace(SMALL, basis=basis, coefficients=coefficients)
    record = bake("plane", tmp_path / "out", options, samples=tmp_path / "s.npz").record
    samples = np.load(tmp_path / "s.npz")
    gltf = json.loads((tmp_path / "out" / "model.gltf").read_text("utf-8"))
    fur = gltf["extensions"]["FUR_ptm_shells"]
    pelt = fur["pelts"][0]
    images = tuple(read_png(tmp_path / "out" / gltf["images"][i]["uri"]) for i in pelt["planes"])
    texels = unpack(Planes(images, None), coefficients)

    matrix = np.array(fur["basis"]["matrix"]) if basis == "eigen" else None
    stored = dequantise(texels.codes, np.array(pelt["scale"]), np.array(pelt["bias"]))
    held_out = samples["held_out"]
    light = relight(
        stored, Basis(fur["basis"]["kind"], fur["basis"].get("degree"), matrix), samples["lights"][held_out]
    )
    alpha = -np.expm1(-samples["sigma"] * samples["height"] / options.layers)
    figures = Judge(samples["L"][held_out], alpha, samples["tint"]).figures(light)

    assert np.abs(texels.alpha / 255 - alpha).max() <= 0.5 / 255 + 1e-9
    assert figures["psnr"] == pytest.approx(record["fit"]["psnr_quantised"], abs=0.01)
    assert record["fit"]["psnr_quantisation"] >= 48
    assert record["fit"]["psnr"] < record["fit"]["bound"]["psnr"]
    assert record["fit"]["psnr"] > 15


def test_six_eigen_curves_beat_the_polynomial(tmp_path: Path) -> None:
    figures = [
        bake("plane", tmp_path / basis, replace(SMALL, lights=64, basis=basis)).record["fit"]
        for basis in ("ptm", "eigen")
    ]
    assert figures[1]["psnr"] > figures[0]["psnr"] + 0.5
    assert figures[1]["psnr_composite"] > figures[0]["psnr_composite"] + 0.5


def test_samples_hold_the_strands_and_lights_of_the_bake(tmp_path: Path) -> None:
    bake("plane", tmp_path / "out", SMALL, samples=tmp_path / "s.npz")
    samples = np.load(tmp_path / "s.npz")
    hairs = SMALL.coat.guard.count + SMALL.coat.under.count
    assert samples["strands"].shape[0] == samples["radius"].shape[0] == hairs
    assert samples["strands"][..., 2].max() == pytest.approx(float(samples["height"]))
    assert samples["L"].shape == (len(samples["lights"]), 6, 32, 32)
    assert samples["L"].dtype == np.float32
    assert (~samples["held_out"]).sum() == 32
    assert samples["tangent"].shape == (6, 32, 32, 3)
    np.testing.assert_allclose(np.linalg.norm(samples["tangent"], axis=-1), 1)


@pytest.mark.parametrize(("basis", "coefficients", "colour"), [("ptm", 6, True), ("eigen", 3, False)])
def test_directions_are_a_plane_more_and_nothing_else(
    tmp_path: Path, basis: str, coefficients: int, colour: bool
) -> None:
    options = replace(SMALL, basis=basis, coefficients=coefficients, colour_plane=colour)
    plain = bake("plane", tmp_path / "plain", options)
    out = tmp_path / "out"
    told = bake("plane", out, replace(options, directions=True), samples=tmp_path / "s.npz")
    assert validate(out) == []
    assert {path.name for path in out.iterdir()} - {path.name for path in plain.folder.iterdir()} == {"direction.png"}
    for path in plain.folder.iterdir():
        if path.suffix in (".png", ".bin"):
            assert (out / path.name).read_bytes() == path.read_bytes()
    assert told.record["key"] != plain.record["key"]

    codes = read_pelt(read_asset(out)).direction
    assert codes is not None
    stored, samples = from_signed_bytes(codes), np.load(tmp_path / "s.npz")
    covered = -np.expm1(-samples["sigma"] * samples["height"] / options.layers) >= SOLID
    assert covered.mean() > 0.05
    assert np.abs(stored - samples["tangent"])[covered].max() <= 0.5 / 127.5 + 1e-12
    assert np.abs(np.linalg.norm(stored, axis=-1) - 1).max() <= np.sqrt(3) * 0.5 / 127.5
    assert stored[..., 2].min() > -0.01  # from root to tip


def test_fins_can_be_left_out_and_creases_have_none(tmp_path: Path, write_obj: Any, cube: Any) -> None:
    options = replace(SMALL, size=8)
    with_fins = bake("plane", tmp_path / "plane", options)
    assert with_fins.record["fit"]["fin"]["psnr"] > 12
    assert with_fins.record["asset"]["fins"]["faces"] > 0
    plain = bake("plane", tmp_path / "plain", replace(options, fins=False))
    corners, _ = cube
    tetrahedron = write_obj(corners[[0, 3, 5, 6]], np.array([(0, 1, 2), (0, 2, 3), (0, 3, 1), (1, 3, 2)]))
    creased = bake(str(tetrahedron), tmp_path / "creased", options)
    for result in (plain, creased):
        assert "fin" not in result.record["fit"]
        assert "fins" not in result.record["asset"]
        assert not list(result.folder.glob("fin*"))
        assert validate(result.folder) == []
