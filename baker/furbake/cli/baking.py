"""The action of `furbake bake`, which waits for no library that other sub-commands need."""

from __future__ import annotations

import json
import os
import time
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from types import SimpleNamespace
from urllib.parse import quote

from platformdirs import user_cache_path

from furbake.asset.store import check_folder
from furbake.cli.chosen import options_for
from furbake.cli.output import complain, say
from furbake.cli.parsing import UsageError
from furbake.cli.progress import shown
from furbake.cores import cores
from furbake.device import on_device
from furbake.freshness import fresh_record
from furbake.options import OptionError
from furbake.pipeline import STAGES, bake
from furbake.surface.read.reading import STAGES as USD
from furbake.surface.read.reading import kind_of
from furbake.tile.tile import Spread

FOLDER = "FURBAKE_CACHE"
"""Environment variable that names the folder; empty: no cache."""


def pelt_cache(args: SimpleNamespace) -> Path | None:
    """Folder of `--cache`, of the environment, or the user's own; None where nothing is to be kept.

    Raises OptionError for two answers, StoreError where the folder that was named cannot be one.
    """
    given = getattr(args, "cache", None)
    if getattr(args, "no_cache", False):
        if given:
            raise OptionError(f"cache: got {given!r} and --no-cache, expected one of them")
        return None
    folder = given or os.environ.get(FOLDER)
    if folder == "":
        return None
    if folder is None:
        return user_cache_path("furbake", appauthor=False) / "pelts"
    if not getattr(args, "send", False):  # else it is the workers' own
        check_folder(Path(folder))
    return Path(folder)


def run_bake(args: SimpleNamespace) -> int:
    """Bake a mesh into a folder."""
    args.model = args.model or mesh_of(args.groom)
    options = options_for(args.model, args)
    out = Path(args.out)
    if args.if_stale and (record := fresh_record(args.model, out, options)):
        if args.json:
            say(json.dumps({"folder": str(out), "baked": False, "seconds": {}, **record}))
        elif not args.quiet:
            say(f"{out}: up to date")
        return 0
    samples, cache = Path(args.samples) if args.samples else None, pelt_cache(args)
    start = time.perf_counter()
    with on_device(args.device), _spread(args) as spread, shown(STAGES, args.quiet, args.percent) as progress:
        result = bake(
            args.model, out, options, force=args.force or args.if_stale, samples=samples, progress=progress,
            cache=cache, spread=spread,
            notify=(lambda notice: None) if args.quiet else (lambda notice: complain(f"note: {notice}")),
        )  # fmt: skip
    if args.json:
        say(json.dumps({"folder": str(out), "baked": True, "seconds": result.seconds, **result.record}))
    elif not args.quiet:
        size = sum(result.record["asset"]["bytes"].values()) / 1e6
        say(
            f"{out}: {result.record['input']['name']} in {options.layers} layers of {options.size} x {options.size}, "
            f"{result.record['fit']['psnr']:.1f} dB, {size:.2f} MB, {time.perf_counter() - start:.1f} s"
        )
        if not args.if_stale:
            say(f"to see it: npm start, then {_on_the_page(out)}")
    return 0


def mesh_of(groom: str | None) -> str:
    """The model of a bake that names none: the mesh beside the strands. Raises UsageError where it has none."""
    if groom is None:
        raise UsageError("MODEL: missing, expected furbake bake MODEL -o DIR")
    if kind_of(groom) not in USD:
        raise UsageError(f"MODEL: missing, and {groom} holds strands alone, expected furbake bake MODEL -o DIR")
    return groom


def _spread(args: SimpleNamespace) -> AbstractContextManager[Spread | None]:
    """Workers that sample the light; None: this process does."""
    if args.scheduler is None:
        return nullcontext()
    from furbake.cluster.crew import spread_over  # noqa: PLC0415 — an optional extra

    return spread_over(args.scheduler, cores())


def _on_the_page(out: Path) -> str:
    """Way to show a baked folder on the demo page: its address below the page's, or a drop."""
    folders = out.resolve().parts
    if "public" in folders[:-1]:
        start = len(folders) - folders[::-1].index("public")
        return f"?model={quote('/'.join(folders[start:]))} in its address"
    return f"drop the folder {out} on the page"
