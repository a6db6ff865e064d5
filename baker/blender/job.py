"""A command that runs beside Blender: started, looked at now and then, stopped."""

from __future__ import annotations

import os
import re
import signal
import subprocess
from collections import deque
from pathlib import Path
from threading import Thread

LINES = 200
"""Lines of the command that are kept."""

WIDEST = 120
"""Characters of a foreign command's answer that are shown."""

GRACE = 5.0
"""Seconds for the command to clear up after it was interrupted."""

PATIENCE = 30.0
"""Seconds for a command to tell its version."""

HIDDEN = getattr(subprocess, "CREATE_NO_WINDOW", 0)
"""Flag that keeps Windows from opening a console."""

NAME = "furbake: "

PERCENT = re.compile(r"furbake: (\d+) % (.+)")


class JobError(RuntimeError):
    """A command that could not be started or has failed; one sentence."""


def answer(command: list[str]) -> list[str]:
    """Lines that a short command prints, cut; none where it cannot be started or does not end."""
    try:
        done = subprocess.run(  # noqa: S603 — the command that the artist names
            command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False,
            text=True, encoding="utf-8", errors="replace", creationflags=HIDDEN, timeout=PATIENCE,
        )  # fmt: skip
    except (OSError, subprocess.TimeoutExpired):
        return []
    return [line.strip()[:WIDEST] for line in done.stdout.splitlines() if line.strip()]


class Job:
    """A running command.

    percent : 0 to 100; stage : what it is doing; notes : what it told on the way, for the user
    """

    def __init__(self, command: list[str], folder: Path | None = None) -> None:
        """Start a command in a folder. Raises JobError where it cannot be started."""
        self.percent, self.stage = 0, ""
        self.notes: list[str] = []
        self.cancelled = False
        self._lines: deque[str] = deque(maxlen=LINES)
        try:
            self._process = subprocess.Popen(  # noqa: S603 — the command that the artist names
                command, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                text=True, encoding="utf-8", errors="replace", creationflags=HIDDEN,
            )  # fmt: skip
        except OSError as error:
            raise JobError(f"{command[0]}: {(error.strerror or str(error)).lower()}, expected furbake") from error
        self._reader = Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self) -> None:
        if self._process.stdout is None:
            return
        with self._process.stdout as output:
            for line in output:
                self._take(line.rstrip())

    def _take(self, line: str) -> None:
        if found := PERCENT.fullmatch(line):
            self.percent, self.stage = int(found[1]), found[2]
        elif line.startswith(f"{NAME}note: "):
            self.notes.append(line.removeprefix(f"{NAME}note: "))
        elif line:
            self._lines.append(line)

    @property
    def running(self) -> bool:
        return self._process.poll() is None

    def result(self) -> str:
        """The last line of the finished command. Raises JobError where it has failed or was cancelled."""
        code = self._process.wait()
        self._reader.join()
        last = self._lines[-1] if self._lines else ""
        if self.cancelled:
            raise JobError("cancelled, nothing was written")
        if code != 0:
            told = [line for line in self._lines if line.startswith(f"{NAME}error: ")]
            text = told[-1].removeprefix(f"{NAME}error: ") if told else last
            raise JobError(text or f"furbake ended with exit code {code}")
        return last

    def cancel(self) -> None:
        """Stop the command: it clears up, or is killed after `GRACE`."""
        if not self.running:
            return
        self.cancelled = True
        if os.name == "nt":
            self._process.terminate()
        else:
            self._process.send_signal(signal.SIGINT)
        try:
            self._process.wait(GRACE)
        except subprocess.TimeoutExpired:
            self._process.kill()
