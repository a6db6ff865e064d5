"""Two bakes of one body beside each other; the page is a stand-in, as a browser is too slow for every run."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from furbake import BakeOptions
from furbake.groom.files import write_groom
from furbake.groom.strands import groom
from furbake.pipeline import bake
from furbake.study import beside
from furbake.study.verify.body import Options
from furbake.study.verify.page import Shown
from furbake.study.verify.pathtrace import VerifyError


@pytest.fixture
def page(monkeypatch: pytest.MonkeyPatch) -> None:
    """A page on which fur is as bright as it is long."""

    def show(asset: Any, albedo: float, skin: float, seen: Any, cells: Any, methods: Any, step: Any) -> Shown:
        shape = seen.height, seen.width
        light = np.linspace(0, float(asset.fur["length"]), shape[0] * shape[1]).reshape(shape)
        names = [(cell.name, method) for cell in cells for method in methods]
        views = {cell.view for cell in cells}
        step(1.0)
        return Shown(
            dict.fromkeys(names, light),
            dict.fromkeys(names, np.ones(shape)),
            dict.fromkeys(views, np.zeros((*shape, 3))),
            dict.fromkeys(views, np.zeros(shape, bool)),
        )

    monkeypatch.setattr(beside, "show", show)


@pytest.mark.usefixtures("page")
def test_longer_fur_is_told_from_shorter_and_from_itself(tmp_path: Path, tiny: BakeOptions) -> None:
    for name, length in (("a", 0.1), ("b", 0.12)):
        bake("sphere", tmp_path / name, replace(tiny, length=length))
    same = beside.beside(tmp_path / "a", tmp_path / "a", Options(size=32), picture=tmp_path / "a.png")
    assert set(same["apart"].values()) == {0.0}
    assert same["r"] == pytest.approx(1.0)
    assert (tmp_path / "a.png").is_file()
    other = beside.beside(tmp_path / "a", tmp_path / "b", Options(size=32))
    assert other["apart"]["length"] > 0.5
    assert {round(cell["brightness"], 3) for cell in other["cells"]} == {round(0.1 / 0.12, 3)}
    assert any("| length | " in line for line in beside.lines(other))


@pytest.mark.usefixtures("page")
def test_another_body_is_refused(tmp_path: Path, tiny: BakeOptions) -> None:
    for name in ("sphere", "torus"):
        bake(name, tmp_path / name, tiny)
    with pytest.raises(VerifyError, match="has another body than"):
        beside.beside(tmp_path / "sphere", tmp_path / "torus")


@pytest.mark.usefixtures("page")
def test_a_groom_of_ours_baked_again_has_like_strands(tmp_path: Path, tiny: BakeOptions) -> None:
    bake("sphere", tmp_path / "a", replace(tiny, length=0.15))
    write_groom(tmp_path / "hairs.npz", groom(tmp_path / "a"))
    bake("sphere", tmp_path / "b", BakeOptions(**vars(tiny) | {"length": None, "groom": str(tmp_path / "hairs.npz")}))
    found = beside.beside(tmp_path / "b", tmp_path / "a", Options(size=32))
    assert max(found["apart"].values()) < 0.25  # of a tile of two dozen hairs
