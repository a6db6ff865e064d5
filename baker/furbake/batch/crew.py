"""Crew of a batch: processes of this machine that bake, as many at a time as the memory holds."""

from __future__ import annotations

import time
from dataclasses import dataclass, replace
from queue import Empty, SimpleQueue
from threading import Event as Flag
from threading import Thread
from typing import Any, NamedTuple, Protocol

from furbake.apart import Apart, CrashError
from furbake.batch import memory
from furbake.batch.job import Baked, Job, bake_apart
from furbake.cores import shared_cores
from furbake.options import BakeOptions

LOOK = 0.02
"""Seconds between two looks at the memory."""

GROWN = 1.5
"""Factor on what a bake held that was ended for want of memory: its need at the next try."""

MARGIN = 1.1
"""Factor on what another bake of the same fur needed."""


class MemoryShortError(RuntimeError):
    """A bake that needs more memory than a batch may take; the message is a sentence."""


class Event(NamedTuple):
    """kind : began, step (a stage and its fraction), again (put back) or done (what was baked, or the exception)."""

    kind: str
    job: Job
    value: Any = None


class Crew(Protocol):
    """Processes or workers that bake; the loop of a batch says what and when."""

    def room(self, job: Job) -> bool:
        """True if this bake can begin now."""

    def start(self, job: Job) -> None:
        """Begin it; what becomes of it is an event."""

    def next(self) -> Event | None:
        """The next event, after a short wait; None where nothing has happened."""

    def close(self) -> None:
        """End all that is running."""


@dataclass
class _Running:
    job: Job
    need: int
    process: Apart | None = None
    ended: bool = False
    alone: bool = False

    @property
    def number(self) -> int:
        """Number of its process; 0 before that has begun."""
        return 0 if self.process is None else self.process.process.pid

    def end(self) -> None:
        """Kill its process, now or when it begins."""
        self.ended = True
        if self.process is not None:
            self.process.process.kill()


class LocalCrew:
    """Processes of this machine.

    Each bake reserves the bytes that another of its fur has needed, or else a guess, and more when it holds more. One
    begins where the bound has room for its bytes. Where all processes hold more than the bound, the bake that began
    last is ended and put back.
    """

    def __init__(self, jobs: int, bound: int) -> None:
        """jobs : at the same time, at most; bound : bytes, of this process, too."""
        self.jobs, self.bound = jobs, bound
        self.environment = shared_cores(jobs)
        self.events: SimpleQueue[Event] = SimpleQueue()
        self.running: dict[str, _Running] = {}
        self.needed: dict[Any, int] = {}
        self.needs: dict[str, int] = {}

    def room(self, job: Job) -> bool:
        """True if fewer than `jobs` run and the bound has room; a bake alone always has it."""
        if not self.running:
            return True
        return len(self.running) < self.jobs and self._reserved() + self._need(job) <= self.bound

    def _need(self, job: Job) -> int:
        known = self.needed.get(fur_of(job))
        return max(
            self.needs.get(job.name, 0),
            memory.guess(job.model, job.options) if known is None else int(MARGIN * known),
        )

    def _reserved(self) -> int:
        for one, taken in zip(self.running.values(), self._held(), strict=True):
            one.need = max(one.need, taken)
        return memory.own() + sum(one.need for one in self.running.values())

    def start(self, job: Job) -> None:
        one = self.running[job.name] = _Running(job, self._need(job))
        Thread(target=self._work, args=(one,), daemon=True).start()

    def _work(self, one: _Running) -> None:
        """Bake, in a thread that waits for its process."""

        def own(process: Apart) -> None:
            one.process = process
            if one.ended:
                process.process.kill()

        try:
            job = replace(one.job, environment=self.environment)
            done: Any = bake_apart(job, lambda *told: self.events.put(Event("step", one.job, told)), own)
        except Exception as error:  # noqa: BLE001 — the batch goes on, and says what it was
            done = error
        self.events.put(Event("done", one.job, done))

    def next(self) -> Event | None:
        self._look()
        try:
            event = self.events.get(timeout=LOOK)
        except Empty:
            return None
        if event.kind != "done":
            return event
        one = self.running.pop(event.job.name)
        if isinstance(event.value, Baked):
            fur = fur_of(event.job)
            self.needed[fur] = max(self.needed.get(fur, 0), event.value.memory)
        elif one.ended:
            return self._short(one)
        return event

    def _look(self) -> None:
        """End the bake that began last where more is held than the bound; one at a time."""
        held = self._held()
        if memory.own() + sum(held) <= self.bound or any(one.ended for one in self.running.values()):
            return
        last = list(self.running.values())[-1]
        last.alone = len(self.running) == 1
        self.needs[last.job.name] = int(GROWN * held[-1])
        last.end()

    def _held(self) -> list[int]:
        return memory.held([one.number for one in self.running.values()])

    def _short(self, one: _Running) -> Event:
        """Put a bake back that was ended, unless it had all the memory for itself."""
        if not one.alone:
            return Event("again", one.job)
        return Event("done", one.job, _too_little(self.bound))

    def close(self) -> None:
        for one in self.running.values():
            one.end()
        while self.running:
            event = self.events.get()
            if event.kind == "done":
                del self.running[event.job.name]


def bake_within(job: Job, bound: int | None) -> Baked:
    """As `bake_apart`, ended where it takes more bytes than the bound. Raises MemoryShortError then."""
    over = Flag()

    def watch(process: Apart) -> None:
        while bound is not None and process.process.poll() is None:
            if memory.held([process.process.pid])[0] > bound:
                over.set()
                process.process.kill()
            time.sleep(LOOK)

    def own(process: Apart) -> None:
        Thread(target=watch, args=(process,), daemon=True).start()

    try:
        found: Baked = bake_apart(job, own=own)
    except CrashError:
        if bound is not None and over.is_set():
            raise _too_little(bound) from None
        raise
    return found


def _too_little(bound: int) -> MemoryShortError:
    got = f"a bound of {megabytes(bound)} for bakes and command together"
    return MemoryShortError(f"memory: got {got}, expected more for this bake")


def fur_of(job: Job) -> tuple[BakeOptions, float]:
    """Key of a fur: equal for two bakes in the same one."""
    return job.options.of_tile(), job.options.own_height


def megabytes(number: int) -> str:
    """Bytes in words."""
    return f"{number / 1e6:.0f} MB"
