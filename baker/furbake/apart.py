"""Calls in a process of their own: what crashes there, or is killed, leaves a sentence, and its memory is known.

The process is a fresh interpreter, also inside a daemon, which may have no children by `multiprocessing`. It ends with
the one that started it, however that ends: it reads requests from a pipe, which closes then.
"""

from __future__ import annotations

import os
import pickle
import signal
import subprocess
from collections.abc import Callable, Mapping
from contextlib import suppress
from enum import Enum
from queue import SimpleQueue
from sys import executable
from threading import Thread
from typing import Any

SERVE = "from furbake.apart import serve; serve()"

ONE_THREAD = dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"), "1")
"""Environment of a process, where it does not say otherwise: algebra with one thread, as in the command."""


class Place(Enum):
    """Stands among the arguments of a call for what is on the other side."""

    TELL = "tell"


TELL = Place.TELL


class CrashError(RuntimeError):
    """A process that ended without an answer; the message names the signal or the exit status."""


class Apart:
    """A process that calls functions of modules, one after another."""

    def __init__(self, environment: Mapping[str, str] | None = None, folder: str | None = None) -> None:
        """environment : variables beside this process's own; folder : the current one, if not the same."""
        self.process = subprocess.Popen(  # noqa: S603 — this interpreter, and a text of ours
            [executable, "-P", "-c", SERVE],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            cwd=folder,
            env={**ONE_THREAD, **os.environ, **(environment or {})},
        )

    def call(
        self, function: Callable[..., Any], *arguments: Any, tell: Callable[..., None] = lambda *told: None
    ) -> Any:
        """Result of `function(*arguments)`; `TELL` among them stands for `tell`, which is then called here.

        Raises what the function raises, and CrashError where the process ends without an answer.
        """
        requests, answers = self.process.stdin, self.process.stdout
        if requests is None or answers is None:
            raise TypeError("got a process without pipes, expected both")
        try:
            pickle.dump((function, arguments), requests)
            requests.flush()
            while True:
                kind, value = pickle.load(answers)  # noqa: S301 — from a process of ours
                if kind == "done":
                    return value
                if kind == "error":
                    raise value
                tell(*value)
        except (EOFError, BrokenPipeError, pickle.UnpicklingError):
            raise CrashError(ending(self.process.wait())) from None

    def end(self) -> None:
        """End the process, whatever it does."""
        self.process.kill()
        self.process.wait()
        for pipe in (self.process.stdin, self.process.stdout):
            with suppress(OSError):  # what it has not read
                if pipe is not None:
                    pipe.close()


def ending(status: int) -> str:
    """Name of the signal that ended a process, or its exit status."""
    with suppress(ValueError):
        return signal.Signals(-status).name
    return f"exit status {status}"


def _said(value: Any) -> str:
    """Name and message of an exception, or its name alone where the message is no text."""
    with suppress(Exception):
        return f"{type(value).__name__}: {value}"
    return type(value).__name__


def serve() -> None:
    """Answer requests until the pipe closes; then the process ends at once, whatever it does."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # it is for the command, which ends this process
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # nothing that a library prints gets between the answers
    requests: SimpleQueue[tuple[Callable[..., Any], tuple[Any, ...]]] = SimpleQueue()

    def read() -> None:
        try:
            with os.fdopen(0, "rb", closefd=False) as pipe:
                while True:
                    requests.put(pickle.load(pipe))  # noqa: S301 — from the process that started this one
        finally:
            os._exit(0)

    Thread(target=read, daemon=True).start()

    def answer(kind: str, value: Any) -> None:
        try:
            text = pickle.dumps((kind, value))
        except Exception:  # noqa: BLE001 — what libraries raise may refuse to be data by any exception
            text = pickle.dumps(("error", RuntimeError(_said(value))))
        answers.write(text)
        answers.flush()

    def tell(*told: Any) -> None:
        answer("told", told)

    while True:
        function, arguments = requests.get()
        try:
            given = (tell if argument is TELL else argument for argument in arguments)
            done = function(*given)
        except Exception as error:  # noqa: BLE001 — raised again on the other side
            answer("error", error)
        else:
            answer("done", done)
