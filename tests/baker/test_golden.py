"""The golden assets of both wings, read from their files: what the baker stores must give the light they promise."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from furbake.asset.planes import Planes, read_png, unpack
from furbake.asset.read import read_asset
from furbake.asset.roots.read import read_roots
from furbake.asset.stored import read_pelt
from furbake.asset.validate import validate
from furbake.pelt.fin import polynomial, row_means
from furbake.pelt.pelt import Pelt
from furbake.pelt.texels.basis import PTM, Basis
from furbake.pelt.texels.fit import relight
from furbake.pelt.texels.quantise import dequantise
from furbake.study.bend import law, relit
from furbake.surface.colours import LINEAR, sample_picture
from furbake.surface.material import CLAMP
from helpers.moving import Moving

GOLDEN = Path(__file__).parents[1] / "golden"
STRIPES = 8
"""Stripes of the picture of `roots`, the first one black."""

CURVED = GOLDEN / "ptm-6-curves"
NAMES = ("ptm-6", "eigen-6", "eigen-3")
SEVERAL = ("regions", "regions-3", "regions-4")


@pytest.mark.parametrize("name", NAMES)
def test_stored_bytes_give_the_expected_light(name: str) -> None:
    folder = GOLDEN / name
    gltf = json.loads((folder / "model.gltf").read_text("utf-8"))
    fur = gltf["extensions"]["FUR_ptm_shells"]
    pelt = fur["pelts"][0]
    images = tuple(read_png(folder / gltf["images"][i]["uri"]) for i in pelt["planes"])
    codes = unpack(Planes(images, None), fur["coefficients"]).codes
    basis = Basis("ptm") if fur["basis"]["kind"] == "ptm" else Basis("eigen", 4, np.array(fur["basis"]["matrix"]))
    lights = np.array(json.loads((folder / "lights.json").read_text("utf-8")))
    expected = np.fromfile(folder / "light.f32", "<f4").reshape(len(lights), *codes.shape[:3])

    above = lights[:, 2] >= 0
    light = relight(dequantise(codes, np.array(pelt["scale"]), np.array(pelt["bias"])), basis, lights[above])
    assert above.sum() == 48
    np.testing.assert_allclose(light, expected[above], atol=1e-4)
    assert expected.max() > 1


@pytest.mark.parametrize("name", [*NAMES, "ptm-6-curves", "states", "character", *SEVERAL, "roots"])
def test_golden_assets_are_valid_but_for_the_record_of_a_bake(name: str) -> None:
    problems = validate(GOLDEN / name)
    assert [problem for problem in problems if not problem.startswith("bake.json")] == []


def test_stored_bytes_of_the_fin_give_the_expected_light() -> None:
    folder = GOLDEN / "ptm-6"
    fin = read_pelt(read_asset(folder)).fin
    assert fin is not None
    t, w, n = np.array(json.loads((folder / "lights.json").read_text("utf-8"))).T
    expected = np.fromfile(folder / "fin.f32", "<f4").reshape(len(t), *fin.alpha.shape)
    lights = np.stack([t, n, w], axis=1)[n >= 0]
    light = relight(fin.values, PTM, lights)
    np.testing.assert_allclose(light, expected[n >= 0], atol=1e-4)
    assert expected.max() > 1
    assert (fin.alpha[:, 0] == np.arange(255, 0, -32)).all()


def test_stored_bytes_give_the_expected_light_of_bent_fur() -> None:
    folder = GOLDEN / "ptm-6"
    pelt = read_pelt(read_asset(folder))
    given = json.loads((folder / "bent.json").read_text("utf-8"))
    expected = np.fromfile(folder / "bent.f32", "<f4").reshape(-1, pelt.size, pelt.size)
    lean = pelt.drift[-1] / pelt.height
    for tip, light in zip(given["bends"], expected, strict=True):
        found = relit(pelt, np.array([given["light"]]), np.array(tip), lean, law)
        np.testing.assert_allclose(found[0, -1], light, atol=1e-4)


@pytest.fixture(scope="module")
def curved() -> Pelt:
    """The golden pelt of version 2.0."""
    return read_pelt(read_asset(CURVED))


def test_stored_bytes_give_the_expected_light_on_bodies(curved: Pelt) -> None:
    given = json.loads((CURVED / "lights.json").read_text("utf-8"))
    lights = np.array(given["lights"])
    expected = np.fromfile(CURVED / "light.f32", "<f4").reshape(-1, len(lights), *curved.codes.shape[:3])
    coefficients = curved.values
    for beta, light in zip(given["bodies"], expected, strict=True):
        found = relight(coefficients, curved.basis, lights, curved.mean(lights, beta))
        np.testing.assert_allclose(found, light, atol=1e-4)
    assert expected.max() > 1
    assert (expected[0] != expected[1]).any()


def test_stored_bytes_of_the_fin_give_the_expected_light_on_bodies(curved: Pelt) -> None:
    assert curved.fin is not None
    given = json.loads((CURVED / "lights.json").read_text("utf-8"))
    t, w, n = np.array(given["lights"]).T
    lights = np.stack([w, t, n], axis=1)  # in the tile's frame
    expected = np.fromfile(CURVED / "fin.f32", "<f4").reshape(-1, len(lights), *curved.fin.alpha.shape)
    coefficients = curved.fin.values
    for beta, light in zip(given["bodies"], expected, strict=True):
        mean = row_means(curved, len(curved.fin.alpha), lights, beta)
        np.testing.assert_allclose(relight(coefficients, polynomial, lights, mean), light, atol=1e-4)


def test_stored_bytes_give_the_expected_light_of_bent_fur_on_bodies(curved: Pelt) -> None:
    given = json.loads((CURVED / "bent.json").read_text("utf-8"))
    shape = len(given["lights"]), len(given["bends"]), curved.size, curved.size
    lights, lean = np.array(given["lights"]), curved.drift[-1] / curved.height
    for beta, expected in zip((1, 4, 7, 16), np.fromfile(CURVED / "bent.f32", "<f4").reshape(-1, *shape), strict=True):
        for i, tip in enumerate(given["bends"]):
            found = relit(curved, lights, np.array(tip), lean, law, beta)
            np.testing.assert_allclose(found[:, -1], expected[:, i], atol=1e-4)


def test_curves_give_the_expected_moments_of_an_environment(curved: Pelt) -> None:
    assert curved.curves is not None
    given = json.loads((CURVED / "environment.json").read_text("utf-8"))
    for beta, expected in zip(given["bodies"], given["shells"], strict=True):
        np.testing.assert_allclose(curved.curves.environment(PTM, beta), expected, atol=2e-4)


def test_the_golden_character_is_posed_as_expected() -> None:
    """The file's own numbers give the stored poses: skin, shells and fins of a vertex stay together in all of them."""
    folder = GOLDEN / "character"
    found = Moving(folder / "model.gltf")
    poses = json.loads((folder / "poses.json").read_text("utf-8"))
    expected = np.fromfile(folder / "posed.f32", "<f4").reshape(len(poses), -1)
    rest = [found.posed(node, pose={0: {"weights": (0, 0)}}, skin=0)["POSITION"] for node in range(3)]
    for pose, row in zip(poses, expected, strict=True):
        moved = found.clip(pose["clip"], pose["seconds"])
        parts = [found.posed(node, pose=moved, skin=0) for node in range(3)]
        right = np.concatenate([values.ravel() for part in parts for values in part.values()])
        np.testing.assert_allclose(row, right, atol=1e-5)
        for still, part in zip(rest[1:], parts[1:], strict=True):
            nearest = np.linalg.norm(still[:, None] - rest[0][None], axis=2).argmin(axis=1)
            np.testing.assert_allclose(part["POSITION"], parts[0]["POSITION"][nearest], atol=1e-6)
    assert np.abs(expected[2] - expected[0]).max() > 0.3


def test_hairs_have_the_colours_of_the_stripes_on_which_they_stand() -> None:
    """Also those of fins, by places of their own."""
    asset = read_asset(GOLDEN / "roots")
    stored = read_roots(asset)
    assert stored is not None
    for name, unit in (("shells", asset.fur["tiles"] * stored.scale), ("fins", np.ones(2))):
        primitive = asset.primitive(asset.fur[name])
        values = {key: asset.accessor(index) for key, index in primitive["attributes"].items()}
        faces = asset.accessor(primitive["indices"]).reshape(-1, 3)
        uv = values["TEXCOORD_0" if name == "shells" else "TEXCOORD_1"][faces].mean(axis=1) / 65535 * unit
        across = (values["POSITION"][faces, 0].mean(axis=1) - values["POSITION"][:, 0].min()) / 65535 * STRIPES
        inside = np.abs(across - np.rint(across)) > 0.2
        assert inside.mean() > 0.3
        pixels = sample_picture(stored.pixels, uv[inside], (CLAMP, CLAMP), LINEAR)
        white = np.floor(across[inside]) % 2
        assert 0.3 < white.mean() < 0.7
        np.testing.assert_allclose(pixels, np.repeat(white[:, None], 3, axis=1), atol=0.05)
