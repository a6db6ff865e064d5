"""`furbake batch`: from arguments to an exit status."""

from __future__ import annotations

import json
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from furbake.asset.store import StoreError, atomic_file
from furbake.batch import memory
from furbake.batch.crew import Crew, LocalCrew
from furbake.batch.journal import journal
from furbake.batch.run import Row, Telling, run
from furbake.cli.baking import pelt_cache
from furbake.cli.batch.listing import listed
from furbake.cli.batch.table import Table, facts
from furbake.cli.command import INVALID, told
from furbake.cli.interrupt import INTERRUPTED
from furbake.cli.output import complain, say
from furbake.cluster.crew import cluster_crew
from furbake.cluster.versions import ClusterError
from furbake.cores import cores
from furbake.options import OptionError
from furbake.show.sheet import MARK, NAME, Cell, sheet, thumbnail


def run_batch(args: SimpleNamespace) -> int:
    """Bake many models."""
    out, start = Path(args.out), time.perf_counter()
    if args.jobs is not None and args.jobs < 1:
        raise OptionError(f"jobs: got {args.jobs}, expected 1 or more")
    cache = None if args.send and not args.cache else pelt_cache(args)
    jobs = listed(args.models, out, args, cache)
    _check_place(out)
    ends: list[Row] = []
    with (
        _crew(args, len(jobs)) as crew,
        journal(out) as log,
        Table(len(jobs), args.quiet or args.json) as table,
    ):

        def ended(row: Row) -> None:
            ends.append(row)
            table.row(row)
            if args.json:
                say(json.dumps(_plain(row)), flush=True)

        try:
            rows = run(jobs, log, crew, Telling(ended, table.event, _sentence))
        except (KeyboardInterrupt, ClusterError) as error:
            done = sum(row.status != "failed" for row in ends)
            why = "interrupted" if isinstance(error, KeyboardInterrupt) else str(error)
            complain(f"{why}: {done} of {len(jobs)} are done, the same command goes on from there")
            _write_sheet(out, ends, f"stopped: {done} of {len(jobs)} models")
            return INTERRUPTED if isinstance(error, KeyboardInterrupt) else INVALID
    counts = {status: sum(row.status == status for row in rows) for status in ("baked", "fresh", "failed")}
    seconds = time.perf_counter() - start
    summary = (
        f"{counts['baked']} baked, {counts['fresh']} up to date, {counts['failed']} failed "
        f"of {len(rows)} models, {seconds:.1f} s"
    )
    _write_sheet(out, rows, summary)
    if args.json:
        say(json.dumps({"folder": str(out), **counts, "seconds": seconds}))
    elif not args.quiet:
        say(f"{out}: {summary}; {out / NAME} shows them")
    for row in rows:
        if row.status == "failed":
            complain(f"error: {row.job.name}: {row.entry.error}")
    return INVALID if counts["failed"] else 0


def _check_place(out: Path) -> None:
    """Raise StoreError where the sheet would replace a page of somebody else."""
    if out.exists() and not out.is_dir():
        raise StoreError(f"{out}: is a file, expected a folder for the bakes")
    page = out / NAME
    if page.exists() and not (page.is_file() and MARK.encode() in page.read_bytes()[:200]):
        raise StoreError(f"{page}: not written by furbake batch, expected a folder without it")


@contextmanager
def _crew(args: SimpleNamespace, count: int) -> Iterator[Crew]:
    """Processes of this machine, or workers of a scheduler."""
    if args.scheduler is None and args.send:
        raise OptionError("send: got no --scheduler, expected one to send to")
    jobs = min(args.jobs or cores(), count)
    if args.scheduler is None:
        local = LocalCrew(jobs, args.memory or memory.free())
        try:
            yield local
        finally:
            local.close()
        return
    bound = args.memory // jobs if args.memory and args.scheduler == "local" else args.memory
    with cluster_crew(args.scheduler, jobs, bound, None if args.send else Path(args.out)) as crew:
        yield crew


def _sentence(error: Exception) -> str:
    """Why a bake failed."""
    return told(error) or f"{type(error).__name__}: {' '.join(str(error).split())}, an error of furbake's own"


def _plain(row: Row) -> dict[str, Any]:
    entry, record = row.entry, row.record
    found: dict[str, Any] = {
        "name": row.job.name, "model": row.job.model, "folder": str(row.job.out), "status": row.status,
        "seconds": entry.seconds, "memory": entry.memory,
    }  # fmt: skip
    if record is None:
        return {**found, "error": entry.error}
    return {**found, "bytes": sum(record["asset"]["bytes"].values()), "fit": record["fit"]}


def _write_sheet(out: Path, rows: Sequence[Row], summary: str) -> None:
    """Write the contact sheet, in place of an older one."""
    cells = [
        Cell(row.job.name, "", (), row.entry.error)
        if row.record is None
        else Cell(row.job.name, row.entry.picture or thumbnail(row.job.out), facts(row))
        for row in rows
    ]
    with atomic_file(out / NAME) as file:
        file.write(sheet(cells, summary).encode())
