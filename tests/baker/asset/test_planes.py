"""Images hold every byte as it is, in the channels that the format fixes."""

from __future__ import annotations

import struct
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from furbake.asset.planes import PlaneError, Planes, pack, read_png, unpack, write_png
from furbake.pelt.pelt import Pelt


@pytest.mark.parametrize("coefficients", [3, 4, 5, 6])
def test_round_trip(make_pelt: Callable[..., Pelt], coefficients: int) -> None:
    pelt = make_pelt(layers=3, coefficients=coefficients, kind="eigen", direction=True)
    texels = unpack(pack(pelt), coefficients)
    np.testing.assert_array_equal(texels.codes, pelt.codes)
    np.testing.assert_array_equal(texels.alpha, pelt.alpha)
    np.testing.assert_array_equal(texels.tint, 255 if coefficients == 3 else pelt.tint)
    np.testing.assert_array_equal(texels.colour, pelt.colour)
    np.testing.assert_array_equal(texels.direction, pelt.direction)


def test_six_coefficients(make_pelt: Callable[..., Pelt]) -> None:
    pelt = make_pelt(layers=4, size=8)
    first, second = pack(pelt).coefficients
    assert first.shape == second.shape == (32, 8, 4)
    # Layer 2, row 3, column 5 stands in image row 2·8 + 3.
    a = pelt.codes[2, 3, 5]
    assert first[19, 5].tolist() == [a[0], a[1], a[2], a[5]]
    assert second[19, 5].tolist() == [a[3], a[4], pelt.alpha[2, 3, 5], pelt.tint[2, 3, 5]]


def test_fewer_coefficients(make_pelt: Callable[..., Pelt]) -> None:
    three = make_pelt(coefficients=3)
    (plane,) = pack(three).coefficients
    assert plane[9, 2].tolist() == [*three.codes[1, 1, 2], three.alpha[1, 1, 2]]
    four = make_pelt(coefficients=4)
    first, second = pack(four).coefficients
    assert (first[..., 3] == 0).all()
    assert (second[..., 1] == 0).all()
    np.testing.assert_array_equal(second[9, 2, 0], four.codes[1, 1, 2, 3])


def test_no_colour_and_no_direction(make_pelt: Callable[..., Pelt]) -> None:
    planes = pack(make_pelt(colour=False))
    assert (planes.colour, planes.direction) == (None, None)
    assert unpack(planes, 6).direction is None


@pytest.mark.parametrize("coefficients", [2, 7])
def test_wrong_count(make_pelt: Callable[..., Pelt], coefficients: int) -> None:
    with pytest.raises(ValueError, match=f"got {coefficients}, expected 3 to 6"):
        pack(make_pelt(coefficients=coefficients))


def test_unpack_checks_the_shapes() -> None:
    with pytest.raises(ValueError, match="planes: got"):
        unpack(Planes((np.zeros((9, 8, 4), np.uint8),), None), 3)


@given(st.integers(0, 2**32 - 1), st.sampled_from([3, 4]))
def test_png_keeps_every_byte(tmp_path_factory: pytest.TempPathFactory, seed: int, channels: int) -> None:
    chance = np.random.default_rng(seed)
    pixels = chance.integers(0, 256, (chance.integers(1, 40), chance.integers(1, 40), channels), dtype=np.uint8)
    if channels == 4:
        pixels[..., 3] *= chance.random(pixels.shape[:2]) < 0.5  # empty texels hold coefficients too
    path = tmp_path_factory.mktemp("png") / "x.png"
    write_png(path, pixels, srgb=channels == 3)
    np.testing.assert_array_equal(read_png(path), pixels)


def chunks(data: bytes) -> dict[bytes, bytes]:
    found, at = {}, 8
    while at < len(data):
        (length,) = struct.unpack(">I", data[at : at + 4])
        found[data[at + 4 : at + 8]] = data[at + 8 : at + 8 + length]
        at += 12 + length
    return found


def test_png_says_nothing_of_time_tool_or_colour(tmp_path: Path) -> None:
    pixels = np.random.default_rng(0).integers(0, 256, (16, 8, 4), dtype=np.uint8)
    write_png(tmp_path / "a.png", pixels)
    write_png(tmp_path / "b.png", pixels)
    data = (tmp_path / "a.png").read_bytes()
    assert data == (tmp_path / "b.png").read_bytes()
    # A browser would apply sRGB, gAMA, cHRM or iCCP to coefficients.
    assert not {b"tIME", b"tEXt", b"iTXt", b"zTXt", b"sRGB", b"gAMA", b"cHRM", b"iCCP"} & set(chunks(data))
    write_png(tmp_path / "c.png", pixels[..., :3].copy(), srgb=True)
    found = chunks((tmp_path / "c.png").read_bytes())
    assert b"sRGB" in found
    assert not {b"tIME", b"tEXt", b"iTXt", b"zTXt"} & set(found)


def test_bad_files(tmp_path: Path) -> None:
    with pytest.raises(PlaneError, match=r"nope\.png"):
        read_png(tmp_path / "nope.png")
    (tmp_path / "text.png").write_text("no image")
    with pytest.raises(PlaneError, match=r"text\.png: cannot be read as a picture, expected PNG, JPEG or the like$"):
        read_png(tmp_path / "text.png")
    with pytest.raises(PlaneError, match=r"a\.png: no such file or directory, expected a new picture$"):
        write_png(tmp_path / "no" / "a.png", np.zeros((4, 4, 4), np.uint8))
    with pytest.raises(PlaneError, match=r"a\.xyz: no kind of picture by its name, expected one that ends in \.png$"):
        write_png(tmp_path / "a.xyz", np.zeros((4, 4, 4), np.uint8))
    assert [path.name for path in tmp_path.iterdir()] == ["text.png"]


def test_pixels_of_a_plane_are_bounded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write_png(tmp_path / "a.png", np.zeros((4, 5, 4), dtype=np.uint8))
    monkeypatch.setenv("FURBAKE_LIMITS", "pixels=19")
    with pytest.raises(PlaneError, match=r"a\.png: 5 x 4 pixels, expected at most 19$"):
        read_png(tmp_path / "a.png")
