"""Fixtures shared by the tests of this folder."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from furbake.asset.gltf import FurModel, write_gltf
from furbake.asset.rig.motion import Motion
from furbake.pelt.pelt import FinPelt, Pelt
from furbake.surface.mesh import Surface
from furbake.surface.place.fins import build_fins
from furbake.surface.place.vertex_fur import VertexFur
from furbake.surface.rig.follow import follow
from furbake.surface.rig.rig import Rig
from helpers.gltf import lapped
from helpers.moving import Moving

FIGURES = ("psnr", "psnr_worst_layer", "psnr_composite", "r2", "psnr_quantised", "psnr_quantised_composite",
           "psnr_quantisation")  # fmt: skip


def side(pelt: Pelt) -> FinPelt:
    """Side view of a pelt: its lowest slab."""
    return FinPelt(pelt.codes[0], pelt.alpha[0], pelt.tint[0], None, pelt.scale, pelt.bias)


@pytest.fixture
def character(tmp_path: Path, make_pelt: Callable[..., Pelt]) -> Callable[..., Moving]:
    """Write a character as a body with fur and fins: character(surface, rig, ground=..., ...)."""

    def build(surface: Surface, rig: Rig, **rest: Any) -> Moving:
        ground = rest.get("ground", surface)
        charts = rest.pop("charts", None) or lapped(ground)
        follows = [follow(rig, each.vertices, each.normals) for each in (surface, ground)]
        fins = build_fins(ground, np.cross(ground.normals, [1.0, 0.3, 0.2]), 0.3)
        fur = rest.pop("fur", None) or VertexFur.even(len(ground.vertices))
        pelt = replace(make_pelt(colour=False), fin=side(make_pelt()))
        model = FurModel(surface, charts, fur, (pelt,), 0.12, fins, **rest, motion=Motion(rig, *follows))
        fit = dict.fromkeys(FIGURES, 1.0) | {"bound": {"rank": 6, "psnr": 1.0, "psnr_composite": 1.0}}
        record = {"furbake": "0", "libraries": {}, "options": {}, "input": {}, "key": "", "fit": fit}
        record["asset"] = write_gltf(tmp_path, model)
        (tmp_path / "bake.json").write_text(json.dumps(record))
        return Moving(tmp_path / "model.gltf")

    return build
