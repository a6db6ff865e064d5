from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from furbake.cli import main
from furbake.options import preset
from furbake.pelt.hairs.strands import Strands, grow
from furbake.pelt.hairs.volume import voxelise
from furbake.pelt.light.transport import hemisphere
from furbake.pelt.texels.basis import PTM
from furbake.pelt.texels.fit import relight
from furbake.study.trim import Row, cut, reweighted, share_above, stand_ins, table, trim

SMALL = replace(preset("bunny"), size=16, layers=8)


def clipped(strands: Strands, height: float) -> Strands:
    """The same hairs, cut off by a horizontal plane: segments beyond it shrink to nothing."""
    points, radius = strands.points.copy(), strands.radius.copy()
    for s in range(len(points)):
        beyond = np.flatnonzero(points[s, :, 2] > height)
        if not len(beyond):
            continue
        last = beyond[0]
        before, after = points[s, last - 1], points[s, last]
        t = (height - before[2]) / (after[2] - before[2])
        points[s, last:] = before + t * (after - before)
        radius[s, last:] = radius[s, last - 1] + t * (radius[s, last] - radius[s, last - 1])
    return replace(strands, points=points, radius=radius)


def test_the_lowest_slabs_are_what_clipped_strands_are_drawn_into() -> None:
    strands = grow(SMALL.coat, 0.6, 0)
    short = cut(voxelise(strands, 0.6, 16, 32, SMALL.coat.opacity), 0.5)
    drawn = voxelise(clipped(strands, 0.3), 0.3, 8, 32, SMALL.coat.opacity / 2)
    assert short.height == pytest.approx(0.3)
    np.testing.assert_allclose(short.sigma, drawn.sigma, atol=1e-9)
    np.testing.assert_allclose(short.tangent, drawn.tangent, atol=1e-9)
    np.testing.assert_allclose(short.drift, drawn.drift, atol=1e-9)


def test_whole_fur_is_its_own_stand_in() -> None:
    alpha = np.random.default_rng(0).uniform(0, 0.5, (6, 8, 8))
    np.testing.assert_allclose(stand_ins(alpha, 6), np.arange(6), atol=1e-12)


def test_slabs_stand_in_for_each_other_by_what_is_seen_not_by_depth() -> None:
    # Three thick slabs below three thin ones: of the thick ones alone the uppermost is seen as the thin ones were.
    alpha = np.concatenate([np.full((3, 4, 4), 0.5), np.full((3, 4, 4), 0.05)])
    above = share_above(alpha)
    assert np.all(np.diff(above) < 0)
    places = stand_ins(alpha, 3)
    assert np.all(np.diff(places) > 0)
    np.testing.assert_allclose(np.interp(places, np.arange(6), above), share_above(alpha[:3]), atol=1e-12)
    assert 2 < places[-1] < 5


def test_light_of_a_slab_changes_by_as_much_as_its_mean() -> None:
    rng = np.random.default_rng(1)
    alpha = rng.uniform(0.1, 0.6, (5, 8, 8))
    lights = hemisphere(24)
    # The share of a constant light in every texel keeps a vector that makes 1 of all of them.
    coefficients = 0.1 * rng.normal(size=(5, 8, 8, 6))
    coefficients[..., 5] = 1.0
    coefficients[..., 0] += np.arange(5)[:, None, None]
    short = reweighted(coefficients, alpha, 2)
    change = (short - coefficients[:2]) * alpha[:2, ..., None]
    assert np.abs(change[..., 0]).max() > 0.1
    for k in range(2):
        each = (short - coefficients[:2])[k]
        np.testing.assert_allclose(each, np.broadcast_to(each.mean((0, 1)), each.shape), atol=0.02)
    assert np.isfinite(relight(short, PTM, lights)).all()


@pytest.fixture(scope="module")
def rows() -> list[Row]:
    return list(trim(SMALL, (0.25, 0.5), lights=32))


def test_reweighted_slabs_come_nearer_to_a_bake_of_the_cut_strands(rows: list[Row]) -> None:
    ways = {(row.kept, row.way): row for row in rows}
    assert {kept for kept, _ in ways} == {2, 4}
    for kept in (2, 4):
        flat, bare, ours, anew = (ways[kept, way] for way in ("flattened", "cut", "cut, re-weighted", "baked anew"))
        for figure in ("psnr", "psnr_composite"):
            assert getattr(ours, figure) > getattr(bare, figure) + 3
            assert getattr(ours, figure) > getattr(flat, figure)
            assert getattr(anew, figure) > getattr(ours, figure)
        assert ours.r > max(flat.r, bare.r - 0.01)
        assert 0.85 < ours.level < 1.4


def test_table_has_a_line_for_each_length(rows: list[Row]) -> None:
    lines = table(rows).splitlines()
    assert len(lines) == 4
    assert lines[2].startswith("| bunny | 2 of 8 | ")
    assert "cut, re-weighted: slabs, from above, r, level" in lines[0]


def test_command_prints_it(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["trim", "bunny", "--size", "8", "--lengths", "0.5", "--lights", "16", "--quiet"]) == 0
    assert "| bunny | 8 of 16 |" in capsys.readouterr().out.replace("12 of 24", "8 of 16")
    assert main(["trim", "--lengths", "1.5"]) == 2
    assert "lengths: got 1.5, expected above 0 and at most 1" in capsys.readouterr().err
