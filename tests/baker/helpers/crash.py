"""Functions for a process of its own."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable
from typing import Any

from furbake.study.verify.pathtrace import VerifyError


def crash(*_arguments: Any, step: Callable[[float], None], **_options: Any) -> None:
    step(0.5)
    os.kill(os.getpid(), signal.SIGKILL)


def fail(*, step: Callable[[float], None]) -> None:
    step(0.0)
    raise VerifyError("mitsuba: no, expected yes")


def double(number: int, *, step: Callable[[float], None]) -> int:
    step(1.0)
    return 2 * number
