"""The swatch is what the shader makes of the stored bytes."""

from __future__ import annotations

import json
import math
import re
import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from furbake.asset.gltf import FurModel, write_gltf
from furbake.asset.planes import read_png
from furbake.asset.read import AssetError, read_asset
from furbake.asset.stored import body_radius, read_pelt, skin_colour
from furbake.daylight import Scene
from furbake.options import OptionError, preset
from furbake.pelt.hairs.ramp import Ramp
from furbake.pelt.pelt import Pelt
from furbake.pelt.texels.basis import PTM
from furbake.pipeline import bake
from furbake.show.swatch import (
    SKIN,
    above_horizon,
    drift_at,
    from_srgb,
    light_direction,
    picture,
    radiance,
    render,
    resample,
    save,
    sky_harmonics,
)
from furbake.surface.place.vertex_fur import VertexFur
from furbake.surface.shapes import builtin

GOLDEN = Path(__file__).parents[2] / "golden"
UP = np.array([[0.0, 0.0, 1.0]])
NIGHT = (0.0, 0.0, 0.0)
LAMP_ONLY = Scene(lamp=(4 * math.pi,) * 3, sky=NIGHT, ground=NIGHT)


def even_pelt(numbers: list[float], alpha: int = 255, layers: int = 1, size: int = 8, **changes: Any) -> Pelt:
    """A pelt whose texels are all alike: coefficients `numbers`, coverage alpha/255, white hairs."""
    shape = (layers, size, size)
    pelt = Pelt(
        codes=np.broadcast_to(np.array([100] * 6, np.uint8), (*shape, 6)),
        alpha=np.full(shape, alpha, np.uint8),
        tint=np.full(shape, 255, np.uint8),
        colour=None,
        scale=np.array(numbers) / 100,
        bias=np.zeros(6),
        basis=PTM,
        drift=np.zeros((layers, 2)),
        height=0.5,
        ramp=Ramp((0.5, 0.5, 0.5), (1.0, 1.0, 1.0), (1.0, 1.0, 1.0), 1.0),
    )
    return replace(pelt, **changes)


def write(folder: Path, pelt: Pelt) -> Path:
    """The pelt as a folder over a flat square."""
    folder.mkdir()
    surface = builtin("plane")
    assert surface.natural is not None
    fur = VertexFur.even(len(surface.vertices))
    write_gltf(folder, FurModel(surface, surface.natural.charts(1.0), fur, (pelt,), 0.5))
    return folder


def test_a_pixel_worked_out_by_hand() -> None:
    # Light (0.6, 0, 0.8), E = 4π: L·E/(4π) = 0.2·0.36 + 0.5·0.6 + 0.7 = 1.072 of colour mix(0.5, 1, 0.5) = 0.75,
    # covering 102/255 = 0.4 of a skin that is 0.35 as dark as the root's 0.5 under the same light.
    pelt = even_pelt([0.2, 0, 0, 0.5, 0, 0.7], alpha=102)
    image = radiance(pelt, np.array([[0.6, 0.0, 0.8]]), 8, 1, LAMP_ONLY)
    assert image.shape == (1, 8, 8, 3)
    expected = 0.4 * 0.75 * 1.072 + 0.6 * SKIN * 0.5 * 1.072
    np.testing.assert_allclose(image, expected, rtol=1e-12)


def test_sky_is_the_integral_of_its_radiance() -> None:
    # An even sky of radiance 1 lights L = 1 with 2π: no sample of the environment matrix enters this figure.
    pelt = even_pelt([0, 0, 0, 0, 0, 1.0])
    even = Scene(lamp=NIGHT, sky=(math.pi,) * 3, ground=(math.pi,) * 3)
    np.testing.assert_allclose(radiance(pelt, UP, 8, 1, even), 0.996 * 0.75 / 2 + 0.004 * SKIN * 0.5 / 2, rtol=1e-6)
    # Irradiance of a surface facing up or down: constant c and gradient g make π·c ± ⅔·π·g.
    harmonics = sky_harmonics(Scene(sky=(3.0, 0, 0), ground=(1.0, 0, 0)))[:, 0]
    c, g = harmonics[0] * math.sqrt(1 / (4 * math.pi)), harmonics[2] * math.sqrt(3 / (4 * math.pi))
    assert math.pi * c + 2 / 3 * math.pi * g == pytest.approx(3)
    assert math.pi * c - 2 / 3 * math.pi * g == pytest.approx(1)


def test_a_lamp_beside_the_eye_has_its_surge() -> None:
    # 1 + A/(1 + |l − v|²/w²), seen from straight above; |l − v|² is 0.4 for a lamp of height 0.8.
    plain = even_pelt([0, 0, 0, 0, 0, 1.0])
    surging = replace(plain, surge=np.array([-0.25, 0.5, 0.4]))
    lamps = np.array([[0.0, 0.0, 1.0], [0.6, 0.0, 0.8]])
    factor = radiance(surging, lamps, 8, 1, LAMP_ONLY) / radiance(plain, lamps, 8, 1, LAMP_ONLY)
    np.testing.assert_allclose(factor[0], 0.75, rtol=1e-12)
    np.testing.assert_allclose(factor[1], 1 - 0.25 / (1 + 0.4 / 0.16), rtol=1e-12)


def test_a_folders_fur_is_lit_as_on_a_ball_of_the_models_size(tmp_path: Path, make_pelt: Callable[..., Pelt]) -> None:
    # A square of side 1 with hairs of 0.5: a ball of radius 0.5 has β 1.
    folder = write(tmp_path / "out", make_pelt())
    assert body_radius(read_asset(folder)) == pytest.approx(1.0, rel=1e-4)
    document = json.loads((folder / "model.gltf").read_text("utf-8"))
    document["extensions"]["FUR_ptm_shells"]["length"] = 0.05
    (folder / "model.gltf").write_text(json.dumps(document), "utf-8")
    assert body_radius(read_asset(folder)) == pytest.approx(10.0, rel=1e-4)


def test_lamp_and_sky_are_clamped_apart() -> None:
    # Under this lamp the polynomial is negative; the sky's light stays whole.
    pelt = even_pelt([0, 0, 0, -5.0, 0, 1.0])
    both = Scene(lamp=(4 * math.pi,) * 3, sky=(math.pi,) * 3, ground=(math.pi,) * 3)
    sky = replace(both, lamp=NIGHT)
    side = np.array([[0.8, 0.0, 0.6]])
    np.testing.assert_array_equal(radiance(pelt, side, 8, 1, both), radiance(pelt, side, 8, 1, sky))
    assert radiance(pelt, side, 8, 1, sky).min() > 0


@pytest.mark.parametrize("name", ["ptm-6", "eigen-6", "eigen-3"])
def test_golden_light_above_and_below_the_horizon(name: str) -> None:
    pelt = read_pelt(read_asset(GOLDEN / name))
    lights = np.array(json.loads((GOLDEN / name / "lights.json").read_text("utf-8")))
    expected = np.fromfile(GOLDEN / name / "light.f32", "<f4").reshape(len(lights), *pelt.codes.shape[:3])
    top = Pelt(**{**vars(pelt), "codes": pelt.codes[-1:], "alpha": pelt.alpha[-1:], "tint": pelt.tint[-1:]})
    for i in (0, 20, 50, 58, 63):
        direction, fade = above_horizon(lights[i], 3.5 / 4)
        seen = radiance(replace(top, drift=np.zeros((1, 2))), direction[None], 8, 1, LAMP_ONLY)[0, ..., 0]
        behind = SKIN * expected[i, -1]  # the skin, through the 0.4 % that no shell covers
        np.testing.assert_allclose(fade * seen, 0.996 * expected[i, -1] + 0.004 * behind, atol=2e-4)


def test_all_layers_are_there_and_the_nearest_hides_the_rest() -> None:
    pelt = even_pelt([0, 0, 0, 0, 0, 1.0], alpha=51, layers=3)
    image = radiance(pelt, UP, 8, 1, LAMP_ONLY)
    expected = SKIN * 0.5
    for s in (1 / 6, 3 / 6, 5 / 6):
        expected += 0.2 * (0.5 + 0.5 * s - expected)
    np.testing.assert_allclose(image, expected, rtol=1e-12)


def test_more_shells_cover_as_much_as_the_slabs() -> None:
    pelt = even_pelt([0, 0, 0, 0, 0, 1.0], alpha=120, layers=4, ramp=Ramp(*[(1.0, 1.0, 1.0)] * 3, 1.0))
    one, three = (radiance(pelt, UP, 8, shells, LAMP_ONLY) for shells in (1, 3))
    np.testing.assert_allclose(one, three, rtol=1e-12)


def test_the_side_that_faces_the_light_is_bright() -> None:
    # Texels left of the middle face −u, right of it +u; those in the first rows face +v.
    codes = np.full((1, 8, 8, 6), 100, np.uint8)
    codes[..., 3] = np.where(np.arange(8) < 4, 50, 150)
    codes[..., 4] = np.where(np.arange(8) < 4, 150, 50)[:, None]
    pelt = even_pelt([0, 0, 0, 1, 1, 1], codes=codes, bias=np.array([0, 0, 0, 100, 100, 0.0]))

    def half(light: tuple[float, float, float], side: slice, axis: int) -> float:
        image = picture(pelt, light, tiles=1, size=64, scene=Scene((2.0,) * 3, NIGHT, NIGHT)).astype(float)
        return float(image[side].mean() if axis == 0 else image[:, side].mean())

    left, right = slice(0, 32), slice(32, 64)
    assert half((0.9, 0, 0.4), right, 1) > 1.5 * half((0.9, 0, 0.4), left, 1)
    assert half((-0.9, 0, 0.4), left, 1) > 1.5 * half((-0.9, 0, 0.4), right, 1)
    # v grows upwards in the picture, so its first rows are the picture's lower half.
    assert half((0, 0.9, 0.4), right, 0) > 1.5 * half((0, 0.9, 0.4), left, 0)


@pytest.mark.parametrize(("kind", "count"), [("ptm", 6), ("eigen", 6), ("eigen", 5), ("eigen", 4), ("eigen", 3)])
@pytest.mark.parametrize("colour", [True, False])
def test_every_kind_of_folder(
    tmp_path: Path, make_pelt: Callable[..., Pelt], kind: str, count: int, colour: bool
) -> None:
    pelt = make_pelt(coefficients=count, kind=kind, colour=colour)
    asset = read_asset(write(tmp_path / "out", pelt))
    stored = read_pelt(asset)
    for name in ("codes", "alpha", "colour"):
        np.testing.assert_array_equal(getattr(stored, name), getattr(pelt, name))
    np.testing.assert_array_equal(stored.tint, 255 if count == 3 else pelt.tint)
    assert skin_colour(asset) == (1.0, 1.0, 1.0)
    image = render(tmp_path / "out", tiles=2, size=64)
    assert image.shape == (64, 64, 3)
    assert image.dtype == np.uint8
    assert np.ptp(image) > 20


def test_the_skins_colour_multiplies_the_furs(tmp_path: Path, make_pelt: Callable[..., Pelt]) -> None:
    folder = write(tmp_path / "out", make_pelt())
    document = json.loads((folder / "model.gltf").read_text("utf-8"))
    document["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = [1, 0, 0, 1]
    (folder / "model.gltf").write_text(json.dumps(document), "utf-8")
    image = render(folder, size=32, tiles=1)
    assert image[..., 0].max() > 50
    assert image[..., 1:].mean() < image[..., 0].mean() / 4  # tone mapping alone turns strong red towards white


def test_tiles_repeat_exactly(make_pelt: Callable[..., Pelt]) -> None:
    image = picture(make_pelt(), tiles=2, size=96)
    np.testing.assert_array_equal(image[:48], image[48:])
    np.testing.assert_array_equal(image[:, :48], image[:, 48:])
    # A size that the tiles don't divide is cropped, not squeezed.
    odd = picture(make_pelt(), tiles=3, size=64)
    assert odd.shape == (64, 64, 3)
    np.testing.assert_array_equal(odd[:, :20], odd[:, 22:42])


def test_resampling() -> None:
    texels = np.random.default_rng(0).random((8, 8, 3))
    np.testing.assert_allclose(resample(texels, 8, (0.0, 0.0)), texels, atol=1e-12)
    np.testing.assert_allclose(resample(texels, 8, (2 / 8, -1 / 8)), np.roll(texels, (2, -1), (1, 0)), atol=1e-12)
    for pixels in (2, 8, 24):
        np.testing.assert_allclose(resample(texels, pixels, (0.1, 0.2)).mean((0, 1)), texels.mean((0, 1)), atol=0.03)
    # Halfway between two texels: their mean; across the tile's edge: the mean of the first and the last.
    doubled = resample(texels[:1].repeat(8, 0), 16, (1 / 32, 0.0))[0]
    np.testing.assert_allclose(doubled[0], texels[0, [0, 7]].mean(0), atol=1e-12)
    np.testing.assert_allclose(doubled[2], texels[0, [0, 1]].mean(0), atol=1e-12)


def test_drift_runs_from_the_root_through_the_slabs_middles() -> None:
    drift = np.array([[0.1, 0.0], [0.3, -0.2]])
    at = drift_at(np.array([0.0, 0.125, 0.25, 0.5, 0.75, 1.0]), drift)
    np.testing.assert_allclose(at[:, 0], [0, 0.05, 0.1, 0.2, 0.3, 0.4])
    np.testing.assert_allclose(at[:, 1], [0, 0, 0, -0.1, -0.2, -0.3])


def test_a_light_needs_a_direction_and_no_length() -> None:
    np.testing.assert_allclose(light_direction((0, 3, 4)), [0, 0.6, 0.8])
    for light in ((0, 0, 0), (math.nan, 0, 1), (math.inf, 0, 1), (1, 2)):
        with pytest.raises(OptionError, match=r"light: got .*, expected three numbers x,y,z"):
            light_direction(light)


def test_arguments_out_of_range(make_pelt: Callable[..., Pelt]) -> None:
    for name, value in (("tiles", 0), ("tiles", 17), ("size", 8), ("size", 5000), ("shells_per_slab", 0)):
        with pytest.raises(OptionError, match=f"{name}: got {value}, expected "):
            picture(make_pelt(), **{name: value})


def test_folders_that_are_no_bake(tmp_path: Path, make_pelt: Callable[..., Pelt]) -> None:
    with pytest.raises(AssetError, match="no such folder, expected a folder that furbake wrote"):
        render(tmp_path / "nowhere")
    good = write(tmp_path / "good", make_pelt())

    def broken(name: str, change: Callable[[Path], object], message: str) -> None:
        folder = tmp_path / name
        shutil.copytree(good, folder)
        change(folder)
        with pytest.raises(AssetError, match=message):
            render(folder)

    def edit(pattern: str, replacement: str) -> Callable[[Path], object]:
        def change(folder: Path) -> None:
            text = (folder / "model.gltf").read_text("utf-8")
            changed = re.sub(pattern, replacement, text)
            assert changed != text
            (folder / "model.gltf").write_text(changed, "utf-8")

        return change

    broken(
        "a",
        lambda folder: (folder / "plane1.png").unlink(),
        "plane1.png: no such file or directory, expected a picture",
    )
    broken("b", lambda folder: shutil.copy(folder / "colour.png", folder / "plane0.png"), "malformed pelt")
    broken("c", edit(r'"layers": 4', '"layers": 5'), "a plane is 8 x 32, expected 8 x 40")
    broken("d", edit(r'"kind": "ptm"', '"kind": "wavelet"'), "basis 'wavelet', expected ptm or eigen")
    broken("e", edit(r'"scale": \[[^]]*\]', '"scale": [1]'), "malformed pelt")
    broken("f", edit("FUR_ptm_shells", "FUR_other"), "no FUR_ptm_shells")


def test_saved_png_is_the_picture(tmp_path: Path, make_pelt: Callable[..., Pelt]) -> None:
    folder = write(tmp_path / "out", make_pelt())
    save(folder, tmp_path / "swatch.png", (0.3, 0.1, 0.9), tiles=2, size=48)
    np.testing.assert_array_equal(read_png(tmp_path / "swatch.png"), render(folder, (0.3, 0.1, 0.9), tiles=2, size=48))


def test_fur_is_dark_in_its_depths_and_follows_the_light(tmp_path: Path) -> None:
    options = replace(preset("paper"), layers=8, size=32, lights=16)
    bake("plane", tmp_path / "out", options)
    for light in ((0.7, 0.0, 0.7), (0.0, -0.7, 0.7)):
        image = render(tmp_path / "out", light, tiles=1, size=128).astype(float)
        assert image.std() > 10, "strands are readable"
    high, low = (render(tmp_path / "out", light, size=96).mean() for light in ((0, 0.2, 1.0), (0, 1.0, 0.15)))
    assert high > low


def test_srgb_decodes_as_the_standard_says() -> None:
    np.testing.assert_allclose(from_srgb(np.array([0, 10, 188, 255], np.uint8)), [0, 0.003035, 0.502887, 1], atol=1e-6)
