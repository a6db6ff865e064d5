"""Sub-commands that measure presets or models anew and print a table, as Markdown."""

from __future__ import annotations

import json
from dataclasses import asdict, replace
from functools import partial
from pathlib import Path
from types import SimpleNamespace

from furbake.body.body import patch_figures
from furbake.cli.output import say
from furbake.cli.progress import shown
from furbake.options import BakeOptions, preset, preset_names
from furbake.study.bend import Row as BendRow
from furbake.study.bend import bend
from furbake.study.bend import check as check_bends
from furbake.study.bend import markdown as bend_table
from furbake.study.compare import Row, compare, markdown
from furbake.study.states import Row as HalfwayRow
from furbake.study.states import compare_states
from furbake.study.states import markdown as halfway_table
from furbake.study.trim import Row as TrimRow
from furbake.study.trim import table as trim_table
from furbake.study.trim import trim

PATCHES = """\
| model | faces | covered | faces ratio | stretch, 95 % | sum of weights off | off the field, 95 % | s |
|---|---|---|---|---|---|---|---|"""
"""Head of the table of patches."""


def run_compare(args: SimpleNamespace) -> int:
    """Print a table of presets and bases, all measured anew."""
    names, coats = _coats(args)
    rows: list[Row] = []
    with shown(names, args.quiet) as progress:
        for name, options in zip(names, coats, strict=True):
            rows += compare(options, args.lights, partial(progress, name))
            progress(name, 1.0)
    say(markdown(rows), end="")
    return 0


def run_states(args: SimpleNamespace) -> int:
    """Print a table of the states of presets, and of mixtures half-way between them, all baked anew."""
    names = args.names or preset_names()
    furs = [replace(preset(name), layers=16, size=args.size, lights=args.lights) for name in names]
    for options in furs:
        options.check()
    rows: list[HalfwayRow] = []
    with shown(names, args.quiet) as progress:
        for name, options in zip(names, furs, strict=True):
            rows += compare_states(options, partial(progress, name))
            progress(name, 1.0)
    say(json.dumps([asdict(row) for row in rows]) if args.json else halfway_table(rows), end="")
    return 0


def run_trim(args: SimpleNamespace) -> int:
    """Print a table of cut fur, lit in every way, against the same strands cut and baked anew."""
    names, coats = _coats(args)
    rows: list[TrimRow] = []
    with shown(names, args.quiet) as progress:
        for name, options in zip(names, coats, strict=True):
            rows += trim(options, tuple(args.lengths), args.lights, partial(progress, name))
            progress(name, 1.0)
    say(trim_table(rows), end="")
    return 0


def run_bend(args: SimpleNamespace) -> int:
    """Print a table of bent fur, lit in every way, against the same strands bent and sampled anew."""
    check_bends(args.tips, args.azimuths)
    names, coats = _coats(args)
    rows: list[BendRow] = []
    with shown(names, args.quiet) as progress:
        for name, options in zip(names, coats, strict=True):
            rows += bend(options, args.tips, args.azimuths, partial(progress, name))
            progress(name, 1.0)
    say(bend_table(rows), end="")
    return 0


def _coats(args: SimpleNamespace) -> tuple[list[str], list[BakeOptions]]:
    """The named presets, or all, at the given size."""
    names = args.names or preset_names()
    coats = [preset(name) for name in names]
    if args.size is not None:
        coats = [replace(options, size=args.size) for options in coats]
        coats[0].check()
    return names, coats


def run_patches(args: SimpleNamespace) -> int:
    """Print a table of models and how lapped patches cover them."""
    for number, model in enumerate(args.models):
        found = patch_figures(model, args.faces)
        if number == 0:
            say(PATCHES)
        off = max(found["sum_error"], found["sum_error_vertices"])
        say(
            f"| {Path(model).name} | {found['faces']} | {found['coverage']:.2%} | {found['faces_ratio']:.2f} "
            f"| {found['stretch_mean']:.3f}, {found['stretch_95']:.3f} | {off:.1g} "
            f"| {found['angle_mean']:.1f}°, {found['angle_95']:.1f}° | {found['seconds']:.1f} |"
        )
    return 0
