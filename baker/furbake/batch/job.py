"""One bake of a batch, run in a process of its own, here or on another machine."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from furbake.apart import TELL, Apart
from furbake.asset.store import BusyError, clear
from furbake.batch.memory import peak_memory
from furbake.options import BakeOptions
from furbake.pipeline import bake
from furbake.show.sheet import thumbnail

PATIENCE = 20.0
"""Seconds in which the last writer of a folder, whose batch or worker was killed, may end."""

Tell = Callable[[str, float], None]


@dataclass(frozen=True)
class Job:
    """A bake: its name in the batch, the model, its options and the folder to write.

    cache : of finished pelts, None: none
    environment, folder : variables, and the current folder, of the process that bakes
    """

    name: str
    model: str
    options: BakeOptions
    out: Path
    cache: Path | None = None
    environment: dict[str, str] = field(default_factory=dict)
    folder: str | None = None


@dataclass(frozen=True)
class Baked:
    """Result of a bake: seconds, most bytes of memory, `bake.json`, notices, a small picture as a data URI."""

    seconds: float
    memory: int
    record: dict[str, Any]
    notices: tuple[str, ...]
    picture: str


def baked(job: Job, tell: Tell = lambda stage, fraction: None) -> Baked:
    """Bake in this process, over an older bake if there is one. Raises what `bake` does."""
    end = time.monotonic() + PATIENCE
    start = time.perf_counter()
    while True:
        try:
            # A batch counts the memory of one process for each bake.
            result = bake(job.model, job.out, job.options, force=True, cache=job.cache, helped=False, progress=tell)
        except BusyError:
            if time.monotonic() > end:
                raise
            time.sleep(0.1)
        else:
            seconds = time.perf_counter() - start
            return Baked(seconds, peak_memory(), result.record, result.notices, thumbnail(job.out))


def bake_apart(job: Job, tell: Tell = lambda stage, fraction: None, own: Callable[[Apart], None] | None = None) -> Any:
    """As `baked`, in a process of its own, of which nothing is left where it crashes or is killed.

    own : called with the process before it begins

    Raises what `bake` does, and CrashError.
    """
    process = Apart(job.environment, job.folder)
    try:
        if own is not None:
            own(process)
        return process.call(baked, job, TELL, tell=tell)
    finally:
        process.end()
        clear(job.out)
