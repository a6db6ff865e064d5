"""Golden assets on bodies of their own: a character, furs side by side, and a picture of the roots."""

from __future__ import annotations

import json
import shutil
import sys
from dataclasses import replace
from io import BytesIO
from pathlib import Path

import numpy as np
from expected import SIZE
from pelts import golden_curves, golden_fin, golden_pelt
from PIL import Image

from furbake.asset.gltf import FurModel, write_gltf
from furbake.asset.regions.record import RegionFur, Regions
from furbake.asset.rig.motion import Motion
from furbake.pelt.pelt import Pelt
from furbake.surface.charts import Charts, laid
from furbake.surface.material import CLAMP, Material, Picture, Skin
from furbake.surface.mesh import Surface
from furbake.surface.place.fins import build_fins
from furbake.surface.place.shares import bounds
from furbake.surface.place.vertex_fur import VertexFur
from furbake.surface.rig.follow import follow
from furbake.surface.roots.picture import picture_of_roots
from furbake.surface.shapes import builtin

HERE = Path(__file__).parent
sys.path.append(str(HERE.parent / "baker"))
from helpers.arms import ring  # noqa: E402
from helpers.moving import Moving  # noqa: E402

BORDER = (0.25, 0.75)
"""Share of the width of `regions` at which its second fur begins, and from which it is alone."""

STRIPES = 8
"""Number of stripes across the picture of `roots`."""

POSES = ((0, 0.0), (0, 0.2), (0, 0.5), (0, 0.8))


def emptied(name: str) -> Path:
    """The folder of an asset, without what an earlier run has left."""
    folder = HERE / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    return folder


def golden_character() -> None:
    """Write the character with its poses."""
    folder = emptied("character")
    surface, rig = ring()
    charts = surface.natural.charts(0.5)
    pelt = golden_curves(replace(golden_pelt("ptm", 6), fin=golden_fin()))
    fins = build_fins(surface, laid(charts, surface.normals), 0.5, 0.2)
    follows = follow(rig, surface.vertices, surface.normals)
    comb = 0.4 * laid(charts, surface.normals)
    fur = replace(VertexFur.even(len(surface.vertices)), comb=comb)
    motion = Motion(rig, follows, follows)
    write_gltf(folder, FurModel(surface, charts, fur, (pelt,), 0.2, fins, motion=motion))
    found = Moving(folder / "model.gltf")
    poses = [found.clip(clip, seconds) for clip, seconds in POSES]
    parts = [[found.posed(node, pose=pose, skin=0) for node in range(3)] for pose in poses]
    numbers = [[values.ravel() for part in pose for values in part.values()] for pose in parts]
    np.stack([np.concatenate(row) for row in numbers]).astype("<f4").tofile(folder / "posed.f32")
    told = [{"clip": clip, "seconds": seconds} for clip, seconds in POSES]
    (folder / "poses.json").write_text(json.dumps(told) + "\n", "utf-8")


def square() -> tuple[Surface, Charts, Pelt]:
    """A square of 4 × 4 tiles, and fur for it with hairs one texel thick."""
    surface = builtin("plane:16x16")
    charts = surface.natural.charts(0.25)
    pelt = golden_curves(golden_pelt("ptm", 6))
    grown = np.random.default_rng(9).random((SIZE, SIZE)) < 0.7
    steps = np.rint(pelt.drift * SIZE).astype(int)
    alpha = np.stack([np.roll(grown, (v, u), (0, 1)) for u, v in steps]) * np.uint8(230)
    return surface, charts, replace(pelt, alpha=alpha)


def golden_regions() -> None:
    """Write a square of two, three and four furs, and the same in one."""
    surface, charts, pelt = square()
    x, y = (surface.vertices - surface.vertices.min(axis=0))[:, [0, 2]].T / np.ptp(surface.vertices[:, 0])
    furs = {
        "regions-whole": [],
        "regions": [np.clip((x - BORDER[0]) / (BORDER[1] - BORDER[0]), 0, 1)],
        "regions-3": [x * y, x * (1 - y)],
        "regions-4": [x * y, (1 - x) * (1 - y), x * (1 - y)],
    }
    fur = VertexFur.even(len(surface.vertices))
    for name, shares in furs.items():
        folder = emptied(name)
        beside = tuple(RegionFur(name, 1.0, (pelt,)) for name in ("right", "far", "corner")[: len(shares)])
        regions = Regions(bounds(shares), 0.25, beside) if shares else None
        write_gltf(folder, FurModel(surface, charts, fur, (pelt,), 0.125, regions=regions))


def golden_roots() -> None:
    """Write a square whose skin has a picture of upright stripes, black and white, `STRIPES` in all."""
    surface, charts, pelt = square()
    pelt = replace(pelt, fin=golden_fin())
    stripes = np.repeat(np.tile(np.array([[[0], [255]]], np.uint8), (4, STRIPES // 2, 3)), 8, axis=1)
    stream = BytesIO()
    Image.fromarray(stripes).save(stream, "PNG")
    x = (surface.vertices[:, 0] - surface.vertices[:, 0].min()) / np.ptp(surface.vertices[:, 0])
    uv = np.stack([x, np.full(len(x), 0.5)], axis=-1)
    material = Material(picture=Picture(stream.getvalue(), "image/png"), wrap=(CLAMP, CLAMP))
    every = np.arange(len(surface.vertices))
    surface = replace(surface, skin=(Skin(material, every, surface.faces, uv),))
    roots = picture_of_roots(surface, surface, charts, pelt.drift[-1], SIZE)
    fins = build_fins(surface, laid(charts, surface.normals), 0.25, 0.2)
    folder = emptied("roots")
    fur = replace(VertexFur.even(len(every)), colour=np.full((len(every), 3), 0.5))
    write_gltf(folder, FurModel(surface, charts, fur, (pelt,), 0.125, fins, roots=roots))
