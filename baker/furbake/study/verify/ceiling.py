"""The best that shells could show: the samples' own composite without any fit, drawn by the page.

Compositing is linear in the light of the texels. So the samples of three directions are a colour plane's red, green and
blue, the share that each direction has in a vertex's light is its colour, and such passes, unlit, add up to the picture
that has every texel's light as it was sampled, linear between the directions. Fins are left out.
"""

from __future__ import annotations

import json
import shutil
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import Delaunay

from furbake.asset.planes import write_png
from furbake.asset.read import Asset
from furbake.asset.stored import read_pelt
from furbake.groom.ground import Floats, Ground, read_ground, read_skin
from furbake.groom.strands import recorded
from furbake.imported.stored import tile_strands
from furbake.pelt.hairs.volume import fine_shape, voxelise
from furbake.pelt.light.transport import LOWEST_FLAT, hemisphere, lowest
from furbake.pelt.texels.fill import fill
from furbake.pelt.texels.quantise import srgb_bytes
from furbake.study.verify.cells import Cell
from furbake.surface.mesh import Surface
from furbake.surface.place.thickness import distances
from furbake.tile.lighting import under

Single = NDArray[np.float32]

INNER, RIM = 84, 24
"""Directions on the sphere above the lowest light, and at its height."""

TOGETHER = 3
"""Directions in a pass: as many as a colour has channels."""

RAYS = 24
"""Rays to the lamp from the fur of a vertex, for the shade of other parts of the body."""

NEAR = 3.0
"""Lengths of the fur: what blocks a low lamp nearer than this is the place's own body, whose shade is sampled."""

LOW = 0.3
"""l·n below which a lamp is low."""


@dataclass(frozen=True)
class Ceiling:
    """Passes of the samples' own composite.

    samples : (n, K, N, N) light of the texels under n directions, a multiple of `TOGETHER`
    alpha : (K, N, N) of the texels
    shares : (cells, M, n) of each direction in the light at the M vertices of the shells, shadows of the body in them
    """

    samples: Single
    alpha: Floats
    shares: Single

    @property
    def white(self) -> float:
        """The brightest sample."""
        return float(self.samples.max())

    @property
    def passes(self) -> int:
        return len(self.samples) // TOGETHER


def directions(least: float) -> Floats:
    """(n, 3) unit vectors towards the lights that are sampled, the last ones in a ring at lz = `least`."""
    angle = 2 * np.pi * np.arange(RIM) / RIM
    level = np.sqrt(1 - least**2)
    ring = np.stack([level * np.cos(angle), level * np.sin(angle), np.full(RIM, least)], -1)
    return np.concatenate([hemisphere(INNER, lowest=least), ring])


def shares(lights: Floats, towards: Floats) -> Single:
    """(m, n) shares of n lights in one towards each of m unit vectors, linear on triangles between the lights.

    Shares sum to 1 down to the lowest of the lights; what is below it is dark.
    """
    least = float(lights[:, 2].min())
    plane = _flat(lights)
    seen = towards[:, 2] >= least
    # The ring is a polygon, which its circle leaves by a little.
    at = _flat(towards) * np.cos(np.pi / RIM) ** (np.linalg.norm(_flat(towards), axis=1) / _reach(least))[:, None]
    mesh = Delaunay(plane)
    found = mesh.find_simplex(at, tol=1e-9)
    seen &= found >= 0
    rows = np.flatnonzero(seen)
    turn = mesh.transform[found[rows]]
    two = np.einsum("mij,mj->mi", turn[:, :2], at[rows] - turn[:, 2])
    each = np.column_stack([two, 1 - two.sum(axis=1)])
    result = np.zeros((len(towards), len(lights)), np.float32)
    result[rows[:, None], mesh.simplices[found[rows]]] = np.clip(each, 0, 1)
    return result


def sampled_ceiling(asset: Asset, cells: Sequence[Cell]) -> Ceiling:
    """The passes of a baked folder in some cells, its fur sampled anew."""
    options, pelt = recorded(asset), read_pelt(asset)
    options = replace(options, layers=pelt.layers, size=pelt.size)
    strands = tile_strands(asset, options.coat, pelt.height, options.seed)
    fine = voxelise(strands, pelt.height, *fine_shape(pelt.layers, pelt.size, pelt.height), options.coat.opacity)
    lights = directions(LOWEST_FLAT if options.flat else lowest())
    ground = read_ground(asset, (1.0, 1.0, 1.0))
    vertices, faces = read_skin(asset)
    body = Surface(vertices, faces, np.zeros_like(vertices))
    return build(under(lights, fine, options), pelt.alpha / 255, lights, ground, body, cells)


def build(
    samples: Single, alpha: Floats, lights: Floats, ground: Ground, body: Surface, cells: Sequence[Cell]
) -> Ceiling:
    """The passes of a body's samples; samples : (n, K, N, N) under `lights` (n, 3)."""
    frames = np.stack([ground.tangents, ground.bitangents, ground.normals], axis=1)
    each = []
    for cell in cells:
        towards = frames @ cell.to_lamp
        towards /= np.linalg.norm(towards, axis=1, keepdims=True)
        each.append(shares(lights, towards) * visible(ground, body, cell.to_lamp)[:, None])
    return Ceiling(samples, alpha, np.stack(each).astype(np.float32))


def write_passes(ceiling: Ceiling, grey: Path, folder: Path) -> None:
    """A folder of the page's format for each pass, and the colours of its vertices: NN.f32, (cells, M, 3).

    grey : folder with the asset's grey copy
    """
    document: dict[str, Any] = json.loads((grey / "model.gltf").read_text("utf-8"))
    fur = document["extensions"]["FUR_ptm_shells"]
    pelt = fur["pelts"][0]
    document["images"].append({"name": "samples", "uri": "samples.png"})
    pelt["colour"] = len(document["images"]) - 1
    if "fin" in pelt:
        del pelt["fin"]
        fins = fur.pop("fins", None)
        fur.pop("edges", None)
        document["scenes"][0]["nodes"] = [node for node in document["scenes"][0]["nodes"] if node != fins]
    text = json.dumps(document)
    for number in range(ceiling.passes):
        part = slice(number * TOGETHER, (number + 1) * TOGETHER)
        place = folder / f"{number:02}"
        place.mkdir(parents=True)
        (place / "model.gltf").write_text(text, "utf-8")
        for name in (document["buffers"][0]["uri"], *(document["images"][i]["uri"] for i in pelt["planes"])):
            shutil.copyfile(grey / name, place / name)
        light = np.moveaxis(ceiling.samples[part] / ceiling.white, 0, -1).astype(np.float64)
        pixels = srgb_bytes(fill(np.clip(light, 0, 1), ceiling.alpha))
        write_png(place / "samples.png", pixels.reshape(-1, pixels.shape[2], TOGETHER), srgb=True)
        np.ascontiguousarray(ceiling.shares[..., part], "<f4").tofile(folder / f"{number:02}.f32")


def _flat(directions: Floats) -> Floats:
    """(n, 2) equal-area picture of the sphere (Lambert), the zenith in the middle."""
    level = np.maximum(np.linalg.norm(directions[:, :2], axis=1, keepdims=True), 1e-12)
    return np.asarray(directions[:, :2] / level * np.sqrt(np.maximum(1 - directions[:, 2:], 0)))


def _reach(least: float) -> float:
    return float(np.sqrt(1 - least))


def visible(ground: Ground, body: Surface, to_lamp: Floats) -> Floats:
    """(M,) share of the lamp that no other part of the body hides from the fur at a vertex."""
    chance = np.random.default_rng(0)
    count = len(ground.vertices)
    low = ground.normals @ to_lamp < LOW
    reach = np.maximum(ground.reach, 1e-3 * ground.reach.max())[:, None]
    lit = np.zeros(count)
    for i in range(RAYS):
        height = (0.3 + 0.7 * (i + 0.5) / RAYS) * reach
        aside = 0.5 * reach * chance.normal(size=(count, 3))
        aside -= ground.normals * np.einsum("ij,ij->i", aside, ground.normals)[:, None]
        origins = ground.vertices + height * ground.normals + aside
        far = distances(body, origins, np.broadcast_to(to_lamp, origins.shape))
        lit += ~np.isfinite(far) | (low & (far < NEAR * reach[:, 0]))
    return lit / RAYS
