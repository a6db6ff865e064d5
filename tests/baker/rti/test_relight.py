"""Folders of relight: their own viewer's arithmetic, written down once more, is the oracle."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from furbake.rti import relit
from furbake.rti.relight import read_relight, write_relight
from furbake.rti.relit import RtiError
from helpers.museum import H, W, lamps, relight_under

SCALE, BIAS = np.array([0.4, 0.6, 0.25, 0.5, 0.3, 1.1]), np.array([120.0, 97, 130, 128, 110, 0])


def made(kind: str) -> relit.Relit:
    chance = np.random.default_rng(2)
    rows, columns = np.mgrid[:H, :W]
    smooth = 128 + 60 * np.sin(rows[..., None] / 4 + columns[..., None] / 6 + np.arange(18))
    codes = np.rint(smooth).astype(np.uint8)
    if kind == "rgb":
        return relit.rgb(codes, SCALE, BIAS)
    return relit.lrgb(codes[..., :6], SCALE, BIAS, chance.integers(0, 256, (H, W, 3), dtype=np.uint8))


@pytest.mark.parametrize("kind", ["lrgb", "rgb"])
def test_what_is_written_is_what_relight_s_viewer_shows(tmp_path: Path, kind: str) -> None:
    own = made(kind)
    assert write_relight(tmp_path, own, "png") == [
        "info.json",
        *(f"plane_{i}.png" for i in range(3 if kind == "lrgb" else 6)),
    ]
    again = read_relight(tmp_path)
    for light in lamps(6):
        shown = relight_under(tmp_path, light)
        assert np.abs(own.lit(light) * 255 - shown).max() < 2e-3
        assert np.abs(again.lit(light) * 255 - shown).max() < 2e-3


def test_jpeg_planes_lose_little(tmp_path: Path) -> None:
    own = made("rgb")
    write_relight(tmp_path, own)
    light = lamps(5)[2]
    assert np.abs(own.lit(light) * 255 - relight_under(tmp_path, light)).mean() < 4


def store(folder: Path, info: dict[str, Any], planes: np.ndarray) -> None:
    (folder / "info.json").write_text(json.dumps(info))
    for i in range(planes.shape[-1] // 3):
        Image.fromarray(planes[..., 3 * i : 3 * i + 3]).save(folder / f"plane_{i}.png")


def hemispherical(light: np.ndarray) -> list[float]:
    """As OpenLIME's HSH has it, term by term."""
    theta = min(np.arccos(light[2]), np.pi / 2 - 0.15)
    phi, t = np.arctan2(light[1], light[0]), np.cos(theta)
    root = np.sqrt(t - t * t)
    return [
        1 / np.sqrt(2 * np.pi),
        np.sqrt(6 / np.pi) * np.cos(phi) * root,
        np.sqrt(3 / (2 * np.pi)) * (-1 + 2 * t),
        np.sqrt(6 / np.pi) * root * np.sin(phi),
    ]


def test_hemispherical_harmonics(tmp_path: Path) -> None:
    chance = np.random.default_rng(4)
    planes = chance.integers(0, 256, (H, W, 12), dtype=np.uint8)
    scale, bias = chance.uniform(0.3, 1, 12), chance.uniform(0, 0.5, 12)
    material = {"scale": scale.tolist(), "bias": bias.tolist()}
    info = {"type": "hsh", "colorspace": "rgb", "nplanes": 12, "format": "png", "materials": [material]}
    store(tmp_path, info, planes)
    found = read_relight(tmp_path / "info.json")
    assert found.kind == "hsh rgb"
    value = (planes / 255 - bias) * scale
    for light in lamps(6, 0.02):
        wanted = sum(term * value[..., 3 * i : 3 * i + 3] for i, term in enumerate(hemispherical(light)))
        assert np.abs(found.lit(light) - np.clip(wanted, 0, 1)).max() < 1e-4


@pytest.mark.parametrize("space", ["mrgb", "mycc"])
@pytest.mark.parametrize("kind", ["rbf", "bilinear"])
def test_bases_that_the_file_brings(tmp_path: Path, kind: str, space: str) -> None:
    chance = np.random.default_rng(6)
    lights, count, resolution = lamps(16), 9, 4
    planes = chance.integers(0, 256, (H, W, count), dtype=np.uint8)
    basis = chance.integers(0, 256, (count + 1, 16, 3))
    scale, bias, spread = chance.uniform(0.3, 1, count), chance.uniform(0, 0.5, count), chance.uniform(100, 300, count)
    material = {"scale": scale.tolist(), "bias": bias.tolist(), "range": spread.tolist()}
    info = {"type": kind, "colorspace": space, "nplanes": count, "format": "png", "materials": [material]}
    info |= {"sigma": 0.3, "lights": lights.reshape(-1).tolist(), "resolution": resolution}
    info |= {"basis": basis.reshape(-1).tolist(), "yccplanes": [5, 2, 2]}
    store(tmp_path, info, planes)
    found = read_relight(tmp_path)
    value = (planes / 255 - bias) * scale
    for light in lamps(5, 0.3):
        share = np.zeros(16)
        if kind == "rbf":
            share = np.exp(-((lights - light) ** 2).sum(1) / 0.09)
            share[share / share.sum() <= 1e-3] = 0
            share /= share.sum()
        else:
            size = np.abs(light).sum()
            x, y = ((light[0] + light[1]) / size + 1) / 2 * 3, ((light[1] - light[0]) / size + 1) / 2 * 3
            left, top = min(int(x), 2), min(int(y), 2)
            for i, j in ((0, 0), (0, 1), (1, 0), (1, 1)):
                share[left + i + (top + j) * 4] = (x - left if i else 1 - x + left) * (y - top if j else 1 - y + top)
        mixed = np.einsum("m,pmk->pk", share, basis.astype(float))
        weights = (mixed[1:] - 127) / spread[:, None]
        shown = np.tile(mixed[0] / 255, (H, W, 1))
        for p in range(count):
            if space == "mrgb":
                shown += value[..., p : p + 1] * weights[p]
            else:
                channel = p % 3 if p // 3 < 2 else 0
                shown[..., channel] += value[..., p] * weights[p, channel]
        if space == "mycc":
            y, red, green = np.moveaxis(shown, -1, 0)
            shown = np.stack([y - green / 2 + red / 2, y + green / 2, y - green / 2 - red / 2], -1)
        assert np.abs(found.lit(light) - np.clip(shown, 0, 1)).max() < 1e-4


def bad(**changes: Any) -> dict[str, Any]:
    material = {"scale": [1.0] * 9, "bias": [0.0] * 9}
    return {"type": "ptm", "colorspace": "lrgb", "nplanes": 9, "format": "png", "materials": [material]} | changes


@pytest.mark.parametrize(
    ("info", "message"),
    [
        ([], "malformed (list indices"),
        ({}, "no type, expected relight's info.json"),
        (bad(type="neural"), "got neural with lrgb and 9 planes, expected ptm, hsh, sh with lrgb or rgb"),
        (bad(nplanes=10**9), "got 1000000000 planes, expected 3 to 99"),
        (bad(nplanes=True), "got True planes"),
        (bad(nplanes=21), "scale of 9 numbers, expected 21"),
        (bad(materials=[]), "malformed (list index out of range), expected relight's info.json"),
        (
            bad(materials=[{"scale": [float("nan")] * 9, "bias": [0] * 9}]),
            "scale with a number that is not below 1e+09, expected",
        ),
        (bad(type="rbf", colorspace="mrgb"), "no lights, expected relight's info.json"),
    ],
)
def test_a_bad_info_is_refused_in_a_sentence(tmp_path: Path, info: Any, message: str) -> None:
    store(tmp_path, info, np.zeros((4, 4, 9), np.uint8))
    with pytest.raises(RtiError) as caught:
        read_relight(tmp_path)
    assert str(caught.value).startswith(f"{tmp_path / 'info.json'}: {message}")


def test_planes_that_are_missing_or_of_another_size_are_told(tmp_path: Path) -> None:
    store(tmp_path, bad(), np.zeros((4, 4, 9), np.uint8))
    Image.new("RGB", (5, 4)).save(tmp_path / "plane_2.png")
    with pytest.raises(RtiError, match=r"plane_2\.png: 5 x 4 pixels, expected 4 x 4 as plane_0 has$"):
        read_relight(tmp_path)
    (tmp_path / "plane_1.png").unlink()
    with pytest.raises(RtiError, match=r"plane_1\.png: no such file or directory, expected a file to read$"):
        read_relight(tmp_path)
    (tmp_path / "info.json").write_text("{")
    with pytest.raises(RtiError, match=r"info\.json: not JSON .*, expected relight's info\.json$"):
        read_relight(tmp_path)
