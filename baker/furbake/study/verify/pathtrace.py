"""Path-traced ground truth: the very strands of a tile, as diffuse fibres on black skin, seen from straight above.

Mitsuba 3 does the tracing (an optional extra); it knows nothing of slabs, optical depths or coefficients.
"""

from __future__ import annotations

import importlib
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import scipy.linalg
from numpy.typing import NDArray

from furbake.pelt.hairs.strands import Strands

Array = NDArray[np.float64]

DEPTH = 32
"""Vertices of the longest path: 2 is direct light only."""

TILES = 2
"""Tiles of hair on every side of the one that is seen, at least."""

THINNEST = 1e-6
"""Least radius of a hair, tile widths."""

SPECK = 1e-6
"""Radius of the last hair of a file, which no ray shall meet, and the length of its three pieces."""

LLVM, LLVM_COLOUR = "llvm_ad_mono", "llvm_ad_rgb"
"""Mitsuba's variants that compile what they render: in greys, and in colours."""

ABOVE = 8.0
"""Height of the orthographic camera above the skin, tile widths. Fur is at most 4 long."""

FAR = 1e4
"""Distance up to which a camera sees, tile widths."""

FIELD = 2
"""Side of what is seen of a field, tile widths."""


class VerifyError(ValueError):
    """A bake that cannot be verified; one sentence that says why, and what would help."""


def load(fast: bool = False, coloured: bool = False) -> Any:
    """Mitsuba, ready to render; fast : by LLVM, where its library is found. Raises VerifyError where it is missing."""
    try:
        mitsuba: Any = importlib.import_module("mitsuba")
    except ImportError as error:
        raise VerifyError(f"mitsuba: {error}, expected the optional extra: pip install 'furbake[verify]'") from error
    variant = LLVM_COLOUR if coloured else LLVM
    mitsuba.set_variant(variant if fast and _has_llvm(mitsuba, variant) else "scalar_rgb")
    mitsuba.set_log_level(mitsuba.LogLevel.Error)
    return mitsuba


def _has_llvm(mitsuba: Any, variant: str) -> bool:
    if variant not in mitsuba.variants():
        return False
    drjit: Any = importlib.import_module("drjit")
    return bool(drjit.has_backend(drjit.JitBackend.LLVM))


def control_points(strands: Strands) -> Array:
    """Cubic B-splines through every point and radius of the strands: (S, P + 2, 4) rows of u, v, z, radius.

    Three neighbours c of a uniform B-spline meet its knot at (c₋ + 4c + c₊)/6. Before the first and after the last
    point the spline goes straight on, so its ends are the strand's own.
    """
    points = np.concatenate([strands.points, strands.radius[..., None]], axis=-1)
    count, length, _ = points.shape
    bands = np.zeros((3, length))
    bands[0, 2:], bands[1], bands[2, :-2] = 1, 4, 1
    bands[1, [0, -1]] = 6
    along = np.moveaxis(6 * points, 1, 0).reshape(length, -1)
    inner = np.moveaxis(scipy.linalg.solve_banded((1, 1), bands, along).reshape(length, count, 4), 0, 1)
    first, last = 2 * inner[:, :1] - inner[:, 1:2], 2 * inner[:, -1:] - inner[:, -2:-1]
    control = np.concatenate([first, inner, last], axis=1)
    control[..., 3] = np.maximum(control[..., 3], THINNEST)
    return control


def tiles_around(strands: Strands, lowest: float) -> int:
    """Tiles on every side that can shade the one in the middle from a light whose sine of elevation is `lowest`."""
    height = float(strands.points[..., 2].max())
    aside = float(np.ptp(strands.points[..., :2] - strands.points[:, :1, :2], axis=(0, 1)).max())
    return max(TILES, int(np.ceil(height * np.sqrt(1 - lowest**2) / lowest + aside)))


def write_curves(path: Path, parts: Iterable[Array]) -> None:
    """Hairs as Mitsuba's text of curves: a line per control point, a gap per hair; parts : (S, P, 4) each.

    The last hair is a speck, too small for rays to meet. Mitsuba reads past the end of a file where a ray meets the
    very tip of its last piece: the more rays, the likelier is a segmentation fault.
    """
    at = np.zeros(3)
    with path.open("w", encoding="ascii") as file:
        for control in parts:
            line = "\n".join(["%.7g %.7g %.7g %.6g"] * control.shape[1]) + "\n"
            np.savetxt(file, control.reshape(len(control), -1), fmt=line)
            at = control[0, 0, :3]
        np.savetxt(file, [[*(at + k * SPECK), SPECK] for k in range(4)], fmt="%.9g")
        file.write("\n")


def write_tiles(path: Path, strands: Strands, around: int) -> None:
    """The strands of (2·around + 1)² tiles as `write_curves` does, tile by tile."""
    control, steps = control_points(strands), range(-around, around + 1)
    write_curves(path, (control + np.array([u, v, 0, 0]) for u in steps for v in steps))


@dataclass(frozen=True)
class View:
    """An orthographic camera at `origin` that sees `width` by `height` around `target`, tile widths."""

    origin: Array
    target: Array
    width: float
    height: float

    def placed(self, to: Any) -> Any:
        """Mitsuba's transform of it; to : its class of transforms"""
        upright = abs(self.origin[2] - self.target[2]) > (1 - 1e-6) * np.linalg.norm(self.origin - self.target)
        up = [0, 1, 0] if upright else [0, 0, 1]
        looking = to().look_at(origin=self.origin.tolist(), target=self.target.tolist(), up=up)
        return looking @ to().scale([self.width / 2, self.height / 2, 1])


FROM_ABOVE = View(np.array([0.5, 0.5, ABOVE]), np.array([0.5, 0.5, 0.0]), 1, 1)
"""One tile from straight above."""


@dataclass(frozen=True)
class Tracer:
    """Renders one tile, [0, 1)² in u and v, of the curves in a file.

    pixels : per side; row r of every image is v = (r + ½)/pixels, column c is u = (c + ½)/pixels, as in the planes
    samples : paths per pixel
    albedo : share of the light that a hair reflects
    """

    curves: Path
    around: int
    pixels: int
    samples: int
    albedo: float

    def lit(self, light: Array, depth: int = DEPTH, seed: int = 0) -> Array:
        """Radiance under a distant light of irradiance 1 towards `light`, a unit vector: (pixels, pixels)."""
        return self._render(_lamp(light), depth, seed)

    def covered(self, seed: int = 0) -> Array:
        """Share of every pixel that hides the skin, (pixels, pixels)."""
        return 1 - self._render({}, 1, seed, glow=1.0)

    def field(self, eye: Array, light: Array, height: float, seed: int = 0) -> float:
        """Mean radiance towards `eye` of fur without end under a distant light of irradiance 1; unit vectors.

        height : of the middle of what is seen, tile widths
        """
        middle = np.array([0.5, 0.5, height])
        view = View(middle + eye * (4 * self.around + ABOVE), middle, FIELD, FIELD * eye[2])
        return float(self._render(_lamp(light), DEPTH, seed, view=view).mean())

    def _render(
        self, lights: dict[str, Any], depth: int, seed: int, glow: float = 0.0, view: View | None = None
    ) -> Array:
        mitsuba = load()
        to = mitsuba.ScalarTransform4f
        side = self.around + 0.5
        skin: dict[str, Any] = {
            "type": "rectangle",
            "to_world": to().translate([0.5, 0.5, 0]) @ to().scale([side, side, 1]),
            "bsdf": {"type": "diffuse", "reflectance": _grey(0)},
        }
        if glow:
            skin["emitter"] = {"type": "area", "radiance": _grey(glow)}
        scene = {
            "type": "scene",
            "integrator": {"type": "path", "max_depth": depth, "rr_depth": 2 * DEPTH},
            "skin": skin,
            "fur": {
                "type": "bsplinecurve",
                "filename": str(self.curves),
                "bsdf": {"type": "diffuse", "reflectance": _grey(self.albedo)},
            },
            "eye": {
                "type": "orthographic",
                "to_world": (view or FROM_ABOVE).placed(to),
                "far_clip": FAR,
                "film": {
                    "type": "hdrfilm",
                    "width": self.pixels,
                    "height": self.pixels,
                    "pixel_format": "luminance",
                    "rfilter": {"type": "box"},
                },
                "sampler": {"type": "independent", "sample_count": self.samples},
            },
            **lights,
        }
        image = np.array(mitsuba.render(mitsuba.load_dict(scene), spp=self.samples, seed=seed), np.float64)
        # The camera's upper edge is the larger v.
        return np.ascontiguousarray(image[::-1, :, 0])


def _lamp(light: Array) -> dict[str, Any]:
    """A distant light of irradiance 1 towards a unit vector."""
    return {"lamp": {"type": "directional", "direction": [float(-x) for x in light], "irradiance": _grey(1)}}


def _grey(value: float) -> dict[str, Any]:
    return {"type": "rgb", "value": float(value)}
