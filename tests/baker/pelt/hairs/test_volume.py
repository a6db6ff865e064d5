from __future__ import annotations

import numpy as np
import pytest

from furbake.pelt.hairs.strands import Coat, Strands, grow
from furbake.pelt.hairs.volume import (
    average_down,
    coarsen,
    doubled,
    fine_shape,
    pool,
    seen_from_above,
    voxelise,
)


def hair(root: tuple[float, float], tip: tuple[float, float, float], radius: float) -> Strands:
    """One straight hair of even thickness."""
    s = np.linspace(0, 1, 9)[:, None]
    points = np.array([*root, 0.0]) * (1 - s) + np.array(tip) * s
    return Strands(
        points[None],
        np.full((1, 9), radius),
        np.full((1, 9), 0.5),
        np.full((1, 9), 0.25),
    )


def solid(strands: Strands, height: float = 0.5, layers: int = 8, size: int = 64) -> np.ndarray:
    """Share of every voxel that hair fills."""
    opacity = 1.0
    return voxelise(strands, height, layers, size, opacity).sigma * height / 16 / opacity


@pytest.mark.parametrize("radius", [0.004, 0.008, 0.02, 0.05])
def test_upright_hair_fills_its_cross_section_wherever_it_stands(radius: float) -> None:
    places = np.random.default_rng(0).random((30, 2))
    areas = [solid(hair((u, v), (u, v, 0.5), radius), layers=1).sum() / 64**2 for u, v in places]
    assert np.mean(areas) == pytest.approx(np.pi * radius**2, rel=0.03)


def test_leaning_hair_has_a_longer_cross_section_and_its_direction() -> None:
    strands = hair((0.3, 0.5), (0.8, 0.5, 0.5), 0.03)
    volume = voxelise(strands, 0.5, 8, 64, 1.0)
    area = (volume.sigma * 0.5 / 16).sum((1, 2)) / 64**2
    np.testing.assert_allclose(area, np.pi * 0.03**2 * np.sqrt(2), rtol=0.05)
    inside = volume.sigma > 0
    np.testing.assert_allclose(
        volume.tangent[inside],
        np.broadcast_to([0.5**0.5, 0, 0.5**0.5], (inside.sum(), 3)),
        atol=1e-9,
    )
    assert set(np.unique(volume.tint[inside].round(9))) == {0.5}
    middles = (np.arange(8) + 0.5) / 8
    np.testing.assert_allclose(volume.drift, np.stack([0.5 * middles, 0 * middles], 1), atol=1e-9)


def test_drift_is_the_mean_of_all_hairs() -> None:
    """Thick ones count by their width, steep ones as flat ones."""
    one, other = hair((0.1, 0.2), (0.6, 0.2, 0.5), 0.03), hair((0.1, 0.7), (0.1, 2.2, 0.5), 0.01)
    both = Strands(*(np.concatenate(pair) for pair in zip(vars(one).values(), vars(other).values(), strict=True)))
    middles = (np.arange(8) + 0.5) / 8
    wanted = np.stack([0.75 * 0.5 * middles, 0.25 * 1.5 * middles], 1)
    np.testing.assert_allclose(voxelise(both, 0.5, 8, 64, 1.0).drift, wanted, rtol=0.01)


def test_tile_repeats() -> None:
    middle = solid(hair((0.5, 0.5), (0.625, 0.5, 0.5), 0.03))
    corner = solid(hair((0.0, 0.0), (0.125, 0.0, 0.5), 0.03))
    np.testing.assert_allclose(np.roll(middle, (-32, -32), (1, 2)), corner, atol=1e-12)


def test_row_is_v_and_column_is_u() -> None:
    _, row, column = np.nonzero(solid(hair((0.25, 0.75), (0.25, 0.75, 0.5), 0.01)))
    assert abs(column.mean() + 0.5 - 16) < 1
    assert abs(row.mean() + 0.5 - 48) < 1


def test_top_slab_holds_tips() -> None:
    volume = voxelise(grow(Coat(), 0.6, 0), 0.6, 32, 128, 2.2)
    assert (volume.sigma.sum((1, 2)) > 0).all()


def test_coarse_coverage_is_that_of_the_fine_slabs_together() -> None:
    fine = voxelise(grow(Coat(), 0.6, 1), 0.6, 8, 32, 2.2)
    clear = (1 - fine.coverage).reshape(4, 2, 32, 32).prod(1)
    np.testing.assert_allclose(coarsen(fine, 4, 16).coverage, pool(1 - clear, 16), atol=1e-6)


def test_average_down_sees_the_upper_slab_first() -> None:
    coverage = np.zeros((2, 2, 2))
    coverage[1] = 0.75
    coverage[0] = 1.0
    values = np.stack([np.full((2, 2), 10.0), np.full((2, 2), 2.0)])
    mean = average_down(values, seen_from_above(coverage, 1), 1)
    assert mean == pytest.approx(0.75 * 2 + 0.25 * 10, abs=1e-3)


def test_the_volume_is_finer_in_every_axis() -> None:
    assert fine_shape(16, 64, 0.5) == (64, 128)
    assert fine_shape(24, 128, 0.6) == (72, 256)
    assert fine_shape(64, 8, 0.5) == (128, 16)
    assert fine_shape(6, 32, 0.5) == (30, 64)
    for layers in range(1, 65):
        fine, _ = fine_shape(layers, 64, 1.0)
        assert fine % layers == 0
        assert fine // layers >= 2


def test_doubled_keeps_the_mean_and_what_is_linear() -> None:
    image = np.random.default_rng(0).random((2, 8, 8))
    np.testing.assert_allclose(pool(doubled(image), 8).mean(), image.mean())
    ramp = np.tile(np.arange(8.0), (1, 8, 1))
    np.testing.assert_allclose(doubled(ramp)[0, 5, 2:-2], np.arange(0.75, 6.5, 0.5))
    np.testing.assert_allclose(doubled(ramp.swapaxes(1, 2))[0, 2:-2, 5], np.arange(0.75, 6.5, 0.5))
