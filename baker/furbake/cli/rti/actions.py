"""Actions of `export`, and of `swatch` for files of museums."""

from __future__ import annotations

import json
from contextlib import AbstractContextManager, nullcontext
from dataclasses import asdict
from pathlib import Path
from types import SimpleNamespace
from typing import BinaryIO

from furbake.asset.planes import write_png
from furbake.asset.store import atomic_file, atomic_folder
from furbake.asset.validate import check
from furbake.cli import actions
from furbake.cli.output import complain, say
from furbake.cli.progress import shown
from furbake.options import OptionError
from furbake.rti.files import LP, PTM, is_rti, members, read_relit, suffix_of
from furbake.rti.fit import Figure, beside, fit_photographs, held_out
from furbake.rti.photographs import LEAST, read_photographs
from furbake.rti.ptm import write_ptm
from furbake.rti.relight import write_relight
from furbake.rti.relit import LRGB, RGB, Relit, RtiError
from furbake.show.export import COMPOSITE, Exported, exported
from furbake.show.plain import write_plain
from furbake.show.swatch import FROM_THE_SIDE, light_direction

OF_PELT = ("kind", "state", "layer", "linear", "tiles", "pixels")
"""Options of a pelt from above."""


def run_export(args: SimpleNamespace) -> int:
    """Write a pelt from above as a PTM, and as planes of relight; the body as a GLB."""
    if not (args.ptm or args.relight or args.glb):
        raise OptionError("export: got none of --ptm, --relight and --glb, expected one of them")
    _check_export(args)
    source = Path(args.folder)
    check(source)
    folder = atomic_folder(Path(args.relight), force=None) if args.relight else nullcontext()
    with folder as fresh, _file(args.ptm) as file, _file(args.glb) as body:
        if body is not None:
            write_plain(body, source)
        found = _from_above(args, source) if args.ptm or args.relight else None
        if found is not None and file is not None:
            write_ptm(file, found.relit)
        if found is not None and fresh is not None:
            write_relight(fresh, found.relit, args.planes or "jpg")
    if found is None:
        return _told_body(args)
    written = [name for name in (args.ptm, args.relight, args.glb) if name]
    relit = found.relit
    if args.json:
        coding = {"coding": "linear" if args.linear else "srgb", "white": found.white}
        size = {"width": relit.width, "height": relit.height}
        say(json.dumps({"files": written, "kind": relit.kind, **size, **coding, "psnr": found.psnr}))
    elif not args.quiet:
        told = f"linear, byte 255 is {found.white:.3g}" if args.linear else "sRGB"
        size_told = f"{relit.width} x {relit.height}"
        say(f"{', '.join(written)}: {relit.kind}, {size_told}, {told}, {found.psnr:.1f} dB on lamps left out")
    return 0


def _file(name: str | None) -> AbstractContextManager[BinaryIO | None]:
    return atomic_file(Path(name)) if name else nullcontext()


def _from_above(args: SimpleNamespace, source: Path) -> Exported:
    look = {"tiles": args.tiles, "size": args.pixels}
    with shown(("fit",), args.quiet) as progress:
        return exported(
            source, kind=args.kind or LRGB, state=args.state, layer=args.layer or COMPOSITE, linear=args.linear,
            step=lambda fraction: progress("fit", fraction),
            **{name: value for name, value in look.items() if value is not None},
        )  # fmt: skip


def _check_export(args: SimpleNamespace) -> None:
    """Raise OptionError for values that there are not, names of other kinds of file and options without use."""
    _among("format", args.kind, (LRGB, RGB))
    _among("planes", args.planes, ("jpg", "png"))
    places = [Path(name).resolve() for name in (args.ptm, args.relight, args.glb) if name]
    if len({*places}) < len(places):
        raise OptionError(f"export: got {args.relight} twice, expected a place of its own for each")
    if not args.relight:
        _refuse(args, ("planes",), "export", "--ptm" if args.ptm else "--glb", "--relight beside it")
        if not args.ptm:
            _refuse(args, OF_PELT, "export", "--glb", "--ptm or --relight beside it")
    if args.layer not in (None, COMPOSITE):
        _refuse(args, ("tiles", "pixels"), "export", "--layer", f"them with {COMPOSITE}")


def _told_body(args: SimpleNamespace) -> int:
    size = Path(args.glb).stat().st_size
    if args.json:
        say(json.dumps({"files": [args.glb], "bytes": size}))
    elif not args.quiet:
        say(f"{args.glb}: the body without its fur, {size / 1e6:.2f} MB")
    return 0


def run_swatch(args: SimpleNamespace) -> int:
    """Write a picture of a baked pelt, of a preset's, or of a file of a museum."""
    files = [Path(name) for name in args.files]
    _among("format", args.kind, (LRGB, RGB))
    measured = bool(files) and suffix_of(files[0]) == LP
    if not measured:
        if Path(args.out).suffix.lower() == ".ptm":
            raise OptionError(f"out: got {args.out}, expected a name that ends in .png")
        _refuse(args, ("kind",), "swatch", files[0] if files else "no .lp", "it beside an .lp")
    if not files or not is_rti(files[0]):
        if len(files) > 1:
            raise OptionError(f"swatch: got {files[1]} beside {files[0]}, expected one baked folder")
        args.folder = args.files[0] if files else None
        return actions.run_swatch(args)
    _refuse(args, ("preset", "set", "state", "tiles", "pixels"), "swatch", files[0], "the file alone")
    return _relit_swatch(args, files)


def _relit_swatch(args: SimpleNamespace, files: list[Path]) -> int:
    first, others = files[0], files[1:]
    light, out = light_direction(args.light or FROM_THE_SIDE), Path(args.out)
    measured = suffix_of(first) == LP
    read = {path.resolve() for file in files for path in (file, *members(file))}
    if out.resolve() in read:
        raise OptionError(f"out: got {out}, which is read for it, expected another file")
    if out.suffix.lower() == PTM:
        _refuse(args, ("light",), "swatch", out, "a .png to be lit")
    if others and not measured:
        raise OptionError(f"swatch: got {others[0]} beside {first}, expected it beside an .lp with its photographs")
    relit, figures = _fitted(first, others, args) if measured else (read_relit(first), [])
    if out.suffix.lower() == PTM:
        with atomic_file(out) as file:
            write_ptm(file, relit)
    else:
        write_png(out, relit.picture(light), srgb=True)
    if args.json:
        record = {"kind": relit.kind, "width": relit.width, "height": relit.height}
        say(json.dumps({"file": str(out), **record, "fits": [asdict(figure) for figure in figures]}))
    elif not args.quiet:
        if figures:
            say(table(figures))
        say(f"{out}: {relit.kind}, {relit.width} x {relit.height}")
    return 0


def _fitted(path: Path, others: list[Path], args: SimpleNamespace) -> tuple[Relit, list[Figure]]:
    """The fit of an `.lp`, and how good it and others are."""
    photographs = read_photographs(path)
    if not args.quiet:
        for notice in photographs.notices:
            complain(f"note: {notice}")
    above = int((photographs.lights[:, 2] > 0).sum())
    if above < LEAST:
        raise RtiError(
            f"{path}: {above} of {len(photographs.lights)} lamps above the horizon, expected {LEAST} or more"
        )
    size = photographs.width, photographs.height
    known = {str(other): _of_size(read_relit(other), size, other) for other in others}
    with shown(("fit",), args.quiet) as progress:
        relit = fit_photographs(photographs, args.kind or LRGB, lambda fraction: progress("fit", fraction))
    return relit, [*held_out(photographs), *beside(photographs, known | {"this fit": relit})]


def table(figures: list[Figure]) -> str:
    """Fits in lines: numbers per pixel, decibels, and lamps by which they are judged."""
    rows = [("fit", "numbers", "dB", "lamps")]
    rows += [
        (figure.name, str(figure.numbers), f"{figure.psnr:.1f}", "left out" if figure.left_out else "all, seen")
        for figure in figures
    ]
    wide = max(len(row[0]) for row in rows)
    return "\n".join(f"{name:<{wide}}  {numbers:>7}  {psnr:>5}  {lamps}" for name, numbers, psnr, lamps in rows)


def _of_size(relit: Relit, size: tuple[int, int], path: Path) -> Relit:
    if (relit.width, relit.height) != size:
        expected = f"{size[0]} x {size[1]} as the photographs have"
        raise RtiError(f"{path}: {relit.width} x {relit.height} pixels, expected {expected}")
    return relit


def _among(name: str, value: str | None, known: tuple[str, ...]) -> None:
    if value is not None and value not in known:
        raise OptionError(f"{name}: got {value!r}, expected {' or '.join(known)}")


def _refuse(args: SimpleNamespace, names: tuple[str, ...], command: str, beside: object, expected: str) -> None:
    """Raise OptionError for the first of these options that is given, where it has no use."""
    for name in names:
        value = getattr(args, name)
        if value is not None and value is not False and value != ():
            flag = "format" if name == "kind" else name
            raise OptionError(f"{command}: got {beside} and --{flag}, expected {expected}")
