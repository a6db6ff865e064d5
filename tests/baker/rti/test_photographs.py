"""Lists of photographs as people have them, and fits of what they show."""

from __future__ import annotations

import io
import os
import shutil
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from furbake.rti import fit
from furbake.rti.fit import beside, fit_photographs, held_out, smoothness
from furbake.rti.lp import parse_lp
from furbake.rti.photographs import read_photographs
from furbake.rti.ptm import write_ptm
from furbake.rti.relit import RtiError
from helpers.museum import H, W, known, lamps, photographed, picture_under, ptm_under


def test_windows_paths_spaces_comments_quotes_and_wrong_counts(tmp_path: Path) -> None:
    lights = lamps(8)
    path = photographed(tmp_path, lights)
    lines = path.read_text().splitlines()[1:]
    lines[0] = "C:\\RTI\\my set\\" + lines[0]
    lines[1] = lines[1].replace("photo 01.png", '".\\PHOTO 01.PNG"')
    lines[2] = lines[2].replace(" ", "\t").replace("photo\t", "photo ")
    lines[3] = "/home/me/" + lines[3]
    x, y, z = (float(word) for word in lines[4].split()[-3:])
    lines[4] = f"photo 04.png {3 * x} {3 * y} {3 * z}".replace(".", ",").replace(",png", ".png")
    text = "\ufeff# lamps of May\r\n\r\n9\r\n" + "\r\n; more\r\n".join(lines) + "\r\n\r\n"
    path.write_text(text, "utf-8")
    found = read_photographs(path)
    assert [place.name for place in found.paths] == [f"photo {i:02}.png" for i in range(8)]
    assert np.abs(found.lights - lights).max() < 1e-5
    assert (found.width, found.height) == (W, H)
    assert found.notices == (f"{path}: says 9 photographs and lists 8: all are taken",)


def test_missing_broken_and_other_photographs_are_left_out(tmp_path: Path) -> None:
    lights = lamps(12)
    path = photographed(tmp_path, lights)
    for i in (1, 2, 3, 4):
        (tmp_path / f"photo {i:02}.png").unlink()
    (tmp_path / "photo 05.png").write_bytes(b"\x89PNG")
    Image.new("RGB", (W + 1, H)).save(tmp_path / "photo 06.png")
    found = read_photographs(path)
    assert np.abs(found.lights - lights[[0, 7, 8, 9, 10, 11]]).max() < 1e-5
    assert found.notices == (
        f"{path}: not found beside it: photo 01.png, photo 02.png, photo 03.png and 1 more: left out",
        f"{path}: cannot be read: photo 05.png: left out",
        f"{path}: not of {W} x {H} pixels: photo 06.png: left out",
    )
    (tmp_path / "photo 07.png").unlink()
    with pytest.raises(RtiError, match=r"5 photographs of one size \(not found beside it: .* expected 6 or more$"):
        read_photographs(path)


def test_photographs_outside_the_folder_are_not_read(tmp_path: Path) -> None:
    inside = tmp_path / "inside"
    inside.mkdir()
    path = photographed(inside, lamps(8))
    shutil.move(inside / "photo 00.png", tmp_path)
    path.write_text(path.read_text().replace("photo 00", "../photo 00"))
    assert read_photographs(path).notices == (f"{path}: not found beside it: ../photo 00.png: left out",)


@pytest.mark.parametrize("inside", [True, False])
def test_photographs_are_found_where_rtibuilder_keeps_them(tmp_path: Path, inside: bool) -> None:
    lists = tmp_path / "assembly-files"
    lists.mkdir()
    path = photographed(lists, lamps(8))
    exports = (lists if inside else tmp_path) / "jpeg-exports"
    exports.mkdir()
    for photograph in lists.glob("*.png"):
        shutil.move(photograph, exports)
    path.write_text(path.read_text().replace("photo ", "C:\\\\rti\\\\jpeg-exports\\\\PHOTO "))
    found = read_photographs(path)
    assert found.notices == ()
    assert [photograph.parent for photograph in found.paths] == [exports] * 8


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "no line, expected the number of photographs"),
        ("# only words\n", "no line, expected the number"),
        ("a.jpg 0 0 1\n", "line 1 is 'a.jpg 0 0 1', expected the number of photographs"),
        ("12\n", "0 photographs, expected 1 to 10000"),
        ("1\n0 0 1\n", "line 2 is '0 0 1', expected NAME X Y Z, with the photograph's name"),
        ("1\n\n a.jpg 0 1\n", "line 3 is 'a.jpg 0 1', expected NAME X Y Z"),
        ("1\na.jpg 0 0 up\n", "line 2 is 'a.jpg 0 0 up', expected NAME X Y Z"),
        ("1\na.jpg 0 0 0\n", "line 2 is 'a.jpg 0 0 0', expected NAME X Y Z, with a direction to the lamp"),
        ("1\na.jpg 0 nan 0\n", "line 2 is 'a.jpg 0 nan 0', expected NAME X Y Z, with a direction to the lamp"),
        ("1\n" + "a.jpg 0 0 1\n" * 10001, "10001 photographs, expected 1 to 10000"),
        ("x" * 500, f"line 1 is {('x' * 57 + '...')!r}, expected the number of photographs"),
    ],
)
def test_a_bad_list_is_refused_in_a_sentence(text: str, message: str) -> None:
    with pytest.raises(RtiError) as caught:
        parse_lp(text, "a.lp")
    assert str(caught.value).startswith(f"a.lp: {message}")
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("band", [fit.BAND, 2 * W])
@pytest.mark.parametrize("kind", ["lrgb", "rgb"])
def test_a_known_polynomial_is_found_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, kind: str, band: int
) -> None:
    monkeypatch.setattr(fit, "BAND", band)
    photographs = read_photographs(photographed(tmp_path, lamps(24)))
    file = io.BytesIO()
    write_ptm(file, fit_photographs(photographs, kind))
    for light in lamps(9, 0.3):
        wanted = picture_under(light, *known()) * 255
        assert np.abs(ptm_under(file.getvalue(), light) - wanted).max() < (3 if kind == "lrgb" else 4)


def test_brightness_is_that_of_ptmfitter(tmp_path: Path) -> None:
    """Every pixel's polynomial is 255 at its brightest photograph: the colour has the rest."""
    lights = lamps(24)
    photographs = read_photographs(photographed(tmp_path, lights))
    found = fit_photographs(photographs)
    values = found.scale * (found.codes - found.bias)
    under = np.stack([values @ terms for terms in fit.PTM(lights)])
    assert np.abs(under.max(0) - 255).max() < 4
    each = np.stack(list(photographs)).astype(float)
    brightest = np.take_along_axis(each, (each @ fit.LUMINANCE).argmax(0)[None, ..., None], 0)[0]
    assert found.colour is not None
    assert np.abs(found.colour - brightest).max() <= 2


def test_lamps_that_are_left_out_judge_the_fits(tmp_path: Path) -> None:
    photographs = read_photographs(photographed(tmp_path, lamps(30)))
    found = {figure.name: figure for figure in held_out(photographs)}
    assert list(found) == ["ptm rgb", "ptm lrgb", "eigen 3", "eigen 4", "eigen 5", "eigen 6"]
    assert [figure.numbers for figure in found.values()] == [18, 9, 9, 12, 15, 18]
    # A polynomial is told exactly by others of its lamps, but for the rounding of the photographs: 58.9 dB.
    assert 52 < found["ptm rgb"].psnr < 59
    assert found["ptm lrgb"].psnr > 52
    assert found["eigen 3"].psnr < found["eigen 4"].psnr < found["eigen 5"].psnr < found["eigen 6"].psnr
    for figure in beside(photographs, {"own": fit_photographs(photographs, "rgb")}):
        assert figure.name == "own (ptm rgb)"
        assert not figure.left_out
        assert 45 < figure.psnr < 60


def test_noise_cannot_be_told_from_other_lamps(tmp_path: Path) -> None:
    """A left-out lamp is really left out: of pure noise a fit that had seen it would know a part."""
    path = photographed(tmp_path, lamps(8))
    chance = np.random.default_rng(1)
    for i in range(8):
        pixels = chance.integers(64, 192, (H, W, 3), dtype=np.uint8)
        Image.fromarray(pixels).save(tmp_path / f"photo {i:02}.png")
    spread = 128 / np.sqrt(12) / 255
    for figure in held_out(read_photographs(path)):
        assert 10 ** (-figure.psnr / 20) > spread


@pytest.mark.parametrize(("lights", "degree"), [(6, 2), (12, 2), (30, 3), (48, 4), (60, 5), (80, 6), (500, 6)])
def test_few_lamps_bear_few_functions(lights: int, degree: int) -> None:
    assert smoothness(lights) == degree


def test_names_of_windows_are_found(tmp_path: Path) -> None:
    """Bytes of Latin-1 on the disk, as an old archive leaves them, and a list in UTF-16."""
    photographed(tmp_path, lamps(9))
    for path in tmp_path.glob("photo*"):
        path.rename(tmp_path / os.fsdecode(path.name.replace("photo", "münze").encode("latin-1")))
    text = (tmp_path / "set.lp").read_text().replace("photo", "münze")
    for coding in ("latin-1", "utf-8", "utf-16"):
        (tmp_path / "set.lp").write_text(text, coding)
        assert len(read_photographs(tmp_path / "set.lp").paths) == 9
