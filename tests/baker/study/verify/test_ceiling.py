from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np

from furbake import BakeOptions
from furbake.asset.read import read_asset
from furbake.asset.stored import read_pelt
from furbake.pipeline import bake
from furbake.study.verify.ceiling import TOGETHER, directions, sampled_ceiling, shares, visible, write_passes
from furbake.study.verify.page import grey_copy
from furbake.surface.mesh import Surface
from furbake.surface.shapes import sphere as icosphere
from helpers.cells import cell


class TestCeiling:
    def test_shares_bring_smooth_light_back(self) -> None:
        """A function of the direction is known between the lights, too."""
        lights = directions(0.02)
        assert len(lights) % TOGETHER == 0
        chance = np.random.default_rng(0)
        towards = chance.normal(size=(500, 3))
        towards /= np.linalg.norm(towards, axis=1, keepdims=True)
        each = shares(lights, towards)
        above = towards[:, 2] > 0.02
        np.testing.assert_allclose(each.sum(axis=1), above, atol=1e-5)
        assert ((each > 0).sum(axis=1) <= 3).all()

        def light(d: np.ndarray) -> np.ndarray:
            return 1 + d[:, 2] + 0.5 * d[:, 0] * d[:, 1]

        np.testing.assert_allclose((each @ light(lights))[above], light(towards[above]), atol=0.06)

    def test_one_part_of_a_body_shades_another_and_not_itself(self) -> None:
        """A ball far behind hides the lamp; the ground's own ball does not, however low the lamp is."""
        ball = icosphere()
        whole = Surface(
            np.concatenate([ball.vertices, ball.vertices + np.array([5.0, 0, 0])]),
            np.concatenate([ball.faces, ball.faces + len(ball.vertices)]),
            np.concatenate([ball.normals, ball.normals]),
        )
        alone = Surface(ball.vertices, ball.faces, ball.normals)
        ground = SimpleNamespace(vertices=ball.vertices, normals=ball.normals, reach=np.full(len(ball.vertices), 0.1))
        lamp = np.array([1.0, 0, 0])
        lit = ball.normals[:, 0] > -0.1
        np.testing.assert_array_equal(visible(ground, alone, lamp)[lit], 1)
        assert visible(ground, whole, lamp)[ball.normals[:, 0] > 0.7].max() == 0

    def test_a_pass_is_an_asset_of_three_directions(self, tmp_path: Path, tiny: BakeOptions) -> None:
        bake("plane:2x2", tmp_path / "a", replace(tiny, uv="own"))
        asset = read_asset(tmp_path / "a")
        (tmp_path / "grey").mkdir()
        grey_copy(asset, tmp_path / "grey", 0.8, 0.2)
        found = sampled_ceiling(asset, [cell((0.2, 0.9, 0.3))])
        assert found.shares.shape == (1, 9, len(directions(0.02)))
        np.testing.assert_allclose(found.shares.sum(axis=2), 1, atol=1e-5)
        write_passes(found, tmp_path / "grey", tmp_path / "passes")
        assert len(list((tmp_path / "passes").glob("*.f32"))) == found.passes
        copy = read_asset(tmp_path / "passes" / "01")
        texels = read_pelt(copy)
        assert texels.colour is not None
        stored = (texels.colour / 255.0 + 0.055) / 1.055
        linear = np.where(texels.colour / 255.0 <= 0.04045, texels.colour / 255.0 / 12.92, stored**2.4)
        thick = found.alpha > 0.2
        np.testing.assert_allclose(
            found.white * linear[thick], np.moveaxis(found.samples[3:6], 0, -1)[thick], atol=0.02 * found.white
        )
