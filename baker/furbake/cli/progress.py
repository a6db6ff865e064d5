"""Progress of long work on standard error: a bar on a terminal, lines elsewhere."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn


@contextmanager
def shown(stages: Sequence[str], quiet: bool, every: bool = False) -> Iterator[Callable[[str, float], None]]:
    """A bar with the stages on a terminal, else a line for each stage that is done; both on standard error.

    every : a line for every percent of the whole instead, which other programs read
    """
    if every:
        yield _percents(stages)
        return
    if quiet:
        yield _silent
        return
    console = Console(stderr=True)
    if console.is_terminal:
        columns = (TextColumn("{task.description:<8}"), BarColumn(), TextColumn("{task.percentage:>3.0f} %"))
        with Progress(*columns, TimeElapsedColumn(), console=console, transient=True) as bar:
            task = bar.add_task(stages[0], total=len(stages))
            yield lambda stage, fraction: bar.update(
                task, description=stage, completed=stages.index(stage) + min(max(fraction, 0.0), 1.0)
            )
        return
    began: dict[str, float] = {}
    done: set[str] = set()

    def line(stage: str, fraction: float) -> None:
        now = time.perf_counter()
        start = began.setdefault(stage, now)
        if fraction >= 1.0 and stage not in done:
            done.add(stage)
            print(f"furbake: {stage} {now - start:.1f} s", file=sys.stderr)

    yield line


def _percents(stages: Sequence[str]) -> Callable[[str, float], None]:
    last = -1

    def line(stage: str, fraction: float) -> None:
        nonlocal last
        percent = int(100 * (stages.index(stage) + min(max(fraction, 0.0), 1.0)) / len(stages))
        if percent > last:
            last = percent
            print(f"furbake: {percent} % {stage}", file=sys.stderr, flush=True)

    return line


def _silent(_stage: str, _fraction: float) -> None:
    pass
