from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from PIL import Image

from furbake import BakeOptions, bake, validate
from furbake.asset.extension import STATE
from furbake.asset.inspect import summary
from furbake.asset.planes import Planes, read_png, unpack
from furbake.asset.read import read_asset
from furbake.asset.stored import read_pelt
from furbake.groom.strands import groom
from furbake.options import OptionError, preset
from furbake.pelt.hairs.states import WETNESS
from furbake.pelt.hairs.states import chosen as states_of
from furbake.pelt.light.transport import hemisphere
from furbake.pelt.texels.basis import Basis
from furbake.pelt.texels.fill import SOLID
from furbake.pelt.texels.fit import Judge, relight
from furbake.pelt.texels.quantise import dequantise, from_signed_bytes
from furbake.pipeline import STAGES

SMALL = replace(BakeOptions(), layers=6, size=32, lights=32)

SMALLER = replace(SMALL, size=16, lights=16)
"""Where the files are tested and not how good the fit is: a fifth of the time."""


def test_stages_come_in_order_each_to_its_end(tmp_path: Path) -> None:
    seen: list[tuple[str, float]] = []
    result = bake("plane", tmp_path / "out", SMALLER, progress=lambda stage, done: seen.append((stage, done)))
    assert [stage for stage, done in seen if done == 0] == list(STAGES)
    assert [stage for stage, done in seen if done == 1][::-1][0] == "write"
    assert set(result.seconds) == set(STAGES)
    assert result.folder == tmp_path / "out"


@pytest.mark.parametrize(
    ("basis", "coefficients", "curves"),
    [("ptm", 6, "none"), ("ptm", 6, "slab"), ("eigen", 6, "slab"), ("eigen", 4, "none"), ("eigen", 3, "slab")],
)
def test_stored_planes_give_back_the_samples_as_well_as_the_record_says(
    tmp_path: Path, basis: str, coefficients: int, curves: str
) -> None:
    options = replace(SMALL, basis=basis, coefficients=coefficients, curves=curves)
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
    lights, mean = samples["lights"][held_out], None
    if curves == "slab":  # of bodies of four lengths of the fur, above the horizon
        even, along = (np.array(fur["curves"][name])[:, 1] for name in ("even", "along"))
        x, m = 6 + 10 * np.sqrt(lights[:, 2]), np.array(fur["drift"][-1])
        tables = [[np.interp(x, np.arange(17), row) for row in part] for part in (even, along)]
        mean = np.transpose(tables[0] + tables[1] * (lights[:, :2] @ (m / np.hypot(*m)))) @ np.transpose(
            pelt["weights"]
        )
    light = relight(stored, Basis(fur["basis"]["kind"], fur["basis"].get("degree"), matrix), lights, mean)
    alpha = -np.expm1(-samples["sigma"] * samples["height"] / options.layers)
    figures = Judge(samples["L"][held_out], alpha, samples["tint"]).figures(light)

    assert np.abs(texels.alpha / 255 - alpha).max() <= 0.5 / 255 + 1e-9
    assert figures["psnr"] == pytest.approx(record["fit"]["psnr_quantised"], abs=0.01)
    assert record["fit"]["psnr_quantisation"] >= (50 if curves == "slab" else 46)
    assert curves == "slab" or record["fit"]["psnr"] < record["fit"]["bound"]["psnr"]
    assert record["fit"]["psnr"] > 15


def test_without_curves_assets_are_of_version_1(tmp_path: Path) -> None:
    plainly = replace(SMALLER, meshopt=False)
    folders = [bake("plane", tmp_path / curves, replace(plainly, curves=curves)).folder for curves in ("none", "slab")]
    plain, curved = (read_asset(folder) for folder in folders)
    assert [validate(folder) for folder in folders] == [[], []]
    assert (plain.fur["version"], curved.fur["version"]) == ("1.0", "2.0")
    assert set(plain.fur) - set(curved.fur) == {"environment"}
    assert set(curved.fur) - set(plain.fur) == {"curves", "eye", "finEye", "surge", "short", "spread"}
    assert set(curved.fur["pelts"][0]) - set(plain.fur["pelts"][0]) == {"weights", "multiple"}
    texts = [(folder / "model.gltf").stat().st_size for folder in folders]
    assert texts[1] - texts[0] < 4000
    assert read_pelt(plain).curves is None
    assert [folder.joinpath("plane0.png").exists() for folder in folders] == [True, True]
    assert [BakeOptions.from_record(asset.record["options"]).curves for asset in (plain, curved)] == ["none", "slab"]


def test_six_eigen_curves_beat_the_polynomial(tmp_path: Path) -> None:
    figures = [
        bake("plane", tmp_path / basis, replace(SMALL, lights=64, basis=basis)).record["fit"]
        for basis in ("ptm", "eigen")
    ]
    assert figures[1]["psnr"] > figures[0]["psnr"] + 0.5
    assert figures[1]["psnr_composite"] > figures[0]["psnr_composite"] + 0.5


def test_samples_hold_the_strands_and_lights_of_the_bake(tmp_path: Path) -> None:
    bake("plane", tmp_path / "out", SMALLER, samples=tmp_path / "s.npz")
    samples = np.load(tmp_path / "s.npz")
    hairs = SMALLER.coat.guard.count + SMALLER.coat.under.count
    assert samples["strands"].shape[0] == samples["radius"].shape[0] == hairs
    assert samples["strands"][..., 2].max() == pytest.approx(float(samples["height"]))
    assert samples["L"].shape == (len(samples["lights"]), 6, 16, 16)
    assert samples["L"].dtype == np.float32
    assert (~samples["held_out"]).sum() == 16
    assert samples["tangent"].shape == (6, 16, 16, 3)
    np.testing.assert_allclose(np.linalg.norm(samples["tangent"], axis=-1), 1)


@pytest.mark.parametrize(("basis", "coefficients", "colour"), [("ptm", 6, True), ("eigen", 3, False)])
def test_directions_are_a_plane_more_and_nothing_else(
    tmp_path: Path, basis: str, coefficients: int, colour: bool
) -> None:
    options = replace(SMALLER, basis=basis, coefficients=coefficients, colour_plane=colour)
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


def test_fins_can_be_left_out(tmp_path: Path) -> None:
    options = replace(SMALL, size=8)
    with_fins = bake("plane", tmp_path / "plane", options)
    assert with_fins.record["fit"]["fin"]["psnr"] > 12
    assert with_fins.record["asset"]["fins"]["faces"] > 0
    plain = bake("plane", tmp_path / "plain", replace(options, fins=False))
    assert "fin" not in plain.record["fit"]
    assert "fins" not in plain.record["asset"]
    assert not list(plain.folder.glob("fin*"))
    assert validate(plain.folder) == []


@pytest.mark.parametrize("own", [False, True])
def test_hairs_of_a_body_with_a_picture_have_its_hue_or_the_preset_s_besides(tmp_path: Path, own: bool) -> None:
    paint = np.array([[[40, 200, 90], [27, 145, 64]]], dtype=np.uint8)  # the second is half as bright
    ball = trimesh.creation.icosphere(subdivisions=2)
    material = trimesh.visual.material.PBRMaterial(baseColorTexture=Image.fromarray(paint))
    ball.visual = trimesh.visual.TextureVisuals(uv=0.5 + 0.4 * ball.vertices[:, :2], material=material)
    ball.export(tmp_path / "ball.glb")
    options = preset("fox", own_colours=own)
    options = replace(options, layers=4, size=16, lights=8, length=0.2)
    baked = bake(str(tmp_path / "ball.glb"), tmp_path / "out", options)
    told = "colours: the picture's times those of fox; --own-colours leaves its hues out"
    assert (told in baked.notices) is not own
    hairs = groom(baked.folder).colour
    tips = hairs[:, -1].reshape(-1, 3)
    tips = tips / tips.sum(axis=1, keepdims=True)
    skin = ((paint[0, 0] / 255 + 0.055) / 1.055) ** 2.4  # sRGB decoded
    off = np.abs(tips - skin / skin.sum()).max(axis=1)
    assert np.quantile(off, 0.9) < 0.01 if own else np.median(off) > 0.05


def test_a_body_of_creases_has_fins_beside_them(tmp_path: Path, write_obj: Any, cube: Any) -> None:
    corners, _ = cube
    tetrahedron = write_obj(corners[[0, 3, 5, 6]], np.array([(0, 1, 2), (0, 2, 3), (0, 3, 1), (1, 3, 2)]))
    creased = bake(str(tetrahedron), tmp_path / "creased", replace(SMALL, size=8))
    assert any(": 4 faces divided into " in notice for notice in creased.notices)
    assert creased.record["asset"]["fins"]["faces"] > 0
    assert validate(creased.folder) == []


@pytest.fixture(scope="module")
def living(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """All states of a small fur."""
    folder = tmp_path_factory.mktemp("living") / "out"
    options = replace(SMALLER, states=tuple(WETNESS), dirt=True)
    bake("plane:1x1", folder, options)
    return folder


def test_states_share_their_numbers_and_differ_in_their_texels(living: Path) -> None:
    assert validate(living) == []
    asset = read_asset(living)
    assert asset.fur["version"] == "2.2"
    pelts = [read_pelt(asset, i) for i in range(6)]
    for pelt, state in zip(pelts, states_of(tuple(WETNESS), True), strict=True):
        assert (pelt.state.name, pelt.state.mud) == (state.name, state.mud)
        for name in STATE:
            assert getattr(pelt.state, name) == pytest.approx(getattr(state, name), rel=1e-6)
    dry = pelts[0]
    for pelt in pelts[1:]:
        np.testing.assert_array_equal(pelt.scale, dry.scale)
        np.testing.assert_array_equal(pelt.bias, dry.bias)
        assert np.array_equal(pelt.weights, dry.weights) == bool(pelt.state.dirt)
        assert (pelt.codes != dry.codes).mean() > 0.3
        assert pelt.height == pytest.approx(dry.height * pelt.state.length)
        assert pelt.fin is not None
        assert dry.fin is not None
        assert pelt.fin.codes.shape == dry.fin.codes.shape
        np.testing.assert_array_equal(pelt.fin.scale, dry.fin.scale)
        assert (pelt.fin.codes != dry.fin.codes).any()
    assert [pelt.colour is None for pelt in pelts] == [False] * 5 + [True]
    seen = [1 - np.prod(1 - pelt.alpha / 255, axis=0) for pelt in pelts]
    cover = [float(image.mean()) for image in seen]
    assert cover[4] < cover[0] - 0.01  # skin between the clumps
    assert cover[5] > cover[0]


def test_record_has_every_state(living: Path) -> None:
    record = read_asset(living).record
    assert [state["name"] for state in record["states"]] == [*WETNESS, "dirty"]
    assert [(state["wetness"], state["dirt"]) for state in record["states"]][-2:] == [(1.0, 0.0), (0.0, 1.0)]
    assert record["states"][0]["fit"] == record["fit"]
    for state in record["states"]:
        assert state["fit"]["psnr"] > 15
        assert state["fit"]["psnr_quantisation"] > 40
        assert state["fit"]["fin"]["r2"] > 0.3
    assert summary(read_asset(living))["states"].keys() == {*WETNESS, "dirty"}
    assert BakeOptions.from_record(record["options"]).states == tuple(WETNESS)


def test_dry_fur_is_the_same_hairs_with_and_without_states(living: Path, tmp_path: Path) -> None:
    alone = bake("plane:1x1", tmp_path / "out", SMALLER).record
    assert "states" not in alone
    assert not {"states", "dirt"} & set(alone["options"])
    one, other = (read_pelt(read_asset(folder)) for folder in (tmp_path / "out", living))
    np.testing.assert_array_equal(one.alpha, other.alpha)
    np.testing.assert_array_equal(one.tint, other.tint)
    assert read_asset(tmp_path / "out").fur["version"] == "2.2"
    assert one.state == other.state
    # The mean curves suit all states, so that the two pelts differ in their numbers; what they say is the same light.
    light = [pelt.light(hemisphere(9, turn=0.5))[:, one.alpha > 25] for pelt in (one, other)]
    assert np.percentile(np.abs(light[0] - light[1]), 99) < 0.05 * np.percentile(light[0], 99)


def test_eigen_states_share_their_curves(tmp_path: Path) -> None:
    options = replace(SMALL, size=8, lights=16, basis="eigen", coefficients=4, states=("dry", "soaked"), fins=False)
    bake("plane:1x1", tmp_path / "out", options)
    asset = read_asset(tmp_path / "out")
    assert [pelt["name"] for pelt in asset.fur["pelts"]] == ["dry", "soaked"]
    np.testing.assert_array_equal(read_pelt(asset, 0).basis.matrix, read_pelt(asset, 1).basis.matrix)


@pytest.mark.parametrize(
    ("changes", "what"),
    [
        ({"states": ("soaked",)}, "states: got soaked, expected dry..wet, or dry and then some of damp"),
        ({"states": ("dry", "dry")}, "states: got dry,dry"),
        ({"states": ("dry", "soaked", "damp")}, "states: got dry,soaked,damp"),
        ({"states": ("dry", "frozen")}, "states: got dry,frozen"),
        ({"states": ()}, "states: got , expected"),
        ({"dirt": True, "basis": "eigen", "coefficients": 3}, "dirt: got 3 coefficients"),
    ],
)
def test_states_that_there_are_not(changes: dict[str, Any], what: str) -> None:
    with pytest.raises(OptionError, match=re.escape(what)):
        replace(SMALL, **changes).check()
