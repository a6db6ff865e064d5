"""Cycles as the tracer of hairs on a body, in a Python of its own that has Blender in it."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from furbake.study.verify.cells import Cell, Frame
from furbake.study.verify.pathtrace import VerifyError
from furbake.study.verify.truth import Scene, Traced

RENDER = Path(__file__).with_name("render.py")

INSTALL = "pip install bpy==4.5.*, in a Python 3.11"
"""How Blender comes as a Python package."""

UNIT = 4 * np.pi
"""Irradiance over the albedo by which pictures are in the unit of L."""


def trace(
    scene: Scene,
    seen: Frame,
    cells: list[Cell],
    spp: int,
    step: Callable[[float], None] = lambda fraction: None,
    *,
    python: str,
) -> list[Traced]:
    """Pictures as of `truth.trace`, with the same strands, skin, eyes and lamps, by Cycles.

    python : interpreter that can import `bpy`. Raises VerifyError where it cannot, or where Blender fails.
    """
    _check(python)
    half = max(1, spp // 2)
    with TemporaryDirectory(prefix="furbake-") as scratch:
        folder = Path(scratch)
        np.savez(
            folder / "job.npz",
            points=scene.groom.points, radius=scene.groom.radius,
            vertices=scene.vertices, faces=scene.faces,
            albedo=scene.albedo, skin=scene.skin, irradiance=UNIT / scene.albedo,
            size=[seen.width, seen.height], field=seen.field, centre=seen.centre, distance=seen.distance,
            eyes=[cell.eye for cell in cells], lamps=[cell.to_lamp for cell in cells], spp=half,
        )  # fmt: skip
        try:
            subprocess.run(  # noqa: S603
                [_absolute(python), str(RENDER)], check=True, capture_output=True, text=True, cwd=scratch
            )
        except subprocess.CalledProcessError as error:
            last = (error.stderr.strip() or error.stdout.strip() or "no word").splitlines()[-1]
            raise VerifyError(f"cycles: {last}, expected pictures of {len(cells)} cells") from None
        step(1.0)
        return [_traced(folder, number) for number in range(len(cells))]


def _absolute(python: str) -> str:
    """Path of a program that holds in other folders, too; a name alone is looked up as before."""
    return str(Path(python).absolute()) if Path(python).name != python else python


def _check(python: str) -> None:
    """Raise VerifyError where this Python has no Blender."""
    try:
        subprocess.run([python, "-c", "import bpy"], check=True, capture_output=True, text=True)  # noqa: S603
    except OSError as error:
        raise VerifyError(
            f"cycles: {python}: {(error.strerror or str(error)).lower()}, expected a Python with Blender ({INSTALL})"
        ) from None
    except subprocess.CalledProcessError as error:
        why = (error.stderr.strip() or "it ended").splitlines()[-1]
        raise VerifyError(f"cycles: {python}: {why}, expected Blender in it ({INSTALL})") from None


def _traced(folder: Path, number: int) -> Traced:
    """One picture of two halves, row 0 on top."""
    one, two = (np.load(folder / f"{number}-{half}.npy").astype(np.float64)[::-1] for half in range(2))
    both = (one + two) / 2
    light = (one[..., :3].mean(axis=-1), two[..., :3].mean(axis=-1))
    return Traced((light[0] + light[1]) / 2, both[..., 3], light)
