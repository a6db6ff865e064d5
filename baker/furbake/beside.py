"""Work beside a bake's own, in a process of its own: Python runs one thread at a time, and threads that work on small
arrays wait for each other longer than they work.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import suppress
from types import TracebackType
from typing import Any, Generic, Self, TypeVar

from furbake.apart import Apart, CrashError
from furbake.cores import VARIABLE, cores

Found = TypeVar("Found")


class Later(Generic[Found]):
    """A call that is wanted later: begun there by now, or made here when it is wanted."""

    def __init__(self, call: Callable[[], Found], there: Future[Found] | None) -> None:
        self._call, self._there = call, there

    def result(self) -> Found:
        """Result of the call. Raises what it raises."""
        if self._there is not None and not self._there.cancel():
            try:
                return self._there.result()
            except (CrashError, MemoryError):  # there may be memory for one
                pass
        self._there = Future()
        self._there.set_result(self._call())
        return self._there.result()


def results(calls: Sequence[Later[Found]]) -> list[Found]:
    """Results of calls, in their order; wanted from the last on, as they are made from the first on."""
    return [call.result() for call in reversed(calls)][::-1]


class Beside:
    """Calls of functions of modules, one after another in another process; here where none was started.

    No result depends on where it is found. Leaving the context ends the process, whatever it does.
    """

    def __init__(self, *, apart: bool = False) -> None:
        """apart : there may be another process"""
        self._wanted = apart
        self._process: Apart | None = None
        self._line: ThreadPoolExecutor | None = None
        self._calls = list[Future[Any]]()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._process is not None and self._line is not None:
            self._line.shutdown(wait=False, cancel_futures=True)
            self._process.end()

    def start(self) -> None:
        """Start the process, unless it is not wanted, cannot be had, or there is one core only."""
        if self._wanted and self._process is None and cores() > 1:
            with suppress(OSError):
                self._process, self._line = Apart({VARIABLE: "1"}), ThreadPoolExecutor(1)

    def submit(self, function: Callable[..., Found], *given: Any) -> Later[Found]:
        """The call of a function with data that can be pickled."""
        there = None
        if self._process is not None and self._line is not None:
            there = self._line.submit(self._process.call, function, *given)
            self._calls.append(there)
        return Later(lambda: function(*given), there)

    @property
    def busy(self) -> int:
        """Cores that it keeps busy."""
        return int(not all(call.done() for call in self._calls))
