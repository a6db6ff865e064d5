"""The command line: what can be asked for, and what is said where it cannot be understood."""

from __future__ import annotations

import argparse
import re
from importlib.metadata import version
from typing import Any, NoReturn

from furbake.bend import AZIMUTHS, TIPS
from furbake.cli import actions, tables
from furbake.likeness.cells import PLANS
from furbake.likeness.verify import METHODS, SIZE, SPP
from furbake.pelt.states import WETNESS
from furbake.swatch import FROM_THE_SIDE
from furbake.trim import LENGTHS
from furbake.verify import SAMPLES


class UsageError(ValueError):
    """A command line that cannot be understood; the message names the argument, what was got and expected."""


class _Parser(argparse.ArgumentParser):
    """Says what is wrong in the words of all other errors, instead of printing usage."""

    shape = (
        "furbake bake, inspect, validate, presets, report, swatch, lesson, verify, compare, "
        "states, trim, bend, patches or groom"
    )

    def error(self, message: str) -> NoReturn:
        if match := re.fullmatch(r"the following arguments are required: (.*)", message, re.DOTALL):
            raise UsageError(f"{match[1].replace('/--out', '')}: missing, expected {self.shape}")
        if match := re.fullmatch(r"unrecognized arguments: (.*)", message, re.DOTALL):
            raise UsageError(f"{match[1]}: unknown, expected arguments of '{self.prog} --help'")
        if match := re.fullmatch(r"argument COMMAND: invalid choice: (.*?) \(choose from (.*)\)", message, re.DOTALL):
            raise UsageError(f"command: got {match[1]}, expected {match[2].replace(chr(39), '')}")
        if match := re.fullmatch(r"argument (?:-\w/)?-*([\w-]+): (.*)", message, re.DOTALL):
            detail = match[2].replace("expected one argument", "got nothing, expected a value")
            raise UsageError(f"{match[1]}: {detail}")
        raise UsageError(f"arguments: {message}")


def _whole(text: str) -> int:
    try:
        return int(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"got {text!r}, expected a whole number") from None


def _lights(text: str) -> int:
    count = _whole(text)
    if not 8 <= count <= 1024:
        raise argparse.ArgumentTypeError(f"got {text}, expected 8 to 1024")
    return count


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"got {text!r}, expected a number") from None


def _share(text: str) -> float:
    share = _number(text)
    if not 0 < share <= 1:
        raise argparse.ArgumentTypeError(f"got {text}, expected above 0 and at most 1")
    return share


def _setting(text: str) -> tuple[str, str]:
    name, equals, value = text.partition("=")
    if not (name.strip() and equals):
        raise argparse.ArgumentTypeError(f"got {text!r}, expected KNOB=VALUE such as coat.guard.count=300")
    return name.strip(), value.strip()


def _direction(text: str) -> tuple[float, float, float]:
    try:
        x, y, z = (float(part) for part in text.split(","))
    except ValueError:
        raise argparse.ArgumentTypeError(f"got {text!r}, expected three numbers X,Y,Z") from None
    return x, y, z


def _guide(text: str) -> str:
    if text not in ("nose-tail", "down") and not text.endswith(".json"):
        raise argparse.ArgumentTypeError(f"got {text!r}, expected nose-tail, down or a .json file of strokes")
    return text


def _states(text: str) -> tuple[str, ...]:
    return tuple(WETNESS) if text == "dry..wet" else tuple(name.strip() for name in text.split(","))


def _names(text: str) -> tuple[str, ...]:
    return tuple(name.strip() for name in text.split(","))


def _path(text: str) -> str:
    if not text or "\0" in text:
        raise argparse.ArgumentTypeError(f"got {text!r}, expected a path")
    return text


def parser() -> argparse.ArgumentParser:
    """Of the whole command."""
    top = _Parser(
        prog="furbake", description="Bakes fur that can be relit in real time, from any mesh.", allow_abbrev=False
    )
    top.add_argument("--version", action="version", version=f"furbake {version('furbake')}")
    commands = top.add_subparsers(metavar="COMMAND", required=True, dest="COMMAND", parser_class=_Parser)

    def add(name: str, run: Any, shape: str, text: str) -> _Parser:
        command: _Parser = commands.add_parser(name, help=text, description=text, allow_abbrev=False)
        command.set_defaults(run=run)
        command.shape = f"furbake {name} {shape}"
        return command

    _bake_arguments(add("bake", actions.run_bake, "MODEL -o DIR", "bake a mesh into a folder"))
    inspect = add("inspect", actions.run_inspect, "DIR", "say what is in a baked folder")
    inspect.add_argument("folder", metavar="DIR", type=_path)
    inspect.add_argument("--json", action="store_true", help="as one JSON object")
    check = add("validate", actions.run_validate, "DIR", "check a baked folder: exit 1 and a list if it is bad")
    check.add_argument("folder", metavar="DIR", type=_path)
    presets = add("presets", actions.run_presets, "[NAME]", "list the presets, or all knobs of one as TOML to copy")
    presets.add_argument("name", metavar="NAME", nargs="?", type=_path, help="a preset or a .toml file")
    presets.add_argument("--json", action="store_true", help="as one JSON object with all their options")
    report = add(
        "report", actions.run_report, "DIR", "write DIR/report.html: how good the bake is, and where it is not"
    )
    report.add_argument("folder", metavar="DIR", type=_path)
    report.add_argument("--quiet", action="store_true", help="no progress, no summary")
    _swatch_arguments(add("swatch", actions.run_swatch, "DIR -o FILE.png", "picture of a baked pelt, or of a preset's"))
    _lesson_arguments(add("lesson", actions.run_lesson, "-o DIR", "data of the lesson on the page Learn"))
    _verify_arguments(add("verify", actions.run_verify, "DIR", "compare a bake with a path tracer (Mitsuba 3)"))
    compare = add("compare", tables.run_compare, "[NAME ...]", "table of presets and bases, measured anew, as Markdown")
    compare.add_argument("names", metavar="NAME", nargs="*", type=_path, help="presets or .toml files (default: all)")
    compare.add_argument("--lights", type=_lights, default=192, metavar="N", help="lights of the fit (default: 192)")
    compare.add_argument("--size", type=_whole, metavar="N", help="texels per side of a slab (default: the preset's)")
    compare.add_argument("--quiet", action="store_true", help="no progress")
    states = add("states", tables.run_states, "[NAME ...]", "table of how states of fur mix, baked anew, as Markdown")
    states.add_argument("names", metavar="NAME", nargs="*", type=_path, help="presets or .toml files (default: all)")
    states.add_argument("--lights", type=_lights, default=64, metavar="N", help="lights of the fits (default: 64)")
    states.add_argument("--size", type=_whole, default=64, metavar="N", help="texels per side of a slab (default: 64)")
    states.add_argument("--json", action="store_true", help="every figure, as a JSON list")
    states.add_argument("--quiet", action="store_true", help="no progress")
    trim = add("trim", tables.run_trim, "[NAME ...]", "table of fur that is cut at run time, as Markdown")
    trim.add_argument("names", metavar="NAME", nargs="*", type=_path, help="presets or .toml files (default: all)")
    trim.add_argument(
        "--lengths", type=_share, nargs="+", default=LENGTHS, metavar="S", help="shares of the fur that are left"
    )
    trim.add_argument("--lights", type=_lights, default=64, metavar="N", help="lights of the fit (default: 64)")
    trim.add_argument("--size", type=_whole, metavar="N", help="texels per side of a slab (default: the preset's)")
    trim.add_argument("--quiet", action="store_true", help="no progress")
    bend = add("bend", tables.run_bend, "[NAME ...]", "table of how right the light on bent fur is, as Markdown")
    bend.add_argument("names", metavar="NAME", nargs="*", type=_path, help="presets or .toml files (default: all)")
    bend.add_argument(
        "--tips", type=_number, nargs="+", default=list(TIPS), metavar="H",
        help="how far tips are displaced, shares of the height (default: 0.3 0.5)",
    )  # fmt: skip
    bend.add_argument(
        "--azimuths", type=_whole, default=AZIMUTHS, metavar="N",
        help=f"in how many directions, the first along the lean (default: {AZIMUTHS})",
    )  # fmt: skip
    bend.add_argument("--size", type=_whole, metavar="N", help="texels per side of a slab (default: the preset's)")
    bend.add_argument("--quiet", action="store_true", help="no progress")
    patches = add("patches", tables.run_patches, "MODEL ...", "table of how lapped patches cover models, as Markdown")
    patches.add_argument("models", metavar="MODEL", nargs="+", type=_path)
    patches.add_argument(
        "--faces", type=_whole, metavar="F", help="of a simplified copy of each (default: as they are)"
    )
    _groom_arguments(add("groom", actions.run_groom, "DIR -o FILE.npz", "write the strands of a baked fur on its body"))
    return top


def _bake_arguments(parser: _Parser) -> None:
    add = parser.add_argument
    unset: Any = argparse.SUPPRESS
    add("model", metavar="MODEL", type=_path, help="a mesh file, or sphere, plane, plane:RxC, torus, torus:RxC")
    add("-o", "--out", metavar="DIR", required=True, type=_path, help="folder to write, whole or not at all")
    _preset_arguments(parser, "paper")
    add("--layers", type=_whole, default=unset, metavar="K", help="slabs of the tile, 1 to 64")
    add("--size", type=_whole, default=unset, metavar="N", help="texels per side of a slab, a power of two, 8 to 512")
    add("--lights", type=_whole, default=unset, metavar="N", help="sampled directions of light, 8 to 1024")
    add("--basis", default=unset, metavar="ptm|eigen", help="the paper's polynomial, or curves found for this fur")
    add("--coefficients", type=_whole, default=unset, metavar="C", help="numbers per texel: 6, with eigen 3 to 6")
    add(
        "--curves", default=unset, metavar="slab|none",
        help="mean light of each slab beside its numbers (default), or none: version 1 of the format",
    )  # fmt: skip
    add("--length", type=_number, default=unset, metavar="L", help="longest fur, the model's own units")
    add("--tile", type=_number, default=unset, metavar="W", help="width of a tile, the model's own units")
    add("--height", type=_number, default=unset, metavar="H", help="longest fur in tile widths: length / tile")
    add("--seed", type=_whole, default=unset, metavar="S", help="of all chance")
    add("--guide", type=_guide, default=unset, metavar="nose-tail|down|FILE.json", help="where the fur is laid")
    add("--comb", type=_path, default=unset, metavar="FILE.json", help="strokes along which it is combed, besides")
    add("--uv", default=unset, metavar="lapped|own", help="lapped patches (default), or the model's own coordinates")
    add("--max-faces", type=_whole, default=unset, metavar="F", help="simplify larger models (default: 60000)")
    add("--length-map", type=_path, default=unset, metavar="FILE.png|vertex:red", help="black is no length")
    add("--mask", type=_path, default=unset, metavar="FILE.png|vertex:red", help="black is bare skin")
    add("--features", type=_path, default=unset, metavar="FILE.json", help="eyes, a nose and the like")
    add("--length-by-thickness", action="store_true", default=unset, help="shorter fur where the body is thin")
    add("--no-fins", dest="fins", action="store_false", default=unset, help="no quads on the edges")
    add("--directions", action="store_true", default=unset, help="store the hairs' directions too, for other shaders")
    add("--flat", action="store_true", default=unset, help="a flat patch under a point at infinity, for checks")
    add("--states", type=_states, default=unset, metavar="dry..wet|dry,NAME", help="wet states too: all five, or some")
    add("--dirt", action="store_true", default=unset, help="a dirty state too")
    add("--samples", type=_path, metavar="FILE.npz", help="write the sampled physics too, for others to check")
    add("--force", action="store_true", help="replace DIR if it is a bake")
    add("--if-stale", action="store_true", help="only if DIR differs in options, input or version; implies --force")
    add("--json", action="store_true", help="print one JSON object with the record and the seconds of every stage")
    add("--quiet", action="store_true", help="no progress, no summary")


def _preset_arguments(parser: _Parser, default: str | None) -> None:
    parser.add_argument(
        "--preset",
        default=default,
        metavar="NAME|FILE.toml",
        type=_path,
        help="sets what is not given (default: paper)",
    )
    parser.add_argument(
        "--set",
        default=[],
        action="append",
        metavar="KNOB=VALUE",
        type=_setting,
        help="change a knob of the preset, such as coat.guard.count=300 (furbake presets NAME lists them); repeatable",
    )


def _swatch_arguments(parser: _Parser) -> None:
    add = parser.add_argument
    add("folder", metavar="DIR", nargs="?", type=_path, help="a baked folder; without it a preset is baked for this")
    _preset_arguments(parser, None)
    add("-o", "--out", metavar="FILE.png", required=True, type=_path, help="picture to write")
    add("--light", metavar="X,Y,Z", type=_direction, default=FROM_THE_SIDE, help="towards the lamp: right, up, at you")
    add("--state", metavar="NAME", help="dry (default), damp, moist, wet, soaked or dirty")
    add("--tiles", metavar="T", type=_whole, default=3, help="repeats of the tile along a side (default: 3)")
    add("--pixels", metavar="P", type=_whole, default=512, help="side of the picture (default: 512)")
    add("--quiet", action="store_true", help="no progress, no summary")


def _lesson_arguments(parser: _Parser) -> None:
    add = parser.add_argument
    _preset_arguments(parser, "paper")
    add("-o", "--out", metavar="DIR", required=True, type=_path, help="folder to write, whole or not at all")
    add("--force", action="store_true", help="replace DIR")
    add("--if-stale", action="store_true", help="only if DIR differs in options or version; implies --force")
    add("--json", action="store_true", help="print the record as one JSON object")
    add("--quiet", action="store_true", help="no progress, no summary")


def _groom_arguments(parser: _Parser) -> None:
    add = parser.add_argument
    add("folder", metavar="DIR", type=_path)
    add("-o", "--out", metavar="FILE.npz|FILE.usdc", required=True, type=_path, help="file to write")
    add("--json", action="store_true", help="what was written as one JSON object")
    add("--quiet", action="store_true", help="no progress, no summary")


def _verify_arguments(parser: _Parser) -> None:
    add = parser.add_argument
    add("folder", metavar="DIR", type=_path)
    add("--body", action="store_true", help="the strands on their body, beside the page's own shader (needs Node)")
    add("-o", "--out", "--picture", metavar="FILE.png", type=_path, help="picture with both side by side")
    add("--spp", metavar="N", type=_whole, help=f"paths per pixel (default: {SAMPLES}, with --body {SPP})")
    add("--size", metavar="N", type=_whole, default=SIZE, help=f"with --body: pixels across (default: {SIZE})")
    add(
        "--distance", metavar="D", type=_number, default=1.0,
        help="with --body: of the camera, 1: all of the fur is seen (default), 0.35: close up",
    )  # fmt: skip
    add(
        "--methods", metavar="NAME,...", type=_names, default=METHODS,
        help=f"with --body: ways to light the fur (default: {','.join(METHODS)})",
    )  # fmt: skip
    add("--plan", metavar="|".join(PLANS), help="with --body: eyes and lamps (default: round of sphere and torus)")
    add("--colour", action="store_true", help="with --body: hairs in their own colours; tells mean colours alone")
    add("--ceiling", action="store_true", help="with --body: the samples' own composite too, without any fit")
    for name, what in (("gloss", "highlights"), ("backlight", "light from behind")):
        add(f"--{name}", metavar="N", type=_number, default=0.0, help=f"with --body: {what} on the page (default: 0)")
    add("--truth", metavar="FILE.npz", type=_path, help="with --body: keeps what was traced for the next run")
    add("--json", action="store_true", help="figures as one JSON object")
    add("--quiet", action="store_true", help="no progress, no summary")
