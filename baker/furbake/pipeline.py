"""From a mesh and options to a folder: one call per stage, in reading order."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass, field
from functools import partial
from importlib.metadata import version
from pathlib import Path
from typing import Any

from furbake.asset.gltf import FurModel, write_gltf
from furbake.asset.regions.parted import chosen_fins
from furbake.asset.regions.record import RegionFur, Regions, shaped
from furbake.asset.rig.motion import Motion
from furbake.asset.store import atomic_file, atomic_folder
from furbake.beside import Beside
from furbake.body.body import Body, prepare
from furbake.device import device
from furbake.identity import bake_key, describe_input, library_versions
from furbake.imported.stored import write_strands
from furbake.options import BakeOptions, OptionError
from furbake.pelt.pelt import Pelt
from furbake.surface.place.fins import Fins, build_fins
from furbake.surface.rig.follow import follow
from furbake.surface.roots.look import textured
from furbake.surface.roots.picture import Roots, picture_of_roots
from furbake.surface.shapes import is_builtin
from furbake.tile.lighting import write_samples
from furbake.tile.pelts import Pelts
from furbake.tile.tile import Fitted, Spread

STAGES = ("mesh", "strands", "volume", "light", "fit", "fins", "write")

Progress = Callable[[str, float], None]
Notify = Callable[[str], None]


@dataclass(frozen=True)
class BakeResult:
    """Folder of the asset, contents of `bake.json`, seconds of every stage, and notices, one sentence each."""

    folder: Path
    record: dict[str, Any]
    seconds: dict[str, float]
    notices: tuple[str, ...] = ()


@dataclass
class _Clock:
    """Report each stage to the caller, and time it."""

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
    cache: Path | None = None,
    spread: Spread | None = None,
    helped: bool = True,
    progress: Progress = lambda stage, fraction: None,
    notify: Notify = lambda notice: None,
) -> BakeResult:
    """Bake `model` (a file or the name of a built-in shape) into the folder `out`, whole or not at all.

    samples : optional file for the physics itself, for others to check; the light is then sampled anew
    cache : optional folder of finished pelts: one of this very fur is taken from there, else kept there
    spread : who lets the light through the hairs, if not this process
    helped : a second process does a part of a long bake, where several cores may be used
    progress : called with a stage of `STAGES` and the fraction of it that is done
    notify : called with each notice of the result once the mesh is read, before the light is sampled

    Raises OptionError, MeshError or StoreError, each with one sentence.
    """
    options = options or BakeOptions()
    _check(options, samples, spread)
    clock = _Clock(progress)
    archive_file = atomic_file(samples) if samples else nullcontext()
    with atomic_folder(out, force) as folder, archive_file as archive, Beside(apart=helped) as beside:
        with clock.stage("mesh"):
            body = prepare(model, options)
        given, options = options, body.dressed(options)
        notices = (*body.skin.notices, *body.notices, *_hues(body, options))
        for notice in notices:
            notify(notice)
        make = partial(Pelts, clock.stage, beside, cache, spread)
        height = body.regions[0].height if body.regions else body.length / body.tile
        pelts = make(options.of_tile(), height, body.strands)
        others = [make(part.options.of_tile(), part.height, part.strands) for part in body.regions[1:]]
        fitted = pelts.fitted(anew=samples is not None)
        worn = [each.fitted(anew=False) for each in others]
        for notice in pelts.notices:
            notify(notice)
        with clock.stage("fins"):
            fins, quads = _fins(body, options, [made[0][0] for made in (fitted, *worn)])
            if fins is not None:
                fitted = pelts.with_fins(fitted)
                worn = [each.with_fins(made) for each, made in zip(others, worn, strict=True)]
        with clock.stage("write"):
            record = _record(model, given, options, body, fitted) | _worn(body, worn)
            furry = _furry(model, options, body, fitted, fins, _regions(body, fitted[0][0], worn, quads))
            record["asset"] = write_gltf(folder, furry, options.meshopt, cache)
            for number, each in enumerate((pelts, *others)):
                if each.strands is not None:
                    record["asset"]["bytes"] |= write_strands(folder, each.strands, number)
            (folder / "bake.json").write_text(json.dumps(record, indent=1) + "\n", "utf-8")
            if archive is not None:
                write_samples(archive, pelts.sampled[0], pelts.tile.strands)
    return BakeResult(out, record, clock.seconds, (*notices, *pelts.notices))


def _check(options: BakeOptions, samples: Path | None, spread: Spread | None) -> None:
    """Raise OptionError for options that are out of range, or cannot be had together."""
    options.check()
    if spread is not None and options.groom is not None:
        raise OptionError(f"scheduler: got one beside the groom {options.groom}, expected a bake on this machine")
    if samples is not None and options.swatch is not None:
        raise OptionError(f"samples: got {samples} beside a swatch, expected fur that is grown")


def _furry(
    model: str, options: BakeOptions, body: Body, fitted: Fitted, fins: Fins | None, regions: Regions | None
) -> FurModel:
    """All that the folder shows."""
    return FurModel(
        skin=body.skin,
        charts=body.charts,
        fur=body.fur,
        pelts=tuple(pelt for pelt, _ in fitted),
        length=body.length,
        fins=fins,
        ground=None if body.ground is body.skin else body.ground,
        features=body.features,
        bare=None if is_builtin(model) else fitted[0][0].ramp.root,
        motion=_motion(body),
        tinted=options.swatch is None,
        roots=_roots(body, options, fitted[0][0]),
        thinned=body.groom is not None,
        regions=regions,
    )


def _pictured(body: Body, options: BakeOptions) -> bool:
    """True where hairs have the colours of the model's picture, not those of an artist's groom or a photograph."""
    by_skin = body.fur.colour is not None and body.fur.own is None
    return by_skin and textured(body.skin) and options.swatch is None


def _hues(body: Body, options: BakeOptions) -> tuple[str, ...]:
    """A notice where a preset's hues come over those of the model's picture."""
    if options.own_colours or not (_pictured(body, options) and options.ramp.hued):
        return ()
    return (f"colours: the picture's times those of {options.preset}; --own-colours leaves its hues out",)


def _roots(body: Body, options: BakeOptions, dry: Pelt) -> Roots | None:
    """The picture of the roots; None where hairs have the colours of the vertices, or none of the model's picture."""
    if options.colour == "vertex" or not _pictured(body, options) or dry.curves is None:
        return None
    return picture_of_roots(body.skin, body.ground, body.charts, dry.drift[-1], options.size)


def _fins(body: Body, options: BakeOptions, dry: Sequence[Pelt]) -> tuple[Fins | None, tuple[int, ...]]:
    """Fins of a body, and how many of each of several furs; None where they are not wanted or not known, and on a
    body that is all creases.

    dry : the pelt of each fur
    """
    if not options.fins or options.swatch is not None:
        return None, ()
    tiles = [part.tile / body.tile for part in body.regions] or [1.0]
    leans = [float(pelt.drift[-1, 1]) * tile for pelt, tile in zip(dry, tiles, strict=True)]
    each = [build_fins(body.ground, body.direction, body.tile, lean, options.seed, body.length) for lean in leans]
    if not len(each[0].faces):
        return None, ()
    return (each[0], ()) if body.bounds is None else chosen_fins(each, body.bounds, options.seed)


def _worn(body: Body, worn: Sequence[Fitted]) -> dict[str, Any]:
    """The part of the record on regions: share of the furry surface, options and figures of each; {} without any."""
    if not body.regions:
        return {}
    furs = [
        {"name": part.name, "covers": part.covers, "length": part.length, "options": part.options.as_record()}
        | {"fit": fitted[0][1], **part.record}
        for part, fitted in zip(body.regions[1:], worn, strict=True)
    ]
    return {"regions": furs}


def _regions(body: Body, coat: Pelt, worn: Sequence[Fitted], quads: tuple[int, ...]) -> Regions | None:
    """Furs beside the coat, as they are stored."""
    if body.bounds is None:
        return None
    furs = [
        RegionFur(part.name, part.tile / body.tile, shaped([pelt for pelt, _ in fitted], coat))
        for part, fitted in zip(body.regions[1:], worn, strict=True)
    ]
    return Regions(body.bounds, body.tile, tuple(furs), quads)


def _motion(body: Body) -> Motion | None:
    """The rig of a body and how its surfaces follow it; None where nothing moves it."""
    rig, skin, ground = body.skin.rig, body.skin, body.ground
    if rig is None:
        return None
    follows = follow(rig, skin.vertices, skin.normals)
    return Motion(rig, follows, follows if ground is skin else follow(rig, ground.vertices, ground.normals))


def _record(model: str, given: BakeOptions, options: BakeOptions, body: Body, fitted: Fitted) -> dict[str, Any]:
    """`bake.json` without the written files: versions, options, input and figures.

    given : options before a groom changed them
    """
    record: dict[str, Any] = {
        "furbake": version("furbake"),
        "libraries": library_versions(),
        "options": options.as_record(),
        "input": describe_input(model, body.skin),
        "key": bake_key(model, given),
        "fit": fitted[0][1],
    }
    if device() != "cpu" and options.swatch is None:
        record["device"] = device()
    if body.groom is not None:
        record["groom"] = body.groom.record
    if len(fitted) > 1:
        record["states"] = [
            {"name": pelt.state.name, "wetness": pelt.state.wetness, "dirt": pelt.state.dirt, "fit": figures}
            for pelt, figures in fitted
        ]
    return record
