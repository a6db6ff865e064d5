"""Path-traced truth: hairs on a body, diffuse on diffuse skin, under one lamp, over nothing."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from furbake.groom.ground import Ints
from furbake.groom.strands import Groom, Single
from furbake.pelt.hairs.ramp import RGB
from furbake.pelt.hairs.strands import Strands
from furbake.study.verify.cells import Cell, Floats, Frame
from furbake.study.verify.paint import write_painted
from furbake.study.verify.pathtrace import DEPTH, control_points, load, write_curves

ROULETTE = 6
"""Vertices after which a path may end by chance (Russian roulette)."""

HORIZON = 64
"""Rows of the sky's picture above the horizon, and below it."""

LANES = 4_000_000
"""Paths that are traced at once: LLVM keeps the state of all of them in memory."""


@dataclass(frozen=True)
class Scene:
    """Hairs and skin to be traced.

    vertices, faces : of the skin; albedo, skin : shares of the light that hairs and skin scatter back
    colours : (S, P, 3) linear, of the hairs' points, and `ground`, the skin's, in place of these; None: all is grey
    sky : radiance from above (y) and from below, in place of the lamp
    """

    groom: Groom
    vertices: Floats
    faces: Ints
    albedo: float
    skin: float
    colours: Single | None = None
    ground: RGB = (0.0, 0.0, 0.0)
    sky: tuple[RGB, RGB] | None = None


@dataclass(frozen=True)
class Traced:
    """A picture from the tracer, row 0 on top, (height, width) each; light in colours (height, width, 3).

    light : in the unit of L, 4π·radiance/(albedo·irradiance), in colours 4π·radiance/irradiance; of the sky, radiance
    cover : share of the pixel that hides what is behind
    halves : the light of either half of the paths, for its noise
    """

    light: Floats
    cover: Floats
    halves: tuple[Floats, Floats]


def trace(
    scene: Scene,
    seen: Frame,
    cells: list[Cell],
    spp: int,
    depth: int = DEPTH,
    step: Callable[[float], None] = lambda fraction: None,
    *,
    fast: bool = True,
) -> list[Traced]:
    """A picture of every cell, with `spp` paths a pixel; fast : by LLVM, where its library is found.

    Raises VerifyError where Mitsuba is missing.
    """
    coloured = scene.colours is not None
    mitsuba = load(fast, coloured)
    unit = 4 * np.pi / (1.0 if coloured else scene.albedo)
    with TemporaryDirectory(prefix="furbake-") as scratch:
        body = _shapes(mitsuba, scene, Path(scratch))
        found = []
        for number, cell in enumerate(cells):
            world = mitsuba.load_dict(
                {
                    "type": "scene",
                    "integrator": {
                        "type": "path",
                        "max_depth": depth,
                        "rr_depth": ROULETTE,
                        "hide_emitters": True,
                    },
                    "lamp": _lamp(cell, unit) if scene.sky is None else _sky(mitsuba, scene.sky),
                    "eye": _eye(mitsuba, seen, cell, coloured),
                    **body,
                }
            )
            found.append(_average(mitsuba, world, seen, spp))
            step((number + 1) / len(cells))
    return found


def splines(strands: Groom) -> Floats:
    """(S, P + 2, 4) control points of the hairs."""
    points, radius = strands.points.astype(np.float64), strands.radius.astype(np.float64)
    return control_points(Strands(points, radius, tint=radius, hue=radius))


def _shapes(mitsuba: Any, scene: Scene, scratch: Path) -> dict[str, Any]:
    """Skin and hairs, loaded."""
    _write_ply(scratch / "skin.ply", scene.vertices, scene.faces)
    skin = {"type": "ply", "filename": str(scratch / "skin.ply"), "face_normals": True}
    if scene.colours is not None:
        found = {"skin": mitsuba.load_dict(skin | {"bsdf": _painted(scene.ground)})}
        parts = write_painted(scratch, splines(scene.groom), scene.colours)
        for number, (path, colour) in enumerate(parts):
            hairs = {"type": "bsplinecurve", "filename": str(path), "bsdf": _painted(colour)}
            found[f"hairs{number}"] = mitsuba.load_dict(hairs)
        return found
    write_curves(scratch / "hairs.txt", [splines(scene.groom)])
    hairs = {"type": "bsplinecurve", "filename": str(scratch / "hairs.txt")}
    return {
        "skin": mitsuba.load_dict(skin | {"bsdf": _diffuse(scene.skin)}),
        "hairs": mitsuba.load_dict(hairs | {"bsdf": _diffuse(scene.albedo)}),
    }


def _write_ply(path: Path, vertices: Floats, faces: Ints) -> None:
    header = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\n"
        "property float x\nproperty float y\nproperty float z\n"
        f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    rows = np.empty(len(faces), [("count", "u1"), ("corner", "<i4", 3)])
    rows["count"], rows["corner"] = 3, faces
    path.write_bytes(header.encode() + vertices.astype("<f4").tobytes() + rows.tobytes())


def _lamp(cell: Cell, irradiance: float) -> dict[str, Any]:
    direction = [float(-x) for x in cell.to_lamp]
    return {"type": "directional", "direction": direction, "irradiance": _grey(irradiance)}


def _sky(mitsuba: Any, sides: tuple[RGB, RGB]) -> dict[str, Any]:
    """One radiance from above the horizon, another one from below it."""
    texels = np.repeat(np.array(sides, np.float32), HORIZON, axis=0)[:, None].repeat(4 * HORIZON, axis=1)
    return {"type": "envmap", "bitmap": mitsuba.Bitmap(np.ascontiguousarray(texels))}


def _eye(mitsuba: Any, seen: Frame, cell: Cell, coloured: bool) -> dict[str, Any]:
    to = mitsuba.ScalarTransform4f
    place = {"origin": cell.eye.tolist(), "target": seen.centre.tolist(), "up": [0, 1, 0]}
    return {
        "type": "perspective",
        "fov": seen.field,
        "fov_axis": "y",
        "near_clip": 0.01 * seen.distance,
        "far_clip": 10 * seen.distance,
        "to_world": to().look_at(**place),
        "film": {
            "type": "hdrfilm",
            "width": seen.width,
            "height": seen.height,
            "pixel_format": "rgba" if coloured else "luminance_alpha",
            "rfilter": {"type": "box"},
        },
        "sampler": {"type": "independent"},
    }


def _average(mitsuba: Any, world: Any, seen: Frame, spp: int) -> Traced:
    """An even number of passes, every other one in the other half."""
    passes = 2 * max(1, -(-spp * seen.width * seen.height // (2 * LANES)))
    each = max(1, spp // passes)
    sums: list[Any] = [0.0, 0.0]
    for number in range(passes):
        sums[number % 2] += np.array(mitsuba.render(world, spp=each, seed=number + 1), np.float64)
    one, two = (part / (passes / 2) for part in sums)
    both = (one + two) / 2
    if both.shape[-1] == 2:
        return Traced(both[..., 0], both[..., 1], (one[..., 0], two[..., 0]))
    return Traced(both[..., :3], both[..., 3], (one[..., :3], two[..., :3]))


def _diffuse(albedo: float) -> dict[str, Any]:
    return {"type": "diffuse", "reflectance": _grey(albedo)}


def _painted(colour: Iterable[float]) -> dict[str, Any]:
    return {"type": "diffuse", "reflectance": {"type": "rgb", "value": [float(part) for part in colour]}}


def _grey(value: float) -> dict[str, Any]:
    return {"type": "rgb", "value": float(value)}
