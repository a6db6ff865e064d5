"""Actions of `export`, and of `swatch` for files of museums."""

from __future__ import annotations

import json
from contextlib import nullcontext
from dataclasses import asdict
from pathlib import Path
from types import SimpleNamespace

from furbake.asset.planes import write_png
from furbake.asset.store import atomic_file, atomic_folder
from furbake.asset.validate import check
from furbake.cli import actions
from furbake.cli.output import complain, say
from furbake.cli.progress import shown
from furbake.options import OptionError
from furbake.rti.files import LP, is_rti, read_relit, suffix_of
from furbake.rti.fit import Figure, beside, fit_photographs, held_out
from furbake.rti.photographs import read_photographs
from furbake.rti.ptm import write_ptm
from furbake.rti.relight import write_relight
from furbake.rti.relit import LRGB, RGB, Relit, RtiError
from furbake.show.export import exported
from furbake.show.plain import write_plain
from furbake.show.swatch import FROM_THE_SIDE, light_direction


def run_export(args: SimpleNamespace) -> int:
    """Write a pelt from above as a PTM, and as planes of relight; the body as a GLB."""
    if not (args.ptm or args.relight or args.glb):
        raise OptionError("export: got none of --ptm, --relight and --glb, expected one of them")
    _among("format", args.kind, (LRGB, RGB))
    _among("planes", args.planes, ("jpg", "png"))
    source = Path(args.folder)
    check(source)
    if args.glb:
        with atomic_file(Path(args.glb)) as file:
            write_plain(file, source)
        if not (args.ptm or args.relight):
            return _told_body(args)
    folder = atomic_folder(Path(args.relight)) if args.relight else nullcontext()
    with folder as fresh, atomic_file(Path(args.ptm)) if args.ptm else nullcontext() as file:
        with shown(("fit",), args.quiet) as progress:
            found = exported(
                source, kind=args.kind, state=args.state, layer=args.layer, linear=args.linear, tiles=args.tiles,
                size=args.pixels, step=lambda fraction: progress("fit", fraction),
            )  # fmt: skip
        if file is not None:
            write_ptm(file, found.relit)
        if fresh is not None:
            write_relight(fresh, found.relit, args.planes)
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
    if not files or not is_rti(files[0]):
        if len(files) > 1:
            raise OptionError(f"swatch: got {files[1]} beside {files[0]}, expected one baked folder")
        args.folder = args.files[0] if files else None
        return actions.run_swatch(args)
    if args.preset or args.set or args.state:
        raise OptionError(f"swatch: got {files[0]} and --preset, --set or --state, expected the file alone")
    _among("format", args.kind, (LRGB, RGB))
    return _relit_swatch(args, files)


def _relit_swatch(args: SimpleNamespace, files: list[Path]) -> int:
    first, others = files[0], files[1:]
    light, out = light_direction(args.light or FROM_THE_SIDE), Path(args.out)
    measured = suffix_of(first) == LP
    if out.suffix.lower() not in {".png", *((".ptm",) if measured else ())}:
        expected = "a name that ends in .png" + (" or .ptm" if measured else "")
        raise OptionError(f"out: got {args.out}, expected {expected}")
    if others and not measured:
        raise OptionError(f"swatch: got {others[0]} beside {first}, expected it beside an .lp with its photographs")
    relit, figures = _fitted(first, others, args) if measured else (read_relit(first), [])
    if out.suffix.lower() == ".ptm":
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
    size = photographs.width, photographs.height
    known = {str(other): _of_size(read_relit(other), size, other) for other in others}
    with shown(("fit",), args.quiet) as progress:
        relit = fit_photographs(photographs, args.kind, lambda fraction: progress("fit", fraction))
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


def _among(name: str, value: str, known: tuple[str, ...]) -> None:
    if value not in known:
        raise OptionError(f"{name}: got {value!r}, expected {' or '.join(known)}")
