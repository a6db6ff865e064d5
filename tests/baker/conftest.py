"""Builders that several tests share. Everything is seeded: a test that fails once fails always."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

# One thread for algebra, before NumPy reads it: matrices here are small, and threads that wait for each other on cores
# that other tests use take ten times as long.
for library in ("OPENBLAS", "OMP", "MKL"):
    os.environ.setdefault(f"{library}_NUM_THREADS", "1")

# Tests run beside each other; threads of so small a bake take a third longer than one of them.
os.environ.setdefault("FURBAKE_THREADS", "1")

os.environ["FURBAKE_CACHE"] = ""  # no test reads or writes the user's cache

import hypothesis  # noqa: E402
import numpy as np  # noqa: E402
import pytest  # noqa: E402

from furbake import BakeOptions, cli  # noqa: E402
from furbake.pelt.hairs.ramp import Ramp  # noqa: E402
from furbake.pelt.hairs.strands import Coat, Hairs  # noqa: E402
from furbake.pelt.pelt import Pelt  # noqa: E402
from furbake.pelt.texels.basis import PTM, Basis  # noqa: E402

hypothesis.settings.register_profile("repeatable", deadline=None, derandomize=True, database=None, max_examples=40)
hypothesis.settings.load_profile("repeatable")

TINY = ("--layers", "4", "--size", "8", "--lights", "8", "--quiet")


@dataclass(frozen=True)
class Outcome:
    """Result of a run of the command: exit status and both streams."""

    status: int
    out: str
    err: str


STARTS: dict[str, Any] = {}
"""State of each module's RNG before its first test."""


@pytest.fixture(autouse=True)
def same_numbers(request: pytest.FixtureRequest) -> None:
    """Start a module's RNG anew for each test: its numbers do not depend on the tests before it."""
    rng = getattr(request.module, "RNG", None)
    if rng is not None:
        rng.bit_generator.state = STARTS.setdefault(request.module.__name__, rng.bit_generator.state)


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str]) -> Callable[..., Outcome]:
    """Run the command in this process: run("bake", "torus", "-o", folder)."""

    def call(*args: object) -> Outcome:
        capsys.readouterr()
        status = cli.main([str(arg) for arg in args])
        streams = capsys.readouterr()
        return Outcome(status, streams.out, streams.err)

    return call


@pytest.fixture
def tiny() -> BakeOptions:
    """Options of a bake that takes a fraction of a second."""
    hairs = Hairs(count=12)
    return BakeOptions(layers=4, size=8, lights=8, coat=Coat(guard=hairs, under=hairs, clumps=3))


@pytest.fixture
def make_pelt() -> Callable[..., Pelt]:
    """A valid pelt of random bytes: make_pelt(layers=4, size=8, coefficients=6, kind="ptm", colour=True)."""

    def build(
        layers: int = 4,
        size: int = 8,
        coefficients: int = 6,
        kind: Any = "ptm",
        colour: bool = True,
        direction: bool = False,
        seed: int = 0,
    ) -> Pelt:
        chance = np.random.default_rng(seed)
        texels = (layers, size, size)

        def noise(*shape: int) -> np.ndarray[Any, np.dtype[np.uint8]]:
            return chance.integers(0, 256, shape, dtype=np.uint8)

        return Pelt(
            codes=noise(*texels, coefficients),
            alpha=noise(*texels),
            tint=noise(*texels),
            colour=noise(*texels, 3) if colour else None,
            scale=chance.uniform(0.001, 0.02, coefficients),
            bias=chance.uniform(-20, 200, coefficients),
            basis=Basis("eigen", 4, chance.normal(size=(coefficients, 27))) if kind == "eigen" else PTM,
            drift=chance.normal(size=(layers, 2)),
            height=0.6,
            ramp=Ramp(),
            direction=noise(*texels, 3) if direction else None,
        )

    return build


@pytest.fixture
def write_obj(tmp_path: Path) -> Callable[..., Path]:
    """Write vertices and faces (from 0) as an .obj file."""

    def write(vertices: Any, faces: Any, name: str = "mesh.obj") -> Path:
        lines = [f"v {x} {y} {z}" for x, y, z in vertices] + [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in faces]
        path = tmp_path / name
        path.write_text("\n".join(lines) + "\n")
        return path

    return write


@pytest.fixture
def cube() -> tuple[np.ndarray[Any, Any], np.ndarray[Any, Any]]:
    """A unit cube of 12 triangles, wound outward."""
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return corners, np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])
