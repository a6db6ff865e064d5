"""Edges of stripes in the fur lie where a path tracer has them: the same strands, each coloured at its root.

Minutes of tracing: `FURBAKE_TEST_ALL=1`.
"""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh
from PIL import Image

from furbake.options import override, preset
from furbake.pipeline import bake
from furbake.study.verify.apart import trace
from furbake.study.verify.body import Options, prepared
from furbake.study.verify.cells import Frame, Plan, cells, frame
from furbake.study.verify.page import show
from furbake.study.verify.truth import Scene

STRIPES, TILE = 12, 0.25
"""Stripes on a plane that is 1 wide, one pixel each, and the width of a tile."""

WHITE = "0.8,0.8,0.8"

PLAN = Plan({"above": (0.0, 89.99)}, {"eye": (0.3, 0.2, 0.93)})

RED, GREEN = (1.0, 0.0, 0.05), (0.0, 1.0, 0.05)


def plane(folder: Path) -> Path:
    """A plane of 24 × 24 squares; its stripes cross the direction in which fur is laid (along z)."""
    side = np.linspace(-0.5, 0.5, 25)
    x, z = (part.reshape(-1) for part in np.meshgrid(side, side))
    at = np.arange(625).reshape(25, 25)
    a, b, c, d = (part.reshape(-1) for part in (at[:-1, :-1], at[:-1, 1:], at[1:, :-1], at[1:, 1:]))
    faces = np.concatenate([np.stack([a, c, b], 1), np.stack([b, c, d], 1)])
    pixels = np.zeros((STRIPES, 1, 3), np.uint8)
    pixels[0::2, 0], pixels[1::2, 0] = (255, 0, 63), (0, 255, 63)
    material = trimesh.visual.material.PBRMaterial(baseColorTexture=Image.fromarray(pixels), metallicFactor=0.0)
    # v of trimesh grows upwards.
    visual = trimesh.visual.TextureVisuals(uv=np.column_stack([x + 0.5, 0.5 - z]), material=material)
    mesh = trimesh.Trimesh(np.column_stack([x, 0 * x, z]), faces, process=False, visual=visual)
    mesh.export(folder / "plane.glb")
    return folder / "plane.glb"


def stripes(z: np.ndarray) -> np.ndarray:
    """(n, 3) linear colours: what lies between the middles of two pixels is mixed, and the picture repeats."""
    at = (z + 0.5) * STRIPES - 0.5
    share = 1.0 - np.abs(np.mod(at, 2.0) - 1.0)[:, None]
    return (1.0 - share) * np.array(RED) + share * np.array(GREEN)


def edges(picture: np.ndarray, seen: Frame) -> np.ndarray:
    """Where red turns to green, pixels from the middle between two stripes, for all but the outer ones.

    Each over the length of a tile: single hairs lie aside of the mean.
    """
    unit = picture.shape[0] / 2 / np.tan(np.radians(seen.field) / 2) / seen.distance
    redder, half = picture[..., 0] - picture[..., 1], unit / STRIPES / 2
    height, width = redder.shape
    rows, found = np.arange(height) + 0.5, []
    for start in (-1.5, -0.5, 0.5):
        left, right = (round(width / 2 + (start + side) * TILE * unit) for side in (0, 1))
        profile = redder[:, left:right].mean(axis=1)
        for edge in range(2, STRIPES - 1):
            away = (rows - height / 2 - (edge / STRIPES - 0.5) * unit) / half
            before, after = (profile[np.abs(away - end) < 0.5].mean() for end in (-1.0, 1.0))
            found.append(-2.0 * half * profile[np.abs(away) < 1.0].mean() / (after - before))
    return np.array(found)


@pytest.mark.skipif(os.environ.get("FURBAKE_TEST_ALL") != "1", reason="minutes of tracing: npm test -- --all")
@pytest.mark.parametrize("combed", [False, True])
def test_edges_lie_where_the_tracer_has_them(combed: bool, tmp_path: Path) -> None:
    """Within half of a hair's spacing, RMS, upright and combed across the stripes.

    Combed, tips are a third of a tile off their roots: 1.5 if hairs that lie hid no more than others.
    """
    laid = {"sweep": "0.5"} if combed else {"coat.lean": "0,0"}
    white = {f"ramp.{name}": WHITE for name in ("root", "tip", "tip2")}
    options = replace(
        override(preset("paper"), laid | white), tile=TILE, lights=16, fins=False, colour_plane=False, tip_noise=0.0
    )
    bake(str(plane(tmp_path)), tmp_path / "baked", options)
    case = prepared(tmp_path / "baked", Options(size=400, spp=24), lambda stage, fraction: None, coloured=True)
    seen = frame(case.vertices, float(case.asset.fur["length"]), PLAN, 400, 0.8)
    strands = case.strands
    hairs = np.broadcast_to(0.8 * stripes(strands.points[:, 0, 2].astype(float))[:, None], strands.colour.shape)
    scene = Scene(strands, case.vertices, case.faces, 0.8, case.coat.skin, hairs.astype(np.float32))
    wanted = cells(PLAN, seen)
    truth = trace(scene, seen, wanted, 24)[0].light
    page = show(case.asset, 0.8, case.coat.skin, seen, wanted, ("ptm",), coloured=True).light[wanted[0].name, "ptm"]
    apart = edges(page, seen) - edges(truth, seen)
    unit = len(page) / 2 / np.tan(np.radians(seen.field) / 2) / seen.distance
    spacing = TILE * unit / np.sqrt(options.coat.guard.count + options.coat.under.count)
    print(f"{'combed' if combed else 'upright'}: {np.sqrt(np.mean(apart**2)) / spacing:.3f} of a hair's spacing")
    assert np.sqrt(np.mean(apart**2)) < 0.5 * spacing
