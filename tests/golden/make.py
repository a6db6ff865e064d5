"""Writes the golden assets: the smallest whole ones, with lights and the light they must give.

    baker/.venv/bin/python tests/golden/make.py

Each folder is an asset as the baker writes it, over a flat unit square of one tile: 4 layers of 8 × 8 texels with
random coefficients, all of them covered. Beside it `lights.json` holds 64 unit vectors (a quarter of them below the
horizon) and `light.f32` the L of every texel, little-endian float32 [light, layer, row, column]. L is computed here in
plain loops over lights from the formulas of the format, sharing no code with either wing's evaluation.

`states` has three wet states and a dirty one. Its `weather.json` lists 16 of the lights, and weathers as wetness and
dirt; `weather.f32` has, for each of these, the red part of radiance · 4π of every texel under a lamp of irradiance 1:
[weather, light, layer, row, column]. The skin is white, so that is L times the hairs' shade, or the mud's.

`ptm-6` has fins, too: a quad on every edge and a side view of 16 × 8 random texels. `fin.f32` holds its L under the
same 64 vectors taken in the fin's frame as (l·t, l·w, l·n): [light, row, column]. `bent.f32` holds L of the top layer
where hairs are bent by each of `BENDS` (tips along T and B, shares of the length) under one light: [bend, row, column].

`ptm-6-curves` is of version 2.0: three random curves, random weights, a fur that leans aside of v, and fins. Its
`lights.json` has 32 vectors, some of them lower, and `bodies`: the radii β, in lengths of fur, for which `light.f32`
[body, light, layer, row, column] and `fin.f32` [body, light, row, column] are worked out. `bent.json` has two lights,
of which one is below the horizon: `bent.f32` is [body, light, bend, row, column] of its top layer. `environment.json`
has, for each body, the integrals over the sphere of harmonics × φ × curve: `shells` [body][curve][coefficient][9] and
`fins`, by plain sums over 640 × 256 directions.

`character` is of version 2.1: a coarse torus of two joints and two morph targets, with fins. `poses.json` has a clip
with seconds in it for each pose; `posed.f32` what plain sums make of the file then, scene space: [pose][number], for
skin, shells and fins one after the other the places of all vertices, their normals, and, but for the skin, tangents.

`regions` is of version 2.3: a square of 4 × 4 tiles with hairs one texel thick, the same fur on both sides of a border
that is half of its width. `regions-whole` is the same square in one fur. `regions-3` and `regions-4` have the fur three
and four times, all of them at once over all of the square: the coat is alone at the left, or at one corner.

`roots` is of version 2.3: the same square in one fur with fins, over a skin with a picture of black and white stripes.
"""

from __future__ import annotations

import json
import shutil
import sys
from dataclasses import replace
from io import BytesIO
from pathlib import Path

import numpy as np
from expected import (
    BENDS,
    BENT_LIGHT,
    BENT_LIGHTS,
    BODIES,
    LAYERS,
    SIZE,
    expected,
    expected_bent,
    expected_curves,
    expected_curves_bent,
    expected_curves_fin,
    expected_environment,
    expected_fin,
    expected_weather,
)
from PIL import Image

from furbake.asset.gltf import FurModel, write_gltf
from furbake.asset.regions.record import RegionFur, Regions
from furbake.asset.rig.motion import Motion
from furbake.pelt.curves import Curves
from furbake.pelt.hairs.ramp import Ramp
from furbake.pelt.hairs.states import PeltState
from furbake.pelt.pelt import FinPelt, Pelt
from furbake.pelt.texels.basis import Basis
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


VARIANTS = {"ptm-6": ("ptm", 6), "eigen-6": ("eigen", 6), "eigen-3": ("eigen", 3)}


STATES = (
    PeltState("moist", wetness=0.5, length=0.95, shade=0.8, gloss=1.5, sharpness=2.0),
    PeltState("wet", wetness=0.75, length=0.9, shade=0.7, gloss=2.0, sharpness=3.0),
    PeltState("soaked", wetness=1.0, length=0.85, shade=0.5, gloss=2.5, sharpness=4.0),
    PeltState("dirty", dirt=1.0, mud=(0.25, 0.2, 0.1)),
)


WEATHERS = ((0.0, 0.0), (0.25, 0.0), (0.5, 0.0), (0.625, 0.0), (1.0, 0.0), (0.75, 1.0), (0.75, 0.5))


def golden_states() -> list[Pelt]:
    """The dry pelt and those of `STATES`, of the same λ and Ω; each with a fin."""
    dry = replace(golden_pelt("ptm", 6), fin=golden_fin())
    pelts = [dry]
    for i, state in enumerate(STATES):
        rng = np.random.default_rng([7, i])
        shape = dry.codes.shape
        tint = rng.integers(0, 256, shape[:3], dtype=np.uint8) if state.dirt else dry.tint
        codes = rng.integers(0, 256, shape, dtype=np.uint8)
        fin = replace(golden_fin(10 + i), scale=dry.fin.scale, bias=dry.fin.bias)
        pelts.append(replace(dry, codes=codes, tint=tint, fin=fin, state=state))
    return pelts


def golden_fin(seed: int = 8) -> FinPelt:
    """A side view of random bytes, covered less and less from root to tip."""
    rng = np.random.default_rng(seed)
    shape = (8, 16)
    return FinPelt(
        codes=rng.integers(0, 256, (*shape, 6), dtype=np.uint8),
        alpha=np.repeat(np.arange(255, 0, -32, dtype=np.uint8)[:, None], 16, axis=1),
        tint=np.full(shape, 255, np.uint8),
        colour=None,
        scale=rng.uniform(0.004, 0.012, 6),
        bias=rng.uniform(60, 130, 6),
    )


def golden_pelt(kind: str, count: int) -> Pelt:
    """A pelt of random bytes whose light lies around 0..3."""
    rng = np.random.default_rng([count, len(kind)])
    matrix = rng.normal(0, 0.5, (count, 27)) if kind == "eigen" else None
    basis = Basis("ptm") if matrix is None else Basis("eigen", 4, matrix)
    shape = (LAYERS, SIZE, SIZE)
    return Pelt(
        codes=rng.integers(0, 256, (*shape, count), dtype=np.uint8),
        alpha=np.full(shape, 255, np.uint8),
        tint=np.full(shape, 255, np.uint8),
        colour=None,
        scale=rng.uniform(0.004, 0.012, count),
        bias=rng.uniform(60, 130, count),
        basis=basis,
        drift=np.stack([np.zeros(LAYERS), np.linspace(0, 0.2, LAYERS)], -1),
        height=0.5,
        ramp=Ramp((1.0, 1.0, 1.0), (1.0, 1.0, 1.0), (1.0, 1.0, 1.0), 1.0),
    )


def golden_curves(pelt: Pelt) -> Pelt:
    """The pelt with three random curves and random weights, light up to about 3, and a lean of (3, 4) parts."""
    rng = np.random.default_rng(17)
    x = np.arange(17)
    rise = np.where(x == 0, 0, (x / 16) ** rng.uniform(0.5, 3, (3, 3, 1)))
    even = rise * rng.uniform(0.5, 1, (3, 3, 17))
    along = np.minimum(x, 16 - x) / 8 * even * rng.uniform(-0.8, 0.8, (3, 3, 1))
    tables = (np.array([float(f"{value:.4g}") for value in part.ravel()]).reshape(3, 3, 17) for part in (even, along))
    weights = np.round(rng.uniform(0.1, 0.7, (LAYERS, 3)), 4)
    drift = np.linspace(0, 0.2, LAYERS)[:, None] * [0.6, 0.8]
    return replace(pelt, drift=drift, curves=Curves(*tables, np.array([0.6, 0.8])), weights=weights)


def lower_lights() -> np.ndarray:
    """20 unit vectors above the horizon and 12 below, down to where no tip sees them."""
    rng = np.random.default_rng(32)
    z = np.concatenate([rng.uniform(0.0001, 1, 20), rng.uniform(-0.9, -0.001, 12)])
    azimuth = rng.uniform(0, 2 * np.pi, 32)
    across = np.sqrt(1 - z * z)
    return np.stack([across * np.cos(azimuth), across * np.sin(azimuth), z], -1)


def golden_lights() -> np.ndarray:
    """48 unit vectors above the horizon and 16 below, down to where no tip sees the light any more."""
    rng = np.random.default_rng(64)
    z = np.concatenate([rng.uniform(0.01, 1, 48), rng.uniform(-0.7, -0.001, 16)])
    azimuth = rng.uniform(0, 2 * np.pi, 64)
    across = np.sqrt(1 - z * z)
    return np.stack([across * np.cos(azimuth), across * np.sin(azimuth), z], -1)


def golden_character() -> None:
    """Write the character with its poses."""
    folder = HERE / "character"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
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
        folder = HERE / name
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
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
    folder = HERE / "roots"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    fur = replace(VertexFur.even(len(every)), colour=np.full((len(every), 3), 0.5))
    write_gltf(folder, FurModel(surface, charts, fur, (pelt,), 0.125, fins, roots=roots))


def main() -> None:
    """Write all variants anew."""
    lights = golden_lights()
    surface = builtin("plane")
    charts = surface.natural.charts(1.0)
    for name, (kind, count) in VARIANTS.items():
        folder = HERE / name
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        pelt = golden_pelt(kind, count)
        fur, fins = VertexFur.even(len(surface.vertices)), None
        if kind == "ptm":
            pelt = replace(pelt, fin=golden_fin())
            fins = build_fins(surface, laid(charts, surface.normals), 1.0, 0.2)
            expected_fin(pelt.fin, lights).astype("<f4").tofile(folder / "fin.f32")
            expected_bent(pelt).astype("<f4").tofile(folder / "bent.f32")
            (folder / "bent.json").write_text(json.dumps({"bends": BENDS, "light": BENT_LIGHT}) + "\n", "utf-8")
        write_gltf(folder, FurModel(surface, charts, fur, (pelt,), 0.5, fins))
        (folder / "lights.json").write_text(json.dumps(lights.tolist()) + "\n", "utf-8")
        expected(pelt, lights).astype("<f4").tofile(folder / "light.f32")

    folder = HERE / "ptm-6-curves"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    lights = lower_lights()
    pelt = golden_curves(replace(golden_pelt("ptm", 6), fin=golden_fin()))
    fins = build_fins(surface, laid(charts, surface.normals), 1.0, 0.2)
    write_gltf(folder, FurModel(surface, charts, VertexFur.even(len(surface.vertices)), (pelt,), 0.5, fins))
    told = {"bodies": BODIES, "lights": lights.tolist()}
    (folder / "lights.json").write_text(json.dumps(told) + "\n", "utf-8")
    bends = {"bends": BENDS, "lights": BENT_LIGHTS}
    (folder / "bent.json").write_text(json.dumps(bends) + "\n", "utf-8")
    (folder / "environment.json").write_text(json.dumps(expected_environment(pelt)) + "\n", "utf-8")
    expected_curves(pelt, lights).astype("<f4").tofile(folder / "light.f32")
    expected_curves_bent(pelt).astype("<f4").tofile(folder / "bent.f32")
    expected_curves_fin(pelt, lights).astype("<f4").tofile(folder / "fin.f32")

    folder = HERE / "states"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    pelts = golden_states()
    fins = build_fins(surface, laid(charts, surface.normals), 1.0, 0.2)
    fur = VertexFur.even(len(surface.vertices))
    write_gltf(folder, FurModel(surface, charts, fur, tuple(pelts), 0.5, fins))
    few = golden_lights()[::4]
    weathers = [{"wetness": wetness, "dirt": dirt} for wetness, dirt in WEATHERS]
    (folder / "weather.json").write_text(json.dumps({"lights": few.tolist(), "weathers": weathers}) + "\n", "utf-8")
    radiance = [expected_weather(pelts, wetness, dirt, few) for wetness, dirt in WEATHERS]
    np.stack(radiance).astype("<f4").tofile(folder / "weather.f32")
    golden_character()
    golden_regions()
    golden_roots()


if __name__ == "__main__":
    main()
