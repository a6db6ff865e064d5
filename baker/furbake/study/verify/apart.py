"""The path tracer in a process of its own: where it crashes, a sentence is left.

Mitsuba's compiled variants end in a segmentation fault on very many strands.
"""

from __future__ import annotations

import multiprocessing
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from multiprocessing.connection import Connection
from typing import Any

from furbake.apart import CrashError, ending
from furbake.study.verify import truth
from furbake.study.verify.cells import Cell, Frame
from furbake.study.verify.pathtrace import VerifyError

Step = Callable[[float], None]


def trace(
    scene: truth.Scene,
    seen: Frame,
    cells: list[Cell],
    spp: int,
    step: Step = lambda fraction: None,
    *,
    fast: bool = True,
) -> list[truth.Traced]:
    """As `truth.trace`. Raises VerifyError where Mitsuba is missing, and where it crashes."""
    try:
        found: list[truth.Traced] = apart(truth.trace, scene, seen, cells, spp, fast=fast, step=step)
    except CrashError as error:
        other = " or --scalar" if fast else ""
        raise VerifyError(
            f"mitsuba: ended by {error} with {len(scene.groom.points)} hairs, expected fewer of them "
            f"(bake with a larger --tile, or fewer by --set coat.under.count=N){other}"
        ) from error
    return found


def apart(function: Callable[..., Any], *arguments: Any, step: Step, **options: Any) -> Any:
    """Result of a function, called in a process of its own with `step` as its last option.

    Raises what the function raises, and CrashError where the process ends without an answer.
    """
    context = multiprocessing.get_context("spawn")
    answers, theirs = context.Pipe(duplex=False)
    process = context.Process(target=_work, args=(theirs, function, arguments, options), daemon=True)
    try:
        with _uninterrupted():
            process.start()
        theirs.close()
        while True:
            kind, value = answers.recv()
            if kind == "step":
                step(value)
            elif kind == "error":
                raise value
            else:
                return value
    except EOFError:
        process.join()
        raise CrashError(ending(process.exitcode or 0)) from None
    finally:
        answers.close()
        if process.pid is not None:
            process.kill()
            process.join()


def _work(answers: Connection, function: Callable[..., Any], arguments: Any, options: dict[str, Any]) -> None:
    """Call the function; answers are pairs of a kind (step, error or done) and its value."""
    try:
        done = function(*arguments, **options, step=lambda fraction: answers.send(("step", fraction)))
    except Exception as error:  # noqa: BLE001 — raised again on the other side
        answers.send(("error", error))
    else:
        answers.send(("done", done))


@contextmanager
def _uninterrupted() -> Iterator[None]:
    """Let processes that start in the block ignore Ctrl-C, which is for the command: it ends them."""
    try:
        before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    except ValueError:  # not the main thread
        yield
        return
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
