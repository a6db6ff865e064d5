"""The fur's side view: hairs where they stand, light that a hair alone must have, and a polynomial that keeps it."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from furbake.options import BakeOptions
from furbake.pelt.fin import (
    FIN_FRAME,
    THICKNESS,
    SideView,
    between,
    fill_fin,
    fin_environment,
    fin_shape,
    fit_fins,
    in_the_row,
    overlap,
    seen_from_the_side,
    side_view,
)
from furbake.pelt.hairs.strands import Coat, Strands, grow
from furbake.pelt.hairs.volume import fine_shape, voxelise
from furbake.pelt.light.transport import hemisphere
from furbake.pelt.texels.basis import PTM, harmonics
from furbake.pelt.texels.fit import relight

LAYERS, SIZE, HEIGHT = 8, 32, 0.5
COAT = Coat()


def straight(roots: Any, lean: Any = (0.0, 0.0), radius: float = 0.02) -> Strands:
    """Straight hairs of the full height with roots (S, 2), all leaning alike."""
    roots = np.array(roots, float)
    s = np.linspace(0, 1, 9)[None, :, None]
    across = roots[:, None] + np.array(lean) * s
    points = np.concatenate([across, np.broadcast_to(HEIGHT * s, (len(roots), 9, 1))], -1)
    even = np.ones((len(roots), 9))
    return Strands(points, radius * even, 0.5 * even, 0.25 * even)


def view(strands: Strands, lights: Any = None, coat: Coat = COAT, **options: Any) -> SideView:
    fine = voxelise(strands, HEIGHT, *fine_shape(LAYERS, SIZE, HEIGHT), COAT.opacity)
    return side_view(strands, fine, LAYERS, SIZE, hemisphere(4) if lights is None else lights, coat, **options)


def unit(*vector: float) -> np.ndarray[Any, Any]:
    return np.array(vector) / np.linalg.norm(vector)


@pytest.mark.parametrize(
    ("size", "height", "shape"),
    [
        (64, 0.5, (32, 64)),
        (64, 0.25, (16, 64)),
        (128, 0.6, (64, 128)),
        (8, 0.02, (8, 8)),
        (64, 4.0, (64, 64)),
        (128, 1.0, (64, 128)),
    ],
)
def test_texels_are_about_square(size: int, height: float, shape: tuple[int, int]) -> None:
    assert fin_shape(size, height) == shape


def test_an_upright_hair_is_a_column() -> None:
    seen = view(straight([(0.5, 0.25 + 0.5 / SIZE)]))
    assert seen.alpha.shape == (16, 32)
    column = seen.alpha.sum(0)
    assert column.argmax() == 8
    assert column[7:10].sum() > 0.99 * column.sum()
    np.testing.assert_allclose(seen.alpha[:, 8], seen.alpha[0, 8])
    assert seen.alpha[0, 8] > 0.9
    np.testing.assert_allclose(seen.tint[:, 8], 0.5)
    np.testing.assert_allclose(seen.hue[:, 8], 0.25)


@pytest.mark.parametrize("lean", [0.3, -0.3, 0.9])
def test_hairs_lean_along_the_fin_and_go_round_it(lean: float) -> None:
    alpha = view(straight([(0.5, 0.5)], lean=(0.0, lean))).alpha
    angle = 2 * np.pi * (np.arange(32) + 0.5) / 32
    middle = np.unwrap(np.angle(alpha @ np.exp(1j * angle))) / (2 * np.pi)
    rise = np.polyfit((np.arange(16) + 0.5) / 16, middle, 1)[0]
    assert rise == pytest.approx(lean, abs=0.02)


def test_a_turn_of_the_tile_turns_the_texture() -> None:
    strands = straight([(0.45, 0.1), (0.55, 0.3), (0.5, 0.9)], lean=(0.05, 0.2))
    moved = replace(strands, points=strands.points + np.array([0, 0.25, 0]))
    one, two = view(strands, flat=True), view(moved, flat=True)
    np.testing.assert_allclose(np.roll(one.alpha, 8, axis=1), two.alpha, atol=1e-9)
    np.testing.assert_allclose(np.roll(one.light, 8, axis=2), two.light, atol=2e-3)


def test_only_a_row_of_tufts_is_seen_and_whole() -> None:
    strands = grow(BakeOptions().coat, HEIGHT, 0)
    row = strands.some(in_the_row(strands))
    off = np.abs(row.points[:, 0, 0] % 1 - 0.5)
    assert off.max() <= THICKNESS / 2
    assert len(row.points) == pytest.approx(THICKNESS * len(strands.points), rel=0.1)
    assert row.points.shape[1:] == strands.points.shape[1:]
    assert in_the_row(straight([(0.05, 0.2)])).all()  # a fin is never bare


def test_alpha_is_what_all_hairs_along_the_view_cover() -> None:
    volume = voxelise(straight([(0.4, 0.5), (0.6, 0.5), (0.5, 0.3)], radius=0.05), HEIGHT, 16, 32, 1.0)
    shares = seen_from_the_side(volume)
    through = np.exp(-(volume.sigma / 32).sum(2))  # upright hairs show their whole width
    np.testing.assert_allclose(shares.sum(2), 1 - through, atol=1e-6)
    row = shares[8, 16]  # the hair in front hides most of the one behind it
    assert row[16:].sum() > 1.5 * row[:16].sum() > 0


def test_a_hair_alone_is_a_lambertian_cylinder_as_the_shells_show_it() -> None:
    lights = np.array([unit(1, 0, 0.5), unit(0, 1, 0.5), unit(-1, 0, 0.5), unit(1, 0, 1), unit(0, 1, 1)])
    hair = view(straight([(0.5, 0.5 + 0.5 / SIZE)], radius=0.004), lights, flat=True).light[:, 8, 16]
    # Upright it points at the eye above: (4/π)·sinθ from all sides; next to nothing is scattered twice.
    expected = 4 / np.pi * np.hypot(lights[:, 0], lights[:, 1])
    np.testing.assert_allclose(hair, expected, rtol=0.12)


def test_hairs_before_and_behind_the_row_shade_it() -> None:
    lights = np.array([unit(1, 0, 0.3), unit(-1, 0, 0.3)])
    row = [(0.5, v) for v in np.arange(8) / 8]
    black = replace(COAT, albedo=0.0)  # nothing is scattered twice
    hedges = row + [(u, v) for u in (0.2, 0.8) for v in np.arange(32) / 32]
    alone, hedge = (view(straight(roots), lights, black, flat=True) for roots in (row, hedges))
    np.testing.assert_allclose(alone.alpha, hedge.alpha)
    low = alone.alpha[2] > 0.5
    assert hedge.light[0, 2, low].mean() < 0.5 * alone.light[0, 2, low].mean()


def test_more_light_higher_up_and_none_negative() -> None:
    strands = grow(BakeOptions().coat, HEIGHT, 0)
    lights = hemisphere(24)
    seen = view(strands, lights)
    assert np.isfinite(seen.light).all()
    assert seen.light.min() >= 0
    mean = (seen.light * seen.alpha).sum((0, 2)) / np.maximum(seen.alpha.sum(1), 1e-9) / len(lights)
    assert mean[2] < 0.6 * mean[8] < 0.6 * mean[13]
    assert seen.alpha[:2].mean() > 0.9
    assert seen.alpha[-1].mean() < 0.3


def test_half_the_resolution_does() -> None:
    strands, lights = grow(BakeOptions().coat, HEIGHT, 0), hemisphere(12)
    fine = voxelise(strands, HEIGHT, *fine_shape(LAYERS, SIZE, HEIGHT), COAT.opacity)
    finer = voxelise(strands, HEIGHT, *(2 * side for side in fine_shape(LAYERS, SIZE, HEIGHT)), COAT.opacity)
    coarse = side_view(strands, fine, LAYERS, SIZE, lights, COAT)
    exact = side_view(strands, finer, LAYERS, 2 * SIZE, lights, COAT)
    exact_light = exact.light.reshape(12, 16, 2, 32, 2).mean((2, 4))
    weight = coarse.alpha
    difference = np.sqrt((((coarse.light - exact_light) ** 2).mean(0) * weight).sum() / weight.sum())
    assert difference < 0.15 * np.percentile(exact.light, 99)


def test_known_polynomials_come_back() -> None:
    chance = np.random.default_rng(0)
    lights = hemisphere(64)
    coefficients = chance.uniform(-0.3, 0.5, (8, 16, 6)) + np.array([0, 0, 0, 0, 0, 2.0])
    light = np.einsum("hwc,nc->nhw", coefficients, PTM(lights[:, FIN_FRAME]))
    side = SideView(np.ones((8, 16)), np.full((8, 16), 0.4), np.zeros((8, 16)), light)
    (fin,) = fit_fins([side], lights, [None])
    back = relight(fin.values, PTM, lights[:, FIN_FRAME])
    assert np.abs(back - light).max() < 0.02
    assert (fin.tint == 102).all()
    assert (fin.alpha == 255).all()
    assert fin.colour is None


def test_frame_is_right_handed_with_hairs_leaning_along_t() -> None:
    frame = np.eye(3)[FIN_FRAME]  # rows t, n, w in the tile's frame
    np.testing.assert_array_equal(frame, [[0, 1, 0], [0, 0, 1], [1, 0, 0]])
    np.testing.assert_array_equal(np.cross(frame[0], frame[1]), frame[2])


def test_environment_has_its_closed_form() -> None:
    # R = c + b·ω + ωᵀQω over the half sphere y ≥ 0, with the moments of methods for z ≥ 0 and y, z exchanged.
    matrix = fin_environment()
    y00, y1, y20, y22 = (np.sqrt(k / np.pi) for k in (1 / 4, 3 / 4, 5 / 16, 15 / 16))
    pi = np.pi
    # harmonics: constant; then y, z, x; then xy, yz, 3z² − 1, xz, x² − y²
    one = [2 * pi * y00, pi * y1, 0, 0, 0, 0, y20 * (3 * 2 * pi / 3 - 2 * pi), 0, 0]
    np.testing.assert_allclose(matrix[5], one, atol=1e-12)
    y11 = np.sqrt(15 / (4 * pi))
    lu = [0, 0, 0, 2 * pi / 3 * y1, pi / 4 * y11, 0, 0, 0, 0]  # ∫x·xy = π/4
    np.testing.assert_allclose(matrix[3], lu, atol=1e-12)
    square = [2 * pi / 3, pi / 4, 2 * pi / 5, 2 * pi / 15]  # ∫x², ∫x²·y, ∫x⁴, ∫x²y² = ∫x²z²
    lu2 = [square[0] * y00, square[1] * y1, 0, 0, 0, 0, y20 * (3 * square[3] - square[0]), 0]
    lu2.append(y22 * (square[2] - square[3]))
    np.testing.assert_allclose(matrix[0], lu2, atol=1e-12)
    assert matrix[4, 0] == pytest.approx(pi * y00)  # ∫y = π


def test_environment_is_the_sum_over_many_lights() -> None:
    lights = hemisphere(40_000)[:, FIN_FRAME]  # around n; the lowest ones are left out
    total = PTM(lights).T @ harmonics(lights) * 2 * np.pi * 0.98 / len(lights)
    np.testing.assert_allclose(total, fin_environment(), atol=0.08)


def test_matrices_keep_means() -> None:
    for count, wanted in ((64, 32), (72, 64), (16, 32), (5, 3)):
        matrix = overlap(count, wanted)
        np.testing.assert_allclose(matrix.sum(1), 1)
        np.testing.assert_allclose(matrix.sum(0), wanted / count)
    matrix = between(8, 32, periodic=True)
    np.testing.assert_allclose(matrix.sum(1), 1)
    np.testing.assert_allclose(matrix.sum(0), 4)
    ramp = between(4, 8) @ np.arange(4.0)
    np.testing.assert_allclose(ramp, [0, 0.25, 0.75, 1.25, 1.75, 2.25, 2.75, 3])


@pytest.mark.parametrize("shape", [(8, 32), (16, 32), (32, 32)])
def test_empty_texels_take_their_neighbours_values(shape: tuple[int, int]) -> None:
    alpha = np.zeros(shape)
    alpha[: shape[0] // 2] = 1
    values = np.where(alpha > 0, 0.7, -5.0)[..., None]
    filled = fill_fin(values, alpha)
    assert filled.shape == (*shape, 1)
    np.testing.assert_allclose(filled[: shape[0] // 2], 0.7)
    assert np.abs(filled - 0.7).max() < 0.05
