from __future__ import annotations

import json
import os
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path
from typing import Any, Self

import numpy as np
import pytest

from furbake import BakeOptions, page
from furbake.asset.read import read_asset
from furbake.asset.stored import read_pelt, skin_colour
from furbake.asset.validate import validate
from furbake.page import PageError
from furbake.pipeline import bake
from furbake.study.verify.cells import FIELD_OF_VIEW, Cell, Frame
from furbake.study.verify.page import grey_copy, show
from helpers.cells import NEAR, cell


def test_the_grey_copy_is_a_valid_asset_without_colours(tmp_path: Path, tiny: BakeOptions) -> None:
    bake("sphere", tmp_path / "a", replace(tiny, states=("dry", "soaked")))
    (tmp_path / "b").mkdir()
    grey_copy(read_asset(tmp_path / "a"), tmp_path / "b", 0.8, 0.25)
    before, after = (read_asset(tmp_path / name) for name in ("a", "b"))
    assert not [problem for problem in validate(tmp_path / "b") if "bake.json" not in problem]
    old, new = read_pelt(before), read_pelt(after)
    np.testing.assert_array_equal(new.codes, old.codes)
    np.testing.assert_array_equal(new.alpha, old.alpha)
    assert (new.tint == 255).all()
    assert old.colour is not None
    assert new.colour is None
    assert new.ramp.root == new.ramp.tip == new.ramp.tip2 == (0.8, 0.8, 0.8)
    assert skin_colour(after) == (0.25, 0.25, 0.25)
    assert len(after.fur["pelts"]) == 1


def test_missing_node_is_one_sentence(tmp_path: Path, tiny: BakeOptions, monkeypatch: pytest.MonkeyPatch) -> None:
    bake("plane:1x1", tmp_path / "a", tiny)
    monkeypatch.setattr(page.shutil, "which", lambda name: None)
    with pytest.raises(PageError, match="node: not found, expected Node"):
        show(read_asset(tmp_path / "a"), 0.8, 0.2, NEAR, [cell((0, 0, 1))], ["ptm"])


class Told:
    """A Node that writes what it should, or fails."""

    def __init__(self, command: list[str], says: str = "furbake: page 1/1\n", code: int = 0, **given: Any) -> None:
        self.stderr, self.returncode = says.splitlines(keepends=True), code
        folder = Path(command[-1])
        job = json.loads((folder / "job.json").read_text())
        assert sorted(path.name for path in (folder / "baked").glob("model.*")) == ["model.bin", "model.gltf"]
        count = job["width"] * job["height"]
        ramp = np.arange(count, dtype="<f4")
        for one in job["cells"]:
            for method in job["methods"]:
                np.column_stack([ramp, ramp * 0 + 1]).astype("<f4").tofile(folder / f"{one['name']}.{method}.f32")
            np.column_stack([ramp * 0, ramp * 0, ramp * 0 + 1, ramp >= 60]).astype("<f4").tofile(
                folder / f"{one['view']}.normals.f32"
            )
            np.zeros((count, 2), "<f4").tofile(folder / f"{one['view']}.features.f32")

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        pass


def test_pictures_of_the_page_have_row_0_on_top(
    tmp_path: Path, tiny: BakeOptions, monkeypatch: pytest.MonkeyPatch
) -> None:
    bake("plane:1x1", tmp_path / "a", tiny)
    monkeypatch.setattr(page.shutil, "which", lambda name: "node")
    monkeypatch.setattr(subprocess, "Popen", Told)
    seen: list[float] = []
    shown = show(read_asset(tmp_path / "a"), 0.8, 0.2, NEAR, [cell((0, 0, 1))], ["ptm"], seen.append)
    light = shown.light["front-lamp", "ptm"]
    assert light.shape == (50, 60)
    assert light[-1, 0] == 0
    assert light[0, 0] == 49 * 60
    assert np.isnan(shown.normal["front"][-1]).all()
    np.testing.assert_array_equal(shown.normal["front"][0, 0], [0, 0, 1])
    assert seen == [1.0]

    def broken(command: list[str], **given: Any) -> Told:
        return Told(command, "furbake: no browser for the tests: install Chromium\n", 1)

    monkeypatch.setattr(subprocess, "Popen", broken)
    with pytest.raises(PageError, match="page: no browser for the tests"):
        show(read_asset(tmp_path / "a"), 0.8, 0.2, NEAR, [cell((0, 0, 1))], ["ptm"])


def test_the_page_draws_a_job(tmp_path: Path, tiny: BakeOptions) -> None:
    """Through Node and a browser: a lit square of skin under fur whose hairs all have L = 1."""
    browser = [shutil.which(name) for name in ("chromium", "chromium-browser", "google-chrome")]
    if not (any(browser) or os.environ.get("FURBAKE_CHROMIUM")) or shutil.which("node") is None:
        pytest.skip("needs Node and Chromium")
    if not (page.TOOLS.parents[2] / "node_modules").exists():
        pytest.skip("needs the web wing: npm ci")
    thick = replace(tiny.coat, guard=replace(tiny.coat.guard, count=900), under=replace(tiny.coat.under, count=900))
    bake("plane:1x1", tmp_path / "a", replace(tiny, uv="own", fins=False, coat=thick))
    eye = np.array([0.0, 6.0, 6.0])
    wanted = [Cell("front", "lamp", eye, np.array([0.0, 1.0, 0.0]))]
    seen = Frame(np.zeros(3), 0.7, float(np.linalg.norm(eye)), 48, 40)
    shown = show(read_asset(tmp_path / "a"), 0.8, 0.0, seen, wanted, ["unlit", "ptm"])
    skin = np.isfinite(shown.normal["front"][..., 0])
    np.testing.assert_allclose(shown.normal["front"][skin], np.tile([0, 1, 0], (skin.sum(), 1)), atol=1e-5)
    half = np.tan(np.radians(FIELD_OF_VIEW) / 2) * np.linalg.norm(eye) / 20  # of a pixel, model units
    assert skin.sum() == pytest.approx(np.sqrt(0.5) / half**2, rel=0.1), "the square from 45 degrees"
    rows, columns = np.nonzero(skin)
    assert (rows.mean(), columns.mean()) == pytest.approx((19.5, 23.5), abs=1)
    light, cover = (part["front-lamp", "unlit"] for part in (shown.light, shown.cover))
    assert (cover[skin] > 0.99).all()
    assert np.median(light[skin]) == pytest.approx(1, abs=0.03)
    assert shown.light["front-lamp", "ptm"][skin].mean() > 0.1
    assert not shown.feature["front"].any()
    glossy = show(read_asset(tmp_path / "a"), 0.8, 0.0, seen, wanted, ["ptm"], look=(1.0, 0.0))
    assert (glossy.light["front-lamp", "ptm"] - shown.light["front-lamp", "ptm"])[skin].mean() > 0.01
