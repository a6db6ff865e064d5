"""The command `furbake`: the only module that prints, shows progress or exits."""

from __future__ import annotations

import argparse
import json
import os
import re
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from importlib.metadata import version
from pathlib import Path
from typing import Any, NoReturn

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

from furbake.asset.inspect import summary
from furbake.asset.planes import PlaneError
from furbake.asset.read import AssetError, read_asset
from furbake.asset.store import StoreError
from furbake.asset.validate import validate
from furbake.bake import STAGES, bake, bake_key
from furbake.options import BakeOptions, OptionError, preset, preset_names, preset_summary
from furbake.surface.mesh import MeshError

GIVEN = (
    "layers", "size", "lights", "basis", "coefficients", "length", "tile", "height", "seed", "flat", "guide",
    "length_by_thickness",
)  # fmt: skip
"""Options of the command that are options of the bake; one that is not given is the preset's."""

BAD_INPUT, INVALID, INTERRUPTED = 2, 1, 130


class UsageError(ValueError):
    """A command line that cannot be understood; the message names the argument, what was got and expected."""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; its exit status: 0 done, 1 something is invalid, 2 bad input, 130 interrupted."""
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="backslashreplace")  # a name of a file may hold anything
    try:
        args = _parser().parse_args(argv)
        run: Callable[[argparse.Namespace], int] = args.run
        status = run(args)
        sys.stdout.flush()
    except (UsageError, OptionError, MeshError, StoreError, AssetError, PlaneError) as error:
        return _fail(str(error))
    except BrokenPipeError:  # whoever read the output has gone
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return INVALID
    except OSError as error:
        what = error.filename or "file"
        return _fail(f"{what}: {(error.strerror or str(error)).lower()}, expected it to be readable or writable")
    except MemoryError:
        return _fail("memory: not enough for this bake, expected smaller --layers, --size or --lights")
    except KeyboardInterrupt:
        print("furbake: interrupted, nothing written", file=sys.stderr)
        return INTERRUPTED
    return status


def _fail(message: str) -> int:
    print(f"furbake: error: {' '.join(message.split())}", file=sys.stderr)
    return BAD_INPUT


def _bake(args: argparse.Namespace) -> int:
    options = replace(preset(args.preset), **{name: getattr(args, name) for name in GIVEN if hasattr(args, name)})
    options.check()
    out = Path(args.out)
    if args.if_stale and (record := _fresh(args.model, out, options)):
        if args.json:
            print(json.dumps({"folder": str(out), "baked": False, "seconds": {}, **record}))
        elif not args.quiet:
            print(f"{out}: up to date")
        return 0
    samples = Path(args.samples) if args.samples else None
    start = time.perf_counter()
    with _progress(args.quiet) as progress:
        result = bake(args.model, out, options, force=args.force or args.if_stale, samples=samples, progress=progress)
    if args.json:
        print(json.dumps({"folder": str(out), "baked": True, "seconds": result.seconds, **result.record}))
    elif not args.quiet:
        size = sum(result.record["asset"]["bytes"].values()) / 1e6
        print(
            f"{out}: {result.record['input']['name']} in {options.layers} layers of {options.size} x {options.size}, "
            f"{result.record['fit']['psnr']:.1f} dB, {size:.2f} MB, {time.perf_counter() - start:.1f} s"
        )
    return 0


def _fresh(model: str, out: Path, options: BakeOptions) -> dict[str, Any] | None:
    """The record of a whole bake of the same options, version and input in `out`, if there is one."""
    try:
        record = read_asset(out).record
        whole = all((out / name).stat().st_size == size for name, size in record["asset"]["bytes"].items())
        return record if whole and record["key"] == bake_key(model, options) else None
    except (AssetError, OSError, LookupError, TypeError, AttributeError):
        return None


def _inspect(args: argparse.Namespace) -> int:
    found = summary(read_asset(Path(args.folder)))
    if args.json:
        print(json.dumps(found))
        return 0
    for name, value in found.items():
        if isinstance(value, dict):
            print(f"{name}:")
            for key, item in value.items():
                print(f"  {key + ':':<26}{_text(item)}")
        else:
            print(f"{name + ':':<28}{_text(value)}")
    return 0


def _text(value: Any) -> str:
    if isinstance(value, dict):
        return ", ".join(f"{key} {_text(item)}" for key, item in value.items())
    if isinstance(value, list):
        return ", ".join(_text(item) for item in value)
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def _validate(args: argparse.Namespace) -> int:
    folder = Path(args.folder)
    if not folder.is_dir():
        read_asset(folder)
    problems = validate(folder)
    for problem in problems:
        print(problem)
    if not problems:
        print(f"{folder}: valid")
    return INVALID if problems else 0


def _presets(args: argparse.Namespace) -> int:
    if args.json:
        print(json.dumps({name: preset(name).as_record() for name in preset_names()}))
        return 0
    for name in preset_names():
        options = preset(name)
        print(f"{name:<12}{options.layers} layers of {options.size} x {options.size}. {preset_summary(name)}")
    return 0


@contextmanager
def _progress(quiet: bool) -> Iterator[Callable[[str, float], None]]:
    """A bar with the stages on a terminal, else a line for each stage that is done; both on standard error."""
    if quiet:
        yield _silent
        return
    console = Console(stderr=True)
    if console.is_terminal:
        columns = (TextColumn("{task.description:<8}"), BarColumn(), TextColumn("{task.percentage:>3.0f} %"))
        with Progress(*columns, TimeElapsedColumn(), console=console, transient=True) as bar:
            task = bar.add_task(STAGES[0], total=len(STAGES))
            yield lambda stage, fraction: bar.update(
                task, description=stage, completed=STAGES.index(stage) + min(max(fraction, 0.0), 1.0)
            )
        return
    began: dict[str, float] = {}
    done: set[str] = set()

    def line(stage: str, fraction: float) -> None:
        now = time.perf_counter()
        start = began.setdefault(stage, now)
        if fraction >= 1.0 and stage not in done:
            done.add(stage)
            print(f"furbake: {stage} {now - start:.1f} s", file=sys.stderr)

    yield line


def _silent(_stage: str, _fraction: float) -> None:
    pass


class _Parser(argparse.ArgumentParser):
    """Says what is wrong in the words of all other errors, instead of printing usage."""

    shape = "furbake bake, inspect, validate or presets"

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


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"got {text!r}, expected a number") from None


def _guide(text: str) -> str:
    if text not in ("nose-tail", "down"):
        hint = " (a file of strokes is not supported yet)" if Path(text).suffix else ""
        raise argparse.ArgumentTypeError(f"got {text!r}, expected nose-tail or down{hint}")
    return text


def _path(text: str) -> str:
    if not text or "\0" in text:
        raise argparse.ArgumentTypeError(f"got {text!r}, expected a path")
    return text


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(
        prog="furbake", description="Bakes fur that can be relit in real time, from any mesh.", allow_abbrev=False
    )
    parser.add_argument("--version", action="version", version=f"furbake {version('furbake')}")
    commands = parser.add_subparsers(metavar="COMMAND", required=True, dest="COMMAND", parser_class=_Parser)
    _bake_arguments(commands.add_parser("bake", help="bake a mesh into a folder", allow_abbrev=False))

    inspect = commands.add_parser("inspect", help="say what is in a baked folder", allow_abbrev=False)
    inspect.add_argument("folder", metavar="DIR", type=_path)
    inspect.add_argument("--json", action="store_true", help="as one JSON object")
    inspect.set_defaults(run=_inspect)
    inspect.shape = "furbake inspect DIR"

    check = commands.add_parser(
        "validate", help="check a baked folder: exit 1 and a list if it is bad", allow_abbrev=False
    )
    check.add_argument("folder", metavar="DIR", type=_path)
    check.set_defaults(run=_validate)
    check.shape = "furbake validate DIR"

    presets = commands.add_parser("presets", help="list the presets", allow_abbrev=False)
    presets.add_argument("--json", action="store_true", help="as one JSON object with all their options")
    presets.set_defaults(run=_presets)
    return parser


def _bake_arguments(parser: _Parser) -> None:
    parser.shape = "furbake bake MODEL -o DIR"
    parser.set_defaults(run=_bake)
    add = parser.add_argument
    unset: Any = argparse.SUPPRESS
    add("model", metavar="MODEL", type=_path, help="a mesh file, or sphere, plane, torus, torus:RxC")
    add("-o", "--out", metavar="DIR", required=True, type=_path, help="folder to write, whole or not at all")
    add("--preset", default="paper", metavar="NAME", help="sets what is not given (default: paper)")
    add("--layers", type=_whole, default=unset, metavar="K", help="slabs of the tile, 1 to 64")
    add("--size", type=_whole, default=unset, metavar="N", help="texels per side of a slab, a power of two, 8 to 512")
    add("--lights", type=_whole, default=unset, metavar="N", help="sampled directions of light, 8 to 1024")
    add("--basis", default=unset, metavar="ptm|eigen", help="the paper's polynomial, or curves found for this fur")
    add("--coefficients", type=_whole, default=unset, metavar="C", help="numbers per texel: 6, with eigen 3 to 6")
    add("--length", type=_number, default=unset, metavar="L", help="longest fur, the model's own units")
    add("--tile", type=_number, default=unset, metavar="W", help="width of a tile, the model's own units")
    add("--height", type=_number, default=unset, metavar="H", help="longest fur in tile widths: length / tile")
    add("--seed", type=_whole, default=unset, metavar="S", help="of all chance")
    add("--guide", type=_guide, default=unset, metavar="nose-tail|down", help="where the fur is laid")
    add("--length-by-thickness", action="store_true", default=unset, help="shorter fur where the body is thin")
    add("--flat", action="store_true", default=unset, help="a flat patch under a point at infinity, for checks")
    add("--samples", type=_path, metavar="FILE.npz", help="write the sampled physics too, for others to check")
    add("--force", action="store_true", help="replace DIR if it is a bake")
    add("--if-stale", action="store_true", help="only if DIR differs in options, input or version; implies --force")
    add("--json", action="store_true", help="print one JSON object with the record and the seconds of every stage")
    add("--quiet", action="store_true", help="no progress, no summary")


if __name__ == "__main__":
    sys.exit(main())
