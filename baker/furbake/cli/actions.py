"""Actions of the sub-commands: from arguments to an exit status."""

from __future__ import annotations

import json
from dataclasses import asdict, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from types import SimpleNamespace
from typing import Any

from furbake.asset.inspect import summary
from furbake.asset.read import read_asset
from furbake.asset.validate import check, validate
from furbake.cli.baking import pelt_cache
from furbake.cli.chosen import chosen
from furbake.cli.command import INVALID
from furbake.cli.output import complain, say
from furbake.cli.progress import shown
from furbake.groom.files import write_groom
from furbake.groom.strands import STAGES as GROOM_STAGES
from furbake.groom.strands import groom
from furbake.options import BakeOptions, OptionError, as_toml, preset, preset_names, preset_summary
from furbake.pipeline import STAGES, bake
from furbake.show.lesson import STAGES as LESSON_STAGES
from furbake.show.lesson import fresh as fresh_lesson
from furbake.show.lesson import write as write_lesson
from furbake.show.report import STAGES as REPORT_STAGES
from furbake.show.report import write as write_report
from furbake.show.swatch import save
from furbake.study import beside, grooms
from furbake.study.verify import body, field
from furbake.study.verify.colour import colour_lines, verify_colour
from furbake.study.verify.figures import lines as body_lines
from furbake.study.verify.tile import SAMPLES, lines, verify

VERIFY_STAGES = ("strands", "light", "trace")


def run_inspect(args: SimpleNamespace) -> int:
    """Print the contents of a baked folder."""
    found = summary(read_asset(Path(args.folder)))
    if args.json:
        say(json.dumps(found))
        return 0
    table(found)
    return 0


def _text(value: Any) -> str:
    if isinstance(value, dict):
        return ", ".join(f"{key} {_text(item)}" for key, item in value.items())
    if isinstance(value, list):
        return ", ".join(_text(item) for item in value)
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def run_validate(args: SimpleNamespace) -> int:
    """List the problems of a baked folder."""
    folder = Path(args.folder)
    if not folder.is_dir():
        read_asset(folder)
    problems = validate(folder)
    for problem in problems:
        say(problem)
    if not problems:
        say(f"{folder}: valid")
    return INVALID if problems else 0


def run_presets(args: SimpleNamespace) -> int:
    """All presets in a line each, or every knob of one, to copy."""
    if args.name:
        options = preset(args.name)
        say(json.dumps(options.as_record()) if args.json else described(args.name, options), end="")
        return 0
    if args.json:
        say(json.dumps({name: preset(name).as_record() for name in preset_names()}))
        return 0
    for name in preset_names():
        options = preset(name)
        say(f"{name:<12}{options.layers} layers of {options.size} x {options.size}. {preset_summary(name)}")
    return 0


def described(name: str, options: BakeOptions) -> str:
    """A preset as a file to copy."""
    first = preset_summary(name) if name in preset_names() else name
    return f"# {first}\n\n{as_toml(options)}"


def run_report(args: SimpleNamespace) -> int:
    """Write DIR/report.html."""
    check(Path(args.folder))
    with shown(REPORT_STAGES, args.quiet) as progress:
        out = write_report(Path(args.folder), progress, shown=not args.no_model)
    if not args.quiet:
        say(str(out))
    return 0


def run_swatch(args: SimpleNamespace) -> int:
    """Write a picture of a baked pelt, or of a preset's."""
    out = Path(args.out)
    given = {"tiles": args.tiles, "size": args.pixels, "state": args.state, "light": args.light}
    look: dict[str, Any] = {name: value for name, value in given.items() if value is not None}
    if args.folder:
        if args.preset or args.set:
            raise OptionError(f"swatch: got {args.folder!r} and --preset or --set, expected DIR alone or no DIR")
        check(Path(args.folder))
        pixels = save(Path(args.folder), out, **look)
    else:
        args.preset = args.preset or "paper"
        options = in_state(chosen(args), args.state)
        with TemporaryDirectory(prefix="furbake-") as scratch, shown(STAGES, args.quiet) as progress:
            bake("plane", Path(scratch) / "plane", options, cache=pelt_cache(args), progress=progress)
            pixels = save(Path(scratch) / "plane", out, **look)
    if args.json:
        say(json.dumps({"file": str(out), "width": pixels.shape[1], "height": pixels.shape[0]}))
    elif not args.quiet:
        say(str(out))
    return 0


def in_state(options: BakeOptions, state: str | None) -> BakeOptions:
    """Options of a bake that has a state: the dry one, and that one."""
    if state is None or state == "dry":
        return options
    dirty = state == "dirty"
    options = replace(options, dirt=dirty, states=("dry",) if dirty else ("dry", state))
    options.check()
    return options


def run_lesson(args: SimpleNamespace) -> int:
    """Write the lesson's data."""
    options, out = chosen(args), Path(args.out)
    record = fresh_lesson(out, options) if args.if_stale else None
    done = record is not None
    if record is None:
        with shown(LESSON_STAGES, args.quiet) as progress:
            record = write_lesson(out, options, force=args.force or args.if_stale, progress=progress)
    if args.json:
        say(json.dumps({"folder": str(out), "baked": not done, **record}))
    elif not args.quiet:
        size = sum(record["bytes"].values()) / 1e6
        say(f"{out}: up to date" if done else f"{out}: {len(record['samples'])} layers measured, {size:.2f} MB")
    return 0


def run_groom(args: SimpleNamespace) -> int:
    """Write the strands of a baked fur on its body."""
    out = Path(args.out)
    check(Path(args.folder))
    joints = len(read_asset(Path(args.folder)).document.get("skins", []))
    with shown(GROOM_STAGES, args.quiet) as progress:
        strands = groom(Path(args.folder), progress)
        write_groom(out, strands)
    count, points = strands.points.shape[:2]
    if joints and not args.quiet:
        complain("note: joints move the body: strands stand on it in its rest pose and follow none of them")
    if args.json:
        say(json.dumps({"file": str(out), "hairs": count, "points": points, "bytes": out.stat().st_size}))
    elif not args.quiet:
        say(f"{out}: {count} hairs of {points} points, {out.stat().st_size / 1e6:.1f} MB")
    return 0


def run_verify(args: SimpleNamespace) -> int:
    """Compare a bake with a path tracer."""
    for other in ("body", "beside", "groom", "out"):
        if args.eyes and getattr(args, other):
            flag = "-o" if other == "out" else f"--{other}"
            raise OptionError(f"verify: got --eyes and {flag}, expected --eyes alone")
    picture = Path(args.out) if args.out else None
    if args.body:
        return _verify_body(args, picture)
    if args.beside:
        return _verify_beside(args, picture)
    if args.groom:
        return _verify_groom(args)
    with shown(VERIFY_STAGES, args.quiet) as progress:
        if args.eyes:
            figures = field.verify_field(Path(args.folder), spp=args.spp or field.SAMPLES, progress=progress)
        else:
            figures = verify(Path(args.folder), picture=picture, spp=args.spp or SAMPLES, progress=progress)
    if args.json:
        say(json.dumps(figures))
    elif not args.quiet:
        say("\n".join(field.lines(figures) if args.eyes else lines(figures)))
    return 0


def _verify_groom(args: SimpleNamespace) -> int:
    with shown(grooms.STAGES, args.quiet) as progress:
        figures = grooms.held_out(Path(args.folder), Path(args.groom), progress)
    if args.json:
        say(json.dumps(asdict(figures)))
    elif not args.quiet:
        say("\n".join(grooms.lines(figures)))
    return 0


def _verify_beside(args: SimpleNamespace, picture: Path | None) -> int:
    options = body.Options(plan=args.plan, size=args.size, distance=args.distance)
    with shown(beside.STAGES, args.quiet) as progress:
        figures = beside.beside(Path(args.folder), Path(args.beside), options, picture=picture, progress=progress)
    if args.json:
        say(json.dumps(figures))
    elif not args.quiet:
        say("\n".join(beside.lines(figures)))
    return 0


def _verify_body(args: SimpleNamespace, picture: Path | None) -> int:
    options = body.Options(
        plan=args.plan,
        methods=args.methods,
        size=args.size,
        spp=args.spp or body.SPP,
        distance=args.distance,
        ceiling=args.ceiling,
        look=(args.gloss, args.backlight),
        truth=Path(args.truth) if args.truth else None,
        groom=Path(args.groom) if args.groom else None,
        fast=not args.scalar,
        cycles=args.cycles,
    )
    if args.colour:
        with shown(body.STAGES, args.quiet) as progress:
            figures = verify_colour(Path(args.folder), options, picture=picture, progress=progress)
        if args.json:
            say(json.dumps(figures))
        elif not args.quiet:
            say("\n".join(colour_lines(figures)))
        return 0
    with shown(body.STAGES, args.quiet) as progress:
        figures = body.verify_body(Path(args.folder), options, picture=picture, progress=progress)
    if args.json:
        say(json.dumps(figures))
    elif not args.quiet:
        say("\n".join(body_lines(figures)))
    return 0


def table(found: dict[str, Any]) -> None:
    """Print names and values, one a line, groups indented."""
    for name, value in found.items():
        if isinstance(value, dict):
            say(f"{name}:")
            for key, item in value.items():
                say(f"  {key + ':':<26}{_text(item)}")
        else:
            say(f"{name + ':':<28}{_text(value)}")
