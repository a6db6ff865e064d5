"""The page's own pictures of a baked body: a job for the browser, through Node, and its results."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from numpy.typing import NDArray

from furbake.asset.planes import read_png, write_png
from furbake.asset.read import Asset, inside
from furbake.page import draw
from furbake.study.verify.ceiling import Ceiling, write_passes
from furbake.study.verify.cells import FIELD_OF_VIEW, Cell, Floats, Frame

SAMPLES = "samples"
"""Method whose light is that of the samples themselves."""

TINT = 3
"""Channel of a second plane that has the hairs' shade."""


@dataclass(frozen=True)
class Shown:
    """Pictures of the page, row 0 on top, (height, width) each.

    light : by cell and method, in the unit of L; cover : of the same, 0..1
    normal : by view, (height, width, 3) of the skin, NaN where there is none; feature : by view, whether an eye or the
        like is seen
    """

    light: dict[tuple[str, str], Floats]
    cover: dict[tuple[str, str], Floats]
    normal: dict[str, Floats]
    feature: dict[str, NDArray[np.bool_]]


def show(
    asset: Asset,
    albedo: float,
    skin: float,
    seen: Frame,
    cells: Sequence[Cell],
    methods: Sequence[str],
    step: Callable[[float], None] = lambda fraction: None,
    ceiling: Ceiling | None = None,
    coloured: bool = False,
    look: tuple[float, float] = (0.0, 0.0),
) -> Shown:
    """The pictures of all cells by all methods. Raises PageError where there is no Node, no browser or a failure.

    albedo, skin : as of the tracer's hairs and skin
    ceiling : passes of a further method, `SAMPLES`
    coloured : hairs have their own colours; light then is (height, width, 3)
    look : strength of highlights and of light from behind, which are not baked
    """
    with TemporaryDirectory(prefix="furbake-") as scratch:
        folder = Path(scratch)
        (folder / "baked").mkdir()
        if coloured:
            coloured_copy(asset, folder / "baked")
        else:
            grey_copy(asset, folder / "baked", albedo, skin)
        job = {
            "width": seen.width,
            "height": seen.height,
            "fieldOfView": FIELD_OF_VIEW,
            "centre": seen.centre.tolist(),
            "radius": seen.radius,
            "irradiance": 4 * np.pi / (1.0 if coloured else albedo),
            "cells": [
                {"name": cell.name, "view": cell.view, "eye": cell.eye.tolist(), "lamp": cell.to_lamp.tolist()}
                for cell in cells
            ],
            "methods": list(methods),
            "coloured": coloured,
            "gloss": look[0],
            "backlight": look[1],
            "passes": 0 if ceiling is None else ceiling.passes,
            "brightest": 0.0 if ceiling is None else ceiling.white,
        }
        if ceiling is not None:
            write_passes(ceiling, folder / "baked", folder / "baked" / "passes")
        (folder / "job.json").write_text(json.dumps(job), "utf-8")
        draw("verify.mjs", ["--job", str(folder)], "the page's part of --body", step)
        return _read(folder, seen, cells, methods if ceiling is None else (*methods, SAMPLES), 4 if coloured else 2)


def grey_copy(asset: Asset, folder: Path, albedo: float, skin: float) -> None:
    """The dry fur of a baked folder with all hairs of one grey and the skin of another, without pictures."""
    document: dict[str, Any] = json.loads(json.dumps(asset.document))
    fur = next(iter(value for key, value in document["extensions"].items() if key == "FUR_ptm_shells"))
    fur.pop("roots", None)
    for mesh in document["meshes"]:
        for primitive in mesh["primitives"]:
            primitive["attributes"].pop("COLOR_0", None)
    for name in ("textures", "samplers"):
        document.pop(name, None)
    for own in _furs(fur):
        pelt = own["pelts"][0]
        own["pelts"] = [pelt]
        if "multiple" in pelt:
            pelt["multiple"]["tint"] = [1.0] * fur["layers"]
            pelt["multiple"].pop("colour", None)
        own["ramp"] |= {name: [albedo] * 3 for name in ("root", "tip", "tip2")}
        for part in (pelt, pelt.get("fin", {})):
            part.pop("colour", None)
            for number, image in enumerate(part.get("planes", [])):
                uri = document["images"][image]["uri"]
                pixels = read_png(inside(asset.folder, uri))
                if number == 1:
                    pixels[..., TINT] = 255
                write_png(folder / uri, pixels)
        if "direction" in pelt:
            uri = document["images"][pelt["direction"]]["uri"]
            shutil.copyfile(inside(asset.folder, uri), folder / uri)
    _plain(document, skin)
    (folder / document["buffers"][0]["uri"]).write_bytes(asset.data)
    (folder / "model.gltf").write_text(json.dumps(document), "utf-8")


def coloured_copy(asset: Asset, folder: Path) -> None:
    """The dry fur of a baked folder in its own colours and those of the skin below it, on a white skin."""
    document: dict[str, Any] = json.loads(json.dumps(asset.document))
    fur = next(iter(value for key, value in document["extensions"].items() if key == "FUR_ptm_shells"))
    images: set[int] = set()
    for own in _furs(fur):
        pelt = own["pelts"][0]
        own["pelts"] = [pelt]
        for part in (pelt, pelt.get("fin", {})):
            images |= {*part.get("planes", []), *(part[role] for role in ("colour", "direction") if role in part)}
    if "roots" in fur:
        images.add(document["textures"][fur["roots"]["texture"]]["source"])
    for image in images:
        uri = document["images"][image]["uri"]
        shutil.copyfile(inside(asset.folder, uri), folder / uri)
    for primitive in document["meshes"][document["nodes"][fur["skin"]]["mesh"]]["primitives"]:
        primitive["attributes"].pop("COLOR_0", None)
    _plain(document, 1.0)
    (folder / document["buffers"][0]["uri"]).write_bytes(asset.data)
    (folder / "model.gltf").write_text(json.dumps(document), "utf-8")


def _furs(fur: dict[str, Any]) -> list[dict[str, Any]]:
    """The coat and the furs of its regions, as an asset stores them."""
    return [fur, *fur.get("regions", {"furs": []})["furs"]]


def _plain(document: dict[str, Any], skin: float) -> None:
    """Give the skin of a model one grey and no pictures; nothing moves it out of the bind pose."""
    plain = {"baseColorFactor": [skin, skin, skin, 1.0], "metallicFactor": 0.0, "roughnessFactor": 1.0}
    document["materials"] = [{"pbrMetallicRoughness": plain} for _ in document.get("materials", [])]
    document.pop("animations", None)
    for node in document["nodes"]:
        node.pop("skin", None)
    for mesh in document["meshes"]:
        mesh.pop("weights", None)


def _read(folder: Path, seen: Frame, cells: Sequence[Cell], methods: Sequence[str], channels: int) -> Shown:
    def picture(name: str, channels: int) -> Floats:
        """Row 0 on top."""
        floats = np.fromfile(folder / f"{name}.f32", "<f4").astype(np.float64)
        return floats.reshape(seen.height, seen.width, channels)[::-1]

    pairs = {(cell.name, method): picture(f"{cell.name}.{method}", channels) for cell in cells for method in methods}
    views = dict.fromkeys(cell.view for cell in cells)
    normals = {view: picture(f"{view}.normals", 4) for view in views}
    return Shown(
        light={key: pair[..., 0] if channels == 2 else pair[..., :3] for key, pair in pairs.items()},
        cover={key: pair[..., -1] for key, pair in pairs.items()},
        normal={view: np.where(n[..., 3:] > 0.5, n[..., :3], np.nan) for view, n in normals.items()},
        feature={view: picture(f"{view}.features", 2)[..., 1] > 0.5 for view in views},
    )
