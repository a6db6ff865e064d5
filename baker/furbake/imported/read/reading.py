"""A groom of any format as curves."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from furbake.imported.curves import Curves, GroomError, checked
from furbake.imported.read.arrays import read_arrays
from furbake.imported.read.binary import read_hair, read_tfx
from furbake.imported.read.splines import least, lines
from furbake.surface.files import check_regular, read_regular
from furbake.surface.limits import Budget
from furbake.surface.soup import MeshError
from furbake.usd.stage import ENDINGS, Stage, UsdCurves, UsdError, read_stage

ALEMBIC = "Alembic has no reader of ours: open it in Blender (File, Import, Alembic) and bake it there"

KINDS = (".npz", ".hair", ".tfx", *ENDINGS)


def read_curves(path: Path) -> Curves:
    """Strands of a groom, in metres and y up where the file says its units. Raises GroomError with one sentence."""
    name, ending = str(path), path.suffix.lower()
    if ending == ".abc":
        raise GroomError(f"{name}: {ALEMBIC}")
    if ending not in KINDS:
        raise GroomError(f"{name}: file type is '{ending.lstrip('.')}', expected one of {', '.join(KINDS)}")
    try:
        budget = Budget(name, "bytes")
        if ending in ENDINGS:
            check_regular(path, budget)
            return of_stage(name, read_stage(path))
        data = read_regular(path, budget)
    except (MeshError, UsdError) as error:
        raise GroomError(str(error)) from None
    except OSError as error:
        why = (error.strerror or str(error)).lower()
        raise GroomError(f"{name}: {why}, expected a groom ({', '.join(KINDS)})") from None
    if ending == ".npz":
        return read_arrays(name, data, budget.whole)
    return read_hair(name, data) if ending == ".hair" else read_tfx(name, data)


def of_stage(name: str, stage: Stage) -> Curves:
    """All curves of a stage. Raises GroomError where there is none."""
    if not stage.curves:
        other = ", ".join(
            f"{count} {kind}" for kind, count in {"Mesh": len(stage.meshes), **stage.others}.items() if count
        )
        gone = "".join(f"; {layer} is missing" for layer in stage.missing)
        raise GroomError(f"{name}: no curves ({other or 'nothing with a shape'}){gone}, expected BasisCurves")
    some = [curves for curves in stage.curves if len(curves.counts) or len(curves.points)]
    parts = [_part(name, stage, curves) for curves in some or stage.curves]
    told = _told(name, stage)
    if len(parts) == 1:
        return replace(parts[0], notices=(*told, *parts[0].notices))
    widths = [part.widths for part in parts if part.widths is not None]
    colours = [part.colours for part in parts if part.colours is not None]
    for what, had in (("widths", widths), ("colours", colours)):
        if 0 < len(had) < len(parts):
            told.append(f"{name}: {len(had)} of {len(parts)} groups of curves have {what}, which are left out")
    return Curves(
        np.concatenate([part.points for part in parts]),
        np.concatenate([part.counts for part in parts]),
        np.concatenate(widths) if len(widths) == len(parts) else None,
        np.concatenate(colours) if len(colours) == len(parts) else None,
        (*told, *(notice for part in parts for notice in part.notices)),
    )


def _told(name: str, stage: Stage) -> list[str]:
    """Notices on what is left out of a stage that has curves."""
    told = [f"{name}: {layer} is missing, and what it has with it" for layer in stage.missing]
    if stage.hidden:
        told.append(f"{name}: {stage.hidden} groups of curves are guides, proxies or invisible and left out")
    others = [f"{count} {kind}" for kind, count in stage.others.items() if kind.endswith(("Curves", "Instancer"))]
    if others:
        told.append(f"{name}: {', '.join(others)} left out, only BasisCurves are read")
    return told


def _part(name: str, stage: Stage, curves: UsdCurves) -> Curves:
    """One primitive as lines of points."""
    where = f"{name}: {curves.path}"
    if curves.wrap == "periodic":
        raise GroomError(f"{where}: periodic curves have no root, expected open ones (pinned or nonperiodic)")
    counts = curves.counts
    if (counts < 0).any() or int(counts.sum()) != len(curves.points):
        raise GroomError(
            f"{where}: {len(curves.points)} points for curves that count {int(counts.sum())}, expected as many"
        )
    if not len(counts):
        raise GroomError(f"{where}: no curves, expected strands of two points or more")
    fewest = least(curves.kind, curves.basis, curves.wrap)
    if int(counts.min()) < fewest:
        most = "one point" if int(counts.max()) < 2 else f"{int(counts.min())} points"
        kind = "linear ones" if curves.kind == "linear" else f"a {curves.basis} that is {curves.wrap}"
        raise GroomError(f"{where}: curves of {most}, expected {fewest} or more of {kind}")
    values = {
        what: found for what, found in (("widths", curves.widths), ("colours", curves.colours)) if found is not None
    }
    try:
        points, many, found = lines(stage.placed(curves.points), counts, curves.kind, curves.basis, curves.wrap, values)
    except GroomError as error:
        raise GroomError(f"{where}: {error}") from None
    widths = found.get("widths")
    scaled = None if widths is None else widths * (stage.metres or 1.0)
    return checked(where, points, many, scaled, found.get("colours"))
