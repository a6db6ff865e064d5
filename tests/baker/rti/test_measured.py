"""Photographs become a tile: periodic, as bright as they are, its heights where shadows tell them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from furbake.pelt.light.transport import hemisphere
from furbake.rti.measured import WHITE, heights, measure, periodic
from furbake.rti.relit import RtiError
from helpers.museum import lamps, photographed


def linear(code: np.ndarray) -> np.ndarray:
    value = code / 255
    return np.where(value <= 0.04045, value / 12.92, ((value + 0.055) / 1.055) ** 2.4)


def test_a_tile_goes_round_without_a_seam_and_keeps_its_contrast() -> None:
    chance = np.random.default_rng(1)
    cells = chance.uniform(0.2, 0.8, (40, 53, 3))
    rows, columns = np.mgrid[:400, :530] / 31
    picture = cells[rows.astype(int), columns.astype(int)]
    tile = periodic(picture, 64)
    assert tile.shape == (64, 64, 3)
    steps = [np.abs(np.diff(tile, axis=axis, append=np.take(tile, [0], axis))) for axis in (0, 1)]
    for axis, step in enumerate(steps):
        each = step.mean(axis=(1 - axis, 2))
        assert each[-1] <= 1.1 * each[:-1].max()
    torn = np.abs(picture[:, 65] - picture[:, 464]).mean()
    assert steps[1].mean(axis=(0, 2))[-1] < 0.6 * torn
    assert abs(tile.mean() / picture.mean() - 1) < 0.02
    whole = periodic(picture[:, 60:460], 64)
    quarter = whole[:16].std(), whole[24:56].std()
    assert 0.8 < quarter[0] / quarter[1] < 1.2


def test_photographs_keep_their_light_and_colour(tmp_path: Path) -> None:
    lights = lamps(24, 0.1)
    path = photographed(tmp_path, lights, width=64, height=64)
    found = measure(path, 1, 32)
    assert found.samples.shape == (24, 1, 32, 32)
    assert found.held_out.sum() == 4
    assert (found.alpha == 1).all()
    shown = found.samples[:, 0, ..., None] / WHITE * found.colour
    for i in (0, 9, 17):
        photograph = linear(np.asarray(Image.open(tmp_path / f"photo {i:02}.png"), float))
        assert np.abs(shown[i].mean((0, 1)) / photograph.mean((0, 1)) - 1).max() < 0.03


def rough(size: int = 48) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Hills under lamps that cast shadows: brightness (n, N, N), lights (n, 3), heights (N, N) in texels."""
    chance = np.random.default_rng(2)
    spectrum = np.fft.rfft2(chance.normal(size=(size, size)))
    frequency = np.hypot(np.fft.fftfreq(size)[:, None], np.fft.rfftfreq(size))
    height = np.fft.irfft2(spectrum * np.exp(-((frequency / 0.12) ** 2)), (size, size))
    height = 3 * height / height.std()
    albedo = chance.uniform(0.2, 0.9, (size, size))
    lights = hemisphere(60, lowest=0.1)
    shown = []
    for u, v, z in lights:
        lit = np.ones((size, size))
        for step in range(1, 24):
            moved = np.roll(height, (-round(step * v), -round(step * u)), (0, 1))
            lit *= np.clip(1 - (moved - height - step * z / np.hypot(u, v)), 0, 1) if np.hypot(u, v) > 0.05 else 1
        shown.append(albedo * z * (0.1 + 0.9 * lit))
    return np.stack(shown), lights, height


def ranked(values: np.ndarray) -> np.ndarray:
    return np.argsort(np.argsort(values.ravel())).astype(float)


def test_shadows_tell_heights_whatever_the_colour() -> None:
    brightness, lights, height = rough()
    found, agreement = heights(brightness, lights)
    assert agreement > 0.8
    assert np.corrcoef(ranked(found), ranked(height))[0, 1] > 0.6
    assert np.abs(np.corrcoef(ranked(found), ranked(brightness.max(0)))[0, 1]) < 0.5


def test_flat_cloth_has_no_heights(tmp_path: Path) -> None:
    """Patterns and noise of the camera are no relief."""
    chance = np.random.default_rng(3)
    lights = hemisphere(40, lowest=0.15)
    pattern = chance.uniform(0.1, 0.8, (64, 64, 3))
    lines = ["40"]
    for i, (u, v, z) in enumerate(lights):
        value = np.clip(pattern * z + chance.normal(0, 0.004, (64, 64, 1)), 0, 1)
        code = np.where(value <= 0.0031308, 12.92 * value, 1.055 * value ** (1 / 2.4) - 0.055)
        Image.fromarray(np.rint(code * 255).astype(np.uint8)).save(tmp_path / f"{i}.png")
        lines.append(f"{i}.png {u} {v} {z}")
    (tmp_path / "flat.lp").write_text("\n".join(lines))
    found = measure(tmp_path / "flat.lp", 4, 32)
    assert (found.alpha == 1).all()
    assert found.notices[-1].startswith("heights: halves of the lamps agree by ")
    assert found.notices[-1].endswith("less than 0.5: all texels are as high")


def test_steps_cover_less_and_less_upwards(tmp_path: Path) -> None:
    brightness, lights, _ = rough()
    lines = [str(len(lights))]
    for i, (image, (u, v, z)) in enumerate(zip(brightness, lights, strict=True)):
        grey = np.rint(255 * np.sqrt(np.clip(image, 0, 1))).astype(np.uint8)
        Image.fromarray(np.repeat(grey[..., None], 3, 2)).save(tmp_path / f"{i}.png")
        lines.append(f"{i}.png {u} {v} {z}")
    (tmp_path / "hills.lp").write_text("\n".join(lines))
    found = measure(tmp_path / "hills.lp", 4, 32)
    shares = found.alpha.mean((1, 2))
    assert shares[0] == 1
    assert np.abs(shares[1:] - [0.625, 0.375, 0.125]).max() < 0.01
    assert (np.diff(found.alpha, axis=0) <= 0).all()


def test_too_few_lamps_and_unknown_kinds_are_told(tmp_path: Path) -> None:
    path = photographed(tmp_path, lamps(9) * [1, 1, -1])
    with pytest.raises(RtiError, match=r"set\.lp: 0 lamps above the horizon, expected 8 or more$"):
        measure(path, 1, 16)
    with pytest.raises(
        RtiError, match=r"a\.hsh: unknown kind, expected FILE\.ptm, FILE\.lp, or info\.json of relight$"
    ):
        measure(tmp_path / "a.hsh", 1, 16)
