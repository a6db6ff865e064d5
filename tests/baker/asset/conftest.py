"""Fixtures shared by the tests of this folder."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from furbake import BakeOptions, bake
from furbake.asset.gltf import FurModel, write_gltf
from furbake.asset.read import read_asset
from furbake.pelt.pelt import Pelt
from furbake.surface.place.vertex_fur import VertexFur
from furbake.surface.shapes import builtin
from helpers.gltf import lapped


@pytest.fixture
def write(tmp_path: Path, make_pelt: Callable[..., Pelt]) -> Callable[..., Any]:
    def build(name: str = "sphere", fur: Any = None, pelt: Any = None, surface: Any = None, **rest: Any) -> Any:
        surface = surface or builtin(name)
        charts = rest.pop("charts", None) or lapped(rest.get("ground", surface))
        folder = tmp_path / "asset"
        folder.mkdir(exist_ok=True)
        fur = fur or VertexFur.even(len(rest.get("ground", surface).vertices))
        record = write_gltf(folder, FurModel(surface, charts, fur, (pelt or make_pelt(),), 0.12, **rest))
        return read_asset(folder), surface, charts, record

    return build


@pytest.fixture(scope="session")
def good(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("good") / "asset"
    bake("sphere", folder, BakeOptions(layers=4, size=8, lights=8, meshopt=False))
    return folder
