"""The loop of a batch: what is up to date is left, the rest is baked, whatever becomes of each."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Literal

from furbake.apart import CrashError
from furbake.batch.crew import Crew, Event, fur_of
from furbake.batch.job import Baked, Job
from furbake.batch.journal import Entry, Journal
from furbake.freshness import fresh_record

Status = Literal["baked", "fresh", "failed"]


@dataclass(frozen=True)
class Row:
    """A bake that has ended: how, what its journal says, and `bake.json` where it has one."""

    job: Job
    status: Status
    entry: Entry
    record: dict[str, Any] | None = None


@dataclass(frozen=True)
class Telling:
    """Listeners: of each row, of each event of the crew; and how an exception is said in one sentence."""

    row: Callable[[Row], None]
    event: Callable[[Event], None]
    sentence: Callable[[Exception], str]


def run(jobs: Sequence[Job], journal: Journal, crew: Crew, telling: Telling) -> list[Row]:
    """Bake what is not up to date; rows in the order of the jobs."""
    rows: dict[str, Row] = {}

    def ended(row: Row) -> None:
        rows[row.job.name] = row
        telling.row(row)

    waiting = []
    for job in jobs:
        record = fresh_record(job.model, job.out, job.options)
        if record is None:
            waiting.append(job)
            continue
        entry = journal.entries.get(job.name, Entry(job.name))
        ended(Row(job, "fresh", entry if entry.key == record["key"] else Entry(job.name, record["key"]), record))
    running: dict[str, Job] = {}
    while waiting or running:
        for job in _next(waiting, running, rows):
            if not crew.room(job):
                break
            waiting.remove(job)
            running[job.name] = job
            crew.start(job)
            telling.event(Event("began", job))
        event = crew.next()
        if event is None:
            continue
        telling.event(event)
        if event.kind in ("again", "done"):
            del running[event.job.name]
        if event.kind == "again":
            waiting.append(event.job)
        elif event.kind == "done":
            row = _row(event, telling)
            journal.add(row.entry)
            ended(row)
    return [rows[job.name] for job in jobs]


def _next(waiting: Sequence[Job], running: dict[str, Job], rows: dict[str, Row]) -> list[Job]:
    """Bakes in the order in which to begin them.

    The first in a fur leaves its pelt in the cache: others in it come after those for which nobody makes theirs.
    """
    busy = {fur_of(job) for job in running.values()}
    made = {fur_of(row.job) for row in rows.values() if row.status != "failed"}
    first: list[Job] = []
    later: list[Job] = []
    for job in waiting:
        fur = fur_of(job)
        alone = job.cache is None or fur in made or fur not in busy
        (first if alone else later).append(job)
        busy.add(fur)
    return first if first or running else later


def _row(event: Event, telling: Telling) -> Row:
    job, done = event.job, event.value
    if isinstance(done, Baked):
        entry = Entry(job.name, done.record["key"], done.seconds, done.memory, picture=done.picture)
        return Row(job, "baked", entry, done.record)
    if isinstance(done, CrashError):
        text = f"{job.model}: the process that baked it was ended ({done}), expected memory and time enough for it"
    else:
        text = telling.sentence(done)
    return Row(job, "failed", Entry(job.name, error=text))
