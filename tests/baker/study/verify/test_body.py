from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from furbake import BakeOptions
from furbake.asset.planes import read_png
from furbake.groom.strands import Groom
from furbake.pipeline import bake
from furbake.study.verify import apart
from furbake.study.verify.body import Options, verify_body
from furbake.study.verify.cells import FIELD_OF_VIEW, Frame
from furbake.study.verify.figures import lines
from furbake.study.verify.page import Shown
from furbake.study.verify.pathtrace import VerifyError
from furbake.study.verify.sheet import GAP
from furbake.study.verify.truth import Scene, trace
from helpers.cells import NEAR, cell


@pytest.mark.parametrize(
    ("options", "says"),
    [
        (Options(plan="all"), "plan: got 'all', expected body or round"),
        (Options(methods=("ptm", "magic")), "methods: got 'magic'"),
        (Options(size=8), "size: got 8"),
        (Options(spp=1), "spp: got 1"),
        (Options(look=(0.5, -1.0)), "look: got 0.5,-1, expected 0 to 100 each"),
        (Options(distance=0.1), "distance: got 0.1, expected 0.25 to 4"),
    ],
)
def test_options_out_of_range_are_refused(tmp_path: Path, options: Options, says: str) -> None:
    with pytest.raises(VerifyError, match=says):
        verify_body(tmp_path, options)


@pytest.mark.usefixtures("mitsuba")
class TestWithMitsuba:
    """Proofs that need the path tracer."""

    @staticmethod
    def hair(radius: float) -> Groom:
        """A straight one along x, before a wall far behind it."""
        points = np.zeros((1, 9, 3), np.float32)
        points[0, :, 0] = np.linspace(-3, 3, 9)
        flat = np.ones((1, 9), np.float32)
        return Groom(points, radius * flat, flat, np.ones((1, 9, 3), np.float32), np.zeros(1, int), np.zeros(1, int))

    WALL = np.array([[-9.0, -9, -20], [9, -9, -20], [9, 9, -20], [-9, 9, -20]])
    FACES = np.array([[0, 1, 2], [0, 2, 3]])

    @pytest.mark.parametrize("phi", [0.0, 0.9, 2.2])
    def test_a_hair_is_as_wide_and_as_bright_as_the_cylinder_says(self, phi: float) -> None:
        """A Lambertian cylinder of albedo ϖ has 4π·radiance/(ϖ·E) = sinφ + (π − φ)cosφ on the mean of its width."""
        away = replace(NEAR, radius=5.0)
        scene = Scene(self.hair(0.1), self.WALL + np.array([0, 0, -900]), self.FACES, 0.85, 0.0)
        light = cell((0.0, np.sin(phi), np.cos(phi)))
        (seen,) = trace(scene, away, [light], 64, depth=2)
        column = seen.light[:, 20:40].mean(axis=1)
        cover = seen.cover[:, 20:40].mean(axis=1)
        pixel = 2 * 10 * np.tan(np.radians(FIELD_OF_VIEW) / 2) / 50
        assert cover.sum() * pixel == pytest.approx(0.2, rel=0.02)
        expected = np.sin(phi) + (np.pi - phi) * np.cos(phi)
        assert column.sum() / cover.sum() == pytest.approx(expected, rel=0.05)
        if phi > 0:
            assert column[:25].sum() > column[25:].sum(), "the upper side faces the lamp, and row 0 is on top"

    def test_skin_is_as_bright_as_lambert_says(self) -> None:
        """Radiance of albedo ρ under irradiance E·cos is ρ·E·cos/π: in the unit of L 4·ρ·cos/ϖ."""
        scene = Scene(self.hair(1e-5), self.WALL, self.FACES, 0.8, 0.3)
        (seen,) = trace(scene, NEAR, [cell((0.6, 0.0, 0.8))], 8)
        assert np.median(seen.light) == pytest.approx(4 * 0.3 * 0.8 / 0.8, rel=1e-3)
        assert seen.cover.min() == 1

    def test_a_body_is_compared(self, tmp_path: Path, tiny: BakeOptions, monkeypatch: pytest.MonkeyPatch) -> None:
        """All but the browser, whose pictures are those of the tracer, twice as bright."""
        bake("sphere", tmp_path / "a", replace(tiny, fins=False))
        kept: list[Any] = []

        def traced(*given: Any, **more: Any) -> Any:
            kept.extend(apart.trace(*given, **more))
            return kept

        def shown(
            asset: Any, albedo: float, skin: float, seen: Frame, wanted: Any, methods: Any, *_: Any, look: Any
        ) -> Shown:
            assert look == (0.25, 40.0)
            normal = np.zeros((seen.height, seen.width, 3))
            normal[..., 2] = 1
            pairs = [(one.name, method) for one in wanted for method in methods]
            return Shown(
                {pair: 2 * one.light for pair, one in zip(pairs, kept, strict=True)},
                {pair: one.cover for pair, one in zip(pairs, kept, strict=True)},
                {"front": normal},
                {"front": normal[..., 0] > 0},
            )

        monkeypatch.setattr("furbake.study.verify.body.trace", traced)
        monkeypatch.setattr("furbake.study.verify.body.show", shown)
        options = Options(methods=("ptm",), size=36, spp=8, look=(0.25, 40.0), truth=tmp_path / "t.npz")
        found = verify_body(tmp_path / "a", options, picture=tmp_path / "p.png")
        assert found["plan"] == "round"
        for one in found["cells"]:
            assert one["methods"]["ptm"]["brightness"] == pytest.approx(2)
            assert one["methods"]["ptm"]["r"] == pytest.approx(1)
            assert one["outline"] == 1
        assert read_png(tmp_path / "p.png").shape == (3 * 30 + 2 * GAP, 3 * 36 + 2 * GAP, 3)
        assert sum(line.startswith("| front-") for line in lines(found)) == 3
        assert sum("brightness in the unit of L" in line for line in lines(found)) == 3
        again = list(kept)
        monkeypatch.setattr("furbake.study.verify.body.trace", lambda *given, **more: pytest.fail("traced again"))
        kept[:] = again
        assert verify_body(tmp_path / "a", options)["cells"][0]["outline"] == 1


def test_missing_mitsuba_says_what_to_install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "mitsuba", None)
    with pytest.raises(VerifyError, match=r"pip install 'furbake\[verify\]'"):
        verify_body(tmp_path)
