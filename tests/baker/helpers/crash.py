"""Functions for a process of its own; the last argument of each takes a step."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable
from typing import Any

from furbake.study.verify.pathtrace import VerifyError

Step = Callable[[float], None]


def crash(*arguments: Any, **_options: Any) -> None:
    arguments[-1](0.5)
    os.kill(os.getpid(), signal.SIGKILL)


def fail(step: Step) -> None:
    step(0.0)
    raise VerifyError("mitsuba: no, expected yes")


def double(number: int, step: Step) -> int:
    step(1.0)
    return 2 * number
