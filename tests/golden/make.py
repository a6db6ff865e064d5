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
from dataclasses import replace

import numpy as np
from bodies import emptied, golden_character, golden_regions, golden_roots
from expected import (
    BENDS,
    BENT_LIGHT,
    BENT_LIGHTS,
    BODIES,
    expected,
    expected_bent,
    expected_curves,
    expected_curves_bent,
    expected_curves_fin,
    expected_environment,
    expected_fin,
    expected_weather,
)
from pelts import golden_curves, golden_fin, golden_pelt, golden_states

from furbake.asset.gltf import FurModel, write_gltf
from furbake.surface.charts import laid
from furbake.surface.place.fins import build_fins
from furbake.surface.place.vertex_fur import VertexFur
from furbake.surface.shapes import builtin

VARIANTS = {"ptm-6": ("ptm", 6), "eigen-6": ("eigen", 6), "eigen-3": ("eigen", 3)}


WEATHERS = ((0.0, 0.0), (0.25, 0.0), (0.5, 0.0), (0.625, 0.0), (1.0, 0.0), (0.75, 1.0), (0.75, 0.5))


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


def main() -> None:
    """Write all variants anew."""
    lights = golden_lights()
    surface = builtin("plane")
    charts = surface.natural.charts(1.0)
    for name, (kind, count) in VARIANTS.items():
        folder = emptied(name)
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

    folder = emptied("ptm-6-curves")
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

    folder = emptied("states")
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
