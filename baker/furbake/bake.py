"""The pipeline: from a mesh and options to a folder, one call per stage, in reading order."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass, field, replace
from importlib.metadata import version
from pathlib import Path
from typing import Any

from furbake.asset.gltf import write_gltf
from furbake.asset.store import atomic_file, atomic_folder
from furbake.body import prepare
from furbake.identity import bake_key, describe_input, library_versions
from furbake.options import BakeOptions
from furbake.pelt.bent import fit_bends
from furbake.pelt.eye import fit_eye
from furbake.pelt.states import Fur, chosen, in_state
from furbake.pelt.strands import grow
from furbake.pelt.volume import Volume
from furbake.sides import fit_sides
from furbake.surface.fins import build_fins
from furbake.tile import fit_pelts, parts, sampled, write_samples

STAGES = ("mesh", "strands", "volume", "light", "fit", "fins", "write")

Progress = Callable[[str, float], None]


@dataclass(frozen=True)
class BakeResult:
    """Where the asset is, what `bake.json` says, and what is not stored: seconds of every stage, what was repaired."""

    folder: Path
    record: dict[str, Any]
    seconds: dict[str, float]
    notices: tuple[str, ...] = ()


@dataclass
class _Clock:
    """Tells the caller which stage has begun, and times it."""

    progress: Progress
    seconds: dict[str, float] = field(default_factory=dict)

    @contextmanager
    def stage(self, name: str) -> Iterator[Callable[[float], None]]:
        start = time.perf_counter()
        self.progress(name, 0.0)
        yield lambda fraction: self.progress(name, fraction)
        self.seconds[name] = time.perf_counter() - start
        self.progress(name, 1.0)


def bake(
    model: str,
    out: Path,
    options: BakeOptions | None = None,
    *,
    force: bool = False,
    samples: Path | None = None,
    progress: Progress = lambda stage, fraction: None,
) -> BakeResult:
    """Bake `model` (a file or the name of a built-in shape) into the folder `out`, whole or not at all.

    samples : optional file for the physics itself, for others to check
    progress : called with a stage of `STAGES` and the fraction of it that is done

    Raises OptionError, MeshError or StoreError, each with one sentence.
    """
    options = options or BakeOptions()
    options.check()
    clock = _Clock(progress)
    with atomic_folder(out, force) as folder, atomic_file(samples) if samples else nullcontext() as archive:
        with clock.stage("mesh"):
            body = prepare(model, options)
        height = body.length / body.tile
        with clock.stage("strands"):
            strands = grow(options.coat, height, options.seed)
            furs = [
                in_state(state, options.coat, strands, height, options.seed)
                for state in chosen(options.states, options.dirt)
            ]
        with clock.stage("volume"):
            fine = furs[0].voxels(options.layers, options.size)

        def voxels(fur: Fur) -> Volume:
            """Of the states but the dry one the fine volumes are made anew: all of them at once take much memory."""
            return fine if fur is furs[0] else fur.voxels(options.layers, options.size)

        with clock.stage("light") as step:
            share = zip(furs, parts(step, len(furs)), strict=True)
            lit = [sampled(fur, voxels(fur), options, part) for fur, part in share]
        with clock.stage("fit") as step:
            pelts, figures = map(list, zip(*fit_pelts(lit, options), strict=True))
            if not options.flat:
                pelts[0] = replace(pelts[0], bent=fit_bends(pelts[0], strands, options.coat, step))
            if options.curves != "none":
                eye = fit_eye(strands, height, options.layers, options.size, options.coat, flat=options.flat)
                if eye is not None:
                    pelts[0] = replace(pelts[0], eye=eye.weights, surge=eye.surge)
        with clock.stage("fins"):
            fins = None
            if options.fins:
                lean = float(pelts[0].drift[-1, 1])
                fins = build_fins(body.ground, body.direction, body.tile, lean, options.seed, body.length)
            if fins is not None and len(fins.faces):
                sides = fit_sides(((fur, voxels(fur)) for fur in furs), pelts, options)
                pelts = [replace(pelt, fin=fin) for pelt, (fin, _) in zip(pelts, sides, strict=True)]
                figures = [found | {"fin": fin} for found, (_, fin) in zip(figures, sides, strict=True)]
            else:  # a body that is all creases
                fins = None
        with clock.stage("write"):
            record = {
                "furbake": version("furbake"),
                "libraries": library_versions(),
                "options": options.as_record(),
                "input": describe_input(model, body.skin),
                "key": bake_key(model, options),
                "fit": figures[0],
            }
            if len(pelts) > 1:
                record["states"] = [
                    {"name": pelt.state.name, "wetness": pelt.state.wetness, "dirt": pelt.state.dirt, "fit": found}
                    for pelt, found in zip(pelts, figures, strict=True)
                ]
            base = None if body.ground is body.skin else body.ground
            record["asset"] = write_gltf(
                folder,
                body.skin,
                body.charts,
                body.fur,
                pelts[0],
                body.length,
                fins,
                base,
                body.features,
                tuple(pelts[1:]),
            )
            (folder / "bake.json").write_text(json.dumps(record, indent=1) + "\n", "utf-8")
            if archive is not None:
                write_samples(archive, lit[0], strands)
    return BakeResult(out, record, clock.seconds, body.skin.notices)
