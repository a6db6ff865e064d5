"""Ctrl-C while libraries are imported: one line, and the end.

An exception would not do: initialisers in C turn it into errors of their own.
"""

from __future__ import annotations

import os
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

INTERRUPTED = 130
MESSAGE = "interrupted, nothing written"


@contextmanager
def importing() -> Iterator[None]:
    """Stop the process at once on Ctrl-C during the block, unless somebody else listens to it."""
    if signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
        yield
        return
    try:
        signal.signal(signal.SIGINT, _stop)
    except ValueError:  # not the main thread, which alone is interrupted
        yield
        return
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def end_as_interrupted() -> None:
    """Let SIGTERM, by which CI and schedulers end a command, be as orderly an end as Ctrl-C."""
    if threading.current_thread() is threading.main_thread() and signal.getsignal(signal.SIGTERM) == signal.SIG_DFL:
        signal.signal(signal.SIGTERM, _interrupt)


def _interrupt(_number: int, _frame: Any) -> None:
    raise KeyboardInterrupt


def _stop(_number: int, _frame: Any) -> None:
    os.write(2, f"furbake: {MESSAGE}\n".encode())
    os._exit(INTERRUPTED)
