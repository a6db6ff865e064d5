"""Sub-commands that measure presets or models anew and print a table, as Markdown."""

from __future__ import annotations

import argparse
import json
from dataclasses import asdict, replace
from functools import partial
from pathlib import Path

from furbake.bend import Row as BendRow
from furbake.bend import bend
from furbake.bend import check as check_bends
from furbake.bend import markdown as bend_table
from furbake.body import patch_figures
from furbake.cli.progress import shown
from furbake.compare import Row, compare, markdown
from furbake.halfway import Row as HalfwayRow
from furbake.halfway import halfway
from furbake.halfway import markdown as halfway_table
from furbake.options import BakeOptions, preset, preset_names
from furbake.trim import Row as TrimRow
from furbake.trim import table as trim_table
from furbake.trim import trim


def run_compare(args: argparse.Namespace) -> int:
    """Print a table of presets and bases, all measured anew."""
    names, coats = _coats(args)
    rows: list[Row] = []
    with shown(names, args.quiet) as progress:
        for name, options in zip(names, coats, strict=True):
            rows += compare(options, args.lights, partial(progress, name))
            progress(name, 1.0)
    print(markdown(rows), end="")
    return 0


def run_states(args: argparse.Namespace) -> int:
    """Print a table of presets and how good what lies between two states of their fur is, all baked anew."""
    names = args.names or preset_names()
    furs = [replace(preset(name), layers=16, size=args.size, lights=args.lights) for name in names]
    for options in furs:
        options.check()
    rows: list[HalfwayRow] = []
    with shown(names, args.quiet) as progress:
        for name, options in zip(names, furs, strict=True):
            rows += halfway(options, partial(progress, name))
            progress(name, 1.0)
    print(json.dumps([asdict(row) for row in rows]) if args.json else halfway_table(rows), end="")
    return 0


def run_trim(args: argparse.Namespace) -> int:
    """Print a table of cut fur, lit in every way, against the same strands cut and baked anew."""
    names, coats = _coats(args)
    rows: list[TrimRow] = []
    with shown(names, args.quiet) as progress:
        for name, options in zip(names, coats, strict=True):
            rows += trim(options, tuple(args.lengths), args.lights, partial(progress, name))
            progress(name, 1.0)
    print(trim_table(rows), end="")
    return 0


def run_bend(args: argparse.Namespace) -> int:
    """Print a table of bent fur, lit in every way, against the same strands bent and sampled anew."""
    check_bends(args.tips, args.azimuths)
    names, coats = _coats(args)
    rows: list[BendRow] = []
    with shown(names, args.quiet) as progress:
        for name, options in zip(names, coats, strict=True):
            rows += bend(options, args.tips, args.azimuths, partial(progress, name))
            progress(name, 1.0)
    print(bend_table(rows), end="")
    return 0


def _coats(args: argparse.Namespace) -> tuple[list[str], list[BakeOptions]]:
    """Presets that are named, or all, at the size that is asked for."""
    names = args.names or preset_names()
    coats = [preset(name) for name in names]
    if args.size is not None:
        coats = [replace(options, size=args.size) for options in coats]
        coats[0].check()
    return names, coats


def run_patches(args: argparse.Namespace) -> int:
    """Print a table of models and how lapped patches cover them."""
    print("| model | faces | covered | faces ratio | stretch, 95 % | sum of weights off | off the field, 95 % | s |")
    print("|---|---|---|---|---|---|---|---|")
    for model in args.models:
        found = patch_figures(model, args.faces)
        off = max(found["sum_error"], found["sum_error_vertices"])
        print(
            f"| {Path(model).name} | {found['faces']} | {found['coverage']:.2%} | {found['faces_ratio']:.2f} "
            f"| {found['stretch_mean']:.3f}, {found['stretch_95']:.3f} | {off:.1g} "
            f"| {found['angle_mean']:.1f}°, {found['angle_95']:.1f}° | {found['seconds']:.1f} |"
        )
    return 0
