"""Path-traced pictures for the lesson's figure of the rivals: a baked body under its lamps and the page's sky."""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from furbake.asset.planes import write_webp
from furbake.asset.stored import read_pelt, skin_colour
from furbake.daylight import PAGE, tone_mapped
from furbake.pelt.hairs.ramp import RGB
from furbake.pelt.texels.quantise import srgb_bytes
from furbake.study.verify.apart import trace
from furbake.study.verify.body import Options, prepared
from furbake.study.verify.cells import Cell, Floats, Frame, axes
from furbake.study.verify.colour import SHADE
from furbake.study.verify.truth import Scene, Traced

SIZE, SPP = 400, 256
"""Pixels of a side, and paths per pixel."""

QUALITY = 84
"""Quality of the stored picture, 0 to 100."""


@dataclass(frozen=True)
class View:
    """An eye and its lamps, as the lesson has them.

    azimuth, elevation, field : of the eye and of its picture's height, degrees; distance : radii of body and fur
    lamps : name → vector towards it, world axes; sky : share of the page's sky
    """

    azimuth: float
    elevation: float
    field: float
    distance: float
    lamps: dict[str, tuple[float, float, float]]
    sky: float

    @classmethod
    def read(cls, path: Path) -> View:
        """Read the lesson's own file."""
        found = json.loads(path.read_text(encoding="utf-8"))
        eye, lamps = found["eye"], {name: (x, y, z) for name, (x, y, z) in found["lamps"].items()}
        return cls(eye["azimuth"], eye["elevation"], eye["fieldOfView"], eye["distance"], lamps, found["sky"])


def lesson_pictures(folder: Path, view: View, size: int = SIZE, spp: int = SPP) -> dict[str, Floats]:
    """(size, size, 4) per lamp, row 0 on top: sRGB, tone-mapped as on the page, and coverage, 0..1.

    Hairs scatter in their own colours, the skin below them as on the page. Raises VerifyError where Mitsuba is missing,
    AssetError where the folder is no whole asset.
    """
    case = prepared(folder, Options(), lambda stage, fraction: None, coloured=True)
    ramp = read_pelt(case.asset).ramp
    colours = case.strands.colour / np.maximum(np.array(skin_colour(case.asset), np.float32), 1e-6)
    red, green, blue = (SHADE * part for part in ramp.root)
    ground = red, green, blue
    scene = Scene(
        case.strands, case.vertices, case.faces, case.coat.albedo, case.coat.skin, np.clip(colours, 0, 1), ground
    )
    radius = case.seen.radius + float(case.asset.fur["length"])
    seen = Frame(case.seen.centre, radius, view.distance * radius, size, size, view.field)
    eye = seen.centre + seen.distance * axes(view.azimuth, view.elevation)[2]
    cells = [Cell("lesson", name, eye, np.array(way) / np.linalg.norm(way)) for name, way in view.lamps.items()]
    lit = trace(scene, seen, cells, spp)
    sides = _radiance(PAGE.sky, view.sky), _radiance(PAGE.ground, view.sky)
    (sky,) = trace(replace(scene, sky=sides), seen, cells[:1], spp)
    return {cell.lamp: shown(one, sky) for cell, one in zip(cells, lit, strict=True)}


def _radiance(irradiance: RGB, share: float) -> RGB:
    red, green, blue = (share * part / np.pi for part in irradiance)
    return red, green, blue


def shown(lit: Traced, sky: Traced) -> Floats:
    """Picture of a lamp and the sky together, not premultiplied."""
    light = lit.light / (4 * np.pi) * np.array(PAGE.lamp) + sky.light
    cover = np.clip(lit.cover, 0, 1)
    colour = light / np.maximum(cover, 1 / 255)[..., None]
    return np.concatenate([srgb_bytes(tone_mapped(colour)) / 255.0, cover[..., None]], axis=-1)


def write_pictures(view: str, model: str, out: str) -> None:
    """Write OUT/LAMP.webp for every lamp of a view's file."""
    for name, picture in lesson_pictures(Path(model), View.read(Path(view))).items():
        write_webp(Path(out) / f"{name}.webp", np.round(picture * 255).astype(np.uint8), QUALITY)
