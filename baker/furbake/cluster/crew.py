"""Workers of a scheduler as the crew of a batch, or as those who let light through the hairs of one bake."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from concurrent.futures import CancelledError, Future
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from queue import Empty, SimpleQueue
from threading import Thread
from typing import Any

from furbake.apart import CrashError
from furbake.batch.crew import LOOK, Event
from furbake.batch.job import Job
from furbake.cluster.client import check_shared, connected, dask
from furbake.cluster.parcel import keep, packed
from furbake.cluster.versions import ClusterError, versions
from furbake.cluster.work import Order, bake_there, let_go, lit_there
from furbake.device import device
from furbake.options import BakeOptions
from furbake.pelt.light.beam import Beam, Fields
from furbake.pelt.light.transport import Array, Beams
from furbake.surface.limits import VARIABLE
from furbake.tile.lighting import directions
from furbake.tile.tile import Spread

UNITS = 4
"""Units for each thread of all workers: few enough that voxels are made seldom, and no worker waits long at the end."""

RETRIES = 3
"""Times that the lights of a unit are begun anew where their process crashes."""


class ClusterCrew:
    """Workers of a scheduler, one bake for each of their threads; those of a worker that is lost go to others."""

    def __init__(self, client: Any, bound: int | None, *, send: bool) -> None:
        """bound : bytes of each bake; send : files and results go by the network."""
        self.client, self.bound, self.send = client, bound, send
        self.events: SimpleQueue[Event] = SimpleQueue()
        self.running: dict[str, Any] = {}
        self.versions = versions()

    def room(self, job: Job) -> bool:  # noqa: ARG002 — any bake is like any other
        try:
            threads: int = sum(self.client.nthreads().values())
        except OSError as error:
            raise ClusterError(f"scheduler: lost ({type(error).__name__}), expected it until all is done") from None
        return len(self.running) < max(1, threads)

    def start(self, job: Job) -> None:
        parcel = packed(job) if self.send else None
        limits = {VARIABLE: os.environ[VARIABLE]} if VARIABLE in os.environ else {}
        there = replace(job, out=job.out.absolute(), environment=limits)
        order = Order(there, self.versions, str(Path.cwd()), parcel, self.bound)
        future = self.client.submit(bake_there, order, pure=False)
        self.running[job.name] = future
        future.add_done_callback(lambda _: self.events.put(Event("done", job)))

    def next(self) -> Event | None:
        try:
            job = self.events.get(timeout=LOOK).job
        except Empty:
            return None
        try:
            baked, files = self.running.pop(job.name).result()
            if files:
                keep(job, files)
        except (Exception, CancelledError) as error:  # noqa: BLE001 — the batch goes on, and says what it was
            return Event("done", job, _understood(error))
        return Event("done", job, baked)

    def close(self) -> None:
        self.client.cancel(list(self.running.values()), force=True)


def _understood(error: BaseException) -> Exception:
    """An error of a unit; those of Dask as a sentence."""
    if type(error).__module__.partition(".")[0] in {"distributed", "asyncio", "concurrent", "dask"}:
        name = type(error).__name__
        lost = f"workers: the one that baked it was lost ({name})"
        return ClusterError(f"{lost}, expected memory for it there, and a scheduler that lives")
    if isinstance(error, CrashError):
        return ClusterError(f"workers: a process of theirs was ended ({error}), expected memory and time enough for it")
    return error if isinstance(error, Exception) else RuntimeError(str(error))


@contextmanager
def cluster_crew(scheduler: str, jobs: int, bound: int | None, shared: Path | None) -> Iterator[ClusterCrew]:
    """The crew of a scheduler.

    jobs : workers of `local`; bound : bytes of each bake; shared : a folder that all machines see, None: all is sent

    Raises ClusterError.
    """
    with connected(scheduler, jobs) as client:
        if shared is not None:
            check_shared(client, shared)
        crew = ClusterCrew(client, bound, send=shared is None)
        try:
            yield crew
        finally:
            crew.close()


@contextmanager
def spread_over(scheduler: str, workers: int) -> Iterator[Spread]:
    """Workers that sample the light of a bake, some lights of a state at a time. Raises ClusterError."""
    with connected(scheduler, workers) as client:
        try:
            yield _Spread(client)
        finally:
            client.run(let_go, on_error="ignore")


class _Spread:
    def __init__(self, client: Any) -> None:
        self.client, self.versions = client, versions()

    def __call__(self, options: BakeOptions, height: float, states: int) -> Sequence[Beams]:
        count = len(directions(options))
        size = max(1, -(-count * states // (UNITS * max(1, sum(self.client.nthreads().values())))))
        units = [
            (state, range(first, min(first + size, count)))
            for state in range(states)
            for first in range(0, count, size)
        ]
        found: list[Future[list[Fields]]] = [Future() for _ in units]
        Thread(target=self._gather, args=(options, height, units, found), daemon=True).start()

        def beams(state: int) -> Beams:
            def fields(_beam: Beam, _lights: Array) -> Iterator[Fields]:
                for (of, _), some in zip(units, found, strict=True):
                    if of == state:
                        yield from some.result()

            return fields

        return [beams(state) for state in range(states)]

    def _gather(
        self, options: BakeOptions, height: float, units: list[tuple[int, range]], found: list[Future[list[Fields]]]
    ) -> None:
        """Fetch each unit when it is done, so that a worker that is lost then costs nothing."""
        try:
            order = {
                self.client.submit(
                    lit_there, options, height, state, some, self.versions, device(),
                    pure=False, retries=RETRIES, priority=-number,
                ): number
                for number, (state, some) in enumerate(units)
            }  # fmt: skip
            for future in dask().as_completed(list(order)):
                found[order.pop(future)].set_result(future.result())
        except (Exception, CancelledError) as error:  # noqa: BLE001 — raised where the fields are wanted
            for left in found:
                if not left.done():
                    left.set_exception(_understood(error))
