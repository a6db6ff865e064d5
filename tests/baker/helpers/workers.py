"""A scheduler of Dask and workers, each a process of its own."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

CALM = {"DASK_DISTRIBUTED__WORKER__DAEMON": "False", "DASK_LOGGING__DISTRIBUTED": "error"}


class Workers:
    """Their address and their processes; more can be started."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.file = folder, folder / "scheduler.json"
        self.processes = [self._start("scheduler", "--port", "0", "--no-dashboard", "--scheduler-file", self.file)]
        end = time.monotonic() + 60
        while not self.file.exists():
            assert time.monotonic() < end, "the scheduler does not come up"
            time.sleep(0.05)

    def _start(self, *arguments: object, **more: str) -> subprocess.Popen[bytes]:
        return subprocess.Popen(  # noqa: S603 — this interpreter
            [sys.executable, "-m", "dask", *map(str, arguments)],
            cwd=self.folder, env=os.environ | CALM | more, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )  # fmt: skip

    def add(self, **more: str) -> subprocess.Popen[bytes]:
        """One more worker with a thread; more : its environment."""
        arguments = ("--scheduler-file", self.file, "--no-nanny", "--nthreads", "1", "--no-dashboard")
        self.processes.append(self._start("worker", *arguments, **more))
        return self.processes[-1]

    @property
    def address(self) -> str:
        return str(json.loads(self.file.read_text())["address"])

    def end(self) -> None:
        for process in reversed(self.processes):
            process.kill()
            process.wait()


@contextmanager
def workers(folder: Path, count: int) -> Iterator[Workers]:
    folder.mkdir()
    found = Workers(folder)
    try:
        for _ in range(count):
            found.add()
        yield found
    finally:
        found.end()
